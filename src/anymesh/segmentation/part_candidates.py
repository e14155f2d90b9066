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
from anymesh.geometry.triangle_set import principal_spread, surface_moments
from anymesh.segmentation.contacts import Contacts, dominated_by
from anymesh.segmentation.merge_tree import merged_groups
from anymesh.segmentation.patch_names import named_groups
from anymesh.types import Mesh

BASES = 3  # number of the largest patches that may be the base
MIN_NESTED_SHARE = 0.98  # minimum shared part of the smaller candidate for it to lie within the larger one
MAX_DISJOINT_SHARE = 1e-3  # maximum shared part of the smaller candidate for two candidates to be disjoint


@dataclass(frozen=True, eq=False)
class Overlap:
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
        area, spread = np.maximum(self.area, 1e-300), self.spread
        same = ~self.meet & ~np.eye(len(area), dtype=bool) & (np.abs(np.log(area[:, None] / area[None])) < 2 * SAME_SIZE)
        return same & (np.abs(spread[:, None] - spread[None]).max(2) < SAME_SIZE * spread[:, None, 2])


@dataclass(frozen=True, eq=False)
class PartCandidates:
    """Groups of patches that may be parts, largest first.

    members: (n, P) which patches each group has; names: (P,) the recognized name of each patch's node or material, or "".
    """

    whole: ObjectShape
    contacts: Contacts
    members: Bool[np.ndarray, "n P"]
    names: tuple[str, ...]

    @property
    def area(self) -> Float[np.ndarray, " n"]:
        """Return the area of each group [m^2]."""
        return self.overlap.area

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
    return PartCandidates(whole, contacts, _largest(whole, contacts, _distinct(masks), min_size, max_candidates), names)


def _distinct(masks: Iterable[Bool[np.ndarray, " P"]]) -> list[Bool[np.ndarray, " P"]]:
    """Return the masks without duplicates and without that of the whole object."""
    return list({np.packbits(mask).tobytes(): mask for mask in masks if not mask.all()}.values())


def _largest(
    whole: ObjectShape, contacts: Contacts, masks: list[np.ndarray], min_size: float, max_candidates: int
) -> Bool[np.ndarray, "n P"]:
    """Return the groups with the largest diagonals."""
    bounds = contacts.patch_bounds
    size = np.array([float(np.linalg.norm(np.ptp(_bounds(bounds, m), axis=0))) for m in masks]) / whole.diagonal
    area = contacts.patch_area
    order = [int(k) for k in np.lexsort((np.arange(len(masks)), -size)) if size[k] >= min_size and area[masks[k]].sum() > 0]
    return np.array([masks[k] for k in order[:max_candidates]], bool).reshape(-1, len(bounds))


def _bounds(patches: Float[np.ndarray, "P 2 3"], members: Bool[np.ndarray, " P"]) -> Float[np.ndarray, "2 3"]:
    mine = patches[members]
    return np.array([mine[:, 0].min(0), mine[:, 1].max(0)])
