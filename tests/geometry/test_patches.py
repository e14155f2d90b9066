"""Test the steps of simplification by hand, and that patches and parts stay apart in it."""

from __future__ import annotations

import numpy as np
import pytest
from assets import CUBE, CUBE_FACES
from trimesh.creation import revolve

from anymesh.geometry import simplify_, surface
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.surface import MIN_PATCH_FACES, DividedSurface
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.types.triangles import normals_and_areas


def sheet(size: int, low=(0.0, 0.0, 0.0), side: float = 1.0) -> np.ndarray:
    """Return a square sheet of 2 * size^2 triangles that face +z."""
    i, j = (g.reshape(-1) for g in np.meshgrid(np.arange(size), np.arange(size), indexing="ij"))
    a, b, c, d = (np.c_[x, y, 0 * x] * side / size for x, y in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
    return np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]) + low


def area(triangles: np.ndarray) -> float:
    return float(normals_and_areas(triangles)[1].sum())


def test_the_smallest_index_comes_first_and_the_winding_stays() -> None:
    faces = np.array([[2, 0, 1], [5, 3, 4], [3, 4, 5], [8, 9, 7]])
    assert simplify_.smallest_index_first(faces).tolist() == [[0, 1, 2], [3, 4, 5], [3, 4, 5], [7, 8, 9]]


def test_a_closed_surface_has_no_border_and_without_a_face_it_has_one() -> None:
    assert not simplify_._has_border(CUBE_FACES)
    for k in range(12):
        assert simplify_._has_border(np.delete(CUBE_FACES, k, 0))
    strip = np.array([[0, 1, 2], [2, 1, 0]])
    assert not simplify_._has_border(strip)
    assert not simplify_._has_border(np.concatenate([strip, strip + 3]))


def test_the_area_of_a_cube_is_that_of_its_sides() -> None:
    assert simplify_._area(2 * CUBE, CUBE_FACES) == pytest.approx(24)
    assert simplify_._area(2 * CUBE, CUBE_FACES[:3]) == pytest.approx(6)


@pytest.mark.parametrize("size", [0.1, 1.0, 8.0])
def test_a_triangle_is_on_a_surface_within_a_tenth_of_its_size(size: float) -> None:
    ground, one = sheet(1, (-50, -50, 0), 100.0), size * np.sqrt(2) * np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    raised = np.stack([one + np.array([0, 0, share * size]) for share in (-0.11, -0.09, 0, 0.09, 0.11)])
    found = simplify_._on_surface(raised, ground.reshape(-1, 3), np.arange(6).reshape(-1, 3))
    assert found.tolist() == [False, True, True, True, False]


def test_up_to_the_target_a_mesh_is_returned_as_it_is() -> None:
    assert simplify_._by_quadrics(CUBE, CUBE_FACES, 12)[1] is CUBE_FACES
    assert simplify(CUBE[CUBE_FACES], 13).tolist() == CUBE[CUBE_FACES].tolist()


def test_the_sharpest_vertex_represents_its_cell() -> None:
    """A roof of two slopes that meet at x = 0.5, in cells of a fifth: those at its ridge keep a ridge vertex."""
    roof = sheet(20)
    roof[:, :, 2] = 0.5 - np.abs(roof[:, :, 0] - 0.5)
    points, corner = np.unique(roof.reshape(-1, 3).round(9), axis=0, return_inverse=True)
    kept, faces = simplify_._clustered(points, corner.reshape(-1, 3), 70)
    cell = np.sqrt(2 * np.sqrt(2) / 70)
    at = np.floor(kept / cell).astype(int)
    ridge = at[:, 0] == int(0.5 / cell)
    assert (kept[ridge, 2].max(), len(kept)) == (pytest.approx(0.5), len(np.unique(kept, axis=0)))
    for k in np.unique(at[ridge, 1]):
        assert kept[ridge & (at[:, 1] == k), 2].max() == pytest.approx(0.5)
    assert 30 < len(faces) <= 100
    assert (np.sort(faces, 1)[:, :-1] != np.sort(faces, 1)[:, 1:]).all()


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_a_flat_sheet_keeps_its_area_and_place_at_any_scale(scale: float) -> None:
    fine = scale * (sheet(16) + np.array([5, -3, 2]))
    few = simplify(fine, 60)
    assert 2 <= len(few) <= 60
    assert area(few) == pytest.approx(scale**2, rel=0.06)
    assert few.reshape(-1, 3).min(0) == pytest.approx(scale * np.array([5, -3, 2]), abs=0.02 * scale)
    assert (normals_and_areas(few)[0][:, 2] > 0.99).all()


def divided(triangles: np.ndarray, patch: np.ndarray, copy: np.ndarray | None = None) -> DividedSurface:
    rows = np.arange(len(triangles))
    shape = TriangleSet(triangles, normals_and_areas(triangles)[0], np.zeros(len(triangles), bool), rows, 7)
    return DividedSurface(shape, rows if copy is None else copy, patch, np.array([[0, 1]]), 2.0)


def test_parts_of_a_patch_are_simplified_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    fine = sheet(20)
    right = (fine.mean(1)[:, 0] > 0.5).astype(np.int64)
    monkeypatch.setattr(surface, "MAX_FACES", 100)
    found = divided(fine, np.zeros(800, np.int64)).simplified(right)
    assert 20 < len(found.patch) <= 130
    part = right[found.source]
    assert found.shape.triangles[part == 0][:, :, 0].max() <= 0.5 + 1e-6
    assert found.shape.triangles[part == 1][:, :, 0].min() >= 0.5 - 1e-6
    assert found.patch.tolist() == [0] * len(found.patch)
    assert (found.shared.tolist(), found.diagonal) == ([[0, 1]], 2.0)
    assert found.shape.seed == 7
    assert found.shape.known is not None


def test_few_faces_stay_and_dense_patches_are_simplified_in_proportion(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sheets of 1800, 450 and 8 triangles; the last one stays."""
    sheets = [sheet(30), sheet(15, (2, 0, 0)), sheet(2, (4, 0, 0))]
    triangles, patch = np.concatenate(sheets), np.repeat([0, 1, 2], [1800, 450, 8])
    order = np.random.default_rng(0).permutation(len(patch))
    triangles, patch = triangles[order], patch[order]
    monkeypatch.setattr(surface, "MAX_FACES", 500)
    monkeypatch.setattr(surface, "KEPT_PATCH_FACES", 30)
    found = divided(triangles, patch).simplified()
    count = np.bincount(found.patch)
    assert 300 < count[0] <= 400
    assert 70 < count[1] <= 100
    assert count[2] == 8
    assert found.patch.tolist() == patch[found.source].tolist()
    low = [found.shape.triangles[found.patch == k][:, :, 0].min() for k in range(3)]
    assert low == pytest.approx([0, 2, 4], abs=0.02)
    assert (found.shape.normals[:, 2] > 0.9).all()
    assert [area(found.shape.triangles[found.patch == k]) for k in range(3)] == pytest.approx([1, 1, 1], rel=0.06)
    assert found.of(np.array([3, 1])).faces.tolist() == [3, 1]


def test_a_mesh_of_the_maximum_number_of_faces_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    found = divided(sheet(5), np.zeros(50, np.int64))
    monkeypatch.setattr(surface, "MAX_FACES", 50)
    assert found.simplified().source.tolist() == list(range(50))
    monkeypatch.setattr(surface, "MAX_FACES", 49)
    monkeypatch.setattr(surface, "KEPT_PATCH_FACES", 20)
    assert len(found.simplified().source) < 50


def test_very_many_patches_keep_few_faces_each(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 100 patches of 32 triangles, 3 * 60 / 100 faces each would be left, and the minimum is kept."""
    triangles = np.concatenate([sheet(4, (2 * k, 0, 0)) for k in range(100)])
    monkeypatch.setattr(surface, "MAX_FACES", 60)
    monkeypatch.setattr(surface, "KEPT_PATCH_FACES", 32)
    found = divided(triangles, np.repeat(np.arange(100), 32)).simplified()
    count = np.bincount(found.patch)
    assert len(count) == 100
    assert count.max() <= MIN_PATCH_FACES == 20
    assert count.min() >= 2


POT = [(0, 0), (0.11, 0), (0.12, 0.02), (0.12, 0.14), (0.117, 0.14), (0.117, 0.022), (0, 0.004)]  # [m] radius and height
ROWS, SECTIONS = 24, 142  # of the grid: rows per segment of the profile, and sections around


def fine_pot() -> np.ndarray:
    """Return a closed pot with walls of 3 mm, on a regular grid of about 40,000 triangles."""
    profile, at = np.array(POT), np.linspace(0, len(POT) - 1, ROWS * (len(POT) - 1) + 1)
    fine = np.stack([np.interp(at, np.arange(len(POT)), column) for column in profile.T], 1)
    return np.asarray(revolve(fine, sections=SECTIONS).triangles, float)


def volume(triangles: np.ndarray) -> float:
    return float(np.linalg.det(triangles).sum() / 6)


def test_thin_walls_on_a_fine_grid_keep_their_volume():
    pot = fine_pot()
    few = simplify(pot, 3000)
    for found, most in ((few, 3000), (simplify(few, 1000), 1000)):  # in two steps, as for collision shapes
        assert len(found) <= 1.1 * most
        assert volume(found) == pytest.approx(volume(pot), rel=0.03)
        assert normals_and_areas(found)[1].sum() == pytest.approx(normals_and_areas(pot)[1].sum(), rel=0.01)


def test_a_surface_on_which_quadrics_stall_is_simplified_the_same_each_time():
    pot = fine_pot()
    assert simplify(pot, 1000).tobytes() == simplify(pot, 1000).tobytes()


@pytest.mark.parametrize("axis", range(3))
def test_both_sides_of_a_thin_board_stay_apart_in_one_cell(axis):
    """A board of 1 x 1 and 1 mm, in cells of about 6 cm."""
    u, v = (g.reshape(-1) for g in np.meshgrid(np.linspace(0, 1, 60), np.linspace(0, 1, 60), indexing="ij"))
    k = np.arange(60 * 60).reshape(60, 60)
    a, b, c, d = (p.reshape(-1) for p in (k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]))
    side = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    low, high = (np.roll(np.stack([np.full(len(u), w), u, v], 1), axis, 1) for w in (0.0, 1e-3))
    points, faces = simplify_._clustered(np.concatenate([low, high]), np.concatenate([side[:, ::-1], side + len(u)]), 600)
    normals, areas = normals_and_areas(points[faces])
    assert len(faces) <= 900
    for sign in (-1, 1):
        own = sign * normals[:, axis] > 0.9
        assert areas[own].sum() == pytest.approx(1, abs=0.15)
        assert np.unique(points[faces[own], axis]).tolist() == [0.0 if sign < 0 else 1e-3]
