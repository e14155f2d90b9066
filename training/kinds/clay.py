"""Round, faceted or blocky lumps and limbs on the way to a figure, and curves and skins for them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import trimesh
from jaxtyping import Float
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, ball, join, loft, mirrored, moved, rod, turned, vec


def curve(a: Point, b: Point, c: Point, count: int = 6) -> Float[np.ndarray, "k 3"]:
    """Points on a bow from a towards b to c."""
    t = np.linspace(0, 1, count)[:, None]
    return (1 - t) ** 2 * np.asarray(a, float) + 2 * t * (1 - t) * np.asarray(b, float) + t**2 * np.asarray(c, float)


def skin(path: Sequence[Point] | Float[np.ndarray, "k 3"], radii: Sequence, n: int = 10, blunt: bool = False) -> Trimesh:
    """A tapered limb along a path; radii: one a point, or (across, up); blunt: its ends are flat."""
    p = np.asarray(path, float)
    r = np.broadcast_to(np.asarray(radii, float).reshape(len(p), -1), (len(p), 2))
    along = np.gradient(p, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    if not blunt:
        k, out, shrink = [0, 0, -1, -1], [-0.8, -0.55, 0.55, 0.8], np.array([[0.35], [0.75], [0.75], [0.35]])
        caps = p[k] + np.array(out)[:, None] * r[k].mean(1, keepdims=True) * along[k]
        p, r = np.concatenate([caps[:2], p, caps[2:]]), np.concatenate([(shrink * r[k])[:2], r, (shrink * r[k])[2:]])
        along = along[[0, 0, *range(len(along)), -1, -1]]
    side = np.cross(along[0], (0, 1, 0) if abs(along[0, 2]) > 0.8 else (0, 0, 1))
    t, rings = 2 * np.pi * (np.arange(n) + 0.5) / n, []
    for q, w, a in zip(p, r * (1.4 if n == 4 else 1.0), along, strict=True):
        side = side - (side @ a) * a
        side /= np.linalg.norm(side)
        rings.append(q + w[0] * np.outer(np.cos(t), side) + w[1] * np.outer(np.sin(t), np.cross(side, a)))
    return loft(np.array(rings))


@dataclass
class Clay:
    """Lumps and limbs that are round, faceted or blocks; both: and mirrored; share: how often it is there."""

    m: Model
    form: str
    n: int

    def put(self, solid: Trimesh, both: bool = False, share: float = 1.0) -> None:
        """Add a solid, perhaps with its mirror image."""
        if self.m.chance(share):
            self.m.add(BASE, solid, *([mirrored(solid)] if both else []))

    def lump(
        self, at: Point, radii: Point, both: bool = False, axis: Point = (0, 0, 1), by: float = 0, share: float = 1.0
    ) -> None:
        r = np.asarray(radii, float)
        solid = ball((0, 0, 0), r, self.n if r.mean() > 0.12 else min(self.n, 8))
        if self.form != "round":
            blocks = self.form == "blocks"
            solid = (trimesh.creation.box((1.8,) * 3) if blocks else trimesh.creation.icosphere(1)).apply_scale(r)
        self.put(moved(turned(solid, axis, by, (0, 0, 0)), at), both, share)

    def limb(self, path: Sequence[Point], radii: Sequence, both: bool = False) -> None:
        """Add a tapered limb along a path."""
        n = {"blocks": 4, "facets": 5}.get(self.form, min(self.n, 12))
        self.put(skin(path, radii, n, self.form == "blocks"), both)

    def jointed(self, path: Sequence[Point], radii: Sequence, whole: bool, both: bool = False) -> None:
        """A limb of two pieces that meet at the middle point, or of one."""
        for a, b in ((0, 3),) if whole else ((0, 2), (1, 3)):
            self.limb(path[a:b], radii[a:b], both)

    def eyes(self, at: Point, r: float) -> None:
        """Two eyes, beads or balls with pupils."""
        self.lump(at, (r, r, r), True)
        if self.m.chance(0.5):
            self.lump(at + r * vec(0.3, -0.7, 0), (0.6 * r,) * 3, True)

    def done(self, size: float, plinth: float = 0.3, fuse: int = 0) -> None:
        """Fuse the first pieces into one, perhaps add a plinth, scale all and set it on the ground."""
        m, solids = self.m, [s for _, s in self.m.pieces]
        if fuse and m.chance(0.25) and all(s.is_watertight for s in solids[:fuse]):
            solids = [join(*solids[:fuse]), *solids[fuse:]]
        low, high = np.min([s.bounds[0] for s in solids], axis=0), np.max([s.bounds[1] for s in solids], axis=0)
        if m.chance(plinth):
            a, b, _ = 0.5 * m.number(0.7, 1.1) * (high - low)
            x, y, z = (*(low + high)[:2] / 2, low[2] + m.pick(0.0, 0.01))
            for k in range(m.pick(1, 1, 2)):
                slab = rod((0, 0, -0.05 - 0.05 * k), (0, 0, -0.05 * k), 1.0, m.pick(4, 6, 16, 32))
                solids.append(moved(slab.apply_scale([(1 + 0.15 * k) * a, (1 + 0.15 * k) * b, m.number(0.6, 2)]), (x, y, z)))
        low = min(s.bounds[0, 2] for s in solids)
        m.pieces = [(BASE, moved(s, (0, 0, -low)).apply_scale(size)) for s in solids]


def clay(m: Model) -> Clay:
    """Clay in a style that is drawn by chance."""
    return Clay(m, m.pick("round", "round", "round", "facets", "blocks"), m.pick(8, 12, 16))
