"""Small things with keys by another hand: pocket phone, remote handset."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Spot
from trimesh import Trimesh

from training.kinds.maker_fronts import button, screen
from training.kinds.maker_style import Maker, cuboid, laid, maker, pill, plate, soft, without
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, prism, rod, turned, vec

UP = (0, 0, 1)


def _slab(k: Maker, x: Span, y: Span, z: Span, share: float) -> list[Trimesh]:
    """A flat housing that lies: block, sheet, two shells with a seam and screws, or round-edged."""
    outline = pill(x, y, share)
    high = z[1] - z[0]
    if k.way == "cad":
        mid = z[0] + 0.5 * high
        shells = [prism(outline, "z", (z[0], mid - 0.0001)), prism(outline, "z", (mid + 0.0001, z[1]))]
        core = prism(pill((x[0] + 0.001, x[1] - 0.001), (y[0] + 0.001, y[1] - 0.001), share), "z", (mid - 0.0004, mid + 0.0004))
        inset = 0.3 * share * (x[1] - x[0]) / 2 + 0.004
        spots = [(u, w) for u in (x[0] + inset, x[1] - inset) for w in (y[0] + inset, y[1] - inset)]
        return [*shells, core, *(rod((u, w, z[0] - 0.0003), (u, w, z[0] + 0.001), 0.0016, 8) for u, w in spots)]
    if k.way == "soft":
        return [soft(x, y, z, min(0.48, k.edge + 0.15) * high, 2)]
    if k.way == "cut":
        groove = prism(outline.buffer(1).difference(outline.buffer(-0.0006)), "z", (z[0] + 0.45 * high, z[0] + 0.5 * high))
        return [cut(prism(outline, "z", z), groove)]
    if k.edge < 0.25:
        return [k.block(x, y, z)]
    solid = prism(outline, "z", z)
    return [without(solid, (0, 0, -1)) if k.way == "sheet" else solid]


def _keypad(k: Maker, x: Span, y: Span, z: float, grid: tuple[int, int], part: str = BASE, name: str = "key") -> None:
    """Keys in rows and columns on a face that looks up; where they are round, all are."""
    rows, columns = grid
    us, ws = (np.linspace(*s, n + 1) for s, n in ((x, columns), (y, rows)))
    fill, turn, high = k.m.number(0.32, 0.46), k.m.chance(0.25) and k.way != "sheet", k.m.number(0.0008, 0.002)
    half = (fill * (us[1] - us[0]), fill * (ws[1] - ws[0]))
    for j in range(rows):
        for i in range(columns):
            at = ((us[i] + us[i + 1]) / 2, (ws[j] + ws[j + 1]) / 2, z)
            button(k, f"{name}_{j * columns + i}", at, (min(half),) * 2 if turn else half, high, UP, part, turn)


def _cross(k: Maker, at: Span, z: float, r: float, part: str = BASE) -> None:
    """A ring for four directions and a key in it, or the key alone."""
    center = Spot(*at)
    if k.m.chance(0.7):
        ring = center.buffer(r, quad_segs=k.m.pick(2, 4, 8)).difference(center.buffer(0.5 * r))
        k.m.add("ring_key", plate(ring, "z", (z - 0.0003, z + 0.0016), k))
        k.m.slide("ring_key", (0, 0, -1), 0.001, part)
    button(k, "middle_key", (*at, z), (0.42 * r, 0.42 * r), 0.0014, UP, part, k.way != "sheet")


def _face(k: Maker, part: str, x: Span, y: Span, z: float) -> None:
    """A display on a face that looks up."""
    k.m.add(part, *laid([screen(k, x, y, -z + 0.0016)]))


def pocket_phone(m: Model) -> None:
    """A phone that lies: a bar with keys, a clam, a slider, or a flat one with a screen."""
    k = maker(m)
    design, half, share = m.pick("bar", "clam", "slider", "flat"), m.number(0.021, 0.028), m.number(0.15, 0.7)
    if design == "flat":
        _flat_phone(k, m.number(0.065, 0.08), m.number(0.006, 0.01))
        return
    long, thick = (
        (m.number(0.1, 0.15), m.number(0.01, 0.018)) if design == "bar" else (m.number(0.085, 0.1), m.number(0.007, 0.012))
    )
    m.add(BASE, *_slab(k, (-half, half), (0, long), (0, thick), share))
    _side_keys(k, half, long, thick)
    if design == "clam":
        _clam(k, half, long, thick, share)
    elif design == "slider":
        _slider(k, half, long, thick, share)
    else:
        _keypad(k, (-0.8 * half, 0.8 * half), (0.08 * long, 0.42 * long), thick, (m.pick(4, 4, 5), 3))
        _cross(k, (0, 0.5 * long), thick, 0.009)
        _face(k, BASE, (-0.75 * half, 0.75 * half), (0.6 * long, 0.88 * long), thick)
        if m.chance(0.5):
            x, r = 0.65 * half, 0.35 * thick
            m.add("antenna", rod((x, 0.7 * long, thick / 2), (x, long + 0.012, thick / 2), r, k.n))
            m.slide("antenna", (0, 1, 0), m.number(0.02, 0.05))


def _slider(k: Maker, half: float, long: float, thick: float, share: float) -> None:
    """A half with the screen that slides up from the keys on a rail."""
    low, top = thick + 0.002, thick + k.m.number(0.007, 0.011)
    _keypad(k, (-0.8 * half, 0.8 * half), (0.06 * long, 0.48 * long), thick, (4, 3))
    k.m.add("screen_half", *_slab(k, (-half, half), (0, long), (low, top), share))
    k.m.add("screen_half", box((-0.5 * half, 0.5 * half), (0.55 * long, 0.95 * long), (thick + 0.0001, low + 0.0005)))
    _face(k, "screen_half", (-0.8 * half, 0.8 * half), (0.35 * long, 0.93 * long), top)
    k.m.slide("screen_half", (0, 1, 0), 0.42 * long)
    _cross(k, (0, 0.16 * long), top, 0.009, "screen_half")


def _clam(k: Maker, half: float, long: float, thick: float, share: float) -> None:
    """A half with the screen that turns on a barrel at the top, shut or open."""
    m, low, top = k.m, thick + 0.002, thick + k.m.number(0.007, 0.011)
    _keypad(k, (-0.8 * half, 0.8 * half), (0.08 * long, 0.52 * long), thick, (4, 3))
    _cross(k, (0, 0.64 * long), thick, 0.0085)
    rest, y, z, x = m.pick(0, 0, 60, 110, 150), long + 0.002, thick + 0.001, 0.6 * half
    solids = _slab(k, (-half, half), (0, long), (low, top), share)
    solids.append(box((-0.8 * half, 0.8 * half), (0.15 * long, 0.8 * long), (low - 0.0006, low + 0.001)))
    solids += laid([screen(k, (-0.5 * half, 0.5 * half), (0.45 * long, 0.75 * long), 0.0016 - top)])
    solids += [rod((-x, y, z), (x, y, z), 0.004, k.n), box((-x, x), (long - 0.012, y), (low, low + 0.002))]
    for s in (-1, 1):
        m.add(BASE, rod((s * 1.03 * x, y, z), (s * half, y, z), 0.004, k.n))
        m.add(BASE, box((s * 1.03 * x, s * half), (long - 0.01, y), (thick - 0.003, thick)))
    m.add("flip_half", *(turned(s, (-1, 0, 0), rest, (0, y, z)) for s in solids))
    m.hinge("flip_half", (0, y, z), (-1, 0, 0), (-rest, 160 - rest))


def _side_keys(k: Maker, half: float, long: float, thick: float) -> None:
    """Keys on the long edges."""
    for i in range(k.m.pick(0, 1, 2, 3)):
        side = 1 if i < 2 else -1
        at = vec(side * half, (0.5 + 0.14 * i) * long, thick / 2)
        solid = cuboid(at + vec(side * 0.0003, 0, 0), (0.0009, 0.055 * long, 0.2 * thick))
        k.m.add(f"side_key_{i}", solid if k.way != "sheet" else without(solid, (-side, 0, 0)))
        k.m.slide(f"side_key_{i}", (-side, 0, 0), 0.0006)


def _flat_phone(k: Maker, wide: float, thick: float) -> None:
    """A screen in a frame, keys on its edges, perhaps a home key, a tray for the card, lenses behind."""
    half, long, rim = wide / 2, wide * k.m.number(1.9, 2.15), k.m.number(0.002, 0.005)
    k.m.add(BASE, *_slab(k, (-half, half), (0, long), (0, thick), k.m.number(0.15, 0.35)))
    home = k.m.chance(0.5)
    _face(k, BASE, (rim - half, half - rim), (rim + 0.013 * home, long - rim - 0.01 * home), thick)
    if home:
        button(k, "home_key", (0, rim + 0.006, thick), (0.0045, 0.0045), 0.0008, UP, turn=k.way != "sheet")
    if k.m.chance(0.7):
        k.m.add(BASE, k.block((0.2 * half, 0.85 * half), (0.82 * long, 0.95 * long), (-0.0015, 0.0005), UP))
        spots = [(0.4 * half, 0.91 * long), (0.4 * half, 0.855 * long), (0.68 * half, 0.88 * long)]
        k.m.add(BASE, *(rod((x, y, -0.0022), (x, y, -0.001), 0.0045, k.n) for x, y in spots[: k.m.pick(1, 2, 3)]))
    if k.m.chance(0.4):
        k.m.add("card_tray", cuboid((-half + 0.006, 0.6 * long, thick / 2), (0.0063, 0.008, 0.2 * thick)))
        k.m.slide("card_tray", (-1, 0, 0), 0.012)
    count = k.m.pick(1, 2, 3)
    for i in range(count):
        at = vec(half, (0.6 + 0.12 * i) * long, thick / 2)
        k.m.add(f"side_key_{i}", cuboid(at + vec(0.0002, 0, 0), (0.0009, 0.035 * long, 0.18 * thick)))
        k.m.slide(f"side_key_{i}", (-1, 0, 0), 0.0006)


def remote_handset(m: Model) -> None:
    """A handset for a television: keys in grids, a ring, tall rockers; a cover that slides over keys or the batteries."""
    k = maker(m)
    wide, long, thick = m.number(0.034, 0.06), m.number(0.13, 0.23), m.number(0.012, 0.025)
    half = wide / 2
    m.add(BASE, *_slab(k, (-half, half), (0, long), (0, thick), m.number(0.1, 0.95)))
    if k.way == "old":
        m.add(BASE, *(box((s * half, s * (half + 0.003)), (0.01, long - 0.01), (0.002, thick + 0.001)) for s in (-1, 1)))
    turn = m.chance(0.5) and k.way != "sheet"
    button(k, "power_key", (m.pick(-0.6, 0.6, 0) * half, 0.93 * long, thick), (0.004, 0.004), 0.002, UP, turn=turn)
    layout = [
        ("grid", "cross", "rockers"),
        ("cross", "rockers", "grid"),
        ("rockers", "cross"),
        ("grid", "cross"),
        ("grid", "grid2"),
    ]
    spots = m.pick(*layout)
    edges = np.linspace(0.1, 0.86, len(spots) + 1) * long
    for what, a, b in zip(spots, edges[:-1], edges[1:], strict=True):
        if what.startswith("grid"):
            rows = m.pick(3, 4, 5) if b - a > 0.05 else m.pick(2, 3)
            _keypad(k, (-0.82 * half, 0.82 * half), (a + 0.003, b - 0.003), thick, (rows, m.pick(3, 3, 4)), name=f"{what}_key")
        elif what == "cross":
            _cross(k, (0, (a + b) / 2), thick, min(0.8 * half, 0.42 * (b - a)))
        else:
            for i, x in enumerate((-0.5, 0.5) if m.chance(0.7) else (0.0,)):
                button(k, f"rocker_{i}", (x * half, (a + b) / 2, thick), (0.24 * half, 0.36 * (b - a)), 0.003, UP)
    if m.chance(0.5):
        m.add(BASE, box((-0.5 * half, 0.5 * half), (long - 0.001, long + 0.0015), (0.3 * thick, 0.7 * thick)))
    if m.chance(0.5) and k.way != "sheet":
        m.add("battery_cover", box((-0.7 * half, 0.7 * half), (0.08 * long, 0.45 * long), (-0.0012, -0.0001)))
        m.add(
            "battery_cover",
            *(box((-0.3 * half, 0.3 * half), (y, y + 0.001), (-0.0018, -0.001)) for y in (0.1 * long, 0.12 * long)),
        )
        m.slide("battery_cover", (0, -1, 0), m.number(0.15, 0.35) * long)
