"""Texts of a page about a question: title, instructions and current answers, shorter than those for models."""

from __future__ import annotations

from html import escape

from anymesh.prompted.questions.prompting import JointAppearance, MotionTable, PartFit
from anymesh.types import JointType
from anymesh.viewer.ask_forms import ArrowsForm, Form, KindsForm, LabelRow, MotionsForm, PartsForm, PointsForm, RecognizeForm
from anymesh.viewer.ask_marks import SPLIT, Group, MarksForm
from anymesh.viewer.ask_shapes import group_color
from anymesh.viewer.panels import SMALL

KINDS = {
    "hinge along an edge (door, lid)": JointAppearance.HINGE_ALONG,
    "turns in the surface (knob, wheel)": JointAppearance.HINGE_INTO,
    "turns, hinge out of sight": JointAppearance.HINGE_HIDDEN,
    "slides in or out (drawer, button)": JointAppearance.SLIDE_OUT,
    "slides along the surface": JointAppearance.SLIDE_ALONG,
    "does not move": JointAppearance.FIXED,
}
MOVES = {
    "turns within limits": JointType.REVOLUTE,
    "turns round and round": JointType.CONTINUOUS,
    "slides": JointType.PRISMATIC,
}
FITS = {"is right": PartFit.RIGHT, "is too much": PartFit.TOO_MUCH, "is too little": PartFit.TOO_LITTLE}
NONE_OF_THESE = "None"


def title(form: Form) -> str:
    """Return a one-line title of the question."""
    match form:
        case RecognizeForm():
            return "What is this, and what moves?"
        case MarksForm():
            return "Which faces are which part?"
        case KindsForm():
            return "How is it attached?"
        case PointsForm():
            return "Where does it turn?"
        case ArrowsForm():
            return "Which way does it slide?"
        case MotionsForm():
            return "Which motion is right?"
    raise TypeError(type(form).__name__)


def guide(form: Form) -> str:
    """Return the instructions."""
    match form:
        case RecognizeForm():
            return "Name the object and give one entry for each kind of part that moves; click an entry to change it."
        case MarksForm():
            return (
                "Choose a part below, then click its regions on the object; click again to take one back. "
                "Leave what does not move."
            )
        case KindsForm():
            return "Look at the coloured part and say how it moves."
        case PointsForm():
            return f"Click, on the object: {form.table.wanted}. Pale points lie under a surface."
        case ArrowsForm():
            return "Choose the arrow along which the coloured part opens."
        case MotionsForm():
            return "Each number plays a motion of the coloured part. Leave the right one playing."
    raise TypeError(type(form).__name__)


def place(form: PartsForm) -> str:
    """Return which of several parts is in question."""
    return f"Part {form.step + 1} of {len(form.parts)}: {form.part.label}"


def label_words(row: LabelRow) -> str:
    """Describe a kind of part in one line."""
    moves = JointType(row.moves)
    words = next(k for k, v in MOVES.items() if v is moves)
    unit = "cm" if moves is JointType.PRISMATIC else "°"
    limits = "" if moves is JointType.CONTINUOUS else f", {row.lower:g} to {row.upper:g} {unit}"
    return f"{row.label}: {words}{limits}"


def group_name(group: Group) -> str:
    """Return the name of a group of marks."""
    return group[0] if group == SPLIT else f"{group[0]} {group[1]}"


def marks_table(form: MarksForm) -> str:
    """Return a table of the parts with their colours and marks, as HTML."""
    rows = []
    for group, marks in form.groups.items():
        r, g, b = group_color(form, group)
        dot = (
            f'<span style="display:inline-block;width:0.8em;height:0.8em;border-radius:2px;background:rgb({r},{g},{b})"></span>'
        )
        numbers = ", ".join(map(str, sorted(marks))) or "nothing yet"
        name = escape(group_name(group))
        rows.append(f"<div>{dot} {f'<b>{name}</b>' if group == form.current else name}: {numbers}</div>")
    left = len(form.asked) - sum(len(marks & form.asked) for marks in form.groups.values())
    return f"<div {SMALL}>{''.join(rows)}<div>{left} regions belong to no part.</div></div>"


def chosen_points(form: PointsForm) -> str:
    """Return the chosen points of the part that is shown."""
    return ", ".join(map(str, form.chosen[form.step]))


def motion_words(table: MotionTable, number: int) -> str:
    """Describe a motion in words; 0 is none of them."""
    if number == 0:
        return "None of these: the next ones are shown, if there are any."
    motion = table.motions[number - 1]
    blocked = ", blocked by something as modelled" if number <= len(table.blocked) and table.blocked[number - 1] else ""
    return (
        f"Motion {number} of {len(table.motions)}: it {'slides' if motion.kind is JointType.PRISMATIC else 'turns'}{blocked}."
    )
