"""Stages A and B on one mesh, answered by geometry, a vision-language model, or ground truth in an evaluation."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Protocol

import numpy as np

from anymesh.config import Config
from anymesh.entry_points import PROMPTED_STAGES, load
from anymesh.geometry.boxes import straight_mesh, turned_back
from anymesh.geometry.patches import ObjectShape
from anymesh.pipeline.geometry_stages import GeometryStages
from anymesh.pipeline.results import JointResult, RecognitionResult, SegmentationResult, segmentation_result
from anymesh.runtime import Deadline, Progress, silent
from anymesh.segmentation.given import GIVEN, parts_from_file, parts_from_nodes
from anymesh.types import Joint, Mesh, Segmentation
from anymesh.types.motion import Recognition
from anymesh.types.questions import AnswererFactory


class StageAnswerer(Protocol):
    """Answerer of stages A and B about one object: `GeometryStages`, or `PromptedStages` of `anymesh.prompted`.

    recognizes: whether the object is recognized first, by a stage with a result of its own.
    """

    recognizes: bool

    def recognize(self, *, sized: bool = False, metric: bool = False) -> RecognitionResult:
        """Recognize the object and its movable parts.

        sized: the answered size sets the scale, unless the file states its unit (metric). In that case a contradicting size
        gives a warning.
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
    that the object is straight. The warnings of each stage include what was left out after the deadline.
    """

    def __init__(
        self,
        mesh: Mesh,
        config: Config | None = None,
        answerer_factory: AnswererFactory | None = None,
        deadline: Deadline | None = None,
    ) -> None:
        config = config or Config()
        if answerer_factory is not None:  # the geometry answerer finds no more with finer patches (docs/decisions/0010)
            config = replace(config, patches=replace(config.patches, seams=True))
        self.mesh = mesh
        straight, self._T_straight = straight_mesh(mesh) if answerer_factory is None else (mesh, np.eye(4))
        self.geometry = GeometryStages(straight, config, deadline or Deadline())
        self.answers: StageAnswerer = (
            self.geometry if answerer_factory is None else load(PROMPTED_STAGES)(self.geometry, answerer_factory)
        )

    @property
    def whole(self) -> ObjectShape:
        """Return the object as both stages use it: straight if geometry answers, and then in the frame of `geometry.mesh`."""
        return self.geometry.whole

    def recognize(self, *, sized: bool = False, metric: bool = False) -> RecognitionResult:
        """Recognize the object, see `StageAnswerer`."""
        return self.answers.recognize(sized=sized, metric=metric)

    def parts(
        self, parts: str = "auto", recognition: Recognition | None = None, progress: Progress = silent
    ) -> SegmentationResult:
        """Run Stage A.

        parts: auto, nodes, or a file of face labels.
        """
        if parts == "auto":
            return self.answers.find_parts(recognition, progress)
        return segmentation_result(
            parts_from_nodes(self.mesh) if parts == "nodes" else parts_from_file(self.mesh, Path(parts)), GIVEN
        )

    def joints(
        self,
        segmentation: Segmentation,
        recognition: Recognition | None = None,
        progress: Progress = silent,
        grounded: bool = False,
    ) -> JointResult:
        """Run Stage B, see `StageAnswerer`."""
        result = self.answers.estimate_joints(segmentation, recognition, progress, grounded)
        return replace(result, joints=tuple(turned_back(joint, self._T_straight) for joint in result.joints))


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


__all__ = ["Solver", "StageAnswerer", "solve"]
