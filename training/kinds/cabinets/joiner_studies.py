"""Furniture of studies and halls by the joiner: computer desk, office pedestal, tilting shoe cabinet, bench of lockers."""

from __future__ import annotations

from dataclasses import replace

from trimesh import Trimesh

from training.kinds.cabinets.joiner_bodies import Tree, carcass, drawers, row, stack
from training.kinds.cabinets.joiner_feet import cornice, feet, legs
from training.kinds.cabinets.joiner_fits import fit
from training.kinds.joiner_style import Look, bevelled, draw_look, middle, named, shrunk, slab
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, prism, rod, rounded, tube, vec


def computer_desk(m: Model) -> None:
    """A desk with cupboards at one side or both, a tray for the keyboard that slides, a shelf above, things on it."""
    look = draw_look(m, 0.9)
    wide, deep, high = m.number(1.0, 1.8), m.number(0.55, 0.75), m.number(0.7, 0.76)
    x, y, side = (0.0, wide), (0.02, deep), m.number(0.32, 0.45)
    layout = m.pick("left", "right", "both", "trestle")
    sides = {"left": [(0.0, side)], "right": [(wide - side, wide)], "both": [(0.0, side), (wide - side, wide)]}.get(layout, [])
    for span in sides:
        tree = m.pick(
            drawers(m.pick(2, 3, 4), m),
            stack("door", "drawer", weights=(2.6, 1)),
            stack("open", "drawer", weights=(2.6, 1)),
            "door",
            stack("drawer", "open things", weights=(1.5, 1)),
        )
        foot = m.pick(0.02, 0.06)
        fit(m, look, carcass(m, look, span, y, (foot, high), tree))
        feet(m, look, span, y, foot, "plinth")
    room = (side if layout in ("left", "both") else 0.0, wide - side if layout in ("right", "both") else wide)
    if layout == "trestle":
        legs(m, look, x, y, (0, high), m.number(0.04, 0.07))
    elif layout != "both":
        panel = (wide - 0.025, wide) if layout == "left" else (0.0, 0.025)
        m.add(BASE, slab(look, panel, y, (0, high), "x") if look.way != "sheet" else box(panel, y, (0, high)))
    m.add(BASE, box(room, (deep - 0.03, deep - 0.012), (high - m.number(0.2, 0.5), high)))
    top = high + m.number(0.018, 0.035)
    m.add(BASE, slab(look, shrunk(x, -0.01), (-0.02, deep), (high, top)))
    if m.chance(0.7) or layout == "trestle":
        _keyboard_tray(m, shrunk(room, 0.03 if layout != "trestle" else 0.09), high)
    elif m.chance(0.6):
        fit(
            m,
            look,
            carcass(m, look, shrunk(room, 0.08), (0.04, 0.8 * deep), (high - 0.12, high), row(*["drawer"] * m.pick(1, 2))),
        )
    if m.chance(0.45):
        _hutch(m, look, wide, deep, top)
    else:
        _screen(m, middle(room), 0.62 * deep, top)


def _keyboard_tray(m: Model, room: Span, high: float) -> None:
    """A board on runners below the top, with a lip or a keyboard on it."""
    part, z = named(m, "tray"), high - m.number(0.07, 0.1)
    x = room if room[1] - room[0] < 0.8 else (middle(room) - 0.35, middle(room) + 0.35)
    y = (0.03, 0.03 + m.number(0.3, 0.38))
    m.add(part, box(x, y, (z - 0.016, z)))
    for s, e in ((x[0], -1), (x[1], 1)):
        m.add(BASE, box((s + e * 0.001, s + e * 0.012), (y[0] + 0.02, y[1] + 0.05), (z - 0.014, high)))
        m.add(BASE, box((s - e * 0.015, s + e * 0.002), (y[0] + 0.02, y[1] + 0.05), (z - 0.019, z - 0.0165)))
    if m.chance(0.5):
        m.add(part, box(x, (y[0] - 0.015, y[0] + 0.001), (z - 0.03, z + 0.012)))
    if m.chance(0.5):
        m.add(part, bevelled(shrunk(x, 0.1), (y[0] + 0.04, y[0] + 0.17), (z - 0.001, z + 0.02), 0.006, "z", 1))
    m.slide(part, (0, -1, 0), m.number(0.2, 0.3))


def _hutch(m: Model, look: Look, wide: float, deep: float, top: float) -> None:
    """Shelves and small cupboards above the desk."""
    tall = m.number(0.3, 0.75)
    tree = m.pick(
        row("door", "open things", "open"),
        stack("open things", row("lift", "lift")),
        row(stack("open", "drawer"), "open things", "door", weights=(1, 2, 1)),
        stack("open", row("open", "open things")),
    )
    y = (deep - m.number(0.22, 0.3), deep)
    fit(m, look, carcass(m, look, (0.0, wide), y, (top, top + tall), tree))


def _screen(m: Model, x: float, y: float, top: float) -> None:
    """A screen on its foot, which does not move here, and perhaps a keyboard."""
    if m.chance(0.3):
        return
    half = m.number(0.22, 0.32)
    m.add(BASE, bevelled((x - half, x + half), (y - 0.02, y + 0.015), (top + 0.1, top + 0.1 + 1.15 * half), 0.006, "y", 1))
    m.add(BASE, box((x - 0.025, x + 0.025), (y, y + 0.025), (top, top + 0.16)))
    m.add(BASE, box((x - 0.11, x + 0.11), (y - 0.08, y + 0.08), (top, top + 0.01)))


def office_pedestal(m: Model) -> None:
    """A low cabinet for an office: drawers of equal or mixed height, a file drawer, on castors or a plinth, perhaps padded."""
    look = draw_look(m, 0.7)
    wide, deep, high = m.number(0.36, 0.48), m.number(0.45, 0.62), m.number(0.42, 0.68)
    foot = m.pick(0.0, 0.03, 0.06, 0.075)
    rolling = foot >= 0.06
    tree = m.pick(
        drawers(3, m),
        stack("drawer", "drawer", "drawer", weights=(2, 1, 1), boards=False),
        stack("drawer", "drawer", weights=(2, 1), boards=False),
        stack("drawer", "drawer", "drawer", "drawer", weights=(2, 1, 1, 0.4), boards=False),
        stack("door", "drawer", weights=(2.5, 1)),
        stack("drawer", "open", weights=(1.5, 1)),
        stack("drawer", "drawer", "blank", weights=(2, 1, 0.25), boards=False),
    )
    x, y, z = (0.0, wide), (0.0, deep), (foot, foot + high)
    fit(m, look, carcass(m, look, x, y, z, tree))
    feet(m, look, x, y, foot, "castors" if rolling else "plinth")
    front = -look.thick if not look.inset else 0.0
    sort = m.pick("plain", "plain", "top", "cushion", "rim")
    if sort == "top":
        m.add(BASE, slab(look, shrunk(x, -0.004), (front - 0.004, deep), (z[1], z[1] + 0.02)))
    elif sort == "cushion":
        m.add(BASE, bevelled(x, (front, deep), (z[1], z[1] + m.number(0.03, 0.06)), 0.02, "z"))
    elif sort == "rim":
        outline = rounded(x, y, 0.01)
        m.add(BASE, cut(prism(outline, "z", (z[1], z[1] + 0.03)), prism(outline.buffer(-0.012), "z", (z[1] + 0.006, 1 + z[1]))))
    if look.inset and m.chance(0.4):
        at = vec(wide - 0.5 * look.wall, front - 0.001, z[1] - 0.5 * look.wall)
        m.add(BASE, rod(at, at + vec(0, 0.02, 0), 0.008, look.n))


def tilt_out_shoe_cabinet(m: Model) -> None:
    """A shallow cabinet whose fronts tilt out, in one column or several, with drawers or doors among them."""
    look = draw_look(m, 0.8)
    columns, rows = m.pick(1, 1, 2, 3), m.pick(1, 2, 2, 3, 4)
    wide, deep = columns * m.number(0.45, 0.8), m.number(0.17, 0.32)
    foot = m.pick(0.0, 0.0, 0.05, 0.12)
    high = rows * m.number(0.34, 0.45) + 0.04
    column: Tree = stack(*["tilt"] * rows, boards=m.chance(0.5))
    trees = [column] * columns
    if columns > 1 and m.chance(0.4):
        trees[-1] = m.pick("door", stack("door", "open"), "open things") if rows > 1 else drawers(2, m)
    tree = row(*trees)
    if m.chance(0.35):
        tree = stack(tree, row(*["drawer"] * m.pick(1, columns)), weights=(rows, 0.4))
        high += 0.14
    x, y, z = (0.0, wide), (0.0, deep), (foot, foot + high)
    fit(m, look, carcass(m, look, x, y, z, tree))
    feet(m, look, x, y, foot)
    if m.chance(0.7):
        top = cornice(m, look, x, y, z[1])
        if m.chance(0.3):
            m.add(BASE, *(bevelled((a, a + 0.1), (0.04, 0.13), (top, top + 0.07), 0.03, "x") for a in (0.1, 0.22)))


def locker_bench(m: Model) -> None:
    """A bench of lockers: doors, drawers or open places under a seat, or lids as the seat; a back with hooks or lockers."""
    look = draw_look(m)
    columns = m.pick(2, 3, 3, 4)
    wide, deep, high = columns * m.number(0.32, 0.48), m.number(0.36, 0.46), m.number(0.34, 0.42)
    foot = m.pick(0.0, 0.04, 0.08)
    x, y, z = (0.0, wide), (0.0, deep), (foot, foot + high)
    lids = look.way not in ("block", "round") and m.chance(0.35)
    behind = m.pick("none", "none", "hooks", "lockers", "lockers", "shelf")
    under = "open" if lids else m.pick("door", "drawer", "open things", stack("drawer", "drawer"), "door")
    cells = m.pick(
        [under if under != "open things" else "door"] * columns, ["drawer" if lids else "door", *[under] * (columns - 1)]
    )
    back = 0.02 if behind == "hooks" else m.number(0.3, 1.0) * 0.3 + 0.12
    if lids:
        _chest(m, look, wide, deep, z, columns if m.chance(0.5) else 1, 0.0 if behind == "none" else 0.04)
    else:
        fit(m, look, carcass(m, look, x, y, z, row(*cells)))
        m.add(BASE, _seat(m, look, x, (-0.015 - look.thick, deep), z[1]))
    feet(m, look, x, y, foot, m.pick("plinth", "blocks"))
    seat = z[1] + (0.03 if not lids else 0.0)
    if behind == "hooks":
        _hooks(m, look, wide, (deep - back, deep), seat, columns)
    elif behind != "none" and not lids:
        lockers: list[Tree] = [m.pick("door rail", "door rail", stack("door", "door")) for _ in range(columns)]
        tree = row(*lockers) if behind == "lockers" else row(*["open"] * columns)
        lift = 0.0 if behind == "lockers" else m.number(0.5, 0.8)
        if lift:
            m.add(BASE, box(x, (deep - 0.02, deep), (seat - 0.03, seat + lift)))
        tall = m.number(0.9, 1.4) if behind == "lockers" else 0.3
        upper = replace(look, gap=max(look.gap, 0.0))
        fit(m, upper, carcass(m, upper, x, (deep - back, deep), (seat + lift, seat + lift + tall), tree))
        cornice(m, upper, x, (deep - back, deep), seat + lift + tall)


def _seat(m: Model, look: Look, x: Span, y: Span, low: float) -> Trimesh:
    """The seat: a board or a cushion, 3 cm thick."""
    if m.chance(0.4):
        return bevelled(x, y, (low, low + 0.03), 0.013, "z")
    return slab(look, x, y, (low, low + 0.03))


def _chest(m: Model, look: Look, wide: float, deep: float, z: Span, lids: int, back: float) -> None:
    """A box below the seat whose top is one lid or several."""
    w = 0.018
    hole = [((k * wide / lids + w, (k + 1) * wide / lids - w), (w, deep - w)) for k in range(lids)]
    body = box((0, wide), (0, deep), z)
    m.add(BASE, cut(body, *(box(a, b, (z[0] + w if look.inside else z[1] - 0.03, z[1] + 1)) for a, b in hole)))
    for k in range(lids):
        part, x = named(m, "lid"), shrunk((k * wide / lids, (k + 1) * wide / lids), max(look.gap, 0.001))
        y = (-0.015, deep - back)
        m.add(part, slab(look, x, y, (z[1], z[1] + 0.03)) if m.chance(0.6) else bevelled(x, y, (z[1], z[1] + 0.03), 0.013, "z"))
        m.hinge(part, (middle(x), y[1], z[1] + 0.03), (-1, 0, 0), m.pick(70, 85))
    if back:
        m.add(BASE, box((0, wide), (deep - back + 0.002, deep), (z[1], z[1] + 0.03)))


def _hooks(m: Model, look: Look, wide: float, y: Span, low: float, columns: int) -> None:
    """A tall back with a row of hooks and a shelf on it."""
    tall = m.number(0.9, 1.4)
    m.add(
        BASE,
        slab(look, (0, wide), y, (low - 0.03, low + tall), "y")
        if look.way != "sheet"
        else box((0, wide), y, (low, low + tall)),
    )
    m.add(BASE, box((0.02, wide - 0.02), (y[0] - 0.012, y[0] + 0.001), (low + 0.8 * tall, low + 0.8 * tall + 0.09)))
    for k in range(2 * columns):
        at = vec(wide * (k + 0.5) / (2 * columns), y[0] - 0.011, low + 0.8 * tall + 0.05)
        m.add(BASE, tube([at, at + vec(0, -0.04, -0.01), at + vec(0, -0.06, 0.03)], 0.005, 6))
    if m.chance(0.5):
        m.add(BASE, box((0, wide), (y[0] - 0.2, y[1]), (low + tall, low + tall + 0.02)))
