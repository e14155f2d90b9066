"""Working machines: forklift, excavator, crane, tractor, windmill."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Polygon

from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, glazed, hang
from training.kinds.solids import Span, box, prism, rod, rounded, vec
from training.kinds.vehicles.vehicles import prisms
from training.kinds.wheels import axled, beam, lathe, upright, wheel_maker


def cab(m: Model, part: str, x: Span, y: Span, z: Span, name: str | None) -> None:
    """A cab on a part: posts and roof, glass walls or a block; name: its door on the left, or none."""
    style = m.pick("posts", "block", "walls")
    t = 0.06
    m.add(part, box((x[0] - 0.03, x[1] + 0.03), (y[0] - 0.05, y[1] + 0.05), (z[1] - t, z[1])))
    if style == "block":
        m.add(part, box((x[0] + t, x[1]), y, (z[0], z[1] - t)))
    else:
        m.add(part, *(box((a, a + t), (b, b + t), (z[0], z[1] - t)) for a in (x[0], x[1] - t) for b in (y[0], y[1] - t)))
        m.add(part, box((x[0] + 0.25, x[1] - 0.1), (y[1] - 0.5, y[1] - 0.1), (z[0], z[0] + 0.4)))
    if style == "walls":
        m.add(part, box((x[1] - 0.03, x[1]), y, (z[0], z[1] - t)), box(x, (y[1] - 0.03, y[1]), (z[0], z[1] - t)))
    if name:
        door = Model(m.rng)
        w, gap = y[1] - y[0] - 2 * t, abs(m.gap(0.6))
        span = (gap, w - gap), (-0.04, 0.0), (z[0] + 0.02, z[1] - t - 0.01)
        if m.chance(0.7):
            glazed(door, name, *span, 0.07)
        else:
            door.add(name, box(*span))
        door.add(name, box((w - 0.14, w - 0.1), (-0.08, -0.04), (z[0] + 0.5, z[0] + 0.7)))
        hang(door, name, *span, m.pick("left", "right"), OUT, 90, part)
        turn = np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]])  # its front faces -x
        for owner, solid in door.pieces:
            solid.vertices = solid.vertices @ turn.T + (x[0], y[1] - t, 0)
            m.add(owner, solid)
        joint = door.joints[name]
        low, high = np.degrees(joint.limits)
        m.hinge(name, turn @ joint.origin + (x[0], y[1] - t, 0), turn @ joint.axis, (low, high), part)


def chain_track(m: Model, part: str, x: Span, long: float, high: float) -> None:
    """A crawler: a rounded band, smooth or with plates, and its fixed rollers."""
    line = LineString([(-long / 2 + high / 2, high / 2), (long / 2 - high / 2, high / 2)])
    band = line.buffer(high / 2).difference(line.buffer(0.38 * high)) if m.chance(0.6) else line.buffer(high / 2)
    m.add(part, *prisms(band, "x", x))
    for y in np.linspace(-long / 2 + high / 2, long / 2 - high / 2, m.pick(3, 5)):
        m.add(part, rod((x[0] - 0.01, y, high / 2), (x[1] + 0.01, y, high / 2), 0.32 * high, 12))
    if m.chance(0.5):
        for y in np.arange(-long / 2 + high / 2, long / 2 - high / 2, 0.22):
            m.add(part, *(box((x[0] - 0.02, x[1] + 0.02), (y, y + 0.16), (z - 0.02, z + 0.03)) for z in (0.0, high)))


def forklift(m: Model) -> None:
    """A body on wheels, a mast that may tilt, one or two lifting stages, forks that may shift."""
    half, long, radius = m.number(0.45, 0.6), m.number(1.6, 2.2), m.number(0.22, 0.3)
    back, low = long * 0.55, 0.12
    m.add(BASE, prism(rounded((0.15, long), (low, 0.75), 0.08), "x", (-0.8 * half, 0.8 * half)))
    m.add(BASE, prism(Polygon([(back, 0.7), (long + 0.1, 0.6), (long, 1.0), (back, 1.05)]), "x", (-half, half)))
    posts = [(s * 0.75 * half, y, z) for s in (-1, 1) for y, z in ((0.3, 0.7), (back + 0.2, 1.0))]
    m.add(BASE, *(rod(p, (p[0], p[1] + 0.05, 2.05), 0.03, 8) for p in posts))
    bars = np.linspace(0.35, back + 0.25, m.pick(4, 6))
    m.add(BASE, *(box((-0.8 * half, 0.8 * half), (y - 0.02, y + 0.02), (2.03, 2.07)) for y in bars))
    m.add(BASE, *(box((s * 0.75 * half - 0.03, s * 0.75 * half + 0.03), (0.3, back + 0.3), (2.05, 2.09)) for s in (-1, 1)))
    m.add(BASE, box((-0.2, 0.2), (0.6, back + 0.05), (0.75, 0.9)))
    make = wheel_maker(m, ("disc", "tyre", "lathed"), 0.2)
    axled(m, make, (-half, half), 0.3, radius, 0.18, "front")
    axled(m, make, (-half, half), long - 0.35, 0.85 * radius, 0.16, "rear")
    if m.chance(0.7):
        center = np.array([0, 0.5, 1.1])
        solids = [lathe([(0.14, -0.012), (0.165, -0.012), (0.165, 0.012), (0.14, 0.012), (0.14, -0.012)], 16)]
        solids += [box((-0.15, 0.15), (-0.015, 0.015), (-0.01, 0.01)), rod((0, 0, -0.25), (0, 0, 0), 0.02, 8)]
        m.add("steering", *upright(solids, (0, 0.5, 0.8), center))
        m.spin("steering", center, (0, 0.5, 0.8))
    tall, mast = m.number(1.9, 2.3), BASE
    if m.chance(0.6):
        mast = "mast"
        m.hinge(mast, (0, 0.0, 0.3), (1, 0, 0), (-8, 6))
    m.add(mast, *(box((s * 0.3 - 0.04, s * 0.3 + 0.04), (-0.06, 0.06), (0.08, tall)) for s in (-1, 1)))
    m.add(mast, *(box((-0.3, 0.3), (0.02, 0.06), (z, z + 0.08)) for z in (0.3, tall - 0.1)))
    carried = mast
    if m.chance(0.5):
        carried = "stage"
        m.add("stage", *(box((s * 0.22 - 0.03, s * 0.22 + 0.03), (-0.05, 0.03), (0.1, tall - 0.02)) for s in (-1, 1)))
        m.add("stage", *(box((-0.22, 0.22), (-0.03, 0.02), (z, z + 0.06)) for z in (0.15, tall - 0.12)))
        m.slide("stage", (0, 0, 1), 0.8 * tall, mast)
    m.add("carriage", *(box((-0.42, 0.42), (-0.12, -0.06), (z, z + 0.08)) for z in (0.15, 0.5)))
    m.add("carriage", *(box((s * 0.15 - 0.02, s * 0.15 + 0.02), (-0.1, -0.05), (0.12, 0.6)) for s in (-1, 1)))
    if m.chance(0.5):
        m.add("carriage", *(box((x - 0.015, x + 0.015), (-0.1, -0.07), (0.55, 1.1)) for x in np.linspace(-0.4, 0.4, 6)))
        m.add("carriage", box((-0.42, 0.42), (-0.11, -0.06), (1.08, 1.12)))
    m.slide("carriage", (0, 0, 1), (-0.05, 0.75 * tall), carried)
    shifts = m.chance(0.4)
    for k, s in enumerate((-1, 1)):
        part, x = (f"fork_{k}" if shifts else "carriage"), s * m.pick(0.22, 0.28)
        m.add(
            part, box((x - 0.05, x + 0.05), (-0.16, -0.12), (0.06, 0.58)), box((x - 0.05, x + 0.05), (-1.1, -0.12), (0.06, 0.1))
        )
        if shifts:
            m.slide(part, (s, 0, 0), 0.08, "carriage")


def excavator(m: Model) -> None:
    """Tracks or wheels, a house that swings, boom, stick and bucket; perhaps a blade and a cab door."""
    half, long, tall = m.number(0.8, 1.4), m.number(2.2, 3.6), m.number(0.5, 0.8)
    if m.chance(0.75):
        for s in (-1, 1):
            chain_track(m, BASE, tuple(sorted((s * half, s * (half - 0.45)))), long, tall)
        m.add(BASE, box((-half + 0.4, half - 0.4), (-0.3 * long, 0.3 * long), (0.35 * tall, 0.9 * tall)))
    else:
        make = wheel_maker(m, ("tyre", "rim", "lathed"), 0.5)
        m.add(BASE, box((-half + 0.4, half - 0.4), (-0.45 * long, 0.45 * long), (0.4 * tall, tall)))
        for k, y in enumerate((-0.33 * long, 0.33 * long)):
            axled(m, make, (-half, half), y, 0.6 * tall, 0.3, f"axle_{k}")
    if m.chance(0.5):
        y = -0.5 * long - 0.35
        m.add(
            "blade",
            prism(Polygon([(y, 0.05), (y + 0.08, 0.05), (y + 0.14, 0.55), (y, 0.55), (y + 0.05, 0.3)]), "x", (-half, half)),
        )
        arms = [beam((s * 0.25, -0.25 * long, 0.5 * tall), (s * 0.25, y + 0.1, 0.3), 0.1, 0.12) for s in (-1, 1)]
        m.add("blade", *arms)
        m.hinge("blade", (0, -0.25 * long, 0.5 * tall), (-1, 0, 0), (-10, 25))
    floor = 1.15 * tall
    m.add(BASE, rod((0, 0, 0.8 * tall), (0, 0, floor - 0.02), 0.45 * half, 24))
    rear, front = 0.42 * long, -0.3 * long
    house = (
        rounded((-half, half), (front, rear), 0.2)
        if m.chance(0.5)
        else Polygon(
            [(-half, front), (half, front), (half, 0.6 * rear), (0.6 * half, rear), (-0.6 * half, rear), (-half, 0.6 * rear)]
        )
    )
    m.add("house", prism(house, "z", (floor, floor + 0.2)))
    m.add("house", box((-half + 0.05, half - 0.05), (0.15, rear - 0.05), (floor + 0.2, floor + m.number(0.5, 0.8))))
    m.add("house", box((0.35 * half, half - 0.05), (front + 0.1, 0.15), (floor + 0.2, floor + m.number(0.3, 0.6))))
    m.spin("house", (0, 0, floor), (0, 0, 1))
    cab(
        m,
        "house",
        (-half + 0.03, -0.25 * half),
        (front + 0.05, 0.12),
        (floor + 0.2, floor + 1.5),
        "door" if m.chance(0.6) else None,
    )
    if m.chance(0.5):
        m.add("house", rod((0.5 * half, 0.4, floor), (0.5 * half, 0.4, floor + 1.2), 0.05, 8))
    w, s = 0.22, m.number(0.8, 1.1)
    a = np.array([0.05 * half, front + 0.15, floor + 0.35])
    elbow, b = a + s * np.array([0, -0.7, 1.35]), a + s * np.array([0, -2.0, 1.6])
    m.add(
        "boom",
        beam(a, elbow, w, 0.3),
        beam(elbow, b, w, 0.3, taper=0.7),
        rod(elbow - (w / 2, 0, 0), elbow + vec(w / 2, 0, 0), 0.15, 12),
    )
    m.add(
        "house",
        *(box((a[0] + c - 0.03, a[0] + c + 0.03), (a[1] - 0.2, a[1] + 0.2), (floor, a[2] + 0.15)) for c in (-0.18, 0.18)),
    )
    m.hinge("boom", a, (-1, 0, 0), (-30, 25), "house")
    top, c = b + s * np.array([0, 0.25, 0.25]), b + s * np.array([0, -0.5, -1.45])
    m.add("stick", beam(top, c, 0.8 * w, 0.24, taper=0.7), rod(b - (0.6 * w, 0, 0), b + vec(0.6 * w, 0, 0), 0.07, 12))
    m.hinge("stick", b, (-1, 0, 0), (-40, 50), "boom")
    if m.chance(0.5):  # rams drawn, standing still on their parts
        m.add(
            "boom",
            beam(elbow + vec(0, 0, 0.25), b + vec(0, 0.5, 0.35), 0.1, 0.1),
            beam(a + vec(0.16, -0.3, 0), elbow + vec(0.16, 0.1, -0.3), 0.08, 0.08),
        )
    n, bw = m.pick(8, 14), m.number(0.25, 0.45)
    t = np.linspace(0.1 * np.pi, 1.15 * np.pi, n)
    curve = np.c_[c[1] + 0.28 + 0.38 * np.cos(t + np.pi / 2.2), c[2] - 0.25 + 0.38 * np.sin(t + np.pi / 2.2)]
    shell = LineString(curve).buffer(0.025, cap_style=2)
    m.add("bucket", *prisms(shell, "x", (c[0] - bw, c[0] + bw)))
    cheek = Polygon(curve).buffer(0.02)
    for s in (-1, 1):
        m.add("bucket", *prisms(cheek, "x", tuple(sorted((c[0] + s * bw, c[0] + s * (bw - 0.03))))))
        m.add(
            "bucket",
            box((c[0] + s * 0.13 - 0.02, c[0] + s * 0.13 + 0.02), (c[1] - 0.1, c[1] + 0.2), (c[2] - 0.25, c[2] + 0.06)),
        )
    tip = curve[-1]
    m.add(
        "bucket",
        *(
            box((x - 0.03, x + 0.03), (tip[0] - 0.03, tip[0] + 0.12), (tip[1] - 0.03, tip[1] + 0.03))
            for x in c[0] + np.linspace(-0.9, 0.9, 4) * bw
        ),
    )
    m.hinge("bucket", c, (-1, 0, 0), (-60, 70), "stick")
