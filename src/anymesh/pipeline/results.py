"""Results of the stages."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from anymesh.types import Exchange, Joint, Mesh, Segmentation, Source
from anymesh.types.motion import Recognition

Record = dict[str, Any]  # a JSON object
LOW_CONFIDENCE = 0.4  # warnings name parts and joints below this confidence


@dataclass(frozen=True, eq=False)
class LoadResult:
    """The mesh in the asset frame, its source file, and warnings.

    metric: whether the scale is the unit stated by the file.
    """

    mesh: Mesh
    source: Source
    warnings: tuple[str, ...] = ()
    metric: bool = False


@dataclass(frozen=True, eq=False)
class RecognitionResult:
    """The recognized object, if a model was asked; scale: factor on the loaded mesh; note: its reason."""

    recognition: Recognition | None
    answerer: str
    scale: float = 1.0
    note: str = ""
    warnings: tuple[str, ...] = ()
    exchanges: tuple[Exchange, ...] = ()

    def sized(self, loaded: LoadResult) -> LoadResult:
        """Return the loaded mesh in the answered size."""
        if self.scale == 1:
            return loaded
        S = np.diag([self.scale] * 3 + [1.0])
        source = replace(
            loaded.source, T_asset_source=S @ loaded.source.T_asset_source, notes=(*loaded.source.notes, self.note)
        )
        return LoadResult(loaded.mesh.transformed(S), source, loaded.warnings, loaded.metric)


@dataclass(frozen=True, eq=False)
class SegmentationResult:
    """Stage A: the parts, the name of the answerer, and warnings."""

    segmentation: Segmentation
    answerer: str
    warnings: tuple[str, ...] = ()
    exchanges: tuple[Exchange, ...] = ()


@dataclass(frozen=True, eq=False)
class JointResult:
    """Stage B: the joints, the name of the answerer, and warnings.

    segmentation: the parts with the answered labels, where these changed; it is saved as the result of Stage A.
    """

    joints: tuple[Joint, ...]
    answerer: str
    warnings: tuple[str, ...] = ()
    exchanges: tuple[Exchange, ...] = ()
    segmentation: Segmentation | None = None


@dataclass(frozen=True, eq=False)
class CompletionResult:
    """Stage C: the completed mesh.

    mesh: with new faces and materials; face_part: the part of each face; source_face: its previous index (-1: new); notes: on
    the changes.
    """

    mesh: Mesh
    face_part: np.ndarray
    source_face: np.ndarray
    notes: tuple[str, ...] = ()

    def parted(self, before: Segmentation) -> Segmentation:
        """Return the same parts with these faces."""
        return Segmentation(self.face_part, before.parts)


@dataclass(frozen=True, eq=False)
class CorrectionResult:
    """Manually corrected parts and joints; log: the corrections in order, as JSON values."""

    segmentation: Segmentation
    joints: tuple[Joint, ...]
    warnings: tuple[str, ...]
    log: tuple[Record, ...]


def segmentation_result(
    segmentation: Segmentation, answerer: str, warnings: tuple[str, ...] = (), exchanges: tuple[Exchange, ...] = ()
) -> SegmentationResult:
    """Return the result of Stage A, with a warning for each part of low confidence, and if there is none but the base."""
    none = ("no moving part was found",) if len(segmentation.parts) == 1 else ()
    unsure = tuple(
        f"part {p.name}: low confidence ({p.confidence:.2f}) that it moves by itself, please check"
        for p in segmentation.parts[1:]
        if p.confidence < LOW_CONFIDENCE
    )
    return SegmentationResult(segmentation, answerer, (*warnings, *none, *unsure), exchanges)


def joint_result(
    joints: tuple[Joint, ...], answerer: str, warnings: tuple[str, ...] = (), exchanges: tuple[Exchange, ...] = ()
) -> JointResult:
    """Return the result of Stage B, with a warning for each joint of low confidence."""
    unsure = tuple(
        f"joint {j.name}: low confidence ({j.confidence:.2f}), please check" for j in joints if j.confidence < LOW_CONFIDENCE
    )
    return JointResult(joints, answerer, (*warnings, *unsure), exchanges)
