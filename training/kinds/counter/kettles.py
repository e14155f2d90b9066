"""Kettles and pressure cookers."""

from __future__ import annotations

from training.kinds.kitchen_trims import button, cable, dial, fluted, lathe, lever
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, ring, rod, rounded, tube, vec


def kettle(m: Model) -> None:
    """A kettle: a jug on a base with a hinged lid and a switch, or one for the stove with a bail, a loose lid and a whistle."""
    n, r, high = m.pick(12, 16, 24, 32), m.number(0.07, 0.1), m.number(0.14, 0.24)
    stove = m.chance(0.4)
    if stove:
        high *= 0.7
        profile = [(0.8 * r, 0), (1.25 * r, 0.02), (1.25 * r, 0.4 * high), (0.7 * r, high)]
        top = 0.7 * r
    else:
        m.add(BASE, rod((0, 0, 0), (0, 0, 0.018), 1.05 * r, n))
        profile, top = [(r, 0.02), (m.pick(1.0, 1.1) * r, 0.06), (0.75 * r, high)], 0.75 * r
    if m.chance(0.5):
        profile += [(0.92 * top, high), (0.85 * r, 0.03)]
    m.add(BASE, lathe(profile, n))
    spout = vec(-0.9 * r, 0, 0.75 * high)
    if stove or m.chance(0.4):
        tip = vec(-r - 0.06, 0, high * 1.02)
        m.add(BASE, rod(vec(-0.7 * r, 0, 0.4 * high), tip, 0.016, n))
        if stove and m.chance(0.6):
            m.add(
                "whistle",
                rod(tip - vec(0.004, 0, -0.006), tip + vec(-0.01, 0, 0.016), 0.02, 12),
                box((tip[0], tip[0] + 0.04), (-0.006, 0.006), (tip[2] + 0.018, tip[2] + 0.024)),
            )
            m.hinge("whistle", tip + vec(0.014, 0, 0.014), (0, 1, 0), m.pick(60, 80))
    else:
        m.add(
            BASE,
            prism([(-0.6 * r, -0.03), (-r - 0.03, 0), (-0.6 * r, 0.03)], "z", (0.75 * high, high - 0.002)).apply_translation(
                0 * spout
            ),
        )
    lid = lathe([(1.02 * top, high + 0.001), (top, high + 0.012), (0.3 * top, high + m.number(0.014, 0.035))], n)
    m.add("lid", lid)
    z = float(lid.bounds[1, 2])
    if m.chance(0.7):
        m.add(
            "lid",
            m.pick(
                ball((0, 0, z + 0.01), (0.014,) * 3, 10),
                box((-0.02, 0.02), (-0.008, 0.008), (z - 0.004, z + 0.012)),
                rod((0, 0, z - 0.005), (0, 0, z + 0.014), 0.01, 10),
            ),
        )
    if stove:
        m.slide("lid", (0, 0, 1), m.number(0.05, 0.15))
        up, s = high + m.number(0.07, 0.11), 0.95 * r
        part = m.pick("bail", "bail", BASE)
        m.add(
            part,
            tube([(-s, 0, 0.75 * high), (-s, 0, up), (s, 0, up), (s, 0, 0.75 * high)], 0.005, 8),
            rod((-0.6 * s, 0, up), (0.6 * s, 0, up), 0.011, n),
        )
        if part == "bail":
            m.add(BASE, *(rod((s * k, -0.012, 0.75 * high), (s * k, 0.012, 0.75 * high), 0.012, 10) for k in (-1, 1)))
            m.hinge("bail", (0, 0, 0.75 * high), (1, 0, 0), (-80, 80))
        return
    out, t = r + m.number(0.04, 0.06), 0.011
    if m.chance(0.5):
        m.add(
            BASE,
            tube([(0.7 * r, 0, high - 0.01), (out, 0, high - 0.01), (out, 0, 0.3 * high), (0.85 * r, 0, 0.25 * high)], t, 8),
        )
    else:
        m.add(
            BASE,
            prism(
                rounded((0.7 * r, out + t), (0.2 * high, high + 0.004), 0.01).difference(
                    rounded((0.7 * r, out - t), (0.2 * high + 0.02, high - 0.018), 0.008)
                ),
                "y",
                (-0.012, 0.012),
            ),
        )
    m.hinge("lid", (top, 0, high + 0.004), (0, 1, 0), m.pick(70, 90, 110))
    if m.chance(0.7):
        at, low = vec(out, 0, 0.25 * high), m.chance(0.5)
        if low:
            lever(m, "switch", at, at + vec(0.035, 0, -0.008), 0.01)
            m.hinge("switch", at, (0, 1, 0), 20)
        else:
            button(m, "lid_button", (out - 0.005, 0, high + 0.002), (0, 0, 1), 0.014)
    if m.chance(0.4):
        m.add(BASE, box((-0.015, 0.015), (-r, -0.8 * r), (0.2 * high, 0.6 * high)))
    if m.chance(0.4):
        cable(m, (0, r, 0.01), 0.2)


def pressure_cooker(m: Model) -> None:
    """A pot whose lid turns to open or is hinged: long handles, a valve, a button or slider, a bow that clamps."""
    n, r, high, t = m.pick(16, 24, 32), m.number(0.1, 0.14), m.number(0.12, 0.24), 0.004
    style, profile = m.pick("turned", "turned", "hinged", "bow"), [(0.95 * r, 0.0), (r, 0.01), (r, high)]
    m.add(BASE, lathe([*profile, (r - t, high), (r - t, 0.01)] if m.chance(0.6) else profile, n))
    m.add(BASE, ring((0, 0, high - 0.004), (0, 0, 1), r, 0.005, n))
    z = high + m.number(0.02, 0.035)
    rim = 1.03 * r if style != "bow" else 0.97 * r
    m.add(
        "lid",
        lathe(
            [
                (rim, high - 0.008 if style == "turned" else high + 0.002),
                (rim, high + 0.008),
                (0.75 * r, z),
                (0.1 * r, z + 0.003),
            ],
            n,
        ),
    )
    w, long = m.number(0.012, 0.018), m.number(0.1, 0.18)
    handles = m.pick("long", "ears", "both")
    for s in (-1, 1):
        reach = long if s < 0 and handles != "ears" else 0.035
        y = sorted((s * 0.97 * r, s * (r + reach)))
        m.add(BASE, box((-w, w), tuple(y), (0.75 * high, 0.75 * high + 0.022)))
        if style == "turned" and (s < 0 or handles != "long"):
            y = sorted((s * 0.9 * r, s * (r + reach)))
            m.add("lid", box((-w, w), tuple(y), (high + 0.006, high + 0.026)))
    at = vec(0, 0, z)
    if style == "turned":
        m.hinge("lid", at, (0, 0, m.pick(-1, 1)), m.pick(30, 45, 90))
        if m.chance(0.6):
            m.add("slider", box((-0.5 * w, 0.5 * w), (-r - 0.03, -r - 0.01), (high + 0.026, high + 0.033)))
            m.slide("slider", (0, -1, 0) if m.chance(0.5) else (0, 1, 0), 0.015, "lid")
    elif style == "hinged":
        m.add(BASE, box((-0.03, 0.03), (0.98 * r, r + 0.03), (0.7 * high, high + 0.006)))
        m.add(
            "lid",
            box((-0.02, 0.02), (0.9 * r, r + 0.028), (high + 0.006, high + 0.016)),
            box((-0.025, 0.025), (-r - 0.035, -0.9 * r), (high + 0.003, high + 0.018)),
        )
        m.hinge("lid", (0, r + 0.02, high + 0.006), (-1, 0, 0), m.pick(80, 95))
    else:
        m.slide("lid", (0, 0, 1), m.number(0.05, 0.12))
        bar, s = z + 0.02, r + 0.015
        m.add(
            "bow",
            box((-s, s), (-0.012, 0.012), (bar, bar + 0.01)),
            *(box((k * s - 0.004, k * s + 0.004), (-0.012, 0.012), (0.8 * high, bar + 0.01)) for k in (-1, 1)),
        )
        m.add(
            BASE,
            *(rod((k * 0.97 * r, 0, 0.8 * high + 0.01), (k * (s + 0.01), 0, 0.8 * high + 0.01), 0.008, 10) for k in (-1, 1)),
        )
        m.hinge("bow", (0, 0, 0.8 * high + 0.01), (1, 0, 0), m.pick(60, 90))
        dial(m, "screw", (0, 0, bar + 0.01), (0, 0, 1), 0.03, "bow")
    if style != "bow":
        valve = at + vec(0.3 * r * m.pick(0, 1), 0, 0)
        kind = m.pick("weight", "knob", "lever")
        if kind == "weight":
            m.add("valve", fluted(0.012, 10, (0, 0.022), valve), rod(valve, valve + vec(0, 0, 0.03), 0.005, 8))
            m.slide("valve", (0, 0, 1), 0.01, "lid")
        elif kind == "knob":
            dial(m, "valve", valve, (0, 0, 1), 0.016, "lid")
        else:
            lever(m, "valve", valve + vec(0, 0, 0.006), valve + vec(0.04, 0, 0.008), 0.01)
            m.hinge("valve", valve, (0, 0, 1), 60, "lid")
        if m.chance(0.6):
            button(m, "pin", at + vec(-0.4 * r, 0, -0.003), (0, 0, 1), 0.01, "lid")
        m.add("lid", *(rod(at + vec(c, 0.4 * r, -0.01), at + vec(c, 0.4 * r, 0.002), 0.005, 8) for c in (-0.02, 0.02)))
