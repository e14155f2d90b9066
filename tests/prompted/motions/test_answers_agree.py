"""Test labels of given parts and warnings about contradictions."""

from dataclasses import replace

import numpy as np
import pytest
from assets import box
from known import KNOWN, QUICK, Watched, prompted, ready, true_answers, visual_prompts
from scenes import Scene, prism, wheel

from anymesh.pipeline.solving import Solver
from anymesh.prompted.motions.cases import labels_by_name, make_cases
from anymesh.prompted.motions.joints import PromptedJoints, Questions, prompt_joints
from anymesh.prompted.motions.offers import normal_outwards, opening_slide
from anymesh.prompted.questions.prompting import JointAppearance, KindAnswer, MotionPick, PartFit
from anymesh.types import JointType, Part, Segmentation
from anymesh.types.motion import Recognition, RecognizedLabel

pytestmark = pytest.mark.usefixtures("computed_once")
LEFT = KNOWN["left"]
X, Y, Z = np.eye(3)


def recognition(*labels: RecognizedLabel) -> Recognition:
    return Recognition("cabinet", None, labels)


DOOR = RecognizedLabel("door", JointType.REVOLUTE, "base", (0.0, 1.2))
TRAY = RecognizedLabel("tray", JointType.PRISMATIC, "base", (0.0, 0.3))


def asked(
    scene: Scene, told: Recognition, name: str = "leaf", verify: str = "motion", **changed
) -> tuple[PromptedJoints, Watched]:
    mesh, whole, segmentation = ready(scene)
    segmentation = replace(segmentation, parts=(segmentation.parts[0], Part(name, "part")))
    config = replace(QUICK, verify=verify)
    watched = Watched(true_answers(mesh, segmentation, (LEFT.joint,)), changed, changed.pop("attached", None))
    return prompt_joints(Questions(visual_prompts(mesh), watched, config, told), lambda _: whole, segmentation), watched


@pytest.mark.parametrize(
    ("name", "label"),
    [("rudder_left", "rudder"), ("LeftRudders02", "rudder"), ("front door", "door"), ("door handle", "handle"), ("x", "part")],
)
def test_recognized_labels_reach_given_parts_by_their_names(name: str, label: str) -> None:
    given = Segmentation(np.array([0, 1]), (Part("body", "base"), Part(name, "part")))
    assert labels_by_name(given, ("rudder", "door", "handle")).parts[1] == Part(name, label)


def test_a_label_that_was_recognized_already_is_kept() -> None:
    given = Segmentation(np.array([0, 1]), (Part("body", "base"), Part("rudder", "door")))
    assert labels_by_name(given, ("rudder", "door")).parts[1].label == "door"


def test_a_name_brings_the_recognized_limits_and_nothing_more_is_asked() -> None:
    found, answerer = asked(LEFT.scene, recognition(DOOR, TRAY), "cabinet_door_3")
    assert found.joints[0].limits == (0, pytest.approx(1.2, abs=0.02))
    assert found.segmentation.parts[1].label == "door"
    assert "label" not in answerer.asked[0].schema()["properties"]["parts"]["items"]["properties"]


def test_a_part_without_a_telling_name_is_asked_for_its_label() -> None:
    door = KindAnswer(JointAppearance.HINGE_ALONG, label="door")
    found, answerer = asked(LEFT.scene, recognition(DOOR, TRAY), "mesh_17", attached=door)
    assert [q.labels for q in answerer.asked] == [("door", "tray")]
    assert found.joints[0].limits == (0, pytest.approx(1.2, abs=0.02))
    assert found.segmentation.parts[1].label == "door"


def test_answers_that_contradict_each_other_are_a_warning_and_lower_the_confidence() -> None:
    right, _ = asked(LEFT.scene, recognition(DOOR), "door")
    wrong, _ = asked(LEFT.scene, recognition(replace(DOOR, moves=JointType.PRISMATIC)), "door")
    assert right.warnings == ()
    (warning,) = wrong.warnings
    assert "recognized as prismatic, then hinge along edge" in warning
    assert wrong.joints[0].confidence < right.joints[0].confidence


def test_what_is_recognized_as_moving_is_not_fixed_by_one_answer() -> None:
    fixed = {"attached": KindAnswer(JointAppearance.FIXED)}
    found, answerer = asked(LEFT.scene, recognition(DOOR), "door", **fixed)
    assert [q.kind for q in answerer.asked] == ["motions"]
    assert found.joints[0].type is JointType.REVOLUTE
    assert "then fixed" in found.warnings[0]
    right, _ = asked(LEFT.scene, recognition(DOOR), "door")
    none, _ = asked(LEFT.scene, recognition(DOOR), "door", **fixed, motions=lambda q: (MotionPick(None),))
    assert none.joints[0].type is JointType.FIXED
    assert none.joints[0].confidence < right.joints[0].confidence


def test_a_part_that_is_too_much_is_grounded_again_once() -> None:
    calls = []

    def reground(wrong) -> Segmentation:
        calls.append(dict(wrong))
        return segmentation

    mesh, whole, segmentation = ready(LEFT.scene)
    answerer = Watched(true_answers(mesh, segmentation, (LEFT.joint,)))
    answerer.changed = {"motions": lambda q: tuple(replace(a, part=PartFit.TOO_MUCH) for a in answerer.answerer.ask(q))}
    questions = Questions(visual_prompts(mesh), answerer, QUICK)
    found = prompt_joints(questions, lambda _: whole, segmentation, reground)
    assert calls == [{"leaf": PartFit.TOO_MUCH}]
    first, second = (q for q in answerer.asked if q.kind == "motions")
    assert "part_is" in first.schema()["properties"]["parts"]["items"]["properties"]
    assert "part_is" not in second.schema()["properties"]["parts"]["items"]["properties"]  # only once
    assert found.joints[0].type is JointType.REVOLUTE
    kept = prompt_joints(questions, lambda _: whole, segmentation, lambda wrong: None)
    assert [j.type for j in kept.joints] == [JointType.REVOLUTE]
    assert found.warnings == kept.warnings == ("part leaf: its region was called too much, but its marks stayed, please check",)


def test_the_papers_method_takes_the_planes_normal_and_the_free_one_what_is_held() -> None:
    """On an open drawer the connecting area is its sides, so the normal of its plane is no opening direction."""
    _, whole, segmentation = ready(KNOWN["open drawer"].scene)
    (case,) = make_cases(whole, segmentation, None, QUICK)
    assert abs(normal_outwards(case).axis @ case.shown.normal) == pytest.approx(1)
    assert abs(opening_slide(case).axis @ Y) > 0.999
    for verify, axis in (("off", normal_outwards(case).axis), ("free", opening_slide(case).axis)):
        (found,), answerer = prompted(KNOWN["open drawer"].scene, (KNOWN["open drawer"].joint,), verify=verify)
        assert abs(found.axis @ axis) > 0.999
        assert [q.kind for q in answerer.asked] == ["kinds"]


def test_the_papers_method_offers_clusters_alone_for_an_axis_into_the_surface() -> None:
    into = {"kinds": lambda q: (KindAnswer(JointAppearance.HINGE_INTO),)}
    tables = {}
    for verify in ("off", "free"):
        _, answerer = prompted(wheel(), (KNOWN["wheel"].joint,), verify=verify, changed=into)
        tables[verify] = answerer.asked[1].tables[0]
    assert tables["off"].axes is None
    assert (tables["off"].max_points, tables["free"].max_points) == (1, min(2, len(tables["free"].points)))
    assert np.abs(tables["free"].axes[0] @ Y) == pytest.approx(1)


def test_only_points_that_are_drawn_are_listed_and_hidden_ones_are_told() -> None:
    knob = box((0.2, -0.05, 0.2), (0.4, -0.001, 0.4))
    scene = {"base": [box((0, 0, 0), (0.6, 0.4, 0.6))], "knob": [knob]}
    _, answerer = prompted(
        scene, (KNOWN["left"].joint,), verify="free", changed={"kinds": lambda q: (KindAnswer(JointAppearance.HINGE_INTO),)}
    )
    (table,) = answerer.asked[1].tables
    assert table.hidden is not None
    assert len(table.hidden) == len(table.points)
    assert not table.hidden[0]  # where the axis leaves the knob's face
    assert table.hidden[1:].any()  # clusters between the knob and the block
    assert f"points 1..{len(table.points)}" in answerer.asked[1].text()
    assert "hidden" in answerer.asked[1].text()


def test_labels_that_were_answered_are_part_of_the_stages_result() -> None:
    mesh, _, segmentation = ready(LEFT.scene)
    given = replace(segmentation, parts=(segmentation.parts[0], Part("cabinet_door", "part")))
    solver = Solver(mesh, QUICK, lambda _: true_answers(mesh, segmentation, (LEFT.joint,)))
    named = solver.joints(given, recognition(DOOR))
    assert named.segmentation is not None
    assert [p.label for p in named.segmentation.parts] == ["part", "door"]
    assert named.joints[0].limits == (0, pytest.approx(1.2, abs=0.02))
    assert solver.joints(given).segmentation is None  # nothing was recognized


def test_each_axis_goes_with_the_point_where_it_comes_out() -> None:
    """On a blade with two round pins, the hinge runs through the pin whose point is picked."""
    pins = [prism(0.02, (-0.03, -0.001), x, 0.3) for x in (0.1, 0.5)]
    scene = {"base": [box((0, 0, 0), (0.6, 0.4, 0.6))], "blade": [box((0.05, -0.02, 0.25), (0.55, -0.001, 0.35)), *pins]}
    into = {"kinds": lambda q: (KindAnswer(JointAppearance.HINGE_INTO),)}
    for pick in range(3):
        (found,), answerer = prompted(
            scene, (LEFT.joint,), verify="free", changed={**into, "points": lambda q, k=pick: ((k,),)}
        )
        (table,) = answerer.asked[1].tables
        assert table.axes is not None
        assert not np.isnan(table.axes[pick]).any()
        assert np.linalg.norm(np.cross(found.origin - table.points[pick], found.axis)) < 1e-6
        assert abs(found.axis @ table.axes[pick]) == pytest.approx(1)
        outer = table.points[pick] @ Y
        assert outer == pytest.approx(-0.03, abs=2e-3)  # where the axis leaves the pins


def test_a_label_that_hangs_on_itself_is_that_of_a_chain() -> None:
    arms = {"base": [box((0, 0, 0), (2, 2, 0.2))], "low": [box((0.9, 0.9, 0.2), (1.1, 1.1, 3.2))]}
    arms["high"] = [box((0.9, 1.1, 3.0), (1.1, 1.3, 6))]
    _, whole, segmentation = ready(arms)
    told = Recognition("lamp", None, (RecognizedLabel("part", JointType.REVOLUTE, "part", (-1.0, 1.0)),))
    assert [c.parent for c in make_cases(whole, segmentation, told, QUICK)] == ["base", "low"]
