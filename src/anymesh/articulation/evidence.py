"""Evidence for each candidate motion, from its sweep: free range, support, guidance, handle side."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from anymesh.articulation.adjacent_panels import adjacent_sides, outer_side, overlap_gain, pair_side
from anymesh.articulation.contact_metrics import contact_retention, hinge_support, lever_arm
from anymesh.articulation.motion_question import MIN_FREE_ANGLE_RAD, Candidate, PartFacts
from anymesh.geometry.sweep import free_amounts, sweep_all
from anymesh.motion.part_context import IGNORE_OVERLAP_SCALE, PartContext
from anymesh.types import JointType, Motion, Sweep

CROSSWISE_HANDLE_WEIGHT = 0.6  # weight of the side of a bar handle that runs across the line
PENETRATION_SCALES = (3.0, IGNORE_OVERLAP_SCALE)  # tried in this order if a hinge is blocked
RIM_ROLES = ("edge", "edge_mid", "barrel")  # hinges at a rim, which may turn although the part overlaps static geometry
MIN_OUTWARD_COSINE = 0.5  # minimum cosine between an outward motion and the opening direction
FACING_COSINE = 0.7  # minimum cosine of a surface that faces the opening direction or the opposite one
# [deg] rotations about its axis; a body of revolution looks the same after all of them
ASYMMETRY_ANGLES_DEG = (37, 90, 141, 200, 285)
GUIDE_STEP_RATIO = 0.02  # of the scale: a slide is guided if a sideways step of this length is blocked


def part_facts(around: PartContext, name: str, label: str, two_pivot: bool) -> PartFacts:
    """Compute the facts of a part that do not depend on a motion."""
    core = around.body_obb
    extents = 2 * core.half / around.diagonal
    return PartFacts(
        name=name,
        label=label,
        extents=(float(extents[0]), float(extents[1]), float(extents[2])),
        thinness=float(core.half[2] / max(core.half[1], 1e-12)),
        roundness=around.outline.roundness,
        flatness=around.outline.height / max(around.outline.radius, 1e-9),
        opening_direction=around.opening_direction,
        visibility=around.visibility,
        insertion_depth=around.insertion_depth,
        size=around.part.box.diagonal / around.diagonal,
        diagonal=around.diagonal,
        horizontal=bool(abs(around.opening_direction[2]) > 0.8),
        handle=around.handle,
        two_pivot=two_pivot,
        tall=_face_aspect(around),
        height=float((around.part.bounds.mean(0)[2] - around.bounds[0, 2]) / max(np.ptp(around.bounds[:, 2]), 1e-9)),
        back_contact=_back_contact(around),
        free_rim=_free_rim(around) if around.outline.roundness > 0.5 else 0.0,
        covers_opening=_covers_opening(around) if around.outline.roundness > 0.5 else 0.0,
        rotational_asymmetry=_rotational_asymmetry(around) if around.outline.roundness > 0.5 else 1.0,
    )


def _face_aspect(around: PartContext) -> float:
    if abs(around.opening_direction[2]) > 0.8:
        return 0.0
    across = np.cross(around.opening_direction, (0.0, 0.0, 1.0))
    width = float(np.ptp(around.part.corners @ (across / np.linalg.norm(across))))
    return float(np.log2(max(float(np.ptp(around.part.bounds[:, 2])), 1e-9) / max(width, 1e-9)))


def _back_contact(around: PartContext) -> float:
    """Return the share of the back that is in contact with the parent, or inside it."""
    back = around.part.samples.normals @ around.opening_direction < -FACING_COSINE
    near = around.gap < max(2 * around.config.connecting * around.scale, 1.5 * float(around.gap.min()))
    return float(near[back].mean()) if back.sum() > 3 else 0.0


def _free_rim(around: PartContext) -> float:
    """Return the share of a round part's rim that is free for two radii, radially."""
    outline, points = around.outline, around.part.samples.points
    arm = points - outline.center
    arm -= (arm @ outline.axis)[:, None] * outline.axis
    radius = np.linalg.norm(arm, axis=1)
    rim = np.flatnonzero(radius > 0.85 * outline.radius)[:300]
    if len(rim) < 3:
        return 0.0
    away = arm[rim] / radius[rim, None]
    start = points[rim] + 0.02 * outline.radius * away
    return float((around.rest.scene.first_hit(start, 2 * outline.radius * away, 1.0).face < 0).mean())


def _rotational_asymmetry(around: PartContext) -> float:
    """Return the maximum distance of a round part from its rotated copies, over its radius: knobs have markings or handles."""
    outline, points = around.outline, around.part.samples.points[::4]
    off = 0.0
    for turn in np.deg2rad(ASYMMETRY_ANGLES_DEG):
        T = Motion(JointType.REVOLUTE, outline.axis, outline.center, "").transform(turn)
        turned = points @ T[:3, :3].T + T[:3, 3]
        off = max(off, float(np.percentile(around.part.tree.distance(turned), 99)))
    return off / max(outline.radius, 1e-9)


def _covers_opening(around: PartContext) -> float:
    """Return the share of a round part's rim near the parent, times the share of its back with an opening behind it."""
    outline, points = around.outline, around.part.samples.points
    arm = points - outline.center
    radius = np.linalg.norm(arm - (arm @ outline.axis)[:, None] * outline.axis, axis=1)
    rim, back = radius > 0.85 * outline.radius, radius < 0.6 * outline.radius
    if rim.sum() < 3 or back.sum() < 3:
        return 0.0
    supported = float((around.gap[rim] < 0.1 * outline.radius).mean())
    rays = np.repeat(-around.opening_direction[None] * 0.5 * outline.radius, int(back.sum()), 0)
    empty = float((around.rest.scene.first_hit(points[back], rays, 1.0).face < 0).mean())
    return supported * empty


def hypotheses(around: PartContext, proposed: list[tuple[str, Motion]]) -> tuple[Candidate, ...]:
    """Sweep and measure all motions: return two candidates per motion, opening along its axis and against it.

    Meshes may have parts that penetrate the rest at rest. Blocked hinges are therefore swept again with more allowed
    penetration, and finally with the overlap at rest ignored.
    """
    motions, steps = [m for _, m in proposed], around.config.sweep_steps
    revolute = [m for m in motions if m.kind is JointType.REVOLUTE]
    along, adjacent = iter(hinge_support(around, revolute)), adjacent_sides(around)
    inward = [
        m.kind is JointType.PRISMATIC and abs(float(m.axis @ around.opening_direction)) <= MIN_OUTWARD_COSINE for m in motions
    ]
    swept: dict[int, Sweep] = {}
    for obstacles, wanted in ((around.obstacles(), False), (around.obstacles_at_rest, True)):
        chosen = [k for k, x in enumerate(inward) if x is wanted]
        swept.update(zip(chosen, sweep_all(obstacles, [motions[k] for k in chosen], steps), strict=True))
    guided = iter(_guided_share(around, [m for m in motions if m.kind is JointType.PRISMATIC]))
    ahead = [
        _revolute(around, role, motion, swept[k], next(along), adjacent)
        if motion.kind is JointType.REVOLUTE
        else _prismatic(around, role, motion, swept[k], next(guided))
        for k, (role, motion) in enumerate(proposed)
    ]
    found = _with_overlap_ignored(around, [way for c in ahead for way in (c, reversed_(c))])
    shares = contact_retention(around, [c.motion for c in found], [c.opening_sign for c in found])
    return tuple(replace(c, contact_retention=float(share)) for c, share in zip(found, shares, strict=True))


def reversed_(c: Candidate) -> Candidate:
    """Return the candidate that opens the other way."""
    return replace(c, opening_sign=-c.opening_sign, opening=c.closing, closing=c.opening, outward=-c.outward)


def _with_overlap_ignored(around: PartContext, found: list[Candidate]) -> list[Candidate]:
    """Sweep blocked hinges again at the smallest penetration scale that frees each of them."""
    found = list(found)
    stuck = [
        k
        for k, c in enumerate(found)
        if c.role in RIM_ROLES and c.outward >= MIN_OUTWARD_COSINE and c.opening <= MIN_FREE_ANGLE_RAD
    ]
    for slack in PENETRATION_SCALES:
        swept = sweep_all(around.obstacles(slack), [found[k].motion for k in stuck], around.config.sweep_steps) if stuck else []
        for k, free in zip(list(stuck), swept, strict=True):
            opening, closing = (free.forward, free.backward)[:: found[k].opening_sign]
            if opening > MIN_FREE_ANGLE_RAD:
                found[k] = replace(found[k], sweep=free, opening=opening, closing=closing, penetration_scale=slack)
                stuck.remove(k)
    return found


def _revolute(
    around: PartContext, role: str, motion: Motion, swept: Sweep, near: np.ndarray, adjacent: np.ndarray
) -> Candidate:
    moves = np.cross(motion.axis, around.part.samples.points.mean(0) - motion.origin)
    across = float(np.linalg.norm(moves))
    reach, proximity, thick = lever_arm(around, motion)
    return Candidate(
        motion, swept, role, 1, swept.forward, swept.backward,
        hinge_support=float(near[0]),
        sibling=float(near[1]),
        handle_side=_handle_side(around, motion),
        guided=0.0,
        depth=0.0,
        vertical=float(abs(motion.axis[2])),
        above=_axis_height(around, motion),
        captured=False,
        outward=float(moves @ around.opening_direction) / across if across > 1e-9 else 0.0,
        pair=pair_side(around, motion, adjacent),
        outer=outer_side(around, motion),
        handle_off=_handle_offset(around, motion),
        support_opposite=float(near[2]),
        reach=reach,
        contact_proximity=proximity,
        thick=thick,
    )  # fmt: skip


def _sides(around: PartContext, motion: Motion) -> np.ndarray:
    """Return the (2, 3) unit directions across a slide, along the part's box where that is perpendicular."""
    flat = sorted(around.body_obb.axes, key=lambda a: abs(float(a @ motion.axis)))[:2]
    side = np.array([a - (a @ motion.axis) * motion.axis for a in flat])
    return side / np.linalg.norm(side, axis=1, keepdims=True)


def _guided_share(around: PartContext, prismatic: list[Motion]) -> list[float]:
    """Return the share of the four directions across each slide in which the part is stopped within GUIDE_STEP_RATIO."""
    sideways = [Motion(JointType.PRISMATIC, d, m.origin, "sideways") for m in prismatic for d in _sides(around, m)]
    step = [GUIDE_STEP_RATIO * around.scale] * (2 * len(sideways))
    signs = [1] * len(sideways) + [-1] * len(sideways)
    free = free_amounts(around.obstacles_at_rest, sideways + sideways, signs, step, 3) if prismatic else []
    stopped = np.array([not clear for _, clear in free], bool).reshape(2, len(prismatic), 2)
    return [float(share) for share in stopped.mean((0, 2))]


def _prismatic(around: PartContext, role: str, motion: Motion, swept: Sweep, guided: float) -> Candidate:
    side = _sides(around, motion)
    inner = around.depth_in_parent(motion.axis)
    across = sorted(np.ptp(around.part.corners @ d) for d in side)[0]
    return Candidate(
        motion, swept, role, 1, swept.forward / around.scale, swept.backward / around.scale,
        hinge_support=0.0,
        sibling=0.0,
        handle_side=0.0,
        guided=guided,
        depth=float(inner / max(across, 1e-9)),
        vertical=float(abs(motion.axis[2])),
        above=0.0,
        captured=_captured(around, swept),
        outward=float(motion.axis @ around.opening_direction),
        overlap_gain=overlap_gain(around, motion, (swept.forward, swept.backward)),
    )  # fmt: skip


def _axis_height(around: PartContext, motion: Motion) -> float:
    low, high = around.part.bounds[:, 2]
    return float(np.clip(2 * (motion.origin[2] - low) / max(high - low, 1e-9) - 1, -1, 1))


def _captured(around: PartContext, swept: Sweep) -> bool:
    room = swept.forward + swept.backward
    return not (swept.clear_forward or swept.clear_backward) and room > 0.25 * around.part.box.diagonal


def _handle_side(around: PartContext, motion: Motion) -> float:
    """Return the side of the handle: 1 opposite the hinge line, -1 at the line, 0 level with it or without a handle.

    A handle that runs across the line counts less, since pulls are usually parallel to the hinge.
    """
    handle = around.handle
    if handle is None:
        return 0.0
    total = 0.0
    arm = motion.origin - around.body_obb.center
    for axis, where in zip(around.face_axes, handle.across, strict=True):
        if abs(around.body_obb.axes[axis] @ motion.axis) < 0.3:
            side = float(arm @ around.body_obb.axes[axis]) / max(float(around.body_obb.half[axis]), 1e-9)
            across = handle.along is not None and around.face_axes[handle.along] == axis
            total -= float(np.clip(side, -1, 1)) * where * (CROSSWISE_HANDLE_WEIGHT if across else 1.0)
    return float(np.clip(total, -1, 1))


def _handle_offset(around: PartContext, motion: Motion) -> float:
    """Return the offset of the handle from the center of the hinge line (0..1): small for flaps, large for doors."""
    if around.handle is None:
        return 0.0
    across = zip(around.face_axes, around.handle.across, strict=True)
    return max((abs(w) for axis, w in across if abs(around.body_obb.axes[axis] @ motion.axis) > 0.7), default=0.0)
