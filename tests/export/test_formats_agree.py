"""Test that all formats agree: joint frames, limits, resistance, drives, poses, inertia, collision, base."""

import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from assets import cabinet, poses, slanted, within_limits
from models import CONFIG, desk, model_of, with_meshes
from readers import READERS
from scipy.spatial.transform import Rotation

from anymesh.errors import MissingExtraError, OptionError
from anymesh.export.formats import WRITERS, load_libraries, main_file, write_formats
from anymesh.export.model import Exclusion, drives
from anymesh.export.notation import principal, quaternion, rpy, turning_x_to
from anymesh.export.options import DEFAULT, Base, Driven, ExportOptions, Format, parse_formats
from anymesh.formats.robot.sdf import joint_names
from anymesh.physics.resistance import ResistanceLevel
from anymesh.types import Box, Cylinder, JointType

ASSETS = {"cabinet": cabinet, "slanted": slanted, "desk": desk}
DOCS = Path(__file__).parents[2] / "docs" / "formats.md"
CLOSE = {"atol": 1e-5, "rtol": 1e-6}


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Write an asset in all formats, once."""

    @cache
    def write(name: str, base: Base):
        folder = tmp_path_factory.mktemp(f"{name}_{base}")
        model = model_of(ASSETS[name](), base=base)
        write_formats(model, with_meshes(model, folder), tuple(Format), CONFIG)
        return model, folder

    return write


def read(written, name, kind, base=Base.FIXED):
    model, folder = written(name, base)
    return model, READERS[kind](folder, name)


@pytest.mark.parametrize("kind", READERS)
@pytest.mark.parametrize("name", ASSETS)
def test_links_are_where_the_joints_put_them(written, name, kind):
    model, found = read(written, name, kind)
    origins = {link.name: link.origin for link in model.links}
    rename = joint_names(model) if kind == "sdf" else {j.name: j.name for j in model.asset.joints}
    rng = np.random.default_rng(3)
    for positions in [{}, *(within_limits(model.asset, rng) for _ in range(5))]:
        expected = poses(model.asset, positions)
        links = found.poses({rename[joint]: value for joint, value in positions.items()})
        assert set(links) == set(expected)
        for link, T in expected.items():
            there = T.copy()
            there[:3, 3] += T[:3, :3] @ origins[link]
            np.testing.assert_allclose(links[link], there, atol=1e-5)


@pytest.mark.parametrize("kind", READERS)
@pytest.mark.parametrize("name", ASSETS)
def test_joints_say_the_same(written, name, kind):
    model, found = read(written, name, kind)
    motors = drives(model)
    rename = joint_names(model) if kind == "sdf" else {}
    # in MJCF a nested body is enough
    moving = [j for j in model.asset.joints if kind != "mjcf" or j.type is not JointType.FIXED]
    assert set(found.joints) == {rename.get(j.name, j.name) for j in moving}
    for j in moving:
        said = found.joints[rename.get(j.name, j.name)]
        assert (said["type"], said["parent"], said["child"]) == (j.type, j.parent, j.child)
        if j.type is JointType.FIXED:
            continue
        assert (said["limits"] is None) == (j.limits is None)
        if j.limits is not None:
            np.testing.assert_allclose(said["limits"], j.limits, **CLOSE)
        words = ("effort", "velocity", "damping", "friction", "armature")
        expected = {key: getattr(model.resistances[j.name], key) for key in words}
        expected["drive"] = (motors[j.name].stiffness, motors[j.name].damping, motors[j.name].effort)
        for key, value in expected.items():
            assert (key in said) != ((kind, key) in GAPS), f"{kind} and docs/formats.md differ on {key}"
            if key in said:
                np.testing.assert_allclose(said[key], value, rtol=1e-6)


def documented_gaps() -> set[tuple[str, str]]:
    """Return (format, concept) of the cells that say GAP."""
    written = DOCS.read_text().partition("## What is written")[2]
    rows = [line.strip("|\n").split(" | ") for line in written.splitlines() if line.startswith("|")]
    heads = [cell.strip().lower() for cell in rows[0]]
    return {(heads[i], row[0].strip()) for row in rows[2:] for i, cell in enumerate(row) if cell.strip().startswith("GAP")}


GAPS = documented_gaps()


@pytest.mark.parametrize("kind", READERS)
@pytest.mark.parametrize("name", ASSETS)
def test_mass_and_collision_are_the_same(written, name, kind):
    model, found = read(written, name, kind)
    directions = np.random.default_rng(4).normal(size=(30, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    for body in model.bodies:
        said = found.bodies[body.name]
        assert said.mass == pytest.approx(body.inertia.mass, rel=1e-6)
        np.testing.assert_allclose(said.center, body.inertia.center, atol=1e-6)
        np.testing.assert_allclose(said.tensor, body.inertia.tensor, atol=2e-6 * np.trace(body.inertia.tensor))
        assert len(said.supports) == len(body.shapes)
        for shape, support in zip(body.shapes, said.supports, strict=True):
            for d in directions:
                assert support(d) == pytest.approx(reach(shape, d), abs=1e-5)


def reach(shape, d) -> float:
    """Return the support of a shape in a direction."""
    match shape:
        case Box():
            return float(d @ shape.center + np.abs(d @ shape.rotation) @ shape.size / 2)
        case Cylinder():
            local = d @ shape.rotation
            round_and_flat = shape.radius * np.hypot(local[0], local[1]) + shape.length / 2 * abs(local[2])
            return float(d @ shape.center + round_and_flat)
        case _:
            return float((shape.vertices @ d).max())


@pytest.mark.parametrize("kind", ["mjcf", "usd", "sdf", "glb"])
@pytest.mark.parametrize("base", Base)
def test_the_base_is_fixed_or_free(written, kind, base):
    assert read(written, "cabinet", kind, base)[1].fixed == (base is Base.FIXED)


def test_the_same_model_gives_the_same_bytes(tmp_path):
    contents = []
    for run in ("a", "b"):
        (tmp_path / run).mkdir()
        model = model_of(desk(), exclusions=(Exclusion("desk", "lid", "they touch"),))
        write_formats(model, with_meshes(model, tmp_path / run), tuple(Format), CONFIG)
        contents.append({p.relative_to(tmp_path / run): p.read_bytes() for p in (tmp_path / run).rglob("*") if p.is_file()})
    assert contents[0] == contents[1]
    assert not [name for name, content in contents[0].items() if str(tmp_path).encode() in content]  # paths are relative


POLES = [Rotation.from_euler("xyz", (0.3, sign * np.pi / 2, -0.7)).as_matrix() for sign in (1, -1)]
HALF_TURNS = [Rotation.from_rotvec(np.pi * axis).as_matrix() for axis in np.eye(3)]
ROTATIONS = [*Rotation.random(50, rng=1).as_matrix(), np.eye(3), *POLES, *HALF_TURNS]


@pytest.mark.parametrize("R", ROTATIONS)
def test_roll_pitch_yaw_and_quaternion_there_and_back(R):
    np.testing.assert_allclose(Rotation.from_euler("xyz", rpy(R)).as_matrix(), R, atol=1e-9)
    found = quaternion(R)
    assert found[0] >= 0
    np.testing.assert_allclose(Rotation.from_quat(found, scalar_first=True).as_matrix(), R, atol=1e-9)


@pytest.mark.parametrize("axis", [*(R[0] for R in ROTATIONS), *np.eye(3), *-np.eye(3)])
def test_x_is_turned_to_any_axis(axis):
    R = turning_x_to(axis)
    np.testing.assert_allclose(R[:, 0], axis, atol=1e-9)
    np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-9)
    assert np.linalg.det(R) > 0


@pytest.mark.parametrize("R", ROTATIONS[:10])
def test_principal_axes_give_the_tensor_back(R):
    tensor = (R * np.array([3.0, 1.0, 2.5])) @ R.T
    moments, axes = principal(tensor)
    np.testing.assert_allclose((axes * moments) @ axes.T, tensor, atol=1e-12)
    np.testing.assert_allclose(moments, [1, 2.5, 3])
    assert np.linalg.det(axes) == pytest.approx(1)


def test_formats_are_read_once_each_in_the_order_of_the_set():
    assert parse_formats("glb, URDF,glb") == (Format.URDF, Format.GLB)
    assert parse_formats(",".join(Format)) == tuple(Format)
    assert Format.USD not in DEFAULT  # requires the extra


@pytest.mark.parametrize("text", ["", " , ", "urdf,stl", "xml"])
def test_what_is_not_a_format_is_named_with_what_is(text):
    with pytest.raises(OptionError, match="valid are urdf, mjcf, usd, sdf, glb") as error:
        parse_formats(text)
    assert text.rpartition(",")[2].strip() in str(error.value)


def test_every_format_has_a_writer_and_writes_its_main_file(tmp_path):
    assert set(WRITERS) == set(Format)
    model = model_of(cabinet())
    for kind in Format:
        folder = tmp_path / kind
        folder.mkdir()
        write_formats(model, with_meshes(model, folder), [kind], CONFIG)
        written = {p.name for p in folder.iterdir()} - {"meshes", "model.config"}
        assert written == {main_file(kind, "cabinet")}


@pytest.mark.parametrize(("kind", "package", "told"), [("usd", "pxr", r"\.\[usd\]"), ("mjcf", "mujoco", "reinstall")])
def test_a_missing_package_is_one_error_that_says_how_it_is_had(kind, package, told, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(MissingExtraError, match=told):
        write_formats(model_of(cabinet()), tmp_path, [Format(kind)], CONFIG)
    assert not list(tmp_path.iterdir())
    if kind == "usd":
        with pytest.raises(MissingExtraError, match=told):
            load_libraries([Format.URDF, Format.USD])


def test_the_options_of_an_asset_are_those_that_it_was_written_with() -> None:
    options = {"base": "free", "drives": "position", "hulls": 7, "resistance": "stiff"}
    asset = {"files": {"usd": "a.usda", "mjcf": "a.xml"}, **options}
    kept = ExportOptions(Base.FREE, (Format.MJCF, Format.USD), Driven.POSITION, 7, ResistanceLevel.STIFF)
    assert ExportOptions.parse({}, before=asset) == kept
    assert ExportOptions.parse(dict.fromkeys(("base", "formats", "drives", "hulls", "resistance")), before=asset) == kept
    assert kept.record() == options
    given = ExportOptions.parse({"drives": "passive", "formats": "glb", "hulls": 0, "resistance": "typical"}, before=asset)
    assert given == ExportOptions(Base.FREE, (Format.GLB,))
    assert given.record() == {"base": "free", "drives": "passive", "resistance": "typical"}
    assert ExportOptions.parse({}, before={}) == ExportOptions()


@pytest.mark.parametrize("damaged", [{"base": "fixd"}, {"base": ["fixed"]}, {"drives": 1}, {"hulls": "2"}, {"hulls": -1}])
def test_a_damaged_record_of_an_asset_gives_one_clear_error(damaged: dict) -> None:
    with pytest.raises(OptionError, match=r"found .*; valid (are|is)"):
        ExportOptions.parse({}, before=damaged)
