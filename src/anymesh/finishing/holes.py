"""Flat holes covered by other parts: permanently covered ones get a cap; others open a cavity when the cover moves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from anymesh.finishing.closing import backed, cap, covers_itself
from anymesh.finishing.scenes import SKIP, Scenes, room
from anymesh.finishing.seen import SheetVisibility
from anymesh.finishing.settings import ShapeConfig
from anymesh.finishing.sheets import Sheet
from anymesh.geometry.triangle_set import sample_surface

PROBES = 120  # sample points on a cap
PARALLEL = 0.99  # minimum cosine between the normals of borders in one plane
UNCOVERED = 0.5  # minimum share of a hole's points uncovered by motion
AWAY = 0.1  # minimum distance by which the cover must move, as a share of the hole's size; at least two walls


def with_caps(seen: SheetVisibility, part: int, scenes: Scenes, config: ShapeConfig) -> tuple[Sheet, bool]:
    """Close the flat holes of a sheet that are permanently covered.

    Also return whether a hole stays open because its cover moves away.
    """
    sheet = seen.sheet
    done, capped, opens = [], sheet, False
    for normal, numbers in _flat_holes(sheet, config):
        points, faces = np.zeros((0, 3)), cap(sheet.points, [sheet.loops[k] for k in numbers], normal)
        hidden, opened = _covered(sheet.points[faces], seen.sign * normal, part, scenes, config)
        opens |= opened
        if not hidden or opened:
            continue
        if covers_itself(sheet.faces, faces):  # then the cap is placed slightly in front of the hole
            rim, out = replace(capped, loops=tuple(sheet.loops[k] for k in numbers)), seen.sign * normal
            level = float((sheet.points[np.concatenate(rim.loops)] @ out).max()) + config.sheet * scenes.diagonal / 2
            points, faces = backed(rim, out, level, faces_out=seen.faces_out)
        capped = capped.with_faces(points, faces)
        done += numbers
    return capped.without(done), opens


def _flat_holes(sheet: Sheet, config: ShapeConfig) -> list[tuple[np.ndarray, list[int]]]:
    """Return the normals of a sheet's flat holes, and the indices of the borders in the plane of each."""
    groups: list[tuple[np.ndarray, np.ndarray, list[int]]] = []
    for k, loop in enumerate(sheet.loops):
        flat = _flat_hole(sheet, loop, config)
        if flat is None:
            continue
        near = config.flat * sheet.size
        same = [g for g in groups if abs(g[0] @ flat[0]) > PARALLEL and abs((g[1] - flat[1]) @ flat[0]) < near]
        if same:
            same[0][2].append(k)
        else:
            groups.append((*flat, [k]))
    return [(normal, numbers) for normal, _, numbers in groups]


def _flat_hole(sheet: Sheet, loop: np.ndarray, config: ShapeConfig) -> tuple[np.ndarray, np.ndarray] | None:
    """Return normal (as a cap of the loop is wound) and centre of a border's plane.

    None if it is not a flat hole of a body: the border leaves the plane, or the body lies in it.
    """
    points = sheet.points[loop]
    middle = (points.min(0) + points.max(0)) / 2
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    around = points - middle
    normal = -np.cross(around, np.roll(around, -1, axis=0)).sum(0)
    length = float(np.linalg.norm(normal))
    if length < 1e-6 * size**2:
        return None
    normal /= length
    off = np.abs(around @ normal).max()
    depth = np.ptp((sheet.points - middle) @ normal)
    return (normal, middle) if off < config.flat * size and depth > 2 * max(off, config.flat * size / 2) else None


def _covered(triangles: np.ndarray, outward: np.ndarray, part: int, scenes: Scenes, config: ShapeConfig) -> tuple[bool, bool]:
    """Return whether a hole is hidden at rest, and whether its cover moves away."""
    probe = sample_surface(triangles, PROBES, 0)
    if len(probe) == 0:
        return True, False
    ways = np.repeat(outward[None], len(probe), 0)
    if not scenes.on_the_ground(probe.points) and scenes.seen(probe.points, ways)[:, 0].mean() > config.shown:
        return False, False
    far, skip = 2 * scenes.diagonal, SKIP * scenes.diagonal
    before = room(scenes.rest, probe.points, ways, far, skip)
    after = room(scenes.scene_opened(part), probe.points, ways, far, skip)
    size = float(np.linalg.norm(np.ptp(probe.points, axis=0)))
    away = (before < far) & (after > before + max(2 * config.wall * scenes.diagonal, AWAY * size))
    return True, bool(away.mean() > UNCOVERED)
