"""Test that the triangles of a polygon cover exactly the polygon."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from anymesh.loading import load_mesh
from anymesh.loading.polygons_ import fans, recut

FRAME = np.array([(0, 0), (1, 0), (1, 0.2), (0.2, 0.2), (0.2, 1.8), (1, 1.8), (1, 2), (0, 2)], float)  # a C
# a square with a square hole, connected by a cut from corner to corner
KEYHOLE = np.array([(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 3), (3, 3), (3, 1), (1, 1)], float)


def cut(*outlines: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return corners, triangles and their polygons, of flat outlines (n, 2) or (n, 3)."""
    points = np.concatenate([np.pad(o, ((0, 0), (0, 3 - o.shape[1]))) for o in outlines])
    counts = np.array([len(o) for o in outlines])
    triangles, polygon = fans(counts)
    return points, recut(triangles, polygon, counts, points, np.arange(len(points))), polygon


def signed_areas(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    a, b, c = points[triangles].transpose(1, 0, 2)
    return np.cross(b - a, c - a)[:, 2] / 2


@pytest.mark.parametrize(
    ("outline", "area"), [(FRAME, 0.72), (FRAME[::-1], -0.72), (KEYHOLE, 12.0)], ids=["C", "clockwise", "keyhole"]
)
def test_no_triangle_covers_the_hole_of_a_concave_polygon(outline: np.ndarray, area: float) -> None:
    points, triangles, _ = cut(outline)
    areas = signed_areas(points, triangles)
    assert len(triangles) == len(outline) - 2
    assert areas.sum() == pytest.approx(area)
    assert np.abs(areas).sum() == pytest.approx(abs(area))  # no two overlap


def test_an_outline_may_repeat_its_corners() -> None:
    points, triangles, _ = cut(np.repeat(FRAME, 2, axis=0))
    areas = signed_areas(points, triangles)
    assert len(triangles) == 2 * len(FRAME) - 2
    assert np.abs(areas).sum() == pytest.approx(areas.sum()) == pytest.approx(0.72)


def test_convex_polygons_are_fanned_and_neighbours_stay() -> None:
    square = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)
    _, triangles, polygon = cut(square, FRAME, square[:3])
    assert triangles[polygon == 0].tolist() == [[0, 1, 2], [0, 2, 3]]
    assert set(triangles[polygon == 1].ravel()) == set(range(4, 12))  # every corner stays
    assert triangles[polygon == 2].tolist() == [[12, 13, 14]]


@given(st.integers(4, 24), st.integers(0, 10_000))
def test_stars_in_any_plane_keep_their_area(count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    angle = (np.arange(count) + 0.8 * rng.random(count)) * 2 * np.pi / count
    flat = (0.2 + rng.random(count))[:, None] * np.stack([np.cos(angle), np.sin(angle)], 1)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    points, triangles, _ = cut(np.pad(flat, ((0, 0), (0, 1))) @ turn)
    a, b, c = points[triangles].transpose(1, 0, 2)
    x, y = flat.T
    area = abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    assert np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2 == pytest.approx(area)


def test_a_window_frame_in_an_obj_stays_open(tmp_path) -> None:
    text = "".join(f"v {x} {y} 0\n" for x, y in FRAME) + "f " + " ".join(map(str, range(1, 9))) + "\nf 98 99\n"
    (tmp_path / "frame.obj").write_text(text)
    assert load_mesh(tmp_path / "frame.obj").mesh.face_areas.sum() == pytest.approx(0.72)
