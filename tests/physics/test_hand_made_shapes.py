"""Test hulls, cuts, planes and crossings of triangles and boxes whose results are worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from assets import solid
from trimesh import Trimesh
from trimesh.boolean import union
from trimesh.creation import cylinder, icosphere

from anymesh.geometry.surface import plain_triangles
from anymesh.physics.clear import LinkSurface, placed_bounds
from anymesh.physics.contacts_ import ContactBench
from anymesh.physics.convex import (
    MAX_CORNERS,
    as_hull,
    cut,
    engine_shape,
    fitted,
    hull_of,
    planes,
    shifted,
    thinned,
    trimmed,
    volume,
)
from anymesh.physics.decompose import (
    Resolution,
    cleaned,
    component_shapes,
    load_shapes,
    save_shapes,
    smallest_box,
    split_components,
)
from anymesh.physics.split import concave_planes, patch_of, split_surface
from anymesh.types import Box, Cylinder, Hull

X, Y, Z = np.eye(3)
SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])


def hull(points) -> Hull:
    found = hull_of(np.asarray(points, float))
    assert found is not None
    return found


def shift(x: float, y: float = 0.0, z: float = 0.0) -> np.ndarray:
    T = np.eye(4)
    T[:3, 3] = x, y, z
    return T


def test_points_on_a_line_and_flat_ones_without_a_thickness_have_no_hull() -> None:
    for points in (SQUARE[:2], np.arange(5.0)[:, None] * X, np.zeros((4, 3)), SQUARE):
        assert hull_of(points) is None
    assert hull_of(SQUARE[:3]) is None
    assert hull_of(SQUARE[:3], 0.1) is not None


@pytest.mark.parametrize(("inward", "low", "high"), [(None, -0.05, 0.05), (Z, 0.0, 0.1), (-Z, -0.1, 0.0)])
def test_a_flat_hull_is_as_thick_as_told_on_the_told_side(inward, low: float, high: float) -> None:
    found = hull_of(SQUARE, 0.1, inward)
    assert found is not None
    assert (found.vertices[:, 2].min(), found.vertices[:, 2].max()) == pytest.approx((low, high))
    assert volume(found) == pytest.approx(0.1)


@pytest.mark.parametrize(("height", "flat"), [(1e-4, True), (3e-4, False)])
def test_a_hull_is_flat_below_a_ten_thousandth_of_its_diagonal(height: float, flat: bool) -> None:
    thin = hull_of(np.concatenate([SQUARE, SQUARE + height * Z]), 0.1)
    assert thin is not None
    assert volume(thin) == pytest.approx(0.1 if flat else height)


def test_a_hull_keeps_up_to_64_corners() -> None:
    few, many = (np.asarray(cylinder(1.0, 1.0, sections=n).vertices) for n in (32, 60))
    assert thinned(hull(few)).vertices.shape == (64, 3)
    small = hull(few)
    assert thinned(small) is small
    ball = thinned(hull(np.asarray(icosphere(4).vertices)))
    assert len(ball.vertices) <= MAX_CORNERS
    assert volume(ball) > 0.85 * 4 / 3 * np.pi
    assert len(thinned(hull(many)).vertices) <= MAX_CORNERS


def test_the_planes_of_a_box_are_its_sides() -> None:
    found = planes(hull(solid((1, 2, 3), (2, 4, 6)).reshape(-1, 3)))
    rows = {tuple(np.round(row, 6) + 0.0) for row in found}
    assert rows == {(1, 0, 0, -2), (-1, 0, 0, 1), (0, 1, 0, -4), (0, -1, 0, 2), (0, 0, 1, -6), (0, 0, -1, 3)}


def area(triangles: np.ndarray) -> float:
    return float(
        np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1).sum() / 2
    )


@pytest.mark.parametrize(("offset", "below"), [(-0.1, 0.0), (0.0, 0.0), (0.5, 0.375), (1.0, 0.5), (2.0, 0.5)])
def test_a_plane_divides_a_triangle_by_area(offset: float, below: float) -> None:
    """The triangle has legs of 1 m; the plane is x = offset."""
    parts = cut(SQUARE[None, [0, 1, 3]], X, offset)
    assert [area(p) for p in parts] == pytest.approx([below, 0.5 - below])
    whole = hull(solid((0, 0, 0), (1, 1, 1)).reshape(-1, 3))
    left = trimmed(whole, X, offset)
    assert (0.0 if left is None else volume(left)) == pytest.approx(np.clip(offset, 0, 1), abs=1e-9)


def test_distinct_planes_at_concave_edges_are_limited() -> None:
    slab, bars = solid((0, 0, 0), (10, 4, 1)), [solid((k, 1, 1), (k + 0.5, 3, 2)) for k in range(1, 9)]
    whole = union([Trimesh(*(t.reshape(-1, 3), np.arange(36).reshape(-1, 3))).process() for t in (slab, *bars)])
    triangles = np.asarray(whole.triangles, float)
    assert len(concave_planes(triangles, 100)) == 1 + 2 + 16
    assert len(concave_planes(triangles, 5)) == 6
    assert concave_planes(slab, 5) == []


def test_the_bounds_of_a_turned_surface_are_those_of_its_box() -> None:
    T = shift(1, 0, 0)
    T[:3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    found = placed_bounds(LinkSurface(solid((0, 0, 0), (1, 2, 3))), T)
    assert found == pytest.approx(np.array([[-1, 0, 0], [1, 1, 3]]))


def test_cleaning_removes_slivers_and_duplicates() -> None:
    cube = solid((0, 0, 0), (1, 1, 1))
    sliver = np.array([[[0, 0, 0], [1, 0, 0], [0.5, 1e-10, 0]]])
    assert len(cleaned(np.concatenate([cube, cube[:3], sliver, cube[:1, ::-1]]))) == 12
    assert cleaned(cube + 7) == pytest.approx(cube + 7, abs=2e-6)


def test_an_open_l_is_two_plates_and_a_sheet_is_one() -> None:
    sheet = SQUARE[[[0, 1, 2], [0, 2, 3]]]
    upright = sheet[:, :, [2, 1, 0]]
    hulls = split_surface(np.concatenate([sheet, upright]), gap=0.05, wall=0.01, max_pieces=8)
    assert len(hulls) == 2
    assert sum(volume(h) for h in hulls) == pytest.approx(0.02, rel=0.1)
    assert len(split_surface(np.concatenate([sheet, upright]), gap=0.05, wall=0.01, max_pieces=1)) == 1
    assert len(split_surface(sheet, gap=0.001, wall=0.01, max_pieces=8)) == 1
    assert split_surface(np.zeros((0, 3, 3)), gap=0.1, wall=0.01, max_pieces=8) == []
    flat = patch_of(sheet, 0.01)
    assert flat is not None
    assert flat.gap == pytest.approx(0.01, abs=1e-6)
    assert flat.hull.vertices[:, 2].max() == pytest.approx(0)  # behind the side that it faces


def chamfered(side: float) -> Hull:
    """Return a unit cube without a prism at one edge, of a volume of side^2 / 2."""
    corners = np.array([[0.0, 0], [1, 0], [1, 1 - side], [1 - side, 1], [0, 1]])
    return hull(np.concatenate([np.c_[corners, np.full(5, z)] for z in (0, 1)]))


@pytest.mark.parametrize(("side", "kind"), [(0.15, Box), (0.25, Hull)])
def test_a_box_replaces_a_hull_of_nearly_its_volume(side: float, kind: type) -> None:
    """The chamfers take 1.1 and 3.1 % of the cube."""
    assert isinstance(fitted(chamfered(side)), kind)


def test_primitives_have_the_volume_of_their_hulls_and_may_be_shifted() -> None:
    brick, rod = Box(X, np.eye(3), np.array([1.0, 2, 3])), Cylinder(Y, np.eye(3), 0.5, 2.0)
    assert volume(as_hull(brick)) == pytest.approx(6)
    assert volume(as_hull(rod)) == pytest.approx(0.25 * 2 * 16 * np.sin(2 * np.pi / 32))  # of a prism of 32 sides
    assert as_hull(rod).vertices.mean(0) == pytest.approx(Y)
    for shape in (brick, rod, chamfered(0.3)):
        assert as_hull(shifted(shape, 2 * Z)).vertices == pytest.approx(as_hull(shape).vertices + 2 * Z)


def test_shapes_of_all_kinds_touch_each_other() -> None:
    brick, rod = Box(np.zeros(3), np.eye(3), np.ones(3)), Cylinder(0.9 * X, np.eye(3), 0.5, 1.0)
    bench = ContactBench({"a": [brick], "b": [rod], "c": [shifted(chamfered(0.5), np.array([-1.4, -0.5, -0.5]))]})
    found = bench.contacts(dict.fromkeys("abc", np.eye(4)), 0.01)
    assert {"".join(sorted(c.first[0] + c.second[0])): round(c.depth, 2) for c in found} == {"ab": 0.1, "ac": 0.1}


def test_shapes_are_stored_in_a_folder_that_is_made(tmp_path) -> None:
    folder = tmp_path / "some" / "where"
    save_shapes(folder, "k", (chamfered(0.3),))
    save_shapes(folder, "k", (chamfered(0.3),))
    assert load_shapes(folder, "k") is not None
    assert [p.name for p in folder.iterdir()] == ["k.npz"]
    save_shapes(None, "k", ())
    assert load_shapes(None, "k") is None


def test_a_hull_too_small_for_engines_becomes_its_box() -> None:
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    assert isinstance(engine_shape(hull(1e-2 * corners)), Hull)
    tiny = engine_shape(hull(1e-5 * corners))
    assert isinstance(tiny, Box)
    assert np.allclose(as_hull(tiny).vertices.min(0), 0, atol=1e-5)
    assert tiny.size.prod() >= 1e-15 / 6


@pytest.mark.parametrize("change", ["twice", "two sides", "wound at random", "cracked"])
def test_a_concave_solid_is_divided_alike_however_careless_its_faces_are(change: str) -> None:
    rng = np.random.default_rng(0)
    solid = np.asarray(trimesh.creation.torus(1, 0.3, major_sections=8, minor_sections=6).triangles, float)
    triangles = {
        "twice": np.concatenate([solid, solid]),
        "two sides": np.concatenate([solid, solid[:, ::-1]]),
        "wound at random": np.where(rng.random(len(solid))[:, None, None] < 0.5, solid[:, ::-1], solid),
        "cracked": solid + rng.uniform(-1e-5, 1e-5, solid.shape),
    }[change]
    resolution = Resolution(gap=0.05, wall=0.01, max_pieces=16)
    (plain,), (component,) = (split_components(plain_triangles(t, 2.6)[0], 0.0) for t in (solid, triangles))
    assert component.solid
    assert len(component.triangles) == len(solid)
    assert len(component_shapes(component, resolution)) == len(component_shapes(plain, resolution)) > 4


def test_the_smallest_box_is_around_the_link_and_as_thick_as_a_wall() -> None:
    point = as_hull(smallest_box(np.full((1, 3, 3), 5.0), 0.002)).vertices
    assert point.min(0) == pytest.approx([4.999] * 3)
    assert point.max(0) == pytest.approx([5.001] * 3)
    line = as_hull(smallest_box(np.array([[[0.0, 0, 0], [2, 0, 0], [1, 0, 0]]]), 0.5)).vertices
    assert np.stack([line.min(0), line.max(0)]) == pytest.approx(np.array([[0, -0.25, -0.25], [2, 0.25, 0.25]]))
