"""Named features of part candidates. Lengths are relative to the object's diagonal, shares are 0..1."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Int

from anymesh.config import SAME_SIZE, Config
from anymesh.motion.part_context import PartContext
from anymesh.segmentation.part_fit import enclosed_share, fit_of_rim, on_axis, touching, two_pivots
from anymesh.segmentation.part_freedom import blocked_shares, exposure, space_behind
from anymesh.segmentation.part_tree import PartTree
from anymesh.types import Mesh

AT_BORDER = 0.02  # of the diagonal: a candidate reaches a side of the object's bounds within this distance
MIN_OFFSET = 0.1  # of the half extent: to which side of the middle of the face a contact nearer to it lies is chance
MAX_RATIO = 8.0  # upper limit of ratios of lengths


@dataclass(frozen=True, eq=False)
class FeatureScene:
    """Data shared by the features of all candidates of an object.

    material: (R,) material of each face of `tree.whole`.
    """

    tree: PartTree
    config: Config
    material: Int[np.ndarray, " R"]

    @classmethod
    def of(cls, mesh: Mesh, tree: PartTree, config: Config) -> FeatureScene:
        """Build the data of a mesh and its candidates."""
        return cls(tree, config, mesh.face_material[tree.whole.source])


def part_context_of(scene: FeatureScene, group: int) -> PartContext | None:
    """Return a group as a part among the rest of the object; None if it has no face or nothing is left."""
    tree = scene.tree
    moving = tree.members[group][tree.whole.patch]
    if not moving.any() or moving.all():
        return None
    rest = tree.whole.of(np.flatnonzero(~moving))
    return PartContext(
        part=tree.whole.of(np.flatnonzero(moving)), parent=rest, rest=rest, others=None, everything=rest, barrel_candidates=(),
        diagonal=tree.whole.diagonal, center=tree.whole.shape.bounds.mean(0), config=scene.config.articulation,
    )  # fmt: skip


def part_features(scene: FeatureScene, group: int, around: PartContext) -> dict[str, float]:
    """Return all features of a candidate; the keys are the same for all."""
    return {
        **_shape(scene, group, around),
        **_place(around),
        **_fit(scene, around),
        **_neighbours(scene, group),
        **_copies(scene, group, around),
        **_material(scene, group, around),
        **_handle(around),
        **blocked_shares(around, scene.config.segmentation),
        **exposure(around, scene.config.segmentation),
        **space_behind(around),
    }


def _ratio(a: float, b: float) -> float:
    return float(np.clip(a / max(b, 1e-12), 0, MAX_RATIO))


def _shape(scene: FeatureScene, group: int, around: PartContext) -> dict[str, float]:
    core, outline, tree = around.body_obb, around.outline, scene.tree
    extents = np.sort(np.ptp(tree.whole.shape.bounds, axis=0))
    box_area = 8 * float(core.half[0] * core.half[1] + core.half[1] * core.half[2] + core.half[0] * core.half[2])
    patches = tree.members[group]
    return {
        "thinness": _ratio(core.half[2], core.half[1]),
        "width over length": _ratio(core.half[1], core.half[0]),
        "size": around.part.box.diagonal / around.diagonal,
        "thickness": float(2 * core.half[2] / around.diagonal),
        "area share": float(tree.area[group] / tree.contacts.patch_area.sum()),
        "face share": _ratio(4 * core.half[0] * core.half[1], extents[1] * extents[2]),
        "area over box": _ratio(around.part.area, box_area),
        "closed": float(around.part.solid @ around.part.areas / max(around.part.area, 1e-300)),
        "roundness": outline.roundness,
        "height over radius": _ratio(outline.height, outline.radius),
        "largest patch": float(tree.contacts.patch_area[patches].max() / max(tree.area[group], 1e-300)),
        "log patches of the object": float(np.log1p(len(patches))),
    }


def _place(around: PartContext) -> dict[str, float]:
    low, high = around.bounds
    extent = np.maximum(high - low, 1e-12)
    mine = around.part.bounds
    center = (mine.mean(0) - low) / extent
    reached = np.abs(np.array([mine[0] - low, high - mine[1]])) < AT_BORDER * around.diagonal
    aside = np.linalg.norm(2 * center[:2] - 1)
    return {
        "height": float(center[2]),
        "bottom": float((mine[0, 2] - low[2]) / extent[2]),
        "top": float((high[2] - mine[1, 2]) / extent[2]),
        "horizontal offset": float(aside),
        "sides reached": float(reached[:, :2].sum()),
        "width share": float(((mine[1] - mine[0]) / extent)[:2].max()),
        "height share": float((mine[1, 2] - mine[0, 2]) / extent[2]),
        "faces up": float(around.opening_direction[2]),
        "visibility": around.visibility,
        "thin side towards opening": float(np.abs(around.body_obb.axes[2] @ around.opening_direction)),
        "offset from the center": float((mine.mean(0) - around.center) @ around.opening_direction / around.diagonal),
        "object height over width": _ratio(extent[2], float(extent[:2].max())),
    }


def _fit(scene: FeatureScene, around: PartContext) -> dict[str, float]:
    settings = scene.config.segmentation
    near, normals = touching(around, 2 * settings.touch * around.diagonal)
    sides, flush = fit_of_rim(around, settings)
    gaps = np.quantile(around.gap, [0.05, 0.5]) / around.diagonal
    depth = around.depth_in_parent(around.opening_direction)
    outer = around.part.samples.normals @ around.opening_direction
    back = outer < -0.5
    return {
        "rims with clearance": float(sides),
        "flush rim": flush,
        "touching": float(near.mean()),
        "back touches": float(near[back].mean()) if back.sum() > 3 else 0.0,
        "log10 near gap": float(np.log10(gaps[0] + 1e-5)),
        "log10 middle gap": float(np.log10(gaps[1] + 1e-5)),
        "enclosed": enclosed_share(around),
        "depth": _ratio(depth, 2 * float(around.body_obb.half[1])),
        "two pivots": two_pivots(around, near, normals),
        "on axis": float(on_axis(around)),
        "axle level": float(abs(around.outline.axis[2]) < 0.5),
        **_contact_layout(around, near),
    }


def _contact_layout(around: PartContext, near: np.ndarray) -> dict[str, float]:
    """Return features of the contact's position on the part's face: spread over it, or gathered at one side."""
    if near.sum() < 2:
        return {"contact spread": 0.0, "contact off the middle": 0.0, "contact upright": 0.0}
    local = around.body_obb.local(around.part.samples.points[near]) / np.maximum(around.body_obb.half, 1e-12)
    face = local[:, around.face_axes]
    middle, spread = face.mean(0), face.std(0)
    upright = np.abs(around.body_obb.axes[around.face_axes][::-1, 2])  # along each axis, of the other one
    return {
        "contact spread": float(spread.min()),
        "contact off the middle": float(np.abs(middle).max()),
        "contact upright": float(middle**2 @ upright / max(middle @ middle, MIN_OFFSET**2)),
    }


def _neighbours(scene: FeatureScene, group: int) -> dict[str, float]:
    tree = scene.tree
    inside, contacts = tree.members[group], tree.contacts
    pairs = np.array(list(contacts.area), np.int64).reshape(-1, 2)
    amount = np.array(list(contacts.area.values()), float)
    out = inside[pairs[:, 0]] & ~inside[pairs[:, 1]]
    within = inside[pairs[:, 0]] & inside[pairs[:, 1]]
    beside = np.bincount(pairs[out, 1], amount[out], len(inside))
    shared = tree.whole.shared
    creased = inside[shared[:, 0]] != inside[shared[:, 1]] if len(shared) else np.zeros(0, bool)
    outside, total = float(beside.sum()), max(float(tree.area[group]), 1e-300)
    return {
        "contact with the first": float(beside.max(initial=0) / max(outside, 1e-300)) if outside > 0 else 0.0,
        "contact area": min(outside / total, 1.0),
        "contact within": min(float(amount[within].sum()) / total, 2.0),
        "parted by creases": float(creased.any()),
        "separate": float(not out.any() and not creased.any()),
    }


def _copies(scene: FeatureScene, group: int, around: PartContext) -> dict[str, float]:
    """Return features of other groups of the same size that share no patch with this one."""
    tree = scene.tree
    alike = np.abs(tree.size - tree.size[group]) < SAME_SIZE * tree.size[group]
    alike &= np.abs(tree.area / max(tree.area[group], 1e-300) - 1) < 2 * SAME_SIZE
    alike &= tree.overlap.shared[group] == 0
    middles = tree.bounds[alike].mean(1)
    outline = around.outline
    arm = middles - outline.center
    across = np.linalg.norm(arm - (arm @ outline.axis)[:, None] * outline.axis, axis=1)
    return {
        "log copies": float(np.log1p(alike.sum())),
        "copy on the axis": float((across < 0.3 * outline.radius).any()),
    }


def _material(scene: FeatureScene, group: int, around: PartContext) -> dict[str, float]:
    """Return how well the part's most frequent material separates it from the rest."""
    whole, count = scene.tree.whole, int(scene.material.max()) + 2
    moving = scene.tree.members[group][whole.patch]
    mine = np.bincount(scene.material[moving] + 1, whole.shape.areas[moving], count)
    rest = np.bincount(scene.material[~moving] + 1, whole.shape.areas[~moving], count)
    k = int(mine.argmax())
    return {
        "materials": float(np.log1p(((mine + rest) > 0).sum())),
        "material of its own": float(mine[k] / max(mine[k] + rest[k], 1e-300)),
    }


def _handle(around: PartContext) -> dict[str, float]:
    handle = around.handle
    if handle is None:
        return {"handle": 0.0, "handle size": 0.0, "handle off the middle": 0.0, "bar handle": 0.0}
    return {
        "handle": 1.0,
        "handle size": handle.size,
        "handle off the middle": max(abs(a) for a in handle.across),
        "bar handle": float(handle.along is not None),
    }
