"""Candidate points and arrows: each with its number, none covered; and the view that tells arrows apart."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.config import ViewsConfig
from anymesh.geometry.raycast_ import RayScene
from anymesh.prompted.pictures.drawing import DOT, clearest_view, distinctness, draw_arrows, draw_points, labels_apart
from anymesh.rendering.marks import mark_color
from anymesh.rendering.viewpoints import hidden_points, views
from anymesh.types.camera import Camera

GRAY = np.full((640, 640, 3), 128, np.uint8)


def test_labels_are_apart_when_every_two_are():
    pixels = np.array([[0.0, 0], [35, 0], [0, 40]])
    assert labels_apart(pixels, 35.0)
    assert not labels_apart(pixels, 35.1)
    assert labels_apart(pixels[:1], 35.0)
    assert labels_apart(np.zeros((0, 2)), 35.0)


@pytest.mark.parametrize("seed", range(3))
def test_no_plate_covers_a_dot(seed):
    rng = np.random.default_rng(seed)
    pixels = np.array([(x, y) for x in range(200, 420, 36) for y in range(200, 320, 36)]) + rng.uniform(-1, 1, (28, 2))
    drawn = draw_points(GRAY, pixels, range(1, 29))
    for n, (x, y) in enumerate(pixels.astype(int), 1):
        np.testing.assert_array_equal(drawn[y, x], mark_color(n))
        ring = [drawn[y, x + DOT + 1], drawn[y, x - DOT - 1]]
        assert all((r == 255).all() or (r == np.array(mark_color(n)) // 2).all() for r in ring)
    assert drawn.tobytes() == draw_points(GRAY, pixels, range(1, 29)).tobytes()


def test_every_number_is_drawn_on_a_plate_of_its_own_near_its_dot():
    pixels = np.array([[100.0, 100], [300, 120], [638, 638], [2, 320]])
    drawn = draw_points(GRAY, pixels, [3, 8, 11, 20])
    for n, (x, y) in zip([3, 8, 11, 20], pixels, strict=True):
        v, u = np.nonzero((drawn == np.array(mark_color(n))).all(-1))
        assert len(u) > 120  # a dot has about 50 pixels
        assert np.hypot(u - x, v - y).max() < 45


def test_points_outside_are_left_out():
    np.testing.assert_array_equal(draw_points(GRAY, np.array([[-3.0, 5], [700, 700]]), [1, 2]), GRAY)


def frontal(azimuth: float, part_side: float):
    """Eight views of a block whose thin part is on the side with this azimuth [deg], and directions in that side's plane."""
    a = np.deg2rad(azimuth)
    out = np.array([np.sin(a), -np.cos(a), 0])
    along = np.array([np.cos(a), np.sin(a), 0])
    middle = 0.55 * out
    half = np.abs(along) * 0.3 + np.abs(out) * 0.05 + np.array([0, 0, 0.3])
    mesh, number = mesh_of([box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)), box(middle - half, middle + half)])
    up = np.array([0, 0, 1.0])
    directions = np.stack([along, up, -along, -up])
    return views(mesh, ViewsConfig(), size=96), middle + part_side * 0.05 * out, directions, number


@pytest.mark.parametrize("azimuth", [0, 90, 180, 270])
def test_the_chosen_view_sees_the_plane_of_the_arrows_frontally(azimuth):
    found, center, directions, number = frontal(azimuth, 1)
    best = clearest_view(found, center, directions, number, 1)
    assert best == azimuth // 45
    # the opposite view has the arrows as distinct, but the part is hidden there
    behind = distinctness(found[(best + 4) % 8].camera, center, directions)
    assert behind > 0.8 * distinctness(found[best].camera, center, directions)


def test_distinctness_is_the_angle_times_the_length_seen():
    camera = Camera.looking_at(np.array([0, -5.0, 0]), np.zeros(3), 0.6, 100, 100)
    x, y, z = np.eye(3)
    center = np.zeros(3)
    assert distinctness(camera, center, np.stack([x, z, -x, -z])) == pytest.approx(np.pi / 2)
    assert distinctness(camera, center, np.stack([x, -x])) == pytest.approx(np.pi)
    assert distinctness(camera, center, np.stack([x, y])) == pytest.approx(0, abs=1e-6)
    tilted = np.stack([x, (y + z) / np.sqrt(2)])
    assert distinctness(camera, center, tilted) == pytest.approx(np.pi / 2 / np.sqrt(2))
    assert distinctness(camera, center, np.stack([x, (x + z) / np.sqrt(2)])) == pytest.approx(np.pi / 4)


def test_arrows_lie_along_their_directions_with_their_numbers_beyond_the_tips():
    camera = Camera.looking_at(np.array([0, -5.0, 0]), np.zeros(3), 0.6, 640, 640)
    directions = np.stack([np.eye(3)[0], np.eye(3)[2], -np.eye(3)[0], -np.eye(3)[2]])
    drawn = draw_arrows(GRAY, camera, np.zeros(3), directions, [1, 2, 3, 4], 0.6)
    tips = camera.project(0.6 * directions)[0]
    for n, tip in zip([1, 2, 3, 4], tips, strict=True):
        v, u = np.nonzero((drawn == np.array(mark_color(n))).all(-1))
        offset = np.stack([u, v], 1) - 320.0
        along = (tip - 320) / np.linalg.norm(tip - 320)
        assert np.abs(offset @ [-along[1], along[0]]).max() < 18
        assert (offset @ along).min() > 0
        assert np.linalg.norm(tip - 320) + 10 < (offset @ along).max() < np.linalg.norm(tip - 320) + 60
    assert drawn.tobytes() == draw_arrows(GRAY, camera, np.zeros(3), directions, [1, 2, 3, 4], 0.6).tobytes()


def test_an_arrow_that_leaves_the_picture_keeps_its_number():
    camera = Camera.looking_at(np.array([0, -5.0, 0]), np.zeros(3), 0.6, 640, 640)
    drawn = draw_arrows(GRAY, camera, np.zeros(3), np.eye(3)[[0, 1]], [1, 2], 9.0)
    assert (drawn[300:340, 600:] == np.array(mark_color(1))).all(-1).any()
    assert (drawn == np.array(mark_color(2))).all(-1).any()


def test_hidden_points_are_hollow():
    pixels = np.array([[100.0, 100], [300, 120]])
    drawn = draw_points(GRAY, pixels, [1, 2], np.array([False, True]))
    np.testing.assert_array_equal(drawn[100, 100], mark_color(1))
    np.testing.assert_array_equal(drawn[120, 300], (255, 255, 255))
    assert (drawn[118:123, 294:300] == np.array(mark_color(2))).all(-1).any()  # its rim


def test_points_under_a_surface_are_found():
    mesh, _ = mesh_of([box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))])
    camera = Camera.looking_at(np.array([0, -5.0, 0]), np.zeros(3), 0.6, 100, 100)
    points = np.array([[0, -0.6, 0], [0, -0.5, 0], [0, -0.49, 0], [0, 0, 0], [0.9, 0, 0]])
    found = hidden_points(RayScene(mesh.vertices, mesh.faces), camera, points, 0.005)
    assert found.tolist() == [False, False, True, True, False]
