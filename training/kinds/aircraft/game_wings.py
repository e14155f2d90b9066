"""Hulls and wings of aircraft by another hand; control surfaces are cut from the wings."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.game_style import Look, carve, oval, skin
from training.kinds.model import BASE
from training.kinds.solids import Span, loft

FOIL = np.array([(0, 0), (0.08, 0.05), (0.3, 0.08), (0.65, 0.05), (1, 0.006), (1, -0.006), (0.5, -0.03), (0.1, -0.035)])
BOARD = np.array([(0, 0), (0.06, 0.03), (0.7, 0.03), (1, 0.006), (1, -0.006), (0.7, -0.03), (0.06, -0.03)])
Station = tuple[float, float, float, float]


def hull(a: Look, stations: Sequence[Station], power: float, n: int) -> Trimesh:
    """A fuselage over (y, half width, half height, middle height)."""
    flat = np.array(oval((1, 1), n, power).exterior.coords[:-1])
    rows = [np.c_[w * flat[:, 0], np.full(n, y), z + h * flat[:, 1]] for y, w, h, z in stations]
    return loft(np.array(rows))


class Wing:
    """A tapered surface from a root to a tip that gives up control surfaces; its side view is a foil."""

    def __init__(self, a: Look, root: np.ndarray, tip: np.ndarray, chords: Span, upright: bool = False) -> None:
        self.a, self.root, self.tip, self.chords, self.upright = a, root, tip, chords, upright
        foil = BOARD if upright or a.way in ("low", "sheet") else FOIL
        rows = []
        for at, chord in ((root, chords[0]), (tip, chords[1])):
            flat = chord * foil
            side = [flat[:, 1], flat[:, 0], 0 * flat[:, 0]] if upright else [0 * flat[:, 0], flat[:, 0], flat[:, 1]]
            rows.append(at + np.stack(side, axis=1))
        self.whole = self.rest = loft(np.array(rows))

    def at(self, span: float, chord: float) -> np.ndarray:
        """The point at a share of the span and of the chord there."""
        wide = self.chords[0] + span * (self.chords[1] - self.chords[0])
        return self.root + span * (self.tip - self.root) + [0, chord * wide, 0]

    def flap(self, part: str, span: Span, chord: float, degrees: tuple[float, float], gap: float) -> None:
        """Cuts a surface out of the trailing edge and hangs it at its front; positive turns down or left."""
        p, q = self.at(span[0], chord), self.at(span[1], chord)
        i, axis = (2, "x") if self.upright else (0, "z")
        p2, q2 = [(v[1], v[2]) if self.upright else (v[0], v[1]) for v in (p, q)]
        far = 50.0
        ends = [(far, q2[1]), (far, p2[1])] if self.upright else [(q2[0], far), (p2[0], far)]
        piece, self.rest = carve(self.rest, Polygon([p2, q2, *ends]), axis, (-60, 60), gap)
        self.a.put(part, skin(piece, self.whole) if self.a.way == "sheet" else piece)
        d = q - p
        self.a.m.hinge(part, (p + q) / 2, d if self.upright else -d * np.sign(d[i]), degrees)

    def finish(self) -> None:
        self.a.put(BASE, skin(self.rest, self.whole) if self.a.way == "sheet" else self.rest)
