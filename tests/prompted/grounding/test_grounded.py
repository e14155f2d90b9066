"""Test Stage A with a visual answerer: exact regions, masks of a model, unseen parts, labels without parts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from assets import box, mesh_of
from made import smaller

from anymesh.config import Config
from anymesh.evaluation.ground_truth import GroundTruth, example_truths, prepared
from anymesh.evaluation.oracle import oracle
from anymesh.evaluation.score import match_parts, part_ious
from anymesh.loading import load_mesh, place_mesh
from anymesh.pipeline.results import SegmentationResult
from anymesh.pipeline.solving import Solver, solve
from anymesh.prompted import stages as prompted_stages
from anymesh.prompted.answerers.reference import Reference, ReferenceAnswerer
from anymesh.prompted.grounding import ground as ground_masks
from anymesh.prompted.grounding.ground import UNSURE
from anymesh.prompted.pictures.views import part_pixels
from anymesh.prompted.questions.grounding import MarkedPart, MarksAnswer
from anymesh.prompted.questions.prompting import PartFit
from anymesh.types import JointType, KnownJoint, Mesh, Segmentation
from anymesh.types.motion import Recognition, RecognizedLabel

TRUTHS = {t.name: t for t in example_truths(Path(__file__).parents[3] / "examples")}


@pytest.fixture(autouse=True, scope="module")
def quick() -> Iterator[None]:
    with smaller(320, 20_000, 80_000):  # masks are fused on the points themselves
        yield


def found_in(name: str, proposer: str = "exact") -> tuple[GroundTruth, Mesh, SegmentationResult]:
    truth = TRUTHS[name]
    placed = place_mesh(load_mesh(truth.mesh))
    solver = Solver(placed.mesh, Config(proposer=proposer), lambda _: oracle(prepared(truth)))
    return truth, placed.mesh, solver.parts("auto", solver.answers.recognize().recognition)


def ious(truth: GroundTruth, mesh: Mesh, found: Segmentation) -> dict[str, float]:
    pairs = match_parts(part_ious(found.face_part, truth.labels, mesh.face_areas))
    return {truth.parts[t].name: iou for _, t, iou in pairs}


def test_marks_become_parts_those_inside_too() -> None:
    truth, mesh, found = found_in("microwave")
    got = ious(truth, mesh, found.segmentation)
    assert set(got) == {p.name for p in truth.parts[1:]}
    assert min(got.values()) > 0.97
    assert {p.reason for p in found.segmentation.parts[1:]} == {"identified by oracle"}


@pytest.mark.slow
def test_parts_inside_come_from_geometry_without_an_answer() -> None:
    truth = TRUTHS["microwave"]
    placed = place_mesh(load_mesh(truth.mesh))
    solver = Solver(placed.mesh, Config(), lambda _: oracle(prepared(truth)))
    asked = [label for label in solver.answers.recognize().recognition.labels if label.label != "wheel"]
    found = solver.parts("auto", Recognition("microwave", None, tuple(asked)))
    assert "wheel" in ious(truth, placed.mesh, found.segmentation) or len(found.segmentation.parts) == len(truth.parts)
    assert "no view shows it" in next(p.reason for p in found.segmentation.parts if p.label == "wheel")
    assert any("no view shows the wheel" in w for w in found.warnings)


MOVING = sorted(name for name, truth in TRUTHS.items() if truth.joints)


@pytest.mark.parametrize("name", [n if n == "tilted_drawer" else pytest.param(n, marks=pytest.mark.slow) for n in MOVING])
def test_ideal_masks_lose_no_part_and_divide_none(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The masks cover every part in every view, and their numbers differ between views."""
    truth = TRUTHS[name]
    mesh = place_mesh(load_mesh(truth.mesh)).mesh
    shown, proposed = {}, ground_masks.propose_in_views

    def propose(region, diagonal, seen, *more):
        shown.update({v.color.tobytes(): v for v in seen})
        return proposed(region, diagonal, seen, *more)

    class Masker:
        name, frame = "masker", None

        def embed(self, image): ...

        def predict(self, embedding, points): ...

    def masks(_: object, image: np.ndarray) -> list[SimpleNamespace]:
        view = shown.get(image.tobytes())
        parts = [] if view is None else [part_pixels(view, truth.labels, k) for k in range(len(truth.parts))]
        return [SimpleNamespace(mask=m) for m in parts if m.any()]

    monkeypatch.setattr(prompted_stages, "load_sam", lambda spec: Masker())
    monkeypatch.setattr(ground_masks, "automatic_masks", masks)
    monkeypatch.setattr(ground_masks, "propose_in_views", propose)
    truth, mesh, found = found_in(name, "sam:some")
    got = ious(truth, mesh, found.segmentation)
    assert set(got) == {p.name for p in truth.parts[1:]}
    assert len(found.segmentation.parts) == len(truth.parts)
    assert min(got.values()) > 0.9
    assert found.warnings == ()


def test_marks_take_one_question_whose_captions_name_sides_by_the_recognized_front() -> None:
    truth = TRUTHS["tilted_drawer"]
    placed = place_mesh(load_mesh(truth.mesh))
    asked = []

    class Watched:
        name, exchanges, warnings = "watched", (), ()
        reference = oracle(prepared(truth))

        def ask(self, question):
            asked.append(question)
            found = self.reference.ask(question)
            if question.kind == "marks":  # all of them may be wrong
                return replace(found, unsure=found.parts[0].marks)
            return replace(found, front=90.0)

    solver = Solver(placed.mesh, Config(), lambda _: Watched())
    recognition = solver.answers.recognize().recognition
    found = solver.parts("auto", recognition)
    assert [q.kind for q in asked] == ["recognize", "marks"]  # which views show a label is asked about masks alone
    assert any(p.caption == "picture 1: turned by 0 degrees, 15 degrees up" for p in asked[0].pictures)
    captions = [p.caption.partition(": ")[2] for p in asked[1].pictures]
    sides = {"from the left, 15 degrees up": 0.0, "from the front, 15 degrees up": 90.0, "from the back, 15 degrees up": 270.0}
    seen = dict(zip(captions, asked[1].faces, strict=True))
    views = dict(zip([azimuth for azimuth, _ in Config().directions], solver.answers.visual_prompts.views, strict=False))
    assert all("turned" not in caption for caption in captions)
    assert any((seen[side] == views[azimuth].face).all() for side, azimuth in sides.items() if side in seen)
    (part,) = found.segmentation.parts[1:]
    assert part.confidence == UNSURE
    assert "not sure of" in part.reason


def test_what_is_expected_and_not_there_is_told() -> None:
    truth = TRUTHS["tilted_drawer"]
    placed = place_mesh(load_mesh(truth.mesh))
    solver = Solver(placed.mesh, Config(), lambda _: oracle(prepared(truth)))
    asked = [RecognizedLabel(label, None, None, None) for label in ("drawer", "trapdoor")]
    found = solver.parts("auto", Recognition("cabinet", None, tuple(asked)))
    assert [p.label for p in found.segmentation.parts] == ["base", "drawer"]
    assert found.warnings == ("no trapdoor was found, though the answer of oracle has one",)


def test_where_nothing_moves_nothing_is_asked() -> None:
    placed = place_mesh(load_mesh(TRUTHS["table"].mesh))

    class Silent:
        name, exchanges, warnings = "silent", (), ()

        def ask(self, question):
            raise AssertionError(f"asked {question.kind}")

    found = Solver(placed.mesh, Config(), lambda _: Silent()).parts("auto", Recognition("table", None, ()))
    assert [p.name for p in found.segmentation.parts] == ["base"]
    assert found.warnings[-1].startswith("no moving part was found; nearest to one is the ")


CASE = [box((0, 0, 0), (0.6, 0.4, 0.6))]
DOORS = [box((0.0, -0.03, 0.0), (0.29, 0.0, 0.6)), box((0.31, -0.03, 0.0), (0.6, 0.0, 0.6))]
KNOBS = [box((0.24, -0.06, 0.28), (0.27, -0.03, 0.34)), box((0.33, -0.06, 0.28), (0.36, -0.03, 0.34))]
QUICK = Config(viewpoints="4@15+30,1@50+30", ask="all")


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
