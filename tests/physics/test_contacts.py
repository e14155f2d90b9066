"""Test contacts of collision shapes at given poses, on boxes."""

from __future__ import annotations

import numpy as np
import pytest
from assets import box, mesh_of, source
from scipy.spatial.transform import Rotation
from test_shapes import collision_of
from trimesh.boolean import union
from trimesh.creation import box as solid_box

from anymesh.physics.clear import LinkSurface, cross, placed_bounds
from anymesh.physics.collision import CollisionConfig
from anymesh.physics.contacts_ import ContactBench
from anymesh.physics.convex import hull_of
from anymesh.physics.split import concave_planes
from anymesh.types import Asset, Box, Cylinder, Part, Segmentation


def cube(x: float) -> Box:
    return Box(np.array([x, 0.0, 0.0]), np.eye(3), np.ones(3))


def test_a_pair_of_shapes_has_one_contact_with_the_depth_of_the_overlap() -> None:
    bench = ContactBench({"a": [cube(0), cube(5)], "b": [cube(0.9), cube(5.8)]})
    poses = {"a": np.eye(4), "b": np.eye(4)}
    found = bench.contacts(poses, 0.01)
    assert [(c.first, c.second) for c in found] == [(("a", 0), ("b", 0)), (("a", 1), ("b", 1))]
    assert [c.depth for c in found] == pytest.approx([0.1, 0.2], abs=1e-6)
    for contact, middle in zip(found, (0.45, 5.4), strict=True):
        np.testing.assert_allclose(contact.normal, (1, 0, 0), atol=1e-9)
        assert contact.point[0] == pytest.approx(middle, abs=1e-6)
    assert [c.depth for c in bench.contacts(poses, 0.15)] == pytest.approx([0.2], abs=1e-6)
    away = np.eye(4)
    away[0, 3] = 0.15
    assert [c.second for c in bench.contacts({**poses, "b": away}, 0.01)] == [("b", 1)]


def test_links_that_are_excluded_do_not_touch() -> None:
    bench = ContactBench({"a": [cube(0)], "b": [cube(0.9)]}, [("a", "b")])
    assert bench.contacts({"a": np.eye(4), "b": np.eye(4)}, 0.0) == []


def test_planes_are_ordered_by_the_length_of_their_concave_edges() -> None:
    """Two bars on a slab, 3 x 0.5 and 1 x 0.4: the top of the slab meets all their sides."""
    pieces = [((4, 4, 1), (0, 0, 0.5)), ((3, 0.5, 1), (0, 1, 1.4)), ((1, 0.4, 1), (0, -1, 1.4))]
    solids = []
    for size, middle in pieces:
        solids.append(solid_box(size))
        solids[-1].apply_translation(middle)
    found = concave_planes(np.asarray(union(solids).triangles, float), 20)
    signed = [(tuple(np.round(np.abs(n), 6).tolist()), round(abs(o), 6)) for n, o in found]
    assert signed[0] == ((0, 0, 1), 1)  # 2 * (3 + 0.5) + 2 * (1 + 0.4)
    assert sorted(signed[1:3]) == [((0, 1, 0), 0.75), ((0, 1, 0), 1.25)]  # 3 each
    assert sorted(signed[3:5]) == [((0, 1, 0), 0.8), ((0, 1, 0), 1.2)]  # 1 each
    assert signed[5:7] == [((1, 0, 0), 1.5)] * 2  # 0.5 each
    assert signed[7:] == [((1, 0, 0), 0.5)] * 2  # 0.4 each


@pytest.mark.parametrize(("share", "count"), [(0.2, 1), (0.4, 2)])
def test_components_below_a_share_of_the_gap_get_no_shape(share: float, count: int) -> None:
    """The diagonal of the small cube, in units of the first gap of about 0.02 of the object's diagonal."""
    gap = CollisionConfig().gaps[0] * np.sqrt(3)
    side = share * gap / np.sqrt(3)
    mesh, part = mesh_of([box((0, 0, 0), (1, 1, 1)), box((0, 0, 1 + 1e-6), (side, side, 1 + 1e-6 + side))])
    asset = Asset("block", source(), mesh, Segmentation(0 * part, (Part("base", "base"),)), (), "")
    assert len(collision_of(asset).shapes["base"]) == count


X, Y, Z = np.eye(3)
SHEET = np.array([[[-2.0, -2, 0], [2, -2, 0], [2, 2, 0]], [[-2.0, -2, 0], [2, 2, 0], [-2, 2, 0]]])


def edge(*ends) -> tuple[np.ndarray, np.ndarray]:
    start, end = np.asarray(ends, float)[:, None]
    return start, end


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize(("depth", "found"), [(0.09, True), (0.11, False), (0.5, False)])
def test_an_edge_crosses_a_sheet_by_the_shorter_of_its_ends(depth: float, found: bool, turned: bool) -> None:
    ends = [(0.3, 0.1, -0.1), (0.3, 0.1, 0.4)]
    start, end = edge(*(ends[::-1] if turned else ends))
    assert LinkSurface(SHEET).crossed_by(start, end, depth) == found
    slanted = np.array([1.0, 0, 0]) * [[0], [5 / 4]]  # at an angle, equally deep
    assert LinkSurface(SHEET).crossed_by(start + slanted[:1] * turned, end + slanted[1:], depth) == found


def test_an_edge_that_ends_before_or_at_a_sheet_does_not_cross_it() -> None:
    sheet = LinkSurface(SHEET)
    assert not sheet.crossed_by(*edge((0.3, 0.1, 1), (0.3, 0.1, 0.01)), 0.0)
    assert not sheet.crossed_by(*edge((3, 0.1, 1), (3, 0.1, -1)), 0.0)
    assert not sheet.crossed_by(*edge((0.3, 0.1, 0.1), (1.3, 0.1, 0.1)), 0.0)
    assert not sheet.crossed_by(np.zeros((0, 3)), np.zeros((0, 3)), 0.0)
    start, end = (np.concatenate(p) for p in zip(edge((3, 0, 1), (3, 0, -1)), edge((0.3, 0.1, 1), (0.3, 0.1, -1)), strict=True))
    assert sheet.crossed_by(start, end, 0.5)


@pytest.mark.parametrize("turned", [False, True])
def test_of_two_sheets_the_deeper_one_counts_from_either_end(turned: bool) -> None:
    """A centimetre through one and half a metre through the other."""
    sheets = LinkSurface(np.concatenate([SHEET, SHEET + Z]))
    ends = [(0.3, 0.1, -0.01), (0.3, 0.1, 1.5)]
    start, end = edge(*(ends[::-1] if turned else ends))
    assert sheets.crossed_by(start, end, 0.4)
    assert not sheets.crossed_by(start, end, 0.6)


@pytest.mark.parametrize("axis", range(3))
def test_edges_near_a_box_come_within_its_bounds(axis: int) -> None:
    v, f = box((0, 0, 0), (1, 1, 1))
    surface = LinkSurface(v[f])
    low, high = np.full(3, -1.0), np.full(3, 2.0)
    assert len(surface.edges_near(np.stack([low, high]))[0]) == 18
    low[axis] = 0.5  # without the side at 0, of four edges and a diagonal
    start, end = surface.edges_near(np.stack([low, high]))
    assert len(start) == len(end) == 13
    assert np.maximum(start, end)[:, axis].min() == 1
    low[axis], high[axis] = -1.0, 0.5
    start, end = surface.edges_near(np.stack([low, high]))
    assert len(start) == 13
    assert np.minimum(start, end)[:, axis].max() == 0
    high[axis] = 0.0
    assert len(surface.edges_near(np.stack([low, high]))[0]) == 13
    high[axis] = -0.1
    assert len(surface.edges_near(np.stack([low, high]))[0]) == 0


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(("overlap", "found"), [(0.11, True), (0.09, False)])
def test_surfaces_in_turned_frames_cross_by_the_same_depth(seed: int, overlap: float, found: bool) -> None:
    v, f = box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))
    w, g = box((-0.1, 0.2, 0.5 - overlap), (0.1, 0.4, 2))  # beside the diagonals of the top
    frames = []
    for k in (2 * seed, 2 * seed + 1):
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = Rotation.random(random_state=k).as_matrix(), np.random.default_rng(k).uniform(-3, 3, 3)
        frames.append(T)
    surfaces = [LinkSurface((p @ T[:3, :3].T + T[:3, 3])[h]) for p, h, T in zip((v, w), (f, g), frames, strict=True)]
    back = [np.linalg.inv(T) for T in frames]
    assert cross(surfaces[0], back[0], surfaces[1], back[1], 0.1) == found
    assert cross(surfaces[1], back[1], surfaces[0], back[0], 0.1) == found
    low, high = placed_bounds(surfaces[1], back[1])
    assert (low <= w.min(0) + 1e-9).all()
    assert (high >= w.max(0) - 1e-9).all()


def placed(x: float, turn=(0, 0, 0)) -> np.ndarray:
    T = np.eye(4)
    T[:3, :3], T[0, 3] = Rotation.from_rotvec(np.deg2rad(turn)).as_matrix(), x
    return T


CUBE = Box(np.zeros(3), np.eye(3), np.ones(3))


@pytest.mark.parametrize("turn", [(0, 0, 45), (0, 45, 0)])
def test_a_cube_on_its_edge_reaches_half_a_diagonal(turn) -> None:
    bench = ContactBench({"a": [CUBE], "b": [CUBE]})
    still = placed(0)
    (found,) = bench.contacts({"a": still, "b": placed(1.15, turn)}, 0.01)
    assert found.depth == pytest.approx(0.5 + np.sqrt(0.5) - 1.15, abs=1e-5)
    assert found.normal == pytest.approx(X, abs=1e-5)
    assert bench.contacts({"a": still, "b": placed(1.15)}, 0.01) == []
    (found,) = bench.contacts({"a": still, "b": placed(-0.9)}, 0.01)
    assert (found.depth, found.normal[0]) == (pytest.approx(0.1, abs=1e-6), pytest.approx(-1))
    (turned,) = ContactBench({"a": [CUBE], "b": [Box(np.zeros(3), placed(0, turn)[:3, :3], np.ones(3))]}).contacts(
        {"a": still, "b": placed(1.15)}, 0.01
    )
    assert turned.depth == pytest.approx(0.5 + np.sqrt(0.5) - 1.15, abs=1e-5)


def test_the_deepest_of_several_points_of_contact_counts() -> None:
    """A plate leans by 3 degrees, so that one of its sides is deeper in the cube than the other."""
    lean = np.deg2rad(3)
    low = Box(np.zeros(3), np.eye(3), np.array([4.0, 4, 1]))
    T = placed(0, (0, 3, 0))
    T[2, 3] = 0.5 + 0.5 * np.cos(lean) + 0.5 * np.sin(lean) - 0.06
    (found,) = ContactBench({"low": [low], "cube": [CUBE]}).contacts({"low": placed(0), "cube": T}, 0.01)
    assert found.depth == pytest.approx(0.06, abs=2e-3)
    assert found.normal @ Z == pytest.approx(1, abs=2e-3)


@pytest.mark.parametrize("turn", [(0, 0, 0), (0, 90, 0)])
def test_cylinders_have_their_length_and_hulls_their_corners(turn) -> None:
    rod = Cylinder(np.zeros(3), placed(0, turn)[:3, :3], 0.25, 2.0)
    reach = 1.0 if turn[1] else 0.25
    (found,) = ContactBench({"a": [CUBE], "b": [rod]}).contacts({"a": placed(0), "b": placed(0.45 + reach)}, 0.01)
    assert found.depth == pytest.approx(0.05, abs=1e-4)
    tip = hull_of(np.array([[0.0, 0, 0], [1, 0.2, 0.2], [1, -0.2, 0.2], [1, 0, -0.2]]))
    assert tip is not None
    (found,) = ContactBench({"a": [CUBE], "b": [tip]}).contacts({"a": placed(0), "b": placed(0.4)}, 0.01)
    assert found.depth == pytest.approx(0.1, abs=1e-3)
    assert (found.first, found.second) == (("a", 0), ("b", 0))
