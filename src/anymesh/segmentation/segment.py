"""STAGE A (paper, 3.2) on the embedded default: which parts move, with no name given.

Pieces, what hangs on what, the evidence for each candidate, the answerer's word, and the motion itself: what cannot move is
no movable part.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Container
from dataclasses import replace

import numpy as np

from anymesh.config import Config
from anymesh.deadline import SEGMENT, Deadline
from anymesh.geometry.pieces import ObjectShape
from anymesh.geometry.surroundings import Surroundings
from anymesh.progress import Progress, silent
from anymesh.reasoning.movable import ENOUGH, KEY, stands_out
from anymesh.reasoning.questions import Answerer, Candidate, MotionAnswer, PartAnswer
from anymesh.reasoning.vocabulary import recognize
from anymesh.reasoning.weighing import CONTROL
from anymesh.segmentation.contacts import Contacts, find_contacts
from anymesh.segmentation.looking import Found, Look, look_at
from anymesh.segmentation.naming import named_parts
from anymesh.segmentation.repeats import bare_repeats, examine_repeats, repeats
from anymesh.segmentation.units import Units, join_units, root_ranking, size_of, touches_outside, with_held
from anymesh.types import JointType, Mesh, MotionKind, Segmentation

Moves = Callable[[Surroundings, str], tuple[MotionAnswer, Candidate]]  # Stage B's test of one part, by name of its label


DOUBTFUL = -0.4  # evidence from which the motion of what touches nothing is looked at
PLAINLY = 1.8  # evidence that unseats a root
MOST_KEYS = 16  # more are a keyboard, whose keys nobody wants as joints
TRAVEL = 0.1  # of its size, by which a drawer comes out at least
FRONT = 1.6  # what it counts that a layout of handles makes a piece one of the fronts


def segment_parts(
    mesh: Mesh, whole: ObjectShape, answerer: Answerer, moves: Moves, config: Config, progress: Progress = silent,
    deadline: Deadline | None = None,
) -> Segmentation:  # fmt: skip
    """The movable parts of a mesh and its base; the base is all that is left. Past the deadline no candidate is examined."""
    settings = config.segmentation
    progress("segment", "contacts", 0, 2)
    contacts = find_contacts(whole, settings)
    units = _rooted(mesh, whole, contacts, answerer, moves, config)
    progress("segment", "evidence", 1, 2)
    found = _search(whole, units, answerer, moves, config, progress, deadline or Deadline())
    if len(found) < settings.at_least:
        found += _likeliest(whole, units, found, moves, config)[: settings.at_least - len(found)]
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
    whole: ObjectShape, units: Units, answerer: Answerer, moves: Moves, config: Config, progress: Progress, deadline: Deadline
) -> list[Found]:
    """Four rounds: what touches nothing, small before large, so that a knob is not taken for a panel's handle; what touches;
    again what touches nothing and is free once those parts are out of the way (a tray behind a door); and copies of parts
    that were found."""
    size, group = _sizes(whole, units), repeats(whole, units)
    todo = _large_enough(units, size, config, bare_repeats(units, group))
    found: list[Found] = []

    def examine(u: int, number: int, total: int) -> Found | None:
        if deadline.late(SEGMENT):
            deadline.leave_out("segmentation: some candidates for parts were not examined")
            return None
        progress("segment", units.names[u] or f"piece {u}", number, total)
        return _candidate(whole, units, u, found, answerer, moves, config)

    apart = [u for u in todo if not touches_outside(units, units.hanging[u])]
    for batch in (apart[::-1], [u for u in todo if u not in apart], apart[::-1], todo):
        taken = {f.unit for f in found}
        left = [u for u in batch if u not in taken and (batch is not todo or _is_copy(size, u, found))]
        found += _outermost(units, examine_repeats(whole, units, group, left, found, examine))
    keys = [f for f in found if f.answer.label == KEY and not units.names[f.unit]]
    return _outermost(units, found if len(keys) <= MOST_KEYS else [f for f in found if f not in keys])


def _sizes(whole: ObjectShape, units: Units) -> dict[int, float]:
    return {u: size_of(units, [u]) / whole.diagonal for u in units.hanging}


def _large_enough(units: Units, size: dict[int, float], config: Config, bare: Container[int] = ()) -> list[int]:
    """The units that are examined, largest first. bare: units that are left out."""
    area = np.bincount(units.unit, units.piece_area)
    least = config.segmentation.smallest
    todo = [u for u in sorted(units.hanging) if u != units.root and size[u] >= least and area[u] > 0 and u not in bare]
    return sorted(todo, key=lambda u: (-size[u], u))[: config.segmentation.most_candidates]


def _likeliest(whole: ObjectShape, units: Units, found: list[Found], moves: Moves, config: Config) -> list[Found]:
    """What stands out most and can move, of what the evidence was not enough for; nothing of it lies within another."""
    seen = [
        look_at(whole, units, u, with_held(units, u), found, config) for u in _large_enough(units, _sizes(whole, units), config)
    ]
    taken = {m for f in found for m in f.members}
    chosen: list[Found] = []
    for look in sorted((s for s in seen if s is not None), key=lambda s: -stands_out(s.evidence)):
        if taken & set(look.members):
            continue
        motion, best = moves(look.around, "part")
        if motion.type is not JointType.FIXED:
            answer = PartAnswer(True, "part", 0.0, "nothing else was found, and this stands out most")
            chosen.append(
                Found(look.unit, look.members, look.faces, look.around.core, answer, _label(answer, "", look.around, best))
            )
            taken |= set(look.members)
    return chosen


def _is_copy(size: dict[int, float], u: int, found: list[Found]) -> bool:
    """Whether a unit may be a copy of a part that was found: one may show what another hides."""
    return any(abs(size[f.unit] - size[u]) < 0.02 * size[u] for f in found)


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
    look = look_at(whole, units, u, members, found, config)
    if look is None:
        return None
    answer = answerer.is_part(look.evidence)
    if not answer.moves and np.isin(np.flatnonzero(units.unit == u), whole.fronts).any():
        score = answer.score + FRONT
        answer = replace(answer, moves=score >= ENOUGH, label="door", score=score, reason="a front with a handle of its own")
    if not answer.moves and not (look.separate and answer.score > DOUBTFUL):
        return None
    motion, best = moves(look.around, answer.label if units.names[u] else "part")
    if not answer.moves:  # a fit that lets it slide between two stops is evidence of its own
        answer = answerer.is_part(replace(look.evidence, captured=best.captured and best.guided > 0.4))
    if not answer.moves or motion.type is JointType.FIXED or _stays_in(look, best):
        return None
    return Found(u, look.members, look.faces, look.around.core, answer, _label(answer, units.names[u], look.around, best))


def _stays_in(look: Look, best: Candidate) -> bool:
    """Whether what is too large for a button would come out by next to nothing: it is no drawer."""
    size = look.evidence.size
    return best.motion.kind is MotionKind.SLIDE and best.outward > 0.7 and size > CONTROL and best.opening < TRAVEL * size


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
