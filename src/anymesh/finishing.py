"""Stage C on one asset, whoever completes its shapes and makes its looks (paper, 3.4)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from anymesh.errors import ModelError
from anymesh.postprocessing.accept import accept, accepted
from anymesh.postprocessing.protocol import Completer, Finished
from anymesh.postprocessing.settings import ShapeConfig
from anymesh.postprocessing.shape import complete_shapes
from anymesh.postprocessing.texture import Retexturer
from anymesh.stage_results import Completed
from anymesh.types import Asset

BUILT_IN = "builtin"


def finish_asset(
    asset: Asset, *, shapes: bool, completer: Completer | None, retexturer: Retexturer, config: ShapeConfig
) -> Completed:
    """The mesh of an asset with completed shapes and looks.

    shapes: off leaves shapes as they are. completer: is asked first, None for nobody; the built-in completer does the parts
    that it does not give, or gives so that they disagree with what is seen.
    """
    finished = Finished(asset, np.arange(len(asset.mesh.faces)))
    notes: list[str] = []
    if shapes:
        finished, notes = _completed(asset, completer, config)
    painted = retexturer.retexture(finished)
    segmentation = painted.asset.segmentation
    return Completed(painted.asset.mesh, segmentation.face_part, finished.source_face, (*notes, *painted.notes))


def _completed(asset: Asset, completer: Completer | None, config: ShapeConfig) -> tuple[Finished, list[str]]:
    if completer is None:
        found = complete_shapes(asset, config)
        return found, list(_told(found))
    try:
        taken = accept(asset, completer.complete(asset), who=completer.name)
    except ModelError as error:
        found = complete_shapes(asset, config)
        return found, [f"{completer.name}: {error}; the built-in completer did all parts", *_told(found)]
    done = set(accepted(taken, completer.name))
    rest = [part.name for part in asset.segmentation.parts if part.name not in done]
    found = complete_shapes(taken.asset, config, parts=rest)
    source = np.where(found.source_face >= 0, taken.source_face[found.source_face], -1)
    return replace(found, source_face=source), [*_told(taken), *_told(found)]


def _told(finished: Finished) -> Iterator[str]:
    for part, notes in finished.notes.items():
        yield from (f"{part}: {note}" for note in notes)
