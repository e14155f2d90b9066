"""Completion of shapes by an external completer where its result agrees with the asset, by geometry elsewhere."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

import numpy as np
from jaxtyping import Float, Int

from anymesh.finishing.boards import add_box, add_walls, find_panel
from anymesh.finishing.protocol import Completer, Finished, PartMesh, ShapeConfig
from anymesh.finishing.scenes import Growing, Scenes, moves_freely, seen_from_outside, visible_faces
from anymesh.finishing.solids import close_part
from anymesh.geometry.distance_ import distance_to_mesh, distance_to_triangles
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.triangle_set import sample_surface
from anymesh.runtime import COMPLETION, Deadline
from anymesh.types import Asset, JointType, Mesh
from anymesh.types.triangles import normals_and_areas

THINNER = (0.5,)  # shares of the wall thickness tried for a part that would collide with the full one
AGREES = 0.01  # share of the object's diagonal: maximum distance of a part's visible surface from its completed surface
MAX_OFF_SHARE = 0.05  # share of the points that may lie further away
SAMPLES = 2000  # sample points per part


def with_new_faces(
    asset: Asset, added: Mapping[int, Float[np.ndarray, "n 3 3"]], materials: Mapping[int, Int[np.ndarray, " m"]]
) -> Finished:
    """Add triangles (n, 3, 3) [m, asset frame] to parts, by number, including triangles without area.

    materials: part -> faces of the asset from which its new faces take node, material, colour and texture coordinates, each
    from the nearest one.
    Existing faces keep their numbers, vertices and attributes; new ones follow in the order of the parts.
    """
    mesh = asset.mesh
    numbers = [part for part in sorted(added) if len(added[part])]
    if not numbers:
        return Finished(asset, np.arange(len(mesh.faces)))
    triangles = np.concatenate([added[part] for part in numbers])
    like = np.concatenate([_nearest(mesh, added[part], materials[part]) for part in numbers])
    # one corner of it gives the attributes of all corners of a new face, so that it has a single colour
    corner = np.linalg.norm(mesh.triangles[like] - triangles.mean(1)[:, None], axis=2).argmin(1)
    part = np.repeat(numbers, [len(added[part]) for part in numbers])
    joined = replace(
        mesh,
        vertices=np.concatenate([mesh.vertices, triangles.reshape(-1, 3)]),
        faces=np.concatenate([mesh.faces, len(mesh.vertices) + np.arange(3 * len(triangles)).reshape(-1, 3)]),
        face_node=np.concatenate([mesh.face_node, mesh.face_node[like]]),
        face_material=np.concatenate([mesh.face_material, mesh.face_material[like]]),
        corner_uv=_extended(mesh.corner_uv, like, corner),
        corner_color=_extended(mesh.corner_color, like, corner),
        corner_normal=_with_normals(mesh, triangles),
        corner_more_uv=_extended(mesh.corner_more_uv, like, corner),
    )
    segmentation = replace(asset.segmentation, face_part=np.concatenate([asset.segmentation.face_part, part]))
    source = np.concatenate([np.arange(len(mesh.faces)), np.full(len(triangles), -1)])
    return Finished(replace(asset, mesh=joined, segmentation=segmentation), source)


def _nearest(mesh: Mesh, triangles: np.ndarray, faces: np.ndarray) -> Int[np.ndarray, " n"]:
    """Return for each triangle the nearest of some faces to its centroid."""
    return faces[distance_to_mesh(triangles.mean(1), mesh.vertices, mesh.faces[faces])[1]]


def _extended(rows: np.ndarray | None, face: np.ndarray, corner: np.ndarray) -> np.ndarray | None:
    return None if rows is None else np.concatenate([rows, np.repeat(rows[face, corner][:, None], 3, axis=1)])


def _with_normals(mesh: Mesh, triangles: np.ndarray) -> np.ndarray | None:
    if mesh.corner_normal is None:
        return None
    normals = normals_and_areas(triangles)[0].astype(np.float32)
    return np.concatenate([mesh.corner_normal, np.repeat(normals[:, None], 3, axis=1)])


def complete_shapes(
    asset: Asset,
    config: ShapeConfig = ShapeConfig(),  # noqa: B008 - frozen
    *,
    parts: Collection[str] | None = None,
    deadline: Deadline | None = None,
) -> Finished:
    """Add the faces that parts lack: caps, backs of plates, inner skins of shells, cavity walls and drawer boxes.

    Existing faces stay unchanged. A part without open borders gets nothing but the box of a drawer, so finishing twice changes
    nothing. New faces enter no other part, at rest or on its way, and do not leave the object. No part loses more of its range
    than the sweep of stage B can distinguish.
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
    drawers = {k for k in chosen if k in carrier and growing.scenes.joint[k].type is JointType.PRISMATIC}
    near = [k for k in growing.scenes.order if k in touched | drawers or carrier.get(k) in touched]
    panels = [panel for k in near if (panel := find_panel(k, growing, config)) is not None]
    for panel in panels:
        if carrier[panel.part] in touched:
            add_walls(panel, panels, growing, config)
    for part in sorted(drawers & touched - {panel.part for panel in panels}):
        growing.add(part, growing.triangles(part)[:0], ["no drawer box added: no cavity of its size lies behind it"])
    for panel in panels:
        if panel.part in drawers:
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


def accept(asset: Asset, made: Mapping[str, PartMesh], *, who: str, tolerance: float = AGREES) -> Finished:
    """Add the new faces of each part whose completed surface agrees with the asset.

    A surface agrees if the visible surface of the part lies on it, and if none of it is visible where the object has no
    surface, both within `tolerance` diagonals.
    The part keeps its faces, and gets those of the completed surface that lie further away from them.
    `notes` states for each part of `made` whether it was accepted, or why not. The built-in completer handles rejected parts
    and those not in `made`.
    Raise ValueError for a part that the asset does not have.
    """
    names = [part.name for part in asset.segmentation.parts]
    unknown = sorted(set(made) - set(names))
    if unknown:
        raise ValueError(f"completed parts {unknown}, valid are {names}")
    limit = tolerance * asset.mesh.diagonal
    visible = visible_faces(asset.mesh)
    added, looks, notes = {}, {}, {}
    for number, name in enumerate(names):
        if name not in made:
            continue
        faces = asset.segmentation.faces(number)
        seen = faces[visible[faces]]
        seen = seen if len(seen) else faces
        why = disagreement(asset, seen, made[name].triangles, limit)
        if why:
            notes[name] = (f"{who}: not accepted, {why}",)
            continue
        new = _beyond(made[name].triangles, asset.mesh.triangles[faces], limit)
        added[number], looks[number] = new, seen
        notes[name] = (f"{who}: accepted, {len(new)} new faces",)
    finished = with_new_faces(asset, added, looks)
    return Finished(finished.asset, finished.source_face, notes)


def accepted(finished: Finished, who: str) -> tuple[str, ...]:
    """Return the names of the parts that `accept` took from `who`."""
    return tuple(name for name, notes in finished.notes.items() if any(n.startswith(f"{who}: accepted") for n in notes))


def disagreement(asset: Asset, seen: np.ndarray, triangles: Float[np.ndarray, "n 3 3"], limit: float) -> str:
    """Describe why a completed surface is not that of the part with visible faces `seen`; empty if it is. limit: [m]"""
    if len(triangles) == 0:
        return "it is empty"
    there = sample_surface(asset.mesh.triangles[seen], SAMPLES, 0, at_least=1)
    off = float((distance_to_triangles(there.points, triangles) > limit).mean())
    if off > MAX_OFF_SHARE:
        return f"{off:.0%} of what is seen of the part lies further than {limit:.2g} m from it"
    here = sample_surface(triangles, SAMPLES, 0)
    far = here.take(distance_to_triangles(here.points, asset.mesh.triangles) > limit)
    scene = RayScene(asset.mesh.vertices, asset.mesh.faces)
    out = int(seen_from_outside(scene, far.points, far.normals, asset.mesh.diagonal).sum())
    if out > MAX_OFF_SHARE * len(here):
        return f"{out / len(here):.0%} of it shows where the object has no surface within {limit:.2g} m"
    return ""


def _beyond(triangles: np.ndarray, surface: np.ndarray, limit: float) -> np.ndarray:
    """Return the triangles with at least one corner or the centroid off a surface."""
    points = np.concatenate([triangles, triangles.mean(1, keepdims=True)], axis=1)
    off = distance_to_triangles(points.reshape(-1, 3), surface).reshape(-1, 4)
    return triangles[(off > limit).any(1)]


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
