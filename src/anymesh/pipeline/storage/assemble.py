"""Assemble an asset from stage results."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from anymesh.names import legal_name
from anymesh.pipeline.results import (
    CompletionResult,
    CorrectionResult,
    JointResult,
    LoadResult,
    RecognitionResult,
    SegmentationResult,
)
from anymesh.types import Asset


def assemble(
    loaded: LoadResult,
    recognition: RecognitionResult,
    segmentation: SegmentationResult,
    joints: JointResult,
    *,
    correction: CorrectionResult | None,
    completion: CompletionResult | None,
    revision: CorrectionResult | None,
    timing: Mapping[str, float],
) -> Asset:
    """Assemble the asset from stage results.

    correction: manual correction before Stage C; revision: manual correction after it.
    """
    loaded = recognition.sized(loaded)
    asset = Asset(
        name=legal_name(Path(loaded.source.path).stem, fallback="asset"),
        source=loaded.source,
        mesh=loaded.mesh,
        segmentation=segmentation.segmentation,
        joints=joints.joints,
        answerer=joints.answerer,
        warnings=_once((*loaded.warnings, *recognition.warnings, *segmentation.warnings, *joints.warnings)),
        timing=timing,
        exchanges=(*recognition.exchanges, *segmentation.exchanges, *joints.exchanges),
    )
    asset = asset if correction is None else _corrected(asset, correction)
    if completion is not None:
        asset = replace(
            asset,
            mesh=completion.mesh,
            segmentation=completion.parted(asset.segmentation),
            source_face=completion.source_face,
            notes=completion.notes,
        )
    return asset if revision is None else _corrected(asset, revision)


def _corrected(asset: Asset, by: CorrectionResult) -> Asset:
    return replace(asset, segmentation=by.segmentation, joints=by.joints, warnings=_once(by.warnings))


def _once(warnings: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(warnings))
