"""Test panels inferred from handles on a closed surface, and that surfaces without handles stay whole."""

import numpy as np
import pytest
import trimesh

from anymesh.geometry.surface import ObjectShape
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.panels import PanelRectangle, filled, tile
from anymesh.types import Mesh, Node

SIZE = np.array([1.0, 0.6, 1.2])
FRONT = -SIZE[1] / 2


def solid(*boxes: tuple[list[float], list[float]], size=SIZE) -> Mesh:
    """Return a fine box of `size` united with small ones, (center, sides), as one surface."""
    parts = [trimesh.creation.box(size), *(trimesh.creation.box(sides).apply_translation(at) for at, sides in boxes)]
    whole = trimesh.boolean.union(parts)
    fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(whole.vertices, whole.faces, 0.06))
    count = len(fine.faces)
    return Mesh(fine.vertices, fine.faces, np.zeros(count, np.int64), (Node("object"),), np.full(count, -1))


def bar(x: float, z: float, along: int) -> tuple[list[float], list[float]]:
    sides = [0.03, 0.06, 0.03]
    sides[along] = 0.2
    return [x, FRONT - 0.02, z], sides


def panels(whole: ObjectShape) -> list[int]:
    """Return the patches that are large, without the one that most of the object's surface belongs to."""
    area = np.bincount(whole.patch, whole.shape.areas)
    return [int(p) for p in np.flatnonzero(area > 0.05 * area.sum()) if p != area.argmax()]


def front_boxes(whole: ObjectShape) -> np.ndarray:
    """Return the bounds of the panels, (k, 2, 3), from left to right and from bottom to top."""
    boxes = np.array([whole.of(np.flatnonzero(whole.patch == p)).bounds for p in panels(whole)]).reshape(-1, 2, 3)
    return boxes[np.lexsort((boxes[:, 0, 2].round(1), boxes[:, 0, 0].round(1)))]


def test_two_bars_divide_a_face_into_two_doors() -> None:
    boxes = front_boxes(object_shape(solid(bar(-0.08, 0.0, 2), bar(0.08, 0.0, 2))))
    assert len(boxes) == 2
    assert np.allclose(boxes[0][:, [0, 2]], [[-0.5, -0.6], [0, 0.6]], atol=0.06)
    assert np.allclose(boxes[1][:, [0, 2]], [[0, -0.6], [0.5, 0.6]], atol=0.06)
    assert np.allclose(boxes[:, :, 1], FRONT)


def test_a_handle_on_a_panel_is_a_patch_of_its_own() -> None:
    whole = object_shape(solid(bar(-0.08, 0.0, 2), bar(0.08, 0.0, 2)))
    in_front = set(whole.patch[whole.shape.triangles[:, :, 1].min(1) < FRONT - 0.01].tolist())
    assert len(in_front) == 2
    for patch in in_front:
        low, high = whole.of(np.flatnonzero(whole.patch == patch)).bounds
        assert high - low == pytest.approx([0.03, 0.05, 0.2], abs=1e-6)


def test_a_face_without_handles_stays_whole() -> None:
    assert panels(object_shape(solid())) == []


def test_feet_and_mouldings_are_no_handles() -> None:
    feet = [([x, y, -0.62], [0.05, 0.05, 0.08]) for x in (-0.4, 0.4) for y in (-0.2, 0.2)]
    moulding = ([0, FRONT, 0.4], [0.5, 0.02, 0.1])
    assert panels(object_shape(solid(*feet, moulding))) == []


def test_a_thin_door_is_a_front_on_both_sides_and_a_deep_cabinet_is_not() -> None:
    for depth, through in ((0.08, True), (0.6, False)):
        handle = ([0.4, -depth / 2 - 0.02, 0.0], [0.03, 0.06, 0.2])
        whole = object_shape(solid(handle, size=np.array([1.0, depth, 1.2])))
        y = whole.shape.triangles[:, :, 1]
        front, back = (set(whole.patch[np.abs(y - level).max(1) < 1e-6].tolist()) for level in (-depth / 2, depth / 2))
        assert len(front) == len(back) == 1
        assert (front == back) is through
        sides = set(whole.patch[np.abs(whole.shape.normals[:, 1]) < 0.1].tolist())
        assert not front >= sides  # the rims belong to the rest


def test_turning_the_object_turns_its_fronts() -> None:
    mesh = solid(bar(-0.08, 0.0, 2), bar(0.08, 0.0, 2))
    c, s = np.cos(0.7), np.sin(0.7)
    T = np.eye(4)
    T[:2, :2] = [[c, -s], [s, c]]
    plain, turned = object_shape(mesh), object_shape(mesh.transformed(T))
    assert len(panels(turned)) == 2
    same = np.isin(plain.mesh_patch, panels(plain)) == np.isin(turned.mesh_patch, panels(turned))
    assert mesh.face_areas[same].sum() > 0.98 * mesh.face_areas.sum()


LOW, HIGH = np.zeros(2), np.array([1.0, 1.0])
BAR, KNOB = 0.06, 0.01  # half lengths


def handle(x: float, y: float, along: int) -> np.ndarray:
    half = np.array([KNOB, KNOB])
    if along >= 0:
        half[along] = BAR
    return np.add([x, y], [-half, half])


def fronts(*handles: tuple[float, float, int], low=LOW, high=HIGH) -> list[PanelRectangle]:
    spots = np.array([handle(*h) for h in handles]).reshape(-1, 2, 2)
    found = tile(low, high, spots, np.array([h[2] for h in handles], np.int64))
    return sorted(found, key=lambda f: f.handle)


def rectangles(found: list[PanelRectangle]) -> np.ndarray:
    return np.array([[*f.low, *f.high] for f in found])


def test_one_handle_is_one_front() -> None:
    assert rectangles(fronts((0.9, 0.5, 1))) == pytest.approx(np.array([[0, 0, 1, 1]]))


def test_two_bars_side_by_side_are_two_doors() -> None:
    assert rectangles(fronts((0.45, 0.5, 1), (0.55, 0.5, 1))) == pytest.approx(np.array([[0, 0, 0.5, 1], [0.5, 0, 1, 1]]))


def test_drawers_beside_a_door_reach_as_far_as_their_handles_are_central() -> None:
    found = fronts((0.35, 0.5, 1), (0.7, 0.25, 0), (0.7, 0.75, 0))
    assert rectangles(found) == pytest.approx(np.array([[0, 0, 0.4, 1], [0.4, 0, 1, 0.5], [0.4, 0.5, 1, 1]]))


def test_two_drawers_over_two_doors() -> None:
    found = fronts((0.25, 0.9, 0), (0.75, 0.9, 0), (0.44, 0.5, 1), (0.56, 0.5, 1))
    assert rectangles(found) == pytest.approx(
        np.array([[0, 0.8, 0.5, 1], [0.5, 0.8, 1, 1], [0, 0, 0.5, 0.8], [0.5, 0, 1, 0.8]])
    )


def test_fronts_tile_the_face_and_each_holds_its_handle() -> None:
    rng = np.random.default_rng(0)
    for _ in range(20):
        at = [(x, y, int(rng.integers(-1, 2))) for x in (0.2, 0.5, 0.8) for y in (0.2, 0.5, 0.8) if rng.random() < 0.6]
        found = fronts(*at)
        boxes = rectangles(found).reshape(-1, 4)
        assert len(found) == len(at)
        assert ((boxes[:, 2:] - boxes[:, :2]).prod(1)).sum() == pytest.approx(1.0 if at else 0.0)
        for front, (x, y, _along) in zip(found, at, strict=True):
            assert front.low[0] < x < front.high[0]
            assert front.low[1] < y < front.high[1]


def test_a_row_of_controls_is_no_row_of_doors() -> None:
    assert fronts(*[(x, 0.9, -1) for x in np.linspace(0.1, 0.9, 6)]) == []


def test_handles_that_no_cut_keeps_apart_tell_nothing() -> None:
    assert fronts((0.5, 0.5, 0), (0.5, 0.5, 1)) == []


def test_shift_and_scale_do_not_matter() -> None:
    at = [(0.35, 0.5, 1), (0.7, 0.25, 0), (0.7, 0.75, 0)]
    plain = rectangles(fronts(*at))
    spots = np.array([handle(*h) for h in at]) * 3 + 7
    moved = tile(LOW * 3 + 7, HIGH * 3 + 7, spots, np.array([1, 0, 0]))
    assert rectangles(sorted(moved, key=lambda f: f.handle)) == pytest.approx(plain * 3 + 7)


def test_the_rectangle_that_a_desk_fills_is_its_pedestal() -> None:
    grid = np.stack(np.meshgrid(np.linspace(0, 1, 200), np.linspace(0, 1, 200)), -1).reshape(-1, 2)
    x, y = grid.T
    desk = grid[(x < 0.3) | (y > 0.9) | (x > 0.95)]
    found = filled(desk, np.array([[0.1, 0.2], [0.2, 0.7]]))
    assert found is not None
    assert np.concatenate(found) == pytest.approx([0, 0, 0.3, 1], abs=0.05)
    assert filled(desk, np.array([[0.1, 0.2], [0.7, 0.7]])) is None
    found = filled(desk, np.array([[0.0, 0.0], [0.2, 0.7]]))  # from the lowest corner on
    assert found is not None
    assert np.concatenate(found) == pytest.approx([0, 0, 0.3, 1], abs=0.05)


def test_a_pane_is_part_of_the_rectangle_that_its_frame_fills() -> None:
    grid = np.stack(np.meshgrid(np.linspace(0, 1, 200), np.linspace(0, 1, 200)), -1).reshape(-1, 2)
    frame = grid[(np.abs(grid - 0.5) > 0.4).any(1)]
    found = filled(frame, np.array([[0.92, 0.4], [0.96, 0.6]]))
    assert found is not None
    assert np.concatenate(found) == pytest.approx([0, 0, 1, 1])


def test_the_rectangle_may_begin_at_a_corner_of_another() -> None:
    """Two squares that touch at a corner only: the one around the handle is filled, their bounds are not."""
    grid = np.stack(np.meshgrid(np.linspace(0, 1, 200), np.linspace(0, 1, 200)), -1).reshape(-1, 2)
    squares = grid[(grid < 0.5).all(1) | (grid >= 0.5).all(1)]
    for corner in (0.0, 0.5):
        found = filled(squares, np.array([[0.2, 0.2], [0.3, 0.3]]) + corner)
        assert found is not None
        assert np.concatenate(found) == pytest.approx(np.array([0, 0, 0.5, 0.5]) + corner, abs=0.05)
