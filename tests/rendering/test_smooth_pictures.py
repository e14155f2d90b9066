"""Drawings: outlines and creases are where the surface changes, and show on white, black and textured objects."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from assets import QUAD_UV, box, checker, mesh_of
from scipy.ndimage import binary_erosion

from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.drawing import (
    BRIGHTNESS,
    CREASE_ANGLE,
    GRID,
    Window,
    draw,
    face_colors,
    ground,
    light_on,
    material_colors,
    render_target,
    sample,
    smoothed,
    stroke,
)
from anymesh.rendering.render import KEY_LIGHT, texels_per_pixel
from anymesh.types import Material, Mesh, Texture
from anymesh.types.camera import Camera

SIZE = 120
VISIBLE = 40  # least difference in brightness (0..255) along a silhouette
CAMERA = Camera.looking_at(np.array([2.2, -3.0, 2.0]), np.zeros(3), 0.5, SIZE, SIZE)
WHOLE = Window(0, 0, SIZE, SIZE)


def samples_of(mesh: Mesh, camera: Camera = CAMERA):
    return sample(render_target(mesh, RayScene(mesh.vertices, mesh.faces), np.zeros(len(mesh.faces), int)), camera, WHOLE)


def picture(mesh: Mesh) -> np.ndarray:
    samples = samples_of(mesh)
    return draw(samples, material_colors(mesh, samples), light_on(samples), ground(SIZE, SIZE))


def painted(pieces, grey: float) -> Mesh:
    mesh = mesh_of(pieces)[0]
    material = Material("paint", (grey, grey, grey, 1.0))
    return replace(mesh, face_material=np.zeros(len(mesh.faces), int), materials=(material,))


def cube(grey: float) -> Mesh:
    return painted([box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))], grey)


def prism(sides: int) -> Mesh:
    """An upright cylinder of so many sides, with caps."""
    turn = 2 * np.pi * np.arange(sides) / sides
    ring = 0.5 * np.stack([np.cos(turn), np.sin(turn)], 1)
    ends = [np.c_[ring, np.full(sides, height)] for height in (-0.5, 0.5)]
    vertices = np.concatenate([*ends, [[0, 0, -0.5], [0, 0, 0.5]]])
    a, b = np.arange(sides), (np.arange(sides) + 1) % sides
    low, high = np.full(sides, 2 * sides), np.full(sides, 2 * sides + 1)
    faces = [(a, b, b + sides), (a, b + sides, a + sides), (b, a, low), (a + sides, b + sides, high)]
    return painted([(vertices, np.concatenate([np.stack(f, 1) for f in faces]))], 0.5)


def sphere(rings: int) -> Mesh:
    """A sphere of 4 * rings**2 faces or so."""
    polar, turn = np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1)
    p, t = np.meshgrid(polar, turn, indexing="ij")
    vertices = 0.5 * np.stack([np.sin(p) * np.cos(t), np.sin(p) * np.sin(t), np.cos(p)], -1).reshape(-1, 3)
    i, j = (a.reshape(-1) for a in np.mgrid[:rings, : 2 * rings])
    first = i * (2 * rings + 1) + j
    below = first + 2 * rings + 1
    faces = np.concatenate([np.stack([first, below, below + 1], 1), np.stack([first, below + 1, first + 1], 1)])
    return painted([(vertices, faces)], 0.5)


def creased_rays(mesh: Mesh) -> int:
    return int((samples_of(mesh).steps.crease > 0).sum())


def test_white_is_not_darker_where_the_light_is_strongest() -> None:
    """The light on a surface that faces the lamp is more than 1."""
    mesh = replace(sphere(24), materials=(Material("white", (1.0, 1.0, 1.0, 1.0)),))
    from_the_lamp = Camera.looking_at(3 * KEY_LIGHT, np.zeros(3), 0.5, SIZE, SIZE)
    samples = samples_of(mesh, from_the_lamp)
    seen = RayScene(mesh.vertices, mesh.faces).first_hit(*from_the_lamp.rays()).face.reshape(SIZE, SIZE) >= 0
    assert light_on(samples).max() > 1
    drawn = draw(samples, material_colors(mesh, samples), light_on(samples), ground(SIZE, SIZE))
    assert drawn[binary_erosion(seen, iterations=3)].min() > 100


@pytest.mark.parametrize("grey", [0.0, 0.2, 0.6, 1.0])
def test_the_silhouette_is_seen_whatever_the_colour(grey):
    mesh = cube(grey)
    bright = picture(mesh) @ BRIGHTNESS
    face = RayScene(mesh.vertices, mesh.faces).first_hit(*CAMERA.rays()).face.reshape(SIZE, SIZE)
    seen = face >= 0
    edge = np.argwhere(seen[:, 1:] != seen[:, :-1])
    assert len(edge) > SIZE / 2
    for row, column in edge:  # the darkest pixel at the border against the ground three pixels outside
        outside = column - 2 if seen[row, column + 1] else column + 3
        assert bright[row, outside] - bright[row, column - 1 : column + 3].min() > VISIBLE


@pytest.mark.parametrize("grey", [0.0, 1.0])
def test_creases_are_seen_where_faces_meet_at_a_sharp_angle(grey):
    mesh = cube(grey)
    bright = picture(mesh) @ BRIGHTNESS
    near, low = CAMERA.project(np.array([[0.5, -0.5, 0.5], [0.5, -0.5, -0.5]]))[0]
    for share in np.linspace(0.2, 0.8, 7):
        x, y = (near + share * (low - near)).astype(int)
        across = bright[y, x - 6 : x + 7]
        line, sides = across[4:9], across[[0, -1]]
        assert (line.max() > sides.max() + 30) if grey == 0 else (line.min() < sides.min() - 5)


def test_sharp_edges_have_creases_and_smooth_surfaces_have_none():
    assert creased_rays(cube(0.5)) > SIZE
    assert creased_rays(sphere(60)) == 0
    assert creased_rays(smoothed(sphere(16))) == 0
    rim = creased_rays(smoothed(prism(16)))
    assert 0 < rim < 4 * GRID * SIZE
    assert creased_rays(smoothed(prism(6))) > 1.5 * rim, "sides that meet at 60 degrees"


def test_lines_do_not_depend_on_the_unit():
    mesh = painted([box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)), box((-0.2, -0.55, -0.2), (0.2, -0.5, 0.2))], 0.7)
    far = replace(mesh, vertices=1000 * mesh.vertices)
    moved = CAMERA.T_world_camera.copy()
    moved[:3, 3] *= 1000
    near, scaled = samples_of(mesh), samples_of(far, replace(CAMERA, T_world_camera=moved))
    assert abs(len(near.steps.pairs) - len(scaled.steps.pairs)) < 0.02 * len(near.steps.pairs)


def test_a_step_has_an_outline_and_what_lies_in_one_plane_has_none():
    wall = box((-0.5, 0, -0.5), (0.5, 0.1, 0.5))
    camera = Camera.looking_at(np.array([0.0, -3, 0]), np.zeros(3), 0.5, SIZE, SIZE)
    pixel = 3 * 2 * np.tan(0.25) / SIZE

    def outlined(depth: float) -> float:
        mesh = painted([wall, box((-0.2, -depth, -0.2), (0.2, 0.05, 0.2))], 0.7)
        samples = samples_of(mesh, camera)
        both = (samples.hits.face[samples.steps.pairs] >= 0).all(1)
        return float(samples.steps.outline[both].sum())

    assert outlined(1e-6) == 0
    assert outlined(3 * pixel) > 4 * 0.4 / pixel * GRID * 0.9
    assert outlined(1.0 * pixel) < outlined(3 * pixel)


def test_edges_are_smooth_and_cover_their_area():
    """Brightness summed over the picture is the projected area, to a thousandth."""
    corners = np.array([[-0.61, 0, -0.43], [0.53, 0, -0.57], [0.11, 0, 0.71]])
    mesh = painted([(corners, np.array([[0, 1, 2]]))], 1.0)
    camera = Camera.looking_at(np.array([0.0, -3, 0]), np.zeros(3), 0.7, SIZE, SIZE)
    samples = samples_of(mesh, camera)
    color = np.repeat((samples.hits.face >= 0).astype(np.float32)[:, None], 3, 1)
    covered = samples.resolve(color, np.zeros((SIZE, SIZE, 3), np.float32))[..., 0]
    (ax, ay), (bx, by), (cx, cy) = camera.project(corners)[0]
    area = abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2
    assert covered.sum() == pytest.approx(area, rel=1e-3)
    assert len(np.unique(np.round(covered, 3))) > 5


def test_faces_of_two_colours_meet_in_a_smooth_edge():
    mesh = painted([box((-0.5, 0, -0.5), (0.5, 0.1, 0.5))], 0.5)
    camera = Camera.looking_at(np.array([0.0, -3, 0]), np.zeros(3), 0.5, SIZE, SIZE)
    colors = np.tile(np.array([[200, 60, 60], [60, 60, 200]], np.uint8), (6, 1))
    subject = render_target(mesh, RayScene(mesh.vertices, mesh.faces), np.arange(12))
    samples = sample(subject, camera, WHOLE)
    drawn = draw(samples, face_colors(colors, samples), light_on(samples), ground(SIZE, SIZE))
    inner = drawn[SIZE // 2 - 20 : SIZE // 2 + 20, SIZE // 2 - 20 : SIZE // 2 + 20].reshape(-1, 3)
    assert len(np.unique(inner, axis=0)) > 2
    assert len(samples.steps.pairs[samples.steps.crease > 0]) == 0


def test_shading_normals_of_a_cylinder_point_away_from_its_axis():
    mesh = smoothed(prism(24))
    assert mesh.corner_normal is not None
    side = np.abs(mesh.face_normals[:, 2]) < 0.5
    radial = mesh.triangles[side] * [1, 1, 0]
    radial /= np.linalg.norm(radial, axis=2, keepdims=True)
    assert np.einsum("fkc,fkc->fk", mesh.corner_normal[side], radial).min() > 0.999
    np.testing.assert_allclose(np.abs(mesh.corner_normal[~side, :, 2]), 1, atol=1e-6)
    assert smoothed(cube(0.5)).corner_normal is None
    assert 2 * np.pi / 6 > CREASE_ANGLE
    assert smoothed(prism(6)).corner_normal is None


def test_rays_for_pictures_meet_what_other_rays_meet():
    mesh = sphere(8)
    scene = RayScene(mesh.vertices, mesh.faces)
    origins, directions = CAMERA.rays()
    exact, found = scene.first_hit(origins, directions), scene.surface_hits(origins[0], directions.astype(np.float32))
    np.testing.assert_array_equal(found.face, exact.face)
    seen = exact.face >= 0
    np.testing.assert_allclose(found.depth[seen], exact.distance[seen], rtol=1e-5)
    normal = mesh.face_normals[exact.face[seen]]
    np.testing.assert_allclose(np.abs(np.einsum("ij,ij->i", found.normal[seen], normal)), 1, atol=1e-5)
    assert (np.einsum("ij,ij->i", found.normal[seen], directions[seen]) < 0).all()
    assert np.isinf(found.depth[~seen]).all()
    assert (found.normal[~seen] == 0).all()
    across, down = CAMERA.ray_grid(np.arange(SIZE) + 0.5, np.arange(SIZE) + 0.5)
    np.testing.assert_allclose((down[:, None] + across).reshape(-1, 3), directions, atol=1e-6)


@pytest.mark.parametrize(("texels", "times"), [(32, 1), (512, 1), (32, 1e6)])
def test_a_fine_texture_is_averaged_to_the_pixels(texels, times):
    corners = np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1.0]])
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    material = Material("squares", (1.0, 1.0, 1.0, 1.0), textures={"base_color": Texture(checker(texels), "image/png")})
    mesh, _ = mesh_of([(corners, faces)], [0, 0], materials=(material,), corner_uv=QUAD_UV * np.float32(times))
    camera = Camera.looking_at(np.array([0, -4.0, 0]), np.zeros(3), 2 * np.arctan(0.25), SIZE, SIZE)
    samples = samples_of(mesh, camera)
    found = texels_per_pixel(mesh, samples.hits, samples.pairs_beside())
    assert found == {0: int(np.clip(round(times * texels / SIZE), 1, texels))}
    assert (np.ptp(material_colors(mesh, samples)[: len(samples.plain)], axis=0).max() > 100) == (times * texels < SIZE)


def test_where_strokes_meet_the_strongest_counts():
    drawn = stroke((5, 7), np.array([16, 18, 16]), np.array([90, 200, 120], np.uint8), 1)
    np.testing.assert_array_equal(drawn[2], [0, 120, 120, 200, 200, 200, 0])
    np.testing.assert_array_equal(drawn[1], [0, 0, 120, 0, 200, 0, 0])
    assert not drawn[[0, 4]].any()


def test_a_surface_that_no_ray_meets_leaves_the_ground_as_it_is():
    speck = painted([box((50, 50, 50), (50.001, 50.001, 50.001))], 0.5)
    np.testing.assert_allclose(picture(speck), ground(SIZE, SIZE), atol=0.51)


def test_a_surface_with_cracks_is_shaded_like_one_without() -> None:
    whole = sphere(12)
    normal = smoothed(whole).corner_normal
    corners = whole.triangles.reshape(-1, 3)
    moved = corners + np.random.default_rng(0).uniform(-5e-6, 5e-6, corners.shape) * whole.diagonal
    cracked = smoothed(replace(whole, vertices=moved, faces=np.arange(len(corners)).reshape(-1, 3)))
    assert normal is not None
    assert cracked.corner_normal is not None
    seen = whole.face_areas > 1e-4 * whole.face_areas.max()  # at the poles are faces without area, which divide the others
    along = (cracked.corner_normal * normal).sum(2)[seen]
    assert along.min() > 0.98
    assert np.median(along) > 0.9999


PROGRAM = """
import hashlib
import numpy as np
from test_smooth_pictures import CAMERA, SIZE, samples_of, sphere
from anymesh.prompted.pictures.views import headlight_on
from anymesh.rendering.drawing import draw, ground, light_on, material_colors
from anymesh.rendering.render import lit
from anymesh.rendering.drawing import smoothed

mesh = smoothed(sphere(40))
samples = samples_of(mesh)
base = material_colors(mesh, samples)
lights = light_on(samples), headlight_on(samples, CAMERA), lit(base, samples.normal)
pictures = [samples.resolve(base * light[:, None], ground(SIZE, SIZE)) for light in lights[:2]]
pictures.append(draw(samples, base, lights[1], ground(SIZE, SIZE)))
for array in (*lights, *pictures):
    print(hashlib.sha256(array.tobytes()).hexdigest())
"""


@pytest.mark.skipif(sys.platform != "linux", reason="NumPy's BLAS elsewhere may have one kernel")
def test_light_and_pictures_are_the_same_with_each_kernel_of_blas() -> None:
    """`OPENBLAS_CORETYPE` chooses the kernel that older processors use, whose sums differ in their last bits."""
    hashes = []
    for kernel in ("", "Sandybridge", "Nehalem"):
        environment = {
            **os.environ,
            "OPENBLAS_CORETYPE": kernel,
            "PYTHONPATH": os.pathsep.join([str(Path(__file__).parent), *sys.path]),
        }
        run = subprocess.run([sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True, check=True)
        hashes.append(run.stdout.split())
    assert len(hashes[0]) == 6
    assert hashes[0] == hashes[1] == hashes[2]
