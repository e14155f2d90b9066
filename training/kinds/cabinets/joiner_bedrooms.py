"""Bedroom furniture of the joiner: closet, bedside unit, dressing desk with mirror, bed with drawers."""

from __future__ import annotations

from dataclasses import replace

from trimesh import Trimesh

from training.kinds.cabinets.joiner_bodies import Tree, carcass, drawers, row, stack
from training.kinds.cabinets.joiner_feet import cornice, end_shelves, feet, legs
from training.kinds.cabinets.joiner_fits import fit
from training.kinds.joiner_style import Look, bevelled, draw_look, middle, named, place, shrunk, slab, turned_post
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, box, prism, rectangle, rod, vec


def closet_unit(m: Model) -> None:
    """A wardrobe: columns of doors, drawers and open shelves, sliding panels, or folding doors; boxes above."""
    look = draw_look(m)
    wide, deep, high = m.number(0.8, 2.6), m.number(0.45, 0.65), m.number(1.7, 2.4)
    foot = m.pick(0.0, 0.06, 0.1, 0.14)
    layout = m.pick("columns", "columns", "columns", "sliding", "folding")
    if layout == "sliding":
        panes = m.pick("slide rail", "slide rail mirror", "slide rail three")
        tree: Tree = panes if m.chance(0.6) else stack(drawers(1, m), panes, weights=(1, 5))
    elif layout == "folding":
        tree = row(*["fold rail"] * max(1, round(wide / 0.9)))
    else:
        columns = [_closet_column(m, wide) for _ in range(max(1, round(wide / m.number(0.5, 0.95))))]
        tree = row(*(c if k or c != "open rail things" else "door rail" for k, c in enumerate(columns)))
    if m.chance(0.25) and high > 2.0:
        tree = stack(tree, row(*["pair"] * max(1, round(wide / 0.9))), weights=(4.5, 1))
    x, y = (0.0, wide), (0.0, deep)
    fit(m, look, carcass(m, look, x, y, (foot, high), tree))
    feet(m, look, x, y, foot)
    if m.chance(0.15):
        side = m.pick(-1, 1)
        end_shelves(m, look, wide if side > 0 else 0.0, side, y, (foot, high))
    if m.chance(0.6):
        cornice(m, look, x, y if layout != "sliding" else (-0.05, deep), high)


def _closet_column(m: Model, wide: float) -> Tree:
    mirror = m.pick("", "", "", " mirror")
    tall = "pair rail" if wide > 1.4 and m.chance(0.5) else "door rail" + mirror
    return m.pick(
        tall,
        tall,
        stack(drawers(m.pick(1, 2, 3), m), tall, weights=(1, 3)),
        stack("open", tall, weights=(1, 3)),
        stack(drawers(3, m), "open rail", weights=(1, 1.4)),
        "open rail things",
    )


def bedside_unit(m: Model) -> None:
    """A small cupboard beside a bed: drawers, a door, an open compartment, perhaps hung on a wall, with a lamp on it."""
    look = draw_look(m, 0.8)
    wide, deep, high = m.number(0.35, 0.6), m.number(0.3, 0.45), m.number(0.3, 0.65)
    foot = m.pick(0.0, 0.0, 0.05, 0.12, 0.18)
    tree = m.pick(
        drawers(m.pick(1, 2, 3), m),
        stack("open things", "drawer", weights=(1.5, 1)),
        stack("door", "drawer", weights=(2, 1)),
        stack("drawer", "open", "drawer"),
        row("door", drawers(3, m), weights=(1, 1.3)),
        stack("pair", "open", weights=(2, 1)),
    )
    x, y = (0.0, wide), (0.0, deep)
    z = (foot, foot + high * (1 if foot < 0.1 else 0.75))
    fit(m, look, carcass(m, look, x, y, z, tree))
    feet(m, look, x, y, foot)
    top = cornice(m, look, x, y, z[1]) if m.chance(0.7) else z[1]
    if m.chance(0.3):
        at = (m.number(0.3, 0.7) * wide, 0.5 * deep, top)
        shade = [(0.045, 0.16), (0.09, 0.16), (0.06, 0.3), (0.03, 0.3), (0.045, 0.16)]
        m.add(BASE, turned_post(at, [(0, 0), (0.06, 0), (0.055, 0.01), (0.012, 0.03), (0.01, 0.24), (0, 0.24)], look.n))
        m.add(BASE, turned_post(at, shade, look.n), rod(vec(*at) + vec(-0.06, 0, 0.2), vec(*at) + vec(0.06, 0, 0.2), 0.003, 6))
    if m.chance(0.2):
        m.add(BASE, slab(look, (0, wide), (deep - 0.015, deep), (top, top + m.number(0.05, 0.15)), "y"))


def vanity_desk(m: Model) -> None:
    """A dressing desk: drawers at one side or both, a mirror that tilts, wings that fold, or a lid with the mirror below."""
    look = draw_look(m, 0.8)
    wide, deep, high = m.number(0.8, 1.3), m.number(0.38, 0.5), m.number(0.72, 0.8)
    x, y = (0.0, wide), (0.0, deep)
    layout = m.pick("both", "left", "apron", "lid")
    belt = high - m.number(0.11, 0.16)
    if layout == "lid":
        _lidded(m, look, wide, deep, (belt, high))
        return
    if layout == "apron":
        fit(m, look, carcass(m, look, x, y, (belt, high), row(*["drawer"] * m.pick(1, 2, 3))))
        legs(m, look, x, y, (0, belt), m.number(0.035, 0.06))
    else:
        side = m.number(0.26, 0.36)
        for a, b in ((0.0, side), (wide - side, wide))[: 2 if layout == "both" else 1]:
            fit(
                m,
                look,
                carcass(m, look, (a, b), y, (0.06, high), m.pick(drawers(3, m), stack("door", "drawer", weights=(2.5, 1)))),
            )
            feet(m, look, (a, b), y, 0.06)
        if layout == "left":
            m.add(BASE, *(box((wide - 0.05, wide - 0.01), s, (0, belt)) for s in ((0.01, 0.05), (deep - 0.05, deep - 0.01))))
        fit(m, look, carcass(m, look, (side, wide - (side if layout == "both" else 0.0)), y, (belt, high), "drawer"))
    top = high + 0.022
    m.add(BASE, slab(look, shrunk(x, -0.015), (-0.025 - look.thick, deep), (high, top)))
    mirror = m.pick("tilting", "wings", "fixed", "round", "none")
    if mirror == "wings":
        _winged(m, wide, deep, top)
    elif mirror != "none":
        _mirror(m, look, mirror, wide, deep, top)


def _lidded(m: Model, look: Look, wide: float, deep: float, z: Span) -> None:
    """A desk with drawers at the sides and a lid in its middle that has the mirror below."""
    side = m.number(0.24, 0.32) * wide
    for x in ((0.0, side), (wide - side, wide)):
        fit(m, look, carcass(m, look, x, (0.0, deep), z, "drawer"))
    well = (side, wide - side)
    m.add(BASE, box(well, (0, deep), (z[0], z[0] + 0.012)))
    m.add(BASE, *(box(well, s, (z[0] + 0.012, z[1])) for s in ((0, 0.016), (deep - 0.016, deep))))
    legs(m, look, (0.0, wide), (0.0, deep), (0, z[0]), m.number(0.035, 0.06))
    top = (z[1], z[1] + 0.02)
    for x in ((-0.015, side), (wide - side, wide + 0.015)):
        m.add(BASE, slab(look, x, (-0.02, deep), top))
    part, x = named(m, "lid"), shrunk(well, max(look.gap, 0.001))
    m.add(part, slab(look, x, (-0.02, deep), top))
    m.add(part, box(shrunk(x, 0.04), (0.05, deep - 0.05), (z[1] - 0.004, z[1] + 0.001)))
    m.hinge(part, (wide / 2, deep, top[1]), (-1, 0, 0), m.pick(85, 95))


def _mirror(m: Model, look: Look, sort: str, wide: float, deep: float, top: float) -> None:
    """One mirror between posts or at the wall; the first of these tilts."""
    half, tall = m.number(0.2, 0.3) * wide, m.number(0.45, 0.7)
    cx, y = wide / 2, deep - 0.06
    a, b = (cx - half, cx + half), (top + 0.03, top + 0.03 + tall)
    frame = arch(a, b, 0.3 * half) if sort != "fixed" else rectangle(a, b)
    part = named(m, "mirror") if sort == "tilting" else BASE
    m.add(part, prism(frame, "y", (y, y + 0.018)), prism(frame.buffer(-0.03), "y", (y - 0.003, y + 0.001)))
    if sort == "tilting":
        middle_z = middle(b)
        for s in (-1, 1):
            px = cx + s * (half + 0.02)
            m.add(BASE, box((px - 0.012, px + 0.012), (y, y + 0.024), (top, middle_z + m.number(0.04, 0.2))))
            m.add(
                part, rod((cx + s * (half - 0.004), y + 0.009, middle_z), (px - 0.007 * s, y + 0.009, middle_z), 0.006, look.n)
            )
        m.hinge(part, (cx, y + 0.009, middle_z), (1, 0, 0), (-20, 20))
    else:
        m.add(BASE, box((cx - 0.6 * half, cx + 0.6 * half), (y, y + 0.03), (top, top + 0.05)))


def _winged(m: Model, wide: float, deep: float, top: float) -> None:
    """A fixed mirror with two wings on hinges."""
    half, tall, y = m.number(0.15, 0.2) * wide, m.number(0.5, 0.7), deep - 0.03
    z = (top, top + tall)
    spans = (
        (wide / 2 - half, wide / 2 + half),
        (wide / 2 - 1.9 * half, wide / 2 - half),
        (wide / 2 + half, wide / 2 + 1.9 * half),
    )
    for k, span in enumerate(spans):
        part = BASE if k == 0 else named(m, "mirror")
        a, b = shrunk(span, 0.001), (z if k == 0 else (z[0] + 0.004, z[1] - m.pick(0.0, 0.08)))
        pane = box(shrunk(a, 0.02), (y - 0.002, y + 0.001), shrunk(b, 0.02))
        m.add(part, box(a, (y, y + 0.016), b), pane)
        if k:
            m.hinge(part, (span[1 if k == 1 else 0], y, middle(b)), (0, 0, 1 if k == 1 else -1), m.pick(45, 70))


def drawer_bed(m: Model) -> None:
    """A bed with drawers or doors in its sides or at its foot, under a mattress; a headboard of several sorts."""
    look = draw_look(m)
    look = replace(look, pull="none" if look.pull == "lip" else look.pull)
    wide, long, base = m.number(0.9, 1.8), m.number(1.9, 2.1), m.number(0.26, 0.42)
    foot = m.pick(0.0, 0.04, 0.08)
    count, rows = m.pick(1, 2, 2, 3), m.pick(1, 1, 2)
    sides = m.pick("left", "both", "foot", "both")
    column: Tree = stack(*["drawer"] * rows) if m.chance(0.8) else "pair"
    tree = row(*[column] * count, *(["open"] if m.chance(0.3) else []))
    if sides == "foot":
        fit(m, look, carcass(m, look, (0, wide), (0, long), (foot, base), row(*["drawer"] * m.pick(1, 2))))
        cells_x = (0.0, wide)
    else:
        depth = wide / 2 if sides == "both" else wide
        for angle, at in ((-90, (0, long, 0)), (90, (wide, 0, 0)))[: 2 if sides == "both" else 1]:
            half = Model(m.rng)
            fit(half, look, carcass(half, look, (0, long), (0, depth), (foot, base), tree))
            place(m, half, angle, at)
        cells_x = (0.0, wide)
    feet(m, look, shrunk(cells_x, 0.05), (0.05, long - 0.05), foot, m.pick("plinth", "blocks"))
    thick = m.number(0.16, 0.26)
    m.add(
        BASE,
        bevelled((0.02, wide - 0.02), (0.02, long - 0.02), (base, base + thick), 0.05, "z", 4 if look.way != "prop" else 1),
    )
    m.add(BASE, *_headboard(m, look, wide, long, base + thick))
    if m.chance(0.3) and sides != "foot":
        m.add(BASE, slab(look, (-0.02, wide + 0.02), (-0.04, 0.0), (0, base + m.number(0.0, 0.3)), "y"))
    for k in range(m.pick(0, 1, 2)):
        x = (0.08, wide / 2 - 0.02) if k == 0 else (wide / 2 + 0.02, wide - 0.08)
        m.add(BASE, bevelled(x, (long - 0.48, long - 0.06), (base + thick - 0.01, base + thick + 0.11), 0.05, "z", 3))


def _headboard(m: Model, look: Look, wide: float, long: float, level: float) -> list[Trimesh]:
    """A slab, posts with slats, padded fields, or nothing."""
    x, y = (-0.02, wide + 0.02), (long, long + 0.05)
    tall = level + m.number(0.25, 0.6)
    sort = m.pick("slab", "slats", "padded", "arch", "none")
    if sort == "slab":
        return [slab(look, x, y, (0, tall), "y")]
    if sort == "arch":
        return [prism(arch(x, (0, tall), 0.25), "y", y)]
    if sort == "padded":
        fields = m.pick(2, 3, 5)
        step = (wide + 0.04) / fields
        pads: list[Span] = [(x[0] + k * step, x[0] + (k + 1) * step) for k in range(fields)]
        return [
            box(x, (long + 0.02, y[1]), (0, tall)),
            *(bevelled(p, (long, long + 0.022), (0.3, tall - 0.01), 0.018) for p in pads),
        ]
    if sort == "slats":
        posts = [box(s, y, (0, tall)) for s in ((x[0], x[0] + 0.05), (x[1] - 0.05, x[1]))]
        rails = [box(shrunk(x, 0.05), shrunk(y, 0.01), s) for s in ((level - 0.1, level - 0.04), (tall - 0.08, tall - 0.02))]
        bars = [
            box((a - 0.015, a + 0.015), shrunk(y, 0.017), (level - 0.05, tall - 0.07))
            for a in (x[0] + (x[1] - x[0]) * k / 10 for k in range(1, 10))
        ]
        return [*posts, *rails, *bars]
    return []
