"""STAGE A (paper, 3.2) on the embedded default: which parts move, with no name given.

Pieces, what hangs on what, the evidence for each candidate, the answerer's word, and the motion itself: what cannot move is
no movable part.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Int

from anymesh.config import Config
from anymesh.geometry.pieces import ObjectShape
from anymesh.geometry.surroundings import Surroundings
from anymesh.progress import Progress, silent
from anymesh.reasoning.movable import ENOUGH
from anymesh.reasoning.questions import Answerer, Candidate, MotionAnswer, PartAnswer
from anymesh.reasoning.vocabulary import recognize
from anymesh.segmentation.contacts import Contacts, find_contacts
from anymesh.segmentation.evidence import Context, gather
from anymesh.segmentation.naming import named_parts
from anymesh.segmentation.units import Units, join_units, root_ranking, size_of, touches_outside, with_held
from anymesh.types import JointType, Mesh, MotionKind, Segmentation

Moves = Callable[[Surroundings, str], tuple[MotionAnswer, Candidate]]  # Stage B's test of one part, by name of its label


DOUBTFUL = -0.4  # evidence from which the motion of what touches nothing is looked at
PLAINLY = 1.8  # evidence that unseats a root
FRONT = 1.6  # what it counts that a layout of handles makes a piece one of the fronts


@dataclass(frozen=True, eq=False)
class Found:
    """A candidate that was taken as a part: its unit, its faces, the answer about it."""

    unit: int
    members: tuple[int, ...]
    faces: Int[np.ndarray, " n"]
    answer: PartAnswer
    label: str


def segment_parts(
    mesh: Mesh, whole: ObjectShape, answerer: Answerer, moves: Moves, config: Config, progress: Progress = silent
) -> Segmentation:
    """The movable parts of a mesh and its base; the base is all that is left."""
    settings = config.segmentation
    progress("segment", "contacts", 0, 2)
    contacts = find_contacts(whole, settings)
    units = _rooted(mesh, whole, contacts, answerer, moves, config)
    progress("segment", "evidence", 1, 2)
    found = _search(whole, units, answerer, moves, config, progress)
    return _assemble(mesh, whole, found)


def _rooted(mesh: Mesh, whole: ObjectShape, contacts: Contacts, answerer: Answerer, moves: Moves, config: Config) -> Units:
    """Units hung on the likeliest root; a root that is plainly a movable part itself (a fridge's door) gives way."""
    ranked = root_ranking(whole, contacts)[:4]
    units = join_units(mesh, whole, contacts, ranked[0])
    for first, second in itertools.pairwise(ranked):
        other = join_units(mesh, whole, contacts, second)
        hit = _candidate(whole, other, int(other.unit[first]), [], answerer, moves, config)
        if int(other.unit[first]) == other.root or hit is None or hit.answer.score < PLAINLY:
            break
        units = other
    return units


def _search(
    whole: ObjectShape, units: Units, answerer: Answerer, moves: Moves, config: Config, progress: Progress
) -> list[Found]:
    """Three rounds: what touches nothing, small before large, so that a knob is not taken for a panel's handle; what
    touches; and again what touches nothing and is free once those parts are out of the way (a tray behind a door)."""
    size = {u: size_of(units, [u]) / whole.diagonal for u in units.hanging}
    area = np.bincount(units.unit, [s.area for s in units.contacts.shapes])
    least = config.segmentation.smallest
    todo = [u for u in sorted(units.hanging) if u != units.root and size[u] >= least and area[u] > 0]
    todo = sorted(todo, key=lambda u: (-size[u], u))[: config.segmentation.most_candidates]
    found: list[Found] = []
    apart = [u for u in todo if not touches_outside(units, units.hanging[u])]
    for batch in (apart[::-1], [u for u in todo if u not in apart], apart[::-1]):
        taken = {f.unit for f in found}
        new = []
        for k, u in enumerate(u for u in batch if u not in taken):
            progress("segment", units.names[u] or f"piece {u}", k, len(batch))
            hit = _candidate(whole, units, u, found, answerer, moves, config)
            if hit is not None:
                new.append(hit)
        found += _outermost(units, new)
    return found


def _candidate(
    whole: ObjectShape, units: Units, u: int, found: list[Found], answerer: Answerer, moves: Moves, config: Config
) -> Found | None:
    """The unit, grown by what it holds or else as it is, if the evidence is enough and it can move; else None."""
    grown, plain = with_held(units, u), units.hanging[u]
    hit = _judged(whole, units, u, grown, found, answerer, moves, config)
    if hit is None and len(grown) > len(plain):
        hit = _judged(whole, units, u, plain, found, answerer, moves, config)
    return hit


def _judged(
    whole: ObjectShape, units: Units, u: int, members: list[int], found: list[Found], answerer: Answerer,
    moves: Moves, config: Config,
) -> Found | None:  # fmt: skip
    """These units as one part if the evidence is enough and they can move, else None."""
    faces = units.faces(members)
    moving = np.zeros(len(whole.shape.areas), bool)
    moving[faces] = True
    inner = [f for f in found if f.unit in members and f.unit != u]
    for f in inner:
        moving[f.faces] = False
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
    around = Surroundings(
        part=whole.of(faces), parent=rest, rest=rest, others=whole.of(np.flatnonzero(away)) if away.any() else None,
        everything=whole.of(np.flatnonzero(~moving)), slim=(), diagonal=whole.diagonal,
        center=whole.shape.bounds.mean(0),
        config=config.articulation,
    )  # fmt: skip
    separate = not touches_outside(units, members)
    size = size_of(units, members)
    twins = tuple(
        whole.of(units.faces(units.hanging[other]))
        for other in units.hanging
        if other not in (u, units.root)
        and other not in members
        and abs(size_of(units, units.hanging[other]) - size) < 0.02 * size
    )
    context = Context(whole, config.segmentation, units.names[u], separate, twins, carrier is not None)
    evidence = gather(around, context)
    answer = answerer.is_part(evidence)
    if not answer.moves and np.isin(np.flatnonzero(units.unit == u), whole.fronts).any():
        score = answer.score + FRONT
        answer = replace(answer, moves=score >= ENOUGH, label="door", score=score, reason="a front with a handle of its own")
    if not answer.moves and not (separate and answer.score > DOUBTFUL):
        return None
    motion, best = moves(around, answer.label if units.names[u] else "part")
    if not answer.moves:  # a fit that lets it slide between two stops is evidence of its own
        answer = answerer.is_part(replace(evidence, captured=best.captured and best.guided > 0.4))
    if not answer.moves or motion.type is JointType.FIXED:
        return None
    return Found(u, tuple(members), faces, answer, _label(answer, units.names[u], around, best))


def _label(answer: PartAnswer, name: str, around: Surroundings, best: Candidate) -> str:
    """The field's word for a part that moves like this."""
    if recognize(name) is not None:
        return answer.label
    if best.motion.kind is MotionKind.SLIDE:
        if abs(best.outward) < 0.5:
            return "slider"
        return "drawer" if around.part.box.diagonal > 0.15 * around.diagonal else "button"
    if best.role == "round":
        return "knob" if around.part.box.diagonal < 0.16 * around.diagonal else "wheel"
    if answer.label == "handle" or (best.role == "bail" and around.part.slender):
        return "handle"
    return "lid" if around.outward[2] > 0.8 or best.role == "bail" else "door"  # a plate on two pivots is a laptop's lid


def _outermost(units: Units, new: list[Found]) -> list[Found]:
    """Of parts found within each other in one round, the outer ones, and the inner ones that touch nothing."""
    kept = []
    for f in new:
        rank = (len(f.faces), -f.unit)
        outer = [g for g in new if f.unit in g.members and (len(g.faces), -g.unit) > rank]
        apart = not touches_outside(units, f.members)
        named = units.names[f.unit] and all(g.label != f.label for g in outer)
        if not outer or apart or named:
            kept.append(f)
    return kept


def _assemble(mesh: Mesh, whole: ObjectShape, found: list[Found]) -> Segmentation:
    """Face numbers; a part within a part owns its faces."""
    face_part = np.zeros(len(whole.mesh_piece), np.int64)
    found = sorted(found, key=lambda f: (-len(f.faces), f.unit))
    for number, f in enumerate(found, start=1):
        face_part[np.isin(whole.mesh_piece, whole.piece[f.faces])] = number
    confidence = [float(np.clip(0.4 + 0.2 * f.answer.score, 0.05, 0.99)) for f in found]
    return named_parts(face_part, [f.label for f in found], mesh.face_areas, confidence, [f.answer.reason for f in found])


__all__ = ["Moves", "segment_parts"]
