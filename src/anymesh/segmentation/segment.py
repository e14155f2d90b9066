"""STAGE A (paper, 3.2) on the embedded default: which parts move, with no name given.

Pieces, what hangs on what, the evidence for each candidate, the answerer's word, and the motion itself: what cannot move is
no movable part.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Int

from anymesh.config import Config
from anymesh.geometry.pieces import ObjectShape
from anymesh.geometry.surroundings import Surroundings
from anymesh.geometry.topology import label_connected
from anymesh.progress import Progress, silent
from anymesh.reasoning.questions import Answerer, Candidate, MotionAnswer, PartAnswer
from anymesh.reasoning.vocabulary import is_fixed_name, recognize
from anymesh.segmentation.contacts import Contacts, coplanar, find_contacts, hanging_on
from anymesh.segmentation.evidence import Context, gather
from anymesh.types import JointType, Mesh, MotionKind, Part, Segmentation

Moves = Callable[[Surroundings, str], tuple[MotionAnswer, Candidate]]  # Stage B's test of one part, by name of its label


DOUBTFUL = -0.4  # evidence from which the motion of what touches nothing is looked at
PLAINLY = 1.8  # evidence that unseats a root


@dataclass(frozen=True, eq=False)
class Found:
    """A candidate that was taken as a part: its unit, its faces, the answer about it."""

    unit: int
    members: tuple[int, ...]
    faces: Int[np.ndarray, " n"]
    answer: PartAnswer
    label: str


@dataclass(frozen=True, eq=False)
class _Units:
    """Pieces joined into units that move as one, and what hangs on each."""

    contacts: Contacts
    unit: Int[np.ndarray, " P"]
    names: list[str]
    root: int
    hanging: dict[int, list[int]]

    def faces(self, units: list[int]) -> np.ndarray:
        chosen = np.flatnonzero(np.isin(self.unit, units))
        return np.sort(np.concatenate([self.contacts.shapes[p].faces for p in chosen]))


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
    return _assemble(whole, found)


def _units(mesh: Mesh, whole: ObjectShape, contacts: Contacts, root_piece: int) -> _Units:
    """Bodies that touch nothing move as one; so do the pieces of a node whose name means something."""
    shapes = contacts.shapes
    key = np.where(contacts.body == contacts.body[root_piece], np.arange(len(shapes)), len(shapes) + contacts.body)
    same = np.array(coplanar(contacts, whole, 1e-3 * whole.diagonal), np.int64).reshape(-1, 2)
    key = np.where(key < len(shapes), label_connected(len(shapes), same), key)
    names = [""] * len(shapes)
    common = {_most(mesh.face_material[whole.source[shapes[root_piece].faces]])}
    for p, shape in enumerate(shapes):
        faces = whole.source[shape.faces]
        node, material = _most(mesh.face_node[faces]), _most(mesh.face_material[faces])
        name = mesh.nodes[node].name
        if recognize(name) is not None or is_fixed_name(name):
            names[p] = name
            key[p] = 2 * len(shapes) + node
        elif material >= 0 and material not in common and recognize(mesh.materials[material].name) is not None:
            names[p] = mesh.materials[material].name  # tells what a piece is, not that pieces move as one
    _, first, unit = np.unique(key, return_index=True, return_inverse=True)
    unit = unit.reshape(-1)
    root = int(unit[root_piece])
    return _Units(contacts, unit, [names[p] for p in first], root, hanging_on(contacts, unit, root))


def _most(numbers: np.ndarray) -> int:
    """The number that occurs most; -1 stands for none."""
    return int(np.bincount(numbers + 1).argmax()) - 1


def _rooted(mesh: Mesh, whole: ObjectShape, contacts: Contacts, answerer: Answerer, moves: Moves, config: Config) -> _Units:
    """Units hung on the likeliest root; a root that is plainly a movable part itself (a fridge's door) gives way."""
    ranked = _root_ranking(whole, contacts)[:4]
    units = _units(mesh, whole, contacts, ranked[0])
    for first, second in itertools.pairwise(ranked):
        other = _units(mesh, whole, contacts, second)
        hit = _candidate(whole, other, int(other.unit[first]), [], answerer, moves, config)
        if int(other.unit[first]) == other.root or hit is None or hit.answer.score < PLAINLY:
            break
        units = other
    return units


def _root_ranking(whole: ObjectShape, contacts: Contacts) -> list[int]:
    """The pieces that the rest may hang on, likeliest first: large, much touched, standing on the ground."""
    degree = np.bincount(contacts.touch.reshape(-1), minlength=len(contacts.shapes))
    low = whole.shape.bounds[0, 2] + 0.02 * whole.diagonal
    rank = []
    for s, d in zip(contacts.shapes, degree, strict=True):
        size = float(np.linalg.norm(s.bounds[1] - s.bounds[0])) * (1 + 0.1 * min(int(d), 10))
        samples = s.samples
        stands = ((samples.points[:, 2] < low) & (samples.normals[:, 2] < -0.7)).mean() if len(samples) else 0.0
        rank.append(size * (1.3 if stands > 0.05 else 1.0))
    return [int(i) for i in np.argsort(-np.array(rank), kind="stable")]


def _search(
    whole: ObjectShape, units: _Units, answerer: Answerer, moves: Moves, config: Config, progress: Progress
) -> list[Found]:
    """Three rounds: what touches nothing, small before large, so that a knob is not taken for a panel's handle; what
    touches; and again what touches nothing and is free once those parts are out of the way (a tray behind a door)."""
    size = {u: _size(units, [u]) / whole.diagonal for u in units.hanging}
    area = np.bincount(units.unit, [s.area for s in units.contacts.shapes])
    least = config.segmentation.smallest
    todo = [u for u in sorted(units.hanging) if u != units.root and size[u] >= least and area[u] > 0]
    todo = sorted(todo, key=lambda u: (-size[u], u))[: config.segmentation.most_candidates]
    found: list[Found] = []
    apart = [u for u in todo if not _touches_outside(units, units.hanging[u])]
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


def _size(units: _Units, chosen: list[int]) -> float:
    shapes = [units.contacts.shapes[p] for p in np.flatnonzero(np.isin(units.unit, chosen))]
    low = np.min([s.bounds[0] for s in shapes], 0)
    high = np.max([s.bounds[1] for s in shapes], 0)
    return float(np.linalg.norm(high - low))


def _candidate(
    whole: ObjectShape, units: _Units, u: int, found: list[Found], answerer: Answerer, moves: Moves, config: Config
) -> Found | None:
    """The unit, grown by what it holds or else as it is, if the evidence is enough and it can move; else None."""
    grown, plain = _grown(units, u), units.hanging[u]
    hit = _judged(whole, units, u, grown, found, answerer, moves, config)
    if hit is None and len(grown) > len(plain):
        hit = _judged(whole, units, u, plain, found, answerer, moves, config)
    return hit


def _judged(
    whole: ObjectShape, units: _Units, u: int, members: list[int], found: list[Found], answerer: Answerer,
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
    separate = not _touches_outside(units, members)
    size = _size(units, members)
    twins = tuple(
        whole.of(units.faces(units.hanging[other]))
        for other in units.hanging
        if other not in (u, units.root)
        and other not in members
        and abs(_size(units, units.hanging[other]) - size) < 0.02 * size
    )
    context = Context(whole, config.segmentation, units.names[u], separate, twins, carrier is not None)
    evidence = gather(around, context)
    answer = answerer.is_part(evidence)
    if not answer.moves and not (separate and answer.score > DOUBTFUL):
        return None
    motion, best = moves(around, answer.label if units.names[u] else "part")
    if not answer.moves:  # a fit that lets it slide between two stops is evidence of its own
        answer = answerer.is_part(replace(evidence, captured=best.captured and best.guided > 0.4))
    if not answer.moves or motion.type is JointType.FIXED:
        return None
    return Found(u, tuple(members), faces, answer, _label(answer, units.names[u], around, best))


def _grown(units: _Units, u: int) -> list[int]:
    """The unit, what hangs on it, and the smaller units that touch these more than all else (a shelf on a door)."""
    members = set(units.hanging[u])
    area = units.contacts.area
    unit = units.unit
    own = sum(units.contacts.shapes[p].area for p in np.flatnonzero(np.isin(unit, list(members))))
    for _ in range(4):
        inside = np.isin(unit, list(members))
        hold: dict[int, list[float]] = {}
        for (i, j), a in area.items():
            if not inside[i] and unit[i] != unit[j]:
                hold.setdefault(int(unit[i]), [0.0, 0.0])[int(inside[j])] += a
        new = [v for v, (other, here) in hold.items() if here > other and v != units.root]
        new = [v for v in new if sum(units.contacts.shapes[p].area for p in np.flatnonzero(unit == v)) < own]
        grown = members.union(*(units.hanging[v] for v in new)) - {units.root}
        if grown == members:
            break
        members = grown
    return [u, *sorted(members - {u})]


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
    if best.role == "bail" or answer.label == "handle":
        return "handle"
    return "lid" if around.outward[2] > 0.8 else "door"


def _outermost(units: _Units, new: list[Found]) -> list[Found]:
    """Of parts found within each other in one round, the outer ones, and the inner ones that touch nothing."""
    kept = []
    for f in new:
        rank = (len(f.faces), -f.unit)
        outer = [g for g in new if f.unit in g.members and (len(g.faces), -g.unit) > rank]
        apart = not _touches_outside(units, f.members)
        named = units.names[f.unit] and all(g.label != f.label for g in outer)
        if not outer or apart or named:
            kept.append(f)
    return kept


def _touches_outside(units: _Units, members: Sequence[int]) -> bool:
    inside = np.isin(units.unit, list(members))
    touch = units.contacts.touch
    return bool((inside[touch[:, 0]] != inside[touch[:, 1]]).any())


def _assemble(whole: ObjectShape, found: list[Found]) -> Segmentation:
    """Face numbers and unique names; a part within a part owns its faces."""
    face_part = np.zeros(len(whole.mesh_piece), np.int64)
    found = sorted(found, key=lambda f: (-len(f.faces), f.unit))
    for number, f in enumerate(found, start=1):
        face_part[np.isin(whole.mesh_piece, whole.piece[f.faces])] = number
    present = [n for n in range(1, len(found) + 1) if (face_part == n).any()]
    renumber = np.zeros(len(found) + 1, np.int64)
    renumber[present] = np.arange(1, len(present) + 1)
    if not (face_part == 0).any():
        face_part[:] = 0
        present = []
    parts = [Part("base", "base", 1.0, "what is left when the movable parts are taken")]
    seen: dict[str, int] = {}
    labels = [found[n - 1].label for n in present]
    for n in present:
        f = found[n - 1]
        seen[f.label] = seen.get(f.label, 0) + 1
        name = f.label if labels.count(f.label) == 1 else f"{f.label}_{seen[f.label]}"
        confidence = float(np.clip(0.4 + 0.2 * f.answer.score, 0.05, 0.99))
        parts.append(Part(name, f.label, confidence, f.answer.reason))
    return Segmentation(renumber[face_part], tuple(parts))


__all__ = ["Moves", "segment_parts"]
