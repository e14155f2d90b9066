"""Repeated units: copies of one shape, such as keys, slats or the beads of a lamp. What a few of them show holds for all."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float, Int

from anymesh.geometry.pieces import ObjectShape
from anymesh.segmentation.looking import Found, copy_of
from anymesh.segmentation.units import Units

REPEATED = 16  # copies from which a sample of them is examined
SAMPLED = 5  # copies that are examined; most of them decide
MOST_BARE = 40  # more copies that carry nothing are beads, slats or books, not movable parts
STEP = 0.03  # relative: lengths of copies differ by less; a cell of the logarithmic grid that they are compared on


def repeats(whole: ObjectShape, units: Units) -> Int[np.ndarray, " u"]:
    """Return a class index per unit: units of one class have the same area, moments and height, and touch others or not.

    Moments are the axes of the inertia ellipsoid, so copies may be turned about the vertical. What hangs on a unit does not
    count.
    """
    unit = units.unit[whole.piece]
    count = len(units.names)
    area = np.bincount(unit, whole.shape.areas, count)
    middle = whole.shape.triangles.mean(1)
    weight = whole.shape.areas / np.maximum(area, 1e-300)[unit]
    mean = np.stack([np.bincount(unit, weight * column, count) for column in middle.T], 1)
    off = middle - mean[unit]
    moment = np.zeros((count, 3, 3))
    for i in range(3):
        for j in range(3):
            moment[:, i, j] = np.bincount(unit, weight * off[:, i] * off[:, j], count)
    spread = np.sqrt(np.maximum(np.linalg.eigvalsh(moment), 0))
    low, high = np.full(count, np.inf), np.full(count, -np.inf)
    np.minimum.at(low, units.unit, units.piece_bounds[:, 0, 2])
    np.maximum.at(high, units.unit, units.piece_bounds[:, 1, 2])
    touch = units.unit[units.contacts.touch]
    touches = np.isin(np.arange(count), touch[touch[:, 0] != touch[:, 1]])
    key = np.c_[_cells(np.c_[np.sqrt(area), spread, high - low], whole.diagonal), touches]
    return np.unique(key, axis=0, return_inverse=True)[1].reshape(-1)


def _cells(lengths: Float[np.ndarray, "n k"], diagonal: float) -> Int[np.ndarray, "n k"]:
    """Return the cell of each length on a logarithmic grid; what is far smaller than the object's diagonal is in one."""
    return np.rint(np.log(np.maximum(lengths, 1e-4 * diagonal) / diagonal) / STEP).astype(np.int64)


def bare_repeats(units: Units, group: Int[np.ndarray, " u"]) -> set[int]:
    """Return the units without a name that are repeated more often than movable parts are, and carry copies at most."""
    many = np.bincount(group)[group] > MOST_BARE
    found = (int(u) for u in np.flatnonzero(many) if not units.names[u])
    return {u for u in found if (group[units.hanging[u]] == group[u]).all()}


def examine_repeats(
    whole: ObjectShape, units: Units, group: Int[np.ndarray, " u"], left: Sequence[int], found: list[Found],
    examine: Callable[[int, int, int], Found | None],
) -> list[Found]:  # fmt: skip
    """Return the parts among some units. Of many copies a sample is examined; if most of it are parts, all copies are.

    found: the parts that were found before; examine: finds out about one unit, given how many were done before it and how
    many there are. The order of the result is that of `left`.
    """
    hits: dict[int, Found | None] = {}

    def examined(chosen: list[int]) -> dict[int, Found | None]:
        return {u: examine(u, len(hits) + k, len(left)) for k, u in enumerate(chosen)}

    for number in np.unique(group[list(left)]) if left else ():
        copies = [u for u in left if group[u] == number]
        if len(copies) <= REPEATED:
            hits |= examined(copies)
            continue
        chosen = [copies[k] for k in np.linspace(0, len(copies) - 1, SAMPLED).astype(int)]
        sample = examined(chosen)
        likely = _majority([f for f in sample.values() if f is not None])
        hits |= {u: sample.get(u) or _shared(whole, units, u, likely, found) if likely else None for u in copies}
    return [f for u in left if (f := hits.get(u)) is not None]


def _majority(parts: list[Found]) -> Found | None:
    """Return the first of the sampled copies that most of the sample agree with, if any."""
    labels = [f.label for f in parts]
    return next((f for f in parts if 2 * labels.count(f.label) > SAMPLED), None)


def _shared(whole: ObjectShape, units: Units, u: int, like: Found, found: list[Found]) -> Found | None:
    """Return a unit as a part like its copy."""
    answer = replace(like.answer, reason=f"one of many copies: {like.answer.reason}")
    return copy_of(whole, units, u, replace(like, answer=answer), found)
