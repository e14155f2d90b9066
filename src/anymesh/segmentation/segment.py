"""Stage A (paper, 3.2) by geometry: find the movable parts of an unlabelled mesh.

Steps: patches and their contacts, candidate groups of patches, geometric features of each, a learned score, and the set of
groups with the most parts to be expected. Groups that cannot move are removed, and the set is chosen again.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.sparse import csr_array

from anymesh.entry_points import DESCRIBED, resolve
from anymesh.geometry.surface import ObjectShape
from anymesh.geometry.topology import label_connected
from anymesh.names import NAMED
from anymesh.runtime import SEGMENT, Deadline, Progress, silent, usable_cores
from anymesh.scoring import by_hand
from anymesh.scoring.classifier import KindPrior
from anymesh.segmentation.contacts import Contacts, find_contacts
from anymesh.segmentation.naming import named_parts
from anymesh.segmentation.part_candidates import (
    MIN_NESTED_SHARE,
    Overlap,
    PartCandidates,
    name_class,
    part_candidates,
    shared_name,
    usual_label,
)  # fmt: skip
from anymesh.segmentation.part_classifier import score_parts, shipped_classifier
from anymesh.segmentation.part_features import FeatureInputs, candidate_context, part_features
from anymesh.types import Mesh, Segmentation
from anymesh.vocabulary import recognize

MIN_PART_PROBABILITY = 0.3  # of a part; F1 on kinds left out of training is the same from .25 to .35
UNLIKELY = 0.05  # probability below which a candidate does not count
NEARLY = 2  # candidates that are named where there is no part
MIN_COPIES = 2  # number of copies of a candidate that are parts from which it is one too, if they are most of its copies
MAX_TRIED = 10  # candidates in conflict, directly or through others, up to which all sets are tried
TIE = 1e-6  # difference of sums of probabilities below which two sets are equally good
MIN_USUAL_RATIO = 0.2  # of the diagonal: a smaller candidate is not of the kind that the object's name has in the plural
MIN_DUPLICATE_IOU = 0.3  # minimum IoU at which a candidate within another one is the same part


def conflicts(overlap: Overlap) -> Bool[np.ndarray, "n n"]:
    """Return which pairs of candidates cannot both be parts because they cross or are nearly the same.

    A part may carry a smaller one (a knob on a door). It keeps the faces that the smaller one does not have.
    """
    return overlap.meet & (~overlap.nested | (overlap.iou > MIN_DUPLICATE_IOU))


def assign_parts(overlap: Overlap, probability: Float[np.ndarray, " n"]) -> list[int]:
    """Return the indices of the candidates that are parts, in ascending order.

    The expected F1 of a set without conflicts is twice its expected number of parts, over its size and the expected number of
    parts of the object together. A candidate raises it if its probability is above half of it, so beside certain parts, an
    uncertain candidate is not taken. The set returned has the most parts to be expected above this minimum, and above
    MIN_PART_PROBABILITY.

    probability: that each candidate is a part.
    """
    clash = conflicts(overlap)
    likely = probability[likely_parts(clash, probability)]
    f1 = 2 * likely.cumsum() / (np.arange(1, len(likely) + 1) + likely.sum())
    return _best_set(probability - max(f1.max(initial=0.0) / 2, MIN_PART_PROBABILITY), clash)


def prefer_copies(overlap: Overlap, probability: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
    """Return the probabilities, 0 for the union of copies of which more are parts to be expected, and their mean for these.

    Two drawers that touch may look like one part, but one part does not look like two copies.
    """
    chance, likely, area = probability.copy(), np.flatnonzero(probability > UNLIKELY), overlap.area
    for k in likely:
        inside = likely[overlap.nested[k, likely] & (area[likely] < area[k])]
        for first in inside:
            twins = inside[overlap.copies[first, inside]]
            alike = [first, *twins[likely_parts(overlap.meet[np.ix_(twins, twins)], probability[twins])]]
            mean, whole = probability[alike].mean(), area[alike].sum() > MIN_NESTED_SHARE * area[k]
            if whole and mean > MIN_PART_PROBABILITY and mean * len(alike) > probability[k]:
                chance[k], chance[alike] = 0, np.maximum(chance[alike], mean)
    return chance


def with_copies(overlap: Overlap, chosen: list[int], probability: Float[np.ndarray, " n"]) -> list[int]:
    """Return what is chosen, and candidates of whose copies most, and at least two, are chosen: the fourth of four wheels.

    probability: of each candidate; copies without one, or in conflict with what is chosen, are left out.
    """
    clash, copies = conflicts(overlap), overlap.copies
    for k in np.argsort(-probability, kind="stable"):
        taken = int(copies[k, chosen].sum())
        most = taken >= MIN_COPIES and 2 * taken > copies[k].sum() + 1
        if most and k not in chosen and probability[k] > UNLIKELY and not clash[k, chosen].any():
            chosen = sorted([*chosen, int(k)])
    return chosen


def likely_parts(clash: Bool[np.ndarray, "n n"], probability: Float[np.ndarray, " n"]) -> list[int]:
    """Return candidates without conflicts, likeliest first, each the likeliest that earlier ones allow.

    clash: as from `conflicts`; probability: that each candidate is a part.
    """
    left, chosen = probability > UNLIKELY, list[int]()
    for k in np.argsort(-probability, kind="stable"):
        if left[k]:
            chosen.append(int(k))
            left &= ~clash[k]
    return chosen


def _best_set(gain: Float[np.ndarray, " n"], clash: Bool[np.ndarray, "n n"]) -> list[int]:
    """Return the set without conflicts of the highest sum of gains, in ascending order.

    All sets of few candidates are tried; the others, and those with two best sets, are solved by mixed-integer programming.
    """
    positive = np.flatnonzero(gain > 0)
    gain, clash = gain[positive], clash[np.ix_(positive, positive)]
    cluster = label_connected(len(positive), np.argwhere(clash)) if len(positive) else positive
    chosen, hard = np.zeros(len(positive), bool), np.zeros(len(positive), bool)
    for mine in (np.flatnonzero(cluster == k) for k in np.unique(cluster)):
        best = _single_best(gain[mine], clash[np.ix_(mine, mine)]) if len(mine) <= MAX_TRIED else None
        hard[mine] = best is None
        chosen[mine] = False if best is None else best
    if hard.any():
        chosen[hard] = _by_programming(gain[hard], clash[np.ix_(hard, hard)])
    return [int(k) for k in positive[chosen]]


def _single_best(gain: Float[np.ndarray, " n"], clash: Bool[np.ndarray, "n n"]) -> Bool[np.ndarray, " n"] | None:
    """Return the set without conflicts of highest gain by trying all; None if another is as good."""
    sets = (np.arange(2 ** len(gain))[:, None] >> np.arange(len(gain))) & 1
    total = np.where(((sets @ clash) * sets).any(1), -np.inf, sets @ gain)
    best = int(total.argmax())
    return None if (total > total[best] - TIE).sum() > 1 else sets[best].astype(bool)


def _by_programming(gain: Float[np.ndarray, " n"], clash: Bool[np.ndarray, "n n"]) -> Bool[np.ndarray, " n"]:
    from scipy.optimize import Bounds, LinearConstraint, milp  # import on use: it takes 0.4 s, and most objects do without

    first, second = np.nonzero(np.triu(clash))
    row = np.arange(len(first)).repeat(2)
    pairs = csr_array((np.ones(len(row)), (row, np.stack([first, second], 1).reshape(-1))), (len(first), len(gain)))
    solution = milp(-gain, integrality=np.ones(len(gain)), bounds=Bounds(0, 1), constraints=LinearConstraint(pairs, ub=1))
    return np.round(solution.x).astype(bool)


def join_floating(owner: Int[np.ndarray, " P"], contacts: Contacts) -> Int[np.ndarray, " P"]:
    """Return the part of each patch, with patches that only one part supports joined to that part.

    Otherwise a handle would float once its door opens.
    owner: (P,) the part of each patch, -1 for the base.

    Patches of the base that touch each other form a group. A group joins a part if it touches nothing else and is smaller than
    the part. The largest group stays the base. A part is given up first if its pieces hang on several other parts, each on one.
    """
    owner, (first, second) = _in_one_place(owner, contacts), contacts.touch.T
    inside = (owner[first] < 0) & (owner[second] < 0)
    group = label_connected(len(owner), contacts.touch[inside])
    area = np.bincount(group[owner < 0], contacts.patch_area[owner < 0], int(group.max()) + 1)
    held: dict[int, set[int]] = {}
    for a, b in ((first, second), (second, first)):
        for k in np.flatnonzero((owner[a] < 0) & (owner[b] >= 0)):
            held.setdefault(int(group[a[k]]), set()).add(int(owner[b[k]]))
    new_owner = owner.copy()
    for g, by in held.items():
        part = min(by)
        if len(by) == 1 and g != area.argmax() and area[g] < contacts.patch_area[owner == part].sum():
            new_owner[(group == g) & (owner < 0)] = part
    return new_owner


def _in_one_place(owner: Int[np.ndarray, " P"], contacts: Contacts) -> Int[np.ndarray, " P"]:
    """Return the owners with -1 for parts of which each piece touches one other part only, but not all the same one."""
    pairs = np.concatenate([contacts.touch, contacts.touch[:, ::-1]])
    piece = label_connected(len(owner), pairs[owner[pairs[:, 0]] == owner[pairs[:, 1]]])
    kept = owner.copy()
    for part in np.unique(owner[owner >= 0]):
        held = [set(owner[pairs[piece[pairs[:, 0]] == g, 1]]) - {part} for g in np.unique(piece[owner == part])]
        if all(len(one) == 1 and -1 not in one for one in held) and len(set().union(*held)) > 1:
            kept[owner == part] = -1
    return kept


LabelParts = Callable[[Segmentation], Sequence[str]]  # label per part except the base from its motion, "" if it cannot move
MAX_ASSIGNMENTS = 3  # maximum number of assignments, each without the candidates that turned out to be fixed


def segment_parts(
    mesh: Mesh, whole: ObjectShape, label_parts: LabelParts, at_least: int = 0, progress: Progress = silent,
    deadline: Deadline | None = None, kind: KindPrior | None = None,
) -> Segmentation:  # fmt: skip
    """Return the movable parts of a mesh and its base, which is the rest.

    whole: the object's shape; label_parts: stage B's test of how parts move, with "" for a part that cannot; at_least: minimum
    number of parts, even with weak evidence, for objects that are known to move; kind: parts of the object's kind.

    After the deadline no further contact is measured and no further candidate examined.
    """
    progress("segment", "contacts", 0, 2)
    deadline = deadline or Deadline()
    candidates = part_candidates(mesh, whole, find_contacts(whole, deadline))
    progress("segment", "candidates", 1, 2)
    examined, place, features = examine_candidates(mesh, candidates, progress, deadline)
    score, reasons = score_parts(examined, place, features)
    words, classifier = [shared_name(examined, k) for k in range(len(score))], shipped_classifier()
    score = score + np.array([by_hand.NAME_SCORE.get(name_class(word), 0.0) for word in words])
    score = kind.part_scores(score, place, conflicts(examined.overlap)) if kind and len(score) else score
    known = [word.label if (word := recognize(w)) else "" for w in words]
    sizes, plural = np.linalg.norm(np.ptp(examined.bounds, axis=1), axis=1) / examined.whole.diagonal, usual_label(mesh)
    usual = ["part" if size < MIN_USUAL_RATIO else plural for size in sizes]

    def segmentation(face_part: Int[np.ndarray, " F"], order: list[int], labels: list[str], likely: list[int]) -> Segmentation:
        confidence = [classifier.confidence(float(score[k])) for k in order]
        why = [_reason(learned, words[k], k in likely) for k, learned in zip(order, reasons(order), strict=True)]
        return named_parts(face_part, [known[k] or label for k, label in zip(order, labels, strict=True)], mesh.face_areas,
                           confidence, why)  # fmt: skip

    probability, likely = classifier.probability(score), list[int]()
    free = probability.copy()  # 0 for candidates that turned out to be fixed
    for _ in range(MAX_ASSIGNMENTS):
        chance = prefer_copies(examined.overlap, free)
        likely = with_copies(examined.overlap, assign_parts(examined.overlap, chance), chance)
        face_part, order = _face_part(mesh, examined, _filled(examined, chance, likely, at_least))
        labels = list(label_parts(segmentation(face_part, order, [usual[k] for k in order], likely)))
        fixed = [k for k, label in zip(order, labels, strict=True) if not label]
        if not fixed or deadline.late(SEGMENT):
            break
        free[fixed] = 0  # the same part with its handle, or another one, may move
    moving = {k: label for k, label in zip(order, labels, strict=True) if label}
    if len(moving) < at_least:
        face_part, order = _at_least(mesh, examined, probability, list(moving), at_least)
        labels = [moving.get(k, "part") for k in order]
    still = [n for n, label in enumerate(labels, start=1) if not label]
    parts = segmentation(np.where(np.isin(face_part, still), 0, face_part), order, labels, likely)
    nearly = "" if len(parts.parts) > 1 else _nearly(mesh, examined, probability, words)
    return replace(parts, nearly=nearly)


def _at_least(
    mesh: Mesh, candidates: PartCandidates, probability: Float[np.ndarray, " n"], chosen: list[int], count: int
) -> tuple[Int[np.ndarray, " F"], list[int]]:
    """Return `_face_part` with the best other candidates, so many that `count` have faces of their own, if possible."""
    more = count
    while True:
        filled = _filled(candidates, probability, chosen, more)
        face_part, order = _face_part(mesh, candidates, filled)
        if len(order) >= count or len(filled) < more:
            return face_part, order
        more += 1


def _nearly(mesh: Mesh, candidates: PartCandidates, probability: Float[np.ndarray, " n"], words: Sequence[str]) -> str:
    """Return the likeliest candidates in words, with their probabilities; "" without any."""
    likeliest = sorted(_filled(candidates, probability, [], NEARLY), key=lambda k: (-probability[k], k))
    boxes, whole, describe = candidates.bounds, mesh.bounds, resolve(DESCRIBED)
    return ", ".join(f"{describe(boxes[k], whole, words[k])} (probability {probability[k]:.2g})" for k in likeliest)


def examine_candidates(
    mesh: Mesh, candidates: PartCandidates, progress: Progress = silent, deadline: Deadline | None = None
) -> tuple[PartCandidates, Float[np.ndarray, "n 12"], list[dict[str, float]]]:
    """Return the examined candidates, and the place and the features of each."""
    inputs, limit = FeatureInputs.of(mesh, candidates), deadline or Deadline()

    def measure(k: int) -> tuple[Float[np.ndarray, " 12"], dict[str, float]] | None:
        if limit.late(SEGMENT):
            limit.leave_out("segmentation: some candidates for parts were not examined")
            return None
        context = candidate_context(inputs, k)
        return None if context is None else (context.place, part_features(inputs, k, context))

    kept, places, features = [], [], []
    with ThreadPoolExecutor(usable_cores()) as threads:  # ray casts and distances release the interpreter lock
        for k, measured in enumerate(threads.map(measure, range(len(candidates.members)))):
            progress("segment", f"candidate {k}", k, len(candidates.members))
            if measured is not None:
                kept.append(k)
                places.append(measured[0])
                features.append(measured[1])
    examined = replace(candidates, members=candidates.members[kept])
    return examined, np.array(places).reshape(-1, 12), features


def _reason(learned: str, name: str, likely: bool) -> str:
    reasons = [f'{NAMED} "{name}"'] if name_class(name) else []
    reasons += [] if likely else ["stands out most, where parts were asked for"]
    return "; ".join([*reasons, learned])


def _filled(candidates: PartCandidates, probability: Float[np.ndarray, " n"], chosen: list[int], count: int) -> list[int]:
    """Add the best other candidates without conflicts until there are at least `count`."""
    if len(chosen) >= count:
        return chosen
    apart = ~conflicts(candidates.overlap)
    for k in np.argsort(-probability, kind="stable"):
        if len(chosen) < count and int(k) not in chosen and apart[k, chosen].all() and probability[k] > 0:
            chosen = sorted([*chosen, int(k)])
    return chosen


def _face_part(mesh: Mesh, candidates: PartCandidates, chosen: list[int]) -> tuple[Int[np.ndarray, " F"], list[int]]:
    """Return a part index per face, 0 for the base, and the candidates in part order.

    The largest come first, without the faces of parts that they carry. Candidates without faces of their own are left out, and
    the largest becomes the base if nothing else is left for it.
    """
    owner = np.full(len(candidates.contacts.shapes), -1)
    for k in sorted(chosen, key=lambda k: (-candidates.overlap.area[k], k)):
        owner[candidates.members[k]] = k
    of_face = join_floating(owner, candidates.contacts)[candidates.whole.mesh_patch]
    area = np.bincount(of_face + 1, mesh.face_areas, len(candidates.members) + 1)[1:]
    order = [int(k) for k in np.unique(of_face[of_face >= 0])]
    order.sort(key=lambda k: (-area[k], k))
    number = np.zeros(len(candidates.members) + 1, np.int64)
    number[np.array(order, np.int64) + 1] = np.arange(1, len(order) + 1)
    face_part = number[of_face + 1]
    if order and face_part.all():
        return _face_part(mesh, candidates, order[1:])
    return face_part, order
