"""Test end to end, with scripted answers, that a part that proves wrong when moved is grounded once more."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.config import Config, GroundingConfig, ViewsConfig
from anymesh.pipeline.solving import solve
from anymesh.prompted.answerers.reference import Reference, ReferenceAnswerer
from anymesh.prompted.questions.grounding import MarkedPart, MarksAnswer
from anymesh.prompted.questions.prompting import PartFit
from anymesh.types import JointType, KnownJoint

CASE = [box((0, 0, 0), (0.6, 0.4, 0.6))]
DOORS = [box((0.0, -0.03, 0.0), (0.29, 0.0, 0.6)), box((0.31, -0.03, 0.0), (0.6, 0.0, 0.6))]
KNOBS = [box((0.24, -0.06, 0.28), (0.27, -0.03, 0.34)), box((0.33, -0.06, 0.28), (0.36, -0.03, 0.34))]
QUICK = Config(views=ViewsConfig(around="4@15+30,1@50+30", size=240), grounding=GroundingConfig(points=8_000))


class Scripted:
    """Answers from the truth, except for the first answer about marks, and reports once which part is wrong."""

    name, exchanges, warnings = "scripted", (), ()

    def __init__(self, reference: Reference, fit: PartFit) -> None:
        self.reference, self.fit, self.asked = ReferenceAnswerer("truth", lambda: reference), fit, []

    def ask(self, question):
        first = all(q.kind != question.kind for q in self.asked)
        self.asked.append(question)
        answer = self.reference.ask(question)
        if question.kind == "marks" and first:
            return self._wrong(answer)
        if question.kind == "marks":  # under the label and instance in the question
            return replace(answer, parts=(replace(answer.parts[0], instance=int(question.again[0].split()[1])),))
        if question.kind == "motions" and first:
            return tuple(
                replace(a, part=self.fit if t.part.label == "door" and self._is_wrong(t.part.points) else PartFit.RIGHT)
                for a, t in zip(answer, question.tables, strict=True)
            )
        return answer

    def _wrong(self, answer: MarksAnswer) -> MarksAnswer:
        """Return an answer in which the left door has the right one's knob, or lacks its own knob."""
        left, right = answer.parts
        if self.fit is PartFit.TOO_LITTLE:
            return replace(answer, parts=(MarkedPart("door", 1, None, left.marks[:1]), right))
        return replace(
            answer, parts=(MarkedPart("door", 1, None, (*left.marks, right.marks[-1])), replace(right, marks=right.marks[:-1]))
        )

    def _is_wrong(self, points: np.ndarray) -> bool:
        across = points[:, 0].max() - points[:, 0].min()
        knobbed = points[:, 1].min() < -0.04
        return across > 0.3 if self.fit is PartFit.TOO_MUCH else points[:, 0].max() < 0.3 and not knobbed


@pytest.mark.parametrize("fit", [PartFit.TOO_MUCH, PartFit.TOO_LITTLE])
def test_a_wrong_part_goes_back_to_the_marks_and_is_solved_again(fit: PartFit) -> None:
    mesh, piece = mesh_of([*CASE, *DOORS, *KNOBS])
    truth = np.array([0, 1, 2, 1, 2])[piece]
    z = np.array([0.0, 0.0, 1.0])
    joints = (None, KnownJoint(JointType.REVOLUTE, np.array([0, -0.015, 0.3]), -z, (0.0, 1.5)),
              KnownJoint(JointType.REVOLUTE, np.array([0.6, -0.015, 0.3]), z, (0.0, 1.5)))  # fmt: skip
    reference = Reference("cabinet", 0.6, truth, mesh.face_areas, ("base", "door", "door"), (0, 0, 0), joints)
    answerer = Scripted(reference, fit)
    segmentation, found = solve(mesh, config=QUICK, answerer_factory=lambda _: answerer)
    kinds = [q.kind for q in answerer.asked]
    assert kinds.count("marks") == 2
    again = [q for q in answerer.asked if q.kind == "marks"][1]
    assert f"is {fit.value.replace('_', ' ')}" in again.text()
    assert again.text().count("proved wrong") == 1
    first, *_, second = (q for q in answerer.asked if q.kind == "motions")
    assert len(first.tables) == 2
    assert len(second.tables) == 1  # the other door is not asked about again
    assert "part_is" not in second.schema()["properties"]["parts"]["items"]["properties"]
    owner = segmentation.face_part
    left = owner[piece == 1][0]
    assert set(owner[piece == 1]) == {left} == set(owner[piece == 3]), "the left knob is the left door's"
    if fit is PartFit.TOO_MUCH:
        assert left not in owner[piece == 4]
    assert {j.type for j in found} == {JointType.REVOLUTE}
    assert [j.child for j in found] == [p.name for p in segmentation.parts[1:]]
