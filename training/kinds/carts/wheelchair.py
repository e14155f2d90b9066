"""Wheelchairs."""

from __future__ import annotations

from training.kinds.joinery import alike
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, ring, rod, rounded, tube, turned, vec
from training.kinds.solids import prism as plate
from training.kinds.wheels import beam, caster, wheel_maker


def wheelchair(m: Model) -> None:
    """A wheelchair pushed by hand rims or by a helper: castors, footrests or a foot board, arms that fold, a leaning back."""
    half, deep, seat, n = m.number(0.2, 0.25), m.number(0.4, 0.45), m.number(0.46, 0.52), m.pick(8, 12, 16)
    small = m.chance(0.25)
    r = m.number(0.15, 0.18) if small else m.number(0.28, 0.32)
    axle, c = deep - (0.0 if small else m.number(0.0, 0.08)), m.number(0.06, 0.09)
    make = wheel_maker(m, ("spoked", "rim", "tyre", "disc") if small else ("spoked", "spoked", "rim"), 0.0)
    seed = int(m.rng.integers(1 << 30))
    for k, s in enumerate((-1, 1)):
        x, part = s * (half + 0.05), f"wheel_{k}"
        make(part, (x, axle, r), (s, 0, 0), r, 0.03)
        m.add(BASE, rod((s * (half - 0.01), axle, r), (x, axle, r), 0.012, 8))
        if not small:
            m.add(part, ring((x + s * 0.035, axle, r), (1, 0, 0), 0.88 * r, 0.008, 24))
            m.add(
                part,
                *(
                    rod(
                        (x, axle + 0.87 * r * a, r + 0.87 * r * b),
                        (x + s * 0.035, axle + 0.87 * r * a, r + 0.87 * r * b),
                        0.005,
                        6,
                    )
                    for a, b in ((1, 0), (-0.5, 0.87), (-0.5, -0.87))
                ),
            )
        caster(m, f"castor_{k}", (s * half, 0.06, 1.5 * c + c), c, True)
        _side(alike(m, seed), s, half, (deep, seat), (r, 2.5 * c), n)
    _seat_and_back(m, half, deep, seat, n)
    style = m.pick("hangers", "hangers", "fixed", "board")
    if style == "board":
        _foot_board(m, half, seat)
        return
    for k, s in enumerate((-1, 1)):
        _footrest(alike(m, seed), k, s, half, seat, style == "hangers")


def _side(m: Model, s: int, half: float, size: tuple[float, float], low: tuple[float, float], n: int) -> None:
    (deep, seat), (r, castor), t, x = size, low, 0.012, s * half
    m.add(BASE, rod((x, 0.0, seat), (x, deep, seat), t, n), rod((x, 0.02, castor + 0.06), (x, deep, castor + 0.06), t, n))
    m.add(
        BASE, rod((x, 0.02, castor + 0.06), (x, 0.02, seat), t, n), rod((x, 0.06, castor), (x, 0.06, castor + 0.08), 0.018, n)
    )
    m.add(BASE, rod((x, deep, min(r, castor) - 0.03), (x, deep, seat + 0.05), t, n))
    m.add(BASE, beam((x, deep - 0.1, r), (x, deep + 0.05, r), 0.01, 0.05))
    if m.chance(0.4):
        m.add(
            BASE,
            tube([(x, deep, 0.13), (x, deep + 0.16, 0.09), (x, deep + 0.2, 0.04)], 0.01, 6),
            ball((x, deep + 0.2, 0.03), (0.015, 0.025, 0.025), 8),
        )
    arm, y = seat + m.number(0.19, 0.24), (0.06, deep - 0.03)
    if m.chance(0.5):
        m.add(BASE, box((x - 0.004, x + 0.004), (y[0] + 0.02, y[1]), (seat, arm - 0.04)))
        m.add(
            BASE,
            rod((x, y[0] + 0.02, seat), (x, y[0] + 0.02, arm), 0.01, 8),
            box((x - 0.025, x + 0.025), (y[0], y[1]), (arm, arm + 0.03)),
        )
    else:
        part = f"arm_{(s + 1) // 2}"
        m.add(BASE, rod((x, deep, seat), (x, deep, arm), 0.011, 8), rod((x - 0.03, deep, arm), (x + 0.03, deep, arm), 0.016, n))
        m.add(part, tube([(x, deep, arm), (x, 0.06, arm), (x, 0.05, arm - 0.03), (x, 0.05, seat + 0.02)], 0.011, 8))
        m.add(part, box((x - 0.025, x + 0.025), (0.07, 0.3), (arm + 0.008, arm + 0.035)))
        m.hinge(part, (x, deep, arm), (-1, 0, 0), m.pick(90, 110))
    if m.chance(0.7) and r > 0.2:
        at, part = vec(x + s * 0.02, 0.1, seat - 0.06), f"brake_{(s + 1) // 2}"
        m.add(BASE, box((at[0] - 0.02, at[0] + 0.012), (0.08, 0.12), (at[2] - 0.03, seat)))
        m.add(
            part,
            beam(at, at + vec(s * 0.004, -0.03, 0.15), 0.008, 0.018),
            ball(at + vec(s * 0.004, -0.032, 0.16), (0.014, 0.014, 0.03), 8),
        )
        m.add(part, beam(at, at + vec(s * 0.02, 0.03, -0.02), 0.01, 0.015))
        m.hinge(part, at, (1, 0, 0), m.pick(30, 40))


def _seat_and_back(m: Model, half: float, deep: float, seat: float, n: int) -> None:
    if m.chance(0.5):
        m.add(
            BASE,
            plate(rounded((-half + 0.012, half - 0.012), (0.0, deep), 0.03), "z", (seat + 0.005, seat + m.pick(0.02, 0.06))),
        )
    else:
        m.add(BASE, box((-half, half), (0.0, deep - 0.01), (seat + 0.009, seat + 0.014)))
    if m.chance(0.7):
        m.add(
            BASE,
            *(
                beam((s * half, 0.25, seat - 0.02), (-s * half, 0.25 + s * 0.01, 0.22), 0.025, 0.015, (0, 1, 0))
                for s in (-1, 1)
            ),
        )
    m.add(BASE, rod((-half, deep - 0.03, 0.24), (half, deep - 0.03, 0.24), 0.011, n))
    style, tall, at = m.pick("fixed", "folds", "leans"), m.number(0.38, 0.5), vec(0, deep, seat + 0.05)
    part, lean, y = BASE if style == "fixed" else "back", m.number(3, 10), deep
    pieces = [box((-half + 0.01, half - 0.01), (y - 0.006, y + 0.004), (seat + 0.08, seat + tall))]
    for s in (-1, 1):
        pole = [
            (s * half, y, seat + 0.05),
            (s * half, y, seat + tall),
            (s * half, y + 0.03, seat + tall + 0.05),
            (s * half, y + 0.13, seat + tall + 0.05),
        ]
        pieces += [
            tube(pole, 0.012, 8),
            rod((s * half, y + 0.05, seat + tall + 0.05), (s * half, y + 0.15, seat + tall + 0.05), 0.016, n),
        ]
    if m.chance(0.4):
        pieces.append(box((-half + 0.02, half - 0.02), (y + 0.004, y + 0.05), (seat + 0.12, seat + 0.7 * tall)))
    m.add(part, *(turned(p, (-1, 0, 0), lean, at) for p in pieces))
    if style == "folds":
        m.hinge("back", at, (1, 0, 0), 80)
    elif style == "leans":
        m.hinge("back", at, (-1, 0, 0), m.pick(25, 40, 60))


def _footrest(m: Model, k: int, s: int, half: float, seat: float, swings: bool) -> None:
    """A hanger that swings out about its upright pin, with a plate that flips up."""
    x, part, low = s * half, f"footrest_{k}" if swings else BASE, m.number(0.1, 0.14)
    m.add(
        part,
        tube([(x, -0.02, seat - 0.02), (x, -0.1, seat - 0.04), (x * 0.95, -0.28, low + 0.06), (x * 0.95, -0.3, low)], 0.012, 8),
    )
    m.add(
        part,
        rod((x, -0.03, seat - 0.16), (x, -0.03, seat - 0.01), 0.013, 8),
        beam((x, -0.03, seat - 0.14), (x, -0.14, seat - 0.14), 0.012, 0.012),
    )
    m.add(BASE, *(box((x - 0.012, x + 0.012), (-0.04, 0.03), (z - 0.012, z + 0.012)) for z in (seat - 0.18, seat - 0.0)))
    if swings:
        m.hinge(part, (x, -0.03, seat - 0.09), (0, 0, s), m.pick(70, 90))
    y, inner = -0.3, 0.015
    m.add(f"footplate_{k}", box(sorted((x * 0.95, s * inner)), (y - 0.08, y + 0.09), (low - 0.012, low + 0.004)))
    m.add(f"footplate_{k}", rod((x * 0.95, y - 0.05, low), (x * 0.95, y + 0.05, low), 0.016, 8))
    m.hinge(f"footplate_{k}", (x * 0.95, y, low), (0, s, 0), m.pick(80, 90), part)


def _foot_board(m: Model, half: float, seat: float) -> None:
    low, x = m.number(0.1, 0.14), half - 0.02
    for s in (-1, 1):
        m.add(
            BASE,
            tube(
                [(s * half, 0.0, seat), (s * half, -0.06, seat - 0.05), (s * x, -0.2, low + 0.05), (s * x, -0.22, low)],
                0.012,
                8,
            ),
        )
    m.add(
        "foot_board",
        box((-x + 0.014, x - 0.014), (-0.34, -0.2), (low - 0.01, low + 0.006)),
        rod((-x, -0.21, low), (x, -0.21, low), 0.009, 8),
    )
    m.hinge("foot_board", (0, -0.21, low), (-1, 0, 0), m.pick(70, 85))
    if m.chance(0.5):
        m.add(BASE, box((-x, x), (-0.12, -0.115), (0.5 * seat, 0.5 * seat + 0.08)))
