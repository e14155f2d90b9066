"""How plausible a motion is: the evidence for and against it, each piece with its name, summed by `weights.WEIGHTS`.

The unit is that of a log-likelihood: a motion that scores one more is about e times likelier than another.
"""

from __future__ import annotations

import numpy as np

from anymesh.reasoning.questions import Candidate, PartFacts
from anymesh.reasoning.vocabulary import Habit
from anymesh.reasoning.weights import WEIGHTS
from anymesh.types import MotionKind

BLOCKED = float(np.deg2rad(12))  # a hinge that opens less is no hinge
LITTLE = 0.008  # a slide that is free for less, as a share of the diagonal, is no slide
FLAT = 0.9  # a control lower than this share of its radius is a button
SMALL = 0.06  # a part with less of the object's diagonal is a control, not a door
CONTROL = 0.25  # a part with less of it may be a lever
ROUND = 0.8  # an outline this round may turn about its axis
HIGH = 1.5  # a round part higher than this times its radius is a pin or a button, less a wheel or a dial
MARKED = 0.15  # a round part that is this share of its radius off a body of revolution shows that it turns
PLATE = 0.5  # a part thinner than this share of its width is a plate, else a block
LEVEL = 0.5  # a part that lies deeper in its parent than this share of its width is held by its walls
DEEP = 0.6  # a drawer reaches this share of its width into its parent
GUIDED = 0.7  # held on three of four sides
BOTH_WAYS = 1.0  # [rad] free each way: it swings
SWINGS = 0.5  # [rad] free each way at least: what swings hangs
ROOM = 0.3  # of its size, which a part that slides has room for at least
ALONG = 0.5  # cosine of an axis with the way out
TELLING = 0.3  # a handle nearer to the line's level than this tells nothing of it
TOLD = {  # what a part's name says of a hinge, a turn about a round outline, a slide
    Habit.HINGE: (1.5, -2.5, -2.0),
    Habit.BAIL: (1.5, -2.5, -2.0),
    Habit.SLIDE: (-2.0, -2.5, 2.0),
    Habit.PRESS: (-2.0, -2.5, 2.0),
    Habit.SPIN: (-1.5, 2.5, -2.0),
}


def score(part: PartFacts, c: Candidate, habit: Habit | None) -> float:
    """How plausible a candidate is, given what the part's name says of its habits."""
    told = TOLD.get(habit, (0.0, 0.0, 0.0)) if habit else (0.0, 0.0, 0.0)
    kind = 2 if c.motion.kind is MotionKind.SLIDE else 1 if c.role == "round" else 0
    return told[kind] + sum(WEIGHTS.get(name, 0.0) * value for name, value in evidence(part, c).items())


def evidence(part: PartFacts, c: Candidate) -> dict[str, float]:
    """Each piece of evidence by its name, most of them 0..1."""
    if c.motion.kind is MotionKind.SLIDE:
        return _slide(part, c)
    return _round(part, c) if c.role == "round" else _hinge(part, c)


def _hinge(part: PartFacts, c: Candidate) -> dict[str, float]:
    plate, up = part.thinness < PLATE, c.vertical**2
    free = min(c.opening, c.closing) > BOTH_WAYS
    edge, bail = c.role in ("edge", "edge_mid"), c.role == "bail"
    found = {
        "hinge": 1.0,
        f"hinge: {c.role}": 1.0,
        "hinge: support": c.support,
        "hinge: free side opposite": c.support * (1 - c.opposite),
        "hinge: opens": min(c.opening, np.pi / 2) / (np.pi / 2),
        "hinge: blocked": float(c.opening < BLOCKED),
        "hinge: both ways": float(free),
        "hinge: both ways about the middle": float(free and (bail or c.role == "center")),
        "hinge: along another part": c.sibling,
        "hinge: edge of a block": float(edge and not plate),
        "hinge: about the way out": float(abs(float(c.motion.axis @ part.outward)) > ALONG),
        "hinge: outwards": max(c.outward, -0.5),
        "hinge: buried": 0.0 if bail else min(part.buried, 1.0),
        "hinge: reach": _within(c.reach, -3.0, 3.0),
        "hinge: reach beyond its length": _within(c.reach - 1, 0.0, 3.0),
        "hinge: contact near": c.hugs,
        "hinge: contact near, free side": c.hugs * (1 - c.opposite),
        "hinge: contact kept": c.kept,
        "hinge: at the thick side": c.thick * plate,
        "hinge: stuck": float(np.log(c.slack)),
        "hinge: size": part.size,
        "hinge: round part": float(part.roundness > ROUND),
        "hinge: round lid": 0.0 if part.horizontal else part.lid * (part.roundness > ROUND),
        "hinge: round lid, upright": 0.0 if part.horizontal else up * (part.roundness > ROUND),
    }
    return found | _hand(part, c, up) | _habit(part, c, up)


def _hand(part: PartFacts, c: Candidate, up: float) -> dict[str, float]:
    """What the grip tells of a hinge."""
    small = part.size < SMALL and part.handle is None and c.role != "bail"
    return {
        "hinge: handle opposite": c.handle_side,
        "hinge: handle off the middle, upright": c.handle_off * up,
        "hinge: handle off the middle, level": c.handle_off * (1 - up),
        "hinge: handle in the middle": _central(part),
        "hinge: small, no handle": float(small),
    }


def _habit(part: PartFacts, c: Candidate, up: float) -> dict[str, float]:
    """Where hinges usually are: upright on tall leaves, at a leaf's outer side, opposite to where a pair meets."""
    if part.horizontal:
        return {"hinge: pair, level": c.pair * (1 - up), "hinge: outer, lying": c.outer}
    untold = part.handle is None or abs(c.handle_side) < TELLING
    return {
        "hinge: upright": up,
        "hinge: upright, tall": up * _within(part.tall, -1.5, 1.5),
        "hinge: above": (1 - up) * c.above,
        "hinge: above, high part": (1 - up) * c.above * (2 * part.height - 1),
        "hinge: above, no handle": untold * (1 - up) * c.above,
        "hinge: above, swings": (1 - up) * c.above * (min(c.opening, c.closing) > SWINGS),
        "hinge: pair": untold * c.pair * up,
        "hinge: pair, level": c.pair * (1 - up),
        "hinge: outer": untold * c.outer * up,
    }


def _round(part: PartFacts, c: Candidate) -> dict[str, float]:
    about = abs(float(c.motion.axis @ part.outward))
    lid = _within((part.lid - 0.3) / 0.3, 0.0, 1.0) * about
    flat, small = part.flatness < FLAT, part.size < SMALL
    return {
        "round": 1.0,
        "round: rounder": _within((part.roundness - ROUND) / (1 - ROUND), 0.0, 1.0),
        "round: not round": _within((ROUND - part.roundness) / 0.1, 0.0, 2.0),
        "round: free": min(c.opening, c.closing, 3.0) / 3,
        "round: flat": float(flat),
        "round: flat and seated": flat * part.seated * about,
        "round: small, flat": float(small and flat) * about,
        "round: small, flat and seated": float(small and flat) * part.seated * about,
        "round: high": _within(part.flatness - 1.5, 0.0, 2.0),
        "round: unmarked": _plain(part) * about,
        "round: unmarked, high": _plain(part) * about * (part.flatness > HIGH),
        "round: lid": 0.0 if part.horizontal else lid,
        "round: lid above": lid if part.horizontal else 0.0,
        "round: across the way out": 1 - about,
        "round: free rim": part.free_rim,
        "round: size": part.size,
        "round: contact near": c.hugs,
        "round: contact kept": c.kept,
        "round: buried": min(part.buried, 1.0),
        "round: seated": part.seated,
        "round: handle": float(part.handle is not None),
    }


def _slide(part: PartFacts, c: Candidate) -> dict[str, float]:
    way = abs(c.outward)
    found = {
        "slide": 1.0,
        f"slide: {'box' if c.role in ('slide', 'asked') else c.role}": 1.0,
        "slide: guided": c.guided,
        "slide: blocked": float(max(c.opening, c.closing) < LITTLE),
        "slide: stuck": float(np.log(c.slack)),
        "slide: room": _within(max(c.opening, c.closing) / max(part.size, 1e-9) / ROOM, 0.0, 1.0),
        "slide: size": part.size,
    }
    out, along = _within((way - 0.7) / 0.3, 0.0, 1.0), _within((0.5 - way) / 0.5, 0.0, 1.0)
    parts = [(name, out * value) for name, value in _out(part, c).items()]
    parts += [(name, along * value) for name, value in _along(part, c).items()]
    return found | dict(parts)


def _out(part: PartFacts, c: Candidate) -> dict[str, float]:
    """What speaks for a slide outwards: a drawer, a button."""
    small, plate, deep = part.size < SMALL, part.thinness < PLATE, min(c.depth, DEEP) / DEEP
    round_ = float(part.roundness > ROUND)
    return {
        "slide: out": 1.0,
        "slide: out, small": float(small),
        "slide: out, small plate": float(small and plate) * (1 - round_),
        "slide: out, small and round": small * part.roundness,
        "slide: out, small and seated": small * part.seated,
        "slide: out, deep": deep,
        "slide: out, deep and guided": deep * c.guided,
        "slide: out, deep block": deep * (not plate),
        "slide: out, block": float(not plate),
        "slide: out, buried": float(part.buried > LEVEL and part.size > CONTROL),
        "slide: out, round and high": round_ * _within(part.flatness - 1.5, 0.0, 2.0),
        "slide: out, unmarked": round_ * _plain(part),
        "slide: out, unmarked and high": round_ * _plain(part) * (part.flatness > HIGH),
        "slide: out, free inwards": _within(c.closing / max(part.size, 1e-9), 0.0, 1.0),
        "slide: out, round and buried": round_ * min(part.buried, 1.0),
        "slide: out, lying": float(part.horizontal),
        "slide: out, wide": _within(-part.tall, -1.5, 1.5),
        "slide: out, handle": float(part.handle is not None),
        "slide: out, handle in the middle": _central(part),
        "slide: out, contact kept": c.kept,
    }


def _along(part: PartFacts, c: Candidate) -> dict[str, float]:
    """What speaks for a slide along the surface: a sash, a sliding door, a lever in its slot."""
    captured = c.captured and c.guided > 0.4
    room = max(c.opening, c.closing) / max(part.size, 1e-9)
    return {
        "slide: along": 1.0,
        "slide: along, guided": float(c.guided > GUIDED),
        "slide: along, captured": float(captured),
        "slide: along, captured, small or level": float(captured and (part.size < CONTROL or c.vertical < 0.7)),
        "slide: along, passes another": c.passes * (c.guided > 0),
        "slide: along, contact kept": c.kept,
        "slide: along, room": _within(room, 0.0, 1.0),
        "slide: along, endless": _within(room - 1.5, 0.0, 1.0),
        "slide: along, upright": c.vertical,
        "slide: along, small": float(part.size < CONTROL),
    }


def _plain(part: PartFacts) -> float:
    """0..1: how much a round part looks the same after any turn."""
    return 1 - _within(part.marked / MARKED, 0.0, 1.0)


def _central(part: PartFacts) -> float:
    """0..1: how near the middle of the face the grip sits; in the middle it pulls, at the side it swings."""
    return 0.0 if part.handle is None else 1 - max(abs(a) for a in part.handle.across)


def _within(value: float, low: float, high: float) -> float:
    return float(min(max(value, low), high))
