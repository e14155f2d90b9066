"""The views go round the object, count what is seen, and close-ups show the same points."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.config import ViewsConfig
from anymesh.rendering.raycast_ import RayScene
from anymesh.rendering.render import render
from anymesh.rendering.viewpoints import (
    best_view,
    box_of,
    cameras,
    caption,
    close_up,
    normal_picture,
    part_pixels,
    shown,
    views,
    visible_pixels,
    zoom,
)

CONFIG = ViewsConfig(size=160)


def plate_before_part():
    """A block (part 0), on its front (-y) a button (1), and before that a plate (2) that hides it from the front."""
    pieces = [
        box((-1, 0, -1), (1, 1, 1)),
        box((-0.2, -0.1, -0.2), (0.2, 0, 0.2)),
        box((-0.35, -0.3, -0.35), (0.35, -0.25, 0.35)),
    ]
    mesh, number = mesh_of(pieces)
    return mesh, number


def test_the_cameras_stand_where_the_paper_puts_them():
    mesh, _ = plate_before_part()
    found = cameras(mesh.bounds, CONFIG, 160)
    middle = mesh.bounds.mean(0)
    assert len(found) == 8
    for k, camera in enumerate(found):
        away = camera.T_world_camera[:3, 3] - middle
        assert np.linalg.norm(away) == pytest.approx(mesh.diagonal)
        assert np.arcsin(away[2] / np.linalg.norm(away)) == pytest.approx(np.deg2rad(15))
        azimuth = np.deg2rad(45 * k)  # 0 looks along +y, at the front
        np.testing.assert_allclose(away[:2] / np.linalg.norm(away[:2]), [np.sin(azimuth), -np.cos(azimuth)], atol=1e-9)
        assert camera.fov == pytest.approx(np.deg2rad(60))
        np.testing.assert_allclose(camera.project(middle[None])[0][0], [80, 80])


def test_captions_say_where_a_view_is_from():
    told = [caption(k, CONFIG) for k in range(8)]
    assert told[0] == "view 1: from the front, slightly above"
    assert told[2] == "view 3: from the right, slightly above"
    assert len({t.split(":")[1] for t in told}) == 8
    assert caption(1, ViewsConfig(azimuth_step=90.0, elevation=0.0)) == "view 2: from the right"
    assert caption(2, ViewsConfig(azimuth_step=90.0, elevation=-60.0)) == "view 3: from the back, below"


def test_the_side_that_a_caption_names_is_the_one_that_shows():
    for side, (low, high) in {
        "front": ((0, -0.1, 0), (1, 0, 1)),
        "right": ((1, 0, 0), (1.1, 1, 1)),
        "back": ((0, 1, 0), (1, 1.1, 1)),
        "left": ((-0.1, 0, 0), (0, 1, 1)),
    }.items():
        mesh, number = mesh_of([box((0, 0, 0), (1, 1, 1)), box(low, high)])
        best = best_view(views(mesh, CONFIG, size=80), number, 1)
        assert caption(best, CONFIG) == f"view {best + 1}: from the {side}, slightly above"


def test_what_is_hidden_is_not_counted():
    mesh, part = plate_before_part()
    bare = mesh.subset(part != 2)
    found, free = views(mesh, CONFIG), views(bare, CONFIG)
    assert visible_pixels(free[0], part[part != 2], 1) > 100
    hidden = visible_pixels(found[0], part, 1)
    assert hidden == 0
    assert best_view(found, part, 1) != 0
    assert best_view(free, part[part != 2], 1) == 0
    assert visible_pixels(found[4], part, 1) == 0
    for view in found:
        pixels = [visible_pixels(view, part, k) for k in range(3)]
        assert sum(pixels) == (view.face >= 0).sum()


def test_ties_go_to_the_first_view():
    mesh, part = plate_before_part()
    found = views(mesh, CONFIG, size=40)
    assert best_view([found[3], found[3], found[3]], part, 0) == 0
    assert best_view(found, part, 7) == 0


def test_smooth_colours_change_no_other_buffer_and_nothing_but_edges():
    mesh, _ = plate_before_part()
    camera = cameras(mesh.bounds, CONFIG, 160)[1]
    scene = RayScene(mesh.vertices, mesh.faces)
    plain, smooth = render(mesh, camera, scene=scene), shown(mesh, camera, scene)
    for name in ("depth", "normal", "face"):
        np.testing.assert_array_equal(getattr(plain, name), getattr(smooth, name))
    changed = (plain.color != smooth.color).any(-1)
    assert 0.001 < changed.mean() < 0.05
    levels = (len(np.unique(v.color.reshape(-1, 3), axis=0)) for v in (plain, smooth))
    assert next(levels) < next(levels)


def test_smooth_colours_are_those_of_a_finer_picture():
    mesh, _ = plate_before_part()
    camera = cameras(mesh.bounds, CONFIG, 160)[1]
    fine = render(mesh, cameras(mesh.bounds, CONFIG, 320)[1]).color.reshape(160, 2, 160, 2, 3).mean((1, 3))
    smooth = shown(mesh, camera, RayScene(mesh.vertices, mesh.faces)).color
    assert (np.abs(smooth - fine) > 1).any(-1).mean() < 0.005


def test_normals_are_colours():
    mesh, _ = plate_before_part()
    view = views(mesh, CONFIG)[2]
    found = normal_picture(view)
    np.testing.assert_array_equal(found[view.face < 0], 255)
    np.testing.assert_allclose(found[view.face >= 0] / 127.5 - 1, view.normal[view.face >= 0], atol=0.005)


@pytest.mark.parametrize("number", range(8))
def test_a_close_up_shows_the_same_points_where_it_says(number):
    mesh, part = plate_before_part()
    scene = RayScene(mesh.vertices, mesh.faces)
    view = views(mesh, CONFIG, scene=scene)[number]
    mask = view.face >= 0
    mask[:, :90] = False
    camera = zoom(view.camera, box_of(mask), 0.3, 160)
    near = render(mesh, camera, scene=scene)
    np.testing.assert_array_equal(camera.T_world_camera[:3, 3], view.camera.T_world_camera[:3, 3])
    seen = near.face.ravel() >= 0
    origins, directions = camera.rays()
    points = (origins + near.depth.reshape(-1, 1) * directions)[seen]
    v, u = np.divmod(np.flatnonzero(seen), 160)
    np.testing.assert_allclose(camera.project(points)[0], np.stack([u, v], 1) + 0.5, atol=0.01)
    # the same eye sees the same surface: the far view has it in the pixel where it projects
    pixel = np.floor(view.camera.project(points)[0]).astype(int)
    inside = ((pixel >= 0) & (pixel < 160)).all(1)
    assert inside.any()
    far = view.face[pixel[inside, 1], pixel[inside, 0]]
    assert (part[far] == part[near.face.ravel()[seen][inside]]).mean() > 0.93  # the rest are pixels at edges


@pytest.mark.parametrize("margin", [0.0, 0.3])
def test_a_close_up_holds_the_box_and_its_margin_and_little_else(margin):
    mesh, _ = plate_before_part()
    camera = cameras(mesh.bounds, CONFIG, 160)[1]
    box = np.array([100.0, 40, 130, 60])
    near = zoom(camera, box, margin, 200)
    low, high = box[:2] - margin * np.array([30, 20]), box[2:] + margin * np.array([30, 20])
    corners = np.array([[low[0], low[1]], [high[0], low[1]], [low[0], high[1]], [high[0], high[1]]])
    rays = np.concatenate([(corners - 80) / camera.focal, np.ones((4, 1))], 1) @ camera.T_world_camera[:3, :3].T
    pixel = near.project(camera.T_world_camera[:3, 3] + rays)[0]
    assert pixel.min() > -1e-6
    assert pixel.max() < 200 + 1e-6
    assert np.ptp(pixel, axis=0).max() > 190


def test_small_parts_get_a_close_up_and_others_do_not():
    mesh, part = plate_before_part()
    bare, part = mesh.subset(part != 2), part[part != 2]
    scene = RayScene(bare.vertices, bare.faces)
    view = views(bare, CONFIG, scene=scene)[0]
    covered = visible_pixels(view, part, 1)
    assert close_up(bare, view, part, 1, ViewsConfig(size=160, zoom_below=covered), scene) is None
    assert close_up(bare, view, part, 5, CONFIG, scene) is None
    near = close_up(bare, view, part, 1, ViewsConfig(size=160, zoom_below=covered + 1), scene)
    assert near is not None
    assert near.face.shape == view.face.shape
    assert visible_pixels(near, part, 1) > 4 * covered
    mask = part_pixels(near, part, 1)
    assert not (mask[[0, -1]].any())
    assert not (mask[:, [0, -1]].any())
    # the limit counts pixels of a full-size picture
    small = views(bare, CONFIG, size=80, scene=scene)[0]
    assert close_up(bare, small, part, 1, ViewsConfig(size=160, zoom_below=covered // 2), scene) is None


def test_there_is_no_box_of_nothing():
    with pytest.raises(ValueError, match="at least one pixel"):
        box_of(np.zeros((3, 3), bool))
    mask = np.zeros((9, 9), bool)
    mask[2:4, 5:8] = True
    assert box_of(mask).tolist() == [5, 2, 8, 4]
