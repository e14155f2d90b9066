"""Lifting surfaces: tapered, swept and raised, cut into a fixed part and control surfaces hinged along a slanted line."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from jaxtyping import Float
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, join, loft

AFT = np.array([0.0, 1.0, 0.0])


@dataclass(frozen=True, eq=False)
class Foil:
    """A surface between two leading edge points [m]; its sections are as thick as a share of their chord."""

    root: Float[np.ndarray, " 3"]
    tip: Float[np.ndarray, " 3"]
    chord: Span
    thick: float
    camber: float
    normal: Float[np.ndarray, " 3"]
    points: int = 6  # along each side of a section

    def mirrored(self) -> Foil:
        """The surface on the other side of x = 0."""
        flip = np.array([-1.0, 1, 1])
        return replace(self, root=self.root * flip, tip=self.tip * flip, normal=self.normal * flip)

    def at(self, s: float, c: np.ndarray | float, side: float) -> np.ndarray:
        """Points at share s of the span and shares c of the chord; side: 1 above, -1 below, 0 between."""
        c = np.asarray(c, float)[..., None]
        size = self.chord[0] + s * (self.chord[1] - self.chord[0])
        half = 5 * self.thick * (0.2969 * np.sqrt(c) - 0.126 * c - 0.3516 * c**2 + 0.2843 * c**3 - 0.1036 * c**4)
        height = side * half + 4 * self.camber * c * (1 - c)
        return self.root + s * (self.tip - self.root) + size * (c * AFT + height * self.normal)

    def section(self, s: float, c0: float, c1: float, nose: int) -> Float[np.ndarray, "n 3"]:
        """A closed outline from c0 to c1 of the chord; nose: points of a round nose at c0."""
        c = c0 + (c1 - c0) * (1 - np.cos(np.linspace(0, np.pi, self.points))) / 2
        upper, lower = self.at(s, c, 1.0), self.at(s, c, -1.0)
        outline = [upper, lower[::-1][1 if c1 == 1 else 0 :]]
        if c0 == 0:
            outline[1] = outline[1][:-1]
        elif nose:
            middle, half = (upper[0] + lower[0]) / 2, (upper[0] - lower[0]) / 2
            turn = np.linspace(-np.pi / 2, np.pi / 2, nose + 2)[1:-1, None]
            outline.append(middle + np.sin(turn) * half - np.cos(turn) * np.linalg.norm(half) * AFT)
        return np.concatenate(outline)

    def part(self, span: Span, c: Span, nose: int = 0, caps: bool = True) -> Trimesh:
        """The surface between two shares of the span and of the chord."""
        return loft(np.stack([self.section(s, c[0], c[1], nose) for s in span]), caps)


@dataclass(frozen=True)
class Control:
    """A control surface: where along the span, from which share of the chord, how far it turns down and up [deg]."""

    name: str
    span: Span
    cut: float
    down: float
    up: float


@dataclass(frozen=True)
class Making:
    """How one artist makes the surfaces of one aircraft."""

    nose: int  # points of a round nose; 0: flat
    line: float  # hinge at the upper (1) or lower (-1) edge or between (0)
    gap: float  # share of the chord
    caps: bool  # the surfaces have end caps
    whole: bool  # the fixed part is one solid


def making(m: Model) -> Making:
    nose = m.pick(0, 0, 3, 5)
    return Making(nose, 0.0 if nose else m.pick(0.0, 0.0, 1.0, -1.0), m.pick(0.0, 0.004, 0.012), m.chance(0.7), m.chance(0.5))


def fly(m: Model, foil: Foil, how: Making, controls: list[Control], suffix: str = "", fixed: str = BASE) -> None:
    """Adds a surface with its controls, each hinged along its own leading edge; positive turns it down."""
    cuts = sorted({0.0, 1.0, *(s for c in controls for s in c.span)})
    bays = []
    for span in pairwise(cuts):
        here = [c.cut for c in controls if c.span[0] <= span[0] and span[1] <= c.span[1]]
        bays.append(foil.part(span, (0.0, here[0] if here else 1.0)))
    m.add(fixed, *([join(*bays)] if how.whole else bays))
    for c in controls:
        slot = 0.3 * how.gap
        span = (c.span[0] + slot, c.span[1] - slot)
        radius = 0.5 * foil.thick if how.nose else 0.0
        start = c.cut + how.gap + radius * (1 - c.cut)
        m.add(c.name + suffix, foil.part(span, (start, 1.0), how.nose, how.caps))
        a, b = (foil.at(s, start, how.line) for s in span)
        down = float(np.cross(b - a, AFT) @ foil.normal) < 0
        m.hinge(c.name + suffix, a, (b - a) if down else (a - b), (-c.up, c.down), fixed)


def slanted(root: np.ndarray, half: float, sweep: float, rise: float, chord: Span, thick: float, camber: float) -> Foil:
    """A wing from its root leading edge: half span [m], sweep and dihedral [deg]."""
    tip = root + half * np.array([1.0, np.tan(np.deg2rad(sweep)), np.tan(np.deg2rad(rise))])
    normal = np.array([-np.sin(np.deg2rad(rise)), 0.0, np.cos(np.deg2rad(rise))])
    return Foil(root, tip, chord, thick, camber, normal)
