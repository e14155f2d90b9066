"""Sheets, and what closes them."""

import sys

import numpy as np
import pytest
from assets import box
from surfaces import is_closed, shell

from anymesh.errors import MissingExtraError
from anymesh.finishing.boards import board, tray
from anymesh.finishing.sheets import open_sheets
from anymesh.finishing.solids import backed, cap, covers_itself, shelled, without_folds
from anymesh.loading.polygons_ import triangulate


def volume(triangles: np.ndarray) -> float:
    return float(np.einsum("ij,ij->i", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])).sum() / 6)


def sheets_of(triangles: np.ndarray):
    corners = triangles.reshape(-1, 3)
    return open_sheets(corners, np.arange(len(corners)).reshape(-1, 3), 5.0)


def test_a_box_without_a_side_is_one_sheet_with_one_border():
    (sheet,) = sheets_of(shell((0, 0, 0), (1, 2, 3), "-y"))
    assert len(sheet.faces) == 10
    assert [len(loop) for loop in sheet.loops] == [4]
    assert (sheet.points[sheet.loops[0]][:, 1] == 0).all()


def test_closed_solids_are_no_sheets_however_careless_their_faces_are() -> None:
    """Otherwise boards would get skins."""
    rng = np.random.default_rng(0)
    boards = [vertices[faces] for vertices, faces in (box((0, 0, 0), (1, 3, 1)), box((1, 0, 0), (2, 1, 1)))]
    frame = np.concatenate(boards)
    by_chance = np.where(rng.random(len(frame))[:, None, None] < 0.5, frame[:, ::-1], frame)
    for triangles in (
        frame,
        frame[:, ::-1],
        by_chance,
        np.concatenate([frame, frame]),
        np.concatenate([frame, frame[:, ::-1]]),
    ):
        assert sheets_of(triangles) == []
    assert sheets_of(boards[0] + rng.uniform(-2e-5, 2e-5, (12, 3, 3))) == []


@pytest.mark.parametrize("seed", range(3))
def test_cracks_between_the_faces_of_a_sheet_are_no_borders(seed: int) -> None:
    triangles = shell((0, 0, 0), (1, 2, 3), "-y")
    (sheet,) = sheets_of(triangles + np.random.default_rng(seed).uniform(-2e-5, 2e-5, triangles.shape))
    assert len(sheet.faces) == 10
    assert [len(loop) for loop in sheet.loops] == [4]


def test_a_whole_box_is_no_sheet_and_boxes_that_touch_in_a_point_are_two():
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    assert open_sheets(vertices, faces, 5.0) == []
    two = np.concatenate([shell((0, 0, 0), (1, 1, 1), "-x"), shell((1, 1, 1), (2, 2, 2), "+x")])
    assert [len(s.faces) for s in sheets_of(two)] == [10, 10]


@pytest.mark.parametrize("turned", [False, True])
def test_a_shell_has_the_volume_of_its_walls(turned):
    triangles = shell((0, 0, 0), (1, 2, 3), "-y")
    (sheet,) = sheets_of(triangles[:, ::-1] if turned else triangles)
    points, faces = shelled(sheet, 0.1, faces_out=not turned)
    whole = sheet.with_faces(points, faces).triangles
    assert is_closed(whole)
    assert volume(whole) == pytest.approx((-1 if turned else 1) * (6 - 0.8 * 1.9 * 2.8))


@pytest.mark.parametrize("draft", [0.0, 0.05])
def test_a_back_lies_where_it_is_asked_for(draft):
    (sheet,) = sheets_of(shell((0, 0, 0), (1, 2, 3), "-y"))
    whole = sheet.with_faces(*backed(sheet, np.array([0, -1.0, 0]), 0.5, faces_out=True, draft=draft)).triangles
    assert is_closed(whole)
    assert whole[..., 1].min() == -0.5
    back = whole.reshape(-1, 3)[whole.reshape(-1, 3)[:, 1] == -0.5]
    np.testing.assert_allclose(back.min(0)[[0, 2]], draft, atol=1e-12)
    np.testing.assert_allclose(back.max(0)[[0, 2]], [1 - draft, 3 - draft])


def test_a_cap_with_a_border_within_another_leaves_a_hole():
    points = np.array([[0, 0, 0], [0, 4, 0], [4, 4, 0], [4, 0, 0], [1, 1, 0], [2, 1, 0], [2, 2, 0], [1, 2, 0]], float)
    faces = cap(points, [np.arange(4), np.arange(4, 8)], np.array([0, 0, 1.0]))
    cross = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    assert (cross[:, 2] > 0).all()
    assert cross[:, 2].sum() / 2 == pytest.approx(15)


def test_folds_are_dropped_and_closed_surfaces_stay_closed():
    whole = board(np.zeros(3), np.ones(3), np.eye(3))
    flap = np.array([[[0, 0, 0], [0, 0, 1], [0.0, -1, 0]]])
    flat = np.array([[[0, 0, 0], [0, 0, 0], [0.0, 0, 1]]])
    kept = without_folds(np.concatenate([flap, flat, whole, flap[:, ::-1]]), whole)
    assert (kept == whole).all()
    assert covers_itself(np.array([[0, 1, 2]]), np.array([[3, 4, 5], [2, 1, 0]]))
    assert not covers_itself(np.array([[0, 1, 2]]), np.array([[0, 1, 3]]))


def test_boards_and_trays():
    turn = np.array([[0, 1, 0], [0, 0, 1], [1.0, 0, 0]])
    for axes in (np.eye(3), turn):
        solid, hollow = board(np.zeros(3), np.array([1, 2, 3.0]), axes), tray(np.zeros(3), np.array([1, 2, 3.0]), axes, 0.1)
        assert is_closed(solid)
        assert is_closed(hollow)
        assert volume(solid) == pytest.approx(6)
        assert volume(hollow) == pytest.approx(6 - 0.8 * 1.8 * 2.9)


def test_without_manifold3d_one_error_says_so(monkeypatch):
    monkeypatch.setitem(sys.modules, "manifold3d", None)
    with pytest.raises(MissingExtraError, match="manifold3d is missing"):
        triangulate([np.array([[0, 0], [1, 0], [0, 1.0]])])


def test_a_cap_leaves_out_a_hole_with_another_number_of_corners() -> None:
    """A square of area 4 with a triangular hole of area .5: the cap has area 3.5 and faces along the normal."""
    square = np.array([[0, 0, 0], [0, 2, 0], [2, 2, 0], [2, 0, 0]], float)  # clockwise from above, as the faces around it run
    hole = np.array([[0.5, 0.5, 0], [1.5, 0.5, 0], [0.5, 1.5, 0]], float)
    points = np.concatenate([square, hole])
    faces = cap(points, [np.arange(4), np.arange(4, 7)], np.array([0, 0, 1.0]))
    cross = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    assert (cross[:, 2] > 0).all()
    assert cross[:, 2].sum() / 2 == pytest.approx(3.5)
