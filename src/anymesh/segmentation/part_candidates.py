"""Part candidates: groups of patches that may move together.

Candidates are the nodes of trees over the patches: of the tree that merges those with the most contact, from single patches
on, and for each of the largest patches as base, of the tree of what is attached to it only through what (the dominator tree
of the contacts). Candidates overlap. `part_assignment.py` decides for all at once which of them are parts.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float

from anymesh.config import SAME_SIZE
from anymesh.geometry.patches import ObjectShape
from anymesh.segmentation.contacts import Contacts, dominated_by
from anymesh.segmentation.merge_tree import merged_groups
from anymesh.segmentation.patch_names import named_groups
from anymesh.types import Mesh

BASES = 3  # number of the largest patches that may be the base
MIN_NESTED_SHARE = 0.98  # minimum shared part of the smaller candidate for it to lie within the larger one
MAX_DISJOINT_SHARE = 1e-3  # maximum shared part of the smaller candidate for two candidates to be disjoint


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
    bases = np.argsort(-contacts.patch_area, kind="stable")[:BASES]
    group, names = named_groups(mesh, whole)
    attached = (below for base in bases for below in dominated_by(contacts, group, int(group[base])).values())
    single = ([u] for u in range(int(group.max()) + 1))
    masks = (np.isin(group, chosen) for chosen in itertools.chain(single, attached, merged_groups(contacts, group)))
    members, size = _largest(whole, contacts, _distinct(masks), min_size, max_candidates)
    return PartCandidates(whole, contacts, members, size, names)


def _distinct(masks: Iterable[Bool[np.ndarray, " P"]]) -> list[Bool[np.ndarray, " P"]]:
    """Return the masks without duplicates and without that of the whole object."""
    return list({np.packbits(mask).tobytes(): mask for mask in masks if not mask.all()}.values())


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
