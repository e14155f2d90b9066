"""Numbers sit on what they number, and none covers another."""

import io

import numpy as np
import pytest
from assets import box, mesh_of
from PIL import Image

from anymesh.config import Config
from anymesh.geometry.raycast_ import RayScene
from anymesh.prompted.pictures.drawing import (
    DOT,
    clearest_view,
    distinctness,
    draw_arrows,
    draw_marks,
    draw_points,
    highlight,
    labels_apart,
    mark_positions,
)
from anymesh.prompted.pictures.plates import beside, contrast, mark_color, plate_size, window_sums
from anymesh.prompted.pictures.sheet import question_sheet
from anymesh.prompted.pictures.views import hidden_points, views
from anymesh.rendering.marks import rim
from anymesh.types import Picture
from anymesh.types.camera import Camera

SIZE = 640
X, Y = np.meshgrid(np.arange(SIZE), np.arange(SIZE))


def voronoi(seed: int, count: int, radius: float = 1e9) -> np.ndarray:
    """A map of regions within a disc; -1 outside."""
    rng = np.random.default_rng(seed)
    seeds = rng.uniform(0, SIZE, (count, 2)) if radius > SIZE else rng.uniform(320 - radius, 320 + radius, (count, 2))
    nearest, label = np.full((SIZE, SIZE), np.inf), np.zeros((SIZE, SIZE), int)
    for k, (x, y) in enumerate(seeds):
        gap = np.hypot(X - x, Y - y)
        label[gap < nearest] = k
        nearest = np.minimum(nearest, gap)
    return np.where(np.hypot(X - 320, Y - 320) < radius, label, -1)


def overlaps(a, b) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


@pytest.mark.parametrize("seed", range(5))
def test_boxes_are_disjoint_and_anchors_lie_in_their_regions(seed):
    labels = voronoi(seed, 40)
    plates = mark_positions(labels)
    assert sorted(plates) == np.unique(labels).tolist()
    boxes = [p.box for p in plates.values()]
    assert not any(overlaps(a, b) for k, a in enumerate(boxes) for b in boxes[:k])
    for number, plate in plates.items():
        x0, y0, x1, y1 = plate.box
        assert x0 >= 0
        assert y0 >= 0
        assert max(x1, y1) <= SIZE
        assert labels[plate.anchor[1], plate.anchor[0]] == number
        assert plate.text == str(number)
        if not plate.led:
            assert (labels[y0:y1, x0:x1] == number).mean() > 0.65
    assert sum(p.led for p in plates.values()) <= 4


def test_sixty_regions_in_a_small_disc_get_a_leader_each_or_room():
    labels = voronoi(7, 60, 100)
    plates = mark_positions(labels)
    boxes = [p.box for p in plates.values()]
    assert len(boxes) > 50
    assert not any(overlaps(a, b) for k, a in enumerate(boxes) for b in boxes[:k])
    led = [p for p in plates.values() if p.led]
    assert led
    assert all(labels[p.anchor[1], p.anchor[0]] == int(p.text) for p in plates.values())


def test_the_number_of_a_disc_is_at_its_centre():
    labels = np.where(np.hypot(X - 200, Y - 411) <= 60, 5, -1)
    assert mark_positions(labels)[5].anchor == (200, 411)
    x0, y0, x1, y1 = mark_positions(labels)[5].box
    assert abs((x0 + x1) / 2 - 200) <= 1
    assert abs((y0 + y1) / 2 - 411) <= 1


def test_the_number_of_a_long_region_is_in_its_middle():
    labels = np.where((X >= 40) & (X < 601) & (Y >= 300) & (Y < 341), 1, -1)
    assert mark_positions(labels)[1].anchor == (320, 320)


def test_the_number_of_a_ring_is_on_the_ring():
    gap = np.hypot(X - 320, Y - 320)
    labels = np.where((gap < 200) & (gap > 150), 3, -1)
    plate = mark_positions(labels)[3]
    assert not plate.led
    assert labels[plate.anchor[1], plate.anchor[0]] == 3


def test_a_number_that_does_not_fit_is_beside():
    labels = np.where((X >= 300) & (X < 306) & (Y >= 300) & (Y < 306), 12, -1)
    plate = mark_positions(labels)[12]
    assert plate.led
    assert labels[plate.anchor[1], plate.anchor[0]] == 12
    assert np.hypot(*(np.array(plate.end) - plate.anchor)) < 25
    x0, y0, x1, y1 = plate.box
    assert (labels[y0:y1, x0:x1] == -1).all()


def test_a_small_region_keeps_its_place_in_a_larger_one():
    """The larger region's number gives way, even where its own middle is."""
    gap = np.hypot(X - 320, Y - 320)
    labels = np.where(gap < 200, 2, -1)
    labels[gap < 14] = 1
    plates = mark_positions(labels)
    assert plates[1].anchor == (320, 320)
    assert not overlaps(plates[1].box, plates[2].box)
    assert not plates[2].led


def test_only_the_numbers_that_are_asked_for_are_drawn():
    labels = voronoi(1, 12)
    assert sorted(mark_positions(labels, [3, 7])) == [3, 7]
    image = np.full((SIZE, SIZE, 3), 200, np.uint8)
    drawn = draw_marks(image, labels, [3], alpha=0.1)
    changed = (drawn != image).any(-1)
    assert (labels[changed] == 3).all()
    np.testing.assert_array_equal(draw_marks(image, labels, [], alpha=0.1), image)
    np.testing.assert_array_equal(draw_marks(image, np.full_like(labels, -1), alpha=0.1), image)


def test_fills_are_translucent_in_the_marks_colour_and_outlines_are_opaque():
    labels = np.where(np.hypot(X - 320, Y - 320) < 150, 4, -1)
    image = np.full((SIZE, SIZE, 3), 100, np.uint8)
    drawn = draw_marks(image, labels, alpha=0.25)
    np.testing.assert_allclose(drawn[400, 320], 75 + 0.25 * np.array(mark_color(4)), atol=1)
    np.testing.assert_array_equal(drawn[320, 171], mark_color(4))
    np.testing.assert_array_equal(drawn[labels < 0], 100)


def test_the_same_marks_give_the_same_bytes():
    labels, image = voronoi(2, 40), np.full((SIZE, SIZE, 3), 180, np.uint8)
    before = image.copy()
    assert draw_marks(image, labels, alpha=0.1).tobytes() == draw_marks(image, labels, alpha=0.1).tobytes()
    np.testing.assert_array_equal(image, before)


def test_near_numbers_have_unlike_colours_and_text_stands_out():
    colors = np.array([mark_color(n) for n in range(60)])
    gaps = np.linalg.norm(colors[:, None] - colors[None], axis=2)
    assert gaps[np.triu_indices(60, 1)].min() > 5
    for n in range(58):
        assert gaps[n, n + 1 : n + 3].min() > 60
    gray = [0.299, 0.587, 0.114]
    assert all(abs(np.dot(gray, mark_color(n)) - np.dot(gray, contrast(mark_color(n)))) > 100 for n in range(60))


def test_a_numbers_ink_lies_on_its_plate():
    labels = np.where(np.hypot(X - 320, Y - 320) < 150, 88, -1)
    drawn = draw_marks(np.full((SIZE, SIZE, 3), 127, np.uint8), labels, alpha=0.0)
    x0, y0, x1, y1 = mark_positions(labels)[88].box
    inner = np.abs(drawn[y0 + 1 : y1 - 1, x0 + 1 : x1 - 1].astype(int) - np.array(mark_color(88))).sum(-1) > 100
    rows, columns = np.flatnonzero(inner.any(1)), np.flatnonzero(inner.any(0))
    height, width = inner.shape
    assert len(rows) > 0.5 * height
    assert min(rows[0], columns[0], height - 1 - rows[-1], width - 1 - columns[-1]) >= 1


def test_sums_over_windows():
    weights = np.random.default_rng(0).uniform(size=(7, 9))
    found = window_sums(weights, 3, 2)
    assert found.shape == (6, 7)
    assert found[4, 5] == pytest.approx(weights[4:6, 5:8].sum())
    assert found[0, 0] == pytest.approx(weights[:2, :3].sum())


def test_a_plate_without_room_still_lands_in_the_picture():
    used = np.ones((60, 80), bool)
    x0, y0, x1, y1 = beside("8", 15, (40, 30), used, np.zeros((60, 80)), 6).box
    assert (x1 - x0, y1 - y0) == plate_size("8", 15)
    assert 0 <= x0 < x1 <= 80
    assert 0 <= y0 < y1 <= 60


def test_a_highlight_leaves_the_rest_alone():
    image = np.asarray(Image.effect_noise((SIZE, SIZE), 30).convert("RGB"))
    mask = np.hypot(X - 320, Y - 320) < 50
    found = highlight(image, mask)
    changed = (found != image).any(-1)
    assert not (changed & ~mask & ~rim(mask, 6)).any()
    assert changed[mask].mean() > 0.95
    np.testing.assert_array_equal(highlight(image, np.zeros_like(mask)), image)


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
    return views(mesh, Config().directions, size=96), middle + part_side * 0.05 * out, directions, number


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


def plain(color: tuple[int, int, int], size: tuple[int, int], caption: str = "") -> Picture:
    buffer = io.BytesIO()
    Image.new("RGB", size, color).save(buffer, "PNG")
    return Picture(buffer.getvalue(), caption)


def pixels(picture: Picture) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(picture.png)))


@pytest.mark.parametrize(("count", "size"), [(1, (500, 500)), (8, (600, 600)), (3, (900, 400)), (12, (300, 700))])
def test_every_picture_shows_in_its_proportions(count: int, size: tuple[int, int]) -> None:
    colors = [(250 - 5 * k, 6 * k, 40) for k in range(count)]
    sheet = question_sheet([plain(c, size, f"view {k}: " + "from far away, " * 20) for k, c in enumerate(colors, 1)])
    found = pixels(sheet)
    assert found.shape[1] <= 2000
    shown = []
    for color in colors:
        rows, columns = np.nonzero((np.abs(found.astype(int) - color) <= 1).all(axis=2))
        width, height = np.ptp(columns) + 1, np.ptp(rows) + 1
        assert len(rows) == width * height
        assert width / height == pytest.approx(size[0] / size[1], rel=0.02)
        shown.append((rows.min(), columns.min()))
    assert shown == sorted(shown)  # row by row
    assert width * height >= min(1.0, (240 / max(size)) ** 2) * size[0] * size[1] * 0.97


def test_a_caption_that_begins_with_its_number_is_not_numbered_twice() -> None:
    told, bare = (question_sheet([plain((200, 30, 30), (400, 300), c)]) for c in ("picture 1: from the left", "from the left"))
    other = question_sheet([plain((200, 30, 30), (400, 300), "picture 2: from the left")])
    assert told.png == bare.png != other.png


def test_a_sheet_of_nothing_is_an_error() -> None:
    with pytest.raises(ValueError, match="at least one"):
        question_sheet([])
