"""Stages A and B of one mesh by a visual answerer: a vision-language model, answers in files, or ground truth."""

from __future__ import annotations

from copy import copy
from dataclasses import replace
from functools import cached_property, partial

import numpy as np

from anymesh.kinds.usual import kind_of
from anymesh.pipeline.results import (
    PLEASE_CHECK,
    JointResult,
    RecognitionResult,
    SegmentationResult,
    joint_result,
    segmentation_result,
)
from anymesh.pipeline.solving import GeometryStages
from anymesh.prompted.answerers.question_files import NAME as FILES
from anymesh.prompted.answerers.reference import Reference, ReferenceAnswerer, reference_of
from anymesh.prompted.grounding.cloud import seen_points
from anymesh.prompted.grounding.faces import stays_free
from anymesh.prompted.grounding.ground import Ground, ground_by_masks, ground_exactly, ground_parts
from anymesh.prompted.grounding.mark_questions import MAX_MARKS_PER_PICTURE, MarkQuestioner
from anymesh.prompted.grounding.regrounding import ground_again
from anymesh.prompted.grounding.sam_onnx_ import load_sam
from anymesh.prompted.grounding.views import (
    EXACT,
    MIN_RECOGNITION_PATCH_RATIO,
    SampledObject,
    inner_faces,
    region_cameras,
    sample_object,
)
from anymesh.prompted.motions.joints import Questions, Reground, prompt_joints
from anymesh.prompted.pictures.views import RECOGNITION_PX, shrunk
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.prompted.questions.recognition import GIVEN, RecognizeRegions, answered_scale, ask_recognition, in_size_of
from anymesh.runtime import Progress, silent
from anymesh.types import Picture, Segmentation
from anymesh.types.exchange import DrawnPictures
from anymesh.types.motion import Recognition
from anymesh.types.questions import AnswererFactory

MAX_INSIDE_VIEWS = 2  # pictures of the inside in the question about the object
FEW_PARTS = 4  # a machine of more moving parts, or of more regions than one picture of marks holds, is asked about by regions


class PromptedStages:
    """A visual answerer as the answerer of both stages (see `StageAnswerer`); geometry is its fallback."""

    recognizes = True

    def __init__(self, geometry: GeometryStages, answerer_factory: AnswererFactory) -> None:
        self._geometry, self._see = geometry, answerer_factory
        self.mesh, self.config, self.deadline = geometry.mesh, geometry.config, geometry.deadline

    @cached_property
    def _ground(self) -> Ground:
        spec = self.config.proposer.removeprefix(f"{EXACT}+")
        return ground_exactly if spec == EXACT else partial(ground_by_masks, segmenter=load_sam(spec))

    @cached_property
    def _sampled(self) -> SampledObject:
        return sample_object(self.mesh, self._geometry.whole, self.config)

    @cached_property
    def _reference_parts(self) -> Reference:
        return self._reference()

    def _reference(self, segmentation: Segmentation | None = None) -> Reference:
        """Return the reference made of geometry's answers, the fallback of a model."""
        geometry = copy(self._geometry)  # a suggestion is made by a thread, while the stages may go on
        segmentation = segmentation or geometry.parts()
        joints = geometry.estimate_joints(segmentation, None).joints
        return reference_of(self.mesh, segmentation, joints, self.config.category or "object")

    @cached_property
    def visual_prompts(self) -> VisualPrompts:
        """Return what draws the pictures of the questions."""
        return VisualPrompts(self.mesh, self.config)

    def recognize(self, *, sized: bool = False, metric: bool = False) -> RecognitionResult:
        """Recognize the object and its movable parts by a visual answerer.

        sized: the answered size sets the scale, unless the file states its unit (metric). A contradicting size that does not
        set it gives a warning.
        """
        _ = self._ground  # report unusable weights before anything is asked
        answerer = self._see(ReferenceAnswerer(self._geometry.name, lambda: self._reference_parts))
        azimuths = [azimuth for azimuth, _ in self.config.directions]
        recognition = ask_recognition(self._view_pictures, answerer, self.config.category, self.config.parts_list, azimuths)
        many = sum(r.count or 1 for r in recognition.labels) > FEW_PARTS
        if recognition.machine and (many or len(np.unique(self._sampled.regions)) > MAX_MARKS_PER_PICTURE):
            recognition = replace(recognition, labels=answerer.ask(self._regions(recognition)))
        kept = GIVEN if not sized else "the file's unit" if metric else ""
        size, measured = float(self.mesh.extents.max()), answerer.name == FILES
        scale, note, doubt = answered_scale(recognition, size, kept=kept, measured=measured)
        recognition = in_size_of(recognition, scale * size)
        warnings = (*answerer.warnings, *doubt, *_other_category(self.config.category, recognition.category))
        return RecognitionResult(recognition, answerer.name, scale, note, warnings, answerer.exchanges)

    def _view_pictures(self) -> tuple[Picture, ...]:
        seen, prompts, cloud = self.visual_prompts.views, self.visual_prompts, self._sampled.cloud
        names = prompts.names(len(seen))
        inside = inner_faces(self.mesh, self._geometry.whole, cloud, seen_points(cloud, seen), MIN_RECOGNITION_PATCH_RATIO)
        if inside.any():
            chosen = prompts.clearest_inside_views(inside, MAX_INSIDE_VIEWS)
            seen = [*seen, *(prompts.insides(inside)[k] for k in chosen)]
            names += [prompts.inside_names()[k] for k in chosen]
        return prompts.pictures([shrunk(view.color, RECOGNITION_PX) for view in seen], names)

    def _regions(self, recognition: Recognition) -> RecognizeRegions:
        """Return the question about kinds of part by regions."""
        prompts, near = self.visual_prompts, region_cameras(self._sampled, self.visual_prompts.views)
        names = prompts.names(len(prompts.views), recognition.front)

        def draw() -> tuple[Picture, ...]:
            titles = [f"region {number}, {names[v]}" for number, v, _ in near]
            return prompts.pictures([prompts.view(camera).color for _, _, camera in near], titles)

        return RecognizeRegions(
            DrawnPictures(draw), tuple(number for number, _, _ in near), recognition.labels, recognition.category
        )

    def find_parts(self, recognition: Recognition | None, progress: Progress = silent) -> SegmentationResult:
        """Run Stage A; without a recognition there is nothing to ask for, and geometry finds the parts."""
        if recognition is None:
            return self._geometry.find_parts(recognition, progress)
        self._geometry.category = self.config.category or recognition.category
        answerer = self._see(ReferenceAnswerer(self._geometry.name, lambda: self._reference_parts))
        labels = tuple(r.label for r in recognition.labels)
        asked_for = recognition.size is not None  # the user did not give the labels
        counts = tuple(r.count or 0 for r in recognition.labels)
        questioner = MarkQuestioner(
            answerer, self.visual_prompts, labels, recognition.category, self.config, asked_for,
            counts=counts if any(counts) else (), machine=recognition.machine,
        )  # fmt: skip
        segmentation, warnings = ground_parts(
            self._sampled,
            questioner,
            recognition,
            self._ground,
            self._geometry.parts,
            partial(stays_free, self._geometry.whole),
            progress,
        )
        if len(segmentation.parts) == 1:
            own = self._geometry.parts(progress)
            others = ", ".join(part.name for part in own.parts[1:])
            named = replace(segmentation, nearly=own.nearly or f"what geometry finds: {others}")
            segmentation = own if self.config.at_least else named
        warnings = (*answerer.warnings, *warnings, *self.deadline.warnings(), *self._geometry.too_few(segmentation))
        return segmentation_result(segmentation, answerer.name, warnings, answerer.exchanges)

    def estimate_joints(
        self, segmentation: Segmentation, recognition: Recognition | None, progress: Progress = silent, grounded: bool = False
    ) -> JointResult:
        """Run Stage B.

        grounded: the parts come from `find_parts`, so that answers may once call them too much or too little.
        """
        self._geometry.category = self.config.category or (None if recognition is None else recognition.category)
        answerer = self._see(ReferenceAnswerer(self._geometry.name, lambda: self._reference(segmentation)))
        questions = Questions(self.visual_prompts, answerer, self.config, recognition, progress)
        reground = self._regrounding(questions, segmentation) if grounded and recognition is not None else None
        made = prompt_joints(questions, self._geometry.shape_for, segmentation, reground)
        warnings = (*answerer.warnings, *made.warnings, *self.deadline.warnings())
        estimated = joint_result(made.joints, answerer.name, warnings, answerer.exchanges, made.doubts)
        return replace(estimated, segmentation=made.segmentation if made.segmentation is not segmentation else None)

    def _regrounding(self, questions: Questions, segmentation: Segmentation) -> Reground:
        """Return the function that grounds wrong parts again."""
        recognition = questions.recognition
        asked = MarkQuestioner(questions.answerer, self.visual_prompts, questions.labels, questions.category, self.config)
        front = recognition.front if recognition else None
        return lambda wrong: ground_again(self._sampled, asked, segmentation, wrong, front)


def _other_category(given: str | None, answered: str) -> tuple[str, ...]:
    """Return a warning if the given category and the answered one are other kinds of object, as far as both are known."""
    known, told = kind_of(given), kind_of(answered)
    if known is None or told is None or known.first == told.first or "" != known.wikidata == told.wikidata:
        return ()
    return (f"--category {given} was given, but the answer is {answered!r}; the given one is used{PLEASE_CHECK}",)
