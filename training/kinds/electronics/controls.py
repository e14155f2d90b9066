"""Knobs, buttons, rockers and sliders on flat panels, keyboards and switch panels."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, prism, rod, rounded, tube, vec
from training.kinds.wheels import beam, lathe, upright


def knob(m: Model, part: str, at, axis, radius: float, parent: str = BASE, style: str | None = None) -> None:
    """A knob that turns about an axis out of a face; perhaps with a pointer, a skirt or flutes."""
    style, h, n = style or m.pick("plain", "pointer", "skirt", "fluted"), m.number(0.6, 1.3) * radius, m.sections()
    solids = [lathe([(0, 0), (radius, 0), (0.9 * radius, 0.9 * h), (0.8 * radius, h), (0, h)], n)]
    if style == "pointer":
        solids.append(box((-0.12 * radius, 0.12 * radius), (0, 0.95 * radius), (h, 1.15 * h)))
    elif style == "skirt":
        solids.append(rod((0, 0, 0), (0, 0, 0.15 * h), 1.3 * radius, n))
    elif style == "fluted":
        turns = np.linspace(0, 2 * np.pi, 11)[:-1]
        solids += [
            rod(
                (radius * np.cos(t), radius * np.sin(t), 0.1 * h),
                (radius * np.cos(t), radius * np.sin(t), 0.9 * h),
                0.12 * radius,
                6,
            )
            for t in turns
        ]
    m.add(part, *upright(solids, axis, at))
    if part != BASE:
        m.spin(part, at, axis, parent)


def button(m: Model, part: str, x: Span, y: Span, z: float, up: float, parent: str = BASE, style: str = "box") -> None:
    """A key on a level face at z that is pressed down: a box, a rounded box, a tapering cap or a disc."""
    middle, size = vec((x[0] + x[1]) / 2, (y[0] + y[1]) / 2, z), min(x[1] - x[0], y[1] - y[0])
    low = z - 0.3 * up
    if style == "disc":
        m.add(part, rod((*middle[:2], low), (*middle[:2], z + up), size / 2, m.sections()))
    elif style == "dome":
        m.add(part, ball(middle, (size / 2, size / 2, up), 10))
    elif style == "rounded":
        m.add(part, prism(rounded(x, y, 0.2 * size, 3), "z", (low, z + up)))
    elif style == "taper":
        m.add(part, beam((*middle[:2], low), (*middle[:2], z + up), x[1] - x[0], y[1] - y[0], taper=0.75))
    else:
        m.add(part, box(x, y, (low, z + up)))
    if part != BASE:
        m.slide(part, (0, 0, -1), 0.8 * up, parent)


def tilted(m: Model, degrees: float, about) -> None:
    """Turn everything built so far about a line along x."""
    about = np.asarray(about, float)
    c, s = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
    turn = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    for _, solid in m.pieces:
        solid.vertices = (solid.vertices - about) @ turn.T + about
    for joint in m.joints.values():
        joint.origin[:] = turn @ (joint.origin - about) + about
        joint.axis[:] = turn @ joint.axis


def keyboard(m: Model) -> None:
    """A computer keyboard with many keys, feet that fold out, perhaps a volume wheel."""
    pitch, rows, cols = m.number(0.017, 0.02), m.pick(3, 4, 5), m.pick(8, 10, 12)
    edge, high, style = m.number(0.005, 0.02), m.number(0.01, 0.025), m.pick("box", "taper", "rounded")
    wide, deep = cols * pitch + 2 * edge, rows * pitch + 2 * edge + m.pick(0.0, 0.02)
    case = prism(rounded((0, wide), (0, deep), 0.004), "z", (0, high))
    if m.chance(0.4):
        case = cut(case, box((edge, wide - edge), (edge, edge + rows * pitch), (0.6 * high, 1)))
    m.add(BASE, case)
    top = 0.6 * high if len(case.faces) > 60 and case.volume < 0.9 * wide * deep * high else high
    up, gap = m.number(0.003, 0.008), m.pick(0.0005, 0.001, 0.002)
    for r in range(rows):
        c = 0
        while c < cols:
            span = min(m.pick(4, 5) if r == 0 and 2 <= c < 4 else m.pick(1, 1, 1, 1, 1, 2), cols - c)
            x = (edge + c * pitch + gap, edge + (c + span) * pitch - gap)
            button(m, f"key_{r}_{c}", x, (edge + r * pitch + gap, edge + (r + 1) * pitch - gap), top, up, style=style)
            c += span
    for k, x in enumerate((0.12 * wide, 0.88 * wide)):
        m.add(f"foot_{k}", box((x - 0.012, x + 0.012), (deep - 0.03, deep - 0.008), (-0.003, -0.0002)))
        m.hinge(f"foot_{k}", (x, deep - 0.008, -0.0002), (1, 0, 0), 80)
    if m.chance(0.4) and deep - edge - rows * pitch > 0.02:
        knob(m, "wheel", (wide - 0.03, deep - 0.015, high), (0, 0, 1), 0.008)
    m.add(
        BASE,
        tube([(wide / 2, deep, high / 2), (wide / 2, deep + 0.03, high / 2), (wide / 2 + 0.02, deep + 0.07, 0.003)], 0.002, 6),
    )


def switch_panel(m: Model) -> None:
    """A desk panel or rack of rockers, sliders, knobs, buttons and toggles in rows, with lamps and labels."""
    rows, cols, pitch = m.pick(1, 2, 3), m.pick(2, 4, 6), m.number(0.03, 0.05)
    wide, deep, high = cols * pitch + 0.03, rows * 1.6 * pitch + 0.03, m.number(0.03, 0.06)
    m.add(BASE, box((0, wide), (0, deep), (0, high)))
    if m.chance(0.5):
        m.add(BASE, box((0.004, wide - 0.004), (0.004, deep - 0.004), (high, high + 0.002)))
    m.add(
        BASE, *(rod((x, y, high), (x, y, high + 0.003), 0.003, 8) for x in (0.008, wide - 0.008) for y in (0.008, deep - 0.008))
    )
    for r in range(rows):
        style = m.pick("rocker", "slider", "knob", "button", "toggle")
        for c in range(cols):
            x, y, name = 0.015 + (c + 0.5) * pitch, 0.015 + (r + 0.5) * 1.6 * pitch, f"{style}_{r}{c}"
            at, w = vec(x, y, high), 0.3 * pitch
            if style == "knob":
                knob(m, name, at, (0, 0, 1), 0.8 * w)
            elif style == "button":
                button(m, name, (x - w, x + w), (y - w, y + w), high, 0.006, style="rounded")
            elif style == "rocker":
                m.add(
                    BASE,
                    prism(rounded((x - 1.3 * w, x + 1.3 * w), (y - 2.2 * w, y + 2.2 * w), 0.2 * w), "z", (high, high + 0.003)),
                )
                wedge = [
                    (y - 1.9 * w, high),
                    (y + 1.9 * w, high),
                    (y + 1.9 * w, high + 0.01),
                    (y, high + 0.005),
                    (y - 1.9 * w, high + 0.007),
                ]
                m.add(name, prism(wedge, "x", (x - w, x + w)))
                m.hinge(name, at, (1, 0, 0), (-10, 10))
            elif style == "toggle":
                m.add(BASE, rod(at, at + vec(0, 0, 0.004), 0.35 * w, 6))
                m.add(
                    name, rod(at, at + vec(0, -0.006, 0.02), 0.18 * w, 8), ball(at + vec(0, -0.006, 0.02), (0.25 * w,) * 3, 8)
                )
                m.hinge(name, at, (-1, 0, 0), (0, 35))
            else:
                m.add(BASE, box((x - 0.1 * w, x + 0.1 * w), (y - 2.2 * w, y + 2.2 * w), (high, high + 0.0015)))
                place = y + m.number(-1.5, 1.5) * w
                m.add(name, box((x - 0.6 * w, x + 0.6 * w), (place - 0.4 * w, place + 0.4 * w), (high + 0.001, high + 0.012)))
                m.slide(name, (0, 1, 0), (y - 1.8 * w - place, y + 1.8 * w - place))
            if m.chance(0.4):
                m.add(BASE, ball((x, y + 0.7 * pitch, high), (0.003, 0.003, 0.003), 8))
    angle = m.pick(0, 0, 30, 90)
    if angle:
        tilted(m, angle, (0, 0, 0))
