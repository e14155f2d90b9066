"""Test the points of a surface, their superpoints, and their visibility in views."""

from dataclasses import replace

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.geometry.triangle_set import SurfacePoints
from anymesh.prompted.grounding.cloud import MIN_SUPERPOINT_POINTS, Cloud, _nearest_alike, sample_cloud, seen_points, sight
from anymesh.rendering.render import render
from anymesh.segmentation.divide import object_shape
from anymesh.types import Material, Mesh, Texture
from anymesh.types.camera import Camera

FEW = 20_000  # points
BODY, FRONT, KNOB = box((0, 0, 0), (1, 1, 1)), box((0, -0.1, 0), (1, -0.01, 1)), box((0.45, -0.15, 0.45), (0.55, -0.1, 0.55))
MESH, PIECE = mesh_of([BODY, FRONT, KNOB])


def cloud_of(mesh: Mesh, count: int = FEW) -> Cloud:
    return sample_cloud(mesh, object_shape(mesh), count)


def camera(eye, size: int = 200) -> Camera:
    return Camera.looking_at(np.array(eye, float), np.array([0.5, 0.45, 0.5]), np.deg2rad(60.0), size, size)


def test_every_face_has_a_point_and_every_point_lies_on_its_face() -> None:
    cloud = cloud_of(MESH)
    assert set(cloud.faces) == set(range(len(MESH.faces)))
    off = np.einsum("ij,ij->i", cloud.points - MESH.triangles[cloud.faces, 0], MESH.face_normals[cloud.faces])
    assert np.abs(off).max() < 1e-12
    assert cloud.boxes.shape == (cloud.count, 2, 3)
    assert cloud.superpoint.max() + 1 == cloud.count


def test_superpoints_are_the_sides_of_boxes() -> None:
    cloud = cloud_of(MESH)
    side = 10 * PIECE[cloud.faces] + np.rint(cloud.normals @ [1, 2, 3]).astype(int)
    same = sum(np.unique(side[cloud.superpoint == s], return_counts=True)[1].max() for s in range(cloud.count))
    assert same > 0.999 * len(cloud)
    large = np.bincount(cloud.superpoint) > 100
    assert large.sum() >= 18 - 6  # the knob's sides are small
    assert np.bincount(cloud.superpoint)[large].sum() > 0.98 * len(cloud)


def test_no_superpoint_spans_two_pieces_and_small_ones_are_merged() -> None:
    cloud = cloud_of(MESH)
    piece = object_shape(MESH).mesh_patch[cloud.faces]
    spans = [len(np.unique(piece[cloud.superpoint == s])) for s in range(cloud.count)]
    assert max(spans) == 1
    assert np.bincount(cloud.superpoint).min() >= MIN_SUPERPOINT_POINTS


@pytest.mark.parametrize(("away", "nearest"), [(3, 0), (5, 0), (6, 1), (8, 1)])
def test_a_point_takes_a_chosen_point_with_its_normal_within_some_spacings(away: float, nearest: int) -> None:
    """Two of five points are not chosen, each one spacing of 0.1 m from a chosen one.

    The normal of the first chosen point is the same, that of the second is perpendicular and counts as 4 * sqrt(2) spacings.
    With its distance of one spacing, it is sqrt(33) = 5.7 away.
    """
    x = 0.1 * np.array([-away, 1, 20, 0, 21])
    normals = np.eye(3)[[2, 0, 2, 2, 2]]
    s = SurfacePoints(np.c_[x, 0 * x, 0 * x], normals, np.arange(5))
    assert _nearest_alike(s, np.zeros(5, np.int64), np.arange(3)).tolist() == [0, 1, 2, nearest, 2]


def test_a_change_of_colour_parts_superpoints() -> None:
    plain, _ = mesh_of([BODY])
    materials = (Material("a", base_color=(1.0, 0.0, 0.0, 1.0)), Material("b", base_color=(0.0, 0.0, 1.0, 1.0)))
    two = replace(plain, face_material=(np.arange(12) % 2), materials=materials)
    assert cloud_of(plain).count == 6
    assert cloud_of(two).count == 12


def test_colours_of_a_texture_are_the_points_own() -> None:
    import io

    from PIL import Image

    picture = np.zeros((2, 2, 3), np.uint8)
    picture[:, 1, 0], picture[:, 0, 2] = 255, 255  # right half red, left half blue
    file = io.BytesIO()
    Image.fromarray(picture).save(file, "PNG")
    mesh, _ = mesh_of([BODY])
    uv = np.zeros((12, 3, 2), np.float32)
    uv[..., 0] = mesh.triangles[..., 0]
    look = Material("m", base_color=(1.0, 1.0, 1.0, 1.0), textures={"base_color": Texture(file.getvalue(), "image/png")})
    cloud = cloud_of(replace(mesh, corner_uv=uv, face_material=np.zeros(12, int), materials=(look,)))
    inner = (np.abs(cloud.points[:, 0] - 0.5) < 0.45) & (np.abs(cloud.points[:, 0] - 0.5) > 0.01)
    red = cloud.colors[:, 0] > 128
    assert (red[inner] == (cloud.points[inner, 0] > 0.5)).all()


def test_same_input_same_cloud() -> None:
    one, two = cloud_of(MESH), cloud_of(MESH)
    assert (one.superpoint == two.superpoint).all()
    assert (one.points == two.points).all()


def test_a_front_view_sees_the_front_and_nothing_behind_it() -> None:
    cloud = cloud_of(MESH)
    view = render(MESH, camera((0.5, -1.5, 0.5)))
    seen = seen_points(cloud, [view])
    front = (cloud.normals[:, 1] < -0.9) & (PIECE[cloud.faces] == 1)
    covered = (np.abs(cloud.points[:, [0, 2]] - 0.5) < 0.06).all(1)
    assert seen[front & ~covered].mean() > 0.97
    assert not seen[PIECE[cloud.faces] == 0].any()  # the base stands behind the panel
    assert not seen[cloud.normals[:, 1] > 0.9].any()
    assert seen[(PIECE[cloud.faces] == 2) & (cloud.normals[:, 1] < -0.9)].mean() > 0.9  # its rim is in pixels partly outside it


def test_pixels_are_where_the_points_project() -> None:
    cloud = cloud_of(MESH)
    view = render(MESH, camera((1.5, -1.0, 1.2)))
    found = sight(cloud, view)
    at, _ = view.camera.project(cloud.points[found.points])
    assert (found.pixels == at[:, 1].astype(int) * 200 + at[:, 0].astype(int)).all()
    assert np.abs(view.depth.reshape(-1)[found.pixels]).max() < 10


def test_visibility_agrees_with_a_ray_to_every_point() -> None:
    from anymesh.geometry.raycast_ import RayScene

    cloud = cloud_of(MESH)
    eye = np.array([1.6, -1.2, 1.4])
    seen = seen_points(cloud, [render(MESH, camera(eye, 400))])
    rays = (cloud.points - eye) * (1 - 1e-4)
    free = RayScene(MESH.vertices, MESH.faces).first_hit(np.repeat(eye[None], len(rays), 0), rays, 1.0).face < 0
    assert (seen == free).mean() > 0.985


def test_colours_between_vertices_are_interpolated_wherever_the_object_stands() -> None:
    mesh, _ = mesh_of([box((2, -3, 5), (3, -2, 6))])
    along = mesh.triangles - (2, -3, 5)  # 0 to 1 per axis
    corner_color = np.concatenate([np.rint(200 * along), np.full((12, 3, 1), 255)], 2).astype(np.uint8)
    cloud = cloud_of(replace(mesh, corner_color=corner_color))
    assert np.abs(cloud.colors - 200 * (cloud.points - (2, -3, 5))).max() <= 1.5
