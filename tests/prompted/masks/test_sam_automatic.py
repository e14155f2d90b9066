"""Automatic masks of a fake model that returns the discs of its picture."""

from dataclasses import dataclass, field

import numpy as np
import pytest

from anymesh.errors import OptionError
from anymesh.prompted.masks.sam import AutomaticMasks, PromptedSegmenter, automatic_masks
from anymesh.prompted.masks.sam_frame import Frame

DISCS = np.array([[40.0, 50, 18], [110, 30, 14], [100, 95, 25], [30, 110, 10]])  # x, y, radius [px]
HEIGHT, WIDTH = 130, 150


def disc_picture() -> np.ndarray:
    """Each disc has its own red; the rest is black."""
    x, y = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    image = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
    for k, (cx, cy, r) in enumerate(DISCS):
        image[np.hypot(x - cx, y - cy) < r] = (10 * (k + 1), 0, 0)
    return image


@dataclass
class Discs:
    """Answers with the pixels of the colour under the point: sharp, softly, and badly; scores differ a little by point."""

    frame: Frame = field(default_factory=lambda: Frame(256, padded=True))
    name: str = "discs"
    embedded: int = 0

    def embed(self, image):
        """(reds over the square, zero in its padding; the picture)."""
        self.embedded += 1
        height, width = image.shape[:2]
        rows, columns = self.frame.inner(height, width)
        middle = np.arange(self.frame.side // 2) * 2 + 1.0  # the logits are half as fine as the square
        y, x = (middle * height / rows).astype(int), (middle * width / columns).astype(int)
        red = np.pad(image[..., 0].astype(int), ((0, self.frame.side), (0, self.frame.side)))
        return red[np.minimum(y, height)][:, np.minimum(x, width)], image

    def predict(self, embedding, points):
        square, image = embedding
        red = image[points[:, 1].astype(int), points[:, 0].astype(int), 0].astype(int)
        sharp = np.where((square == red[:, None, None]) & (red > 0)[:, None, None], 20.0, -20.0)
        best = np.where(red > 0, 0.99 - 1e-5 * (points @ [1, WIDTH]) / 2, 0.2)
        scores = np.stack([best, np.full(len(red), 0.999), np.full(len(red), 0.5)], 1)
        return np.stack([sharp, sharp * 0.01, sharp], 1), scores


@pytest.mark.parametrize("frame", [Frame(256, True), Frame(256, False)])
def test_every_disc_is_found_once(frame):
    model = Discs(frame)
    assert isinstance(model, PromptedSegmenter)
    image = disc_picture()
    found = automatic_masks(model, image, settings=AutomaticMasks(points_per_side=16, points_per_batch=7))
    assert len(found) == len(DISCS)
    assert [p.score for p in found] == sorted((p.score for p in found), reverse=True)
    for k in range(len(DISCS)):
        truth = image[..., 0] == 10 * (k + 1)
        overlap = max((p.mask & truth).sum() / (p.mask | truth).sum() for p in found)
        assert overlap > 0.93
    for p in found:
        y, x = np.nonzero(p.mask)
        assert p.box == (x.min(), y.min(), x.max(), y.max())
        assert p.stability >= 0.95


def test_batches_and_the_order_of_points_change_nothing(monkeypatch):
    image = disc_picture()
    first = automatic_masks(Discs(), image, settings=AutomaticMasks(points_per_side=12))
    from anymesh.prompted.masks import sam

    grid = sam.point_grid
    monkeypatch.setattr(sam, "point_grid", lambda n: np.random.default_rng(3).permutation(grid(n)))
    again = automatic_masks(Discs(), image, settings=AutomaticMasks(points_per_side=12, points_per_batch=5))
    assert [(p.box, p.score, p.stability) for p in first] == [(p.box, p.score, p.stability) for p in again]
    for a, b in zip(first, again, strict=True):
        np.testing.assert_array_equal(a.mask, b.mask)


def test_crops_ask_again_and_add_no_duplicates():
    model, image = Discs(), disc_picture()
    found = automatic_masks(model, image, settings=AutomaticMasks(points_per_side=12, crop_layers=1))
    assert model.embedded == 5
    whole = [p for p in found if p.mask.any()]
    for k in range(len(DISCS)):
        truth = image[..., 0] == 10 * (k + 1)
        assert sum((p.mask & truth).sum() > 0.8 * truth.sum() for p in whole) == 1


def test_small_regions_are_cleaned_when_asked():
    image = disc_picture()
    image[5, 5] = (10, 0, 0)  # a crumb of the first disc's colour
    image[50, 40] = 0  # and a hole in it
    plain = automatic_masks(Discs(Frame(512, True)), image, settings=AutomaticMasks(points_per_side=8))
    clean = automatic_masks(Discs(Frame(512, True)), image, settings=AutomaticMasks(points_per_side=8, smallest_region=30))
    assert any(p.mask[5, 5] for p in plain)
    assert not any(p.mask[5, 5] for p in clean)
    assert any(p.mask[50, 40] for p in clean)
    assert not any(p.mask[50, 40] for p in plain)


def test_thresholds_of_zero_keep_all():
    image = disc_picture()
    settings = AutomaticMasks(points_per_side=4, min_score=0.0, min_stability=0.0, nms_iou=1.0)
    assert len(automatic_masks(Discs(), image, settings=settings)) == 4 * 4 * 3


def test_nothing_found_is_no_error():
    assert automatic_masks(Discs(), np.zeros((20, 30, 3), np.uint8)) == []


@pytest.mark.parametrize("wrong", [{"points_per_side": 0}, {"nms_iou": 1.2}, {"crop_layers": -1}, {"crop_overlap": 1.0}])
def test_settings_that_cannot_be_are_refused(wrong):
    with pytest.raises(OptionError, match="valid are"):
        AutomaticMasks(**wrong)
