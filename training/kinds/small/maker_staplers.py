"""Office staplers by another hand: on a desk, heavy with a lever, held like pliers."""

from __future__ import annotations

from shapely.geometry import LineString, Polygon
from trimesh import Trimesh

from training.kinds.maker_style import Maker, lathe, maker, soft, without
from training.kinds.model import Model
from training.kinds.solids import cut, prism, ring, rod, turned


def office_stapler(m: Model) -> None:
    """A stapler that opens about a pin behind, a heavy one with a lever, or one held like pliers."""
    k = maker(m)
    design, long = m.pick("desk", "desk", "heavy", "pliers"), m.number(0.1, 0.19)
    if design == "desk":
        _desk_stapler(k, long)
    elif design == "heavy":
        _heavy_stapler(k, 1.6 * long)
    else:
        _plier_stapler(k, long)


def _beam(k: Maker, profile: list[tuple[float, float]], half: float, wall: float = 0.0015) -> list[Trimesh]:
    """A profile in (y, z) as a bar: solid, a bent channel that is open below, sheets, or softly filled."""
    outline = Polygon(profile)
    solid = prism(outline, "x", (-half, half))
    if k.way == "sheet":
        return [without(solid, (0, 0, -1))]
    if k.way in ("cad", "old") and outline.area > 9e-5:
        inner = outline.buffer(-wall).union(LineString(profile[:1] + profile[-1:]).buffer(1.2 * wall)).buffer(0)
        return [cut(solid, prism(g, "x", (wall - half, half - wall))) for g in [inner] if g.geom_type == "Polygon"] or [solid]
    if k.way == "soft":
        low, high = (outline.buffer(s, quad_segs=3) for s in (-0.2 * half, 0.0))
        if low.geom_type == "Polygon" and not low.is_empty:
            return [prism(high, "x", (-0.75 * half, 0.75 * half)), prism(low, "x", (-half, half))]
    return [solid]


def _desk_stapler(k: Maker, long: float) -> None:
    """A foot, a rail for the staples and an arm on one pin."""
    m, half, rest = k.m, k.m.number(0.009, 0.014), k.m.pick(0.0, 4.0, 9.0)
    back, z = long - 0.018, m.number(0.014, 0.02)
    m.add("base", k.block((-1.15 * half, 1.15 * half), (-0.004, long), (0, 0.007)))
    m.add("base", k.block((-0.6 * half, 0.6 * half), (0.004, 0.02), (0.0065, 0.0082)))
    lugs = [[(back - 0.012, 0.006), (back + 0.012, 0.006), (back + 0.006, z + 0.005), (back - 0.006, z + 0.005)]]
    m.add("base", *(prism(p, "x", sorted((s * 1.02 * half, s * 1.14 * half))) for p in lugs for s in (-1, 1)))
    m.add(m.pick("base", "arm"), rod((-1.25 * half, back, z), (1.25 * half, back, z), 0.0026, k.n))
    rail = [(back + 0.006, z - 0.005), (back + 0.006, z + 0.002), (0.0, z + 0.003), (0.0, z - 0.005)]
    up, nose = m.number(0.012, 0.024), m.number(0.0, 0.02)
    top = [(back + 0.012, z + 0.0035), (0.001, z + 0.0035), (-0.004, z + 0.006), (-0.003, z + up - nose * 0.3)]
    top += [(nose + 0.01, z + up), (0.6 * long, z + 0.9 * up), (back + 0.013, z + 0.5 * up + 0.003)]
    opened = m.pick(45, 80, 120)
    spots = {"magazine": [*_beam(k, rail, 0.75 * half)], "arm": [*_beam(k, top, 0.98 * half)]}
    if k.way in ("low", "soft") and m.chance(0.5):
        spots["arm"].append(soft((-0.9 * half, 0.9 * half), (0.01, 0.5 * long), (z + 0.8 * up, z + up + 0.004), 0.003, 1))
    if k.way == "old":
        spots["arm"].append(
            lathe([(0.005, 0), (0.005, 0.01), (0.014, 0.014), (0.013, 0.02), (0.006, 0.024)], k.n).apply_translation(
                (0, 0.02, z + up - 0.002)
            )
        )
    for s in (-1, 1):
        spots["arm"].append(
            prism(
                [(back - 0.008, z - 0.004), (back + 0.012, z - 0.004), (back + 0.012, z + 0.006), (back - 0.008, z + 0.006)],
                "x",
                sorted((s * 0.8 * half, s * 0.98 * half)),
            )
        )
    for part, tilt in (("magazine", 0.5 * rest), ("arm", rest)):
        for solid in spots[part]:
            m.add(part, turned(solid, (-1, 0, 0), tilt, (0, back, z)))
    m.hinge("magazine", (0, back, z), (-1, 0, 0), (-0.4 * rest, 15))
    m.hinge("arm", (0, back, z), (-1, 0, 0), (-0.4 * rest, opened))


def _heavy_stapler(k: Maker, long: float) -> None:
    """A cast column with a long lever on top and a rail that pulls out."""
    m, half = k.m, k.m.number(0.012, 0.02)
    up = m.number(0.09, 0.13)
    m.add("base", k.block((-1.8 * half, 1.8 * half), (0, long), (0, 0.012)))
    column = [
        (0.3 * long, 0.035),
        (0.3 * long, 0.055),
        (0.62 * long, 0.06),
        (0.7 * long, up),
        (0.92 * long, up),
        (0.95 * long, 0.01),
        (0.7 * long, 0.01),
        (0.66 * long, 0.035),
    ]
    m.add("base", *([prism(column, "x", (-half, half))]))
    m.add("base", k.block((-half, half), (0.02, 0.32 * long), (0.045, 0.058)))
    m.add("magazine", k.block((-0.6 * half, 0.6 * half), (0.015, 0.6 * long), (0.033, 0.0448)))
    m.slide("magazine", (0, -1, 0), 0.3 * long)
    y, z = 0.86 * long, up + 0.004
    lever = [
        (y + 0.012, z - 0.002),
        (y + 0.012, z + 0.012),
        (0.3 * long, z + 0.03),
        (-0.05, z + 0.034),
        (-0.05, z + 0.02),
        (0.3 * long, z + 0.016),
    ]
    m.add("lever", prism(lever, "x", (-0.7 * half, 0.7 * half)))
    if m.chance(0.6):
        m.add("lever", k.block((-1.1 * half, 1.1 * half), (-0.07, 0.05), (z + 0.016, z + 0.04)))
    m.hinge("lever", (0, y, z), (1, 0, 0), m.pick(14, 18))
    m.add(
        "base",
        *(
            prism(
                [(y - 0.014, up - 0.02), (y + 0.014, up - 0.02), (y + 0.008, z + 0.008), (y - 0.008, z + 0.008)],
                "x",
                sorted((s * 0.75 * half, s * 1.1 * half)),
            )
            for s in (-1, 1)
        ),
    )
    m.add("base", rod((-1.3 * half, y, z), (1.3 * half, y, z), 0.004, k.n))
    if m.chance(0.6):
        m.add("guide", k.block((-1.7 * half, 1.7 * half), (0.4 * long, 0.42 * long), (0.0121, 0.03), (0, 1, 0)))
        m.slide("guide", (0, -1, 0), (-0.12 * long, 0.2 * long))


def _plier_stapler(k: Maker, long: float) -> None:
    """A handle with a head and a jaw below it; a grip above is squeezed about a pin over the nose."""
    m, half, z = k.m, k.m.number(0.007, 0.011), 0.046
    tail = m.number(1.1, 1.3) * long
    frame = [(-0.01, 0.0), (0.3 * long, 0.0), (0.45 * long, 0.012), (tail, -0.012), (tail, 0.002), (0.5 * long, 0.03)]
    frame += [(0.42 * long, z), (-0.01, z), (-0.01, 0.024), (0.3 * long, 0.024), (0.3 * long, 0.012), (-0.01, 0.008)]
    m.add("base", *([prism(frame, "x", (-half, half))]))
    grip = [(-0.012, z - 0.004), (-0.012, z + 0.01), (0.3 * long, z + 0.022), (tail, z + 0.045), (tail, z + 0.032)]
    grip += [(0.45 * long, z + 0.014), (0.1 * long, z + 0.001)]
    web = [
        (-0.012, z + 0.006),
        (-0.012, z + 0.01),
        (0.3 * long, z + 0.022),
        (tail, z + 0.045),
        (tail, z + 0.04),
        (0.3 * long, z + 0.017),
    ]
    m.add("grip", *(prism(grip, "x", sorted((s * 1.03 * half, s * 1.3 * half))) for s in (-1, 1)))
    m.add("grip", prism(web, "x", (-1.1 * half, 1.1 * half)))
    m.hinge("grip", (0, 0.0, z), (-1, 0, 0), m.pick(7, 9))
    m.add("base", rod((-1.5 * half, 0, z), (1.5 * half, 0, z), 0.003, k.n))
    if k.way in ("cad", "old"):
        m.add("base", *(ring((s * 1.4 * half, 0, z), (1, 0, 0), 0.005, 0.0015, 12) for s in (-1, 1)))
    if m.chance(0.6):
        m.add("magazine", k.block((-0.6 * half, 0.6 * half), (-0.004, 0.3 * long), (0.018, 0.0238)))
        m.slide("magazine", (0, -1, 0), 0.2 * long)
