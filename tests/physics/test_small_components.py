"""Test which components of a link are kept, joined or cleaned, in which calls they are divided, and primitives."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from assets import solid
from scipy.spatial.transform import Rotation
from test_decomposer import FINE, FakePool, bracket
from trimesh.creation import cylinder

from anymesh.isolation import ChildError, Failure
from anymesh.physics.convex import MAX_CORNERS, as_hull, fitted, hull_of, shifted, volume
from anymesh.physics.decompose import (
    BATCH_FACES,
    Component,
    Decomposer,
    Method,
    Resolution,
    _at_origin,
    _batches,
    cleaned,
    component_shapes,
    split_components,
)
from anymesh.types import Box, Cylinder, Hull

X, Y, Z = np.eye(3)


def sizes(triangles, *args) -> list[int]:
    return [len(c.triangles) for c in split_components(np.concatenate(triangles), *args)]


def test_small_components_are_joined_in_the_cells_of_a_grid_of_four_along_each_side() -> None:
    """Single triangles on a grid of five; the last two of each row share a cell."""
    one = 1e-3 * np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]])
    grid = np.stack(np.meshgrid(*[np.arange(5.0)] * 3, indexing="ij"), -1).reshape(-1, 3) * [1, 2, 3]
    found = split_components(np.concatenate([one + p for p in grid]), 0.0, 0)
    assert sorted(len(c.triangles) for c in found) == [1] * 27 + [2] * 27 + [4] * 9 + [8]
    assert not any(c.solid for c in found)
    whole = [np.ptp(c.triangles.reshape(-1, 3), axis=0).max() for c in found]
    assert max(whole) <= 3.01


def test_components_are_kept_from_the_largest_to_the_smallest_of_the_size_asked_for() -> None:
    pieces = [solid((9 * k, 0, 0), (9 * k + s, s, s)) for k, s in enumerate((1.0, 3.0, 2.0))]
    for least, kept in ((0.0, [3, 2, 1]), (2 * np.sqrt(3) - 1e-9, [3, 2]), (2 * np.sqrt(3) + 1e-9, [3]), (99.0, [3])):
        found = split_components(np.concatenate(pieces), least)
        assert [round(float(np.ptp(c.triangles[:, :, 1])), 9) for c in found] == kept
    assert [c.solid for c in split_components(np.concatenate([pieces[0], pieces[1][1:]]), 0.0)] == [False, True]
    assert sizes(pieces, 0.0, 2) == [12, 12, 12]
    assert split_components(np.concatenate(pieces), 0.0, 2)[2].solid is False
    assert split_components(np.concatenate(pieces), 0.0, 3)[2].solid is True


def test_what_is_in_the_notch_of_a_concave_prism_is_kept() -> None:
    """All corners of the bracket lie on its hull."""
    assert sizes([bracket().triangles, solid((0.3, 0.4, 0.4), (0.6, 0.6, 0.6))], 0.0) == [20, 12]


def test_what_is_inside_a_convex_solid_is_left_out_but_not_what_crosses_it_or_is_in_an_open_one() -> None:
    outer, inner = solid((0, 0, 0), (4, 4, 4)), solid((1, 1, 1), (2, 2, 2))
    assert sizes([outer, inner, solid((9, 0, 0), (9.5, 1, 1))], 0.0) == [12, 12]
    assert sizes([outer[1:], inner], 0.0) == [11, 12]
    assert sizes([outer, solid((1, 1, 3.5), (2, 2, 4.5))], 0.0) == [12, 12]
    assert sizes([outer, solid((-0.5, 1, 1), (0.5, 2, 2))], 0.0) == [12, 12]
    slanted = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4)]
    pyramid = hull_of(np.array(slanted, float))
    assert pyramid is not None
    corner = solid((1.5, 1.5, 1.5), (2, 2, 2))  # within its bounds only
    assert sizes([pyramid.vertices[pyramid.faces], corner, solid((0.2, 0.2, 0.2), (0.6, 0.6, 0.6))], 0.0) == [4, 12]


@pytest.mark.parametrize("scale", [1e-4, 1.0, 1e3])
def test_what_is_in_a_dent_of_a_solid_is_kept(scale: float) -> None:
    outer = solid((0, 0, 0), (4, 4, 4))
    apex = np.array([2.0, 2, 1])  # of a dent in the top
    top = (outer[:, :, 2] == 4).all(1)
    rim = [(0, 0, 4), (4, 0, 4), (4, 4, 4), (0, 4, 4)]
    dent = np.array([(rim[k], rim[(k + 1) % 4], apex) for k in range(4)])
    small = solid((1.9, 1.9, 3), (2.1, 2.1, 3.2))
    assert sizes([scale * outer[~top], scale * dent, scale * small], 0.0) == [14, 12]
    assert sizes([scale * outer, scale * small], 0.0) == [12]


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_cleaning_snaps_corners_to_a_millionth_and_drops_slivers_below_a_billionth(scale: float) -> None:
    """Lengths are relative to the diagonal of 10 m, areas to its square."""
    big = np.array([[[0.0, 0, 0], [8, 0, 0], [8, 6, 0]]])
    near = big + np.array([[0, 0, 0], [0, 3e-6, 0], [0, -3e-6, 0]])  # within a third of a step
    thin, wide = (np.array([[[1.0, 1, 0], [2, 1, 0], [1, 1 + 2 * area, 0]]]) for area in (5e-8, 2e-4))
    found = cleaned(scale * np.concatenate([big, near, thin, wide, big[:, [1, 2, 0]]]))
    assert found / scale == pytest.approx(np.concatenate([big, wide]), abs=1.1e-5)
    apart = big + np.array([[0, 0, 0], [0, 3e-5, 0], [0, 0, 0]])  # three steps
    assert len(cleaned(scale * np.concatenate([big, apart]))) == 2


@pytest.mark.parametrize("method", Method)
def test_each_method_divides_a_bracket_and_an_open_one_is_cut_as_a_surface(method: Method) -> None:
    shapes = component_shapes(bracket(), Resolution(0.01, 0.04, 4), method)
    assert len(shapes) == 2 if method is not Method.SURFACE else len(shapes) > 1
    if method is not Method.SURFACE:
        assert sum(volume(as_hull(s)) for s in shapes) == pytest.approx(0.36, rel=1e-3)
    opened = Component(bracket().triangles[1:], False)
    one, other = (component_shapes(opened, Resolution(0.1, 0.04, 3), m) for m in (method, Method.SURFACE))
    assert [as_hull(s).vertices.tobytes() for s in one] == [as_hull(s).vertices.tobytes() for s in other]
    assert component_shapes(Component(np.zeros((1, 3, 3)), False), FINE, method) == ()


def test_few_calls_are_shared_out_one_by_one_and_more_in_batches_of_about_two_thousand_faces() -> None:
    assert _batches([12] * 64) == [range(k, k + 1) for k in range(64)]
    assert _batches([]) == []
    assert _batches([500] * 66)[:2] == [range(0, 3), range(3, 7)]
    sizes = np.random.default_rng(0).integers(1, 3000, 200).tolist()
    for many in (sizes, [12] * 300, [5000] * 70):
        found = _batches(many)
        assert [k for batch in found for k in batch] == list(range(len(many)))
        assert all(
            sum(many[k] for k in batch) < 2 * BATCH_FACES or len(batch) == 1 or max(many) > BATCH_FACES for batch in found
        )
    assert len(_batches([5000] * 70)) == 70
    assert len(_batches([12] * 300)) == 2


def test_a_batch_that_fails_is_divided_one_by_one() -> None:
    class Fragile(FakePool):
        def run(self, module: Any, function: Any, arguments: Any, *, seconds: float) -> Any:
            self.seconds.append(seconds)
            self.calls.append((arguments["method"], len(arguments["batch"])))
            if len(arguments["batch"]) > 1:
                raise ChildError(Failure.CRASH, "signal 11")
            return [(Box(np.zeros(3), np.eye(3), np.ptp(c.triangles, axis=(0, 1))),) for c, _ in arguments["batch"]]

    pool = Fragile()
    boxes = [Component(solid((0, 0, 0), (1, 2, 3 + k)), True) for k in range(70)]
    found = Decomposer(pool, None, 5.0).divide(boxes, [FINE] * 70)
    assert [d.fallback for d in found] == [None] * 70
    assert [float(d.shapes[0].size[2]) for d in found] == pytest.approx([3 + k for k in range(70)])
    assert [count for _, count in pool.calls] == [70] + [1] * 70
    assert pool.seconds[:2] == pytest.approx([5 + 2e-5 * 840, 5 + 2e-5 * 12])


def test_components_have_the_resolution_of_their_own_and_equal_ones_are_divided_once(tmp_path) -> None:
    coarse, pool = Resolution(0.5, 0.002, 24), FakePool()
    some, how = [bracket(), bracket(), bracket()], [FINE, coarse, FINE]
    for calls in (2, 2):  # the second time from the cache
        found = Decomposer(pool, tmp_path, 5.0).divide(some, how)
        assert [len(d.shapes) for d in found] == [2, 1, 2]
        assert len(pool.calls) == calls
    Decomposer(pool, tmp_path, 5.0).divide([bracket()] * 2, [Resolution(0.01, 0.003, 24), Resolution(0.01, 0.002, 25)])
    assert len(pool.calls) == 4
    assert Decomposer(pool, None, 5.0).divide([], []) == []
    with pytest.raises(ValueError):
        Decomposer(pool, None, 5.0).divide([bracket(), bracket()], [FINE])


@pytest.mark.parametrize("scale", [1e-4, 1.0, 300.0])
def test_copies_become_equal_at_the_origin_within_thirty_binary_digits(scale: float) -> None:
    shape = Component(scale * np.random.default_rng(0).random((20, 3, 3)), False)
    low = shape.triangles.reshape(-1, 3).min(0)
    found = _at_origin(shape, low)
    step = 2.0 ** (np.floor(np.log2((shape.triangles - low).max())) - 30)
    assert found.triangles / step == pytest.approx(np.round(found.triangles / step), abs=1e-12)
    assert np.abs(found.triangles - (shape.triangles - low)).max() <= step / 2
    assert not (np.round(found.triangles / step) % 2 == 0).all()
    assert found.solid is False
    point = _at_origin(Component(np.ones((1, 3, 3)), True), np.ones(3))
    assert (point.triangles.tolist(), point.solid) == (np.zeros((1, 3, 3)).tolist(), True)


@pytest.mark.parametrize("turn", [(0, 0, 0), (0.3, 0.5, -0.4)])
def test_a_prism_of_many_sides_becomes_a_cylinder_and_back(turn) -> None:
    R = Rotation.from_rotvec(turn).as_matrix()
    corners = np.asarray(cylinder(0.5, 3.0, sections=72).vertices) @ R.T + [1, 2, 3]
    whole = hull_of(corners)
    assert whole is not None
    found = fitted(whole)
    assert isinstance(found, Cylinder)
    assert (found.radius, found.length) == (pytest.approx(0.5, rel=1e-3), pytest.approx(3))
    assert found.center == pytest.approx([1, 2, 3], abs=1e-6)
    assert np.abs(found.rotation[:, 2] @ R[:, 2]) == pytest.approx(1)
    assert found.rotation.T @ found.rotation == pytest.approx(np.eye(3), abs=1e-9)
    back = (as_hull(found).vertices - found.center) @ found.rotation
    assert np.linalg.norm(back[:, :2], axis=1) == pytest.approx([found.radius] * 64)
    assert np.sort(back[:, 2]) == pytest.approx([-1.5] * 32 + [1.5] * 32)
    angle = np.sort(np.arctan2(back[:32, 1], back[:32, 0]) % (2 * np.pi)) if len(back) == 64 else None
    assert angle is not None
    assert volume(as_hull(found)) == pytest.approx(32 / 2 * np.sin(2 * np.pi / 32) * found.radius**2 * 3)


@pytest.mark.parametrize(("top", "round_"), [(0.5, True), (0.49, True), (0.46, False), (0.3, False)])
def test_a_cone_is_a_cylinder_if_its_radius_hardly_changes(top: float, round_: bool) -> None:
    """Volumes may differ by 4 % of the cone's; the outline is that of the larger end."""
    angle = np.arange(72) / 72 * 2 * np.pi
    ring = np.c_[np.cos(angle), np.sin(angle)]
    cone = hull_of(np.concatenate([np.c_[0.5 * ring, np.zeros(72)], np.c_[top * ring, np.ones(72)]]))
    assert cone is not None
    assert isinstance(fitted(cone), Cylinder) == round_
    if not round_:
        assert len(as_hull(fitted(cone)).vertices) <= MAX_CORNERS


@pytest.mark.parametrize(("bulge", "round_"), [(0.0, True), (0.015, True), (0.04, False)])
def test_a_cylinder_has_flat_ends(bulge: float, round_: bool) -> None:
    """Corners within a fiftieth of the height from the ends."""
    angle = np.arange(72) / 72 * 2 * np.pi
    ring = np.c_[np.cos(angle), np.sin(angle)]
    rings = [np.c_[ring, np.full(72, 0.5 - bulge)], np.c_[ring, np.full(72, -0.5)], np.c_[0.9 * ring, np.full(72, 0.5)]]
    barrel = hull_of(np.concatenate(rings))
    assert barrel is not None
    assert isinstance(fitted(barrel), Cylinder) == round_


def test_boxes_have_a_rotation_of_columns_and_hulls_with_faces_outwards() -> None:
    R = Rotation.from_rotvec([0.3, 0.5, -0.4]).as_matrix()
    brick = Box(np.array([1.0, 2, 3]), R, np.array([1.0, 2, 4]))
    corners = (as_hull(brick).vertices - brick.center) @ R
    assert np.abs(corners) == pytest.approx(np.tile([0.5, 1, 2], (8, 1)))
    for shape in (brick, Cylinder(np.ones(3), R, 0.5, 2.0)):
        hull = as_hull(shape)
        t = hull.vertices[hull.faces]
        normal = np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])
        assert (((t.mean(1) - shape.center) * normal).sum(1) > 0).all()
    found = fitted(as_hull(brick))
    assert isinstance(found, Box)
    assert found.center == pytest.approx(brick.center)
    assert found.size == pytest.approx([4, 2, 1])
    assert np.abs(R.T @ found.rotation) == pytest.approx(np.eye(3)[[2, 1, 0]], abs=1e-6)
    moved = shifted(as_hull(brick), Z)
    assert isinstance(moved, Hull)
    assert moved.vertices.mean(0) == pytest.approx([1, 2, 4])
    assert moved.faces.tolist() == as_hull(brick).faces.tolist()
