"""Stages A and B of one mesh by geometry alone, each result computed once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cached_property

import numpy as np
from jaxtyping import Bool

from anymesh.articulation.estimate import PartMotions, choose_motion, estimate_joints, motion_questions, with_labels_of
from anymesh.articulation.part_labels import label_of
from anymesh.config import Config
from anymesh.geometry.patches import DividedSurface, ObjectShape
from anymesh.geometry.surface import ground_faces
from anymesh.pipeline.options import GEOMETRY
from anymesh.pipeline.results import JointResult, RecognitionResult, SegmentationResult, joint_result, segmentation_result
from anymesh.runtime import Deadline, Progress, silent
from anymesh.segmentation.divide import divide_surface, object_shape
from anymesh.segmentation.segment import segment_parts
from anymesh.types import Joint, JointType, Mesh, Segmentation
from anymesh.types.motion import Recognition

GROUND_WARNING = "the file contains a ground, which is part of the base"


class GeometryStages:
    """Geometry as the answerer of both stages (see `StageAnswerer`), and what it finds for the fallback of others."""

    name = GEOMETRY
    recognizes = False

    def __init__(self, mesh: Mesh, config: Config, deadline: Deadline) -> None:
        self.mesh, self.config, self.deadline = mesh, config, deadline
        self._by_itself: Segmentation | None = None
        self._swept: tuple[bytes, list[PartMotions]] | None = None  # faces of parts, and their motions

    @cached_property
    def whole(self) -> ObjectShape:
        """Return the object as both stages use it."""
        return self._divided.simplified(self.config.patches)

    @cached_property
    def _divided(self) -> DividedSurface:
        return divide_surface(self.mesh, self.config.seed, self.config.patches)

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
        return segmentation_result(parts, self.name, self.deadline.warnings() + ground)

    def estimate_joints(
        self, segmentation: Segmentation, recognition: Recognition | None, progress: Progress = silent, grounded: bool = False
    ) -> JointResult:
        """Run Stage B."""
        return joint_result(self.joints(segmentation, progress), self.name, self.deadline.warnings())

    def parts(self, progress: Progress = silent) -> Segmentation:
        """Return the parts found by geometry, computed once.

        A ground belongs to the base and is left out; if nothing moves without it, it may be what the parts hang on.
        """
        if self._by_itself is None:
            above = self._parts_above_ground(progress) if self._ground.any() else None
            if above is None or len(above.parts) == 1:
                above = segment_parts(self.mesh, self.whole, self._labels, self.config, progress, self.deadline)
            self._by_itself = above
        return self._by_itself

    def _parts_above_ground(self, progress: Progress) -> Segmentation:
        object_ = self.mesh.subset(~self._ground)
        whole = object_shape(object_, self.config.seed, self.config.patches)

        def with_ground(segmentation: Segmentation) -> Segmentation:
            face_part = np.zeros(len(self.mesh.faces), np.int64)
            face_part[~self._ground] = segmentation.face_part
            return replace(segmentation, face_part=face_part)

        def labels(segmentation: Segmentation) -> list[str]:
            return self._labels(with_ground(segmentation))

        return with_ground(segment_parts(object_, whole, labels, self.config, progress, self.deadline))

    def _labels(self, segmentation: Segmentation) -> list[str]:
        """Return a label of each part but the base from its motion by geometry; "" for a part that cannot move."""
        labels = {}
        for i, _, context, question in self._motions(segmentation):
            answer, best = choose_motion(context, question)
            labels[i] = "" if answer.type is JointType.FIXED else label_of(context, best)
        return [labels[i] for i in sorted(labels)]

    def _motions(self, segmentation: Segmentation, progress: Progress = silent) -> list[PartMotions]:
        """Sweep the motions of all parts; the last result is cached."""
        faces = segmentation.face_part.tobytes()
        if self._swept is None or self._swept[0] != faces:
            motions = motion_questions(self.shape_for(segmentation), segmentation, self.config, self.deadline)
            self._swept = faces, list(_with_progress(motions, segmentation, progress))
            return self._swept[1]
        return list(_with_progress(with_labels_of(segmentation, self._swept[1]), segmentation, progress))

    def shape_for(self, segmentation: Segmentation) -> ObjectShape:
        """Return the object's shape, simplified so that no face lies in two of these parts."""
        label, whole = segmentation.face_part, self.whole
        if (label == label[whole.source][np.unique(whole.patch, return_index=True)[1]][whole.mesh_patch]).all():
            return whole
        return self._divided.simplified(self.config.patches, label)

    def joints(self, segmentation: Segmentation, progress: Progress = silent) -> tuple[Joint, ...]:
        """Return the joints of parts by geometry."""
        return estimate_joints(segmentation, self._motions(segmentation, progress))


def _with_progress(swept: Iterable[PartMotions], segmentation: Segmentation, progress: Progress) -> Iterator[PartMotions]:
    """Report progress for each part."""
    for done, motions in enumerate(swept):
        progress("joints", segmentation.parts[motions.part].name, done, len(segmentation.parts) - 1)
        yield motions
