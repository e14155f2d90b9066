"""Strips show the part where its motion takes it; cards say which part is meant."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.config import Config
from anymesh.geometry.raycast_ import RayScene
from anymesh.prompted.pictures import strips
from anymesh.prompted.pictures.drawing import HIGHLIGHT
from anymesh.prompted.pictures.sides import CLEAR, SeenFrom, Sides, emptiest_corner
from anymesh.prompted.pictures.strips import (
    PANEL,
    Posed,
    best_camera,
    grid,
    motion_strip,
    moved,
    silhouette,
    strip_camera,
    strip_poses,
)
from anymesh.prompted.pictures.views import is_beside, views
from anymesh.prompted.pictures.visual_prompts import BAR, card_view, part_card, titled
from anymesh.rendering.render import render
from anymesh.rendering.viewpoints import away
from anymesh.types import JointType, Motion

X, Y, Z = np.eye(3)


def turn(axis, origin) -> Motion:
    return Motion(JointType.REVOLUTE, np.asarray(axis, float), np.asarray(origin, float), "test")


def slide(axis) -> Motion:
    return Motion(JointType.PRISMATIC, np.asarray(axis, float), np.zeros(3), "test")


def door():
    """A block with a door on its front, hinged at either side."""
    mesh, number = mesh_of([box((-0.5, 0, 0), (0.5, 0.6, 1)), box((-0.5, -0.05, 0), (0.5, -0.01, 1))])
    return mesh, number == 1, (turn(-Z, (-0.5, -0.05, 0)), 1.2), (turn(Z, (0.5, -0.05, 0)), 1.2)


def blue(picture: np.ndarray) -> np.ndarray:
    """Where the part is drawn: nothing else has its hue."""
    r, g, b = np.moveaxis(picture.astype(int), -1, 0)
    return (b > 1.5 * g) & (g > 1.2 * r) & (b > 60)


def test_a_moved_mesh_has_its_part_where_the_motion_says():
    mesh, moving, (motion, amount), _ = door()
    T = motion.transform(amount)
    found = moved(mesh, moving, T)
    np.testing.assert_array_equal(found.triangles[~moving], mesh.triangles[~moving])
    np.testing.assert_allclose(found.triangles[moving], mesh.triangles[moving] @ T[:3, :3].T + T[:3, 3])
    back = moved(found, moving, np.linalg.inv(T))
    np.testing.assert_allclose(back.triangles, mesh.triangles, atol=1e-12)


def test_panels_show_the_part_where_the_id_buffer_has_it():
    mesh, moving, *motions = door()
    camera = strip_camera(mesh, moving, motions)
    strip = motion_strip(mesh, moving, motions)
    assert strip.shape == (PANEL, 3 * PANEL, 3)
    poses = [mesh, *(moved(mesh, moving, m.transform(a)) for m, a in motions)]
    for k, pose in enumerate(poses):
        panel = blue(strip[:, k * PANEL : (k + 1) * PANEL])
        view = render(pose, camera)
        expected = (view.face >= 0) & moving[view.face]
        assert expected.sum() > 2000
        axis_and_edges = 0.12 if k else 0.03  # these cover the part in a moved panel
        assert (panel != expected).sum() < axis_and_edges * expected.sum()


def test_the_camera_frames_every_pose_and_tells_them_apart():
    mesh, moving, *motions = door()
    camera = strip_camera(mesh, moving, motions)
    poses = [mesh, *(moved(mesh, moving, m.transform(a)) for m, a in motions)]
    seen = []
    for pose in poses:
        pixel, depth = camera.project(pose.triangles[moving].reshape(-1, 3))
        assert (depth > 0).all()
        assert pixel.min() >= 0
        assert pixel.max() <= PANEL
        view = render(pose, camera)
        seen.append((view.face >= 0) & moving[view.face])
    for k, a in enumerate(seen):
        for b in seen[:k]:
            assert (a != b).sum() > 0.3 * min(a.sum(), b.sum())
    assert camera.T_world_camera[1, 3] < 0  # from the side of the door


def test_a_small_part_is_shown_close_up():
    mesh, number = mesh_of([box((-1, 0, 0), (1, 1, 2)), box((-0.02, -0.03, 1), (0.02, 0, 1.04))])
    strip = motion_strip(mesh, number == 1, [(slide(-Y), 0.02), (turn(Y, (0, 0, 1.02)), 0.7)])
    assert blue(strip[:, :PANEL]).mean() > 0.01  # one part in 3000 of the whole front


def test_a_hidden_part_shines_through():
    mesh, number = mesh_of([box((-1, -1, -1), (1, 1, 1)), box((-0.5, -0.5, -0.2), (0.5, 0.5, 0.2))])
    motions = [(turn(Z, (0, 0, 0)), 0.5)]
    camera = strip_camera(mesh, number == 1, motions, 120)
    rest = motion_strip(mesh, number == 1, motions, camera=camera)[40:119, 1:119].astype(int)
    tinted = rest[..., 2] > rest[..., 0] + 20  # the block is grey
    expected = silhouette(mesh.triangles[number == 1], camera)[40:119, 1:119]
    assert expected.sum() > 500
    assert (tinted != expected).mean() < 0.05


def test_the_arrow_points_the_way_that_the_part_goes():
    mesh, moving, *_ = door()
    camera = strip_camera(mesh, moving, [(slide(-Y), 0.4)], 120)
    there, back, other = (
        motion_strip(mesh, moving, [(slide(axis), amount)], camera=camera) for axis, amount in ((-Y, 0.4), (Y, -0.4), (Y, 0.4))
    )
    np.testing.assert_array_equal(there, back)
    assert (there != other).any()


def test_a_compass_leaves_the_place_where_it_would_cover_an_arrow(monkeypatch: pytest.MonkeyPatch):
    mesh, moving, *motions = door()
    places: list[tuple[bool, bool]] = []
    monkeypatch.setattr(strips, "emptiest_corner", lambda used: emptiest_corner(used) if used.max() > 1 else (True, False))
    monkeypatch.setattr(strips, "with_compass", lambda panel, _, corner: places.append(corner) or panel)
    camera = strip_camera(mesh, moving, motions)
    motion_strip(mesh, moving, [*motions, (slide(-0.6 * X - 0.8 * Z), 0.3)], camera=camera)
    assert places[:3] == [(True, False)] * 3
    assert places[3] != (True, False)  # the arrow goes to the lower left


def test_strips_are_the_same_every_time():
    mesh, moving, *motions = door()
    camera = strip_camera(mesh, moving, motions, 120)
    again = strip_camera(mesh, moving, motions, 120)
    np.testing.assert_array_equal(camera.T_world_camera, again.T_world_camera)
    first, second = (motion_strip(mesh, moving, motions, camera=camera) for _ in range(2))
    assert first.tobytes() == second.tobytes()
    with pytest.raises(ValueError, match="faces that move"):
        motion_strip(mesh, np.zeros_like(moving), motions)


@pytest.mark.parametrize(("count", "shape"), [(1, (1, 1)), (4, (1, 4)), (5, (2, 3)), (7, (2, 4)), (9, (2, 5)), (15, (3, 5))])
def test_panels_fill_even_rows(count, shape):
    cells = [np.full((8, 8, 3), k, np.uint8) for k in range(count)]
    found = grid(cells)
    assert found.shape == (8 * shape[0], 8 * shape[1], 3)
    assert shape[1] <= (4 if count <= 8 else 5)
    order = [found[8 * (k // shape[1]), 8 * (k % shape[1]), 0] for k in range(shape[0] * shape[1])]
    assert order == list(range(count)) + [255] * (shape[0] * shape[1] - count)


def test_a_silhouette_ignores_what_is_before_it():
    mesh, number = mesh_of([box((-1, -1, -1), (1, 1, 1)), box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))])
    camera = views(mesh, Config().directions, size=64)[0].camera
    inner = mesh.subset(number == 1)
    np.testing.assert_array_equal(silhouette(mesh.triangles[number == 1], camera), render(inner, camera).face >= 0)


def card(parts, part):
    mesh, number = mesh_of(parts)
    scene = RayScene(mesh.vertices, mesh.faces)
    view = card_view(views(mesh, Config().directions, size=320, scene=scene), number, part, scene)
    return part_card(mesh, view, number, part, "part 1: knob", scene)


def test_cards_have_a_close_up_only_for_small_parts():
    body = box((-1, -1, -1), (1, 1, 1))
    large = card([body, box((-0.9, -1.1, -0.9), (0.9, -1, 0.9))], 1)
    small = card([body, box((-0.1, -1.1, -0.1), (0.1, -1, 0.1))], 1)
    hidden = card([body, box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))], 1)
    assert large.shape == hidden.shape == (320 + BAR, 320, 3)
    assert small.shape == (320 + BAR, 640, 3)
    for picture in (large, small[:, :320], small[:, 320:], hidden):
        assert (picture[BAR:] == np.array(HIGHLIGHT)).all(-1).sum() > 50
    assert (hidden[:BAR] < 100).sum() > (large[:BAR] < 100).sum()  # its title says more
    assert titled(large, "ä").shape[0] == 320 + 2 * BAR


def test_a_card_is_in_the_view_that_shows_where_the_part_meets_the_rest():
    """A flap on the front (-y): the side views show both of its short edges alike, and each contact is at one of them."""
    mesh, number = mesh_of([box((-1, -1, -1), (1, 1, 1)), box((-0.5, -1.6, -0.5), (0.5, -1.0, 0.5))])
    scene = RayScene(mesh.vertices, mesh.faces)
    both = views(mesh, [(40.0, 15.0), (320.0, 15.0)], size=320, scene=scene)
    pixels = [int((number[v.face] == 1)[v.face >= 0].sum()) for v in both]
    assert min(pixels) > 0.9 * max(pixels)
    across = np.linspace(-0.5, 0.5, 9)
    chosen = []
    for side in (-0.501, 0.501):
        contact = np.stack([np.full(9, side), np.full(9, -1.001), across], 1)
        view = card_view(both, number, 1, scene, contact)
        chosen.append([k for k, other in enumerate(both) if other is view])
    assert sorted(chosen) == [[0], [1]]


def test_poses_are_cast_at_as_if_the_part_had_been_moved():
    mesh, moving, (motion, amount), _ = door()
    posed = Posed(mesh, moving, RayScene(mesh.vertices, mesh.faces))
    T = motion.transform(amount)
    camera = strip_camera(mesh, moving, [(motion, amount)], 90)
    part = posed.part_pixels(T, camera)
    view = render(moved(mesh, moving, T).subset(moving), camera)
    np.testing.assert_array_equal(np.sort(part.pixel), np.flatnonzero(view.face.reshape(-1) >= 0))
    np.testing.assert_allclose(part.distance, view.depth.reshape(-1)[part.pixel], rtol=1e-4)
    np.testing.assert_allclose(part.normal, view.normal.reshape(-1, 3)[part.pixel], atol=1e-4)
    still = posed.still_picture(camera.rays())
    alone = render(mesh.subset(~moving), camera)
    np.testing.assert_allclose(still.distance, alone.depth.reshape(-1), rtol=1e-4)


def test_a_blocked_motion_is_marked_in_its_panel():
    mesh, moving, *motions = door()
    camera = strip_camera(mesh, moving, motions, 160)
    words = (("turns", "turns"), ("turns", "turns (blocked)"))
    plain, marked = (motion_strip(mesh, moving, motions, camera=camera, words=some) for some in words)
    changed = np.argwhere((plain != marked).any(-1))
    assert changed[:, 1].min() > 2 * 160  # the third panel, at its top
    assert changed[:, 0].max() < 60


def test_the_camera_is_on_the_side_of_the_answered_front():
    mesh, moving, *motions = door()
    for front in (0.0, 90.0, 250.0):
        posed, poses = strip_poses(mesh, moving, motions)
        camera = best_camera(posed, poses, motions, 60, SeenFrom(sides=Sides(front)))
        assert is_beside(camera.T_world_camera[:3, 3] - mesh.bounds.mean(0), away(np.deg2rad(front), 0.0))
    strip = motion_strip(mesh, moving, motions, seen_from=SeenFrom(sides=Sides(0.0)))
    compass = (strip == CLEAR).all(-1)
    assert all(compass[:, k * PANEL : (k + 1) * PANEL].sum() > 5000 for k in range(3))  # one in each panel
