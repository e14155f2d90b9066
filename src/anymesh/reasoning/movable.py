"""Is a piece a movable part? The evidence, weighed; the unit is one clear piece of evidence."""

from __future__ import annotations

from anymesh.reasoning.questions import PartAnswer, PartEvidence
from anymesh.reasoning.vocabulary import Habit, is_fixed_name, recognize

ENOUGH = 0.8  # evidence that makes a part
KEY = "button"  # the label of a key
KEYS = 2  # others like it that a key of a control panel has at least
GRIPPED = 0.06  # what stands out of something smaller is no handle
GAP = (0.0, 0.3, 0.9, 1.6, 2.0)  # for 0..4 rims with a clearance


def judge(e: PartEvidence) -> PartAnswer:
    """The kind of part that the evidence speaks for most; it moves if that is enough."""
    named = _named(e)
    kinds = [_plate(e), _box(e), _round(e), _bail(e), _control(e), _key(e)]
    score, label, why = max(kinds, key=lambda kind: kind[0])
    if e.copied is not None and 0 < score < e.copied and not e.on_movable:  # copies, unless much speaks against, are one case
        score, why = (score + e.copied) / 2, f"{why}, a copy of a part that moves"
    if named is not None:
        bonus, word = named
        return PartAnswer(score + bonus >= ENOUGH, word or label, score + bonus, f'named "{e.name}"; {why}')
    return PartAnswer(score >= ENOUGH, label, score, why)


def stands_out(e: PartEvidence) -> float:
    """How much it looks like what hands move, where nothing else does: in the open, held at little of its surface, small."""
    return 2 * e.outside - 5 * e.touching - 0.5 * e.size - 1.0 * e.at_bottom


def _named(e: PartEvidence) -> tuple[float, str] | None:
    word = recognize(e.name)
    if word is not None:
        if word.habit is Habit.NONE or word.label == "handle":
            return (0.3, word.label)
        return (2.5, word.label)
    return (-2.5, "") if is_fixed_name(e.name) else None


def _plate(e: PartEvidence) -> tuple[float, str, str]:
    if e.thinness > 0.35 or e.face_share < 0.012 or e.outside < 0.4:
        return (-3.0, "panel", "no plate on the outside")
    value, why = -0.7, ["a plate on the outside"]
    if e.handle is not None and e.size > GRIPPED and not e.on_movable:
        value += 2.0 if e.handle.along is not None else 1.0  # a knob on a plate may also be a control on a panel
        why.append("with a handle")
    value += GAP[e.gap_sides]
    if e.gap_sides:
        why.append(f"clearance at {e.gap_sides} rims")
    if e.cover > 0.5:
        value += 0.8
        why.append("an opening behind it")
    if e.separate:
        value += 1.3
        why.append("touches nothing")
    elif e.one_edge:
        value += 1.3
        why.append("held along one edge")
    value -= 1.4 * e.flush
    if e.faces_down:
        value -= 1.5
    if e.on_movable and not e.separate:
        value -= 1.5
    return (value, "door", ", ".join(why))


def _box(e: PartEvidence) -> tuple[float, str, str]:
    if e.enclosed < 0.3 or e.outside < 0.15 or e.touching > 0.7:  # what touches nearly all over is a lining
        return (-3.0, "drawer", "no box in a cavity")
    value, why = -1.0, ["a box in a cavity"]
    if e.handle is not None and e.size > GRIPPED:
        value += 2.0 if e.handle.along is not None else 1.0
        why.append("with a handle")
    value += 0.6 * GAP[e.gap_sides]
    if e.separate:
        value += 1.4
        why.append("touches nothing")
    value += 0.5 * (e.outside > 0.5)
    value -= 1.2 * e.flush
    return (value, "drawer", ", ".join(why))


def _round(e: PartEvidence) -> tuple[float, str, str]:
    if e.roundness < 0.85:
        return (-3.0, "wheel", "not round")
    value, why = -0.6, [f"round outline ({100 * e.roundness:.0f} %)"]
    control = e.size < 0.16
    if e.axle_level and e.at_bottom and e.twins >= 1 and 0.1 < e.flatness < 3:
        value += 2.0
        why.append(f"{e.twins + 1} alike at the bottom with level axles")
        return (value, "wheel", ", ".join(why))
    if e.separate:
        value += 1.2
        why.append("touches nothing")
    if control and 0.45 < e.flatness < 4 and e.outside > 0.3 and not e.faces_down and not e.on_movable:
        value += 1.2 if e.axle_level or e.separate else 0.3
        why.append("stands out like a knob")
        value += 0.3 * min(e.twins, 1)
    if e.opposite:
        value -= 2.0  # one of two pivots or axle ends
    if e.separate and e.axle and e.outside > 0.3:
        value += 0.4
        why.append("something to turn on")
    if e.flatness > 4:
        value -= 2.0 if not e.separate else 0.0 if e.axle else 0.5  # a rod or a pipe
    if e.faces_down or (e.at_bottom and not e.axle_level):
        value -= 1.5  # a foot or a leg
    if e.flatness < 0.25 and not e.axle_level and not e.separate:
        value -= 1.0  # a plate, a burner, a coaster
    return (value, "knob" if control else "wheel", ", ".join(why))


def _bail(e: PartEvidence) -> tuple[float, str, str]:
    if not (e.pivots and e.slender) or e.size < 0.1:
        return (-3.0, "handle", "no pivots")
    return (1.0 + 0.8 * e.separate, "handle", "slender, held by pivots at both ends")


def _key(e: PartEvidence) -> tuple[float, str, str]:
    """A key: one of several alike that stand out of a surface side by side, a clearance between them; the last of a row has
    a neighbour on one side only."""
    least = 2 if e.copied is None else 1
    if e.size > GRIPPED or e.outside < 0.8 or e.gap_sides < least or e.twins < KEYS or e.faces_down:
        return (-3.0, KEY, "no key")
    return (0.2 + 0.2 * e.gap_sides + 0.1 * min(e.twins, 4), KEY, f"{e.twins + 1} alike, clearance at {e.gap_sides} rims")


def _control(e: PartEvidence) -> tuple[float, str, str]:
    """A lever in a slot, a trigger, a button, a slider: small and free of what is round it."""
    if not e.separate or e.outside < 0.05 or e.size > 0.6:
        return (-3.0, "lever", "no control")
    value = (
        (0.3 if e.enclosed > 0.1 else -0.3)
        - 0.6 * e.on_movable
        + 0.3 * (e.enclosed > 0.3)
        + 0.25 * e.gap_sides
        - (0.8 if e.size < 0.02 else 0.0)
    )
    if e.captured:
        return (value + 0.8, "lever", "touches nothing and slides between two stops")
    return (value, "lever", f"touches nothing, clearance at {e.gap_sides} sides")
