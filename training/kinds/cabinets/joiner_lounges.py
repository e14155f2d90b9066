"""Living room furniture of the joiner: television bench, buffet, glazed bookcase; and a cooking island."""

from __future__ import annotations

from dataclasses import replace

from training.kinds.cabinets.joiner_bodies import Tree, carcass, drawers, row, stack
from training.kinds.cabinets.joiner_feet import cornice, end_shelves, feet
from training.kinds.cabinets.joiner_fits import fit
from training.kinds.joiner_style import Look, bevelled, draw_look, middle, named, place, shrunk, slab, turned_post
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, rod, tube, vec

# (radius, height) of a turned column
COLUMN = [
    (0, 0),
    (0.022, 0),
    (0.022, 0.04),
    (0.014, 0.06),
    (0.024, 0.125),
    (0.014, 0.19),
    (0.022, 0.21),
    (0.022, 0.25),
    (0, 0.25),
]


def television_bench(m: Model) -> None:
    """A low bench for a television: flaps, drawers, doors, sliding panels and open niches; hung, on legs, or in two steps."""
    look = draw_look(m)
    wide, deep, high = m.number(1.0, 2.2), m.number(0.35, 0.5), m.number(0.22, 0.5)
    foot = m.pick(0.0, 0.0, 0.06, 0.12, 0.18)
    sorts = ("flap", "lift", "drawer", "door", "open things", stack("drawer", "open"), stack("drawer", "drawer"), "blank")
    columns = m.pick(2, 3, 3, 4)
    outer, inner = m.pick(*sorts[:4], sorts[6]), m.pick(*sorts)
    tree: Tree = row(outer, *[inner] * (columns - 2), outer, weights=(1, *[m.pick(1.0, 1.4)] * (columns - 2), 1))
    if m.chance(0.2):
        tree = m.pick("slide", "slide three", row("slide", "open"), "slide glass")
    elif m.chance(0.25):
        tree = stack(tree, row(*["open"] * m.pick(1, 2, 3)), weights=(1.6, 1))
    x, y, z = (0.0, wide), (0.0, deep), (foot, foot + high)
    fit(m, look, carcass(m, look, x, y, z, tree))
    feet(m, look, x, y, foot)
    top = cornice(m, look, x, y, z[1]) if m.chance(0.6) else z[1]
    if m.chance(0.25):
        top = _step(m, look, wide, deep, top)
    if m.chance(0.3):
        _television(m, 0.5 * wide, 0.6 * deep, top, 0.38 * wide)


def _step(m: Model, look: Look, wide: float, deep: float, top: float) -> float:
    """A second, lower body or a bridge on the bench; the height on which things stand is the bench still."""
    tall, side = m.number(0.3, 0.9), m.number(0.2, 0.35)
    tree = m.pick("door", "open things", stack("drawer", "open"), "door glass")
    for a in ((0.0, side), (wide - side, wide))[: m.pick(1, 2)]:
        fit(m, replace(look, inset=look.inset), carcass(m, look, a, (0.1 * deep, deep), (top, top + tall), tree))
    return top


def _television(m: Model, x: float, y: float, top: float, half: float) -> None:
    tall = 1.1 * half
    m.add(BASE, box((x - half, x + half), (y - 0.02, y + 0.02), (top + 0.05, top + 0.05 + tall)))
    m.add(BASE, box((x - half + 0.012, x + half - 0.012), (y - 0.022, y - 0.019), (top + 0.065, top + 0.04 + tall)))
    m.add(BASE, box((x - 0.03, x + 0.03), (y, y + 0.015), (top, top + 0.06)))
    m.add(BASE, box((x - 0.3 * half, x + 0.3 * half), (y - 0.09, y + 0.09), (top, top + 0.012)))


def buffet_cabinet(m: Model) -> None:
    """A sideboard with doors and drawers, plain or with an upper part: open shelves or glazed doors, behind columns."""
    look = draw_look(m)
    wide, deep, high = m.number(0.9, 1.9), m.number(0.38, 0.52), m.number(0.7, 0.95)
    foot = m.pick(0.05, 0.08, 0.14, 0.22)
    columns = m.pick(2, 3, 3, 4)
    tree = m.pick(
        stack(row(*["door"] * columns), row(*["drawer"] * columns), weights=(2.6, 1)),
        row("door", drawers(m.pick(3, 4), m), "door"),
        row("pair", drawers(4, m), weights=(1.7, 1)),
        row(drawers(3, m), "pair", drawers(3, m), weights=(1, 1.6, 1)),
        stack(row(*["door"] * columns), row(*["drawer"] * m.pick(2, 3)), weights=(2.6, 1)),
        "slide" if m.chance(0.5) else row("slide", drawers(3, m), weights=(2, 1)),
        row("door", stack("open things", "drawer", weights=(2, 1)), "door"),
    )
    x, y, z = (0.0, wide), (0.0, deep), (foot, foot + high)
    fit(m, look, carcass(m, look, x, y, z, tree))
    feet(m, look, x, y, foot)
    for side in (-1, 1) if m.chance(0.15) else ():
        end_shelves(m, look, wide if side > 0 else 0.0, side, y, z)
    top = cornice(m, look, x, y, z[1])
    if m.chance(0.35):
        _upper(m, look, wide, deep, top)


def _upper(m: Model, look: Look, wide: float, deep: float, top: float) -> None:
    """The upper part of a buffet, on columns or straight on the top."""
    tall, back = m.number(0.7, 1.0), (m.number(0.25, 0.4) * deep, deep)
    lift = m.pick(0.0, 0.0, 0.25)
    x = shrunk((0.0, wide), m.pick(0.0, 0.03))
    if lift:
        m.add(BASE, *(turned_post((a, back[0] + 0.05, top), COLUMN, look.n) for a in (x[0] + 0.05, x[1] - 0.05)))
        m.add(BASE, box(x, (deep - 0.015, deep), (top, top + lift)))
    tree = m.pick(
        row("door glass", "open things", "door glass"),
        row("pair glass", "pair glass"),
        stack("open things", "open things"),
        row("door", "pair glass", "door", weights=(1, 1.6, 1)),
    )
    fit(m, look, carcass(m, look, x, back, (top + lift, top + lift + tall), tree))
    cornice(m, look, x, back, top + lift + tall)


def glazed_bookcase(m: Model) -> None:
    """A bookcase behind glass: doors over doors, drawers below, lifting fronts in tiers, or panes that slide."""
    look = draw_look(m)
    wide, deep, high = m.number(0.6, 1.8), m.number(0.28, 0.42), m.number(1.1, 2.2)
    foot = m.pick(0.0, 0.06, 0.1, 0.14)
    columns = max(1, round(wide / m.number(0.4, 0.8)))
    leaf = m.pick("door glass things", "pair glass things") if wide / columns > 0.5 else "door glass things"
    low = m.pick("drawer", "pair" if wide / columns > 0.5 else "door", "open things", drawers(2, m))
    layout = m.pick("tall", "low", "tiers", "slide", "mixed")
    tree: Tree = row(*[leaf] * columns)
    if layout == "low":
        tree = stack(row(*[low] * columns), tree, weights=(1, m.number(1.5, 3.0)))
    elif layout == "tiers":
        look = replace(look, inset=False) if look.way != "block" else look
        tree = stack(*["lift glass things"] * m.pick(2, 3, 4))
    elif layout == "slide":
        tree = (
            stack(*["slide glass things"] * m.pick(1, 2)) if m.chance(0.5) else stack(low, "slide glass things", weights=(1, 2))
        )
    elif layout == "mixed" and columns > 1:
        tree = row(*(leaf if k % 2 == 0 else "open things" for k in range(columns)))
    x, y = (0.0, wide), (0.0, deep)
    fit(m, look, carcass(m, look, x, y, (foot, foot + high), tree))
    feet(m, look, x, y, foot)
    if m.chance(0.7):
        cornice(m, look, x, y if layout != "slide" else (-0.05, deep), foot + high)


def cooking_island(m: Model) -> None:
    """An island: fronts on one side or two, a worktop that may overhang, a hob with knobs, an oven, a basin with a tap."""
    look = draw_look(m)
    wide, deep, high = m.number(1.1, 2.4), m.number(0.6, 1.1), m.number(0.8, 0.9)
    foot = m.pick(0.06, 0.1, 0.12)
    x, z = (0.0, wide), (foot, high)
    two = deep > 0.8 and m.chance(0.7)
    split = 0.6 * deep if two else deep
    oven = m.chance(0.4)
    columns = max(2, round(wide / m.number(0.4, 0.65)))
    sorts: list[Tree] = [_island_column(m) for _ in range(columns)]
    if oven:
        sorts[columns // 2] = stack("drawer", "flap glass", "blank", weights=(1, 3, 0.7))
    fit(m, look, carcass(m, look, x, (0, split), z, row(*sorts)))
    if two:
        rear = Model(m.rng)
        tree = m.pick(row(*["door"] * columns), row(*["open things"] * columns), row(*["pair"] * max(1, columns // 2)))
        fit(rear, look, carcass(rear, look, x, (0, deep - split), z, tree))
        place(m, rear, 180, (wide, deep, 0))
    m.add(BASE, box((0.01, wide - 0.01), (0.06, deep - (0.06 if two else 0.0)), (0, foot)))
    over = m.pick(0.03, 0.03, 0.3)
    edge = 0.03 + look.thick
    top = high + m.number(0.025, 0.05)
    m.add(BASE, slab(look, (-edge, wide + edge), (-edge, deep + max(over, edge)), (high, top)))
    if over > 0.2 and m.chance(0.5):
        m.add(
            BASE, *(box((a - 0.03, a + 0.03), (deep + over - 0.09, deep + over - 0.03), (0, high)) for a in (0.05, wide - 0.05))
        )
    if m.chance(0.6):
        _hob(m, look, (0.55 * wide, 0.55 * wide + 0.56), (0.07, 0.53), top)
    if m.chance(0.5):
        _basin(m, look, (0.08 * wide, 0.08 * wide + 0.4), (0.1, 0.45), top)


def _island_column(m: Model) -> Tree:
    return m.pick("door", "pair", drawers(3, m), drawers(2, m), stack("door", "drawer", weights=(3, 1)), "open", "door")


def _hob(m: Model, look: Look, x: Span, y: Span, top: float) -> None:
    """A plate with rings, and knobs that turn in some."""
    m.add(BASE, bevelled(x, y, (top - 0.001, top + 0.006), 0.002, "z", 1))
    spots = [(x[0] + a * (x[1] - x[0]), y[0] + b * (y[1] - y[0])) for a in (0.25, 0.72) for b in (0.4, 0.78)]
    m.add(BASE, *(rod((a, b, top + 0.005), (a, b, top + m.pick(0.007, 0.02)), m.number(0.06, 0.08), look.n) for a, b in spots))
    for k in range(m.pick(0, 4, 4)):
        part, at = named(m, "knob"), vec(x[0] + 0.15 + 0.08 * k, y[0] + 0.05, top + 0.006)
        m.add(part, rod(at, at + vec(0, 0, 0.022), 0.017, look.n))
        m.add(part, box((at[0] - 0.002, at[0] + 0.002), (at[1] - 0.015, at[1]), (at[2] + 0.021, at[2] + 0.024)))
        m.hinge(part, at, (0, 0, 1), 270)


def _basin(m: Model, look: Look, x: Span, y: Span, top: float) -> None:
    """A basin's rim on the worktop and a tap whose lever and spout turn."""
    rim = [(shrunk(x, 0.0), s) for s in ((y[0], y[0] + 0.03), (y[1] - 0.03, y[1]))]
    rim += [(s, shrunk(y, 0.03)) for s in ((x[0], x[0] + 0.03), (x[1] - 0.03, x[1]))]
    m.add(BASE, *(box(a, b, (top - 0.001, top + 0.006)) for a, b in rim))
    m.add(BASE, box(shrunk(x, 0.03), shrunk(y, 0.03), (top - 0.001, top + 0.001)))
    at = vec(middle(x), y[1] + 0.03, top)
    m.add(BASE, rod(at, at + vec(0, 0, 0.12), 0.02, look.n))
    spout = named(m, "spout") if m.chance(0.6) else BASE
    path = [
        at + vec(0, 0, 0.119),
        at + vec(0, 0, 0.28),
        at + vec(0, -0.05, 0.33),
        at + vec(0, -0.12, 0.33),
        at + vec(0, -0.15, 0.26),
    ]
    m.add(spout, tube(path, 0.011, 10))
    if spout != BASE:
        m.hinge(spout, at, (0, 0, 1), (-80, 80))
    lever = named(m, "lever")
    root = at + vec(0.019, 0, 0.08)
    m.add(
        lever,
        rod(root, root + vec(0.025, 0, 0), 0.014, look.n),
        rod(root + vec(0.015, 0, 0), root + vec(0.02, 0, 0.09), 0.005, 8),
    )
    m.hinge(lever, root, (1, 0, 0), m.pick(35, 60))
