"""Test sampled poses of few joints, shapes of whole assets at several sizes, and the cache of shapes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from assets import box, cabinet, joint, mesh_of, source
from test_decomposer import FakePool, bracket
from test_poses import origins_of, row

from anymesh import physics
from anymesh.export.links import split_links
from anymesh.geometry.kinematics import joint_transform
from anymesh.physics.collision import CollisionConfig, collision_shapes, joint_poses, sampled_poses
from anymesh.physics.convex import as_hull
from anymesh.physics.decompose import content_key, load_shapes, save_shapes
from anymesh.types import Asset, Box, Cylinder, Hull, Part, Segmentation

SHEET = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), np.array([[0, 1, 2], [0, 2, 3]])


@pytest.mark.parametrize(("most", "blocks", "poses"), [(5, 3, 2 + 3 * 2), (5, 1, 2 + 4), (2000, 0, 2), (7, 2, 2 + 2 * 2)])
def test_positions_are_shared_among_the_joints_down_to_three_each(most: int, blocks: int, poses: int, monkeypatch) -> None:
    """The rest pose and all joints open are two more; the position 0 of each range is the rest pose."""
    monkeypatch.setattr(physics.collision, "MAX_POSES", most)
    asset = row(blocks)
    assert len(sampled_poses(asset, origins_of(asset), 17)) == poses


def test_fewer_than_three_positions_may_be_asked_for() -> None:
    asset = row(3)
    assert len(sampled_poses(asset, origins_of(asset), 2)) == 2 + 3


def test_one_joint_is_placed_over_its_range_or_a_whole_turn() -> None:
    asset = cabinet()
    origins = origins_of(asset)
    for j in asset.joints:
        low, high = j.limits or (-np.pi, np.pi)
        rest, *placed = joint_poses(asset, origins, j, 4)
        expected = [v for v in np.linspace(low, high, 4) if v != 0]
        assert len(placed) == len(expected)
        for pose, v in zip(placed, expected, strict=True):
            assert pose[j.child] == pytest.approx(joint_transform(j, v) @ rest[j.child])
        still = asset.segmentation.parts[0].name
        assert rest[still][:3, 3] == pytest.approx(origins[still])
        assert all(pose[still] is rest[still] for pose in placed)


def asset_of(*pieces, joints=()) -> Asset:
    mesh, part = mesh_of(pieces)
    parts = tuple(Part(f"part_{k}", "part") for k in range(len(pieces)))
    return Asset("thing", source(), mesh, Segmentation(part, parts), tuple(joints), "")


def made(asset: Asset, **changes):
    links = split_links(asset)
    where = {k.name: k.triangles for k in links}, {k.name: k.origin for k in links}
    return collision_shapes(asset, *where, replace(CollisionConfig(), **changes), pool=FakePool())


@pytest.mark.parametrize(("size", "thickness"), [(0.5, 0.001 * np.sqrt(2)), (50.0, 0.005)])
def test_an_open_sheet_is_as_thick_as_a_wall_of_two_thousandths_up_to_five_millimetres(size: float, thickness: float) -> None:
    (shape,) = made(asset_of((SHEET[0] * size, SHEET[1]))).shapes["part_0"]
    assert isinstance(shape, Box)
    assert np.sort(shape.size) == pytest.approx([thickness, size, size])


@pytest.mark.parametrize("scale", [0.1, 10.0])
def test_a_component_has_the_pieces_of_the_first_gap_unless_contacts_are_false(scale: float) -> None:
    """The middle of the hull's slope is 0.42 from the bracket, and the object's diagonal is 1.73."""
    corners = (scale * bracket().triangles).reshape(-1, 3)
    asset = asset_of((corners, np.arange(len(corners)).reshape(-1, 3)))
    counts = [len(made(asset, gaps=gaps).shapes["part_0"]) for gaps in ((0.4, 0.01), (0.01, 0.4))]
    assert counts == [1, 2]


@pytest.mark.parametrize("scale", [0.1, 10.0])
@pytest.mark.parametrize(("share", "overlap"), [(0.0027, False), (0.0033, True)])
def test_links_overlap_if_they_penetrate_by_three_thousandths_of_the_diagonal(
    scale: float, share: float, overlap: bool
) -> None:
    size = np.sqrt(1 + 1 + 4)
    upper = box((0.4, 0.05, 1 - share * size), (0.6, 0.3, 2))  # beside the diagonals of the top
    slide = joint("slide", "prismatic", "part_0", "part_1", (0, 0, 0), (0, 0, 1), (0.0, 0.1 * scale))
    pieces = [(v * scale, f) for v, f in (box((0, 0, 0), (1, 1, 1)), upper)]
    found = made(asset_of(*pieces, joints=[slide]))
    assert found.overlapping == ((("part_0", "part_1"),) if overlap else ())
    assert found.false_before == (0 if overlap else 1)
    assert found.tight == ()
    total = sum(float(np.ptp(as_hull(s).vertices[:, 2])) for some in found.shapes.values() for s in some)
    assert total == pytest.approx((2 + (share * size if overlap else 0)) * scale, abs=1e-3 * scale)


def test_a_link_without_surface_gets_the_smallest_box() -> None:
    point = np.full((3, 3), 0.5), np.array([[0, 1, 2]])
    slide = joint("slide", "prismatic", "part_0", "part_1", (0, 0, 0), (0, 0, 1), (0.0, 0.1))
    found = made(asset_of(box((0, 0, 0), (1, 1, 1)), point, joints=[slide]))
    (shape,) = found.shapes["part_1"]
    assert np.ptp(as_hull(shape).vertices, axis=0) == pytest.approx([0.002 * np.sqrt(3)] * 3)


def test_a_key_has_one_shape_which_is_replaced(tmp_path) -> None:
    brick, rod = Box(np.ones(3), np.eye(3), np.array([1, 2, 3.0])), Cylinder(np.zeros(3), np.eye(3), 0.5, 2.0)
    save_shapes(tmp_path / "a", "k", (rod, rod))
    save_shapes(tmp_path / "a", "k", (brick,))
    (found,) = load_shapes(tmp_path / "a", "k") or ()
    assert isinstance(found, Box)
    assert (found.size.tolist(), found.center.tolist()) == ([1, 2, 3], [1, 1, 1])
    save_shapes(tmp_path / "a", "many", (as_hull(brick), rod, brick))
    kinds = [type(s) for s in load_shapes(tmp_path / "a", "many") or ()]
    assert kinds == [Hull, Cylinder, Box]
    save_shapes(tmp_path / "a", "none", ())
    assert load_shapes(tmp_path / "a", "none") == ()


def test_a_folder_that_cannot_be_written_or_a_file_of_other_arrays_is_ignored(tmp_path) -> None:
    (tmp_path / "file").write_text("")
    save_shapes(tmp_path / "file", "k", ())
    assert load_shapes(tmp_path / "file", "k") is None
    with (tmp_path / "odd.npz").open("wb") as out:
        np.savez(out, arrays=np.array([1]), **{"0_0": np.zeros(3)})
    assert load_shapes(tmp_path, "odd") is None
    np.savez(tmp_path / "old.npz", other=np.zeros(3))
    assert load_shapes(tmp_path, "old") is None


@pytest.mark.parametrize("kept", [0, 100, -30])
def test_a_damaged_file_is_ignored(tmp_path, kept: int) -> None:
    save_shapes(tmp_path, "k", (Box(np.ones(3), np.eye(3), np.array([1, 2, 3.0])),))
    stored = tmp_path / "k.npz"
    stored.write_bytes(stored.read_bytes()[:kept])
    assert load_shapes(tmp_path, "k") is None


def test_objects_in_a_stored_file_are_refused(tmp_path) -> None:
    """numpy stores objects as pickles, which run code when they are loaded."""
    cylinder = {f"0_{n}": value for n, value in enumerate((np.zeros(3), np.eye(3), np.array(0.5), np.array(2.0)))}
    np.savez(tmp_path / "plain.npz", arrays=np.array([4]), **cylinder)
    np.savez(tmp_path / "pickled.npz", arrays=np.array([4], object), **cylinder)
    assert [type(s) for s in load_shapes(tmp_path, "plain") or ()] == [Cylinder]
    assert load_shapes(tmp_path, "pickled") is None


def test_keys_depend_on_every_value_and_its_order() -> None:
    a, b = np.arange(3.0), np.arange(4.0)
    keys = {content_key(a, 1), content_key(b, 1), content_key(a, 2), content_key(1, a), content_key(a), content_key(a, 1, 0.5)}
    assert len(keys) == 6
    assert content_key(a, 1) == content_key(a[::-1][::-1], 1.0)


def test_specks_that_no_engine_can_make_a_hull_of_become_boxes() -> None:
    """Triangles of ten nanometres a metre apart, as thick as walls: needles in double precision, lines in single."""
    specks = [1e-8 * np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]) + at for at in (-0.5, 0.5)]
    shapes = made(asset_of((np.concatenate(specks), np.array([[0, 1, 2], [3, 4, 5]])))).shapes["part_0"]
    assert all(isinstance(shape, Box) for shape in shapes)
