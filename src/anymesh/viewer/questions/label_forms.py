"""A person's input on kinds of moving parts: of the whole object, and of a machine seen more closely."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

from anymesh.prompted.questions.recognition import Recognize, RecognizeRegions, folded
from anymesh.prompted.questions.saved_question import answer_object
from anymesh.types import JointType
from anymesh.types.motion import BASE
from anymesh.viewer.questions.forms import Form

UNNAMED = "part"
NO_LIMITS = {JointType.CONTINUOUS.value: {"lower": 0.0, "upper": 0.0}}
MOVES = {
    "turns within limits": JointType.REVOLUTE,
    "turns round and round": JointType.CONTINUOUS,
    "slides": JointType.PRISMATIC,
}


@dataclass
class LabelRow:
    """One kind of moving part; limits in degrees or centimetres."""

    label: str = UNNAMED
    moves: str = JointType.REVOLUTE.value
    parent: str = BASE
    lower: float = 0.0
    upper: float = 90.0
    count: int = 0

    @property
    def words(self) -> str:
        """Description in one line."""
        moves = JointType(self.moves)
        words = next(k for k, v in MOVES.items() if v is moves)
        unit = "cm" if moves is JointType.PRISMATIC else "°"
        limits = "" if moves is JointType.CONTINUOUS else f", {self.lower:g} to {self.upper:g} {unit}"
        return f"{self.label}: {words}{limits}"


@dataclass
class RowsForm(Form):
    """Base of forms about kinds of moving parts. open_row: the expanded entry, -1 for none."""

    rows: list[LabelRow] = field(default_factory=list)
    open_row: int = -1
    touched: bool = False

    def fill(self, answer: Mapping[str, Any]) -> None:
        self.rows = [LabelRow(**p | {end: round(float(p[end]), 1) for end in ("lower", "upper")}) for p in answer["parts"]]

    def answer(self) -> dict[str, Any]:
        return {"parts": [asdict(r) | NO_LIMITS.get(r.moves, {}) for r in self.rows]}

    def rename(self, row: LabelRow, label: str) -> None:
        """Give an entry another label, also where others are mounted on it."""
        taken = {BASE, *(r.label for r in self.rows if r is not row)}
        if not taken & {row.label, label}:
            self._mount(row.label, label)
        row.label = label

    def remove(self, row: LabelRow) -> None:
        """Remove an entry; what is mounted on it is then mounted on what it was mounted on."""
        self.rows = [r for r in self.rows if r is not row]
        self._mount(row.label, BASE if row.parent == row.label else row.parent)

    def _mount(self, before: str, after: str) -> None:
        for r in self.rows:
            r.parent = after if r.parent == before else r.parent


class RecognizeForm(RowsForm):
    """The object, and its kinds of moving parts. front: number of a picture, 0 for none."""

    title = "What is this, and what moves?"
    instructions = "Name the object and give one entry for each kind of part that moves; click an entry to change it."

    def __init__(self, question: Recognize) -> None:
        super().__init__()
        self.question, self.category, self.longest, self.front, self.machine = question, "", 1.0, 0, False

    def fill(self, answer: Mapping[str, Any]) -> None:
        super().fill(answer)
        self.machine = answer.get("machine", False)
        self.category, self.longest, self.front = answer["category"], float(answer["longest_side_m"]), int(answer["front"])

    def answer(self) -> dict[str, Any]:
        own = {"category": self.category, "longest_side_m": self.longest, "front": self.front, "machine": self.machine}
        return own | super().answer()

    def look_from(self, azimuth: float) -> None:
        """Choose the picture with the nearest azimuth [deg] as the one that shows the front."""
        off = [abs((a - azimuth + 180) % 360 - 180) for a in self.question.azimuths]
        self.front, self.touched = (off.index(min(off)) + 1 if off else 0), True


class RegionsForm(RowsForm):
    """The kinds of moving parts of a machine: those found so far, to which those of a closer look are added."""

    title = "What else moves?"
    instructions = "Look closely from all sides; add kinds of part that move and are not listed, remove what does not move."

    def __init__(self, question: RecognizeRegions) -> None:
        super().__init__()
        self.question = question
        self.fill({"parts": ()})

    def fill(self, answer: Mapping[str, Any]) -> None:
        """Take over an answer, which lists only what differs from what was found."""
        rows = {p["label"]: p for p in (*answer_object(self.question, self.question.known)["parts"], *answer["parts"])}
        super().fill({"parts": rows.values()})
        for row in [r for r in self.rows if r.label in answer.get("withdrawn", ())]:
            self.remove(row)

    def answer(self) -> dict[str, Any]:
        left = {folded(r.label) for r in self.rows}
        return answer_object(self.question, [r for r in self.question.known if r.label in left]) | super().answer()
