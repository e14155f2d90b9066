"""Choice of the pictures that show the marks: as few views as possible, with close-ups of crowded ones."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Int

from anymesh.config import REFERENCE_PX
from anymesh.prompted.grounding.regions import Marks
from anymesh.rendering.render import View
from anymesh.rendering.viewpoints import zoom
from anymesh.types.camera import Camera

MAX_MARKS_PER_PICTURE = 40  # marks that can be distinguished in one picture
WELL, HALF = 400.0, 0.5  # a view shows a mark well with this many pixels of a 640 px view, or this share of its maximum
MIN_MARK_PIXELS = 30.0  # [px of a 640 px view] minimum size of a drawn mark
MAX_VIEWS_SHOWN_TWICE = 5  # number of views up to which marks are shown a second time
TILE_AIR = 0.15  # margin around the marks of a close-up, as a share of their box on each side
TILES = 4  # maximum number of times that a crowded view is halved: 16 close-ups


@dataclass(frozen=True, eq=False)
class MarkPicture:
    """A view, the mark of each of its pixels (-1 for none), and its description."""

    view: View
    marks: Int[np.ndarray, "H W"]
    name: str

    @property
    def drawn(self) -> set[int]:
        """Return the marks in the picture."""
        return set(np.unique(self.marks[self.marks > 0]).tolist())

    def only(self, marks: Int[np.ndarray, " n"]) -> MarkPicture:
        """Return the picture with some marks alone."""
        return MarkPicture(self.view, np.where(np.isin(self.marks, marks), self.marks, -1), self.name)

    def without(self, marks: Collection[int]) -> MarkPicture:
        """Return the picture without some marks."""
        return MarkPicture(self.view, np.where(np.isin(self.marks, list(marks)), -1, self.marks), self.name)


def choose_pictures(
    marks: Marks, wanted: Collection[int], views: Sequence[View], names: Sequence[str], render: Callable[[Camera], View]
) -> list[MarkPicture]:
    """Return pictures in which each wanted mark is drawn where it is well visible.

    render: renders the close-ups of crowded views.
    """
    numbers = np.array(sorted(wanted), np.int64)
    if len(numbers) == 0:
        return []
    labels = [marks.in_view(view) for view in views]
    size = np.stack([_count(label, numbers) for label in labels])
    scale = np.array([(view.camera.height / REFERENCE_PX) ** 2 for view in views])[:, None]
    well = size >= np.minimum(WELL * scale, np.maximum(HALF * size.max(0), 1))
    pictures: list[MarkPicture] = []
    for v, new in _cover(well, size):
        pictures += _drawn(MarkPicture(views[v], labels[v], names[v]), numbers, size[v], new, render, marks)
    return pictures


def _count(label: np.ndarray, numbers: np.ndarray) -> Int[np.ndarray, " n"]:
    count = np.bincount(label[label > 0], minlength=int(numbers.max()) + 1)
    return count[numbers]


def _cover(well: Bool[np.ndarray, "V n"], size: np.ndarray) -> list[tuple[int, np.ndarray]]:
    """Return the chosen views in order, each with a mask of the marks that it is chosen for.

    Every mark is shown well once, and a second time as far as MAX_VIEWS_SHOWN_TWICE views allow.
    """
    chosen_views: dict[int, np.ndarray] = {}
    for most in (len(well), MAX_VIEWS_SHOWN_TWICE):
        left = well.any(0)
        if most == MAX_VIEWS_SHOWN_TWICE:
            left &= (well & np.isin(np.arange(len(well)), list(chosen_views))[:, None]).sum(0) < 2
        while left.any() and len(chosen_views) < most:
            rest = (well & left).sum(1) + 1e-9 * (size * left).sum(1)
            rest[list(chosen_views)] = 0
            v = int(rest.argmax())
            if rest[v] < 1:
                break
            chosen_views[v] = well[v] & left
            left &= ~well[v]
    return sorted(chosen_views.items())


def _drawn(
    whole: MarkPicture, numbers: np.ndarray, size: np.ndarray, new: np.ndarray, render: Callable[[Camera], View], marks: Marks
) -> list[MarkPicture]:
    """Return one picture with all visible marks, or with the new ones only, or else close-ups of the new ones.

    The first of these with at most MAX_MARKS_PER_PICTURE marks is chosen. whole: the view with all marks, also tiny ones.
    """
    shown = numbers[size >= MIN_MARK_PIXELS * (whole.view.camera.height / REFERENCE_PX) ** 2]
    own = np.union1d(shown, numbers[new])
    if len(own) <= MAX_MARKS_PER_PICTURE:
        return [whole.only(own)]
    if new.sum() <= MAX_MARKS_PER_PICTURE:
        return [whole.only(numbers[new])]
    return _tiles(whole, numbers[new], render, marks)


def _tiles(whole: MarkPicture, own: np.ndarray, render: Callable[[Camera], View], marks: Marks) -> list[MarkPicture]:
    """Return close-ups of a crowded view, each with a limited number of marks."""
    label, camera = whole.marks, whole.view.camera
    row, column = np.nonzero(np.isin(label, own))
    where = np.searchsorted(own, label[row, column])
    count = np.maximum(np.bincount(where, minlength=len(own)), 1)
    middle = np.stack([np.bincount(where, x, len(own)) / count for x in (column, row)], 1)
    groups = [np.arange(len(own))]
    for _ in range(TILES):
        if max(map(len, groups)) <= MAX_MARKS_PER_PICTURE:
            break
        groups = [half for group in groups for half in _halves(middle, group)]
    tiles = []
    for group in groups:
        at = np.isin(where, group)
        box = np.array([column[at].min(), row[at].min(), column[at].max() + 1, row[at].max() + 1], float)
        near = render(zoom(camera, box, TILE_AIR, camera.height))
        tiles.append(MarkPicture(near, marks.in_view(near), f"a close-up of the view {whole.name}").only(own[group]))
    return tiles


def _halves(middle: np.ndarray, group: np.ndarray) -> list[np.ndarray]:
    """Split a group of marks in two, across its longer side."""
    if len(group) <= MAX_MARKS_PER_PICTURE:
        return [group]
    axis = int(np.ptp(middle[group], axis=0).argmax())
    order = group[np.argsort(middle[group, axis], kind="stable")]
    return [np.sort(order[: len(order) // 2]), np.sort(order[len(order) // 2 :])]
