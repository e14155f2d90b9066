"""Test that all formats agree: joint frames, limits, resistance, drives, poses, inertia, collision, base."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from assets import cabinet, poses, slanted, within_limits
from models import CONFIG, desk, model_of, with_meshes
from readers import READERS

from anymesh.export.formats import Format, write_formats
from anymesh.export.model import Base, Exclusion, drives
from anymesh.export.sdf import joint_names
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
        expected = {key: getattr(j, key) for key in ("effort", "velocity", "damping", "friction")}
        expected["drive"] = (motors[j.name].stiffness, motors[j.name].damping, motors[j.name].effort)
        for key, value in expected.items():
            assert (key in said) != ((kind, key) in GAPS), f"{kind} and docs/formats.md differ on {key}"
            if key in said:
                np.testing.assert_allclose(said[key], value, rtol=1e-6)


def documented_gaps() -> set[tuple[str, str]]:
    """Return (format, concept) of the cells that say GAP."""
    rows = [line.strip("|\n").split(" | ") for line in DOCS.read_text().splitlines() if line.startswith("|")]
    heads = [cell.strip().lower() for cell in rows[0]]
    return {(heads[i], row[0].strip()) for row in rows[2:] for i, cell in enumerate(row) if cell.strip().startswith("GAP")}


GAPS = documented_gaps()


@pytest.mark.parametrize("kind", [k for k in READERS if k != "glb"])
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


@pytest.mark.parametrize("kind", ["mjcf", "usd", "sdf"])
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
