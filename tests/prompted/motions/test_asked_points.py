"""Test the points, axes and steps of the questions about joints, and thick round parts."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from unittest.mock import patch

import numpy as np
import pytest
from assets import box
from known import KNOWN, QUICK, Known, Watched, known, ready, true_answers
from made import Y, context_of
from scenes import prism
from trimesh.creation import annulus

from anymesh.articulation.candidate_motions import PartFacts
from anymesh.articulation.motion_features import part_values
from anymesh.prompted.motions import lines
from anymesh.prompted.motions.joints import PromptedJoints, Questions, prompt_joints
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.prompted.questions.prompting import JointAppearance, KindAnswer, PointTable
from anymesh.types import JointType
from anymesh.types.motion import Recognition, RecognizedLabel

INTO, HIDDEN, ALONG = JointAppearance.HINGE_INTO, JointAppearance.HINGE_HIDDEN, JointAppearance.HINGE_ALONG


@cache
def asked(name: str, kind: JointAppearance, verify: str = "free") -> tuple[PointTable, PromptedJoints, tuple]:
    """Return the points that were shown, the joints, and the steps of the progress."""
    mesh, whole, segmentation = ready(KNOWN[name].scene)
    config, steps = replace(QUICK, verify=verify), []
    picks = {"kinds": lambda _: (KindAnswer(kind),), "points": lambda q: ((0,) if kind is INTO else (0, 1),)}
    watched = Watched(true_answers(mesh, segmentation, (KNOWN[name].joint,)), changed=picks)

    def progress(stage: str, _: str, step: int, count: int) -> None:
        steps.append((stage, step, count))

    questions = Questions(VisualPrompts(mesh, config), watched, config, None, progress)
    with patch.object(lines, "MIN_LABEL_DISTANCE", 2.0):  # numbers may be beside each other
        found = prompt_joints(questions, lambda _: whole, segmentation)
    return next(q for q in watched.asked if q.kind == "points").tables[0], found, tuple(steps)


def test_an_axis_into_the_surface_is_one_of_up_to_eight_points() -> None:
    """Half of them stand for axes; the others have none of their own."""
    table, found, _ = asked("wheel", INTO)
    assert len(table.points) == 8
    assert table.axes is not None
    own = ~np.isnan(table.axes).any(1)
    assert 1 <= own.sum() <= 4
    assert own[: own.sum()].all()  # the axes come first
    (joint,) = found.joints
    assert abs(joint.axis @ table.axes[0]) == pytest.approx(1)
    assert (joint.type, joint.child) == (JointType.REVOLUTE, "disc")


def test_the_paper_shows_more_points_and_no_axes() -> None:
    table, found, _ = asked("wheel", INTO, "off")
    assert table.axes is None
    assert len(table.points) > 8
    assert np.linalg.norm(found.joints[0].axis) == pytest.approx(1)


def test_a_hidden_hinge_has_points_all_over_the_part_too() -> None:
    along, hidden = asked("left", ALONG)[0], asked("left", HIDDEN)[0]
    assert along.axes is None
    assert len(hidden.points) <= lines.MAX_POINTS
    assert along.points[:, 1].min() > -0.02 > hidden.points[:, 1].min()  # also on its front


def test_a_hinge_goes_through_the_picked_points() -> None:
    table, found, _ = asked("left", ALONG)
    a, b = table.points[:2]
    (joint,) = found.joints
    assert np.linalg.norm(np.cross(joint.axis, (b - a) / np.linalg.norm(b - a))) < 1e-6
    assert np.linalg.norm(np.cross(joint.origin - a, joint.axis)) < 1e-6


def test_progress_has_four_steps() -> None:
    assert asked.__wrapped__("left", ALONG)[2] == tuple(("joints", k, 4) for k in (0, 1, 3))


def test_questions_name_the_category_and_the_labels() -> None:
    mesh, _, segmentation = ready(KNOWN["left"].scene)
    made = Questions(VisualPrompts(mesh, QUICK), true_answers(mesh, segmentation, (KNOWN["left"].joint,)), QUICK)
    assert (made.category, made.labels) == ("object", ())
    assert replace(made, config=replace(QUICK, category="oven")).category == "oven"
    told = Recognition("stove", None, (RecognizedLabel("door", None, None, None), RecognizedLabel("knob", None, None, None)))
    recognized = replace(made, recognition=told, config=replace(QUICK, category="oven"))
    assert (recognized.category, recognized.labels) == ("stove", ("door", "knob"))


@pytest.mark.parametrize("kind", [INTO, HIDDEN, ALONG])
def test_the_ends_of_the_axis_of_a_tap_are_points_of_its_lever(kind: JointAppearance, monkeypatch: pytest.MonkeyPatch) -> None:
    """A lever on a round stem, which is round neither as a whole nor along its opening direction."""
    lever = [*upright(prism(0.02, (0.1, 0.15), 0.15, -0.15, 32)), box((0.14, -0.05, 0.15), (0.16, 0.17, 0.16))]
    scene = {"base": [box((0, 0, 0), (0.3, 0.3, 0.1))], "lever": lever}
    monkeypatch.setitem(KNOWN, "tap", Known(scene, known("revolute", np.eye(3)[2], (0.15, 0.15, 0))))
    points = asked.__wrapped__("tap", kind)[0].points
    heights = points[np.linalg.norm(points[:, :2] - 0.15, axis=1) < 0.002][:, 2]
    assert heights.max() > 0.149
    assert kind is INTO or heights.min() == pytest.approx(0.1)


NONE = np.zeros((0, 3))  # points in contact


def upright(*pieces) -> list:
    """Return pieces along y turned upright."""
    return [(v @ np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]), f) for v, f in pieces]


@pytest.mark.parametrize("height", [0.02, 0.2])
def test_the_height_of_a_round_lid_is_over_its_radius(height: float) -> None:
    pot = annulus(0.16, 0.2, 0.3, sections=64)
    lid = upright(prism(0.2, (0.152, 0.152 + height), 0.0, 0.0, 64))
    values = part_values(context_of(lid, [(np.asarray(pot.vertices), np.asarray(pot.faces))]), NONE)
    assert values["height over radius"] == pytest.approx(height / 0.2, abs=0.02)
    assert values["log2 height over width"] == 0


def test_the_values_of_an_upright_panel() -> None:
    panel = context_of([box((0, -0.03, 0.2), (0.6, -0.002, 0.5))], [box((0, 0, 0), (0.6, 0.4, 1))])
    values = part_values(panel, panel.part.samples.points)
    size = np.linalg.norm([0.6, 0.3, 0.028])
    expected = {
        "log2 height over width": -1, "height": 0.35, "opening direction up": 0, "contact share": 1,
        "thinness": 0.028 / 0.3, "width over length": 0.5, "thickness": 0.028 / panel.diagonal, "size": size / panel.diagonal,
    }  # fmt: skip
    assert values == pytest.approx(values | expected)
    assert panel.opening_direction == pytest.approx(-Y)
    facts = PartFacts.of(panel, "door")
    assert (facts.label, facts.size, facts.roundness) == ("door", pytest.approx(size), values["roundness"])
