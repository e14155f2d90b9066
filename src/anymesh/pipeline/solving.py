"""Stages A and B on one mesh, answered by geometry, a vision-language model, or ground truth in an evaluation."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import cached_property, partial
from pathlib import Path

import numpy as np

from anymesh.articulation.estimate import PartMotions, choose_motion, estimate_joints, motion_questions, relabelled
from anymesh.articulation.freedom import stays_free
from anymesh.articulation.geometry_answerer import GeometryAnswerer
from anymesh.articulation.part_labels import label_of
from anymesh.articulation.prompted import Questions, Reground, prompt_joints
from anymesh.config import Config
from anymesh.deadline import Deadline
from anymesh.geometry.patches import DividedSurface, ObjectShape
from anymesh.models.sam import PromptedSegmenter
from anymesh.models.sam_load import load_sam
from anymesh.pipeline.results import JointResult, RecognitionResult, SegmentationResult
from anymesh.progress import Progress, silent
from anymesh.rendering.visual_prompts import VisualPrompts
from anymesh.segmentation.ask_marks import MarkQuestioner
from anymesh.segmentation.divide import divide_surface
from anymesh.segmentation.given import GIVEN, parts_from_file, parts_from_nodes
from anymesh.segmentation.grounded import ground_parts
from anymesh.segmentation.grounded_parts import EXACT, SampledObject, sample_object
from anymesh.segmentation.hidden import MIN_RECOGNITION_PATCH_RATIO, inner_faces, seen_points
from anymesh.segmentation.regrounding import ground_again
from anymesh.segmentation.segment import segment_parts
from anymesh.types import Joint, JointType, Mesh, Picture, Segmentation
from anymesh.types.recognition import Recognition
from anymesh.vlm.asking import VisualAnswerer
from anymesh.vlm.recognition import answered_scale, recognize
from anymesh.vlm.reference import Reference, reference_of
from anymesh.vlm.reference_answerer import ReferenceAnswerer

AnswererFactory = Callable[[VisualAnswerer], VisualAnswerer]  # makes a visual answerer with the given fallback
MAX_INSIDE_VIEWS = 2  # pictures of the inside in the question about the object
LOW_CONFIDENCE = 0.4  # warnings name joints below this confidence
GEOMETRY = GeometryAnswerer()


class Solver:
    """Stage A and Stage B for one placed mesh [m, Z up].

    `answerer_factory` makes the answerer; without it geometry answers. The warnings of each stage include what was left out
    after the deadline.
    """

    def __init__(
        self,
        mesh: Mesh,
        config: Config | None = None,
        answerer_factory: AnswererFactory | None = None,
        deadline: Deadline | None = None,
    ) -> None:
        self.mesh, self.config, self._see = mesh, config or Config(), answerer_factory
        self.deadline = deadline or Deadline()
        self._by_itself: Segmentation | None = None
        self._swept: tuple[bytes, list[PartMotions]] | None = None  # faces of parts, and their motions

    @cached_property
    def whole(self) -> ObjectShape:
        """Return the object as both stages use it."""
        return self._divided.simplified(self.config.pieces)

    @cached_property
    def _divided(self) -> DividedSurface:
        return divide_surface(self.mesh, self.config.seed, self.config.pieces)

    @cached_property
    def _segmenter(self) -> PromptedSegmenter | None:
        spec = self.config.proposer.removeprefix(f"{EXACT}+")
        return None if spec == EXACT else load_sam(spec)

    @cached_property
    def _sampled(self) -> SampledObject:
        return sample_object(self.mesh, self.whole, self.config)

    @cached_property
    def _visual_prompts(self) -> VisualPrompts:
        return VisualPrompts(self.mesh, self.config)

    def recognize(self, *, sized: bool = False, metric: bool = False) -> RecognitionResult:
        """Recognize the object and its movable parts by a visual answerer.

        sized: the answered size sets the scale, unless the file states its unit (metric). In that case a contradicting size
        gives a warning.
        """
        if self._see is None:
            return RecognitionResult(None, GEOMETRY.name)
        _ = self._segmenter  # report unusable weights before anything is asked
        answerer = self._see(ReferenceAnswerer(GEOMETRY.name, lambda: self._geometric_reference))
        azimuths = [azimuth for azimuth, _ in self.config.views.directions]
        found = recognize(self._view_pictures, answerer, self.config.category, self.config.parts_list, azimuths)
        scale, note, doubt = answered_scale(found, float(self.mesh.extents.max()), metric=metric) if sized else (1.0, "", ())
        return RecognitionResult(found, answerer.name, scale, note, (*answerer.warnings, *doubt), answerer.exchanges)

    def _view_pictures(self) -> tuple[Picture, ...]:
        seen, prompts, cloud = self._visual_prompts.views, self._visual_prompts, self._sampled.cloud
        names = prompts.names(len(seen))
        inside = inner_faces(self.mesh, self.whole, cloud, seen_points(cloud, seen), MIN_RECOGNITION_PATCH_RATIO)
        if inside.any():
            chosen = prompts.clearest_inside_views(inside, MAX_INSIDE_VIEWS)
            seen = [*seen, *(prompts.insides(inside)[k] for k in chosen)]
            names += [prompts.inside_names()[k] for k in chosen]
        return prompts.pictures([view.color for view in seen], names)

    def parts(
        self, parts: str = "auto", recognition: Recognition | None = None, progress: Progress = silent
    ) -> SegmentationResult:
        """Run Stage A.

        parts: auto, nodes, or a file of face labels.
        """
        if parts != "auto":
            given = parts_from_nodes(self.mesh) if parts == "nodes" else parts_from_file(self.mesh, Path(parts))
            return _segmentation_result(given, GIVEN)
        if self._see is None or recognition is None:
            return _segmentation_result(self._geometric_parts(progress), GEOMETRY.name, None, self.deadline.warnings())
        answerer = self._see(ReferenceAnswerer(GEOMETRY.name, lambda: self._geometric_reference))
        labels = tuple(r.label for r in recognition.labels)
        questioner = MarkQuestioner(answerer, self._visual_prompts, labels, recognition.category, self.config)
        found, warnings = ground_parts(
            self._sampled,
            questioner,
            recognition,
            self._segmenter,
            self._geometric_parts,
            partial(stays_free, self.whole, self.config.articulation),
            progress,
        )
        return _segmentation_result(found, answerer.name, answerer, (*warnings, *self.deadline.warnings()))

    def joints(
        self,
        segmentation: Segmentation,
        recognition: Recognition | None = None,
        progress: Progress = silent,
        grounded: bool = False,
    ) -> JointResult:
        """Run Stage B.

        grounded: the parts come from `parts`, so that answers may once call them too much or too little.
        """
        if self._see is None:
            found = estimate_joints(segmentation, self._motions(segmentation, progress), GEOMETRY)
            return _joint_result(found, GEOMETRY.name, None, self.deadline.warnings())
        answerer = self._see(ReferenceAnswerer(GEOMETRY.name, lambda: self._reference(segmentation)))
        questions = Questions(self._visual_prompts, answerer, self.config, recognition, progress)
        reground = self._regrounding(questions, segmentation) if grounded and recognition is not None else None
        made = prompt_joints(questions, self._ready_for, segmentation, reground)
        found = _joint_result(made.joints, answerer.name, answerer, (*made.warnings, *self.deadline.warnings()))
        return replace(found, segmentation=made.segmentation if made.segmentation is not segmentation else None)

    def _regrounding(self, questions: Questions, segmentation: Segmentation) -> Reground:
        """Return the function that grounds wrong parts again."""
        recognition = questions.recognition
        asked = MarkQuestioner(questions.answerer, self._visual_prompts, questions.labels, questions.category, self.config)
        front = recognition.front if recognition else None
        return lambda wrong: ground_again(self._sampled, asked, segmentation, wrong, front)

    def _geometric_parts(self, progress: Progress = silent) -> Segmentation:
        """Return the parts found by geometry, computed once."""
        if self._by_itself is None:
            self._by_itself = segment_parts(self.mesh, self.whole, self._labels, self.config, progress, self.deadline)
        return self._by_itself

    def _labels(self, segmentation: Segmentation) -> list[str]:
        """Return a label of each part but the base from its motion by geometry; "" for a part that cannot move."""
        found = {}
        for i, _, around, question in self._motions(segmentation):
            answer, best = choose_motion(around, question, GEOMETRY)
            found[i] = "" if answer.type is JointType.FIXED else label_of(around, best)
        return [found[i] for i in sorted(found)]

    def _motions(self, segmentation: Segmentation, progress: Progress = silent) -> list[PartMotions]:
        """Sweep the motions of all parts; the last result is cached."""
        faces = segmentation.face_part.tobytes()
        if self._swept is None or self._swept[0] != faces:
            found = motion_questions(self._ready_for(segmentation), segmentation, self.config, self.deadline)
            self._swept = faces, list(_with_progress(found, segmentation, progress))
            return self._swept[1]
        return list(_with_progress(relabelled(self._swept[1], segmentation), segmentation, progress))

    def _ready_for(self, segmentation: Segmentation) -> ObjectShape:
        """Return the object with patches that each belong to one of these parts."""
        label, whole = segmentation.face_part, self.whole
        if (label == label[whole.source][np.unique(whole.patch, return_index=True)[1]][whole.mesh_patch]).all():
            return whole
        return self._divided.simplified(self.config.pieces, label)

    @cached_property
    def _geometric_reference(self) -> Reference:
        return self._reference(self._geometric_parts())

    def _reference(self, segmentation: Segmentation) -> Reference:
        """Return the reference made of geometry's answers, the fallback of a model."""
        joints = estimate_joints(segmentation, self._motions(segmentation), GEOMETRY)
        return reference_of(self.mesh, segmentation, joints, self.config.category or "object")


def _with_progress(swept: Iterable[PartMotions], segmentation: Segmentation, progress: Progress) -> Iterator[PartMotions]:
    """Report progress for each part."""
    for done, motions in enumerate(swept):
        progress("joints", segmentation.parts[motions[0]].name, done, len(segmentation.parts) - 1)
        yield motions


def _segmentation_result(
    segmentation: Segmentation, name: str, answerer: VisualAnswerer | None = None, warnings: tuple[str, ...] = ()
) -> SegmentationResult:
    none = ("no moving part was found",) if len(segmentation.parts) == 1 else ()
    noted = answerer.warnings if answerer else ()
    return SegmentationResult(segmentation, name, (*noted, *warnings, *none), answerer.exchanges if answerer else ())


def _joint_result(
    joints: tuple[Joint, ...], name: str, answerer: VisualAnswerer | None = None, cut: tuple[str, ...] = ()
) -> JointResult:
    unsure = tuple(
        f"joint {j.name}: low confidence ({j.confidence:.2f}), please check" for j in joints if j.confidence < LOW_CONFIDENCE
    )
    noted = answerer.warnings if answerer else ()
    return JointResult(joints, name, (*noted, *cut, *unsure), answerer.exchanges if answerer else ())


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
    recognition = solver.recognize().recognition
    segmentation = solver.parts("auto", recognition).segmentation
    jointed = solver.joints(segmentation, recognition, grounded=True)
    return jointed.segmentation or segmentation, jointed.joints
