"""House windows by another hand: casement, awning, hopper, double hung and sliding sashes, with or without their wall."""

from __future__ import annotations

from trimesh import Trimesh

from training.kinds.game_style import Look, look
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, box, cut, prism, rectangle, rod


def wall_window(m: Model) -> None:
    """A window of one convention: one to three openings, each with a fixed pane or a sash that swings or slides."""
    a = look(m)
    half, tall, deep = m.number(0.3, 0.9), m.number(0.6, 1.6), m.number(0.04, 0.09)
    low, edge = m.pick(0.0, m.number(0.6, 0.9)), m.number(0.03, 0.07)
    style = m.pick("casement", "casement", "awning", "hung", "slider", "mixed")
    if style == "hung":
        half = min(half, 0.6)
    span, rise = (-half, half), (low, low + tall)
    _surround(a, span, rise, deep, edge)
    inner = ((-half + edge, half - edge), (low + edge, low + tall - edge))
    if style == "hung":
        _hung(a, *inner, deep)
    elif style == "slider":
        _slider(a, *inner, deep)
    else:
        _swinging(a, *inner, deep, edge, style)


def _surround(a: Look, x: Span, z: Span, deep: float, edge: float) -> None:
    """Frame, sill, perhaps trim and a piece of wall."""
    m = a.m
    frame = rectangle(x, z, edge)
    y = (-deep, deep)
    if a.way == "cad":
        a.put(BASE, *(box((s * x[1], s * (x[1] - edge)), y, z) for s in (-1, 1)))
        inner = (x[0] + edge, x[1] - edge)
        a.put(BASE, box(inner, y, (z[0], z[0] + edge)), box(inner, y, (z[1] - edge, z[1])))
        corners = [(u * (x[1] - edge / 2), v) for u in (-1, 1) for v in (z[0] + edge / 2, z[1] - edge / 2)]
        a.put(BASE, *(rod((u, -deep - 0.004, v), (u, -deep + 0.004, v), 0.006, 6) for u, v in corners))
    else:
        a.put(BASE, prism(frame, "y", y))
    if a.way != "sheet" or m.chance(0.5):
        a.put(
            BASE, a.block((x[0] - 0.04, x[1] + 0.04), (-deep - m.number(0.03, 0.1), -deep + 0.01), (z[0] - 0.03, z[0] + 0.005))
        )
    if m.chance(0.45):
        wall = rectangle((x[0] - m.number(0.2, 0.6), x[1] + m.number(0.2, 0.6)), (z[0] - 0.3, z[1] + 0.3))
        thick = m.number(0.8, 1.6) * deep
        solid = prism(wall.difference(rectangle(x, z)), "y", (-0.8 * deep, -0.8 * deep + 2 * thick))
        a.put(BASE, a.panel(solid, (0, -1, 0)))
    if a.way == "old":
        head = arch((x[0] - 0.08, x[1] + 0.08), (z[1], z[1] + 0.18), m.number(0.06, 0.17))
        a.put(
            BASE,
            prism(head, "y", (-deep - 0.02, deep)),
            *(box((s * x[1], s * (x[1] + 0.07)), (-deep - 0.02, deep), z) for s in (-1, 1)),
        )


def _sash(a: Look, x: Span, z: Span, y: Span, bars: tuple[int, int]) -> list[Trimesh]:
    """A frame with a pane and glazing bars; a single sheet or a board where this artist takes the short way."""
    m = a.m
    wide = min(m.number(0.03, 0.07), 0.2 * (x[1] - x[0]), 0.2 * (z[1] - z[0]))
    if a.way == "sheet" and bars == (0, 0):
        return [a.panel(box(x, y, z), (0, -1, 0))]
    mid = (y[0] + y[1]) / 2
    if a.way == "sunk":
        board = box(x, y, z)
        hollow = rectangle((x[0] + wide, x[1] - wide), (z[0] + wide, z[1] - wide))
        return [cut(board, prism(hollow, "y", (y[0] - 1, mid - 0.003)), prism(hollow, "y", (mid + 0.003, y[1] + 1)))]
    found = [prism(rectangle(x, z, wide), "y", y)]
    if a.way != "low" or m.chance(0.6):
        found.append(
            box((x[0] + 0.9 * wide, x[1] - 0.9 * wide), (mid - 0.003, mid + 0.003), (z[0] + 0.9 * wide, z[1] - 0.9 * wide))
        )
    near, far = mid - 0.4 * (mid - y[0]), mid + 0.4 * (mid - y[0])
    for k in range(bars[0]):
        at = x[0] + (k + 1) * (x[1] - x[0]) / (bars[0] + 1)
        found.append(box((at - 0.01, at + 0.01), (near, far), (z[0] + 0.9 * wide, z[1] - 0.9 * wide)))
    for k in range(bars[1]):
        at = z[0] + (k + 1) * (z[1] - z[0]) / (bars[1] + 1)
        found.append(box((x[0] + 0.9 * wide, x[1] - 0.9 * wide), (near, far), (at - 0.01, at + 0.01)))
    return found


def _bars(a: Look) -> tuple[int, int]:
    return (
        a.m.pick((0, 0), (1, 1), (1, 2), (0, 1), (2, 3)) if a.way in ("old", "low", "cad") else a.m.pick((0, 0), (0, 0), (1, 1))
    )


def _hung(a: Look, x: Span, z: Span, deep: float) -> None:
    """Two sashes in two tracks; the upper one may be fixed."""
    m = a.m
    meet, gap, bars = z[0] + m.number(0.45, 0.6) * (z[1] - z[0]), max(0.0, m.gap(0.5)), _bars(a)
    thick, over = 0.8 * deep, m.number(0.01, 0.04)
    across = (x[0] + gap, x[1] - gap)
    a.put("lower_sash", *_sash(a, across, (z[0], meet + over), (0.02 * deep, thick), bars))
    m.slide("lower_sash", (0, 0, 1), 0.85 * (z[1] - meet - over))
    upper = "upper_sash" if m.chance(0.6) else BASE
    a.put(upper, *_sash(a, across, (meet - over, z[1]), (-thick, -0.02 * deep), bars))
    if upper != BASE:
        m.slide(upper, (0, 0, -1), 0.85 * (meet - over - z[0]))
    if m.chance(0.6):
        a.put(
            "lower_sash",
            *(
                box((s * 0.5 * x[1] - 0.03, s * 0.5 * x[1] + 0.03), (thick - 0.002, thick + 0.02), (z[0] + 0.01, z[0] + 0.025))
                for s in (-1, 1)
            ),
        )
    if a.way == "cad" and m.chance(0.5):
        a.put(
            "catch",
            rod((0, 0.5 * thick, meet + over), (0, 0.5 * thick, meet + over + 0.012), 0.018, 12),
            box((0, 0.06), (0.45 * thick, 0.75 * thick), (meet + over + 0.002, meet + over + 0.01)),
        )
        m.hinge("catch", (0, 0.5 * thick, meet + over), (0, 0, -1), 120, "lower_sash")


def _slider(a: Look, x: Span, z: Span, deep: float) -> None:
    """Two or three sashes beside each other in tracks; one of them may be fixed."""
    m = a.m
    count, bars = m.pick(2, 2, 3), _bars(a)
    wide, over, thick = (x[1] - x[0]) / count, m.number(0.0, 0.03), 0.8 * deep
    fixed = m.pick(-1, 0, count - 1)
    for k in range(count):
        part = BASE if k == fixed and count == 2 else f"sash_{k}"
        track = (0.02 * deep, thick) if k % 2 else (-thick, -0.02 * deep)
        across = (x[0] + k * wide - over * (k > 0), x[0] + (k + 1) * wide + over * (k < count - 1))
        a.put(part, *_sash(a, across, (z[0] + 0.002, z[1] - 0.002), track, bars))
        if part == BASE:
            continue
        side = 1 if k == 0 else -1
        m.slide(part, (side, 0, 0), m.number(0.7, 0.92) * wide)
        at = across[0] + 0.02 if side > 0 else across[1] - 0.02
        if m.chance(0.6):
            a.put(
                part,
                box((at - 0.008, at + 0.008), (track[1] - 0.002, track[1] + 0.015), (sum(z) / 2 - 0.08, sum(z) / 2 + 0.08)),
            )


def _swinging(a: Look, x: Span, z: Span, deep: float, edge: float, style: str) -> None:
    """Sashes on hinges beside and above each other."""
    m = a.m
    count = m.pick(1, 2, 2, 3) if x[1] - x[0] > 0.7 else m.pick(1, 1, 2)
    above = style == "mixed" and z[1] - z[0] > 0.7
    top = z[1] - m.number(0.25, 0.35) * (z[1] - z[0]) if above else z[1]
    mullion = m.pick(0.0, edge) if count == 2 and style == "casement" and not above else edge
    wide, bars, inward = (x[1] - x[0] + mullion) / count, _bars(a), m.chance(0.4)
    if above:
        a.put(BASE, box(x, (-deep, deep), (top - edge / 2, top + edge / 2)))
        _leaf(a, "vent", x, (top + edge / 2, z[1]), deep, "awning", (0, 0), False)
    for k in range(count):
        left = x[0] + k * wide
        if k and mullion:
            a.put(BASE, box((left - mullion, left), (-deep, deep), (z[0], top - edge / 2 * above)))
        across = (left, left + wide - mullion)
        kind = (
            "awning" if style == "awning" else m.pick("casement", "casement", "casement", "fixed") if count == 3 else "casement"
        )
        side = "left" if k < count / 2 else "right"
        if count == 3 and k == 1 and not above:
            kind = "casement"
        rise = (z[0], top - edge / 2 * above)
        if kind == "fixed":
            a.put(BASE, *_sash(a, across, rise, (-0.7 * deep, 0.2 * deep), bars))
        else:
            _leaf(
                a,
                f"sash_{k}",
                across,
                rise,
                deep,
                m.pick("awning", "hopper") if kind == "awning" and inward else kind + side * (kind == "casement"),
                bars,
                inward,
            )


def _leaf(a: Look, part: str, x: Span, z: Span, deep: float, kind: str, bars: tuple[int, int], inward: bool) -> None:
    """One sash with its hinge and handle."""
    m, gap = a.m, max(0.0008, a.m.gap(0.4))
    x, z = (x[0] + gap, x[1] - gap), (z[0] + gap, z[1] - gap)
    inward = (inward and kind != "awning") or kind == "hopper"
    y = (0.0, deep + 0.004) if inward else (-deep - 0.004, 0.0)
    a.put(part, *_sash(a, x, z, y, bars))
    face, out = (y[1], 1) if inward else (y[0], -1)
    mid = (sum(x) / 2, sum(z) / 2)
    if kind in ("awning", "hopper"):
        m.hinge(part, (mid[0], face, z[1] if kind == "awning" else z[0]), (-1, 0, 0), m.number(30, 75))
        grip = (mid[0], z[0] + 0.03 if kind == "awning" else z[1] - 0.03)
    else:
        s = -1 if kind.endswith("left") else 1
        m.hinge(part, (x[0] if s < 0 else x[1], face, mid[1]), (0, 0, -out * s), m.number(70, 160))
        grip = (x[1] - 0.02 if s < 0 else x[0] + 0.02, mid[1])
        if a.way in ("cad", "old"):
            at = x[0] if s < 0 else x[1]
            a.put(
                BASE,
                *(
                    rod((at, face + out * 0.003, h - 0.03), (at, face + out * 0.003, h + 0.03), 0.006, 8)
                    for h in (z[0] + 0.12, z[1] - 0.12)
                ),
            )
    _window_handle(a, part, grip, y[1])


def _window_handle(a: Look, part: str, at: tuple[float, float], inner: float) -> None:
    """A lever on the room side that turns, or a fixed grip, or none."""
    m = a.m
    choice = m.pick("turning", "fixed", "none")
    if choice == "none":
        return
    name = f"handle_{part}" if choice == "turning" else part
    plate = box((at[0] - 0.012, at[0] + 0.012), (inner - 0.001, inner + 0.006), (at[1] - 0.03, at[1] + 0.03))
    a.put(part, plate)
    a.put(
        name,
        rod((at[0], inner + 0.004, at[1]), (at[0], inner + 0.03, at[1]), 0.008, a.n),
        box((at[0] - 0.008, at[0] + 0.008), (inner + 0.024, inner + 0.036), (at[1] - 0.1, at[1] + 0.01)),
    )
    if name != part:
        m.hinge(name, (at[0], inner + 0.02, at[1]), (0, 1, 0), (0, m.pick(90, 90, 180)), part)
