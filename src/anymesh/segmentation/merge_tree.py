"""The tree that merges the patches with the most contact: small groups before large ones, until one group is left."""

from __future__ import annotations

import heapq

import numpy as np
from jaxtyping import Int

from anymesh.segmentation.contacts import Contacts

MIN_AREA_RATIO = 1e-12  # of the surface: area of patches without area, and contact of pairs that have none


def merged_groups(contacts: Contacts, group: Int[np.ndarray, " P"]) -> list[list[int]]:
    """Merge neighbours until one group is left; return all groups that are merged.

    group: the number of the group that each patch begins in, from 0.

    The pair whose smaller group shares the largest part of its contact with the other merges first. Small groups merge before
    large ones, since this share is divided by the geometric mean of both areas. Pairs with a clearance merge after those that
    touch.
    """
    least = MIN_AREA_RATIO * float(contacts.patch_area.sum())
    area = np.maximum(np.bincount(group, contacts.patch_area), least)
    area = dict(enumerate(area / area.sum()))
    contact: dict[int, dict[int, float]] = {}
    near = {(i, j): 0.0 for pair in contacts.near.tolist() for i, j in (pair, pair[::-1])}
    for (i, j), amount in sorted((near | contacts.area).items()):
        a, b = int(group[i]), int(group[j])
        if a != b:
            for x, y in ((a, b), (b, a)):
                row = contact.setdefault(x, {})
                row[y] = row.get(y, 0.0) + max(amount, least)
    members = {k: [k] for k in area}

    def strength(i: int, j: int) -> float:
        small = min((area[i], i), (area[j], j))[1]
        return contact[i][j] / sum(contact[small].values()) / float(np.sqrt(area[i] * area[j]))

    queue = [(-strength(i, j), i, j) for i in sorted(contact) for j in sorted(contact[i]) if i < j]
    heapq.heapify(queue)
    merged, alive = [], set(area)
    while queue:
        _, i, j = heapq.heappop(queue)
        if i not in alive or j not in alive:
            continue
        new = len(members)
        members[new], area[new] = members[i] + members[j], area[i] + area[j]
        alive -= {i, j}
        alive.add(new)
        merged.append(members[new])
        contact[new] = _joined(contact, i, j)
        for other, amount in contact[new].items():
            contact[other].pop(i, None)
            contact[other].pop(j, None)
            contact[other][new] = amount
        for other in sorted(contact[new]):
            heapq.heappush(queue, (-strength(other, new), other, new))
    return merged


def _joined(contact: dict[int, dict[int, float]], i: int, j: int) -> dict[int, float]:
    row: dict[int, float] = {}
    for one in (i, j):
        for other, amount in contact[one].items():
            if other not in (i, j):
                row[other] = row.get(other, 0.0) + amount
    return row
