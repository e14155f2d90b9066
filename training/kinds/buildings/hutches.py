"""Rabbit hutches, and small doors of wire and wood."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang
from training.kinds.solids import Span, box, cut, prism, rectangle, rod, tube
from training.kinds.wheels import beam


def mesh_leaf(m: Model, part: str, x: Span, y: Span, z: Span, rim: float) -> None:
    """A frame with wire in it: crossed wires, upright wires, or one thin sheet."""
    m.add(part, prism(rectangle(x, z, rim), "y", y))
    a, b, c = (x[0] + 0.5 * rim, x[1] - 0.5 * rim), (z[0] + 0.5 * rim, z[1] - 0.5 * rim), sum(y) / 2
    style = m.pick("cross", "upright", "sheet")
    if style == "sheet":
        m.add(part, box(a, (c - 0.002, c + 0.002), b))
        return
    m.add(part, *(rod((d, c, b[0]), (d, c, b[1]), 0.002, 4) for d in np.linspace(*a, max(4, round((a[1] - a[0]) / 0.05)))))
    if style == "cross":
        m.add(
            part,
            *(
                rod((a[0], c + 0.003, d), (a[1], c + 0.003, d), 0.002, 4)
                for d in np.linspace(*b, max(4, round((b[1] - b[0]) / 0.05)))
            ),
        )


def board_leaf(m: Model, part: str, x: Span, y: Span, z: Span) -> None:
    """A wooden leaf: one board, upright boards with battens, or boards with a cross."""
    style, thick = m.pick("plain", "boards", "zed"), y[1] - y[0]
    if style == "plain":
        m.add(part, box(x, y, z))
        return
    cs = np.linspace(*x, m.pick(3, 4, 5) + 1)
    m.add(part, *(box((a, b - 0.003), y, z) for a, b in pairwise(cs)))
    w = 0.12 * min(x[1] - x[0], z[1] - z[0])
    out, inner = (y[0] - 0.6 * thick, y[0]), (x[0] + 0.02, x[1] - 0.02)
    m.add(part, *(box(inner, out, (c - w / 2, c + w / 2)) for c in (z[0] + w, z[1] - w)))
    if style == "zed":
        m.add(
            part,
            beam(
                (inner[0] + w, out[0] + 0.3 * thick, z[0] + w),
                (inner[1] - w, out[0] + 0.3 * thick, z[1] - w),
                0.5 * thick,
                w,
                (0, 1, 0),
            ),
        )


def catch(m: Model, part: str, at: tuple[float, float, float], inward: int) -> None:
    """A turn button on the frame, or a knob, a bolt or a ring on the leaf."""
    x, y, z = at
    style = m.pick("turn", "knob", "bolt", "ring", "none")
    if style == "turn":
        m.add(part, rod((x + inward * 0.025, y - 0.02, z), (x + inward * 0.025, y, z), 0.008, 8))
        m.add(part, box((x - 0.005, x + inward * 0.05), (y - 0.018, y - 0.008), (z - 0.01, z + 0.01)))
    elif style == "knob":
        m.add(part, rod((x + inward * 0.03, y - 0.025, z), (x + inward * 0.03, y, z), 0.012, 10))
    elif style == "bolt":
        m.add(part, box((x + inward * 0.01, x + inward * 0.07), (y - 0.006, y), (z - 0.015, z + 0.015)))
        m.add(part, rod((x - inward * 0.02, y - 0.012, z), (x + inward * 0.07, y - 0.012, z), 0.005, 8))
    elif style == "ring":
        c = x + inward * 0.03
        m.add(
            part, tube([(c - 0.015, y, z), (c - 0.015, y - 0.015, z), (c + 0.015, y - 0.015, z), (c + 0.015, y, z)], 0.004, 6)
        )


def swing_leaf(m: Model, part: str, x: Span, y: Span, z: Span, side: str, wire: bool) -> None:
    """A small door of wood or wire with its catch."""
    if wire:
        mesh_leaf(m, part, x, y, z, 0.1 * min(x[1] - x[0], z[1] - z[0]))
    else:
        board_leaf(m, part, x, y, z)
    hang(m, part, x, y, z, side, OUT, m.number(90, 130) if side != "bottom" else m.number(80, 110))
    free = x[1] if side == "left" else x[0]
    if side in ("left", "right"):
        catch(m, part, (free, y[0], z[0] + 0.5 * (z[1] - z[0])), -1 if side == "left" else 1)
    else:
        m.add(part, rod((sum(x) / 2, y[0] - 0.025, z[1] - 0.03), (sum(x) / 2, y[0], z[1] - 0.03), 0.012, 10))


def rabbit_hutch(m: Model) -> None:
    """A hutch of one or two floors with doors of wire and wood, a roof that opens, trays, a ramp; on legs or on the ground."""
    half, deep, tiers = m.number(0.45, 0.8), m.number(0.42, 0.6), m.pick(1, 1, 2)
    tall, low, t = m.number(0.4, 0.55), m.pick(0.08, 0.3, 0.5) if tiers == 1 else m.pick(0.06, 0.2), 0.016
    top, w = low + tiers * tall, 0.035
    sunk = m.chance(0.5)
    wood, trays = m.pick("left", "right"), m.chance(0.5)
    m.add(BASE, box((-half, half), (deep - t, deep), (low, top)))
    wired = m.chance(0.3)
    for s in (-1, 1):
        if wired and (s < 0) == (wood == "right"):
            m.add(
                BASE,
                box((s * half, s * (half - t)), (0.02, w), (low, top)),
                *(
                    rod((s * (half - 0.008), b, low), (s * (half - 0.008), b, top), 0.003, 4)
                    for b in np.arange(w + 0.03, deep, 0.04)
                ),
            )
        else:
            m.add(BASE, box((s * half, s * (half - t)), (0.02 if not sunk else 0.0, deep - t), (low, top)))
    m.add(BASE, *(box((s * half, s * (half - w)), (b, b + w), (0, top)) for s in (-1, 1) for b in (0.0, deep - w)))
    for tier in range(tiers):
        _hutch_tier(m, tier, (half, deep, tall, low), (trays, sunk, wood))
    _hutch_roof(m, half, deep, top)
    if tiers == 2 and m.chance(0.7):
        m.add(BASE, beam((-0.3 * half, deep - 0.12, low + tall), (0.4 * half, deep - 0.12, low + t), 0.012, 0.15, (0, 0, 1)))
    if m.chance(0.4):
        m.add(
            BASE,
            rod((0.3 * half, -0.05, low + 0.35 * tall), (0.3 * half, -0.05, low + 0.6 * tall), 0.03, 12)
            if sunk
            else box((half, half + 0.05), (0.1, 0.25), (low + 0.2, low + 0.35)),
        )


def _hutch_tier(m: Model, tier: int, size: tuple, how: tuple[bool, bool, str]) -> None:
    """A floor with one cell or two, their doors, and a tray that is pulled out below them."""
    (half, deep, tall, low), (trays, sunk, wood), t, w = size, how, 0.016, 0.035
    y = (0.0, 0.02)
    z = (low + tier * tall, low + (tier + 1) * tall)
    m.add(BASE, box((-half, half), (0.0, deep), (z[0], z[0] + t)), box((-half, half), (0, 0.03), (z[1] - w, z[1])))
    split = m.number(-0.25, 0.25) * half if tier == 0 or m.chance(0.5) else half - w
    lift = 0.05 if trays else 0.0
    cells = [(-half + w, split - w / 2), (split + w / 2, half - w)] if split < half - w - 0.01 else [(-half + w, half - w)]
    if len(cells) == 2:
        m.add(BASE, box((split - w / 2, split + w / 2), (0, 0.03), (z[0] + t + lift, z[1])))
        if m.chance(0.7):
            m.add(
                BASE,
                cut(
                    box((split - t / 2, split + t / 2), (0.04, deep - t), (z[0] + t + lift, z[1] - 0.005)),
                    box((split - 1, split + 1), (0.5 * deep, 0.8 * deep), (z[0] + t, z[0] + 0.25)),
                ),
            )
    if trays:
        m.add(
            f"tray_{tier}",
            box((-half + w + 0.004, half - w - 0.004), (0.004, deep - 0.04), (z[0] + t + 0.002, z[0] + t + 0.01)),
        )
        m.add(
            f"tray_{tier}",
            box((-half + w + 0.004, half - w - 0.004), (-0.004, 0.012), (z[0] + t + 0.002, z[0] + t + 0.042)),
            box((-0.06, 0.06), (-0.02, -0.004), (z[0] + t + 0.015, z[0] + t + 0.028)),
        )
        m.slide(f"tray_{tier}", (0, -1, 0), 0.75 * deep)
    for i, x in enumerate(cells):
        side = m.pick("left", "right") if len(cells) == 1 else ("left", "right")[i]
        side = "bottom" if m.chance(0.12) else side
        lap = 0.004 if sunk else -0.012
        span, rise = (x[0] + lap, x[1] - lap), (z[0] + t + lift + max(lap, -0.004), z[1] - w - lap)
        swing_leaf(
            m,
            f"door_{tier}_{i}",
            span,
            y if sunk else (-0.022, -0.002),
            rise,
            side,
            not (len(cells) == 2 and (i == 0) == (wood == "left")),
        )


def _hutch_roof(m: Model, half: float, deep: float, top: float) -> None:
    """A felted roof that leans back: fixed, or hinged behind, whole or in two."""
    lap, fall, t, style = m.number(0.03, 0.08), m.number(0.03, 0.12), 0.018, m.pick("fixed", "whole", "whole", "two")
    line = [(-lap, top + fall + 0.002), (deep + lap, top + 0.002), (deep + lap, top + t), (-lap, top + fall + t)]
    wedge = [(0.0, top), (deep, top), (0.0, top + fall * (deep + lap) / (deep + 2 * lap))]
    m.add(
        BASE,
        *(prism(wedge, "x", (s * half, s * (half - 0.016))) for s in (-1, 1)),
        box((-half, half), (0.0, 0.016), (top, top + 0.85 * fall)),
    )
    spans = {"two": {"roof_left": (-half - lap, -0.002), "roof_right": (0.002, half + lap)}}.get(
        style, {"roof" if style == "whole" else BASE: (-half - lap, half + lap)}
    )
    for part, x in spans.items():
        m.add(part, prism(line, "x", x))
        if part != BASE:
            m.hinge(part, (0, deep + lap, top + t), (-1, 0, 0), m.number(60, 100))
            m.add(
                part,
                *(
                    box((c - 0.015, c + 0.015), (deep - 0.1, deep + lap), (top + t + 0.02, top + t + 0.026))
                    for c in (x[0] + 0.12, x[1] - 0.12)
                ),
            )
