"""Which parts of a kind of object move, how many and how, as a prior of both stages. The values are in `moving_parts.json`.

A kind is named by the last known phrase of a category or of a name. Names in one row of `kinds.json` mean the same kind.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from importlib.resources import files
from typing import Any

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.articulation.candidate_motions import CandidateMotions
from anymesh.config import LEVEL_COSINE
from anymesh.kinds.usual import KINDS
from anymesh.motion.part_context import PartContext
from anymesh.segmentation.part_classifier import shipped_classifier
from anymesh.segmentation.segment import likely_parts
from anymesh.types import Brief, JointType
from anymesh.vocabulary import words_of

MOVES = ("turns level", "turns upright", "slides level", "slides upright")
LONGEST_PHRASE = 4  # words
# Chosen by `training/kind_prior.py` on objects that the table was made without (docs/decisions/0046).
WIDTH = 0.4  # of the logarithm of sizes, added to the spread of the sizes of a part
PSEUDO_OBJECTS = 3.0  # objects like those of all kinds together, added to those of a kind
PART_WEIGHT, MOTION_WEIGHT = 0.75, 0.5
SHIFT, MAX_SHIFT = 0.5, 4.0  # usual and largest log-odds by which the number of parts shifts all scores
COUNT_SPREAD = 0.5  # of the logarithm of the number of parts, of one object that is added to those of a kind
SMALLEST, BACKGROUND_RATE = 1e-4, 1e-9  # size of a part, and parts of any size that an object has
TO_QUANTILE = 2.563  # standard deviations between the quantiles .1 and .9


def move_of(axis: Float[np.ndarray, " 3"], *, slides: bool) -> str:
    """Return the move of a joint with an axis, z up."""
    return MOVES[int(_moves(axis[None] / np.linalg.norm(axis), np.array([slides]))[0])]


def _moves(axes: Float[np.ndarray, "n 3"], slides: Bool[np.ndarray, " n"]) -> Int[np.ndarray, " n"]:
    return 2 * slides + (np.abs(axes[:, 2]) > LEVEL_COSINE)


@dataclass(frozen=True, eq=False)
class CountedParts(Brief):
    """Parts of some objects. A size is the diagonal of a part over that of its object.

    objects: how many; middle, spread: mean and standard deviation of the logarithm of the size of each part; moves: (r, 4) how
    many parts move so, as in MOVES.
    """

    objects: int
    middle: Float[np.ndarray, " r"]
    spread: Float[np.ndarray, " r"]
    moves: Float[np.ndarray, "r 4"]

    @classmethod
    def of(cls, rows: Sequence[dict[str, Any]]) -> CountedParts:
        """Read rows of the table."""
        parts = [part for row in rows for part in row["parts"]]
        low, middle, high = np.log(np.maximum([part["size"] for part in parts], SMALLEST)).reshape(-1, 3).T
        moves = np.array([[part["moves"].get(move, 0) for move in MOVES] for part in parts], float).reshape(-1, len(MOVES))
        return cls(sum(row["objects"] for row in rows), middle, np.hypot((high - low) / TO_QUANTILE, WIDTH), moves)

    def density(self, size: Float[np.ndarray, " n"]) -> Float[np.ndarray, "n 4"]:
        """Return how many parts of these sizes move so, in all objects, as a density over the logarithm of the size."""
        off = (np.log(np.maximum(size, SMALLEST))[:, None] - self.middle) / self.spread
        return np.exp(-(off**2) / 2) / self.spread @ self.moves + BACKGROUND_RATE * self.objects


@dataclass(frozen=True, eq=False)
class UsualParts(Brief):
    """The moving parts of a kind of object, or of several kinds with the same name.

    names: of the kinds; moving: number of moving parts of each object that was counted; own, rest: parts of the kind, and of
    all kinds together.
    """

    names: tuple[str, ...]
    moving: Float[np.ndarray, " o"]
    own: CountedParts
    rest: CountedParts

    def part_scores(
        self, score: Float[np.ndarray, " n"], place: Float[np.ndarray, "n 12"], clash: Bool[np.ndarray, "n n"]
    ) -> Float[np.ndarray, " n"]:
        """Return the log-odds of candidates for parts: those of a usual size gain, and all together are about as many as usual.

        place: as from `PartContext.place`; clash: candidates that cannot both be parts.
        """
        size = np.linalg.norm(place[:, 3:6], axis=1)
        own, rest = self.own.density(size).sum(1), self.rest.density(size).sum(1) / self.rest.objects
        score = score + PART_WEIGHT * np.log((own + PSEUDO_OBJECTS * rest) / ((self.own.objects + PSEUDO_OBJECTS) * rest))
        return score + self._shift(score[likely_parts(clash, shipped_classifier().probability(score))])

    def _shift(self, score: Float[np.ndarray, " k"]) -> float:
        """Return the likeliest shift of log-odds, by how usual it is and how usual the number of parts is then."""
        count, probability = np.log(self.moving + 0.5), shipped_classifier().probability
        variance = (((count - count.mean()) ** 2).sum() + COUNT_SPREAD**2) / (len(count) + 1)
        shifts = np.linspace(-MAX_SHIFT, MAX_SHIFT, 81)
        expected = np.log(np.array([probability(score + shift).sum() for shift in shifts]) + 0.5)
        return float(shifts[(shifts**2 / SHIFT**2 + (expected - count.mean()) ** 2 / variance).argmin()])

    def motions(self, context: PartContext, motions: CandidateMotions) -> CandidateMotions:
        """Return the motions of a part with scores that also say how parts of its size usually move."""
        size, of = motions.part.size / context.diagonal, [c.motion for c in motions.candidates]
        axes = np.array([m.axis for m in of]).reshape(-1, 3)
        slides = np.array([m.kind is JointType.PRISMATIC for m in of], bool)
        return replace(motions, scores=motions.scores + self.gain_of_motions(size, axes, slides))

    def gain_of_motions(self, size: float, axes: Float[np.ndarray, "k 3"], slides: Bool[np.ndarray, " k"]) -> np.ndarray:
        """Return what is added to the log-odds of motions of a part of this size. axes: unit; slides: which are slides."""
        rest = self.rest.density(np.array([size]))[0]
        own = self.own.density(np.array([size]))[0] + PSEUDO_OBJECTS * rest / rest.sum()
        return MOTION_WEIGHT * np.log(own / own.sum() / (rest / rest.sum()))[_moves(axes, slides)]


@dataclass(frozen=True, eq=False)
class PartTable:
    """The table of moving parts. rows: of its kinds."""

    rows: tuple[dict[str, Any], ...]

    @cached_property
    def _all(self) -> CountedParts:
        return CountedParts.of(self.rows)

    @cached_property
    def _named(self) -> dict[str, list[dict[str, Any]]]:
        """Return the rows of each name, without spaces."""
        rows_of: dict[str, list[dict[str, Any]]] = {}
        for row in self.rows:
            named = [tuple(words_of(name)) for name in row["words"].split()]
            same = {KINDS[words].first for words in named if words in KINDS}
            named += [words for words, kind in KINDS.items() if kind.first in same]
            for name in dict.fromkeys("".join(words) for words in named):
                rows_of.setdefault(name, []).append(row)
        return rows_of

    def find(self, *texts: str | None) -> UsualParts | None:
        """Return the moving parts of the kind that the first of some texts names that names one.

        None without one, or for a kind that only `kinds.json` has.
        """
        for words in (words_of(text) for text in texts if text):
            for end in range(len(words), 0, -1):
                phrases = [words[max(end - n, 0) : end] for n in range(LONGEST_PHRASE, 0, -1)]
                rows = next((rows for phrase in phrases if (rows := self._named.get("".join(phrase)))), None)
                if rows:
                    moving = np.array([n for row in rows for n in row["moving"]], float)
                    return UsualParts(tuple(row["words"].split()[0] for row in rows), moving, CountedParts.of(rows), self._all)
                if any(tuple(phrase) in KINDS for phrase in phrases):
                    return None
        return None


@cache
def shipped_table() -> PartTable:
    """Read the shipped table."""
    text = files("anymesh.kinds").joinpath("moving_parts.json").read_text(encoding="utf-8")
    return PartTable(tuple(json.loads(text)["kinds"]))


def usual_parts(*texts: str | None) -> UsualParts | None:
    """Return the moving parts of the kind that a category or names tell, see `PartTable.find`."""
    return shipped_table().find(*texts)
