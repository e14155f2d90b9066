"""Completion of shapes by an external completer where its result agrees with the asset, by geometry elsewhere."""

from __future__ import annotations

import numpy as np

from anymesh.finishing.accept import accept, accepted
from anymesh.finishing.protocol import Completer, Finished
from anymesh.finishing.settings import ShapeConfig
from anymesh.finishing.shape import complete_shapes
from anymesh.runtime import Deadline
from anymesh.types import Asset


def complete(
    asset: Asset,
    config: ShapeConfig = ShapeConfig(),  # noqa: B008 - frozen
    *,
    completer: Completer | None = None,
    deadline: Deadline | None = None,
) -> Finished:
    """Complete the shapes of the asset's parts.

    Parts that `completer` returns and `accept` takes are used; the others are completed by `complete_shapes`, until the
    deadline. Errors of the completer are passed on.
    """
    if completer is None:
        return complete_shapes(asset, config, deadline=deadline)
    first = accept(asset, completer.complete(asset), who=completer.name)
    taken = set(accepted(first, completer.name))
    left = [p.name for p in asset.segmentation.parts if p.name not in taken]
    second = complete_shapes(first.asset, config, parts=left, deadline=deadline)
    source = np.where(second.source_face < 0, -1, first.source_face[second.source_face])
    names = [p.name for p in asset.segmentation.parts]
    notes = {n: (*first.notes.get(n, ()), *second.notes.get(n, ())) for n in names}
    return Finished(second.asset, source, {n: part_notes for n, part_notes in notes.items() if part_notes})
