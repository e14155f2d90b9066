"""Part candidates: groups of patches that may move together.

Candidates are each rigid group of patches alone, with all that is attached only through it, and with the rest of its surface,
for each of the likeliest bases; the same for single patches; and the groups of a tree that merges those with the
most contact. Candidates overlap. `part_assignment.py` decides for all at once which of them are parts.
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float

from anymesh.config import SAME_SIZE
from anymesh.geometry.patches import ObjectShape
from anymesh.segmentation.contacts import Contacts
from anymesh.segmentation.rigid_groups import RigidGroups, rigid_groups, root_ranking, with_supported
from anymesh.types import Mesh

BASES = 3  # number of base patches for which candidates are listed
MIN_NESTED_SHARE = 0.98  # minimum shared part of the smaller candidate for it to lie within the larger one
MAX_DISJOINT_SHARE = 1e-3  # maximum shared part of the smaller candidate for two candidates to be disjoint
MIN_AREA_RATIO = 1e-12  # share of the surface used as the area of patches without area


@dataclass(frozen=True, eq=False)
class Overlap:
    """Sizes of candidates and their shared areas.

    size: (n,) in any unit; shared: (n, n) area in both candidates, with the area of each on the diagonal.
    """

    size: Float[np.ndarray, " n"]
    shared: Float[np.ndarray, "n n"]

    @property
    def area(self) -> Float[np.ndarray, " n"]:
        """Return the area of each candidate."""
        return np.diag(self.shared)

    @cached_property
    def iou(self) -> Float[np.ndarray, "n n"]:
        """Return the intersection over union of each pair of candidates, by area."""
        return self.shared / np.maximum(self.area[:, None] + self.area[None] - self.shared, 1e-300)

    @cached_property
    def meet(self) -> Bool[np.ndarray, "n n"]:
        """Return which candidates overlap."""
        overlaps = self.shared > MAX_DISJOINT_SHARE * np.minimum(self.area[:, None], self.area[None])
        np.fill_diagonal(overlaps, False)
        return overlaps

    @cached_property
    def nested(self) -> Bool[np.ndarray, "n n"]:
        """Return which pairs of candidates overlap with the smaller one inside the larger one."""
        return self.meet & (self.shared > MIN_NESTED_SHARE * np.minimum(self.area[:, None], self.area[None]))

    @cached_property
    def copies(self) -> Bool[np.ndarray, "n n"]:
        """Return which pairs of candidates do not overlap and have the same area and size."""
        area = np.maximum(self.area, 1e-300)
        same = ~self.meet & ~np.eye(len(area), dtype=bool) & (np.abs(np.log(area[:, None] / area[None])) < 2 * SAME_SIZE)
        return same & (np.abs(self.size[:, None] - self.size[None]) < SAME_SIZE * self.size[:, None])


@dataclass(frozen=True, eq=False)
class PartCandidates:
    """Groups of patches that may be parts, largest first.

    members: (n, P) which patches each group has; size: (n,) diagonal relative to the object's.
    """

    whole: ObjectShape
    contacts: Contacts
    members: Bool[np.ndarray, "n P"]
    size: Float[np.ndarray, " n"]
    names: tuple[str, ...]  # (P,) the recognized name of each patch's node or material, or ""

    @property
    def area(self) -> Float[np.ndarray, " n"]:
        """Return the area of each group [m^2]."""
        return self.overlap.area

    @cached_property
    def bounds(self) -> Float[np.ndarray, "n 2 3"]:
        """Return the axis-aligned bounds of each group [m]."""
        return np.array([_bounds(self.contacts.patch_bounds, m) for m in self.members]).reshape(-1, 2, 3)

    @cached_property
    def overlap(self) -> Overlap:
        """Return the overlap of the groups [m^2]."""
        return Overlap(self.size, (self.members * self.contacts.patch_area) @ self.members.T.astype(float))


def part_candidates(mesh: Mesh, whole: ObjectShape, contacts: Contacts, min_size: float, max_candidates: int) -> PartCandidates:
    """Return the groups of a mesh that may be parts, without duplicates.

    min_size: minimum diagonal of a group, as a share of the object's; max_candidates: maximum number of groups, of which the
    largest are kept.
    """
    masks: dict[bytes, Bool[np.ndarray, " P"]] = {}

    def add(mask: Bool[np.ndarray, " P"]) -> None:
        if not mask.all():
            masks.setdefault(np.packbits(mask).tobytes(), mask)

    ranking = root_ranking(whole, contacts)
    joined = [rigid_groups(mesh, whole, contacts, base) for base in ranking[:BASES]]
    divided = rigid_groups(mesh, whole, contacts, ranking[0], divided=True)
    names = [divided.names[g] for g in divided.group]
    for groups in (*joined, divided):
        for u in sorted(groups.dominated):
            if u != groups.root:
                for chosen in ([u], groups.dominated[u], with_supported(groups, u)):
                    add(np.isin(groups.group, chosen))
    for groups in (joined[0], divided):
        for merged in _merges(groups):
            add(np.isin(groups.group, merged))
    members, size = _largest(whole, contacts, list(masks.values()), min_size, max_candidates)
    return PartCandidates(whole, contacts, members, size, tuple(names))


def _largest(
    whole: ObjectShape, contacts: Contacts, masks: list[np.ndarray], min_size: float, max_candidates: int
) -> tuple[Bool[np.ndarray, "n P"], Float[np.ndarray, " n"]]:
    """Return the largest groups and their diagonals relative to the object's."""
    bounds = contacts.patch_bounds
    size = np.array([float(np.linalg.norm(np.ptp(_bounds(bounds, m), axis=0))) for m in masks]) / whole.diagonal
    area = contacts.patch_area
    order = [int(k) for k in np.lexsort((np.arange(len(masks)), -size)) if size[k] >= min_size and area[masks[k]].sum() > 0]
    order = order[:max_candidates]
    members = np.array([masks[k] for k in order], bool).reshape(len(order), len(bounds))
    return members, size[order]


def _bounds(patches: Float[np.ndarray, "P 2 3"], members: Bool[np.ndarray, " P"]) -> Float[np.ndarray, "2 3"]:
    mine = patches[members]
    return np.array([mine[:, 0].min(0), mine[:, 1].max(0)])


def _merges(groups: RigidGroups) -> list[list[int]]:
    """Merge neighbours until one group is left; return all intermediate groups.

    The pair whose smaller group shares the largest part of its contact with the other merges first. Small groups merge before
    large ones.
    """
    count = len(groups.names)
    area = np.maximum(
        np.bincount(groups.group, groups.contacts.patch_area, count), MIN_AREA_RATIO * groups.contacts.patch_area.sum()
    )
    area = dict(enumerate(area / area.sum()))
    contact: dict[int, dict[int, float]] = {}
    for (i, j), amount in sorted(groups.contacts.area.items()):
        a, b = int(groups.group[i]), int(groups.group[j])
        if a != b:
            for x, y in ((a, b), (b, a)):
                row = contact.setdefault(x, {})
                row[y] = row.get(y, 0.0) + max(amount, MIN_AREA_RATIO)
    members = {k: [k] for k in range(count)}

    def strength(i: int, j: int) -> float:
        small = min((area[i], i), (area[j], j))[1]
        return contact[i][j] / sum(contact[small].values()) / float(np.sqrt(area[small]))

    queue = [(-strength(i, j), i, j) for i in sorted(contact) for j in sorted(contact[i]) if i < j]
    heapq.heapify(queue)
    merged_groups, alive = [], set(range(count))
    while queue:
        value, i, j = heapq.heappop(queue)
        if i not in alive or j not in alive:
            continue
        if (now := -strength(i, j)) > value + 1e-12:
            heapq.heappush(queue, (now, i, j))
            continue
        new = len(members)
        members[new], area[new] = members[i] + members[j], area[i] + area[j]
        alive = alive - {i, j} | {new}
        merged_groups.append(members[new])
        contact[new] = _joined(contact, i, j)
        for other, amount in contact[new].items():
            contact[other].pop(i, None)
            contact[other].pop(j, None)
            contact[other][new] = amount
        for other in sorted(contact[new]):
            heapq.heappush(queue, (-strength(other, new), other, new))
    return merged_groups


def _joined(contact: dict[int, dict[int, float]], i: int, j: int) -> dict[int, float]:
    row: dict[int, float] = {}
    for one in (i, j):
        for other, amount in contact[one].items():
            if other not in (i, j):
                row[other] = row.get(other, 0.0) + amount
    return row
