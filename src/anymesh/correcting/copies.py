"""Copies of a part, and corrections that give them what the part has.

A copy has the shape of the part in another place, turned, or as its mirror image; a part may also have an equal box only, and a
region of the parent is made a part.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import permutations, product

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import KDTree

from anymesh.correcting.corrections import ChooseMotion, Correction, CorrectionError, FaceSet, Relabel, SplitPart, vector
from anymesh.correcting.edits import apply, components_of
from anymesh.correcting.tree import joint_of_part, part_number
from anymesh.geometry.boxes import OrientedBox
from anymesh.geometry.copies import beside, same_box, same_spread
from anymesh.geometry.distance_ import TriangleTree
from anymesh.geometry.topology import edge_pairs, label_connected, triangle_set_of
from anymesh.geometry.triangle_set import body_obb, principal_spread, sample_surface, surface_moments
from anymesh.types import Asset, Brief, Joint, JointType

# Estimates
MAX_SIZE_DIFFERENCE = 0.03  # relative, of the areas of components and facets, and of covariances under a pose
MAX_MISFIT = 0.01  # mean distance of the surfaces of copies, over the diagonal
PLACE_REACH = 0.25  # of the diagonal: how far around a part its place is compared
DETAIL = 0.1  # share of the surface that tells poses apart, such as a handle
MISFIT_STEP = 0.004  # of the diagonal: poses that differ by less fit alike
MAX_BOX_RATIO = 0.5  # axis-aligned boxes of copies differ by less; a protrusion such as a handle is not of the box
NEIGHBOURS = 0.1  # of the diagonal: maximum gap between leaves whose free edges meet
SAMPLES = 300
MIN_FLAT_COSINE = float(np.cos(np.deg2rad(5)))  # between faces of one facet, and facets of copies, as in correcting/picking.py
MAX_REGIONS = 400  # regions of one size that are compared
SIGNED = [np.eye(3)[list(p)] * np.array(s)[:, None] for p in permutations(range(3)) for s in product((1.0, -1.0), repeat=3)]


@dataclass(frozen=True, eq=False)
class Copy(Brief):
    """A copy of a part. part: its name, or of the parent that the region belongs to; faces: of a region, None for a whole part.

    pose: (4, 4), maps the part onto its copy; a mirror image where its determinant is negative.
    """

    part: str
    pose: Float[np.ndarray, "4 4"]
    faces: Int[np.ndarray, " n"] | None = None


class _Surface:
    """A surface with the measures by which copies are recognized."""

    def __init__(self, triangles: Float[np.ndarray, "F 3 3"]) -> None:
        self.triangles = triangles
        moments = surface_moments(triangles)
        self.area = float(moments[3, 3])
        self.center = moments[:3, 3] / max(self.area, 1e-300)
        self.spread = principal_spread(moments[None])[0]
        self.covariance = moments[:3, :3] / max(self.area, 1e-300) - np.outer(self.center, self.center)
        corners = triangles.reshape(-1, 3)
        self.low, self.high = corners.min(0), corners.max(0)
        self.diagonal = float(np.linalg.norm(self.high - self.low))

    @cached_property
    def points(self) -> Float[np.ndarray, "n 3"]:
        return sample_surface(self.triangles, SAMPLES, 0).points

    @cached_property
    def tree(self) -> TriangleTree:
        return TriangleTree(self.triangles)

    @cached_property
    def axes(self) -> Float[np.ndarray, "3 3"]:
        """The principal directions as rows."""
        return np.linalg.eigh(self.covariance)[1].T

    @cached_property
    def box(self) -> OrientedBox:
        """The box without protrusions."""
        return body_obb(triangle_set_of(self.triangles))

    def like(self, other: _Surface) -> bool:
        """Return whether the sizes agree, in any rotation."""
        return bool(same_spread(np.array([self.area, other.area]), np.array([self.spread, other.spread]))[0, 1])

    def misfit(self, other: _Surface, T: Float[np.ndarray, "4 4"], share: float = 1.0) -> float:
        """Return the mean distance of the surfaces under a pose, over the diagonal. share: of the points, the farthest ones."""
        there, back = _moved(T, self.points), _moved(np.linalg.inv(T), other.points)
        off = (np.sort(d)[-max(1, int(share * len(d))) :] for d in (other.tree.distance(there), self.tree.distance(back)))
        return max(float(d.mean()) for d in off) / max(self.diagonal, 1e-300)

    def poses(self, other: _Surface) -> list[Float[np.ndarray, "4 4"]]:
        """Return the poses that map this surface onto the other: shifts first, then mirror images, then the others."""
        turns = [other.axes.T @ S @ self.axes for S in SIGNED]
        plain = sorted(SIGNED, key=lambda S: (-np.trace(np.abs(S)), -np.trace(S)))
        poses: list[np.ndarray] = []
        for L in (*plain, *turns):
            off = np.abs(L @ self.covariance @ L.T - other.covariance).max()
            if off > 2 * MAX_SIZE_DIFFERENCE * self.spread.max() ** 2 or any(np.abs(T[:3, :3] - L).max() < 1e-3 for T in poses):
                continue
            T = np.eye(4)
            T[:3, :3], T[:3, 3] = L, other.center - L @ self.center
            if self.misfit(other, T) < MAX_MISFIT:
                poses.append(T)
        return poses

    def box_poses(self, other: _Surface) -> list[Float[np.ndarray, "4 4"]]:
        """Return the shift and the mirror images that map a box onto an equal one, as in stage B; none if they differ."""
        least = np.maximum(self.high - self.low, other.high - other.low) * MAX_BOX_RATIO
        if (np.minimum(self.high - self.low, other.high - other.low) < least).any() or not same_box(self.box, other.box):
            return []
        poses = [np.diag([*s, 1.0]) for s in ((1, 1, 1), (-1, 1, 1), (1, -1, 1), (1, 1, -1))]
        for T in poses:
            T[:3, 3] = other.box.center - T[:3, :3] @ self.box.center
        return poses


def _moved(T: np.ndarray, points: np.ndarray) -> np.ndarray:
    return points @ T[:3, :3].T + T[:3, 3]


def copies_of(asset: Asset, part: str, *, regions: bool = True) -> tuple[Copy, ...]:
    """Return the copies of a part: the other parts first, then regions of its parent. Raise CorrectionError for the root.

    regions: also find connected components of the parent that would be copies, beside the part with respect to its motion; if
    there are none, flat facets of it that lie to each other as those of the part do.
    Of several poses the one is taken whose context fit best: a door may be the mirror image of the other.
    """
    joint, segmentation = joint_of_part(asset, part), asset.segmentation
    triangles = asset.mesh.triangles
    own = _Surface(triangles[segmentation.faces(part_number(asset, part))])
    place = _Place(own, joint, triangles[segmentation.face_part != part_number(asset, part)], triangles)
    copies = []
    for number, other in enumerate(segmentation.parts[1:], 1):
        surface = _Surface(triangles[segmentation.faces(number)])
        poses = own.poses(surface) if other.name != part and own.like(surface) else []
        if not poses and other.name != part:
            poses = own.box_poses(surface)
        if poses:
            copies.append(Copy(other.name, place.best(surface, poses)))
    if regions:
        for faces in [*_regions_like(asset, part, joint.parent)] or _facets_like(asset, part, joint.parent):
            surface = _Surface(triangles[faces])
            poses = own.poses(surface) if _beside(joint, own, surface) else []
            if poses:
                copies.append(Copy(joint.parent, place.best(surface, poses), faces))
    return tuple(copies)


class _Place:
    """A part's place in the object, to choose between several poses of a copy."""

    def __init__(self, own: _Surface, joint: Joint, rest: np.ndarray, whole: np.ndarray) -> None:
        self._own, self._joint, self._tree = own, joint, TriangleTree(whole)
        reach = PLACE_REACH * own.diagonal
        points = sample_surface(rest, 20 * SAMPLES, 0, at_least=1).points
        around = ((points > own.low - reach) & (points < own.high + reach)).all(1)
        self._around = points[around][:: max(1, int(around.sum()) // SAMPLES)]

    def best(self, other: _Surface, poses: Sequence[np.ndarray]) -> Float[np.ndarray, "4 4"]:
        """Return the pose that fits best with its context; of equal ones the first, but leaves that meet are mirrored."""
        steps = np.round([(self._own.misfit(other, T, DETAIL) + self._misfit(T)) / MISFIT_STEP for T in poses])
        best = [T for T, step in zip(poses, steps, strict=True) if step == steps.min()]
        return next((T for T in best if self._leaves(other, T)), best[0])

    def _misfit(self, T: np.ndarray) -> float:
        if not len(self._around):
            return 0.0
        reach = PLACE_REACH * self._own.diagonal
        return float(np.minimum(self._tree.distance(_moved(T, self._around)), reach).mean()) / max(self._own.diagonal, 1e-300)

    def _leaves(self, other: _Surface, T: np.ndarray) -> bool:
        """Return whether this mirror image makes the two a pair of hinged leaves whose free edges meet."""
        offset, a = other.center - self._own.center, self._joint.axis
        gap = np.maximum(np.maximum(other.low - self._own.high, self._own.low - other.high), 0)
        across = offset / max(float(np.linalg.norm(offset)), 1e-300)
        if self._joint.type is not JointType.REVOLUTE or np.linalg.norm(gap) > NEIGHBOURS * self._own.diagonal:
            return False
        if not np.allclose(T[:3, :3], np.eye(3) - 2 * np.outer(across, across), atol=0.1):
            return False
        hinges = _moved(T, self._joint.origin[None])[0] - self._joint.origin
        return float(np.linalg.norm(np.cross(hinges, a))) > float(np.linalg.norm(np.cross(offset, a)))


def _beside(joint: Joint, own: _Surface, other: _Surface) -> bool:
    """Return whether a region lies beside a part and not before or behind it, where the part opens to."""
    way = joint.axis if joint.type is JointType.PRISMATIC else np.cross(joint.axis, own.center - joint.origin)
    length = float(np.linalg.norm(way))
    if joint.type in (JointType.CONTINUOUS, JointType.FIXED) or length < 1e-9:
        return True
    return beside(other.center - own.center, way / length)


def _regions_like(asset: Asset, part: str, parent: str) -> Iterator[Int[np.ndarray, " n"]]:
    """Yield the faces of each group of components of the parent that has the size and shape of a part."""
    mine, theirs = components_of(asset, part), components_of(asset, parent)
    anchor, area = _Surface(asset.mesh.triangles[mine[0]]), asset.mesh.face_areas
    whole = _Surface(asset.mesh.triangles[np.concatenate(mine)])
    taken = np.zeros(0, np.int64)
    near = [f for f in theirs if abs(float(area[f].sum()) - anchor.area) <= MAX_SIZE_DIFFERENCE * anchor.area]
    for faces in near[:MAX_REGIONS]:
        region = _Surface(asset.mesh.triangles[faces])
        if len(theirs) == 1 or np.isin(faces, taken).any() or not anchor.like(region):
            continue
        groups = [(T, np.unique(np.concatenate([faces, *_carried(asset, whole, theirs, T)]))) for T in anchor.poses(region)]
        fit = [g for T, g in groups if whole.misfit(_Surface(asset.mesh.triangles[g]), T) < MAX_MISFIT]
        if fit:
            group = max(fit, key=lambda g: float(area[g].sum()))
            taken = np.concatenate([taken, group])
            yield group


def _carried(asset: Asset, whole: _Surface, theirs: Sequence[np.ndarray], T: np.ndarray) -> Iterator[np.ndarray]:
    """Yield the components that lie where a pose maps the surface of a part, such as its handle."""
    back, reach = np.linalg.inv(T), MAX_MISFIT * whole.diagonal
    for faces in theirs:
        points = _moved(back, asset.mesh.triangles[faces].reshape(-1, 3))
        if (points > whole.low - reach).all() and (points < whole.high + reach).all():
            points = _moved(back, sample_surface(asset.mesh.triangles[faces], SAMPLES, 0).points)
            if whole.tree.distance(points).mean() < reach:
                yield faces


@dataclass(frozen=True, eq=False)
class _Facets(Brief):
    """The flat facets of some faces: label of each face; area, center and normal of each facet."""

    faces: Int[np.ndarray, " f"]
    label: Int[np.ndarray, " f"]
    area: Float[np.ndarray, " n"]
    center: Float[np.ndarray, "n 3"]
    normal: Float[np.ndarray, "n 3"]

    @classmethod
    def of(cls, asset: Asset, faces: Int[np.ndarray, " f"]) -> _Facets:
        mesh = asset.mesh
        normals, areas, centers = mesh.face_normals[faces], mesh.face_areas[faces], mesh.triangles[faces].mean(1)
        pairs = edge_pairs(mesh.vertices, mesh.faces[faces]).faces
        flat = np.einsum("ij,ij->i", normals[pairs[:, 0]], normals[pairs[:, 1]]) > MIN_FLAT_COSINE
        label = label_connected(len(faces), pairs[flat])
        area = np.maximum(np.bincount(label, areas), 1e-300)
        center = np.stack([np.bincount(label, areas * c) for c in centers.T], 1) / area[:, None]
        normal = np.stack([np.bincount(label, areas * n) for n in normals.T], 1) / area[:, None]
        return cls(faces, label, area, center, normal)


def _facets_like(asset: Asset, part: str, parent: str) -> Iterator[Int[np.ndarray, " n"]]:
    """Yield the faces of the parent whose facets are those of a part, shifted or mirrored, as fronts of one surface."""
    mine, theirs = (_Facets.of(asset, asset.segmentation.faces(part_number(asset, name))) for name in (part, parent))
    reach = MAX_MISFIT * _Surface(asset.mesh.triangles[mine.faces]).diagonal
    anchor, tree, taken = int(mine.area.argmax()), KDTree(theirs.center), np.zeros(len(theirs.area), bool)
    off = mine.center - mine.center[anchor]
    like = np.abs(theirs.area - mine.area[anchor]) <= MAX_SIZE_DIFFERENCE * mine.area[anchor]
    for k in np.flatnonzero(like)[:MAX_REGIONS]:
        for S in (np.ones(3), *(np.ones(3) - 2 * np.eye(3))):
            far, at = tree.query(theirs.center[k] + S * off)
            sizes = np.abs(theirs.area[at] - mine.area) <= MAX_SIZE_DIFFERENCE * mine.area
            turned = np.einsum("ij,ij->i", theirs.normal[at], S * mine.normal) < MIN_FLAT_COSINE
            if sizes.all() and not turned.any() and (far < reach).all() and len(set(at)) == len(at) and not taken[at].any():
                taken[at] = True
                yield theirs.faces[np.isin(theirs.label, at)]


def same_for_copies(asset: Asset, part: str, *, regions: bool = True) -> tuple[Correction, ...]:
    """Return the corrections that give all copies of a part its label and its joint, placed and mirrored as they are.

    regions: also make parts of copies that are regions of the parent. Raise CorrectionError for the root, or without a copy.
    """
    joint, label = joint_of_part(asset, part), asset.segmentation.parts[part_number(asset, part)].label
    copies = copies_of(asset, part, regions=regions)
    if not copies:
        raise CorrectionError(
            f"{part!r} has no copy: no other part{' or region of its parent' if regions else ''} has its shape"
        )
    done: list[Correction] = []
    for copy in copies:
        name = copy.part
        if copy.faces is not None:
            split = SplitPart(copy.part, FaceSet.of(copy.faces), label, label)
            asset = apply(asset, split)
            done.append(split)
            name = asset.segmentation.parts[-1].name
        elif asset.segmentation.parts[part_number(asset, name)].label != label:
            done.append(Relabel(name, label))
        done.append(mapped_motion(joint, name, copy.pose))
    return tuple(done)


def mapped_motion(joint: Joint, part: str, pose: Float[np.ndarray, "4 4"]) -> ChooseMotion:
    """Return the motion of a copy of a joint's child under the copy's pose, with the same limits.

    A mirrored hinge turns the other way round; copies that turn endlessly, as wheels, turn the same way.
    """
    axis = pose[:3, :3] @ joint.axis
    back = axis @ joint.axis < 0 if joint.type is JointType.CONTINUOUS else np.linalg.det(pose[:3, :3]) < 0
    axis = -axis if back and joint.type is not JointType.PRISMATIC else axis
    reason = f"as its copy {joint.child}"
    return ChooseMotion(
        part,
        joint.type,
        vector(axis + 0.0),
        vector(_moved(pose, joint.origin[None])[0]),
        joint.limits,
        1.0,
        reason,
        joint.pitch,
    )
