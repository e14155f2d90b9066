"""Test panels inferred from the positions of their handles."""

import numpy as np
import pytest

from anymesh.segmentation.panels import PanelRectangle, filled, tile

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
