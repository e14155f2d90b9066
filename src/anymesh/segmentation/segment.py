"""Stage A (paper, 3.2) by geometry: find the movable parts of an unlabelled mesh.

Steps: patches and their contacts, candidate groups of patches, geometric features of each, a learned score, and the set of
groups with the most parts to be expected. Groups that cannot move are removed, and the set is chosen again.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
from jaxtyping import Float, Int

from anymesh.geometry.patches import ObjectShape
from anymesh.runtime import SEGMENT, Deadline, Progress, silent, usable_cores
from anymesh.scoring import by_hand
from anymesh.segmentation.contacts import find_contacts
from anymesh.segmentation.naming import named_parts
from anymesh.segmentation.part_assignment import assign_parts, conflicts, join_floating
from anymesh.segmentation.part_candidates import PartCandidates, name_class, part_candidates, shared_name
from anymesh.segmentation.part_classifier import score_parts, shipped_classifier
from anymesh.segmentation.part_features import FeatureInputs, candidate_context, part_features
from anymesh.types import Mesh, Segmentation
from anymesh.vocabulary import recognize

LabelParts = Callable[[Segmentation], Sequence[str]]  # label per part except the base from its motion, "" if it cannot move
MAX_ASSIGNMENTS = 3  # maximum number of assignments, each without the candidates that turned out to be fixed


def segment_parts(
    mesh: Mesh, whole: ObjectShape, label_parts: LabelParts, at_least: int = 0, progress: Progress = silent,
    deadline: Deadline | None = None,
) -> Segmentation:  # fmt: skip
    """Return the movable parts of a mesh and its base, which is the rest.

    label_parts: stage B's test of how parts move, with "" for a part that cannot; at_least: minimum number of parts, even with
    weak evidence, for objects that are known to move.

    After the deadline no further contact is measured and no further candidate examined.
    """
    progress("segment", "contacts", 0, 2)
    deadline = deadline or Deadline()
    contacts = find_contacts(whole, deadline)
    candidates = part_candidates(mesh, whole, contacts)
    progress("segment", "candidates", 1, 2)
    examined, place, features = examine_candidates(mesh, candidates, progress, deadline)
    score, reasons = score_parts(examined, place, features)
    words = [shared_name(examined, k) for k in range(len(score))]
    score = score + np.array([by_hand.NAME_SCORE.get(name_class(word), 0.0) for word in words])
    classifier = shipped_classifier()
    known = [word.label if (word := recognize(w)) else "" for w in words]

    def segmentation(face_part: Int[np.ndarray, " F"], order: list[int], labels: list[str], likely: list[int]) -> Segmentation:
        confidence = [classifier.confidence(float(score[k])) for k in order]
        why = [_reason(learned, words[k], k in likely) for k, learned in zip(order, reasons(order), strict=True)]
        return named_parts(face_part, [known[k] or label for k, label in zip(order, labels, strict=True)], mesh.face_areas,
                           confidence, why)  # fmt: skip

    probability, likely = classifier.probability(score), list[int]()
    free = probability.copy()  # 0 for candidates that turned out to be fixed
    for _ in range(MAX_ASSIGNMENTS):
        likely = assign_parts(examined.overlap, free)
        face_part, order = _face_part(mesh, examined, _filled(examined, free, likely, at_least))
        labels = list(label_parts(segmentation(face_part, order, ["part"] * len(order), likely)))
        fixed = [k for k, label in zip(order, labels, strict=True) if not label]
        if not fixed or deadline.late(SEGMENT):
            break
        free[fixed] = 0  # the same part with its handle, or another one, may move
    moving = {k: label for k, label in zip(order, labels, strict=True) if label}
    if len(moving) < at_least:
        face_part, order = _face_part(mesh, examined, _filled(examined, probability, list(moving), at_least))
        labels = [moving.get(k, "part") for k in order]
    still = [n for n, label in enumerate(labels, start=1) if not label]
    return segmentation(np.where(np.isin(face_part, still), 0, face_part), order, labels, likely)


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
    reasons = [f'named "{name}"'] if name_class(name) else []
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
    for k in sorted(chosen, key=lambda k: (-candidates.area[k], k)):
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
