"""A control console and a wall lever of one artist, with controls that stand on a plane in space."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.arena_style import Look, lathe, look
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, ball, box, cut, prism, rectangle, ring, rod, rounded, vec


@dataclass
class Plane:
    """A plane with its x across, its y up and its z out of it; what stands on it is built in these coordinates."""

    m: Model
    k: Look
    origin: np.ndarray
    slope: float
    yaw: float = 0.0
    used: dict[str, int] = field(default_factory=dict)

    def turn(self) -> np.ndarray:
        a, b = np.deg2rad([self.slope, self.yaw])
        lean = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
        return np.array([[np.cos(b), -np.sin(b), 0], [np.sin(b), np.cos(b), 0], [0, 0, 1]]) @ lean

    def at(self, x: float, y: float, z: float) -> np.ndarray:
        return self.origin + self.turn() @ vec(x, y, z)

    def put(self, part: str, *solids: Trimesh) -> None:
        for solid in solids:
            solid.vertices = self.origin + solid.vertices @ self.turn().T
            self.m.add(part, solid)

    def hinge(self, part: str, at: Point, axis: Point, degrees: float | tuple[float, float], parent: str = BASE) -> None:
        self.m.hinge(part, self.at(*at), self.turn() @ np.asarray(axis, float), degrees, parent)

    def slide(self, part: str, axis: Point, travel: float | tuple[float, float]) -> None:
        self.m.slide(part, self.turn() @ np.asarray(axis, float), travel)

    def name(self, what: str) -> str:
        self.used[what] = self.used.get(what, -1) + 1
        return f"{what}_{self.used[what]}"


def control_console(m: Model) -> None:
    """A desk, a post, an upright cabinet or a desk of three facets with levers, buttons, dials, sticks and screens."""
    k, style = look(m), m.pick("desk", "post", "cabinet", "facets")
    w, d, h = m.number(0.3, 0.7), m.number(0.3, 0.5), m.pick(m.number(0.7, 0.95), m.number(0.7, 0.95), m.number(0.18, 0.3))
    slope = m.pick(8, 15, 25, 35)
    a = np.deg2rad(slope)
    used: dict[str, int] = {}
    if style == "post":
        w, d = m.number(0.2, 0.3), m.number(0.25, 0.36)
        m.add(BASE, *k.limb((0, d / 2, 0), (0, d / 2, h + 0.3 * d * np.sin(a)), 0.5 * w, 0.4 * d))
        m.add(BASE, *k.body((-0.8 * w, 0.8 * w), (0, d), (0, 0.04)))
        m.add(BASE, prism([(0, h - 0.06), (0, h), (d * np.cos(a), h + d * np.sin(a)), (d * np.cos(a), h - 0.04)], "x", (-w, w)))
    else:
        deep = d * np.cos(a)
        profile = [
            (0, h - 0.1),
            (0, h),
            (deep, h + d * np.sin(a)),
            (deep + 0.05, h + d * np.sin(a)),
            (deep + 0.05, 0),
            (0.1, 0),
        ]
        if h > 0.5 and m.chance(0.7):
            _front(m, k, w, h)
        profile += m.pick([(0.1, h - 0.15)], [(0.02, 0.06)], [(0.3 * deep, 0.3 * h)])
        m.add(BASE, prism(profile, "x", (-w, w)))
        if k.style in ("cad", "cut", "old"):
            m.add(
                BASE,
                *(prism(Polygon(profile).buffer(0.012, join_style="mitre"), "x", (s * w, s * (w + 0.025))) for s in (-1, 1)),
            )
    _field(m, Plane(m, k, vec(0, 0, h), slope, 0, used), w, d)
    if style == "cabinet":
        top = h + d * np.sin(a)
        y = d * np.cos(a)
        rise = m.number(0.35, 0.7)
        m.add(BASE, *k.body((-w, w), (y, y + 0.25), (top - 0.02, top + rise), "-z"))
        m.add(BASE, box((-0.9 * w, 0.9 * w), (y - 0.012, y + 0.02), (top + 0.15 * rise, top + 0.9 * rise)))
    if style == "facets":
        for s in (-1, 1):
            yaw = -s * m.pick(20, 35, 45)
            side = Plane(m, k, vec(s * w, 0, h), slope, yaw, used)
            wide = 0.35
            side.put(
                BASE,
                box((0, s * 2 * wide), (0, d), (-0.08, 0)),
                box((s * wide, s * (wide + 0.05)), (0.3 * d, 0.7 * d), (-0.9 * h, -0.05)),
            )
            side.origin = side.at(s * wide, 0, 0)
            _field(m, side, wide, d)


def _front(m: Model, k: Look, w: float, h: float) -> None:
    """Under the desk a kick plate, panels that look like doors, or slots."""
    count = m.pick(1, 2, 3)
    for i in range(count):
        x = (-w + 0.03 + 2 * (w - 0.03) * i / count, -w + 2 * (w - 0.03) * (i + 1) / count)
        m.add(BASE, *k.plate(x, (0.085, 0.4), (0.1, h - 0.2), "-y"))


def _field(m: Model, p: Plane, w: float, d: float) -> None:
    """Cells of a plane, each with another sort of control."""
    cols, rows = max(2, round(2 * w / m.number(0.16, 0.26))), m.pick(2, 3)
    cx, cy = 1.86 * w / cols, 0.9 * d / rows
    makers = (_buttons, _dials, _lever, _toggles, _slider, _screen, _stick, _guarded, _screen, _lamps)
    liked = [makers[i] for i in m.rng.permutation(len(makers))[: m.pick(3, 4, 6)]]
    for i in range(cols):
        for j in range(rows):
            if m.chance(0.15):
                continue
            x, y = -0.93 * w + (i + 0.5) * cx, 0.05 * d + (j + 0.5) * cy
            m.pick(*liked)(m, p, x, y, 0.42 * min(cx, 1.6 * cy), 0.42 * cy)


def _buttons(m: Model, p: Plane, x: float, y: float, a: float, b: float) -> None:
    """A field of keys that are pressed into the plane."""
    nx, ny = m.pick((1, 1), (2, 1), (2, 2), (3, 2))
    r, high = 0.38 * min(2 * a / nx, 2 * b / ny), m.number(0.006, 0.016)
    round_ = m.chance(0.5)
    for i in range(nx):
        for j in range(ny):
            u, v = x + a * (2 * i + 1 - nx) / nx, y + b * (2 * j + 1 - ny) / ny
            name = p.name("button")
            p.put(
                name,
                rod((u, v, -0.002), (u, v, high), r, p.k.n + 4)
                if round_
                else prism(rounded((u - r, u + r), (v - r, v + r), 0.2 * r), "z", (-0.002, high)),
            )
            p.slide(name, (0, 0, -1), 0.7 * high)
            if round_ and nx * ny == 1:
                p.put(BASE, ring((u, v, 0), (0, 0, 1), 1.25 * r, 0.15 * r, 16))


def _dials(m: Model, p: Plane, x: float, y: float, a: float, b: float) -> None:
    """A knob or two with a pointer."""
    count = m.pick(1, 1, 2)
    r = 0.7 * min(a / count, b)
    for i in range(count):
        u = x + a * (2 * i + 1 - count) / count
        name, high = p.name("dial"), m.number(0.015, 0.03)
        p.put(name, rod((u, y, 0), (u, y, high), r, max(8, p.k.n)))
        p.put(name, box((u - 0.12 * r, u + 0.12 * r), (y, y + 1.0 * r), (high - 0.002, high + 0.004)))
        if m.chance(0.4):
            p.put(BASE, rod((u, y, 0), (u, y, 0.003), 1.2 * r, 16))
        p.hinge(name, (u, y, 0), (0, 0, -1), m.pick((-135, 135), (-60, 60), (0, 270)))


def _lever(m: Model, p: Plane, x: float, y: float, a: float, b: float) -> None:
    """One to three throttle levers in slots of a low housing."""
    count = m.pick(1, 1, 2, 3)
    long, lean = m.number(0.08, 0.16), m.pick(0, -25, 20)
    p.put(BASE, box((x - a, x + a), (y - 0.8 * b, y + 0.8 * b), (0, 0.008)))
    for i in range(count):
        u, name = x + a * (2 * i + 1 - count) / count, p.name("lever")
        t = np.deg2rad(lean)
        end = vec(u, y + long * np.sin(t), long * np.cos(t))
        p.put(name, *p.k.limb((u, y, -0.004), end, 0.012, 0.016))
        knob = m.pick("ball", "bar", "none")
        if knob == "ball":
            p.put(name, ball(end, (0.018,) * 3, max(8, p.k.n)))
        elif knob == "bar":
            p.put(name, rod(end - vec(0.7 * a / count, 0, 0), end + vec(0.7 * a / count, 0, 0), 0.01, p.k.n))
        p.hinge(
            name,
            (u, y, 0.0),
            (-1, 0, 0),
            (-35 - lean if lean < 0 else -35, 35) if not lean else (0, 50) if lean < 0 else (-50, 0),
        )
        p.put(BASE, box((u - 0.014, u - 0.009), (y - 0.5 * b, y + 0.5 * b), (0.006, 0.02)))


def _toggles(m: Model, p: Plane, x: float, y: float, a: float, b: float) -> None:
    """Toggle switches in a row that lean to one side."""
    count = m.pick(2, 3, 4)
    for i in range(count):
        u, name = x + 0.9 * a * (2 * i + 1 - count) / count, p.name("switch")
        p.put(BASE, rod((u, y, 0), (u, y, 0.006), 0.008, p.k.n))
        p.put(name, rod((u, y, 0.002), (u, y - 0.012, 0.034), 0.004, p.k.n))
        p.hinge(name, (u, y, 0.004), (-1, 0, 0), m.pick(40, 50))


def _slider(m: Model, p: Plane, x: float, y: float, a: float, b: float) -> None:
    """Faders in slots."""
    count = m.pick(1, 2, 3)
    for i in range(count):
        u, name, v = x + a * (2 * i + 1 - count) / count, p.name("slider"), m.pick(-0.6, 0.0, -0.3) * b
        p.put(BASE, box((u - 0.006, u + 0.006), (y - b, y + b), (0, 0.003)))
        p.put(name, box((u - 0.011, u + 0.011), (y + v - 0.008, y + v + 0.008), (0.002, 0.018)))
        p.slide(name, (0, 1, 0), (-0.85 * b - v, 0.85 * b - v))


def _screen(m: Model, p: Plane, x: float, y: float, a: float, b: float) -> None:
    """A screen that stays."""
    frame = rectangle((x - a, x + a), (y - 0.9 * b, y + 0.9 * b), 0.1 * b)
    p.put(
        BASE,
        prism(frame, "z", (-0.001, 0.01)),
        box((x - 0.95 * a, x + 0.95 * a), (y - 0.85 * b, y + 0.85 * b), (-0.001, 0.004)),
    )


def _lamps(m: Model, p: Plane, x: float, y: float, a: float, b: float) -> None:
    """Lamps that look like buttons but stay: a row of domes."""
    for i in range(m.pick(3, 4)):
        p.put(BASE, ball((x - 0.75 * a + 0.4 * a * i, y, 0), (0.1 * a, 0.1 * a, 0.008), 8))


def _stick(m: Model, p: Plane, x: float, y: float, a: float, b: float) -> None:
    """A joystick on a boot."""
    name, r, high = p.name("joystick"), 0.7 * min(a, b), m.number(0.09, 0.15)
    boot = lathe([(0, 0), (r, 0), (0.8 * r, 0.01), (0.3 * r, 0.03), (0, 0.03)], p.k.n)
    boot.apply_translation((x, y, 0))
    p.put(BASE, boot)
    p.put(name, rod((x, y, 0.02), (x, y, high), 0.009, p.k.n), *p.k.limb((x, y, 0.5 * high), (x, y, high), 0.026, 0.03))
    p.hinge(name, (x, y, 0.02), m.pick((-1, 0, 0), (0, 1, 0)), (-25, 25))


def _guarded(m: Model, p: Plane, x: float, y: float, a: float, b: float) -> None:
    """A button under a cover that folds up."""
    r = 0.5 * min(a, b)
    name, cover = p.name("button"), p.name("cover")
    p.put(name, rod((x, y, -0.002), (x, y, 0.014), 0.6 * r, p.k.n + 4))
    p.slide(name, (0, 0, -1), 0.008)
    outer = box((x - r, x + r), (y - r, y + r), (0.001, 0.026))
    p.put(cover, cut(outer, box((x - 0.85 * r, x + 0.85 * r), (y - 0.85 * r, y + 0.85 * r), (-1, 0.022))))
    p.put(BASE, rod((x - r, y + 1.05 * r, 0.003), (x + r, y + 1.05 * r, 0.003), 0.004, 8))
    p.hinge(cover, (x, y + r, 0.003), (1, 0, 0), m.pick(90, 120))
