"""From a picture with depth to a surface."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.evaluation.partial import joined, visible_surface
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.rendering.render import render
from anymesh.rendering.viewpoints import orbit_camera
from anymesh.types.camera import Camera

BACK, FRONT = box((-1, 0, 0), (1, 1, 2)), box((-0.5, -0.6, 0.5), (0.5, -0.5, 1.5))
MESH, LABELS = mesh_of([BACK, FRONT])


def test_what_is_seen_lies_on_the_object_looks_at_the_camera_and_keeps_its_part() -> None:
    camera = orbit_camera(MESH.bounds, 0.5, 0.4, 96)
    view = render(MESH, camera)
    surface, part = visible_surface(view, np.where(view.face >= 0, LABELS[view.face], -1))
    for k in (0, 1):
        mine = surface.subset(part == k)
        off = distance_to_mesh(mine.vertices, MESH.vertices, MESH.faces[np.flatnonzero(np.equal(LABELS, k))])[0]
        assert off.max() < 1e-5
        toward = camera.T_world_camera[:3, 3] - mine.triangles.mean(1)
        assert (np.einsum("ij,ij->i", toward, mine.face_normals) > 0).all()
    assert surface.corner_color is not None


def test_no_face_spans_a_jump_in_depth() -> None:
    camera = orbit_camera(MESH.bounds, 0.5, 0.4, 96)
    view = render(MESH, camera)
    one = np.where(view.face >= 0, 0, -1)  # although the two boxes count as one part
    surface, _ = visible_surface(view, one)
    middles = surface.triangles.mean(1)
    assert distance_to_mesh(middles, MESH.vertices, MESH.faces)[0].max() < 0.06  # 0.5 lies between the boxes


@pytest.mark.parametrize("slant", [0.0, 60.0, 85.0])
def test_a_plane_is_one_surface_at_any_slant(slant: float) -> None:
    camera = Camera(np.eye(4), np.deg2rad(30), 32, 32)
    x = (np.arange(32) + 0.5 - 16) / camera.focal
    depth = np.tile(4 / (1 - x * np.tan(np.deg2rad(slant))), (32, 1))
    depth[depth < 0] = np.inf
    part = np.where(np.isfinite(depth), 0, -1)
    seen = (part[:, 1:] >= 0) & (part[:, :-1] >= 0)
    assert seen.any()
    assert (joined(depth, part, camera.focal) == seen).all()


def test_neighbours_of_two_parts_or_of_two_depths_are_not_joined() -> None:
    depth, part = np.full((4, 8), 3.0), np.zeros((4, 8), int)
    part[:, 4:] = 1
    depth[:, 6:] = 3.5
    assert joined(depth, part, 100.0)[0].tolist() == [True, True, True, False, True, False, True]


def test_a_picture_of_nothing_has_no_surface() -> None:
    camera = Camera.looking_at(np.array([0.0, -9, 0]), np.array([0.0, -20, 0]), 0.5, 16, 16)
    view = render(MESH, camera)
    with pytest.raises(ValueError, match="three neighbouring pixels"):
        visible_surface(view, np.full((16, 16), -1))
