"""One click takes a facet, a region up to its creases, or a piece; they grow; outlines take what lies in them."""

import numpy as np
import pytest
from assets import box, mesh_of
from chest import PIECES, chest

from anymesh.correcting.regions import Level, Regions, faces_inside
from anymesh.types.camera import Camera

FRONT = Camera.looking_at(np.array([0.0, -3.0, 0.45]), np.array([0.0, 0.0, 0.45]), 0.6, 100, 100)


@pytest.fixture(scope="module")
def regions():
    asset = chest()
    piece = mesh_of(PIECES)[1]
    return Regions(asset.mesh), asset.segmentation.face_part, piece


def face_of(piece: np.ndarray, number: int) -> int:
    """A face on the front (-y) of a piece."""
    return int(np.flatnonzero(piece == number)[4])


def test_a_click_takes_a_facet_a_region_or_a_piece(regions):
    found, part, piece = regions
    top = face_of(piece, 5)
    assert len(found.of(top, Level.FACET, part)) == 2
    assert set(piece[found.of(top, Level.REGION, part)]) == {5}
    assert len(found.of(top, Level.REGION, part)) == 12
    assert set(piece[found.of(top, Level.PIECE, part)]) == {5, 6}  # with the handle, which touches nothing else
    assert set(piece[found.of(face_of(piece, 6), Level.PIECE, part)]) == {6}  # and not the front, which is larger


def test_a_region_stays_in_the_part_that_is_clicked(regions):
    found, part, piece = regions
    half = np.where(np.arange(len(part)) % 2 == 0, part, 1)
    assert len(found.of(face_of(piece, 5), Level.REGION, half)) == 6


def test_growing_takes_the_next_level_then_what_touches(regions):
    found, part, piece = regions
    chosen = found.of(face_of(piece, 5), Level.FACET, part)
    sizes = [len(chosen)]
    for _ in range(3):
        chosen = found.grown(chosen, part)
        sizes.append(len(chosen))
    assert sizes == [2, 12, 24, 36]  # facet, front, its handle (no larger), then what else touches them: the case
    assert len(found.grown(np.zeros(0, np.int64), part)) == 0


def fused() -> np.ndarray:
    """A plate with a block on it in one connected surface: a block's sides meet the plate in concave creases."""
    lower, upper = np.array([[0, 0], [3, 0], [3, 3], [0, 3]], float), np.array([[1, 1], [2, 1], [2, 2], [1, 2]], float)
    floor = np.c_[np.concatenate([lower, upper]), np.zeros(8)]
    top = np.c_[upper, np.ones(4)]
    points = np.concatenate([floor, top])
    quads = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 9, 8), (5, 6, 10, 9), (6, 7, 11, 10), (7, 4, 8, 11)]
    quads.append((8, 9, 10, 11))
    return points, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def test_a_region_ends_at_concave_creases_of_one_surface():
    mesh, _ = mesh_of([fused()])
    part = np.zeros(len(mesh.faces), np.int64)
    found = Regions(mesh)
    block = found.of(17, Level.REGION, part)
    assert set(block) == set(range(8, 18))
    assert len(found.of(17, Level.PIECE, part)) == 18
    assert set(found.of(17, Level.FACET, part)) == {16, 17}


def test_an_outline_takes_the_faces_that_lie_in_it_by_half():
    mesh, piece = mesh_of([box((-0.5, 0, 0.2), (-0.1, 0.1, 0.7)), box((0.1, 0, 0.2), (0.5, 0.1, 0.7))])
    left = np.array([[0.1, 0.1], [0.5, 0.1], [0.5, 0.9], [0.1, 0.9]])
    faces, points, inside = faces_inside(mesh.triangles, FRONT, left)
    assert set(piece[faces]) == {0}
    assert len(faces) == 12
    assert points.shape == (12, 7, 3)
    assert inside.all()
    crossing = left + np.array([0.6, 0]) * (left[:, :1] > 0.3) - 0.0
    assert set(piece[faces_inside(mesh.triangles, FRONT, crossing)[0]]) == {0, 1}
    assert len(faces_inside(mesh.triangles, FRONT, left * 0.01)[0]) == 0


def test_what_lies_behind_the_eye_is_in_no_outline():
    mesh, _ = mesh_of([box((-1, -9, 0), (1, -8, 1))])
    whole = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    assert len(faces_inside(mesh.triangles, FRONT, whole)[0]) == 0


def test_a_piece_comes_with_what_hangs_on_it_alone():
    hub, blades = box((-1, 0, -1), (1, 0.2, 1)), [box((0.9, 0, -0.2), (2.5, 0.2, 0.6)), box((0.9, 0, 0.5), (2.5, 0.2, 1))]
    mast = box((-0.2, 0.2, -9), (0.2, 0.6, 0.5))
    mesh, piece = mesh_of([hub, *blades, mast])
    part = np.zeros(len(mesh.faces), np.int64)
    assert set(piece[Regions(mesh).of(0, Level.PIECE, part)]) == {0, 1, 2}  # blades that touch each other, not the mast
    mesh, piece = mesh_of([hub, *blades, mast, box((2, 0.2, -9), (2.2, 0.4, 0.8))])
    part = np.zeros(len(mesh.faces), np.int64)
    assert set(piece[Regions(mesh).of(0, Level.PIECE, part)]) == {0}  # a post holds the blades too
