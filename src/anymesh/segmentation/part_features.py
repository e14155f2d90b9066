"""Named features of part candidates. Lengths are relative to the object's diagonal, shares are 0..1."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from anymesh.config import FACING_COSINE, Config
from anymesh.motion.part_context import MAX_LENGTH_RATIO, PartContext, shape_features
from anymesh.segmentation.part_candidates import PartCandidates
from anymesh.segmentation.part_fit import enclosed_share, fit_of_rim, on_axis, touching, two_pivots
from anymesh.segmentation.part_freedom import blocked_shares, exposure, space_behind
from anymesh.types import Mesh

AT_BORDER = 0.02  # of the diagonal: what is this close to a side of the object's bounds reaches it
MIN_OFFSET = 0.1  # of the half extent: below this offset from the middle of the face, the side of a contact is chance


@dataclass(frozen=True, eq=False)
class FeatureInputs:
    """What the features of all candidates of an object are computed from.

    material: (P, M) area of each material, or of none, on each patch [m^2].
    """

    candidates: PartCandidates
    config: Config
    material: Float[np.ndarray, "P M"]

    @classmethod
    def of(cls, mesh: Mesh, candidates: PartCandidates, config: Config) -> FeatureInputs:
        """Build the data of a mesh and its candidates."""
        patch, material = candidates.whole.mesh_patch, mesh.face_material + 1
        shape = int(patch.max()) + 1, int(material.max()) + 1
        area = np.bincount(patch * shape[1] + material, mesh.face_areas, shape[0] * shape[1])
        return cls(candidates, config, area.reshape(shape))


def candidate_context(inputs: FeatureInputs, candidate: int) -> PartContext | None:
    """Return a candidate as a part among the rest of the object; None if it has no face or nothing is left."""
    whole = inputs.candidates.whole
    moving = inputs.candidates.members[candidate][whole.patch]
    if not moving.any() or moving.all():
        return None
    rest = whole.of(np.flatnonzero(~moving))
    return PartContext(
        part=whole.of(np.flatnonzero(moving)), parent=rest, rest=rest, other_surface=None, without_part=rest,
        barrel_candidates=(), diagonal=whole.diagonal, center=whole.shape.bounds.mean(0), config=inputs.config.articulation,
    )  # fmt: skip


def part_features(inputs: FeatureInputs, candidate: int, context: PartContext) -> dict[str, float]:
    """Return all features of a candidate; the keys are the same for all."""
    return {
        **shape_features(context),
        **_extent(inputs, candidate, context),
        **_place(context),
        **_fit(inputs, context),
        **_neighbours(inputs, candidate),
        **_copies(inputs, candidate, context),
        **_material(inputs, candidate, context),
        **blocked_shares(context, inputs.config.segmentation),
        **exposure(context, inputs.config.segmentation),
        **space_behind(context),
    }


def _extent(inputs: FeatureInputs, candidate: int, context: PartContext) -> dict[str, float]:
    core, candidates = context.body_obb, inputs.candidates
    extents = np.sort(np.ptp(candidates.whole.shape.bounds, axis=0))
    patches = candidates.members[candidate]
    return {
        "area share": float(candidates.area[candidate] / candidates.contacts.patch_area.sum()),
        "face share": float(min(4 * core.half[0] * core.half[1] / max(extents[1] * extents[2], 1e-12), MAX_LENGTH_RATIO)),
        "largest patch": float(candidates.contacts.patch_area[patches].max() / max(candidates.area[candidate], 1e-300)),
        "log patches of the object": float(np.log1p(len(patches))),
    }


def _place(context: PartContext) -> dict[str, float]:
    low, high = context.bounds
    extent = np.maximum(high - low, 1e-12)
    mine = context.part.bounds
    reached = np.abs(np.array([mine[0] - low, high - mine[1]])) < AT_BORDER * context.diagonal
    return {
        "bottom": float((mine[0, 2] - low[2]) / extent[2]),
        "top": float((high[2] - mine[1, 2]) / extent[2]),
        "sides reached": float(reached[:, :2].sum()),
        "width share": float(((mine[1] - mine[0]) / extent)[:2].max()),
        "height share": float((mine[1, 2] - mine[0, 2]) / extent[2]),
        "thin side towards opening": float(np.abs(context.body_obb.axes[2] @ context.opening_direction)),
        "offset from the center": float((mine.mean(0) - context.center) @ context.opening_direction / context.diagonal),
    }


def _fit(inputs: FeatureInputs, context: PartContext) -> dict[str, float]:
    settings = inputs.config.segmentation
    near, normals = touching(context, 2 * settings.touch * context.diagonal)
    sides, flush = fit_of_rim(context, settings)
    gaps = np.quantile(context.gap, [0.05, 0.5]) / context.diagonal
    outer = context.part.samples.normals @ context.opening_direction
    back = outer < -FACING_COSINE
    return {
        "rims with clearance": float(sides),
        "flush rim": flush,
        "touching": float(near.mean()),
        "back touches": float(near[back].mean()) if back.sum() > 3 else 0.0,
        "log10 near gap": float(np.log10(gaps[0] + 1e-5)),
        "log10 middle gap": float(np.log10(gaps[1] + 1e-5)),
        "enclosed": enclosed_share(context),
        "two pivots": two_pivots(context, near, normals),
        "on axis": float(on_axis(context)),
        "axle level": float(abs(context.outline.axis[2]) < FACING_COSINE),
        **_contact_layout(context, near),
    }


def _contact_layout(context: PartContext, near: np.ndarray) -> dict[str, float]:
    """Return features of the contact's position on the part's face: spread over it, or gathered at one side."""
    if near.sum() < 2:
        return {"contact spread": 0.0, "contact off the middle": 0.0, "contact upright": 0.0}
    local = context.body_obb.local(context.part.samples.points[near]) / np.maximum(context.body_obb.half, 1e-12)
    face = local[:, context.face_axes]
    middle, spread = face.mean(0), face.std(0)
    upright = np.abs(context.body_obb.axes[context.face_axes][::-1, 2])  # along each axis, of the other one
    return {
        "contact spread": float(spread.min()),
        "contact off the middle": float(np.abs(middle).max()),
        "contact upright": float(middle**2 @ upright / max(middle @ middle, MIN_OFFSET**2)),
    }


def _neighbours(inputs: FeatureInputs, candidate: int) -> dict[str, float]:
    candidates = inputs.candidates
    inside, contacts = candidates.members[candidate], candidates.contacts
    pairs = np.array(list(contacts.area), np.int64).reshape(-1, 2)
    amount = np.array(list(contacts.area.values()), float)
    out = inside[pairs[:, 0]] & ~inside[pairs[:, 1]]
    within = inside[pairs[:, 0]] & inside[pairs[:, 1]]
    beside = np.bincount(pairs[out, 1], amount[out], len(inside))
    shared = candidates.whole.shared
    creased = inside[shared[:, 0]] != inside[shared[:, 1]] if len(shared) else np.zeros(0, bool)
    outside, total = float(beside.sum()), max(float(candidates.area[candidate]), 1e-300)
    return {
        "contact with the first": float(beside.max(initial=0) / max(outside, 1e-300)) if outside > 0 else 0.0,
        "contact area": min(outside / total, 1.0),
        "contact within": min(float(amount[within].sum()) / total, 2.0),
        "parted by creases": float(creased.any()),
        "separate": float(not out.any() and not creased.any()),
    }


def _copies(inputs: FeatureInputs, candidate: int, context: PartContext) -> dict[str, float]:
    """Return features of the copies of a candidate: how many there are, and whether one lies on its axis."""
    candidates = inputs.candidates
    copies = candidates.overlap.copies[candidate]
    middles = candidates.bounds[copies].mean(1)
    outline = context.outline
    arm = middles - outline.center
    across = np.linalg.norm(arm - (arm @ outline.axis)[:, None] * outline.axis, axis=1)
    return {
        "log copies": float(np.log1p(copies.sum())),
        "copy on the axis": float((across < 0.3 * outline.radius).any()),
    }


def _material(inputs: FeatureInputs, candidate: int, context: PartContext) -> dict[str, float]:
    """Return how well the part's most frequent material separates it from the rest."""
    total = inputs.material.sum(0)
    mine = inputs.candidates.members[candidate] @ inputs.material
    k = int(mine.argmax())
    return {
        "materials": float(np.log1p((total > 0).sum())),
        "material of its own": float(mine[k] / max(total[k], 1e-300)),
    }
