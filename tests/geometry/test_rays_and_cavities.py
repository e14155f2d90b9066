"""Test rays in the unit frame of a scene, boxes of faces, slender shapes and cavities."""

from __future__ import annotations

import numpy as np
import pytest
from assets import CUBE, CUBE_FACES, box, mesh_of
from rigid import move, shape_of

from anymesh.geometry.distance_ import winding_number
from anymesh.geometry.raycast_ import RayScene, SurfaceHits
from anymesh.geometry.surface import mesh_surface
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.types.triangles import normals_and_areas

TRIANGLE = np.array([[0.0, 0, 0], [4, 0, 0], [0, 2, 0]])
FACE = np.array([[0, 1, 2]])
DOWN = np.array([[0.0, 0, -1]])


def test_the_unit_frame_has_the_middle_of_the_bounds_at_zero_and_the_longest_side_one() -> None:
    scene = RayScene(CUBE * [4, 2, 1] + [1, 2, 3], CUBE_FACES)
    assert scene.center.tolist() == [3, 3, 3.5]
    assert scene.scale == 0.25
    assert scene.unit_half.tolist() == [0.5, 0.25, 0.125]
    assert scene.to_unit(np.array([[5.0, 2, 3.5]])).tolist() == [[0.5, -0.25, 0]]
    assert RayScene(np.ones((3, 3)), FACE).scale == 1


def test_the_first_face_is_hit_with_its_distance_and_place() -> None:
    scene = RayScene(TRIANGLE, FACE)
    hits = scene.first_hit(np.array([[1.0, 0.5, 3]]), DOWN)
    assert (hits.face[0], hits.distance[0]) == (0, pytest.approx(3))
    assert (hits.u[0], hits.v[0]) == (pytest.approx(0.25), pytest.approx(0.25))
    seen = scene.surface_hits(np.array([1.0, 0.5, 3]), np.array([[0, 0, -1], [0, 0, -0.5], [1, 0, 0]], np.float32))
    assert seen.face.tolist() == [0, 0, -1]
    assert seen.depth == pytest.approx([3, 6, np.inf])
    assert seen.normal == pytest.approx(np.array([[0, 0, 1], [0, 0, 1], [0, 0, 0]]))
    assert (seen.u[0], seen.v[0]) == (pytest.approx(0.25), pytest.approx(0.25))
    below = scene.surface_hits(np.array([1.0, 0.5, -3]), np.array([[0, 0, 0.1]], np.float32))
    assert (below.depth[0], below.normal[0].tolist()) == (pytest.approx(30), [0, 0, -1])


@pytest.mark.parametrize(("length", "face"), [(3.1, 0), (2.9, -1)])
def test_a_ray_in_the_unit_frame_ends_at_its_direction(length: float, face: int) -> None:
    scene = RayScene(TRIANGLE, FACE)
    start = scene.to_unit(np.array([[1.0, 0.5, 3]]))
    assert scene.first_hit_unit(start, (length * scene.scale * DOWN).astype(np.float32)).face.tolist() == [face]
    assert scene.first_hit_unit(start, (scene.scale * DOWN).astype(np.float32), length).face.tolist() == [face]


def test_rays_from_one_point_are_those_from_copies_of_it() -> None:
    scene = RayScene(TRIANGLE, FACE)
    start, directions = np.array([1.0, 0.5, 3]), np.array([[0, 0, -1.0], [0.1, 0, -1], [0, 0, 1], [3, 0, -1]])
    one = scene.first_hit(np.broadcast_to(start, (4, 3)), directions)
    copies = scene.first_hit(np.tile(start, (4, 1)), directions)
    assert one.face.tolist() == copies.face.tolist() == [0, 0, -1, -1]
    assert one.distance.tolist() == copies.distance.tolist()
    different = scene.first_hit(np.stack([start, start + np.array([9.0, 0, 0]), start]), np.tile(DOWN, (3, 1)))
    assert different.face.tolist() == [0, -1, 0]


def test_hits_are_joined_and_taken_by_rows() -> None:
    scene = RayScene(TRIANGLE, FACE)
    found = scene.surface_hits(np.array([1.0, 0.5, 3]), np.array([[0, 0, -1], [1, 0, 0], [0, 0, -2]], np.float32))
    twice = SurfaceHits.joined(found, found.take(np.array([2, 0])))
    assert twice.face.tolist() == [0, -1, 0, 0, 0]
    assert twice.depth == pytest.approx([3, np.inf, 1.5, 1.5, 3])
    assert twice.normal.shape == (5, 3)


def test_faces_have_boxes_of_their_own() -> None:
    shape = shape_of(box((1, 2, 3), (2, 4, 7)), T=move(3))
    assert shape.lowest.tolist() == shape.triangles.min(1).tolist()
    assert shape.highest.tolist() == shape.triangles.max(1).tolist()
    assert shape.bounds.tolist() == [shape.triangles.min((0, 1)).tolist(), shape.triangles.max((0, 1)).tolist()]


@pytest.mark.parametrize(("kept", "slender"), [(7, True), (8, False), (12, False)])
@pytest.mark.parametrize("scale", [(1, 1, 1), (0.02, 0.02, 0.02)])
def test_a_shape_is_slender_below_three_fifths_of_the_surface_of_its_box(kept: int, slender: bool, scale) -> None:
    """Some of the twelve halves of the sides of a cube, with all of its corners."""
    order = [0, 1, 2, 3, 4, 8, 6, 5, 7, 9, 10, 11]
    triangles = (CUBE * scale)[CUBE_FACES[order[:kept]]]
    shape = TriangleSet(triangles, normals_and_areas(triangles)[0], np.zeros(kept, bool), np.arange(kept))
    assert len(shape.corners) == 8
    assert shape.slender == slender


def inside_out(low, high) -> tuple[np.ndarray, np.ndarray]:
    v, f = box(low, high)
    return v, f[:, ::-1]


def notched() -> tuple[np.ndarray, np.ndarray]:
    """Return an L of 4 x 4, with legs of width 1, and 4 deep, closed."""
    flat = np.array([[0, 0], [4, 0], [4, 1], [1, 1], [1, 4], [0, 4]], float)
    v = np.concatenate([np.c_[np.full(6, x), flat] for x in (20.0, 24.0)])
    cap, i, j = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]), np.arange(6), (np.arange(6) + 1) % 6
    return v, np.concatenate([cap[:, ::-1], cap + 6, np.stack([i, j, j + 6], 1), np.stack([i, j + 6, i + 6], 1)])


def test_a_solid_inside_out_in_a_notch_is_not_a_cavity() -> None:
    pieces = [inside_out((21, 2, 2), (22, 3, 3)), inside_out((21, 0.2, 0.2), (22, 0.8, 0.8)), notched()]
    found = mesh_surface(mesh_of(pieces)[0])
    assert found.void.tolist() == [False, True, False]
    assert found.components.flip.tolist() == [True] * 24 + [False] * (len(found.row) - 24)
    assert mesh_surface(mesh_of(pieces[::-1])[0]).void.tolist() == [False, True, False]


@pytest.mark.parametrize(("ends", "first"), [((1, 2), 0), ((-1, 0), 2)], ids=["above", "below"])
def test_a_solid_inside_out_against_a_side_is_not_a_cavity(ends: tuple[int, int], first: int) -> None:
    """Its first face lies in a side of the solid, which is from -1 to 2 along y."""
    vertices, faces = inside_out((ends[0], 0.2, 0.2), (ends[1], 0.8, 0.8))
    found = mesh_surface(mesh_of([box((0, -1, 0), (1, 2, 1)), (vertices, np.roll(faces, -first, axis=0))])[0])
    assert found.void.tolist() == [False, False]
    assert found.components.flip.tolist() == [False] * 12 + [True] * 12


def test_cavities_of_one_solid_are_looked_for_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """A search per cavity took minutes on CAD meshes with hundreds of them in a dense solid."""
    asked = []

    def counted(points: np.ndarray, vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
        asked.append((len(points), len(vertices)))
        return winding_number(points, vertices, faces)

    monkeypatch.setattr("anymesh.geometry.surface.winding_number", counted)
    corners, faces = box((0, 0, 0), (10, 1, 1))
    outer = corners[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3)  # as STL stores it, no vertex is shared
    cavities = [inside_out((k + 0.2, 0.2, 0.2), (k + 0.8, 0.8, 0.8)) for k in range(12)]
    assert mesh_surface(mesh_of([outer, *cavities])[0]).void.tolist() == [False] + [True] * 10 + [False] * 2
    assert asked == [(10, 8)]


def test_without_solids_or_without_cavities_there_are_none() -> None:
    assert mesh_surface(mesh_of([inside_out((0, 0, 0), (1, 1, 1))])[0]).void.tolist() == [False]
    assert (
        mesh_surface(mesh_of([box((0, 0, 0), (1, 1, 1)), box((0.2, 0.2, 0.2), (0.4, 0.4, 0.4))])[0]).void.tolist()
        == [False] * 2
    )
