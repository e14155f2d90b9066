"""Test that the direction that points up is read, and inferred from how the object can stand, in any rotation."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.errors import OptionError
from anymesh.evaluation.changes import changed, rotation
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.ground_truth import prepared
from anymesh.loading import LoadedMesh, place_mesh
from anymesh.loading.upright import Stander, distinct, infer_up, read_up, up_candidates, up_classifier, up_features, up_of
from anymesh.types import Mesh

Z = np.array([0.0, 0, 1])


def turn(axis, degrees: float) -> np.ndarray:
    return rotation(np.asarray(axis, float) / np.linalg.norm(axis), np.deg2rad(degrees))


def moved(mesh: Mesh, R: np.ndarray, scale: float = 1.0) -> Mesh:
    """Rotate, scale and shift a mesh."""
    T = R.copy()
    T[:3, :3] *= scale
    T[:3, 3] = 3.0, -1.0, 2.0
    return mesh.transformed(T)


def table() -> Mesh:
    """A table: a top 1.2 x 0.8 x 0.04 on four legs of 0.7."""
    legs = [box((x, y, 0), (x + 0.06, y + 0.06, 0.7)) for x in (0, 1.14) for y in (0, 0.74)]
    return mesh_of([*legs, box((0, 0, 0.7), (1.2, 0.8, 0.74))])[0]


def pyramid() -> Mesh:
    corners = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, 0, 2]])
    return mesh_of([(corners, np.array([[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]))])[0]


def stander(mesh: Mesh) -> Stander:
    shape = Stander.of(mesh)
    assert shape is not None
    return shape


@pytest.mark.parametrize(
    ("text", "direction", "name"),
    [
        ("x", (1, 0, 0), "x"),
        ("-y", (0, -1, 0), "-y"),
        ("+z", (0, 0, 1), "z"),
        ("0,0,-2", (0, 0, -1), "-z"),
        ("0, 3, 4", (0, 0.6, 0.8), "0,0.6,0.8"),
    ],
)
def test_a_stated_direction(text, direction, name) -> None:
    up = read_up(text)
    assert up is not None
    np.testing.assert_allclose(up.direction, direction)
    assert (up.name, up.probability) == (name, None)


def test_auto_and_infer_state_no_direction() -> None:
    assert read_up("auto") is None
    assert read_up("infer") is None
    with pytest.raises(OptionError, match=r"found '1,2'; valid are auto, infer, x, .*-z, or a direction such as"):
        read_up("1,2")


def test_the_rotation_to_the_asset_is_that_of_the_nearest_axis_and_then_the_smallest() -> None:
    rng = np.random.default_rng(0)
    for direction in rng.normal(size=(50, 3)):
        direction /= np.linalg.norm(direction)
        R = up_of(direction).to_z
        np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(R) == pytest.approx(1)
        np.testing.assert_allclose(R @ direction, Z, atol=1e-12)
        axis = np.eye(3)[np.abs(direction).argmax()] * np.sign(direction[np.abs(direction).argmax()])
        more = R @ up_of(axis).to_z.T  # its angle is the one between the direction and the axis
        assert (np.trace(more) - 1) / 2 == pytest.approx(direction @ axis)


def test_features_of_a_pyramid_on_its_base_and_on_its_tip() -> None:
    upright, on_its_tip = up_features(stander(pyramid()), np.array([Z, -Z]))
    assert upright["bottom share"] == pytest.approx(1)
    assert upright["bottom margin"] == pytest.approx(0.5, abs=0.02)  # half a side of the base, over the side
    assert upright["top share"] == 0
    assert upright["height over length"] == pytest.approx(0)
    assert upright["hull below"] == pytest.approx(4 / (4 + 4 * np.sqrt(5)))
    assert upright["height of the center"] == pytest.approx((2 / 3 * 4 * np.sqrt(5)) / (4 + 4 * np.sqrt(5)) / 2, abs=0.01)
    assert on_its_tip["bottom share"] == 0
    assert on_its_tip["bottom margin"] == -1
    assert on_its_tip["height of the center"] == pytest.approx(1 - upright["height of the center"])
    assert on_its_tip["upside down"] == pytest.approx(upright["upside down"])
    assert upright["mirrored"] < 0.02 < upright["upside down"]


def test_features_of_a_table() -> None:
    (f,) = up_features(stander(table()), Z[None])
    assert f["bottom share"] == pytest.approx(1)  # the legs' outline
    assert f["top level"] > 5 * f["bottom level"]
    assert f["faces up"] == pytest.approx(f["faces down"], abs=0.05)
    assert f["height over length"] == pytest.approx(np.log2(0.74 / 1.2))
    assert f["height over width"] == pytest.approx(np.log2(0.74 / 0.8))
    assert f["center off the outline's middle"] < 0.01


@pytest.mark.parametrize("degrees", [0, 37, 90, 180])
def test_features_do_not_depend_on_position_rotation_and_size(degrees) -> None:
    R = turn((1, 2, 3), degrees)
    (before,) = up_features(stander(table()), Z[None])
    (after,) = up_features(stander(moved(table(), R, 0.01)), (R[:3, :3] @ Z)[None])
    assert list(before) == list(after)
    np.testing.assert_allclose(list(after.values()), list(before.values()), atol=1e-6)


@pytest.mark.parametrize("degrees", [0, 20, 45, 90, 133])
def test_candidates_contain_the_true_direction_once(degrees) -> None:
    R = turn((1, 1, 0), degrees)
    candidates = up_candidates(stander(moved(table(), R)))
    np.testing.assert_allclose(np.linalg.norm(candidates, axis=1), 1)
    assert (candidates @ R[:3, :3] @ Z > np.cos(np.deg2rad(2))).sum() == 1
    assert len(distinct(candidates)) == len(candidates)


@pytest.mark.parametrize("degrees", [0, 20, 45, 90, 180])
def test_a_table_in_any_rotation_is_stood_up(degrees) -> None:
    R = turn((1, 2, 0), degrees)
    up = infer_up(moved(table(), R), None)
    np.testing.assert_allclose(up.direction, R[:3, :3] @ Z, atol=1e-6)
    assert 0.3 < up.probability <= 1
    source = LoadedMesh(moved(table(), R), "table.glb", "0" * 64, "y", 1.0, ())  # the format defines y, the mesh lies
    placed = place_mesh(source, up="infer")
    np.testing.assert_allclose(placed.mesh.extents[2], 0.74, atol=1e-6)
    assert placed.mesh.vertices[:, 2].min() == pytest.approx(0, abs=1e-9)
    assert placed.notes[0].startswith(f"up axis {placed.up} (inferred from how the object can stand, probability 0.")
    assert place_mesh(source).up == "y"


def test_a_tilted_direction_can_be_given() -> None:
    R = turn((1, 0, 0), 30)
    source = LoadedMesh(moved(table(), R), "table.stl", "0" * 64, None, 1.0, ())
    x, y, z = R[:3, :3] @ Z
    placed = place_mesh(source, up=f"{x},{y},{z}")
    assert placed.up == "0,-0.5,0.866"
    np.testing.assert_allclose(placed.mesh.extents, [1.2, 0.8, 0.74])
    again = source.mesh.triangles @ placed.T_asset_source[:3, :3].T + placed.T_asset_source[:3, 3]
    np.testing.assert_allclose(again, placed.mesh.triangles, atol=1e-12)


def test_the_usual_axis_of_a_format_counts_more_than_a_tilted_pose() -> None:
    cube = mesh_of([box((0, 0, 0), (1, 1, 1))])[0]
    for usual in "yz":
        assert infer_up(cube, usual).name == usual
    assert infer_up(moved(table(), turn((1, 0, 0), 90)), "z").name == "-y"  # shapes that stand in one way only


def test_a_flat_mesh_has_the_usual_axis_up() -> None:
    flat, _ = mesh_of([(np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]]))])
    assert Stander.of(flat) is None
    assert infer_up(flat, "y").name == "y"
    assert infer_up(flat, None).name == "z"
    note, _ = place_mesh(LoadedMesh(flat, "a.stl", "0" * 64, None, 1.0, ())).notes
    assert note == "up axis z (usual for the format; the mesh is flat)"
    point, _ = mesh_of([(np.zeros((3, 3)), np.array([[0, 1, 2]]))])
    assert infer_up(point, "y").name == "y"


def test_a_dense_ring_keeps_its_stand() -> None:
    angle = np.arange(30_000) / 30_000 * 2 * np.pi
    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)
    k = np.arange(30_000)
    low, high, after = k, k + 30_000, (k + 1) % 30_000
    sides = np.concatenate([np.stack([low, after, high], 1), np.stack([after, after + 30_000, high], 1)])
    caps = np.concatenate([np.stack([after, low, 0 * k + 60_000], 1), np.stack([high, after + 30_000, 0 * k + 60_001], 1)])
    corners = np.concatenate([ring, 0.6 * ring + Z, [[0, 0, 0], Z]])
    up = infer_up(mesh_of([(corners, np.concatenate([sides, caps]))])[0], "z")
    assert up.name == "z"


def test_most_examples_are_stood_up_and_none_was_trained_on(tmp_path) -> None:
    data = open_dataset("examples")
    assert not [name for name in up_classifier().manifest["objects"] if name.startswith("example")]
    samples = [changed("spun", prepared(data.truth(name, tmp_path))) for name in data.objects()]
    right = [infer_up(sample.mesh, None).direction @ sample.up > np.cos(np.deg2rad(5)) for sample in samples]
    assert np.mean(right) >= 0.6
    upright = [prepared(data.truth(name, tmp_path)).mesh for name in data.objects()]
    assert [infer_up(mesh, "z").name for mesh in upright] == ["z"] * len(upright)
