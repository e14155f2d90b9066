"""Small scenes with a reference answerer of their joints, and the joints that result."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from assets import box
from scenes import Scene, built, case, door, drawer, lid, slider, wheel

from anymesh.articulation.candidate_motions import CandidateMotions
from anymesh.config import Config
from anymesh.geometry.surface import ObjectShape
from anymesh.prompted.answerers.reference import Reference, ReferenceAnswerer
from anymesh.prompted.motions.cases import PartCase, make_cases
from anymesh.prompted.motions.joints import Questions, prompt_joints
from anymesh.prompted.motions.offers import scored_motions
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.prompted.questions.prompting import KindAnswer
from anymesh.segmentation.divide import object_shape
from anymesh.types import Exchange, Joint, JointType, KnownJoint, Mesh, Segmentation
from anymesh.types.motion import Recognition
from anymesh.types.questions import VisualAnswerer

X, Y, Z = np.eye(3)
# half the resolution
QUICK = Config(ask="all")


def known(kind: str, axis, origin=(0.0, 0, 0), limits: tuple[float, float] | None = (0.0, 1.9)) -> KnownJoint:
    return KnownJoint(JointType(kind), np.asarray(origin, float), np.asarray(axis, float), limits)


def open_drawer() -> Scene:
    """Return a half-open drawer: a box of boards in a case, close to it at its sides and floor but not at its rim."""
    tray = [
        box((0.022, -0.18, 0.025), (0.578, 0.18, 0.033)),
        box((0.022, -0.18, 0.033), (0.032, 0.18, 0.2)),
        box((0.568, -0.18, 0.033), (0.578, 0.18, 0.2)),
        box((0.032, 0.17, 0.033), (0.568, 0.18, 0.2)),
    ]
    return {"base": case(0.28), "box": [box((0.005, -0.2, 0.005), (0.595, -0.18, 0.275)), *tray]}


@dataclass(frozen=True)
class Known:
    """A scene and the true joint of its only moving part."""

    scene: Scene
    joint: KnownJoint


KNOWN = {
    "left": Known(door("left"), known("revolute", Z, (0.598, -0.012, 0))),
    "right": Known(door("right"), known("revolute", -Z, (0.002, -0.012, 0))),
    "drawer": Known(drawer(), known("prismatic", -Y, limits=(0.0, 0.3))),
    "open drawer": Known(open_drawer(), known("prismatic", -Y, limits=(-0.15, 0.15))),
    "lid": Known(lid(), known("revolute", -X, (0, 0.4, 0.305), (0.0, 1.6))),
    "slider": Known(slider(), known("prismatic", X, limits=(0.0, 0.5))),
    "wheel": Known(wheel(), known("continuous", Y, (0, 0, 0.2), None)),
}


def row_of(*names: str) -> tuple[Scene, tuple[KnownJoint, ...]]:
    """Return some of these scenes side by side on one base."""
    scene, joints = {"base": []}, []
    for k, name in enumerate(names):
        shift = np.array([1.5 * k, 0, 0])
        for part, pieces in KNOWN[name].scene.items():
            scene.setdefault(part if part == "base" else name, []).extend((v + shift, f) for v, f in pieces)
        joints.append(replace(KNOWN[name].joint, origin=KNOWN[name].joint.origin + shift))
    return scene, tuple(joints)


COMPUTED: dict[Any, Any] = {}


def once(compute: Callable[[], Any], *key: Any) -> Any:
    if key not in COMPUTED:
        COMPUTED[key] = compute()
    return COMPUTED[key]


def content(scene: Scene) -> tuple[Any, ...]:
    return tuple((part, *(array.tobytes() for piece in pieces for array in piece)) for part, pieces in scene.items())


def ready(scene: Scene) -> tuple[Mesh, ObjectShape, Segmentation]:
    """Return a scene's mesh, shape and parts, the same ones each time."""

    def compute() -> tuple[Mesh, ObjectShape, Segmentation]:
        mesh, segmentation = built(scene)
        return mesh, object_shape(mesh, 0, labels=segmentation.face_part), segmentation

    return once(compute, content(scene))


def visual_prompts(mesh: Mesh) -> VisualPrompts:
    """Return the pictures of a mesh at half the resolution, whose views are drawn once."""
    return once(lambda: VisualPrompts(mesh, QUICK), mesh)


def cases_once(
    whole: ObjectShape, segmentation: Segmentation, recognition: Recognition | None, config: Config
) -> list[PartCase]:
    """Return `make_cases`, computed once for the same parts of the same shape."""
    told = repr((segmentation.parts, recognition, config.seed))
    key = whole, segmentation.face_part.tobytes(), told
    return list(once(lambda: make_cases(whole, segmentation, recognition, config), *key))


def scored_once(case: PartCase) -> CandidateMotions:
    """Return `scored_motions`, computed once for the same answered motion: it does not depend on the answered kind."""
    asked = case.asked and (case.asked.kind, case.asked.source, case.asked.axis.tobytes(), case.asked.origin.tobytes())
    return once(lambda: scored_motions(case), case.context, case.label, asked)


def the_case(scene: Scene) -> PartCase:
    """Return the case of the only moving part of a scene."""
    _, whole, segmentation = ready(scene)
    (found,) = cases_once(whole, segmentation, None, Config())
    return found


def true_answers(mesh: Mesh, segmentation: Segmentation, joints: tuple[KnownJoint, ...]) -> ReferenceAnswerer:
    """Return an answerer with these joints, one per part after the base, all mounted on the base."""
    labels = ("base", *(p.label for p in segmentation.parts[1:]))
    made = Reference("object", 1.0, segmentation.face_part, mesh.face_areas, labels, (0,) * len(labels), (None, *joints))
    return ReferenceAnswerer("oracle", lambda: made)


@dataclass
class Watched:
    """Wrapper that records the questions to another answerer.

    changed: functions that replace its answers, by the kind of question; attached: kind of joint that replaces the one given
    with a motion.
    """

    answerer: VisualAnswerer
    changed: dict[str, Callable[[Any], Any]] = field(default_factory=dict)
    attached: KindAnswer | None = None
    asked: list[Any] = field(default_factory=list)
    name: str = "watched"
    exchanges: tuple[Exchange, ...] = ()
    warnings: tuple[str, ...] = ()

    def ask(self, question: Any) -> Any:
        self.asked.append(question)
        found = self.changed[question.kind](question) if question.kind in self.changed else self.answerer.ask(question)
        if self.attached is None or question.kind != "motions":
            return found
        return tuple(replace(pick, attached=self.attached) for pick in found)


def prompted(scene: Scene, joints: tuple[KnownJoint, ...], **options: Any) -> tuple[tuple[Joint, ...], Watched]:
    """Return the joints of a scene as estimated with its reference answerer; options: of Watched, Config, or recognition."""
    mesh, whole, segmentation = ready(scene)
    config = replace(QUICK, verify=options.pop("verify", "motion"), ask=options.pop("ask", "all"))
    recognition = options.pop("recognition", None)
    watched = Watched(true_answers(mesh, segmentation, joints), **options)
    questions = Questions(visual_prompts(mesh), watched, config, recognition)
    return prompt_joints(questions, lambda _: whole, segmentation).joints, watched
