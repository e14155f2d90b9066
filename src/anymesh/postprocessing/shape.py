"""The built-in completer of Stage C: what a surface mesh lacks of its parts is added, by geometry alone (paper, 3.4)."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from anymesh.deadline import COMPLETION, Deadline
from anymesh.postprocessing.added import with_new_faces
from anymesh.postprocessing.cavity import add_walls
from anymesh.postprocessing.drawers import add_box
from anymesh.postprocessing.free import moves_freely
from anymesh.postprocessing.panels import find_panel
from anymesh.postprocessing.protocol import Finished
from anymesh.postprocessing.scenes import Growing, Scenes
from anymesh.postprocessing.settings import ShapeConfig
from anymesh.postprocessing.solids import close_part
from anymesh.postprocessing.visible import visible_faces
from anymesh.types import Asset

THINNER = (0.5,)  # of a wall, tried on a part that would strike something with a whole one


def complete_shapes(
    asset: Asset,
    config: ShapeConfig = ShapeConfig(),  # noqa: B008 - frozen
    *,
    parts: Collection[str] | None = None,
    deadline: Deadline | None = None,
) -> Finished:
    """The asset with the faces that its parts lack: caps on the holes that others hid, backs of plates, inner skins of shells,
    walls of the cavities behind doors, boxes behind the panels of drawers.

    What was there stays as it is, face by face; a part without open borders gets nothing, so that finishing twice changes
    nothing. No part loses more of its range than the sweep of stage B tells apart. parts: names, all if None. The same asset
    gives the same faces. Past the deadline further surfaces stay open, and what was added and not swept is taken back.
    MissingExtraError without manifold3d.
    """
    deadline = deadline or Deadline()
    growing = Growing(Scenes(asset), lambda: deadline.late(COMPLETION))
    names = [p.name for p in asset.segmentation.parts]
    chosen = [k for k in growing.scenes.order if parts is None or names[k] in parts]
    touched = {k for k in chosen if close_part(k, growing, config)}
    for part in growing.scenes.order:
        _free_again(part, touched, growing, config)
    if growing.late():
        deadline.leave_out("completion: some surfaces stay open")
        return _grown(asset, growing)
    carrier = {k: growing.scenes.carriers(k)[0] for k in growing.scenes.joint}
    near = [k for k in growing.scenes.order if k in touched or carrier.get(k) in touched]
    panels = [panel for k in near if (panel := find_panel(k, growing, config)) is not None]
    for panel in panels:
        if carrier[panel.part] in touched:
            add_walls(panel, panels, growing, config)
    for panel in panels:
        if panel.part in touched:
            add_box(panel, growing, config)
    return _grown(asset, growing)


def _free_again(part: int, touched: set[int], growing: Growing, config: ShapeConfig) -> None:
    """Makes what was added to a part, and to its carrier, thinner where the part moves as far as it did only then."""
    joint = growing.scenes.joint.get(part)
    both = [] if joint is None else [k for k in (part, growing.scenes.number[joint.parent]) if k in touched]
    if both and growing.late():
        for k in both:
            growing.undo(k)
        return
    for share in (*THINNER, 1.0):  # whole again where the part fits its hole so closely that no thickness frees it
        if not both or moves_freely(part, growing, Growing(growing.scenes)):
            return
        for k in both:
            growing.undo(k)
            close_part(k, growing, replace(config, wall=share * config.wall))
    if both and not moves_freely(part, growing, Growing(growing.scenes)):
        growing.notes.setdefault(part, []).append("fits its hole so closely that what was added may strike on its way")


def _grown(asset: Asset, growing: Growing) -> Finished:
    """The asset with all that was added, which looks like what is seen of its part."""
    visible = visible_faces(asset.mesh)
    looks = {}
    for part in growing.added:
        faces = growing.faces(part)
        looks[part] = faces[visible[faces]] if visible[faces].any() else faces
    found = with_new_faces(asset, {k: np.concatenate(t) for k, t in growing.added.items()}, looks)
    names = [p.name for p in asset.segmentation.parts]
    return replace(found, notes={names[k]: tuple(growing.notes[k]) for k in sorted(growing.notes)})
