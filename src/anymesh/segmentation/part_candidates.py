"""Part candidates: groups of patches that may move together.

Candidates are the nodes of trees over the patches: of the tree that merges those with the most contact, from single patches
on, and for each of the largest patches as base, of the tree of what is attached to it only through what (the dominator tree
of the contacts). Candidates overlap. `segment.assign_parts` decides for all at once which of them are parts.
"""

from __future__ import annotations

import heapq
import itertools
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.geometry.copies import same_spread
from anymesh.geometry.surface import ObjectShape
from anymesh.geometry.triangle_set import principal_spread, surface_moments
from anymesh.segmentation.contacts import Contacts, dominated_by
from anymesh.types import Brief, Mesh
from anymesh.vocabulary import is_fixed_name, named_plurals, recognize, words_of

MIN_PART_RATIO = 0.004  # of the object's diagonal: patches with a smaller one never move on their own
MAX_CANDIDATES = 600  # largest groups of patches that are examined as parts
MIN_AREA_RATIO = 1e-12  # of the surface: area of patches without area, and contact of pairs that have none
BASES = 3  # number of the largest patches that may be the base
MIN_NESTED_SHARE = 0.98  # minimum shared part of the smaller candidate for it to lie within the larger one
MAX_DISJOINT_SHARE = 1e-3  # maximum shared part of the smaller candidate for two candidates to be disjoint


def named_groups(mesh: Mesh, whole: ObjectShape) -> tuple[Int[np.ndarray, " P"], tuple[str, ...]]:
    """Return the number of the group of each patch, from 0, and the recognized name of each patch, or "".

    The patches of a node with a recognized name are one group, all others are groups of their own. The material
    of most of the surface names nothing, nor does the only node, whose name is that of the object.
    """
    faces = np.split(np.argsort(whole.mesh_patch, kind="stable"), np.cumsum(np.bincount(whole.mesh_patch))[:-1])
    names, key = [""] * len(faces), np.arange(len(faces))
    common = int(np.bincount(mesh.face_material + 1, mesh.face_areas).argmax()) - 1
    several = bool((mesh.face_node != mesh.face_node[0]).any())
    for p, mine in enumerate(faces):
        node, material = _most_frequent(mesh.face_node[mine]), _most_frequent(mesh.face_material[mine])
        name = mesh.nodes[node].name if several else ""
        if recognize(name) is not None or is_fixed_name(name):
            names[p], key[p] = name, len(faces) + node
        elif material not in (-1, common) and recognize(mesh.materials[material].name) is not None:
            names[p] = mesh.materials[material].name  # a material names a patch, but does not show that patches move together
    return np.unique(key, return_inverse=True)[1].reshape(-1), tuple(names)


def _most_frequent(numbers: Int[np.ndarray, " n"]) -> int:
    """Return the most frequent number; -1 stands for none."""
    return int(np.bincount(numbers + 1).argmax()) - 1


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


@dataclass(frozen=True, eq=False)
class Overlap(Brief):
    """Spreads of candidates and their shared areas.

    spread: (n, 3) as `PartCandidates.spread`; shared: (n, n) area in both candidates, with the area of each on the diagonal.
    """

    spread: Float[np.ndarray, "n 3"]
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
        """Return which pairs of candidates do not overlap and have the same area and spread, in any rotation or mirrored."""
        return ~self.meet & ~np.eye(len(self.area), dtype=bool) & same_spread(self.area, self.spread)


@dataclass(frozen=True, eq=False)
class PartCandidates(Brief):
    """Groups of patches that may be parts, largest first.

    members: (n, P) which patches each group has; names: (P,) the recognized name of each patch's node or material, or "".
    """

    whole: ObjectShape
    contacts: Contacts
    members: Bool[np.ndarray, "n P"]
    names: tuple[str, ...]

    @cached_property
    def bounds(self) -> Float[np.ndarray, "n 2 3"]:
        """Return the axis-aligned bounds of each group [m]."""
        return np.array([_bounds(self.contacts.patch_bounds, m) for m in self.members]).reshape(-1, 2, 3)

    @cached_property
    def spread(self) -> Float[np.ndarray, "n 3"]:
        """Return the standard deviations of the surface of each group along its principal axes [m], the largest last."""
        center = self.whole.shape.bounds.mean(0)
        patches = np.array([surface_moments(shape.triangles - center) for shape in self.contacts.shapes])
        return principal_spread(np.tensordot(self.members.astype(float), patches, 1))

    @cached_property
    def overlap(self) -> Overlap:
        """Return the overlap of the groups [m^2]."""
        return Overlap(self.spread, (self.members * self.contacts.patch_area) @ self.members.T.astype(float))


def part_candidates(mesh: Mesh, whole: ObjectShape, contacts: Contacts) -> PartCandidates:
    """Return the groups of a mesh that may be parts, without duplicates: the largest MAX_CANDIDATES."""
    bases = np.argsort(-contacts.patch_area, kind="stable")[:BASES]
    group, names = named_groups(mesh, whole)
    attached = (below for base in bases for below in dominated_by(contacts, group, int(group[base])).values())
    single = ([u] for u in range(int(group.max()) + 1))
    masks = (np.isin(group, chosen) for chosen in itertools.chain(single, attached, merged_groups(contacts, group)))
    return PartCandidates(whole, contacts, _largest(whole, contacts, _distinct(masks)), names)


def _distinct(masks: Iterable[Bool[np.ndarray, " P"]]) -> list[Bool[np.ndarray, " P"]]:
    """Return the masks without duplicates and without that of the whole object."""
    return list({np.packbits(mask).tobytes(): mask for mask in masks if not mask.all()}.values())


def _largest(whole: ObjectShape, contacts: Contacts, masks: list[np.ndarray]) -> Bool[np.ndarray, "n P"]:
    """Return the groups with the largest diagonals."""
    bounds = contacts.patch_bounds
    size = np.array([float(np.linalg.norm(np.ptp(_bounds(bounds, m), axis=0))) for m in masks]) / whole.diagonal
    area = contacts.patch_area
    order = [
        int(k) for k in np.lexsort((np.arange(len(masks)), -size)) if size[k] >= MIN_PART_RATIO and area[masks[k]].sum() > 0
    ]
    return np.array([masks[k] for k in order[:MAX_CANDIDATES]], bool).reshape(-1, len(bounds))


def _bounds(patches: Float[np.ndarray, "P 2 3"], members: Bool[np.ndarray, " P"]) -> Float[np.ndarray, "2 3"]:
    mine = patches[members]
    return np.array([mine[:, 0].min(0), mine[:, 1].max(0)])


def name_class(name: str) -> str:
    """Return what a name says: "movable", "fixed", or "" for a handle, which may move with the part that it is attached to."""
    word = recognize(name)
    return "fixed" if is_fixed_name(name) else "movable" if word is not None and word.label != "handle" else ""


def usual_label(mesh: Mesh) -> str:
    """Return door or drawer if the name of the only node has this plural ("Kitchen_3Drawers"), else "part".

    Of the joints of large parts in objects that are named so, 52 of 55 are of the kind (Articraft-10K).
    """
    node = int(mesh.face_node[0])
    several = named_plurals(mesh.nodes[node].name) & {"door", "drawer"} if (mesh.face_node == node).all() else set()
    return several.pop() if len(several) == 1 else "part"


def shared_name(candidates: PartCandidates, candidate: int) -> str:
    """Return the recognized name shared by all patches of a candidate, or the words that all their names begin with."""
    names = {candidates.names[p] for p in np.flatnonzero(candidates.members[candidate])}
    if len(names) == 1:
        return names.pop()
    # the common prefix of the first and last name in order is common to all
    first, *_, last = sorted(words_of(name) for name in names)
    return " ".join(a for a, _ in itertools.takewhile(lambda pair: pair[0] == pair[1], zip(first, last, strict=False)))
