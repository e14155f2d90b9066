"""Parts that have numbers in several views: join their pieces, and list those that were lost."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

import numpy as np
from jaxtyping import Int

from anymesh.prompted.masks.fuse import Counts, Instances, Mask

Key = tuple[str, int]  # label and instance number of a part in the answers


def join_numbered(counts: Sequence[Counts], instances: Instances) -> Instances:
    """Join instances of one label that the answers give the same number, unless one view shows them as different parts.

    The vote of the masks cannot join pieces that no view shows together, such as the outside of a door and its shelves inside.
    """
    named = [_votes(c, instances) for c in counts]
    owner = [_most(v[k] for v in named) for k in range(len(instances.labels) + 1)]
    size = np.bincount(np.maximum(instances.number, 0), sum(c.seen for c in counts), len(instances.labels) + 1)
    groups: dict[Key, list[list[int]]] = {}
    for k in (np.argsort(-size[1:], kind="stable") + 1).tolist():
        key = owner[k] or (instances.labels[k - 1], -k)  # an instance without a numbered mask joins no other
        some = groups.setdefault(key, [])
        joined = next((g for g in some if not any(_apart(named, k, other) for other in g)), None)
        some.append([k]) if joined is None else joined.append(k)
    target = np.arange(-1, len(instances.labels) + 1)  # the first entry stands for superpoints that no view shows
    heads = sorted(min(g) for some in groups.values() for g in some)
    for some in groups.values():
        for g in some:
            target[np.array(g) + 1] = heads.index(min(g)) + 1
    return Instances(target[instances.number + 1], tuple(instances.labels[k - 1] for k in heads))


def _votes(c: Counts, instances: Instances) -> list[Counter[Key]]:
    """Return how many of the points of each instance, from 0, lie in the masks of its label in one view, by number."""
    votes = [Counter[Key]() for _ in range(len(instances.labels) + 1)]
    kept = instances.number > 0
    for m, key in enumerate(zip(c.labels, c.instances, strict=True)):
        points = np.bincount(instances.number[kept], c.top[kept, m], len(votes))
        for k in np.flatnonzero(points):
            if instances.labels[k - 1] == key[0]:
                votes[k][key] += int(points[k])
    return votes


def _most(votes: Iterable[Counter[Key]]) -> Key | None:
    """Return the number with most points, None if there is none."""
    total = sum(votes, Counter[Key]())
    return max(total, key=lambda key: (total[key], key), default=None)


def _apart(named: Sequence[Sequence[Counter[Key]]], a: int, b: int) -> bool:
    """Return whether a view that shows both instances gives them different numbers."""
    pairs = [(_most([v[a]]), _most([v[b]])) for v in named]
    return any(one != two for one, two in pairs if one is not None and two is not None)


def lost_parts(
    masks: Sequence[Sequence[Mask]],
    faces: Sequence[Int[np.ndarray, "H W"]],
    face_part: Int[np.ndarray, " F"],
    labels: Sequence[str],
) -> tuple[str, ...]:
    """Return a warning for each label of which some marked parts are no part of their own in any view.

    masks: of each view; faces: face per pixel of each view, -1 for none; face_part: part of each face, 0 for the base;
    labels: of the parts.
    """
    marked, own_parts = set[Key](), set[Key]()
    for some, face in zip(masks, faces, strict=True):
        taken = set[int]()
        for mask in sorted(some, key=lambda m: -int(m.pixels.sum())):
            key = (mask.label, mask.instance)
            marked.add(key)
            on = mask.pixels & (face >= 0)
            part = int(np.bincount(face_part[face[on]]).argmax()) if on.any() else 0
            if part > 0 and labels[part - 1] == mask.label and part not in taken:
                taken.add(part)
                own_parts.add(key)
    lost = Counter(label for label, _ in marked - own_parts)
    return tuple(f"marked, but not found as parts of their own: {n} of label {label!r}" for label, n in sorted(lost.items()))
