"""Numbers sit on what they number, and none covers another."""

import numpy as np
import pytest
from PIL import Image

from anymesh.prompted.pictures.drawing import draw_marks, mark_positions
from anymesh.rendering.marks import beside, contrast, highlight, mark_color, plate_size, rim, window_sums

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
