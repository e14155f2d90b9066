"""Stage C on one asset, with any completer and retexturer (paper, 3.4)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

import numpy as np

from anymesh.completion.complete import complete
from anymesh.completion.protocol import Completer, Finished
from anymesh.completion.settings import ShapeConfig
from anymesh.completion.texture import Retexturer
from anymesh.deadline import Deadline
from anymesh.errors import ModelError
from anymesh.pipeline.stage_results import CompletionResult
from anymesh.types import Asset


def finish_asset(
    asset: Asset,
    *,
    shapes: bool,
    completer: Completer | None,
    retexturer: Retexturer,
    config: ShapeConfig,
    deadline: Deadline | None = None,
) -> CompletionResult:
    """Return the mesh of an asset with completed shapes and textures.

    shapes: if False, shapes stay unchanged. completer: used first, None for none; the built-in completer handles the parts that
    it omits or that disagree with the visible surface. deadline: past it, further surfaces stay open.
    """
    deadline = deadline or Deadline()
    finished = Finished(asset, np.arange(len(asset.mesh.faces)))
    notes: list[str] = []
    if shapes:
        finished, notes = _completed(asset, completer, config, deadline)
    painted = retexturer.retexture(finished)
    segmentation = painted.asset.segmentation
    return CompletionResult(
        painted.asset.mesh, segmentation.face_part, finished.source_face, (*notes, *deadline.warnings(), *painted.notes)
    )


def _completed(
    asset: Asset, completer: Completer | None, config: ShapeConfig, deadline: Deadline
) -> tuple[Finished, list[str]]:
    try:
        found = complete(asset, config, completer=completer, deadline=deadline)
        return found, list(_told(found))
    except ModelError as error:
        if completer is None:
            raise
        found = complete(asset, config, deadline=deadline)
        return found, [f"{completer.name}: {error}; the built-in completer did all parts", *_told(found)]


def _told(finished: Finished) -> Iterator[str]:
    for part, notes in finished.notes.items():
        for note, times in Counter(notes).items():
            yield f"{part}: {note}" + (f" ({times} times)" if times > 1 else "")
