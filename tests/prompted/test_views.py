"""The views go round the object, count what is seen, and close-ups show the same points."""

from dataclasses import replace

import numpy as np
import pytest
from assets import box, mesh_of
from scipy import ndimage

from anymesh.config import PAPER_VIEWS, Config
from anymesh.errors import OptionError
from anymesh.geometry.raycast_ import RayScene
from anymesh.prompted.pictures import views as pictures
from anymesh.prompted.pictures.views import (
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
)
from anymesh.prompted.pictures.visual_prompts import inside_views
from anymesh.rendering.render import render
from anymesh.rendering.viewpoints import zoom

CONFIG = Config()


def plate_before_part():
    """A block (part 0), on its front (-y) a button (1), and before that a plate (2) that hides it from the front."""
    pieces = [
        box((-1, 0, -1), (1, 1, 1)),
        box((-0.2, -0.1, -0.2), (0.2, 0, 0.2)),
        box((-0.35, -0.3, -0.35), (0.35, -0.25, 0.35)),
    ]
    mesh, number = mesh_of(pieces)
    return mesh, number


def test_the_cameras_stand_where_the_paper_puts_them_and_the_object_fills_each_picture():
    mesh, _ = plate_before_part()
    found = cameras(mesh, replace(CONFIG, viewpoints=PAPER_VIEWS).directions, 160)
    middle = mesh.bounds.mean(0)
    assert len(found) == 8
    for k, camera in enumerate(found):
        away = camera.T_world_camera[:3, 3] - middle
        assert np.linalg.norm(away) == pytest.approx(mesh.diagonal)
        assert np.arcsin(away[2] / np.linalg.norm(away)) == pytest.approx(np.deg2rad(15))
        azimuth = np.deg2rad(45 * k)  # 0 looks along +y
        np.testing.assert_allclose(away[:2] / np.linalg.norm(away[:2]), [np.sin(azimuth), -np.cos(azimuth)], atol=1e-9)
        pixel = camera.project(mesh.vertices)[0]
        assert pixel.min() >= 0
        assert pixel.max() <= 160
        assert np.ptp(pixel, axis=0).max() > 0.9 * 160


def test_tops_and_undersides_are_seen():
    mesh, number = mesh_of([box((0, 0, 0), (1, 1, 2)), box((0, 0, 2), (1, 1, 2.01)), box((0, 0, -0.01), (1, 1, 0))])
    for part in (1, 2):
        shares = [visible_pixels(v, number, part) / 160**2 for v in views(mesh, CONFIG.directions, size=160)]
        assert max(shares[8:]) > 0.05
        assert max(shares[:8]) < 0.02  # from 15 degrees up the eye is below the top


def test_captions_say_where_a_view_is_from():
    assert caption(0.0, 15.0) == "turned by 0 degrees, 15 degrees up"  # the front is not known
    told = [caption(azimuth, elevation, 0.0) for azimuth, elevation in CONFIG.directions]
    assert told[0] == "from the front, 15 degrees up"
    assert told[2] == "from the right, 15 degrees up"
    assert told[8] == "from the front right, from above (50 degrees up)"
    assert told[10] == "from the front right, from below (35 degrees down)"
    assert len(set(told)) == len(told) == 11
    assert caption(90.0, 0.0, 0.0) == "from the right, level"
    assert caption(90.0, 15.0, 90.0) == "from the front, 15 degrees up"
    assert caption(0.0, 15.0, 90.0) == "from the left, 15 degrees up"


def test_the_side_that_a_caption_names_is_the_one_that_shows():
    for side, (low, high) in {
        "front": ((0, -0.1, 0), (1, 0, 1)),
        "right": ((1, 0, 0), (1.1, 1, 1)),
        "back": ((0, 1, 0), (1, 1.1, 1)),
        "left": ((-0.1, 0, 0), (0, 1, 1)),
    }.items():
        mesh, number = mesh_of([box((0, 0, 0), (1, 1, 1)), box(low, high)])
        best = best_view(views(mesh, CONFIG.directions, size=80), number, 1)
        assert caption(*CONFIG.directions[best], 0.0) == f"from the {side}, 15 degrees up"


@pytest.mark.parametrize("told", ["", "8", "8@", "@15", "8@100", "0@15", "8@15;2@50", "99@0", "8@15, 2@50", "8@15+", "-1@0"])
def test_viewpoints_that_are_not_valid_are_told(told):
    with pytest.raises(OptionError, match="--viewpoints: found"):
        Config(viewpoints=told)


def test_viewpoints_are_rings():
    found = Config(viewpoints="2@50+30,1@-35").directions
    assert found == ((30.0, 50.0), (210.0, 50.0), (0.0, -35.0))


def test_what_is_hidden_is_not_counted():
    mesh, part = plate_before_part()
    bare = mesh.subset(part != 2)
    found, free = views(mesh, CONFIG.directions, size=160), views(bare, CONFIG.directions, size=160)
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
    found = views(mesh, CONFIG.directions, size=40)
    assert best_view([found[3], found[3], found[3]], part, 0) == 0
    assert best_view(found, part, 7) == 0


def test_a_drawn_view_has_the_exact_buffers():
    mesh, _ = plate_before_part()
    camera = cameras(mesh, CONFIG.directions, 160)[1]
    scene = RayScene(mesh.vertices, mesh.faces)
    plain, drawn = render(mesh, camera, scene=scene), shown(mesh, camera, scene)
    same = plain.face == drawn.face
    assert same.mean() > 0.999
    seen = same & (plain.face >= 0)
    np.testing.assert_allclose(drawn.depth[seen], plain.depth[seen], rtol=1e-4)
    np.testing.assert_allclose(drawn.normal[seen], plain.normal[seen], atol=1e-4)


def test_edges_are_lines_and_every_side_is_bright():
    mesh, _ = plate_before_part()
    for view in views(mesh, CONFIG.directions, size=160):
        gray = view.color.mean(-1)
        bare = np.abs(np.diff(view.face, axis=1, append=-2)) + np.abs(np.diff(view.face, axis=0, append=-2)) == 0
        inner = ndimage.binary_erosion(bare & (view.face >= 0), iterations=2)
        assert gray[inner].min() > 80  # also from behind and from below
        rim = (view.face >= 0) & ~ndimage.binary_erosion(view.face >= 0)
        assert np.median(gray[rim]) < 0.8 * np.median(gray[inner])
        assert (view.color[view.face < 0] == 255).mean() > 0.9


def test_the_inside_is_drawn_alone_over_a_ghost():
    mesh, part = mesh_of([box((0, 0, 0), (1, 1, 1)), box((0.3, 0.3, 0.3), (0.6, 0.6, 0.6))])
    camera = cameras(mesh, CONFIG.directions, 160)[1]
    (view,) = inside_views(mesh, part == 1, [camera], RayScene(mesh.vertices, mesh.faces))
    seen = view.face >= 0
    assert set(part[view.face[seen]]) == {1}
    pixel = camera.project(np.array([[0.45, 0.45, 0.45]]))[0][0].astype(int)
    assert seen[pixel[1], pixel[0]]
    ghost = view.color[~seen].mean(-1)
    assert ghost.min() > 150
    assert (ghost < 250).mean() > 0.2


def test_normals_are_colours():
    mesh, _ = plate_before_part()
    view = views(mesh, CONFIG.directions, size=160)[2]
    found = normal_picture(view)
    np.testing.assert_array_equal(found[view.face < 0], 255)
    np.testing.assert_allclose(found[view.face >= 0] / 127.5 - 1, view.normal[view.face >= 0], atol=0.005)


@pytest.mark.parametrize("number", range(8))
def test_a_close_up_shows_the_same_points_where_it_says(number):
    mesh, part = plate_before_part()
    scene = RayScene(mesh.vertices, mesh.faces)
    view = views(mesh, CONFIG.directions, size=160, scene=scene)[number]
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
    camera = cameras(mesh, CONFIG.directions, 160)[1]
    box = np.array([100.0, 40, 130, 60])
    near = zoom(camera, box, margin, 200)
    low, high = box[:2] - margin * np.array([30, 20]), box[2:] + margin * np.array([30, 20])
    corners = np.array([[low[0], low[1]], [high[0], low[1]], [low[0], high[1]], [high[0], high[1]]])
    rays = np.concatenate([(corners - 80) / camera.focal, np.ones((4, 1))], 1) @ camera.T_world_camera[:3, :3].T
    pixel = near.project(camera.T_world_camera[:3, 3] + rays)[0]
    assert pixel.min() > -1e-6
    assert pixel.max() < 200 + 1e-6
    assert np.ptp(pixel, axis=0).max() > 190


def test_small_parts_get_a_close_up_and_others_do_not(monkeypatch):
    mesh, part = plate_before_part()
    bare, part = mesh.subset(part != 2), part[part != 2]
    scene = RayScene(bare.vertices, bare.faces)
    view = views(bare, CONFIG.directions, size=160, scene=scene)[0]
    covered = visible_pixels(view, part, 1)
    monkeypatch.setattr(pictures, "MIN_PART_PIXELS", 16 * covered)
    assert close_up(bare, view, part, 1, scene) is None
    assert close_up(bare, view, part, 5, scene) is None
    monkeypatch.setattr(pictures, "MIN_PART_PIXELS", 16 * (covered + 1))
    near = close_up(bare, view, part, 1, scene)
    assert near is not None
    assert near.face.shape == view.face.shape
    assert visible_pixels(near, part, 1) > 4 * covered
    mask = part_pixels(near, part, 1)
    assert not (mask[[0, -1]].any())
    assert not (mask[:, [0, -1]].any())
    # the limit counts pixels of a full-size picture
    small = views(bare, CONFIG.directions, size=80, scene=scene)[0]
    monkeypatch.setattr(pictures, "MIN_PART_PIXELS", 8 * covered)
    assert close_up(bare, small, part, 1, scene) is None


def test_there_is_no_box_of_nothing():
    with pytest.raises(ValueError, match="at least one pixel"):
        box_of(np.zeros((3, 3), bool))
    mask = np.zeros((9, 9), bool)
    mask[2:4, 5:8] = True
    assert box_of(mask).tolist() == [5, 2, 8, 4]
