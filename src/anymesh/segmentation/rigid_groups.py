"""Rigid groups: patches that move together, what is attached only through each, and which patch is the likeliest base."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int

from anymesh.config import ALONG_COSINE
from anymesh.geometry.connected import label_connected
from anymesh.geometry.patches import ObjectShape
from anymesh.segmentation.contacts import Contacts, coplanar, dominated_by
from anymesh.types import Mesh
from anymesh.vocabulary import is_fixed_name, recognize

AT_BORDER = 0.02  # of the diagonal: what is this close to a side of the object's bounds reaches it
MAX_SURFACE_SHARE = 0.5  # share of the object's surface above which a creased surface is the object itself


@dataclass(frozen=True, eq=False)
class RigidGroups:
    """Patches joined into groups that move together.

    dominated: of each group, the groups that reach the root only through it, itself first.
    """

    contacts: Contacts
    group: Int[np.ndarray, " P"]
    names: list[str]
    root: int
    dominated: dict[int, list[int]]
    surface: Int[np.ndarray, " P"]  # patches with the same number are separated by creases only

    @cached_property
    def touching(self) -> tuple[Int[np.ndarray, "k 2"], Float[np.ndarray, " k"]]:
        """Return ordered pairs of touching patches of different groups, and the contact area of the first [m^2]."""
        pairs = np.array(list(self.contacts.area), np.int64).reshape(-1, 2)
        apart = self.group[pairs[:, 0]] != self.group[pairs[:, 1]]
        return pairs[apart], np.array(list(self.contacts.area.values()), np.float64)[apart]


def rigid_groups(mesh: Mesh, whole: ObjectShape, contacts: Contacts, root_patch: int, *, divided: bool = False) -> RigidGroups:
    """Join the boards of one plane, the patches of nodes with a recognized name, and those of other components than the root's.

    divided: join those of nodes with a recognized name only. Parts may touch each other and not the base, or lie in its plane.
    """
    shapes = contacts.shapes
    key = np.arange(len(shapes))
    if not divided:
        same = np.array(coplanar(contacts, whole, 1e-3 * whole.diagonal), np.int64).reshape(-1, 2)
        mine = contacts.touching_group == contacts.touching_group[root_patch]
        key = np.where(mine, label_connected(len(shapes), same), len(shapes) + contacts.touching_group)
    names = [""] * len(shapes)
    faces = np.split(np.argsort(whole.mesh_patch, kind="stable"), np.cumsum(np.bincount(whole.mesh_patch))[:-1])
    common = _most(mesh.face_material[faces[root_patch]])
    for p, mine in enumerate(faces):
        node, material = _most(mesh.face_node[mine]), _most(mesh.face_material[mine])
        name = mesh.nodes[node].name
        if recognize(name) is not None or is_fixed_name(name):
            names[p] = name
            key[p] = 2 * len(shapes) + node
        elif material not in (-1, common) and recognize(mesh.materials[material].name) is not None:
            names[p] = mesh.materials[material].name  # a material names a patch, but does not show that patches move together
    _, first, group = np.unique(key, return_index=True, return_inverse=True)
    group = group.reshape(-1)
    root = int(group[root_patch])
    surface = label_connected(len(shapes), np.array(whole.shared, np.int64).reshape(-1, 2))
    return RigidGroups(contacts, group, [names[p] for p in first], root, dominated_by(contacts, group, root), surface)


def _most(numbers: np.ndarray) -> int:
    """Return the most frequent number; -1 stands for none."""
    return int(np.bincount(numbers + 1).argmax()) - 1


def root_ranking(whole: ObjectShape, contacts: Contacts) -> list[int]:
    """Return patch indices ranked as possible base, likeliest first.

    Large patches rank higher, with many contacts, standing on the ground and reaching far. Panels rank last.
    """
    degree = np.bincount(contacts.touch.reshape(-1), minlength=len(contacts.shapes))
    bounds = whole.shape.bounds
    low = bounds[0, 2] + AT_BORDER * whole.diagonal
    rank = []
    for s, d in zip(contacts.shapes, degree, strict=True):
        size = float(np.linalg.norm(s.bounds[1] - s.bounds[0])) * (1 + 0.1 * min(int(d), 10))
        samples = s.samples
        stands = ((samples.points[:, 2] < low) & (samples.normals[:, 2] < -ALONG_COSINE)).mean() if len(samples) else 0.0
        # sides of the object that the patch reaches; walls reach most of them
        sides = int((np.abs(s.bounds - bounds) < AT_BORDER * whole.diagonal).sum())
        rank.append(size * (1.3 if stands > 0.05 else 1.0) * (1 + 0.1 * sides))
    order = np.lexsort((-np.array(rank), np.isin(np.arange(len(rank)), whole.inferred)))
    return [int(i) for i in order]


def with_supported(groups: RigidGroups, u: int) -> list[int]:
    """Return the group, its dependent groups, and the rest of its surface with theirs.

    The rest of its surface is, for example, the box behind a drawer's panel. If the group is the whole surface, the smaller
    groups with most of their contact on these members are added (a shelf on a door).
    """
    surface = _of_one_surface(groups, u)
    members = set(groups.dominated[u]).union(*(groups.dominated[v] for v in surface))
    if not surface:
        members = _grown(groups, members)
    return [u, *sorted(members - {u, groups.root})]


def _grown(groups: RigidGroups, members: set[int]) -> set[int]:
    (first, second), amount = groups.touching[0].T, groups.touching[1]
    count = len(groups.names)
    area = np.bincount(groups.group, groups.contacts.patch_area, count)
    own = groups.contacts.patch_area[np.isin(groups.group, list(members))].sum()
    for _ in range(4):
        inside = np.isin(groups.group, list(members))
        outer = ~inside[first]
        beside, within = groups.group[first[outer]], inside[second[outer]]
        here = np.bincount(beside[within], amount[outer][within], count)
        elsewhere = np.bincount(beside[~within], amount[outer][~within], count)
        new = [int(v) for v in np.flatnonzero((here > elsewhere) & (area < own)) if v != groups.root]
        grown = members.union(*(groups.dominated[v] for v in new)) - {groups.root}
        if grown == members:
            break
        members = grown
    return members


def _of_one_surface(groups: RigidGroups, u: int) -> list[int]:
    """Return the groups separated from this one by creases only, unless their surface is the root's or most of the object."""
    surface, area = groups.surface, groups.contacts.patch_area
    own = np.isin(surface, surface[groups.group == u])
    if own[groups.group == groups.root].any() or area[own].sum() > MAX_SURFACE_SHARE * area.sum():
        return []
    return [int(v) for v in np.unique(groups.group[own]) if v != u]
