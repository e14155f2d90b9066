"""Named features of part candidates. Lengths are relative to the object's diagonal, shares are 0..1."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from anymesh.config import ALONG_COSINE, FACING_COSINE
from anymesh.geometry.triangle_set import median, quantile
from anymesh.motion.handle import outward_axis
from anymesh.motion.part_context import MAX_LENGTH_RATIO, PartContext, shape_features
from anymesh.segmentation.contacts import NEAR_RATIO, TOUCH_RATIO
from anymesh.segmentation.part_candidates import PartCandidates
from anymesh.types import Brief, Mesh

STRIDE = 8  # every how many samples of the part a ray is cast
MIN_WAY = 0.03  # of the diagonal: minimum length of a way; otherwise it is as long as the part itself
MIN_AHEAD_COSINE = 0.2  # minimum cosine between a normal and a direction for surface that is ahead in this direction
BACK_RAYS = 9  # rays along each side of the back
UP = np.array([0.0, 0.0, 1.0])
RIM = 0.75  # samples beyond this share of the half extent belong to a rim
AT_BORDER = 0.02  # of the diagonal: what is this close to a side of the object's bounds reaches it
MIN_OFFSET = 0.1  # of the half extent: below this offset from the middle of the face, the side of a contact is chance


def blocked_shares(context: PartContext) -> dict[str, float]:
    """Return the share of the part's surface that meets the rest when it moves by its own extent, along its box axes.

    Surface that faces along the way counts, on sheets without an inside both sides.
    """
    points, touch = context.part.samples.points[::STRIDE], TOUCH_RATIO * context.diagonal
    axes, extents, opening = context.body_obb.axes, 2 * context.body_obb.half, context.opening_direction
    deep = extents[outward_axis(context.body_obb, opening)]
    ways = [(opening, deep), (-opening, deep), *((sign * axes[k], extents[k]) for k in context.face_axes for sign in (1, -1))]
    starts, rays = list[np.ndarray](), list[np.ndarray]()
    for direction, extent in ways:
        ahead = points[context.facing(direction)[::STRIDE] > MIN_AHEAD_COSINE]
        # start slightly inside, since a ray that starts on a surface would miss it
        starts.append(ahead - 2 * touch * direction)
        rays.append(np.repeat((max(extent, MIN_WAY * context.diagonal) + 2 * touch) * direction[None], len(ahead), 0))
    met = context.rest.scene.first_hit(np.concatenate(starts), np.concatenate(rays), 1.0).face >= 0
    parts = np.split(met, np.cumsum([len(some) for some in starts])[:-1])
    outward, inward, *sideways = (float(some.mean()) if len(some) > 1 else 0.0 for some in parts)
    return {
        "blocked outward": outward,
        "blocked inward": inward,
        "blocked sideways least": min(sideways),
        "blocked sideways most": max(sideways),
    }


def exposure(context: PartContext) -> dict[str, float]:
    """Return which shares of the part's surface see the outside along their normal, face outward, and face up.

    Open sheets count with either side.
    """
    samples, off = (
        context.part.samples.take(np.arange(0, len(context.part.samples), STRIDE)),
        2 * TOUCH_RATIO * context.diagonal,
    )
    sheet = ~context.part.solid[samples.faces]

    def sees(points: Float[np.ndarray, "n 3"], normals: Float[np.ndarray, "n 3"]) -> Bool[np.ndarray, " n"]:
        return context.rest.scene.first_hit(points + off * normals, 2 * context.diagonal * normals, 1.0).face < 0

    exposed = sees(samples.points, samples.normals)
    exposed[sheet] |= sees(samples.points[sheet], -samples.normals[sheet])
    return {
        "exposed": float(exposed.mean()),
        "facing outward": float((context.facing(context.opening_direction) > FACING_COSINE).mean()),
        "facing up": float((context.facing(UP) > ALONG_COSINE).mean()),
    }


def space_behind(context: PartContext) -> dict[str, float]:
    """Return what is behind the part's back.

    "space behind": median distance to it relative to the diagonal, which also stands for nothing; "nothing behind": share with
    nothing behind; "open behind": share with an opening, free for three thicknesses and at least MIN_WAY.
    """
    points, direction = points_behind(context, BACK_RAYS), context.opening_direction
    hits = context.rest.scene.first_hit(points, np.repeat(-context.diagonal * direction[None], len(points), 0), 1.0)
    nothing, face = hits.face < 0, np.maximum(hits.face, 0)
    inside = ~nothing & context.rest.solid[face] & (context.rest.normals[face] @ direction < 0)
    thick = 2 * context.body_obb.half[outward_axis(context.body_obb, direction)] / context.diagonal
    return {
        "space behind": median(np.where(nothing, 1.0, hits.distance)),
        "nothing behind": float(nothing.mean()),
        "open behind": float((nothing | ~inside & (hits.distance > max(3 * thick, MIN_WAY))).mean()),
    }


def points_behind(context: PartContext, count: int) -> Float[np.ndarray, "n 3"]:
    """Return a grid of `count` points a side, just behind the back of the part's box [m]."""
    core, grid = context.body_obb, np.linspace(-0.85, 0.85, count)
    behind = core.half[outward_axis(core, context.opening_direction)] + 1e-4 * context.diagonal
    local = np.zeros((count**2, 3))
    for axis, value in zip(context.face_axes, np.meshgrid(grid, grid), strict=True):
        local[:, axis] = value.reshape(-1) * core.half[axis]
    return core.world(local) - behind * context.opening_direction


def on_axis(context: PartContext) -> bool:
    """Return whether the rest has surface on the axis of the round outline, within 5 % of the object's diagonal of an end."""
    outline = context.outline
    ends = outline.center + np.array([[-0.5], [0.5]]) * outline.height * outline.axis
    rays = np.array([[-1.0], [1.0]]) * outline.axis * 0.05 * context.diagonal
    return bool((context.rest.scene.first_hit(ends - rays, 2 * rays, 1.0).face >= 0).any())


def touching(context: PartContext, tolerance: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return which samples are within `tolerance` [m] of the rest, the rest's normals at their closest points, and the gaps.

    Normals of other samples are 0. Gaps larger than those of half of the samples may be inf [m].
    """
    search = context.parent.search(context.part.samples.points)
    gap = search.nearer_half(tolerance)
    while (gap < tolerance).sum() < min(8, len(gap)):  # as the connecting area grows in the paper
        tolerance *= 2
    if tolerance > gap[np.isfinite(gap)].max(initial=0.0):
        gap = search.nearer_half(tolerance)
    near = np.flatnonzero(gap < tolerance)
    normals = np.zeros((len(gap), 3))
    normals[near] = context.parent.normals[search.nearest(near)[1]]
    return gap < tolerance, normals, gap


def fit_of_rim(context: PartContext) -> tuple[int, float]:
    """Return how many of the four rims have a clearance to the surface opposite, and the share of the rim that touches it."""
    core = context.body_obb
    samples = context.part.samples
    local = core.local(samples.points) / np.maximum(core.half, 1e-12)
    facing = samples.normals @ core.axes.T
    sides_of = [(sign * local[:, k], sign * facing[:, k]) for k in context.face_axes for sign in (1, -1)]
    rims = np.array([(beyond > RIM) & (along > ALONG_COSINE) for beyond, along in sides_of])
    on_rims = np.flatnonzero(rims.any(0))
    samples, rims = samples.take(on_rims), rims[:, on_rims]
    touch, reach = TOUCH_RATIO * context.diagonal, NEAR_RATIO * context.diagonal
    # start slightly inside, since a ray that starts on a surface would miss it
    start = samples.points - samples.normals * 2 * touch
    hits = context.without_part.scene.first_hit(start, samples.normals * reach, 1.0)
    gap = hits.distance * reach - 2 * touch
    face = np.maximum(hits.face, 0)
    along = np.einsum("ij,ij->i", samples.normals, context.without_part.normals[face])
    gap[(hits.face >= 0) & context.without_part.solid[face] & (along > 0)] = 0  # the rim lies inside the surface opposite
    gap[(np.abs(along) < FACING_COSINE) & (gap > touch)] = np.inf  # ignore slopes and fillets beside the rim
    sides, touched, count = 0, 0, 0
    for rim in rims:
        if rim.sum() < 3:
            continue
        clear = (gap[rim] > touch) & np.isfinite(gap[rim])
        sides += int(clear.mean() > 0.5)
        touched += int((gap[rim] <= touch).sum())
        count += int(rim.sum())
    return sides, touched / max(count, 1)


def enclosed_share(context: PartContext) -> float:
    """Return the share of the candidate with the rest on at least three of the four sides across the opening direction."""
    points, axes = context.part.samples.points[::20], context.body_obb.axes[context.face_axes]
    rays = np.repeat(np.concatenate([axes, -axes]) * context.diagonal, len(points), 0)
    hit = context.rest.scene.first_hit(np.tile(points, (4, 1)), rays, 1.0).face >= 0
    return float((hit.reshape(4, -1).sum(0) >= 3).mean())


def two_pivots(context: PartContext, near: np.ndarray, normals: np.ndarray) -> float:
    """Return how far the candidate is supported at two far ends by surfaces that face along the line between them, 0..1.

    Such contacts are pivots, as opposed to the feet of a fixed handle.
    """
    points = context.part.samples.points
    if near.sum() < 4:
        near = context.gap < max(2 * float(context.gap.min()), 0.004 * context.tolerance_length)
        if near.sum() < 4:
            return 0.0
    held = points[near]
    spread = held - held.mean(0)
    line = np.linalg.svd(spread, full_matrices=False)[2][0]
    t = spread @ line
    reach = float(np.ptp(t))
    parted = quantile(np.abs(t - (t.max() + t.min()) / 2), 0.05) / max(reach / 2, 1e-12)  # 1: no contact between
    far = min(reach / max(context.part.box.diagonal, 1e-12), 1.0)
    return far * parted * float(np.abs(normals[near] @ line).mean())


@dataclass(frozen=True, eq=False)
class FeatureInputs(Brief):
    """What the features of all candidates of an object are computed from.

    material: (P, M) area of each material, or of none, on each patch [m^2].
    """

    candidates: PartCandidates
    material: Float[np.ndarray, "P M"]

    @classmethod
    def of(cls, mesh: Mesh, candidates: PartCandidates) -> FeatureInputs:
        """Build the data of a mesh and its candidates."""
        patch, material = candidates.whole.mesh_patch, mesh.face_material + 1
        shape = int(patch.max()) + 1, int(material.max()) + 1
        area = np.bincount(patch * shape[1] + material, mesh.face_areas, shape[0] * shape[1])
        return cls(candidates, area.reshape(shape))


def candidate_context(inputs: FeatureInputs, candidate: int) -> PartContext | None:
    """Return a candidate as a part among the rest of the object; None if it has no face or nothing is left."""
    whole = inputs.candidates.whole
    moving = inputs.candidates.members[candidate][whole.patch]
    if not moving.any() or moving.all():
        return None
    rest = whole.of(np.flatnonzero(~moving))
    return PartContext(
        part=whole.of(np.flatnonzero(moving)), parent=rest, rest=rest, other_surface=None, without_part=rest,
        barrel_candidates=(), diagonal=whole.diagonal, center=whole.shape.bounds.mean(0),
    )  # fmt: skip


def part_features(inputs: FeatureInputs, candidate: int, context: PartContext) -> dict[str, float]:
    """Return all features of a candidate; the keys are the same for all."""
    return {
        **shape_features(context),
        **_extent(inputs, candidate, context),
        **_place(context),
        **_fit(context),
        **_neighbours(inputs, candidate),
        **_copies(inputs, candidate, context),
        **_material(inputs, candidate, context),
        **blocked_shares(context),
        **exposure(context),
        **space_behind(context),
    }


def _extent(inputs: FeatureInputs, candidate: int, context: PartContext) -> dict[str, float]:
    core, candidates = context.body_obb, inputs.candidates
    extents = np.sort(np.ptp(candidates.whole.shape.bounds, axis=0))
    patches = candidates.members[candidate]
    return {
        "area share": float(candidates.overlap.area[candidate] / candidates.contacts.patch_area.sum()),
        "face share": float(min(4 * core.half[0] * core.half[1] / max(extents[1] * extents[2], 1e-12), MAX_LENGTH_RATIO)),
        "largest patch": float(candidates.contacts.patch_area[patches].max() / max(candidates.overlap.area[candidate], 1e-300)),
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


def _fit(context: PartContext) -> dict[str, float]:
    near, normals, gap = touching(context, 2 * TOUCH_RATIO * context.diagonal)
    sides, flush = fit_of_rim(context)
    gaps = [quantile(gap, share) / context.diagonal for share in (0.05, 0.5)]
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
    outside, total = float(beside.sum()), max(float(candidates.overlap.area[candidate]), 1e-300)
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
    return {"log copies": float(np.log1p(copies.sum())), "copy on the axis": float((across < 0.3 * outline.radius).any())}


def _material(inputs: FeatureInputs, candidate: int, context: PartContext) -> dict[str, float]:
    """Return how well the part's most frequent material separates it from the rest."""
    total = inputs.material.sum(0)
    mine = inputs.candidates.members[candidate] @ inputs.material
    k = int(mine.argmax())
    return {"materials": float(np.log1p((total > 0).sum())), "material of its own": float(mine[k] / max(total[k], 1e-300))}
