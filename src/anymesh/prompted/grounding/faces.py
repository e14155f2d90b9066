"""Parts of faces: patches join a part as a whole, or are cut; unseen ones join the part that supports them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import KDTree

from anymesh.articulation.candidate_motions import Candidate
from anymesh.articulation.estimate import all_motions
from anymesh.articulation.evidence import sweep_candidates
from anymesh.articulation.part_contexts import parents, part_context
from anymesh.articulation.rank_motions import rank_motions
from anymesh.geometry.surface import ObjectShape
from anymesh.geometry.topology import label_connected
from anymesh.motion.part_context import PartContext
from anymesh.prompted.grounding.cloud import Cloud
from anymesh.prompted.grounding.fuse import Instances
from anymesh.segmentation.contacts import Contacts, dominated_by, find_contacts
from anymesh.segmentation.divide import FUSED_SIZE_RATIO
from anymesh.types import JointType, Mesh
from anymesh.types.triangles import boxes_meet, corner_bounds, label_bounds, lengths

UNSEEN = -1
StaysFree = Callable[[Int[np.ndarray, " R"], Int[np.ndarray, " R"], int], bool]
"""Return whether a part opens as far with unseen patches as without.

Arguments: the part index per face of the object's shape without and with the unseen patches, and the part.
"""

MIN_COMPONENT_SHARE = 0.5  # a component joins the part of this share of its visible surface (as in the paper's implementation)
MIN_SEEN_SHARE = 0.02  # minimum visible share of a patch's surface; less is a glimpse through a gap
JOIN_RATIO = 0.03  # of the diagonal: maximum distance of a component that joins a part
# minimum share of a patch's visible surface in one part for that part to take the whole patch, if the patch may hold several
# parts because it is large or was cut out of a fused surface
MIN_CUTTABLE_PATCH_SHARE = 0.85
MOTIONS_PER_TYPE = 4  # likeliest motions of each kind, one of which must stay free with the gained patches
MIN_FREE_RATIO = 0.8  # minimum opening of a part with gained patches, relative to its opening without them
SUFFICIENT_OPENING = float(np.deg2rad(60))  # [rad, or share of the tolerance length] larger openings are not compared


def join_unseen(whole: ObjectShape, part: Int[np.ndarray, " P"], stays_free: StaysFree | None = None) -> Int[np.ndarray, " P"]:
    """Assign unseen patches (part -1) to the parts that support them, the others to the base.

    A part does not gain patches that would limit its motion, such as the walls of a cavity behind its door.
    """
    joined = np.maximum(_joined(whole, part), 0)
    gaining = np.unique(joined[(part < 0) & (joined > 0)])
    if stays_free is None:
        return joined
    for k in gaining:
        without = np.where((part < 0) & (joined == k), 0, joined)
        if not stays_free(without[whole.patch], joined[whole.patch], int(k)):
            joined = without
    return joined


def _joined(whole: ObjectShape, part: Int[np.ndarray, " P"]) -> Int[np.ndarray, " P"]:
    """Return the part of every patch, including unseen ones.

    An unseen patch takes the part of all visible patches that it touches, directly or through others. Otherwise it takes the
    part on which it depends, that it touches more than all others, or that alone is near.
    """
    if (part >= 0).all() or part.max() <= 0:
        return part
    contacts = find_contacts(whole)
    reach = JOIN_RATIO * whole.diagonal
    part = _single_part_components(contacts.touching_group, part)
    for together in (False, True):  # first one by one, then connected patches (a drawer's box) as one
        part = np.where(_goes_on(whole, part), 0, _supported_by(contacts, part, together, reach))
    return part


def _goes_on(whole: ObjectShape, part: np.ndarray) -> Bool[np.ndarray, " P"]:
    """Return unseen patches that continue a fused surface into the base, such as a strip of floor behind a drawer's panel."""
    adjoins_base = np.zeros(len(part), bool)
    if len(whole.shared):
        a, b = whole.shared.T
        adjoins_base[a[part[b] == 0]] = adjoins_base[b[part[a] == 0]] = True
    return adjoins_base & (part < 0)


def _single_part_components(component: np.ndarray, part: np.ndarray) -> Int[np.ndarray, " P"]:
    """Assign unseen patches to the only visible part of their component."""
    least, most = np.full(int(component.max()) + 1, np.iinfo(np.int64).max), np.full(int(component.max()) + 1, UNSEEN)
    np.minimum.at(least, component[part >= 0], part[part >= 0])
    np.maximum.at(most, component, part)
    one = (least == most) & (most >= 0)
    return np.where((part < 0) & one[component], most[component], part)


def _supported_by(contacts: Contacts, part: np.ndarray, together: bool, reach: float) -> Int[np.ndarray, " P"]:
    """Assign unseen patches that depend on a part or touch it more than all others.

    together: treat unseen patches that touch each other as one.
    """
    unseen = part < 0
    if not unseen.any() or not (part == 0).any():
        return part
    count = len(part)
    inner = contacts.touch[unseen[contacts.touch].all(1)] if together else np.zeros((0, 2), np.int64)
    key = np.where(unseen, count + label_connected(count, inner), part)
    _, unit = np.unique(key, return_inverse=True)
    unit = unit.reshape(-1)
    dominated = dominated_by(contacts, unit, int(unit[np.flatnonzero(part == 0)[0]]))
    assigned_part = part.copy()
    for k in np.unique(part[part > 0]):
        own = np.flatnonzero(part == k)
        for u in dominated[int(unit[own[0]])]:
            free = np.flatnonzero((unit == u) & (assigned_part < 0))
            if any(_near(contacts, int(p), own, reach) for p in free):
                assigned_part[free] = k
    return _largest_contact(contacts, unit, assigned_part)


def _largest_contact(contacts: Contacts, group: np.ndarray, part: np.ndarray) -> Int[np.ndarray, " P"]:
    """Assign unseen groups to the part that they touch more than all others, such as a drawer's box on a runner.

    Four rounds resolve chains. An unseen group may be larger than the part: a box behind its panel.
    """
    assigned_part = part.copy()
    for _ in range(4):
        # the first column counts contact with other unseen groups
        area = np.zeros((int(group.max()) + 1, int(assigned_part.max()) + 2))
        for (i, j), a in contacts.area.items():
            if assigned_part[i] < 0 and group[i] != group[j]:
                area[group[i], assigned_part[j] + 1] += a
        best = area.argmax(1)
        joins = (best > 1) & (area.max(1) > area.sum(1) - area.max(1))
        new = (assigned_part < 0) & joins[group]
        if not new.any():
            break
        assigned_part[new] = best[group[new]] - 1
    return assigned_part


def _near(contacts: Contacts, patch: int, others: np.ndarray, reach: float) -> bool:
    """Return whether the patch's box is within `reach` [m] of the box of one of the others."""
    low, high = contacts.shapes[patch].bounds
    boxes = np.array([contacts.shapes[p].bounds for p in others])
    return bool(boxes_meet(boxes[:, 0], boxes[:, 1], low - reach, high + reach).any())


def face_parts(
    mesh: Mesh,
    whole: ObjectShape,
    cloud: Cloud,
    point_part: Int[np.ndarray, " n"],
    stays_free: StaysFree | None = None,
) -> Int[np.ndarray, " F"]:
    """Return a part index per face, 0 for the base.

    point_part: part of every point of the cloud, 0 for the base, -1 if unknown.

    A patch joins one part as a whole. A patch with several parts is cut along the borders of its superpoints. An unseen patch
    joins the part that supports it if that part can still move as far (see `join_unseen`).
    """
    most = int(point_part.max(initial=0)) + 1
    patch = whole.mesh_patch[cloud.faces]
    patches = int(whole.mesh_patch.max()) + 1
    known = point_part >= 0
    votes = np.bincount(patch[known] * most + point_part[known], minlength=patches * most).reshape(patches, most)
    total = votes.sum(1)
    seen = total > MIN_SEEN_SHARE * np.bincount(patch, minlength=patches)
    winner = np.where(seen, votes.argmax(1), UNSEEN)
    share = votes.max(1) / np.maximum(total, 1)
    mixed = seen & (share <= np.where(_cuttable(mesh, whole), MIN_CUTTABLE_PATCH_SHARE, MIN_COMPONENT_SHARE))
    winner = join_unseen(whole, winner, stays_free)
    face_part = winner[whole.mesh_patch]
    for p in np.flatnonzero(mixed):
        mine = np.flatnonzero(patch == p)
        faces, label = _cut(cloud, mine, point_part[mine], most)
        face_part[faces] = label
    return np.maximum(face_part, 0)


def _cuttable(mesh: Mesh, whole: ObjectShape) -> Bool[np.ndarray, " P"]:
    """Return the patches that may hold several parts: those of a fused surface, and large ones."""
    large = patch_sizes(mesh, whole) > FUSED_SIZE_RATIO * whole.diagonal
    large[whole.shared.reshape(-1)] = True
    return large


def _cut(cloud: Cloud, mine: np.ndarray, part: np.ndarray, max_parts: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the faces of one patch and the part of each.

    The superpoints vote first, so that a border between parts follows one between superpoints.

    mine: points of the patch; part: part of each point, -1 if unknown.
    """
    names, own = np.unique(cloud.superpoint[mine], return_inverse=True)
    own = own.reshape(-1)
    known = part >= 0
    votes = np.bincount(own[known] * max_parts + part[known], minlength=len(names) * max_parts).reshape(-1, max_parts)
    best = np.where(votes.sum(1) > 0, votes.argmax(1), UNSEEN)
    label = best[own]
    lost = label < 0
    if lost.any():  # take the part of the nearest known point of the same patch
        nearest = KDTree(cloud.points[mine[~lost]]).query(cloud.points[mine[lost]], workers=-1)[1]
        label[lost] = label[~lost][nearest]
    faces, where = np.unique(cloud.faces[mine], return_inverse=True)
    inside = np.bincount(where.reshape(-1) * max_parts + label, minlength=len(faces) * max_parts).reshape(-1, max_parts)
    return faces, inside.argmax(1)


def mark_parts(
    mesh: Mesh,
    whole: ObjectShape,
    face_mark: Int[np.ndarray, " F"],
    parts: Sequence[Collection[int]],
    little: Bool[np.ndarray, " P"],
    stays_free: StaysFree | None = None,
) -> Int[np.ndarray, " F"]:
    """Return a part index per face from exact marks, 0 for the base.

    parts: marks of each part; little: patches that views show too little of to assign them to the base.

    A face without a mark takes the part of the nearest marked face of its patch. A patch without marks joins the part that
    supports it if that part can still move as far.
    """
    part_of = np.zeros(int(face_mark.max(initial=0)) + 2, np.int64)
    for k, marks in enumerate(parts, start=1):
        part_of[[m for m in marks if m > 0]] = k
    part_of[-1] = UNSEEN
    face_part = part_of[face_mark]
    patch = whole.mesh_patch
    face_part[(face_part == 0) & little[patch]] = UNSEEN
    count = int(patch.max()) + 1
    weight = np.maximum(mesh.face_areas, 1e-300)
    known = face_part >= 0
    most = len(parts) + 1
    votes = np.bincount(patch[known] * most + face_part[known], weight[known], count * most).reshape(count, most)
    winner = np.where(votes.any(1), votes.argmax(1), UNSEEN)
    joined = join_unseen(whole, winner, stays_free)
    mixed = (votes > 0).sum(1) > 1
    lost = np.flatnonzero(~known)
    face_part[lost] = joined[patch[lost]]
    centers = mesh.triangles.mean(1)
    for p in np.unique(patch[lost][mixed[patch[lost]]]):
        own, sure = lost[patch[lost] == p], np.flatnonzero(known & (patch == p))
        face_part[own] = face_part[sure[KDTree(centers[sure]).query(centers[own])[1]]]
    return np.maximum(face_part, 0)


def point_parts(cloud: Cloud, instances: Instances, shown: Bool[np.ndarray, " n"]) -> Int[np.ndarray, " n"]:
    """Return the part index of each point, from its superpoint: 0 for the base, -1 if no view shows the point."""
    return np.where(shown, instances.number[cloud.superpoint], UNSEEN)


def _context_by_gaps(whole: ObjectShape, label: Int[np.ndarray, " F"], part: int) -> PartContext:
    """Build the context of a part where parents are not known yet. label: part index of each face; not all need to occur."""
    numbers, rank = np.unique(label, return_inverse=True)
    shapes = [whole.of(np.flatnonzero(label == k)) for k in numbers]
    number = int(np.searchsorted(numbers, part))
    return part_context(whole, rank, shapes, parents(shapes, whole.diagonal), number)


def stays_free(
    whole: ObjectShape,
    without: Int[np.ndarray, " F"],
    joined: Int[np.ndarray, " F"],
    part: int,
    moves: JointType | None = None,
) -> bool:
    """Return whether a part opens as far with the unseen patches that it would gain.

    without, joined: part index of each face of `whole`, without and with these patches; moves: the recognized motion of the
    part, if known.
    """
    alone, gained = _context_by_gaps(whole, without, part), _context_by_gaps(whole, joined, part)
    motions = all_motions(alone, "part")
    best: dict[int, Candidate] = {}  # the better one of the two directions along each axis
    for k in rank_motions(motions).ranking:
        best.setdefault(id(motions.candidates[k].motion), motions.candidates[k])
    kinds = (JointType.REVOLUTE, JointType.PRISMATIC)
    if moves is not None:
        kinds = (JointType.PRISMATIC if moves is JointType.PRISMATIC else JointType.REVOLUTE,)
    likely = [c for kind in kinds for c in [c for c in best.values() if c.motion.kind is kind][:MOTIONS_PER_TYPE]]
    after = sweep_candidates(gained, [(c.role, c.motion) for c in likely])[::2]
    far = [(max(c.opening, c.closing), max(a.opening, a.closing)) for c, a in zip(likely, after, strict=True)]
    return any(now >= MIN_FREE_RATIO * min(before, SUFFICIENT_OPENING) for before, now in far)


def patch_sizes(mesh: Mesh, whole: ObjectShape) -> Float[np.ndarray, " P"]:
    """Return the diagonal of the axis-aligned box of each patch, with all faces of the mesh [m]."""
    low, high = label_bounds(whole.mesh_patch, *corner_bounds(mesh.triangles))
    return lengths(high - low)
