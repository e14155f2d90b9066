"""A candidate part: what it is made of, what is around it, what it shows."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.config import Config
from anymesh.geometry.boxes import Box, alike
from anymesh.geometry.pieces import ObjectShape
from anymesh.geometry.surroundings import Surroundings, core_box
from anymesh.reasoning.questions import PartAnswer, PartEvidence
from anymesh.segmentation.evidence import Context, gather
from anymesh.segmentation.units import Units, size_of, touches_outside, with_held

SAME_SIZE = 0.02  # of the diagonal, by which the diagonals of copies differ at most


@dataclass(frozen=True, eq=False)
class Found:
    """A candidate that was taken as a part: its unit, its faces, its core box, the answer about it."""

    unit: int
    members: tuple[int, ...]
    faces: Int[np.ndarray, " n"]
    box: Box
    answer: PartAnswer
    label: str


@dataclass(frozen=True, eq=False)
class Look:
    """Units that may be one part, and what they show."""

    unit: int
    members: tuple[int, ...]
    faces: Int[np.ndarray, " n"]
    around: Surroundings
    evidence: PartEvidence
    separate: bool


def look_at(whole: ObjectShape, units: Units, u: int, members: list[int], found: list[Found], config: Config) -> Look | None:
    """The evidence for these units as one part; None where no face of them, or of the rest, is left."""
    inner = [f for f in found if f.unit in members and f.unit != u]
    moving = _own_faces(whole, units, members, inner)
    faces = np.flatnonzero(moving)
    if len(faces) == 0:
        return None
    elsewhere = [f for f in found if f.unit not in members] + inner
    away = np.zeros_like(moving)
    for f in elsewhere:
        away[f.faces] = True
    carrier = next((f for f in elsewhere if u in f.members), None)
    if carrier is not None:
        away[carrier.faces] = False
    away &= ~moving
    still = ~moving & ~away
    if not still.any():
        return None
    rest = whole.of(np.flatnonzero(still))
    others = whole.of(np.flatnonzero(away)) if away.any() else None
    around = Surroundings(
        part=whole.of(faces), parent=rest, rest=rest, others=others,
        everything=rest if others is None else whole.of(np.flatnonzero(~moving)), slim=(), diagonal=whole.diagonal,
        center=whole.shape.bounds.mean(0),
        config=config.articulation,
    )  # fmt: skip
    separate = not touches_outside(units, members)
    twins = _twins(units, u, members)
    copies = [f.answer.score for f in elsewhere if alike(around.core, f.box)]
    copied = max(copies, default=None)
    context = Context(whole, config.segmentation, units.names[u], separate, twins, carrier is not None, copied)
    return Look(u, tuple(members), faces, around, gather(around, context), separate)


def _own_faces(whole: ObjectShape, units: Units, members: list[int], inner: list[Found]) -> Bool[np.ndarray, " R"]:
    """Mask of the faces of some units but those of the parts within them."""
    moving = np.zeros(len(whole.shape.areas), bool)
    moving[units.faces(members)] = True
    for f in inner:
        moving[f.faces] = False
    return moving


def copy_of(whole: ObjectShape, units: Units, u: int, like: Found, found: list[Found]) -> Found | None:
    """The unit as a part like its copy: grown by what it holds if the copy is; None where no face of it is left."""
    grown = len(like.members) > len(units.hanging[like.unit])
    members = with_held(units, u) if grown else units.hanging[u]
    inner = [f for f in found if f.unit in members and f.unit != u]
    faces = np.flatnonzero(_own_faces(whole, units, members, inner))
    if len(faces) == 0:
        return None
    return replace(like, unit=u, members=tuple(members), faces=faces, box=core_box(whole.of(faces)))


def _twins(units: Units, u: int, members: list[int]) -> Float[np.ndarray, "n 3"]:
    """Middles of the other units of the same size as these [m]."""
    size = size_of(units, members)
    alike = np.abs(units.size - size) < SAME_SIZE * size
    alike[[u, units.root, *members]] = False
    return units.bounds[alike].mean(1)
