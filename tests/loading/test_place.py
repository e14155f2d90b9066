"""Test that placement is a rotation, one factor and a shift: Z up, metres, on the ground, centered."""

import numpy as np
import pytest
from assets import CUBE_FACES, box, mesh_of

from anymesh.errors import OptionError
from anymesh.kinds.usual import KINDS, usual_size
from anymesh.loading import LoadedMesh, load, load_mesh, place_mesh
from anymesh.loading.load import BELIEVED_FACTOR
from anymesh.loading.upright import up_of
from anymesh.types import Mesh

USUAL = {"_".join(words): kind.usual for words, kind in KINDS.items() if kind.usual is not None}
LOW, HIGH = np.array([1.0, 2, 3]), np.array([1.4, 2.5, 3.9])  # 0.4 x 0.5 x 0.9
SIDES = dict(zip("xyz", HIGH - LOW, strict=True))
ACROSS = {"x": "yz", "y": "xz", "z": "xy"}  # the file's axes that become the asset's x and y


def loaded(mesh: Mesh | None = None, *, path: str = "box.stl", up: str | None = None, unit: float | None = None) -> LoadedMesh:
    return LoadedMesh(mesh or mesh_of([box(LOW, HIGH)])[0], path, "0" * 64, up, unit, ())


def stands(mesh: Mesh) -> None:
    """Assert that a mesh is on the ground and centered."""
    low, high = mesh.bounds
    np.testing.assert_allclose([*(low + high)[:2], low[2]], 0, atol=1e-9 * max(1, mesh.diagonal))


@pytest.mark.parametrize("up", ["x", "y", "z", "-x", "-y", "-z"])
@pytest.mark.parametrize("scale", ["1", "0.001", "2.5e3"])
def test_placing_is_a_rotation_a_factor_and_a_shift(up, scale) -> None:
    source = loaded()
    placed = place_mesh(source, up=up, scale=scale)
    factor, R = float(scale), placed.T_asset_source[:3, :3] / float(scale)
    np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(R) == pytest.approx(1)
    sign = -1 if up[0] == "-" else 1
    np.testing.assert_allclose(R @ (sign * np.eye(3)["xyz".index(up[-1])]), [0, 0, 1], atol=1e-12)
    assert placed.up == up
    np.testing.assert_allclose(sorted(placed.mesh.extents[:2]), sorted(factor * SIDES[k] for k in ACROSS[up[-1]]))
    assert placed.mesh.extents[2] == pytest.approx(factor * SIDES[up[-1]])
    moved = source.mesh.triangles @ placed.T_asset_source[:3, :3].T + placed.T_asset_source[:3, 3]
    np.testing.assert_allclose(placed.mesh.triangles, moved, rtol=1e-12, atol=1e-12 * factor)
    assert (
        np.einsum("fc,fc->f", placed.mesh.face_normals, placed.mesh.triangles.mean(1) - placed.mesh.bounds.mean(0)) > 0
    ).all()
    stands(placed.mesh)


@pytest.mark.parametrize(
    ("unit", "name", "told"),
    [
        (1.0, "box.glb", ""),
        (15.0, "box.glb", ""),
        (90.0, "box.glb", "metres; if so, give --scale 1"),
        (300.0, "x.dae", "metres; if so, give --scale 1"),
        (0.008, "x.dae", "metres; if so"),
    ],
)
def test_an_object_that_is_large_or_small_in_the_unit_of_its_file_gets_a_warning(unit: float, name: str, told: str) -> None:
    """A diagonal of 1.1 units, thus of 330 m."""
    placed = place_mesh(loaded(unit=unit, path=name), up="z")
    assert placed.metric
    assert told in " ".join(placed.warnings)
    assert any("--scale" in w for w in placed.warnings) == bool(told)


@pytest.mark.parametrize(
    ("name", "unit"), [("cabinet.glb", "centimetres"), ("thing.glb", "centimetres"), ("x/van.glb", "inches")]
)
def test_the_likely_unit_is_told(name: str, unit: str) -> None:
    mesh = mesh_of([box([0, 0, 0], [50, 40, 70] if "van" not in name else [190, 80, 70])])[0]
    (warning,) = place_mesh(loaded(mesh, path=name, up="z", unit=1.0)).warnings
    assert f"it is probably in {unit}; if so, give --scale" in warning


@pytest.mark.parametrize(("probability", "warned"), [(0.5, True), (0.7, False), (None, False)])
def test_an_up_axis_that_is_hardly_likely_gets_a_warning(monkeypatch, probability: float | None, warned: bool) -> None:
    monkeypatch.setattr(load, "infer_up", lambda mesh, usual: up_of(np.array([0.0, -1, 0]), probability))
    placed = place_mesh(loaded())
    assert placed.up == "-y"
    assert any("--up" in w for w in placed.warnings) == warned


@pytest.mark.parametrize(("axis", "length"), [("x", 0.4), ("y", 0.9), ("z", 0.5), ("longest", 0.9), ("diagonal", 1.104536)])
def test_a_length_along_an_axis_of_the_asset(axis, length) -> None:
    placed = place_mesh(loaded(), up="y", scale=f"0.45:{axis}")
    x, y, z = placed.mesh.extents
    sides = {"x": x, "y": y, "z": z, "longest": max(x, y, z), "diagonal": placed.mesh.diagonal}
    assert sides[axis] == pytest.approx(0.45)
    assert np.cbrt(np.linalg.det(placed.T_asset_source[:3, :3])) == pytest.approx(0.45 / length, rel=1e-5)


@pytest.mark.parametrize(
    "up", ["", "xy", "Z", "w", "--z", "auto ", "xyz", "0,0,0", "1,2", "1,2,3,4", "nan,0,1", "inf,0,1", "a,b,c"]
)
def test_an_up_that_is_not_valid(up) -> None:
    with pytest.raises(OptionError, match=r"--up: found .*; valid are auto, infer, x, y, z, -x"):
        place_mesh(loaded(), up=up)


@pytest.mark.parametrize(
    "scale", ["", "big", "0", "-1", "nan", "inf", "1e999", "1:", "1:w", ":z", "0:z", "nan:z", "1:2:z", "x:1"]
)
def test_a_scale_that_is_not_valid(scale) -> None:
    with pytest.raises(OptionError, match=r"--scale: found .*valid are auto, a factor .* METRES:AXIS") as caught:
        place_mesh(loaded(), scale=scale)
    assert "\n" not in str(caught.value)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("scale", ["1e300", "1e-300", "1e-320", "1e308:z", "1e-300:longest", "1e7", "1e-7"])
def test_a_scale_that_no_output_could_hold(scale) -> None:
    with pytest.raises(OptionError, match=r"--scale: found .*diagonal .*; valid are 1e-06 to 1e\+06 m"):
        place_mesh(loaded(), scale=scale)


def test_a_length_along_an_axis_without_extent() -> None:
    flat, _ = mesh_of([(np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]]))])
    with pytest.raises(OptionError, match="no extent along z"):
        place_mesh(loaded(flat), up="z", scale="1:z")
    stands(place_mesh(loaded(flat), up="z", scale="1:x").mesh)


@pytest.mark.parametrize("factor", [1, 0.001, 0.01, 0.0254, 1e-30, 1e9])
def test_auto_scale_gives_a_size_of_things(factor) -> None:
    mesh = mesh_of([box(LOW / factor, HIGH / factor)])[0]
    placed = place_mesh(loaded(mesh))
    assert 0.02 <= placed.mesh.diagonal <= 12
    assert (len(placed.warnings) == 1) == (factor in (1e-30, 1e9))
    told = place_mesh(loaded(mesh, unit=float(factor)))
    assert told.mesh.diagonal == pytest.approx(np.linalg.norm(HIGH - LOW))
    assert told.warnings == ()


def test_a_unit_that_cannot_be_true_is_said() -> None:
    placed = place_mesh(loaded(unit=1e6))
    assert placed.mesh.diagonal == pytest.approx(1)
    assert "1.1e+06 m" in placed.warnings[0]


def test_auto_up_prefers_what_the_format_tells_then_what_the_object_stands_on() -> None:
    assert place_mesh(loaded(up="x")).up == "x"
    assert place_mesh(loaded(up="x"), up="y").up == "y"
    corners = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, 0, 2]])
    pyramid = corners, np.array([[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    upright = mesh_of([pyramid])[0]
    lying = upright.transformed(np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]]))
    for path, usual in (("a.stl", "z"), ("a.obj", "y")):
        assert place_mesh(loaded(upright, path=path)).up == "z"
        assert place_mesh(loaded(lying, path=path)).up == "y"
        assert place_mesh(loaded(mesh_of([box((0, 0, 0), (1, 1, 1))])[0], path=path)).up == usual


def test_far_from_the_origin_the_shape_stays() -> None:
    shift = np.array([4.5e6, -3e6, 2e6])  # coordinates of a map
    near, far = (place_mesh(loaded(mesh_of([box(LOW + s, HIGH + s)])[0]), up="z") for s in (0, shift))
    np.testing.assert_allclose(far.mesh.triangles, near.mesh.triangles, atol=1e-8)
    stands(far.mesh)


def test_degenerate_and_duplicate_faces_and_tiny_components_stay(tmp_path) -> None:
    rng = np.random.default_rng(0)
    pieces = [box(LOW, HIGH)] + [box(c, c + 1e-4) for c in rng.uniform(LOW, HIGH - 1e-3, (300, 3))]
    mesh, _ = mesh_of(pieces)
    faces = np.concatenate([mesh.faces, CUBE_FACES, [[0, 0, 1], [2, 2, 2]]])
    text = "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in mesh.vertices.tolist())
    text += "".join(f"f {a} {b} {c}\n" for a, b, c in (faces + 1).tolist())
    (tmp_path / "dust.obj").write_text(text)
    placed = place_mesh(load_mesh(tmp_path / "dust.obj"), up="z")
    assert len(placed.mesh.faces) == len(faces)
    assert (placed.mesh.face_areas == 0).sum() == 2
    np.testing.assert_allclose(placed.mesh.extents, HIGH - LOW)
    again = place_mesh(load_mesh(tmp_path / "dust.obj"), up="z")
    np.testing.assert_array_equal(again.mesh.vertices, placed.mesh.vertices)


def placed(longest: float, *, path: str = "thing.obj", unit: float | None = None, category: str | None = None):
    mesh = mesh_of([box((0, 0, 0), (longest, longest / 2, longest / 3))])[0]
    return place_mesh(LoadedMesh(mesh, path, "0" * 64, "z", unit, ()), category=category)


@pytest.mark.parametrize(
    ("words", "kind"),
    [
        ("microwave", "microwave"),
        ("my_OldFridge-02", "fridge"),
        ("table lamp", "lamp"),
        ("washing machine", "washing_machine"),
        ("WashingMachine", "washing_machine"),
        ("coffee table", "table"),
        ("toy_car", None),
        ("scene", None),
        ("carpet", None),
    ],
)
def test_the_kind_is_the_last_word_that_is_known(words, kind):
    found = usual_size(words)
    assert (None if found is None else found[0]) == kind


@pytest.mark.parametrize(("factor", "told"), [(1.0, "metres"), (1000.0, "millimetres"), (100.0, "centimetres")])
def test_a_file_without_a_unit_gets_the_one_that_suits_its_name(factor, told):
    found = placed(0.9 * USUAL["microwave"] * factor, path="microwave.obj")
    assert found.mesh.extents.max() == pytest.approx(0.9 * USUAL["microwave"])
    assert told in found.notes[1]
    assert found.warnings == ()


def test_where_no_unit_suits_it_gets_the_usual_size_and_says_so():
    found = placed(7.3e6, path="microwave.obj")
    assert found.mesh.extents.max() == pytest.approx(USUAL["microwave"])
    assert "size prior: a microwave is about 0.5 m" in found.notes[1]
    assert "7.3e+06 m long" in found.warnings[0]


def test_a_unit_in_the_file_counts_for_more_than_its_name_and_less_than_the_category():
    huge = 2 * BELIEVED_FACTOR * USUAL["microwave"]
    assert placed(huge, path="microwave.glb", unit=1.0).mesh.extents.max() == pytest.approx(huge)
    told = placed(huge, path="thing.glb", unit=1.0, category="microwave oven")
    assert told.mesh.extents.max() == pytest.approx(USUAL["microwave_oven"])
    assert "the file's unit would make the microwave oven 3 m long" in told.warnings[0]
    right = placed(0.45, path="thing.glb", unit=1.0, category="microwave")
    assert right.mesh.extents.max() == pytest.approx(0.45)
    assert right.warnings == ()
