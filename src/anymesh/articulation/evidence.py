"""What sweeping each candidate motion shows: freedom, support, guidance, the side of the handle."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from anymesh.articulation.hold import kept, lever, support
from anymesh.articulation.leaves import meeting_sides, outer_side, pair_side, passes
from anymesh.geometry.distance_ import distance_to_triangles
from anymesh.geometry.surroundings import CARVED, Surroundings
from anymesh.geometry.sweep import free_amount, sweep
from anymesh.reasoning.questions import Candidate, PartFacts
from anymesh.types import Motion, MotionKind, Sweep

ACROSS = 0.6  # weight of a bar that runs across the line
SLACKS = (3.0, CARVED)  # factors on the penetration that counts, tried in turn where a hinge is blocked
LEVER = 1.0  # [rad] free each way: what turns up and down, and is held by nothing, is pressed down, as levers are
RIMS = ("edge", "edge_mid", "barrel")  # hinges at a rim of the part: it may be stuck in the rest, and still turn about them
OUTWARDS = 0.5  # cosine of a motion with the way out
STUCK = np.deg2rad(12)  # a hinge that opens less is not free
SQUARE = 0.7  # cosine from which a surface faces the way out, or away from it
TURNS = (37, 90, 141, 200, 285)  # [deg] about its axis; a body of revolution looks the same after all of them
HELD = 0.02  # a slide is held sideways when stopped within this share of the diagonal


def part_facts(around: Surroundings, name: str, label: str, bail: bool) -> PartFacts:
    """The facts of one part that do not depend on a motion."""
    core = around.core
    extents = 2 * core.half / around.diagonal
    return PartFacts(
        name=name,
        label=label,
        extents=(float(extents[0]), float(extents[1]), float(extents[2])),
        thinness=float(core.half[2] / max(core.half[1], 1e-12)),
        roundness=around.outline.roundness,
        flatness=around.outline.height / max(around.outline.radius, 1e-9),
        outward=around.outward,
        openness=around.openness,
        buried=around.buried,
        size=around.part.box.diagonal / around.diagonal,
        diagonal=around.diagonal,
        horizontal=bool(abs(around.outward[2]) > 0.8),
        handle=around.handle,
        touches_ends=bail,
        tall=_tall(around),
        height=float((around.part.bounds.mean(0)[2] - around.bounds[0, 2]) / max(np.ptp(around.bounds[:, 2]), 1e-9)),
        seated=_seated(around),
        free_rim=_free_rim(around) if around.outline.roundness > 0.5 else 0.0,
        lid=_lid(around) if around.outline.roundness > 0.5 else 0.0,
        marked=_marked(around) if around.outline.roundness > 0.5 else 1.0,
    )


def _tall(around: Surroundings) -> float:
    if abs(around.outward[2]) > 0.8:
        return 0.0
    across = np.cross(around.outward, (0.0, 0.0, 1.0))
    width = float(np.ptp(around.part.corners @ (across / np.linalg.norm(across))))
    return float(np.log2(max(float(np.ptp(around.part.bounds[:, 2])), 1e-9) / max(width, 1e-9)))


def _seated(around: Surroundings) -> float:
    """Share of what faces away from the way out that lies on the parent, or in it."""
    back = around.part.samples.normals @ around.outward < -SQUARE
    near = around.gap < max(2 * around.config.connecting * around.scale, 1.5 * float(around.gap.min()))
    return float(near[back].mean()) if back.sum() > 3 else 0.0


def _free_rim(around: Surroundings) -> float:
    """Share of a round part's rim that sees nothing of the rest within two radii, straight away from its axis."""
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


def _marked(around: Surroundings) -> float:
    """How far a round part is from a body of revolution, over its radius: what turns has something on it that shows it."""
    outline, points = around.outline, around.part.samples.points[::4]
    off = 0.0
    for turn in np.deg2rad(TURNS):
        T = Motion(MotionKind.TURN, outline.axis, outline.center, "").transform(turn)
        turned = points @ T[:3, :3].T + T[:3, 3]
        off = max(off, float(np.percentile(distance_to_triangles(turned, around.part.triangles), 99)))
    return off / max(outline.radius, 1e-9)


def _lid(around: Surroundings) -> float:
    """How much of a round part's rim lies near the parent, times the share of its back with nothing close behind."""
    outline, points = around.outline, around.part.samples.points
    arm = points - outline.center
    radius = np.linalg.norm(arm - (arm @ outline.axis)[:, None] * outline.axis, axis=1)
    rim, back = radius > 0.85 * outline.radius, radius < 0.6 * outline.radius
    if rim.sum() < 3 or back.sum() < 3:
        return 0.0
    held = float((around.gap[rim] < 0.1 * outline.radius).mean())
    rays = np.repeat(-around.outward[None] * 0.5 * outline.radius, int(back.sum()), 0)
    empty = float((around.rest.scene.first_hit(points[back], rays, 1.0).face < 0).mean())
    return held * empty


def weigh_all(around: Surroundings, proposed: list[tuple[str, Motion]]) -> tuple[Candidate, ...]:
    """Sweeps every motion and gathers the evidence for it.

    Part and rest may be stuck in each other at rest, as artists leave them: hinges that are blocked are swept again with more
    penetration allowed, and at last as if the rest made room for the part.
    """
    along = iter(support(around, [m for _, m in proposed if m.kind is MotionKind.TURN]))
    meeting = meeting_sides(around)
    found = []
    for role, motion in proposed:
        if motion.kind is MotionKind.TURN:
            found.append(_loosened(around, _turn(around, role, motion, next(along), meeting)))
        else:
            found.append(_slide(around, role, motion))
    shares = kept(around, [c.motion for c in found], [c.opens for c in found])
    return tuple(replace(c, kept=float(share)) for c, share in zip(found, shares, strict=True))


def _loosened(around: Surroundings, c: Candidate) -> Candidate:
    """A hinge that would let the part out but for what holds it, with as little of the hold ignored as sets it free."""
    if c.role not in RIMS or c.outward < OUTWARDS or c.opening > STUCK:
        return c
    for slack in SLACKS:
        swept = sweep(around.obstacles(slack), c.motion, steps=around.config.sweep_steps)
        opening, closing = (swept.forward, swept.backward)[:: c.opens]
        if opening > STUCK:
            return replace(c, sweep=swept, opening=opening, closing=closing, slack=slack)
    return c


def _turn(around: Surroundings, role: str, motion: Motion, near: np.ndarray, meeting: np.ndarray) -> Candidate:
    swept = sweep(around.obstacles(), motion, steps=around.config.sweep_steps)
    moves = np.cross(motion.axis, around.part.samples.points.mean(0) - motion.origin)
    outward = float(moves @ around.outward)
    across = float(np.linalg.norm(moves))
    toward = outward / across if across > 1e-9 else 0.0
    opens = _opening_sign(toward, swept.forward, swept.backward, np.deg2rad(20))
    out = toward * opens
    if min(swept.forward, swept.backward) > LEVER and abs(moves[2]) > 0.5 * across:
        opens = -1 if moves[2] > 0 else 1
    reach, hugs, thick = lever(around, motion)
    return Candidate(
        motion, swept, role, opens,
        *((swept.forward, swept.backward) if opens > 0 else (swept.backward, swept.forward)),
        support=float(near[0]),
        sibling=float(near[1]),
        handle_side=_handle_side(around, motion),
        guided=0.0,
        depth=0.0,
        vertical=float(abs(motion.axis[2])),
        above=_above(around, motion),
        captured=False,
        outward=out,
        pair=pair_side(around, motion, meeting),
        outer=outer_side(around, motion),
        handle_off=_handle_off(around, motion),
        opposite=float(near[2]),
        reach=reach,
        hugs=hugs,
        thick=thick,
    )  # fmt: skip


def _slide(around: Surroundings, role: str, motion: Motion) -> Candidate:
    outward = abs(float(motion.axis @ around.outward)) > 0.5
    swept = sweep(around.obstacles() if outward else around.held_by, motion, steps=around.config.sweep_steps)
    toward = float(motion.axis @ around.outward)
    opens = _opening_sign(toward, swept.forward, swept.backward, 0.0)
    side = np.linalg.svd(motion.axis[None])[2][1:]
    core = around.core.axes
    flat = sorted(core, key=lambda a: abs(float(a @ motion.axis)))[:2]
    side = np.array([a - (a @ motion.axis) * motion.axis for a in flat]) if len(flat) == 2 else side
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    step = HELD * around.scale
    held = 0
    for direction in side:
        sideways = Motion(MotionKind.SLIDE, direction, motion.origin, "sideways")
        held += sum(not free_amount(around.held_by, sideways, sign, step, 3)[1] for sign in (1, -1))
    inner = around.inside_depth(motion.axis * opens)
    across = sorted(np.ptp(around.part.corners @ d) for d in side)[0]
    forward, backward = swept.forward / around.scale, swept.backward / around.scale
    return Candidate(
        motion, swept, role, opens,
        *((forward, backward) if opens > 0 else (backward, forward)),
        support=0.0,
        sibling=0.0,
        handle_side=0.0,
        guided=held / 4,
        depth=float(inner / max(across, 1e-9)),
        vertical=float(abs(motion.axis[2])),
        above=0.0,
        captured=_captured(around, swept),
        outward=toward * opens,
        passes=passes(around, motion, (swept.forward, swept.backward)),
    )  # fmt: skip


def _above(around: Surroundings, motion: Motion) -> float:
    low, high = around.part.bounds[:, 2]
    return float(np.clip(2 * (motion.origin[2] - low) / max(high - low, 1e-9) - 1, -1, 1))


def _captured(around: Surroundings, swept: Sweep) -> bool:
    room = swept.forward + swept.backward
    return not (swept.clear_forward or swept.clear_backward) and room > 0.25 * around.part.box.diagonal


def _opening_sign(toward: float, forward: float, backward: float, little: float) -> int:
    """+1 when +axis opens: outwards if it is free that way, else the freer way."""
    if abs(toward) > 0.15:
        sign = 1 if toward > 0 else -1
        out, into = (forward, backward) if sign > 0 else (backward, forward)
        return -sign if out < little and into > 2 * out else sign
    return 1 if forward >= 0.9 * backward else -1


def _handle_side(around: Surroundings, motion: Motion) -> float:
    """1: the handle is at the side opposite the line; -1: right at the line; 0: no handle, or level with the line.

    A grip that runs across the line counts less: hands close around bars that are parallel to the hinge.
    """
    handle = around.handle
    if handle is None:
        return 0.0
    total = 0.0
    arm = motion.origin - around.core.center
    for axis, where in zip(around.face_axes, handle.across, strict=True):
        if abs(around.core.axes[axis] @ motion.axis) < 0.3:
            side = float(arm @ around.core.axes[axis]) / max(float(around.core.half[axis]), 1e-9)
            across = handle.along is not None and around.face_axes[handle.along] == axis
            total -= float(np.clip(side, -1, 1)) * where * (ACROSS if across else 1.0)
    return float(np.clip(total, -1, 1))


def _handle_off(around: Surroundings, motion: Motion) -> float:
    """How far the handle sits from the middle of the hinge's length: flaps have it in the middle, doors where hands reach."""
    if around.handle is None:
        return 0.0
    across = zip(around.face_axes, around.handle.across, strict=True)
    return max((abs(w) for axis, w in across if abs(around.core.axes[axis] @ motion.axis) > 0.7), default=0.0)
