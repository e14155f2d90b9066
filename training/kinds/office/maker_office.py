"""Desktop printers by another hand: flat ones, high ones, old ones with a platen."""

from __future__ import annotations

from training.kinds.maker_fronts import button, screen, vents
from training.kinds.maker_style import Cell, Maker, laid, maker
from training.kinds.model import Model
from training.kinds.solids import box, cut, prism, rod, vec


def desktop_printer(m: Model) -> None:
    """A printer: flat with a scanner lid, high with paper drawers and a front cover, or an old one with a platen."""
    k = maker(m, "low", "sheet", "cad", "soft", "cut")
    design = m.pick("flat", "flat", "high", "platen")
    wide, deep = m.number(0.36, 0.52), m.number(0.3, 0.42)
    if design == "flat":
        _flat_printer(k, wide, deep, m.number(0.11, 0.2))
    elif design == "high":
        _high_printer(k, wide, deep, m.number(0.2, 0.34))
    else:
        _platen_printer(k, wide, deep, m.number(0.1, 0.15))


def _keys(k: Maker, part: str, x: float, y: float, z: float, count: int) -> None:
    """Keys in a row or a grid on a face that looks up."""
    rows = 1 if count < 5 else k.m.pick(2, 3)
    size, turn = k.m.number(0.006, 0.01), k.m.chance(0.4) and k.way != "sheet"
    for i in range(count):
        at = vec(x + 2.8 * size * (i // rows), y + 2.6 * size * (i % rows), z)
        button(k, f"button_{i}", at, (size, 0.8 * size), 0.003, (0, 0, 1), part, turn)


def _flat_printer(k: Maker, wide: float, deep: float, high: float) -> None:
    """A scanner lid on top; a paper drawer, a tray or a flap in front; a paper support behind."""
    m, wall, t = k.m, 0.012, k.thin(k.m.number(0.015, 0.04))
    cells: list[Cell] = [((0.12 * wide, 0.88 * wide), (0.012, 0.4 * high))]
    mouth = ((0.14 * wide, 0.86 * wide), (0.45 * high, 0.72 * high))
    m.add("base", *k.case((0, wide), (0, deep), (0, high), wall, [*cells, mouth] if k.inside else cells))
    if m.chance(0.6):
        k.drawer("paper_drawer", cells[0], 0.0, m.pick(0.003, 0.01), 0.75 * deep, 0.0)
    if m.chance(0.5):
        z = mouth[1]
        m.add("front_flap", *k.panel(mouth[0], (z[0], z[1] + 0.004), (-0.007, -0.0005)))
        m.hinge("front_flap", (0, -0.003, z[0]), (1, 0, 0), 85)
    else:
        x = (0.2 * wide, 0.8 * wide)
        m.add("output_tray", box(x, (-0.04, 0.5 * deep), (0.47 * high, 0.47 * high + 0.004)))
        m.add("output_tray", box(x, (-0.044, -0.04), (0.46 * high, 0.5 * high)))
        m.slide("output_tray", (0, -1, 0), 0.4 * deep)
    strip = m.chance(0.6)
    front = m.number(0.06, 0.09) if strip else 0.0
    m.add("lid", *laid(k.panel((0.003, wide - 0.003), (front + 0.003, deep - 0.003), (-high - t, -high - 0.0005))))
    m.hinge("lid", (0, deep - 0.004, high + 0.3 * t), (-1, 0, 0), m.pick(70, 85, 90))
    if k.inside and k.way != "sheet":
        m.add("base", box((0.1 * wide, 0.9 * wide), (front + 0.04, deep - 0.04), (high - 0.002, high - 0.0002)))
    if strip:
        m.add("base", k.block((0.003, wide - 0.003), (0.003, front), (high - 0.001, high + 0.8 * t)))
        m.add("base", *laid([screen(k, (0.4 * wide, 0.6 * wide), (0.2 * front, 0.85 * front), -high - 0.8 * t)]))
        _keys(k, "base", 0.66 * wide, 0.3 * front, high + 0.8 * t, m.pick(2, 3, 6))
    else:
        _panel_that_tilts(k, wide, high)
    if m.chance(0.5):
        m.add("paper_support", k.block((0.2 * wide, 0.8 * wide), (deep, deep + 0.008), (0.5 * high, high + 0.02)))
        m.hinge("paper_support", (0, deep + 0.008, 0.5 * high), (-1, 0, 0), 35)


def _panel_that_tilts(k: Maker, wide: float, high: float) -> None:
    """A control panel in front that swings up, with a screen and keys on it."""
    z, x = (0.76 * high, 0.98 * high), (0.3 * wide, 0.7 * wide)
    k.m.add("control_panel", *k.panel(x, z, (-0.014, -0.0005)))
    k.m.add("control_panel", screen(k, (0.42 * wide, 0.58 * wide), (z[0] + 0.005, z[1] - 0.005), -0.014))
    k.m.hinge("control_panel", (0, -0.003, z[1]), (-1, 0, 0), k.m.pick(45, 70))
    for i in range(k.m.pick(0, 2, 3)):
        button(
            k,
            f"button_{i}",
            (0.61 * wide + 0.025 * i, -0.014, (z[0] + z[1]) / 2),
            (0.007, 0.005),
            0.003,
            parent="control_panel",
        )


def _high_printer(k: Maker, wide: float, deep: float, high: float) -> None:
    """Paper drawers below, a cover in front, a hollow on top where sheets arrive, perhaps a scanner above it."""
    m, wall = k.m, 0.015
    count, each = m.pick(1, 1, 2), m.number(0.055, 0.075)
    cells: list[Cell] = [((wall, wide - wall), (0.008 + i * each, i * each + each - 0.004)) for i in range(count)]
    top = 0.012 + count * each
    cover: Cell = ((0.06 * wide, 0.94 * wide), (top, 0.82 * (top + high - count * each * 0.5)))
    high = max(high, cover[1][1] + 0.05)
    solids = k.case((0, wide), (0, deep), (0, high), wall, [*cells, cover])
    hollow = prism(
        [(0.08 * deep, high - 0.005), (0.08 * deep, 1), (0.8 * deep, 1), (0.75 * deep, high - 0.035)],
        "x",
        (0.15 * wide, 0.85 * wide),
    )
    if k.way in ("soft", "cut"):
        solids[0] = cut(solids[0], hollow)
    m.add("base", *solids)
    for i, cell in enumerate(cells):
        k.drawer(f"paper_drawer_{i}", cell, 0.0, m.pick(0.004, 0.012), 0.8 * deep, 0.004)
    m.add("front_cover", *k.panel(cover[0], (cover[1][0] + 0.001, cover[1][1]), (-0.012, -0.0005)))
    m.add("front_cover", *k.handle((wide / 2, -0.012, cover[1][1] - 0.012), 0.12, off=0.012))
    m.hinge("front_cover", (0, -0.004, cover[1][0]), (1, 0, 0), m.pick(75, 90))
    m.add("base", *vents(k, (0.1 * wide, 0.3 * wide), (high - 0.03, high - 0.012), 0.0, 3))
    if m.chance(0.4):
        low, up = high + 0.06, high + m.number(0.09, 0.12)
        m.add(
            "base",
            *(k.block(x, (0.55 * deep, deep), (high - 0.001, low + 0.001)) for x in ((0, 0.12 * wide), (0.88 * wide, wide))),
        )
        m.add("base", k.block((0, wide), (0, deep), (low, up)))
        m.add("scanner_lid", *laid(k.panel((0.003, wide - 0.003), (0.05, deep - 0.002), (-up - 0.03, -up - 0.0005))))
        m.hinge("scanner_lid", (0, deep - 0.004, up + 0.01), (-1, 0, 0), 80)
        _keys(k, "base", 0.6 * wide, 0.015, up, m.pick(3, 6, 9))
    else:
        _keys(k, "base", 0.88 * wide, 0.1 * deep, high, m.pick(1, 2, 3))


def _platen_printer(k: Maker, wide: float, deep: float, high: float) -> None:
    """A roller with a knob, a head on a rail, a cover, a paper guide."""
    m, wall = k.m, 0.014
    body = box((0, wide), (0, deep), (0, high))
    hole = box((0.06 * wide, 0.94 * wide), (0.25 * deep, 0.75 * deep), (0.3 * high, 1))
    m.add("base", cut(k.block((0, wide), (0, deep), (0, high)) if k.way != "sheet" else body, hole))
    y, z = 0.62 * deep, 0.75 * high
    m.add(
        "platen",
        rod((0.06 * wide, y, z), (wide + 0.012, y, z), 0.018, k.n),
        k.knob((wide + 0.002, y, z), (1, 0, 0), 0.024, 0.022),
    )
    m.spin("platen", (wide, y, z), (1, 0, 0))
    m.add("base", rod((0.05 * wide, 0.38 * deep, 0.6 * high), (0.95 * wide, 0.38 * deep, 0.6 * high), 0.004, 8))
    at = m.number(0.15, 0.6)
    m.add("print_head", k.block((at * wide, (at + 0.12) * wide), (0.3 * deep, 0.47 * deep), (0.5 * high, 0.8 * high)))
    m.slide("print_head", (1, 0, 0), (-(at - 0.08) * wide, (0.8 - at) * wide))
    m.add("cover", k.block((0.04 * wide, 0.96 * wide), (0.2 * deep, 0.78 * deep), (high + 0.0005, high + 0.01)))
    m.hinge("cover", (0, 0.78 * deep, high + 0.003), (-1, 0, 0), m.pick(80, 110))
    if m.chance(0.6):
        m.add(
            "paper_guide",
            k.block((0.12 * wide, 0.88 * wide), (deep - wall, deep - 0.006), (high - 0.001, high + m.number(0.06, 0.15))),
        )
        m.hinge("paper_guide", (0, deep - wall / 2, high), (-1, 0, 0), 30)
    _keys(k, "base", 0.7 * wide, 0.06 * deep, high, m.pick(2, 3, 4))
    if m.chance(0.5):
        m.add("base", *laid([screen(k, (0.1 * wide, 0.4 * wide), (0.04 * deep, 0.14 * deep), -high)]))
