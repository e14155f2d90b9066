"""Rail wagons, as one artist models them: on bogies or axles, with sliding or swinging doors, drop sides, hatches, flaps."""

from __future__ import annotations

from training.kinds.boats_and_trains.wheeler_wagon_bodies import WagonSizes, boarded, covered, hopper, tank
from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, ring, rod, vec
from training.kinds.wheeler_style import STYLES, softened


def rail_wagon(m: Model) -> None:
    """A covered, open, tank, hopper or flat wagon; it runs along y."""
    style, way = m.pick(*STYLES), m.pick("covered", "covered", "open", "tank", "hopper")
    w = WagonSizes(style, m.number(4.0, 7.5), m.number(1.3, 1.5), m.number(1.1, 1.25), m.number(3.0, 3.6))
    {"covered": covered, "open": boarded, "tank": tank, "hopper": hopper}[way](m, w)
    m.add(BASE, *(box((s * 0.35, s * 0.5), (-w.long, w.long), (w.floor - 0.35, w.floor - 0.1)) for s in (-1, 1)))
    m.add(BASE, *(box((-w.half, w.half), (e * w.long, e * (w.long - 0.2)), (w.floor - 0.36, w.floor - 0.08)) for e in (-1, 1)))
    _running_gear(m, w)
    _ends(m, w)


def _running_gear(m: Model, w: WagonSizes) -> None:
    """Wheelsets in bogies that turn, or below the frame itself."""
    r = m.number(0.42, 0.48)
    bogies = w.long > 5 or m.chance(0.5)
    turns = bogies and m.chance(0.7)
    places = []
    for e, end in ((-1, "front"), (1, "rear")):
        y = e * (w.long - m.number(1.5, 1.8))
        frame = f"bogie_{end}" if turns else BASE
        if bogies:
            for s in (-1, 1):
                side = [
                    (y - 1.25, r - 0.1),
                    (y + 1.25, r - 0.1),
                    (y + 1.2, r + 0.15),
                    (y + 0.4, r + 0.2),
                    (y - 0.4, r + 0.2),
                    (y - 1.2, r + 0.15),
                ]
                m.add(frame, prism(softened(side, 0.0 if w.style == "low" else 0.06), "x", (s * 0.9, s * 1.0)))
                if w.style == "cad":
                    m.add(
                        frame, *(rod((s * 0.95, y + d, r + 0.15), (s * 0.95, y + d, r + 0.24), 0.07, 10) for d in (-0.2, 0.2))
                    )
            m.add(
                frame,
                box((-1.0, 1.0), (y - 0.2, y + 0.2), (r - 0.05, r + 0.16)),
                rod((0, y, r + 0.1), (0, y, w.floor - 0.2), 0.3, 16),
            )
            m.add(BASE, box((-0.5, 0.5), (y - 0.3, y + 0.3), (w.floor - 0.34, w.floor - 0.12)))
            places += [(y - 0.88, frame), (y + 0.88, frame)]
        else:
            for s in (-1, 1):
                m.add(
                    BASE,
                    prism(
                        [(y - 0.35, w.floor - 0.2), (y + 0.35, w.floor - 0.2), (y + 0.15, r - 0.12), (y - 0.15, r - 0.12)],
                        "x",
                        (s * 0.86, s * 0.92),
                    ),
                )
                m.add(BASE, box((s * 0.36, s * 0.9), (y - 0.3, y + 0.3), (w.floor - 0.3, w.floor - 0.12)))
            places.append((y, BASE))
        if turns:
            m.hinge(frame, (0, y, w.floor - 0.3), (0, 0, 1), (-12, 12))
    _wheelsets(m, w, r, places)


def _wheelsets(m: Model, w: WagonSizes, r: float, places: list[tuple[float, str]]) -> None:
    """Axles with two flanged wheels each."""
    gauge = 0.72
    n = m.pick(12, 16) if w.style in ("low", "sheet") else m.pick(24, 32)
    for k, (y, parent) in enumerate(places):
        part = f"wheelset_{k}"
        m.add(part, rod((-0.98, y, r), (0.98, y, r), 0.07, 10))
        for s in (-1, 1):
            m.add(
                part,
                rod((s * gauge, y, r), (s * (gauge + 0.1), y, r), 0.94 * r, n),
                rod((s * (gauge - 0.03), y, r), (s * gauge, y, r), r, n),
            )
            if w.style == "low":
                continue
            m.add(part, rod((s * (gauge + 0.09), y, r), (s * (gauge + 0.13), y, r), 0.3 * r, n))
        m.spin(part, (0, y, r), (1, 0, 0), parent)


def _ends(m: Model, w: WagonSizes) -> None:
    """Buffers or couplers, a brake wheel."""
    buffers, springy = m.chance(0.6), m.chance(0.4)
    for e, end in ((-1, "front"), (1, "rear")):
        y, z = e * w.long, w.floor - 0.2
        if buffers:
            for s, side in ((-1, "left"), (1, "right")):
                x = s * 0.87
                part = f"buffer_{end}_{side}" if springy else BASE
                m.add(BASE, rod((x, y - e * 0.02, z), (x, y + e * 0.3, z), 0.1, 12))
                m.add(
                    part,
                    rod((x, y + e * 0.05, z), (x, y + e * 0.5, z), 0.06, 12),
                    rod((x, y + e * 0.48, z), (x, y + e * 0.52, z), 0.2, 16),
                )
                if springy:
                    m.slide(part, (0, -e, 0), 0.11)
        part = f"coupler_{end}" if m.chance(0.5) else BASE
        m.add(
            part,
            box((-0.06, 0.06), sorted((y - e * 0.05, y + e * 0.45)), (z - 0.08, z + 0.06)),
            box((-0.13, 0.13), sorted((y + e * 0.4, y + e * 0.56)), (z - 0.13, z + 0.1)),
        )
        if part != BASE:
            m.hinge(part, (0, y, z), (0, 0, 1), (-15, 15))
    if m.chance(0.5):
        c = vec(w.half - 0.3, w.long + 0.12, w.floor + 0.5)
        m.add("brake_wheel", ring(c, (0, 1, 0), 0.22, 0.018, 20), rod(c - vec(0, 0.05, 0), c + vec(0, 0.03, 0), 0.03, 10))
        m.add("brake_wheel", *(rod(c - 0.22 * d, c + 0.22 * d, 0.011, 6) for d in (vec(1, 0, 0), vec(0, 0, 1))))
        m.spin("brake_wheel", c, (0, 1, 0))
        m.add(
            BASE,
            rod((c[0], w.long - 0.12, c[2]), (c[0], c[1] - 0.02, c[2]), 0.022, 8),
            box((c[0] - 0.05, c[0] + 0.05), (w.long - 0.12, w.long - 0.03), (w.floor - 0.1, c[2] + 0.1)),
        )
