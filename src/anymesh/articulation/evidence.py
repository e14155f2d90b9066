"""Evidence for each candidate motion, from its sweep: free range, contact retention, support, guidance, handle side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float

from anymesh.articulation.candidate_motions import (
    HINGE_ROLES,
    Candidate,
    ProposedMotion,
    Role,
    contact_points,
    contact_tolerance,
)
from anymesh.config import ACROSS_COSINE, FACING_COSINE
from anymesh.geometry.circles import MIN_CIRCLE_ROUNDNESS
from anymesh.geometry.sweep import free_amounts, sweep_all
from anymesh.motion.part_context import PartContext
from anymesh.types import JointType, Motion, Sweep

SUPPORT_RATIO = 0.02  # of the tolerance length: maximum distance between a hinge line and the parent that supports it
SWEEP_STEPS = 36  # steps of a sweep in each direction: 5 degrees each over half a turn
LINE_POINTS = 21  # sample points along a hinge line
MAX_RETENTION_POINTS = 120  # sample points of the contact that are followed during a motion
WATCHED_ANGLE_RAD = np.deg2rad(30)  # [rad] opening of a hinge at which contact is measured
WATCHED_TRAVEL_RATIO = 0.5  # travel of a slide at which contact is measured, relative to the part's extent along it
RETAINED_FACTOR = 1.5  # contact is retained within this multiple of the distance that counts as contact at rest
CROSSWISE_HANDLE_WEIGHT = 0.6  # weight of the side of a bar handle that runs across the line
MIN_ARM_RATIO = 0.05  # of the part's diagonal: nearer to its center, a rotation has no direction
GUIDE_STEP_RATIO = 0.02  # of the tolerance length: a slide is guided if a sideways step of this length is blocked
# of its length along the axis: contact and reach of a part that turns endlessly where it is free all round
MAX_HELD_RATIO, MIN_REACH_RATIO = 0.5, 0.5
# of its reach: distance of the centroid from the axis of a rotor; of such rotations that are free, 75 % turn fully
MAX_BALANCE_RATIO = 0.1
# of its reach: where the end of a crank begins, and how far this end stands off along the axis; an estimate
END_RATIO, MIN_ARM_END_RATIO, MAX_ARM_END_RATIO = 0.75, 0.45, 0.9
UNSWEPT = Sweep(0.0, 0.0, clear_forward=False, clear_backward=False)
ENDLESS = Sweep(np.pi, np.pi, clear_forward=True, clear_backward=True)


def contact_retention(context: PartContext, motions: list[Motion], signs: list[int]) -> np.ndarray:
    """Return the share of the contact that stays near the parent at a small opening, one per motion.

    signs: sign of the opening, one per motion.
    """
    contact = contact_points(context)
    if len(contact) < 3 or not motions:
        return np.zeros(len(motions))
    contact = contact[:: max(1, len(contact) // MAX_RETENTION_POINTS)]
    moved = []
    for motion, sign in zip(motions, signs, strict=True):
        extent = float(np.ptp(context.part.corners @ motion.axis))
        amount = WATCHED_ANGLE_RAD if motion.kind is JointType.REVOLUTE else WATCHED_TRAVEL_RATIO * extent
        T = motion.transform(sign * amount)
        moved.append(contact @ T[:3, :3].T + T[:3, 3])
    off = context.parent.tree.distance(np.concatenate(moved))
    return (off.reshape(len(motions), -1) < RETAINED_FACTOR * contact_tolerance(context)).mean(1)


def hinge_support(context: PartContext, motions: list[Motion]) -> np.ndarray:
    """Return the support of each hinge line, as long as the part: an array (motions, 3).

    The columns are the shares of the line near the parent and near another movable part, and the share near the parent of the
    line mirrored at the part's center (its free side, if there is one).
    """
    if not motions:
        return np.zeros((0, 3))
    points, lines = context.part.samples.points, []
    for motion in motions:
        along = points @ motion.axis
        at = np.linspace(along.min(), along.max(), LINE_POINTS) - motion.origin @ motion.axis
        line = motion.origin + at[:, None] * motion.axis
        arm = context.body_obb.center - motion.origin
        lines += [line, line + 2 * (arm - (arm @ motion.axis) * motion.axis)]
    probe = np.concatenate(lines)
    reach = SUPPORT_RATIO * context.tolerance_length
    parent = (context.parent.tree.distance(probe) < reach).reshape(len(motions), 2, LINE_POINTS).mean(2)
    other = np.zeros(len(motions))
    if context.other_surface is not None:
        near = context.other_surface.tree.distance(probe) < reach
        other = near.reshape(len(motions), 2, LINE_POINTS).mean(2)[:, 0]
    return np.stack([parent[:, 0], other, parent[:, 1]], 1)


def sweep_candidates(context: PartContext, proposed: Sequence[ProposedMotion]) -> tuple[Candidate, ...]:
    """Measure and sweep all motions: return two candidates per motion, opening along its axis and against it."""
    return swept(context, unswept(context, proposed))


def unswept(context: PartContext, proposed: Sequence[ProposedMotion]) -> tuple[Candidate, ...]:
    """Measure all motions without moving the part: return one candidate per motion, opening along its axis."""
    hinges = [m for _, m in proposed if m.kind is JointType.REVOLUTE]
    supported = iter(hinge_support(context, hinges))
    return tuple(
        _revolute(context, role, motion, next(supported))
        if motion.kind is JointType.REVOLUTE
        else _prismatic(context, role, motion)
        for role, motion in proposed
    )


def swept(context: PartContext, candidates: Sequence[Candidate]) -> tuple[Candidate, ...]:
    """Sweep measured motions: return two candidates per motion, opening along its axis and against it.

    A circular outline takes up no new space when it turns about its axis. So a part that has one is not stopped there: what
    would stop it is mostly how it is modelled, such as a wheel that reaches into its axle or its arch.
    """
    motions, steps = [c.motion for c in candidates], SWEEP_STEPS
    slides = [m for m in motions if m.kind is JointType.PRISMATIC]
    guided = iter(_guided_share(context, slides))
    circular = context.outline.roundness > MIN_CIRCLE_ROUNDNESS
    sweeps = {k: ENDLESS for k, c in enumerate(candidates) if circular and c.role == "round"}
    for obstacles in {id(o): o for o in map(context.obstacles_of, motions)}.values():
        chosen = [k for k, m in enumerate(motions) if k not in sweeps and context.obstacles_of(m) is obstacles]
        sweeps.update(zip(chosen, sweep_all(obstacles, [motions[k] for k in chosen], steps), strict=True))
    ahead = [
        _swept_hinge(context, c, sweeps[k])
        if c.motion.kind is JointType.REVOLUTE
        else _swept_slide(context, c, sweeps[k], next(guided))
        for k, c in enumerate(candidates)
    ]
    both = [way for c in ahead for way in (c, c.reversed())]
    shares = contact_retention(context, [c.motion for c in both], [c.opening_sign for c in both])
    return tuple(replace(c, contact_retention=float(share)) for c, share in zip(both, shares, strict=True))


def _swept_hinge(context: PartContext, c: Candidate, sweep: Sweep) -> Candidate:
    c = replace(c, sweep=sweep, opening=sweep.forward, closing=sweep.backward)
    return replace(c, spins=c.is_endless and c.role not in HINGE_ROLES and _spins(context, c.motion))


def _spins(context: PartContext, motion: Motion) -> bool:
    """Return whether a part turns about its own middle, or as a crank does, held at one end of its length along the axis."""
    points = context.part.samples.points
    along, off = points @ motion.axis, motion.distance(points)
    length, reach = float(np.ptp(along)), float(off.max())
    held = float(np.ptp(context.contact @ motion.axis)) if len(context.contact) else 0.0
    if held > MAX_HELD_RATIO * length or reach < MIN_REACH_RATIO * length:
        return False  # doors and louvers
    end = float(np.ptp(along[off > END_RATIO * reach])) / max(reach, 1e-9)
    crank = abs(motion.axis[2]) < FACING_COSINE and MIN_ARM_END_RATIO < end < MAX_ARM_END_RATIO
    return crank or float(motion.distance(context.part.centroid[None])[0]) < MAX_BALANCE_RATIO * reach


def _swept_slide(context: PartContext, c: Candidate, sweep: Sweep, guided: float) -> Candidate:
    scale, room = context.tolerance_length, sweep.forward + sweep.backward
    captured = not (sweep.clear_forward or sweep.clear_backward) and room > 0.25 * context.part.box.diagonal
    opening, closing = sweep.forward / scale, sweep.backward / scale
    return replace(c, sweep=sweep, opening=opening, closing=closing, guided=guided, captured=captured)


def initial_direction(context: PartContext, motion: Motion) -> Float[np.ndarray, " 3"]:
    """Return the direction in which the part's center begins to move along a motion, unit.

    It is shorter for a rotation nearly about the center, whose direction is chance, and 0 for one about the center.
    """
    if motion.kind is JointType.PRISMATIC:
        return motion.axis
    moves = np.cross(motion.axis, context.part.centroid - motion.origin)
    return moves / max(float(np.linalg.norm(moves)), MIN_ARM_RATIO * context.part.box.diagonal, 1e-300)


def _revolute(context: PartContext, role: Role, motion: Motion, near: Float[np.ndarray, " 3"]) -> Candidate:
    outward = float(initial_direction(context, motion) @ context.opening_direction)
    support, sibling, opposite = map(float, near)
    off = np.inf if context.pivot is None else float(motion.distance(context.pivot[None])[0] / context.part.box.diagonal)
    return Candidate(
        motion, UNSWEPT, role, 1, 0.0, 0.0, outward, support, sibling, opposite, _handle_side(context, motion), off_pivot=off
    )


def sides(context: PartContext, motion: Motion) -> np.ndarray:
    """Return the (2, 3) unit directions across a slide, along the part's box where that is perpendicular."""
    flat = sorted(context.body_obb.axes, key=lambda a: abs(float(a @ motion.axis)))[:2]
    side = np.array([a - (a @ motion.axis) * motion.axis for a in flat])
    return side / np.linalg.norm(side, axis=1, keepdims=True)


def _guided_share(context: PartContext, prismatic: list[Motion]) -> list[float]:
    """Return the share of the four directions across each slide in which the part is stopped within GUIDE_STEP_RATIO."""
    ways = [sign * d + 0.0 for sign in (1, -1) for m in prismatic for d in sides(context, m)]  # without -0
    apart = {way.tobytes(): Motion(JointType.PRISMATIC, way, context.body_obb.center, "sideways") for way in ways}
    step = [GUIDE_STEP_RATIO * context.tolerance_length] * len(apart)
    free = free_amounts(context.obstacles_with_others, list(apart.values()), [1] * len(apart), step, 3) if prismatic else []
    clear = dict(zip(apart, [clear for _, clear in free], strict=True))  # slides share directions
    stopped = np.array([not clear[way.tobytes()] for way in ways], bool).reshape(2, len(prismatic), 2)
    return [float(share) for share in stopped.mean((0, 2))]


def _prismatic(context: PartContext, role: Role, motion: Motion) -> Candidate:
    return Candidate(motion, UNSWEPT, role, 1, 0.0, 0.0, outward=float(motion.axis @ context.opening_direction))


def _handle_side(context: PartContext, motion: Motion) -> float:
    """Return the side of the handle: 1 opposite the hinge line, -1 at the line, 0 level with it or without a handle.

    A handle that runs across the line counts less, since pulls are usually parallel to the hinge.
    """
    handle = context.handle
    if handle is None:
        return 0.0
    total = 0.0
    arm = motion.origin - context.body_obb.center
    for axis, where in zip(context.face_axes, handle.across, strict=True):
        if abs(context.body_obb.axes[axis] @ motion.axis) < ACROSS_COSINE:
            side = float(arm @ context.body_obb.axes[axis]) / max(float(context.body_obb.half[axis]), 1e-9)
            across = handle.along is not None and context.face_axes[handle.along] == axis
            total -= float(np.clip(side, -1, 1)) * where * (CROSSWISE_HANDLE_WEIGHT if across else 1.0)
    return float(np.clip(total, -1, 1))
