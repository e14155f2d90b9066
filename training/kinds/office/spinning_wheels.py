"""Spinning wheels."""

from __future__ import annotations

import numpy as np

from training.kinds.electronics.controls import knob
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, rod, vec
from training.kinds.wheels import beam, lathe, upright

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def spinning_wheel(m: Model) -> None:
    """A wheel with spokes driven by a treadle; a flyer with a bobbin; on a leaning bench, a frame or a board."""
    style, n = m.pick("bench", "tower", "board"), m.pick(24, 32)
    r, w = (m.number(0.22, 0.3), m.number(0.035, 0.05)) if style != "tower" else (m.number(0.2, 0.25), 0.04)
    c = vec(0, 0, r + m.number(0.22, 0.35))
    post = 0.06
    c, flyer = _bench(m, r, post) if style == "bench" else _frame(m, style, c, r, post)
    foot = 0.12 if style == "bench" else 0.1
    m.add(
        BASE,
        *(
            box((flyer[0] - 0.012, flyer[0] + 0.012), (b - 0.008, b + 0.008), (flyer[2] - 0.075, flyer[2] + 0.03))
            for b in (-0.125, 0.125)
        ),
    )
    _drive_wheel(m, c, r, w, n, post)
    _flyer(m, flyer, n)
    _treadle(m, c, foot, style, post)
    if m.chance(0.35):
        p = vec(flyer[0] + 0.1, 0.1, flyer[2] - 0.1)
        m.add(
            BASE,
            rod((flyer[0], 0.1, p[2]), p, 0.006, 8),
            rod(p - vec(0, 0, 0.02), p + vec(0, 0, 0.3), 0.008, 8),
            ball(p + vec(0, 0, 0.3), (0.035, 0.035, 0.06), 10),
        )


def _bench(m: Model, r: float, post: float) -> tuple[np.ndarray, np.ndarray]:
    """A leaning bench on three legs; returns the centers of the wheel and the flyer."""
    rise = m.number(0.0, 0.12)
    a, b = vec(-0.28, 0, 0.36 - rise / 2), vec(0.5, 0, 0.36 + rise / 2)
    c = vec(-0.08, 0, 0.4 + r + 0.05)
    m.add(BASE, beam(a, b, 0.16, 0.035, Y))
    for p, f in ((a + 0.1 * (b - a), (-0.38, 0)), (a + 0.85 * (b - a), (0.52, -0.2)), (a + 0.85 * (b - a), (0.52, 0.2))):
        m.add(BASE, rod(p, (f[0], f[1], 0), m.number(0.014, 0.02), 10))
    for s in (-1, 1):
        m.add(
            BASE,
            rod((c[0], s * post, 0.34), (c[0], s * post, c[2] + 0.05), 0.017, 10),
            ball((c[0], s * post, c[2] + 0.06), (0.022,) * 3, 10),
        )
    flyer = vec(0.4, 0, c[2] + m.number(-0.05, 0.05))
    m.add(
        BASE,
        rod((0.4, 0, 0.38), (0.4, 0, flyer[2] - 0.08), 0.016, 10),
        beam((0.4, -0.13, flyer[2] - 0.08), (0.4, 0.13, flyer[2] - 0.08), 0.035, 0.03),
    )
    if m.chance(0.6):
        knob(m, "tension", (0.5, 0.0, 0.36 + rise / 2), X, 0.022)
    return c, flyer


def _frame(m: Model, style: str, c: np.ndarray, r: float, post: float) -> tuple[np.ndarray, np.ndarray]:
    """Two frames of leaning posts with the flyer above the wheel; returns the centers of both."""
    for s in (-1, 1):
        m.add(
            BASE,
            *(
                beam(
                    (t * (0.24 if style == "board" else 0.2), s * post, 0.03),
                    (t * 0.03, s * post, c[2] + 0.04),
                    0.04,
                    0.022,
                    Y,
                )
                for t in (-1, 1)
            ),
        )
        m.add(BASE, box((-0.3, 0.3), (s * post - 0.02, s * post + 0.02), (0, 0.035)))
    m.add(BASE, *(box((t - 0.02, t + 0.02), (-post, post), (0.002, 0.033)) for t in (-0.25, 0.25)))
    flyer = vec(0, 0, c[2] + r + 0.13) if style == "tower" else vec(0.12, 0, c[2] + r + 0.09)
    m.add(BASE, *(beam((0.02, s * post, c[2] + 0.02), (flyer[0], s * post, flyer[2] - 0.06), 0.03, 0.022, Y) for s in (-1, 1)))
    m.add(BASE, box((flyer[0] - 0.02, flyer[0] + 0.02), (-0.14, 0.14), (flyer[2] - 0.085, flyer[2] - 0.06)))
    return c, flyer


def _drive_wheel(m: Model, c: np.ndarray, r: float, w: float, n: int, post: float) -> None:
    """The large wheel: a rim, a hub on an axle with a crank, turned spokes or a disc with holes."""
    rim = [(0.86 * r, -w / 2), (r, -w / 2), (0.97 * r, 0), (r, w / 2), (0.86 * r, w / 2), (0.86 * r, -w / 2)]
    count, thick, bulge = m.pick(6, 8, 10, 12, 16), m.number(0.006, 0.01), m.chance(0.6)
    solids = [lathe(rim, n), rod((0, 0, -0.035), (0, 0, 0.035), 0.035, 16)]
    for t in np.linspace(0, 2 * np.pi, count, endpoint=False):
        d = vec(np.cos(t), np.sin(t), 0)
        solids.append(rod(0.03 * d, 0.88 * r * d, thick, 8))
        if bulge:
            solids.append(rod(0.35 * r * d, 0.6 * r * d, 1.6 * thick, 8))
    m.add("wheel", *upright(solids, (0, -1, 0), c), rod(c - vec(0, post + 0.03, 0), c + vec(0, post + 0.03, 0), 0.007, 8))
    m.add(
        "wheel",
        beam(c + vec(0, post + 0.028, 0), c + vec(0, post + 0.028, -0.05), 0.014, 0.008, X),
        rod(c + vec(0, post + 0.024, -0.05), c + vec(0, post + 0.045, -0.05), 0.006, 8),
    )
    m.spin("wheel", c, (0, -1, 0))


def _flyer(m: Model, at: np.ndarray, n: int) -> None:
    """The U with hooks that turns on a spindle, with the bobbin and the whorl."""
    long, half = 0.11, 0.055
    m.add("flyer", rod(at - vec(0, 0.14, 0), at + vec(0, 0.14, 0), 0.005, 8))
    y = at[1] - 0.1
    m.add(
        "flyer",
        *(
            box((at[0] + s * half - 0.006, at[0] + s * half + 0.006), (y, y + 0.16), (at[2] - 0.004, at[2] + 0.004))
            for s in (-1, 1)
        ),
    )
    m.add("flyer", box((at[0] - half - 0.006, at[0] + half + 0.006), (y - 0.008, y + 0.006), (at[2] - 0.007, at[2] + 0.007)))
    for s, b in ((s, b) for s in (-1, 1) for b in np.linspace(y + 0.03, y + 0.14, 5)):
        m.add("flyer", rod((at[0] + s * half, b, at[2]), (at[0] + s * half, b, at[2] + 0.014), 0.0015, 5))
    m.add("flyer", rod(at + vec(0, 0.085, 0), at + vec(0, 0.1, 0), 0.035, n))
    m.spin("flyer", at, Y)
    fill = m.number(0.012, 0.035)
    line = [
        (0.006, 0),
        (0.036, 0),
        (0.036, 0.008),
        (fill, 0.01),
        (fill, long),
        (0.036, long + 0.002),
        (0.036, long + 0.01),
        (0.006, long + 0.01),
        (0.006, 0),
    ]
    m.add("bobbin", *upright([lathe(line, n)], Y, at + vec(0, -0.085 + 0.04, 0)))
    m.spin("bobbin", at, Y, "flyer")


def _treadle(m: Model, c: np.ndarray, foot: float, style: str, post: float) -> None:
    """One or two boards for the feet on an axle near the floor."""
    a, z = c[0], foot - 0.02
    rear = post + 0.06 if style == "bench" else post - 0.02
    two = style != "bench" and m.chance(0.5)
    if style == "bench":
        m.add(BASE, rod((a - 0.22, rear, z), (a + 0.3, rear, z), 0.01, 8))
        m.add(BASE, *(rod((a + t, rear, z), (a + t * 0.9, 0.05, 0.35), 0.008, 8) for t in (-0.2, 0.28)))
    else:
        z = 0.06
        m.add(BASE, box((-0.3, 0.3), (post - 0.02, post + 0.02), (0.03, 0.045)))
        m.add(BASE, *(box((t - 0.012, t + 0.012), (rear - 0.015, rear + 0.015), (0.03, z + 0.015)) for t in (-0.2, 0.2)))
        m.add(BASE, rod((-0.2, rear, z), (0.2, rear, z), 0.006, 8))
    for k, span in enumerate(((-0.13, -0.005), (0.005, 0.13)) if two else ((-0.09, 0.09),)):
        x = (a + span[0], a + span[1])
        m.add(
            f"treadle_{k}",
            box(x, (-0.3, rear), (z + 0.006, z + 0.02)),
            box(shrunk(x, 0.03), (rear - 0.03, rear + 0.01), (z - 0.008, z + 0.008)),
        )
        m.hinge(f"treadle_{k}", (x[0], rear, z), X, (-m.number(4, 6), m.number(6, 10)) if style == "bench" else 8)
        if not two and m.chance(0.6):
            m.add(BASE, rod((a, post + 0.04, z + 0.03), (a, post + 0.04, c[2] - 0.06), 0.006, 8))
