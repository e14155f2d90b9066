"""The asset that saved stages make."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from anymesh.names import legal_name
from anymesh.stage_results import Completed, Corrected, Jointed, Placed, Recognized, Segmented
from anymesh.types import Asset


def assemble(
    placed: Placed,
    recognized: Recognized,
    segmented: Segmented,
    jointed: Jointed,
    *,
    corrected: Corrected | None,
    completed: Completed | None,
    revised: Corrected | None,
    timing: Mapping[str, float],
) -> Asset:
    """The asset of the stages in their order; corrected: by a person before Stage C, revised: after it."""
    placed = recognized.sized(placed)
    asset = Asset(
        name=legal_name(Path(placed.source.path).stem, fallback="asset"),
        source=placed.source,
        mesh=placed.mesh,
        segmentation=segmented.segmentation,
        joints=jointed.joints,
        answerer=jointed.answerer,
        warnings=_once((*placed.warnings, *recognized.warnings, *segmented.warnings, *jointed.warnings)),
        timing=timing,
        exchanges=(*recognized.exchanges, *segmented.exchanges, *jointed.exchanges),
    )
    asset = asset if corrected is None else _corrected(asset, corrected)
    if completed is not None:
        asset = replace(
            asset,
            mesh=completed.mesh,
            segmentation=completed.parted(asset.segmentation),
            source_face=completed.source_face,
            notes=completed.notes,
        )
    return asset if revised is None else _corrected(asset, revised)


def _corrected(asset: Asset, by: Corrected) -> Asset:
    return replace(asset, segmentation=by.segmentation, joints=by.joints, warnings=_once(by.warnings))


def _once(warnings: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(warnings))
