"""Test grounding with a scripted answerer on a box with a door, a tray and a plate inside, and the second grounding."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of
from made import smaller

from anymesh.config import Config
from anymesh.prompted.grounding import alike
from anymesh.prompted.grounding.alike import equal_marks, small_regions, wires
from anymesh.prompted.grounding.ground import ground_exactly, ground_parts
from anymesh.prompted.grounding.mark_questions import MarkQuestioner
from anymesh.prompted.grounding.regrounding import ground_again
from anymesh.prompted.grounding.views import SampledObject, region_cameras, sample_object
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.prompted.questions.grounding import MarkedPart, MarksAnswer, WhichMarks
from anymesh.prompted.questions.prompting import PartFit
from anymesh.segmentation.divide import object_shape
from anymesh.types import Exchange, Mesh, Part, Segmentation
from anymesh.types.motion import Recognition, RecognizedLabel

QUICK = Config(viewpoints="4@15+30,1@50+30")
CASE = [
    box((0, 0, 0), (1, 1, 0.05)), box((0, 0, 0.95), (1, 1, 1)), box((0, 0, 0.05), (0.05, 1, 0.95)),
    box((0.95, 0, 0.05), (1, 1, 0.95)), box((0.05, 0.95, 0.05), (0.95, 1, 0.95)),
]  # fmt: skip
DOOR, KNOB = box((0, -0.05, 0), (1, -0.001, 1)), box((0.8, -0.15, 0.4), (0.9, -0.05, 0.6))
TRAY, PLATE = box((0.2, -0.001, 0.2), (0.8, 0.4, 0.3)), box((0.2, -0.001, 0.6), (0.8, 0.4, 0.7))  # both on the door's back
DOOR_NUMBER, KNOB_NUMBER, TRAY_NUMBER, PLATE_NUMBER = 5, 6, 7, 8


@pytest.fixture(autouse=True, scope="module")
def quick() -> Iterator[None]:
    with smaller(160, 8_000):
        yield


@cache
def scene(inside: bool) -> tuple[SampledObject, np.ndarray, VisualPrompts]:
    mesh, piece = mesh_of([*CASE, DOOR, KNOB, *([TRAY, PLATE] if inside else [])])
    return sample_object(mesh, object_shape(mesh), QUICK), piece, VisualPrompts(mesh, QUICK)


@dataclass
class Scripted:
    """Answerer that gives marks by the pieces that they are on.

    parts: (label, instance) -> pieces; unsure: pieces whose marks may be wrong.
    """

    piece: np.ndarray
    parts: Mapping[tuple[str, int], Sequence[int]]
    unsure: Sequence[int] = ()
    asked: list[WhichMarks] = field(default_factory=list)
    name: str = "scripted"
    exchanges: tuple[Exchange, ...] = ()
    warnings: tuple[str, ...] = ()

    def ask(self, question: WhichMarks) -> MarksAnswer:
        self.asked.append(question)
        assert question.face_mark is not None
        own = {int(m): int(self.piece[question.face_mark == m][0]) for m in sorted(self.drawn(-1))}
        parts = [
            MarkedPart(label, n, None, tuple(m for m, p in own.items() if p in pieces))
            for (label, n), pieces in self.parts.items()
        ]
        return MarksAnswer(tuple(p for p in parts if p.marks), tuple(m for m, p in own.items() if p in self.unsure))

    def drawn(self, call: int) -> set[int]:
        """Return the marks in the pictures of a call."""
        return {int(m) for region in self.asked[call].regions for m in np.unique(region[region > 0])}

    def pieces(self, call: int) -> set[int]:
        """Return the pieces whose marks are in the pictures of a call."""
        marks = self.asked[call].face_mark
        assert marks is not None
        return set(self.piece[np.isin(marks, list(self.drawn(call)))].tolist())


def asking(who: Scripted, prompts: VisualPrompts, *labels: str) -> MarkQuestioner:
    return MarkQuestioner(who, prompts, labels, "box", QUICK)


def grounded(parts: Mapping[tuple[str, int], Sequence[int]], *labels: str, inside: bool = False, **options):
    """Return the parts by name as pieces, the segmentation, its warnings and the answerer."""
    sampled, piece, prompts = scene(inside)
    who = Scripted(piece, parts, options.get("unsure", ()))
    told = Recognition(
        "box", options.get("size"), tuple(RecognizedLabel(label, None, None, None, options.get("count")) for label in labels)
    )

    def by_geometry() -> Segmentation:
        return Segmentation((piece == TRAY_NUMBER).astype(np.int64), (Part("base", "base"), Part("tray", "tray", 0.5, "it is")))

    found, warnings = ground_parts(
        sampled, asking(who, prompts, *labels), told, ground_exactly, by_geometry, lambda *_: True,
        options.get("progress", lambda *_: None),
    )  # fmt: skip
    own = {p.name: sorted(set(piece[found.face_part == k].tolist())) for k, p in enumerate(found.parts)}
    return own, found, warnings, who


def test_parts_have_the_faces_of_their_marks_and_all_else_is_the_base() -> None:
    own, found, warnings, who = grounded({("door", 1): [DOOR_NUMBER], ("knob", 1): [KNOB_NUMBER]}, "door", "knob")
    assert own == {"base": [0, 1, 2, 3, 4], "door": [5], "knob": [6]}
    assert [(p.confidence, p.reason) for p in found.parts[1:]] == [(0.9, "identified by scripted")] * 2
    assert warnings == ()
    assert who.asked[0].labels == ("door", "knob")
    assert not who.asked[0].inside


def test_uncertain_marks_lower_the_confidence_of_their_part_alone() -> None:
    _, found, _, _ = grounded({("door", 1): [5, 6], ("lid", 1): [1]}, "door", "lid", unsure=[6, 0])
    by_name = {p.name: p for p in found.parts}
    assert by_name["door"].confidence == 0.6
    assert by_name["door"].reason == "identified by scripted, not sure of 1 of 2 marks"
    assert (by_name["lid"].confidence, by_name["lid"].reason) == (0.9, "identified by scripted")


def test_a_label_without_a_part_gives_a_warning() -> None:
    _, _, warnings, _ = grounded({("door", 1): [5]}, "door", "lid")
    assert warnings == ("no lid was found, though the answer of scripted has one",)
    _, _, warnings, _ = grounded({("door", 1): range(7)}, "door")
    assert warnings == ("no door was found, the marks cover all of the object, or too little of it",)


def test_parts_that_were_lost_or_miscounted_give_a_warning() -> None:
    _, _, warnings, _ = grounded({("door", 1): [5], ("door", 2): []}, "door", count=2)
    assert warnings == ("the answer of scripted has 2 parts door, but 1 is marked",)
    _, _, warnings, _ = grounded({("lid", 1): [1], ("lid", 2): [0, 2, 3, 4, 5, 6]}, "lid", count=2)
    assert warnings == ("1 of 2 marked parts lid are left: others took the surface of the rest, or all of it",)


def test_with_low_detail_small_regions_join_what_they_sit_on_with_a_warning() -> None:
    sampled, piece, prompts = scene(inside=False)
    small = small_regions(piece, sampled.mesh, sampled.whole.diagonal)
    assert not small
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(alike, "SMALL_RATIO", 0.3)
        assert small_regions(piece, sampled.mesh, sampled.whole.diagonal) == {KNOB_NUMBER}
        who = Scripted(piece, {("door", 1): [DOOR_NUMBER]})
        low = MarkQuestioner(who, prompts, ("door",), "box", replace(QUICK, detail="low"))
        told = Recognition("box", 1.0, (RecognizedLabel("door", None, None, None),))
        found, warnings = ground_parts(sampled, low, told, ground_exactly, lambda: pytest.fail("asked"), lambda *_: True)
    assert who.pieces(0) == {0, 1, 2, 3, 4, 5}
    assert set(piece[found.face_part == 1].tolist()) == {DOOR_NUMBER, KNOB_NUMBER}
    assert warnings[0].startswith("--detail low: 1 regions below ")


def test_equal_marks_are_those_of_one_shape_turned_or_mirrored() -> None:
    boxes = [box((k, 0, 0), (k + 0.4, 0.2, 0.1)) for k in range(3)]
    turned = box((0, 2, 0), (0.1, 2.4, 0.2))
    mesh, number = mesh_of([*boxes, turned, box((2, 2, 0), (2.4, 2.3, 0.1))])
    mark = number + 1
    found = equal_marks(mark, mesh)
    assert found.marks.tolist() == [1, 2, 3, 4]
    assert len(set(found.group.tolist())) == 1
    assert found.middle[0] == pytest.approx([0.2, 0.1, 0.05])
    assert equal_marks(np.where(mark == 1, 1, -1), mesh) is None
    walls = [*(box((0, 0, z), (1, 1, z + 0.02)) for z in (0, 0.98)), *(box((0, y, 0), (1, y + 0.02, 1)) for y in (0, 0.98))]
    mesh, number = mesh_of([*walls, box((0, 0, 2), (1, 1, 2.02))])
    assert equal_marks(number + 1, mesh).group.tolist() == [0, 0, 1, 1, 0]


def test_a_machine_is_shown_region_by_region_in_close_up() -> None:
    sampled, piece, prompts = scene(inside=False)
    near = region_cameras(sampled, prompts.views)
    assert sorted({number for number, _, _ in near}) == [1, 2, 3, 4]
    assert len(near) <= 8
    assert all(camera.fov < prompts.views[v].camera.fov for _, v, camera in near)
    seen = np.unique(np.concatenate([prompts.view(camera).face.ravel() for _, _, camera in near]))
    assert set(piece[seen[seen >= 0]].tolist()) == {0, 1, 2, 3, 4, 5, 6}


def test_regions_of_a_machine_are_where_its_surfaces_are_and_not_on_its_plain_hull() -> None:
    hull = box((0, 0, 0), (10, 1, 1))
    pods = [box((x, 0.4, z), (x + 0.1, 0.6, z + 0.1)) for x in (1, 1.2, 1.4, 8, 8.2, 8.4) for z in (-0.1, 1)]
    mesh, piece = mesh_of([hull, *pods])
    sampled, prompts = sample_object(mesh, object_shape(mesh), QUICK), VisualPrompts(mesh, QUICK)
    near = region_cameras(sampled, prompts.views)
    assert len({number for number, _, _ in near}) == 4
    assert all(camera.fov < prompts.views[v].camera.fov / 3 for _, v, camera in near)
    for names in (range(1, 7), range(7, 13)):  # two pods stand on the hull and under it at each place
        numbers = {number for number, _, camera in near if np.isin(piece[prompts.view(camera).face], names).any()}
        assert len(numbers) >= 2


def test_wires_are_long_for_their_surface_and_small_wheels_are_none() -> None:
    rod, plate = box((0, 0, 0), (1, 0.05, 0.05)), box((0, 0, 0), (0.1, 0.1, 0.01))
    wheel = trimesh.creation.torus(0.05, 0.015)
    frame = trimesh.creation.torus(0.5, 0.01)
    mesh, piece = mesh_of([rod, plate, *((m.vertices, m.faces) for m in (wheel, frame))])
    assert wires(piece, mesh).tolist() == [True, False, False, True]


def test_without_labels_nothing_is_asked_and_all_is_the_base() -> None:
    own, _, warnings, who = grounded({})
    assert own == {"base": [0, 1, 2, 3, 4, 5, 6]}
    assert (warnings, who.asked) == ((), [])


def test_progress_counts_up_to_the_number_of_steps() -> None:
    steps: list[tuple[str, int, int]] = []
    grounded({("door", 1): [5]}, "door", progress=lambda stage, _, step, count: steps.append((stage, step, count)))
    assert steps == [("segment", k, 3) for k in range(3)]


def test_marks_inside_that_are_left_over_belong_to_the_base() -> None:
    """The plate is shown beside the tray, which is named; if neither is, both belong to the door that supports them."""
    own, _, _, who = grounded({("door", 1): [5], ("tray", 1): [TRAY_NUMBER]}, "door", "tray", inside=True, size=1.0)
    assert any(q.inside for q in who.asked)
    assert own["tray"] == [TRAY_NUMBER]
    assert PLATE_NUMBER in own["base"]
    own, _, _, _ = grounded({("door", 1): [5]}, "door", inside=True, size=1.0)
    assert own["door"] == [5, TRAY_NUMBER, PLATE_NUMBER]


@pytest.mark.parametrize(("size", "found"), [(None, True), (1.0, False)])
def test_geometry_adds_what_is_inside_where_a_user_gave_the_labels(size: float | None, found: bool) -> None:
    """The lid is named, so that nothing supports the tray but the door, which is of the base."""
    own, _, warnings, _ = grounded({("lid", 1): [1]}, "lid", inside=True, size=size)
    assert (own.get("tray") == [TRAY_NUMBER]) == found
    assert warnings == (("no view shows the tray inside; geometry found it",) if found else ())


def again(
    before: Mapping[str, Sequence[int]], wrong: Mapping[str, PartFit], parts: Mapping[tuple[str, int], Sequence[int]]
) -> tuple[dict[str, list[int]] | None, Scripted]:
    """Return the parts after a second grounding, as pieces."""
    sampled, piece, prompts = scene(inside=False)
    label = np.zeros(len(piece), np.int64)
    for k, pieces in enumerate(before.values(), start=1):
        label[np.isin(piece, list(pieces))] = k
    parts_before = (Part("base", "base"), *(Part(name, name.split("_")[0]) for name in before))
    who = Scripted(piece, parts)
    found = ground_again(sampled, asking(who, prompts, "door", "lid"), Segmentation(label, parts_before), wrong, None)
    if found is None:
        return None, who
    return {p.name: sorted(set(piece[found.face_part == k].tolist())) for k, p in enumerate(found.parts)}, who


def test_a_part_with_too_much_loses_the_marks_that_are_not_named_again() -> None:
    found, who = again({"door": [5, 6], "lid": [1]}, {"door": PartFit.TOO_MUCH}, {("door", 1): [5]})
    assert found == {"base": [0, 2, 3, 4, 6], "door": [5], "lid": [1]}
    assert who.pieces(0) == {5, 6}  # no others are asked about
    assert who.asked[0].labels == ("door",)
    (told,) = who.asked[0].again
    assert told.startswith("door 1 (marks ")
    assert told.endswith(" is too much: some of these marks do not move with it")


def test_a_part_with_too_little_gains_marks_of_the_base_and_of_others() -> None:
    found, who = again({"door": [5], "lid": [1]}, {"door": PartFit.TOO_LITTLE}, {("door", 1): [5, 6]})
    assert found == {"base": [0, 2, 3, 4], "door": [5, 6], "lid": [1]}
    assert {1, 5, 6} <= who.pieces(0)
    (told,) = who.asked[0].again
    assert told.endswith(" is too little: other marks move with it too")
    taken, _ = again({"door": [5], "lid": [1, 6]}, {"door": PartFit.TOO_LITTLE}, {("door", 1): [5, 6]})
    assert taken == {"base": [0, 2, 3, 4], "door": [5, 6], "lid": [1]}


def test_parts_of_one_label_keep_their_numbers() -> None:
    before = {"door_1": [5], "door_2": [1]}
    found, who = again(before, {"door_2": PartFit.TOO_LITTLE}, {("door", 2): [1, 6]})
    assert found == {"base": [0, 2, 3, 4], "door_1": [5], "door_2": [1, 6]}
    assert who.asked[0].again[0].startswith("door 2 ")


@pytest.mark.parametrize("parts", [{}, {("door", 1): [5, 6]}, {("door", 2): [5]}, {("door", 1): [1, 5]}])
def test_an_answer_that_changes_nothing_or_leaves_a_part_without_faces_is_not_used(parts) -> None:
    assert again({"door": [5, 6], "lid": [1]}, {"door": PartFit.TOO_LITTLE}, parts)[0] is None


def test_the_object_is_sampled_with_fewer_points_for_exact_regions() -> None:
    sampled, _, _ = scene(inside=False)
    assert isinstance(sampled.mesh, Mesh)
    assert 8_000 <= len(sampled.cloud) < 9_000
