"""Laundry room by another hand: front loader, top loader, twin tub, tub on legs."""

from __future__ import annotations

import numpy as np
import trimesh
from shapely.geometry import Polygon

from training.kinds.game_style import Look, bolts, bow_handle, circle, knob, look
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, common, cut, prism, rectangle, rod


def laundry_machine(m: Model) -> None:
    """A washing machine with a porthole, with a lid on top, with two tubs, or a round tub on legs."""
    a = look(m)
    make = m.pick(
        _porthole, _porthole, _porthole, _top_lid, _twin_tub, _old_tub if a.way in ("old", "low", "round") else _porthole
    )
    make(a)


def _porthole(a: Look) -> None:
    m = a.m
    half, deep, tall = m.number(0.26, 0.36), m.number(0.22, 0.34), m.number(0.85, 1.0)
    r, z, front = m.number(0.14, 0.17), m.number(0.4, 0.43), -deep
    square = m.chance(0.25)
    hole = rectangle((-r, r), (z - r, z + r)) if square else circle(r, 2 * a.n, at=(0, z))
    depth = m.number(0.36, 0.5) * 2 * deep if a.inside else 0.03
    body = box((-half, half), (front, deep), (0.02, tall))
    body = a.block((-half, half), (front, deep), (0.02, tall)) if a.way == "round" else body
    if a.way == "sheet" and not a.inside:
        body = a.block((-half, half), (front, deep), (0.02, tall))
    else:
        body = cut(body, prism(hole.buffer(0.002), "y", (front - 0.1, front + depth)))
    a.put(BASE, body)
    if a.inside:
        _drum(a, r, z, front + 0.05, front + depth)
    a.put(
        BASE,
        *(
            rod((sx * (half - 0.05), sy * (deep - 0.05), 0), (sx * (half - 0.05), sy * (deep - 0.05), 0.03), 0.02, 8)
            for sx in (-1, 1)
            for sy in (-1, 1)
        ),
    )
    _round_door(a, hole, r, z, front)
    top = tall - 0.05 * (a.edge > 0)
    _controls(a, half, front, (top - 0.13, top - 0.02))
    if m.chance(0.5):
        wide, x = m.number(0.08, 0.14), m.pick(-1, 1) * (half - 0.18)
        if m.chance(0.3):
            x, wide = 0.0, half - 0.03
        a.put(
            "filter_flap",
            a.panel(box((x - wide, x + wide), (front - 0.008, front), (0.05, 0.05 + m.number(0.07, 0.12))), (0, -1, 0)),
        )
        m.hinge("filter_flap", (x, front - 0.004, 0.05), (1, 0, 0), m.number(80, 110))


def _drum(a: Look, r: float, z: float, near: float, far: float) -> None:
    """A drum with paddles that turns behind the porthole."""
    drum = prism(circle(0.95 * r, 2 * a.n, 0.9 * r, (0, z)), "y", (near, far - 0.02))
    end = prism(circle(0.93 * r, 2 * a.n, 0, (0, z)), "y", (far - 0.03, far - 0.015))
    fins = [box((-0.015, 0.015), (near + 0.02, far - 0.03), (z + 0.7 * r, z + 0.92 * r)) for _ in range(3)]
    for k, fin in enumerate(fins):
        fin.apply_transform(_turn_y(120 * k, z))
    a.put("drum", drum, end, *fins, rod((0, far - 0.03, z), (0, far + 0.005, z), 0.02, 8))
    a.m.spin("drum", (0, near, z), (0, -1, 0))


def _turn_y(degrees: float, z: float) -> np.ndarray:
    return trimesh.transformations.rotation_matrix(np.deg2rad(degrees), (0, 1, 0), (0, 0, z))


def _round_door(a: Look, hole: Polygon, r: float, z: float, front: float) -> None:
    """A ring with a bowl of glass, or a plain disc, hinged at one side."""
    m = a.m
    out, s, thick = m.number(0.02, 0.045), m.pick(-1, 1), m.number(0.02, 0.04)
    if a.way == "sunk":
        out, thick = -0.004, 0.025
    edge = hole.buffer(out)
    y = (front - thick, front - 0.001) if out > 0 else (front - 0.002, front + thick - 0.004)
    if a.way == "sheet" or m.chance(0.15):
        a.put("door", a.panel(prism(edge, "y", y), (0, -1, 0)))
    else:
        a.put("door", prism(edge.difference(hole.buffer(-0.2 * r)), "y", y))
        a.put("door", prism(hole.buffer(-0.19 * r), "y", (y[1] - 0.012, y[1])))
        if a.inside and m.chance(0.7):
            bowl = ball((0, y[1] - 0.01, z), (0.72 * r, m.number(0.04, 0.09), 0.72 * r), max(a.n, 8))
            a.put("door", common(bowl, box((-r, r), (y[1] - 0.005, 0), (z - r, z + r))))
    reach = r + out
    if out > 0 and m.chance(0.75):
        x = -s * (reach - 0.022)
        a.put("door", *bow_handle(a, (x, y[0], z - 0.04), (x, y[0], z + 0.04), (0, -1, 0), 0.006))
    if a.way in ("cad", "old") and out > 0:
        a.put(
            BASE, rod((s * (reach + 0.004), front - 0.008, z - 0.05), (s * (reach + 0.004), front - 0.008, z + 0.05), 0.009, 8)
        )
    m.hinge("door", (s * reach, y[0] if out < 0 else front - 0.005, z), (0, 0, s), m.number(100, 165) if out > 0 else 100)


def _controls(a: Look, half: float, front: float, z: Span) -> None:
    """Soap drawer, dial, buttons and a display in a row along the top."""
    m, mid = a.m, (z[0] + z[1]) / 2
    s = m.pick(-1, 1, 1)
    if m.chance(0.4):
        a.put(BASE, a.panel(box((-half + 0.01, half - 0.01), (front - 0.004, front), (z[0] - 0.012, z[1] + 0.012)), (0, -1, 0)))
        front -= 0.004
    if m.chance(0.8):
        x = tuple(sorted((-s * (half - 0.02), -s * (half - m.number(0.14, 0.22)))))
        a.put("drawer", a.block(x, (front - 0.014, front), z, (0, 1, 0)))
        if a.inside:
            tray = box((x[0] + 0.01, x[1] - 0.01), (front - 0.001, front + 0.18), (z[0] + 0.01, z[1] - 0.02))
            a.put("drawer", cut(tray, box((x[0] + 0.015, x[1] - 0.015), (front + 0.01, front + 0.17), (z[0] + 0.02, z[1]))))
        if m.chance(0.4):
            a.put(
                "drawer",
                *bow_handle(a, (x[0] + 0.03, front - 0.014, mid), (x[1] - 0.03, front - 0.014, mid), (0, -1, 0), 0.005),
            )
        m.slide("drawer", (0, -1, 0), m.number(0.12, 0.18))
    for k in range(m.pick(1, 1, 1, 2)):
        x = s * (0.02 + 0.1 * k)
        name = f"dial_{k}"
        a.put(name, *knob(a, (x, front, mid), (0, -1, 0), m.number(0.022, 0.038), 0.022))
        a.put(name, box((x - 0.003, x + 0.003), (front - 0.026, front - 0.02), (mid, mid + 0.018)))
        m.spin(name, (x, front, mid), (0, -1, 0))
    shape = m.pick("round", "square")
    for k in range(m.pick(0, 1, 3, 4, 5)):
        x = s * (half - 0.035 - 0.03 * k)
        if abs(x) < 0.15:
            continue
        name = f"button_{k}"
        flat = box((x - 0.01, x + 0.01), (front - 0.008, front + 0.002), (z[0] + 0.01, z[0] + 0.028))
        a.put(
            name,
            flat if shape == "square" else rod((x, front + 0.002, z[0] + 0.02), (x, front - 0.008, z[0] + 0.02), 0.01, a.n),
        )
        m.slide(name, (0, 1, 0), 0.006)
    if m.chance(0.5):
        x = s * (half - 0.1)
        a.put(BASE, box((x - 0.05, x + 0.05), (front - 0.002, front + 0.002), (mid + 0.005, z[1] - 0.008)))


def _top_lid(a: Look) -> None:
    """A box with a lid in its top and a console behind it."""
    m = a.m
    half, deep, tall = m.number(0.28, 0.38), m.number(0.28, 0.36), m.number(0.85, 1.0)
    console = m.number(0.08, 0.14)
    body = a.block((-half, half), (-deep, deep), (0, tall))
    wide, y = half - m.number(0.05, 0.1), (-deep + 0.06, deep - console - 0.04)
    if a.way != "sheet":
        body = cut(body, box((-wide, wide), y, (tall - (0.5 if a.inside else 0.02), tall + 0.1)))
    a.put(BASE, body)
    if a.inside and a.way != "sheet":
        mid, r = (y[0] + y[1]) / 2, min(wide, (y[1] - y[0]) / 2) - 0.01
        a.put(
            "drum",
            prism(circle(r, 2 * a.n, 0.93 * r, (0, mid)), "z", (tall - 0.48, tall - 0.06)),
            rod((0, mid, tall - 0.5), (0, mid, tall - 0.46), 0.98 * r, 2 * a.n),
        )
        a.put("drum", rod((0, mid, tall - 0.47), (0, mid, tall - 0.2), 0.05, a.n))
        m.spin("drum", (0, mid, tall - 0.3), (0, 0, 1))
    gap, flush = max(0.001, m.gap(0.5)), a.way in ("sunk", "cad")
    lid = box(
        (-wide + gap, wide - gap),
        (y[0] + gap, y[1] - gap),
        (tall - 0.015, tall + 0.002) if flush else (tall + 0.001, tall + 0.018),
    )
    a.put("lid", a.panel(lid, (0, 0, 1)))
    if m.chance(0.5):
        a.put(
            "lid",
            *bow_handle(a, (-0.05, y[0] + 0.04, lid.bounds[1, 2]), (0.05, y[0] + 0.04, lid.bounds[1, 2]), (0, 0, 1), 0.006),
        )
    m.hinge("lid", (0, y[1] - gap, lid.bounds[1, 2]), (-1, 0, 0), m.number(75, 92))
    rise = m.number(0.1, 0.18)
    wedge = [(deep - console, tall), (deep, tall), (deep, tall + rise), (deep - 0.6 * console, tall + rise)]
    a.put(BASE, prism(wedge, "x", (-half, half)))
    face = deep - 0.8 * console
    for k in range(m.pick(1, 2, 3)):
        x = (-0.6 + 0.5 * k) * half
        a.put(f"dial_{k}", *knob(a, (x, face, tall + rise / 2), (0, -1, 0), 0.025, 0.03))
        m.spin(f"dial_{k}", (x, face, tall + rise / 2), (0, -1, 0))


def _twin_tub(a: Look) -> None:
    """Two tubs under two lids beside each other."""
    m = a.m
    half, deep, tall = m.number(0.36, 0.44), m.number(0.2, 0.26), m.number(0.7, 0.9)
    a.put(
        BASE,
        a.block((-half, half), (-deep, deep), (0.03, tall)),
        box((-half + 0.04, half - 0.04), (-deep + 0.04, deep - 0.04), (0, 0.05)),
    )
    split, gap = m.number(-0.05, 0.2), max(0.002, m.gap(0.5))
    back = deep - 0.1
    for part, x in (("wash_lid", (-half + 0.02, split - gap)), ("spin_lid", (split + gap, half - 0.02))):
        if a.way in ("old", "round") and part == "spin_lid":
            mid, r = (x[0] + x[1]) / 2, min(x[1] - x[0], back + deep) / 2 - 0.02
            a.put(part, rod((mid, back - r, tall + 0.001), (mid, back - r, tall + 0.03), r, 2 * a.n))
        else:
            a.put(part, a.block(x, (-deep + 0.02, back), (tall + 0.001, tall + 0.025)))
        m.hinge(part, (sum(x) / 2, back, tall + 0.002), (-1, 0, 0), m.number(70, 92))
    a.put(BASE, a.block((-half, half), (back + 0.03, deep), (tall - 0.02, tall + 0.1)))
    for k in range(m.pick(2, 3)):
        x = (-0.6 + 0.6 * k) * half
        a.put(f"dial_{k}", *knob(a, (x, back + 0.03, tall + 0.06), (0, -1, 0), 0.022, 0.02))
        m.spin(f"dial_{k}", (x, back + 0.03, tall + 0.06), (0, -1, 0))


def _old_tub(a: Look) -> None:
    """A round tub on legs with castors, a lid and a wringer with a crank."""
    m = a.m
    r, low, tall = m.number(0.22, 0.3), m.number(0.2, 0.35), m.number(0.75, 0.9)
    a.put(BASE, rod((0, 0, low), (0, 0, tall), r, 2 * a.n), rod((0, 0, tall - 0.03), (0, 0, tall), r + 0.012, 2 * a.n))
    legs = [(sx * 0.6 * r, sy * 0.6 * r) for sx in (-1, 1) for sy in (-1, 1)]
    a.put(BASE, *(rod((1.2 * x, 1.2 * y, 0), (x, y, low + 0.02), 0.018, 8) for x, y in legs))
    a.put(BASE, rod((0, 0, low - 0.12), (0, 0, low + 0.01), 0.09, a.n), *bolts((0, 0, low + 0.1), "z", r, 0.008, 8))
    a.put(
        "lid", rod((0, 0, tall + 0.001), (0, 0, tall + 0.02), r, 2 * a.n), *knob(a, (0, 0, tall + 0.02), (0, 0, 1), 0.02, 0.03)
    )
    m.hinge("lid", (0, r, tall + 0.004), (-1, 0, 0), m.number(60, 88))
    if m.chance(0.7):
        y, z = r + 0.08, tall + 0.2
        a.put(
            BASE,
            box((-0.03, 0.03), (r - 0.01, y + 0.02), (tall - 0.15, tall - 0.1)),
            box((-0.03, 0.03), (y - 0.02, y + 0.02), (tall - 0.15, z - 0.04)),
        )
        a.put(
            BASE,
            *(box((x - 0.012, x + 0.012), (y - 0.03, y + 0.03), (z - 0.05, z + 0.12)) for x in (-0.19, 0.19)),
            box((-0.2, 0.2), (y - 0.03, y + 0.03), (z - 0.06, z - 0.04)),
        )
        for k, at in enumerate((z, z + 0.07)):
            a.put(f"roller_{k}", rod((-0.18, y, at), (0.18, y, at), 0.033, a.n))
            a.put(f"roller_{k}", rod((-0.195, y, at), (0.22 if k == 0 else 0.195, y, at), 0.01, 8))
            m.spin(f"roller_{k}", (0, y, at), (1, 0, 0))
        a.put(
            "roller_0",
            box((0.215, 0.23), (y - 0.01, y + 0.01), (z - 0.12, z + 0.01)),
            rod((0.22, y, z - 0.11), (0.3, y, z - 0.11), 0.01, 8),
        )
