"""Stages A and B on one mesh, answered by geometry, a vision-language model, or ground truth in an evaluation."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property, partial
from pathlib import Path
from typing import Protocol

import numpy as np
from jaxtyping import Bool

from anymesh.articulation.estimate import PartMotions, choose_motion, is_named, part_motions, with_labels_of
from anymesh.articulation.rank_motions import DRAWER, MIN_LABEL_CONFIDENCE, label_of
from anymesh.articulation.vetting import vetted_joints
from anymesh.config import Config
from anymesh.entry_points import PROMPTED_STAGES, STATED_JOINTS, STATED_PARTS, USUAL_PARTS, WITH_GEARS, WITH_OTHERS, resolve
from anymesh.geometry.boxes import straight_mesh, turned_back
from anymesh.geometry.surface import DividedSurface, ObjectShape, ground_faces
from anymesh.pipeline.options import GEOMETRY
from anymesh.pipeline.results import JointResult, RecognitionResult, SegmentationResult, joint_result, segmentation_result
from anymesh.runtime import Deadline, Progress, silent
from anymesh.scoring.classifier import KindPrior
from anymesh.segmentation.divide import divide_surface
from anymesh.segmentation.naming import GIVEN, parts_from_file, parts_from_nodes, whole_as_base, with_names_of_file
from anymesh.segmentation.segment import LabelParts, segment_parts
from anymesh.types import Joint, JointType, Mesh, Segmentation
from anymesh.types.motion import Recognition
from anymesh.types.questions import AnswererFactory
from anymesh.vocabulary import typical_motion

GROUND_WARNING = "the file contains a ground, which is part of the base"
# what would move on such a part is its handle: on 130 drawers and trays of Articraft there are three buttons and no knob that
# turns; on sliding gates there are rollers
HANDLES = {DRAWER: ("button", "knob"), "slider": ("button",)}
__all__ = ["Solver", "StageAnswerer", "solve"]


class GeometryStages:
    """Geometry as the answerer of both stages (see `StageAnswerer`), and what it finds for the fallback of others."""

    name = GEOMETRY
    recognizes = False

    def __init__(self, mesh: Mesh, config: Config, deadline: Deadline, *, seams: bool = False, name: str = "") -> None:
        self.mesh, self.config, self.deadline, self._seams = mesh, config, deadline, seams
        self.category, self._name = config.category, name  # as given, or as a model answers; of the file
        self._by_itself: Segmentation | None = None
        self._swept: tuple[bytes, list[PartMotions]] | None = None  # faces of parts, and their motions

    @property
    def _usual(self) -> KindPrior | None:
        """Return the moving parts of the kind that the category, the file or its only node names."""
        nodes = self.mesh.nodes
        return resolve(USUAL_PARTS)(self.category, self._name, nodes[0].name if len(nodes) == 1 else None)

    @cached_property
    def whole(self) -> ObjectShape:
        """Return the object as both stages use it."""
        return self._divided.simplified()

    @cached_property
    def _divided(self) -> DividedSurface:
        return divide_surface(self.mesh, self.config.seed, seams=self._seams)

    @cached_property
    def _ground(self) -> Bool[np.ndarray, " F"]:
        return ground_faces(self.mesh)

    def recognize(self, *, sized: bool = False, metric: bool = False) -> RecognitionResult:
        """Return that nothing was recognized."""
        return RecognitionResult(None, self.name)

    def find_parts(self, recognition: Recognition | None, progress: Progress = silent) -> SegmentationResult:
        """Run Stage A."""
        parts = self.parts(progress)
        ground = (GROUND_WARNING,) if self._ground.any() else ()
        return segmentation_result(parts, self.name, self.deadline.warnings() + ground + self.too_few(parts))

    def too_few(self, parts: Segmentation) -> tuple[str, ...]:
        """Return a warning if there are fewer parts than were asked for."""
        least, count = self.config.at_least, len(parts.parts) - 1
        return () if count >= least else (f"--at-least {least}: there are only {count}, mark more in `anymesh view`",)

    def estimate_joints(
        self, segmentation: Segmentation, recognition: Recognition | None, progress: Progress = silent, grounded: bool = False
    ) -> JointResult:
        """Run Stage B."""
        motions = self.motions(segmentation, progress)
        vetted = vetted_joints(segmentation, motions)
        joints = resolve(WITH_OTHERS)(vetted.joints, segmentation, motions)
        return joint_result(joints, self.name, self.deadline.warnings(), doubts=vetted.doubts)

    def parts(self, progress: Progress = silent) -> Segmentation:
        """Return the parts found by geometry, computed once.

        A ground belongs to the base and is left out; if nothing moves without it, it may be what the parts hang on.
        """
        if self._by_itself is None:
            above = self._parts_above_ground(progress) if self._ground.any() else None
            if above is None or len(above.parts) <= max(1, self.config.at_least):
                above = self._segment(self.mesh, self.whole, self._labels, progress)
            self._by_itself = above
        return self._by_itself

    def _parts_above_ground(self, progress: Progress) -> Segmentation:
        object_ = self.mesh.subset(~self._ground)
        divided = divide_surface(object_, self.config.seed, seams=self._seams)

        def with_ground(segmentation: Segmentation) -> Segmentation:
            face_part = np.zeros(len(self.mesh.faces), np.int64)
            face_part[~self._ground] = segmentation.face_part
            return replace(segmentation, face_part=face_part)

        def labels(segmentation: Segmentation) -> list[str]:
            return self._labels(with_ground(segmentation))

        return with_ground(self._segment(object_, divided.simplified(), labels, progress))

    def _segment(self, mesh: Mesh, whole: ObjectShape, labels: LabelParts, progress: Progress) -> Segmentation:
        return segment_parts(mesh, whole, labels, self.config.at_least, progress, self.deadline, self._usual)

    def _labels(self, segmentation: Segmentation) -> list[str]:
        """Return a label of each part but the base from its motion by geometry; "" for one without a name that cannot move.

        It is "part" where the motion is not sure enough to tell. What stands on a drawer is its handle (`HANDLES`).
        """
        swept = self.motions(segmentation)
        choices = {i: choose_motion(context, motions) for i, _, context, motions in swept}
        shown = {i: label_of(context, choices[i][1]) for i, _, context, _ in swept}
        labels = {}
        for i, parent, _, _ in swept:
            choice, own, label = choices[i][0], segmentation.parts[i], shown[i]
            handle = label in HANDLES.get(shown.get(parent, ""), ())
            still = (choice.type is JointType.FIXED or handle) and (typical_motion(own.label) is None or not is_named(own))
            sure = label == own.label or choice.confidence >= MIN_LABEL_CONFIDENCE.get(label, 0.0)
            labels[i] = "" if still else label if sure else "part"
        return [labels[i] for i in sorted(labels)]

    def motions(self, segmentation: Segmentation, progress: Progress = silent) -> list[PartMotions]:
        """Sweep the motions of all parts; the last result is cached."""
        faces = segmentation.face_part.tobytes()
        if self._swept is None or self._swept[0] != faces:
            shape = self.shape_for(segmentation)
            self._swept = faces, list(part_motions(shape, segmentation, self.deadline, progress=progress, usual=self._usual))
            return self._swept[1]
        progress("joints", segmentation.parts[-1].name, len(segmentation.parts) - 1, len(segmentation.parts))
        return with_labels_of(segmentation, self._swept[1])

    def shape_for(self, segmentation: Segmentation) -> ObjectShape:
        """Return the object's shape, simplified so that no face lies in two of these parts."""
        label, whole = segmentation.face_part, self.whole
        if (label == label[whole.source][np.unique(whole.patch, return_index=True)[1]][whole.mesh_patch]).all():
            return whole
        return self._divided.simplified(label)


class StageAnswerer(Protocol):
    """Answerer of stages A and B about one object: `GeometryStages`, or `PromptedStages` of `anymesh.prompted`.

    recognizes: whether the object is recognized first, by a stage with a result of its own.
    """

    recognizes: bool

    def recognize(self, *, sized: bool = False, metric: bool = False) -> RecognitionResult:
        """Recognize the object and its movable parts.

        sized: the answered size sets the scale, unless the file states its unit (metric). A contradicting size that does not
        set it gives a warning.
        """
        ...

    def find_parts(self, recognition: Recognition | None, progress: Progress = silent) -> SegmentationResult:
        """Run Stage A."""
        ...

    def estimate_joints(
        self, segmentation: Segmentation, recognition: Recognition | None, progress: Progress = silent, grounded: bool = False
    ) -> JointResult:
        """Run Stage B.

        grounded: the parts come from `find_parts`, so that answers may once call them too much or too little.
        """
        ...


class Solver:
    """Stage A and Stage B for one placed mesh [m, Z up].

    `answerer_factory` makes the visual answerer; without it geometry answers, in a frame that is turned about the vertical so
    that the object is straight. name: of the file, which may name the object's kind. The
    warnings of each stage include what was left out after the deadline.
    """

    def __init__(
        self,
        mesh: Mesh,
        config: Config | None = None,
        answerer_factory: AnswererFactory | None = None,
        deadline: Deadline | None = None,
        name: str = "",
    ) -> None:
        self.mesh = mesh
        straight, self._T_straight = straight_mesh(mesh) if answerer_factory is None else (mesh, np.eye(4))
        seams = answerer_factory is not None  # the geometry answerer finds no more with finer patches (docs/decisions/0010)
        self.geometry = GeometryStages(straight, config or Config(), deadline or Deadline(), seams=seams, name=name)
        self.answers: StageAnswerer = (
            self.geometry if answerer_factory is None else resolve(PROMPTED_STAGES)(self.geometry, answerer_factory)
        )

    def parts(
        self, parts: str = "auto", recognition: Recognition | None = None, progress: Progress = silent
    ) -> SegmentationResult:
        """Run Stage A.

        parts: auto, nodes, none (all of it is the base), or a file of face labels.
        """
        if parts in ("auto", "nodes"):
            nodes = parts == "nodes"
            result = (
                segmentation_result(parts_from_nodes(self.mesh), GIVEN)
                if nodes
                else self.answers.find_parts(recognition, progress)
            )
            result = resolve(STATED_PARTS)(self.mesh, result) if self.mesh.joints else result
            return replace(result, segmentation=with_names_of_file(self.mesh, result.segmentation))
        given = whole_as_base(self.mesh) if parts == "none" else parts_from_file(self.mesh, Path(parts))
        return segmentation_result(given, GIVEN)

    def joints(
        self,
        segmentation: Segmentation,
        recognition: Recognition | None = None,
        progress: Progress = silent,
        grounded: bool = False,
    ) -> JointResult:
        """Run Stage B, see `StageAnswerer`; joints that the file states replace those that it estimates."""
        estimate = partial(self.answers.estimate_joints, segmentation, recognition, progress, grounded)
        stated = self.geometry.mesh.joints
        result = resolve(STATED_JOINTS)(self.geometry, segmentation, estimate) if stated else estimate()
        joints = tuple(turned_back(joint, self._T_straight) for joint in result.joints)
        return replace(result, joints=resolve(WITH_GEARS)(self.mesh, result.segmentation or segmentation, joints))


def solve(
    mesh: Mesh,
    given: Segmentation | None = None,
    *,
    config: Config | None = None,
    answerer_factory: AnswererFactory | None = None,
) -> tuple[Segmentation, tuple[Joint, ...]]:
    """Run both stages on a mesh in the asset frame; only Stage B if the parts are given."""
    solver = Solver(mesh, config, answerer_factory)
    if given is not None:
        return given, solver.joints(given).joints
    recognition = solver.answers.recognize().recognition
    segmentation = solver.parts("auto", recognition).segmentation
    jointed = solver.joints(segmentation, recognition, grounded=True)
    return jointed.segmentation or segmentation, jointed.joints
