"""What a pixel shows is what its ray meets."""

import numpy as np
import pytest
from assets import QUAD_UV, box, checker, mesh_of

from anymesh.geometry.distance_ import distance_to_triangles
from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.render import BACKGROUND, face_colors, render
from anymesh.types import Material, Texture
from anymesh.types.camera import Camera

RED, BLUE = (200, 30, 30), (30, 30, 200)  # the checker's


def soup(seed: int, count: int = 25):
    """A mesh of random triangles."""
    rng = np.random.default_rng(seed)
    corners = rng.uniform(-1, 1, (count, 1, 3)) + rng.normal(scale=0.5, size=(count, 3, 3))
    return mesh_of([(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))])[0]


def brute_force(triangles, origins, directions):
    """Distance (n, F) along each ray to each triangle, inf where it is missed, by Cramer's rule."""
    a, e1, e2 = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    d, o = directions[:, None], origins[:, None] - a[None]
    det = (np.cross(d, e2) * e1).sum(-1)
    u = (np.cross(d, e2) * o).sum(-1) / det
    v = (np.cross(o, e1) * d).sum(-1) / det
    t = (np.cross(o, e1) * e2).sum(-1) / det
    return np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0), t, np.inf), u, v


def camera(seed: int, size: tuple[int, int] = (40, 30)) -> Camera:
    eye = np.random.default_rng(seed).normal(size=3)
    return Camera.looking_at(4 * eye / np.linalg.norm(eye), np.zeros(3), 0.9, *size)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("seed", range(3))
def test_first_hits_are_those_of_brute_force_at_any_scale(seed, scale):
    mesh = soup(seed)
    origins, directions = camera(seed).rays()
    t, u, v = brute_force(mesh.triangles, origins, directions)
    expected = np.where(np.isfinite(t.min(1)), t.argmin(1), -1)
    shift = np.array([5.0, -3, 2])
    hits = RayScene((mesh.vertices + shift) * scale, mesh.faces).first_hit((origins + shift) * scale, directions * scale)
    same = hits.face == expected
    assert same.mean() > 0.995  # rays along an edge may go either way
    seen = np.flatnonzero(same & (expected >= 0))
    assert len(seen) > 200
    np.testing.assert_allclose(hits.distance[seen], t.min(1)[seen], rtol=1e-4)
    assert np.isinf(hits.distance[hits.face < 0]).all()
    for found, exact in ((hits.u, u), (hits.v, v)):
        np.testing.assert_allclose(found[seen], exact[seen, expected[seen]], atol=1e-3)


def test_hits_end_at_the_given_distance():
    scene = RayScene(*box((0, 0, 0), (1, 1, 1)))
    origins, directions = np.tile([0.3, 0.4, -1.0], (2, 1)), np.array([[0, 0, 0.9], [0, 0, 1.1]])
    assert (scene.first_hit(origins, directions, 1.0).face >= 0).tolist() == [False, True]
    assert (scene.first_hit(origins, directions).face >= 0).all()
    assert len(scene.first_hit(np.zeros((0, 3)), np.zeros((0, 3))).face) == 0


@pytest.mark.parametrize("seed", range(3))
def test_an_unprojected_pixel_lies_on_its_face_and_projects_back(seed):
    mesh, view = soup(seed), render(soup(seed), camera(seed))
    seen = np.flatnonzero(view.face.ravel() >= 0)
    origins, directions = view.camera.rays()
    points = (origins + view.depth.reshape(-1, 1) * directions)[seen]
    for face in np.unique(view.face.ravel()[seen]):
        mine = view.face.ravel()[seen] == face
        np.testing.assert_allclose(distance_to_triangles(points[mine], mesh.triangles[[face]]), 0, atol=1e-5)
    pixel, depth = view.camera.project(points)
    np.testing.assert_array_equal(np.floor(pixel).astype(int) @ [1, 40], seen)
    np.testing.assert_allclose(depth, view.depth.ravel()[seen], rtol=1e-6)
    normal = view.normal.reshape(-1, 3)
    assert (np.einsum("ij,ij->i", normal[seen], directions[seen]) <= 0).all()
    np.testing.assert_allclose(np.abs(np.einsum("ij,ij->i", normal[seen], mesh.face_normals[view.face.ravel()[seen]])), 1)
    nothing = view.face < 0
    assert nothing.any()
    assert (view.color[nothing] == BACKGROUND).all()
    assert np.isinf(view.depth[nothing]).all()
    assert (view.normal[nothing] == 0).all()


def test_colours_follow_the_faces_and_light_only_scales_them():
    mesh, _ = mesh_of([box((-1, -1, -1), (1, 1, 1))])
    colors = np.zeros((12, 3), np.uint8)
    colors[np.arange(12), np.arange(12) // 2 % 3] = 200
    view = render(mesh, camera(1), face_color=colors)
    seen = view.face >= 0
    np.testing.assert_array_equal(view.color[seen] > 0, colors[view.face[seen]] > 0)
    top = render(mesh, Camera.looking_at(np.array([0, 0, 9.0]), np.zeros(3), 0.5, 5, 5)).color[2, 2]
    under = render(mesh, Camera.looking_at(np.array([0, 0, -9.0]), np.zeros(3), 0.5, 5, 5)).color[2, 2]
    assert (top > under).all()


def test_a_face_has_the_colour_of_its_material_texture_and_corners():
    tints = np.zeros((12, 3, 4), np.uint8)
    tints[:] = (255, 255, 255, 255)
    tints[4:8] = (10, 200, 90, 255)
    materials = (
        Material("white", (1.0, 1.0, 1.0, 1.0)),
        Material("squares", (1.0, 1.0, 1.0, 1.0), textures={"base_color": png(2)}),
    )
    mesh, _ = mesh_of(
        [box((0, 0, 0), (1, 1, 1))],
        np.repeat([0, 1, -1, 0], [2, 2, 2, 6]),
        materials=materials,
        corner_uv=np.tile(QUAD_UV, (6, 1, 1)),
        corner_color=tints,
    )
    found = face_colors(mesh).tolist()
    assert found[0] == found[8] == [255, 255, 255]
    assert found[4] == found[6] == [10, 200, 90]  # as stored, without a material and under a white one
    assert {tuple(found[2]), tuple(found[3])} <= {RED, BLUE}


def png(size: int) -> Texture:
    return Texture(checker(size), "image/png")


def test_a_texture_is_shown_with_v_up():
    corners = np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1.0]])
    uv = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    material = Material("squares", (1.0, 1.0, 1.0, 1.0), textures={"base_color": png(4)})
    mesh, _ = mesh_of([(corners, faces)], [0, 0], materials=(material,), corner_uv=uv[faces])
    view = render(mesh, Camera.looking_at(np.array([0, -4.0, 0]), np.zeros(3), 2 * np.arctan(0.25), 64, 64))
    assert (view.face >= 0).all()
    squares = (np.indices((64, 64)) // 16).sum(0) % 2
    np.testing.assert_array_equal(view.color[..., 2] > view.color[..., 0], squares == 1)


def test_any_number_of_scenes_may_live() -> None:
    """A process has about a thousand keys for the ray caster's devices."""
    vertices, faces = np.eye(3), np.array([[0, 1, 2]])
    alive = [RayScene(vertices, faces) for _ in range(1100)]
    assert alive[-1].first_hit(np.ones((1, 3)), -np.ones((1, 3))).face[0] == 0
