"""Built-in completer of Stage C: missing surfaces of the parts are added by geometry alone (paper, 3.4)."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from anymesh.finishing.added import with_new_faces
from anymesh.finishing.cavity import add_walls
from anymesh.finishing.drawers import add_box
from anymesh.finishing.free import moves_freely
from anymesh.finishing.panels import find_panel
from anymesh.finishing.protocol import Finished
from anymesh.finishing.scenes import Growing, Scenes
from anymesh.finishing.settings import ShapeConfig
from anymesh.finishing.solids import close_part
from anymesh.finishing.visible import visible_faces
from anymesh.runtime import COMPLETION, Deadline
from anymesh.types import Asset

THINNER = (0.5,)  # shares of the wall thickness tried for a part that would collide with the full one


def complete_shapes(
    asset: Asset,
    config: ShapeConfig = ShapeConfig(),  # noqa: B008 - frozen
    *,
    parts: Collection[str] | None = None,
    deadline: Deadline | None = None,
) -> Finished:
    """Add the faces that parts lack: caps, backs of plates, inner skins of shells, cavity walls and drawer boxes.

    Existing faces stay unchanged. A part without open borders gets nothing, so finishing twice changes nothing. No part loses
    more of its range than the sweep of stage B can distinguish.
    parts: names, all if None. The same asset gives the same faces. Past the deadline, further surfaces stay open, and added
    faces that were not checked by a sweep are removed.
    Raise MissingExtraError without manifold3d.
    """
    deadline = deadline or Deadline()
    growing = Growing(Scenes(asset), lambda: deadline.late(COMPLETION))
    names = [p.name for p in asset.segmentation.parts]
    chosen = [k for k in growing.scenes.order if parts is None or names[k] in parts]
    touched = {k for k in chosen if close_part(k, growing, config)}
    for part in growing.scenes.order:
        _free_again(part, touched, growing, config)
    if growing.late():
        deadline.leave_out("completion: some surfaces remain open")
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
    """Make the additions to a part and to its carrier thinner if only then the part moves as far as before."""
    joint = growing.scenes.joint.get(part)
    both = [] if joint is None else [k for k in (part, growing.scenes.number[joint.parent]) if k in touched]
    if both and growing.late():
        for k in both:
            growing.undo(k)
        return
    for share in (*THINNER, 1.0):  # full thickness again if the part fits its hole so closely that no thickness frees it
        if not both or moves_freely(part, growing, Growing(growing.scenes)):
            return
        for k in both:
            growing.undo(k)
            close_part(k, growing, replace(config, wall=share * config.wall))
    if both and not moves_freely(part, growing, Growing(growing.scenes)):
        growing.notes.setdefault(part, []).append("fits its hole so closely that added faces may collide during its motion")


def _grown(asset: Asset, growing: Growing) -> Finished:
    """Return the asset with all additions, which get the materials of their part's visible surface."""
    visible = visible_faces(asset.mesh)
    looks = {}
    for part in growing.added:
        faces = growing.faces(part)
        looks[part] = faces[visible[faces]] if visible[faces].any() else faces
    finished = with_new_faces(asset, {k: np.concatenate(t) for k, t in growing.added.items()}, looks)
    names = [p.name for p in asset.segmentation.parts]
    return replace(finished, notes={names[k]: tuple(growing.notes[k]) for k in sorted(growing.notes)})
