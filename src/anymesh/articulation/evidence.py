"""What sweeping each candidate motion shows: freedom, support, guidance, the side of the handle."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from anymesh.geometry.distance_ import distance_to_triangles
from anymesh.geometry.surroundings import Surroundings
from anymesh.geometry.sweep import free_amount, sweep
from anymesh.reasoning.questions import Candidate, PartFacts
from anymesh.types import Motion, MotionKind, Sweep

LINE_POINTS = 21  # along a hinge line
ACROSS = 0.6  # weight of a bar that runs across the line
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
        horizontal=bool(abs(around.outward[2]) > 0.8),
        handle=around.handle,
        touches_ends=bail,
    )


def weigh_all(around: Surroundings, proposed: list[tuple[str, Motion]]) -> tuple[Candidate, ...]:
    """Sweeps every motion and gathers the evidence for it."""
    along = _support(around, [m for _, m in proposed if m.kind is MotionKind.TURN])
    found = []
    for role, motion in proposed:
        if motion.kind is MotionKind.TURN:
            found.append(_turn(around, role, motion, *next(along)))
        else:
            found.append(_slide(around, role, motion))
    return tuple(found)


def _support(around: Surroundings, turns: list[Motion]) -> Iterator[tuple[float, float]]:
    """For each hinge line, as long as the part: the shares that have the parent, and another movable part, near."""
    if not turns:
        return
    points = around.part.samples.points
    lines = []
    for motion in turns:
        along = points @ motion.axis
        at = np.linspace(along.min(), along.max(), LINE_POINTS) - motion.origin @ motion.axis
        lines.append(motion.origin + at[:, None] * motion.axis)
    probe = np.concatenate(lines)
    reach = around.config.support * around.scale
    parent = distance_to_triangles(probe, around.parent.triangles) < reach
    other = np.zeros(len(probe), bool)
    if around.others is not None:
        other = distance_to_triangles(probe, around.others.triangles) < reach
    shares = (near.reshape(len(turns), LINE_POINTS).mean(1) for near in (parent, other))
    for support, sibling in zip(*shares, strict=True):
        yield float(support), float(sibling)


def _turn(around: Surroundings, role: str, motion: Motion, support: float, sibling: float) -> Candidate:
    swept = sweep(around.obstacles, motion, steps=around.config.sweep_steps)
    moves = np.cross(motion.axis, around.part.samples.points.mean(0) - motion.origin)
    outward = float(moves @ around.outward)
    across = float(np.linalg.norm(moves))
    toward = outward / across if across > 1e-9 else 0.0
    opens = _opening_sign(toward, swept.forward, swept.backward, np.deg2rad(20))
    return Candidate(
        motion, swept, role, opens,
        *((swept.forward, swept.backward) if opens > 0 else (swept.backward, swept.forward)),
        support=support,
        sibling=sibling,
        handle_side=_handle_side(around, motion),
        guided=0.0,
        depth=0.0,
        vertical=float(abs(motion.axis[2])),
        above=_above(around, motion),
        captured=False,
        outward=toward * opens,
    )  # fmt: skip


def _slide(around: Surroundings, role: str, motion: Motion) -> Candidate:
    outward = abs(float(motion.axis @ around.outward)) > 0.5
    swept = sweep(around.obstacles if outward else around.held_by, motion, steps=around.config.sweep_steps)
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
