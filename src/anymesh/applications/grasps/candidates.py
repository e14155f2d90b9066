"""Candidates of grasps by geometry: at the handle, at small pieces, at edges, around the whole part, and pushes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import islice
from typing import Any

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.applications.grasps.grasps import GraspKind
from anymesh.applications.plan.plans import GripperContact, Target
from anymesh.applications.plan.targets import (
    FACING,
    HandRoom,
    PartSurfaces,
    across,
    frames,
    room,
    sample_surface,
    sample_targets,
    unlike,
    velocity,
)
from anymesh.applications.policy.controller_ import ROOM
from anymesh.applications.policy.objects_ import TaskObject
from anymesh.applications.policy.robots_ import REACH, Gripper
from anymesh.geometry.topology import components
from anymesh.mechanisms.handles import find_protrusion
from anymesh.types.triangles import face_cross, unshared

CLEAR = 0.002  # [m] that fingertips keep from what is behind a handle
SAMPLED, PER_REGION, REGIONS = 100, 12, 3  # candidates of a region, those of them that are tried, and most regions
SMALL = 0.5  # share of the part's surface; a connected piece below it is a region of its own
AROUND = 0.02  # a grasp whose width is that of the part, but for this share, is around all of it
PLACES, HOOK_ANGLES = 300, 12  # places of hooks, and directions from which fingers reach behind each
LEANS = np.deg2rad([0.0, 45.0])  # of fingers that hook, against the motion
ACROSS = np.sin(np.deg2rad(15))  # sine; a motion within this angle of a surface goes along it
BESIDE, DIP = 0.001, 0.006  # [m] between the side of the fingers and a place, and by which their tips reach beyond it
Candidate = tuple[GraspKind, Target]


def stated_handle(handle: Any) -> Target | None:
    """Return where the tool grasps a handle of asset.json: as deep as its fingers reach, at most to the handle's middle.

    None if there is no handle, or if it cannot be read.
    """
    T = np.eye(4)
    try:
        z, y, width = np.array(handle["approach"], float), np.array(handle["closing"], float), float(handle["width"])
        deep = np.clip(min(float(handle["depth"]) - REACH - CLEAR, width / 2), 0, REACH)
        T[:3, :3], T[:3, 3] = np.stack([np.cross(y, z), y, z], 1), np.array(handle["place"], float) + deep * z
    except (KeyError, TypeError, ValueError):
        return None
    turns = np.isfinite(T).all() and np.allclose(T[:3, :3] @ T[:3, :3].T, np.eye(3), atol=1e-3)
    return Target(GripperContact.GRASP, T, width, 1.0) if turns else None


def candidates(
    object_: TaskObject,
    gripper: Gripper,
    handle: Any,
    contact: GripperContact,
    *,
    seed: int,
    fits: Callable[[Target], bool],
) -> Iterator[Candidate]:
    """Yield grasps or pushes of the part of the object's joint that fit, the most promising first, computed as asked for.

    handle: of asset.json, if it states one; fits: whether the gripper is free on its way to a target.
    """

    def tried(targets: Iterable[Target]) -> Iterator[Target]:
        return islice(filter(fits, targets), PER_REGION)

    surfaces, way = _surfaces(object_, gripper), opening_way(object_)
    if contact is GripperContact.PUSH:
        pushes = _sampled(object_, surfaces, gripper, seed, contact)
        yield from ((GraspKind.PUSH, t) for t in tried(pushes))
        for kind, targets in _without_hold(object_, surfaces, gripper, seed):
            yield from ((kind, t) for t in tried(targets))
        return
    stated = stated_handle(handle)
    if stated is not None and stated.width < gripper.stroke - ROOM and fits(stated):
        yield GraspKind.HANDLE, stated
    for kind, faces in _regions(object_, surfaces):
        rest = np.concatenate([surfaces.others, surfaces.part[~faces]])
        own = replace(surfaces, part=surfaces.part[faces], others=rest)
        targets = _by_approach(_sampled(object_, own, gripper, seed, contact), way)
        yield from ((kind or _kind(surfaces.part, t), t) for t in tried(targets))


def _surfaces(object_: TaskObject, gripper: Gripper) -> PartSurfaces:
    length, width, thickness = gripper.finger
    palm = (0.022, gripper.stroke / 2 + 0.0125)
    outside = float(
        np.linalg.norm(np.ptp(object_.points, axis=0))
    )  # a hand comes from outside of the object, not out of its inside
    hand = HandRoom(thickness + ROOM / 2, width / 2, palm, length - REACH - 0.01, outside)
    return PartSurfaces(object_.thing.part_triangles, object_.thing.other_triangles, hand)


def _sampled(object_: TaskObject, surfaces: PartSurfaces, gripper: Gripper, seed: int, contact: GripperContact) -> list[Target]:
    motion, goal = object_.thing.motion, object_.goal.goal
    return sample_targets(surfaces, motion, goal, gripper.stroke, seed, (contact,), SAMPLED)


def _regions(object_: TaskObject, surfaces: PartSurfaces) -> list[tuple[GraspKind | None, Bool[np.ndarray, " n"]]]:
    """Return the faces of the handle, of small connected pieces, and of the whole part."""
    part, regions = surfaces.part, []
    handle = find_protrusion(part, surfaces.others, opening_way(object_))
    if handle is not None:
        regions.append((GraspKind.HANDLE, np.isin(np.arange(len(part)), handle[0].faces)))
    number = components(*unshared(part)).label
    area = np.linalg.norm(face_cross(part), axis=1)
    of_piece = np.bincount(number, weights=area)
    small = [k for k in np.argsort(of_piece) if 0 < of_piece[k] < SMALL * area.sum()]
    for k in small[::-1][:REGIONS]:
        regions.append((GraspKind.PIECE, number == k))
    return [*regions, (None, np.ones(len(part), bool))]


def opening_way(object_: TaskObject) -> Float[np.ndarray, " 3"]:
    """Return the direction in which the free edge of the part moves from rest, of any length."""
    return velocity(object_.thing.motion, object_.handle[None])[0] * np.sign(object_.goal.goal)


def _by_approach(targets: Sequence[Target], way: Float[np.ndarray, " 3"]) -> list[Target]:
    """Return targets of each direction of approach in turn, those that come against the motion first."""
    groups: dict[tuple[float, ...], list[Target]] = {}
    for target in targets:
        groups.setdefault(tuple(np.round(target.T_asset_tool[:3, 2])), []).append(target)
    order = sorted(groups, key=lambda z: float(np.dot(z, way)) / float(np.linalg.norm(z)))
    return [groups[z][k] for k in range(max(map(len, groups.values()), default=0)) for z in order if k < len(groups[z])]


def _without_hold(
    object_: TaskObject, surfaces: PartSurfaces, gripper: Gripper, seed: int
) -> Iterator[tuple[GraspKind, list[Target]]]:
    """Yield places where the side of the closed fingers presses in the direction of the motion, then where tips rub."""
    points, normals = sample_surface(surfaces.part, np.random.default_rng(seed))
    speed = velocity(object_.thing.motion, points) * np.sign(object_.goal.goal)
    length = np.linalg.norm(speed, axis=1)
    way, score, far = (
        speed / np.maximum(length, 1e-9)[:, None],
        length / max(float(length.max()), 1e-9),
        length > length.max() / 2,
    )
    along = np.einsum("ij,ij->i", normals, way)

    def some(T: Float[np.ndarray, "n 4 4"], ok: Int[np.ndarray, " n"]) -> list[Target]:
        free = np.flatnonzero(room(surfaces, T, np.zeros(len(T))))
        return [Target(GripperContact.PUSH, T[k], 0.0, float(score[ok[k]])) for k in free]

    ok = _thinned(far & (along < -FACING))
    side, hooks = across(way[ok]), []
    for lean in LEANS:
        for angle in np.arange(HOOK_ANGLES) * 2 * np.pi / HOOK_ANGLES:
            up = np.cos(angle) * side + np.sin(angle) * np.cross(way[ok], side)
            y, z = np.cos(lean) * way[ok] + np.sin(lean) * up, np.cos(lean) * up - np.sin(lean) * way[ok]
            hooks += some(frames(y, z, points[ok] - (gripper.finger[2] + BESIDE) * y + DIP * z), ok)
    opening = opening_way(object_)
    yield GraspKind.HOOK, _by_approach(unlike(hooks, SAMPLED), opening)
    ok = _thinned(far & (np.abs(along) < ACROSS))
    rubs = unlike(some(frames(across(normals[ok]), -normals[ok], points[ok]), ok), SAMPLED)
    yield GraspKind.RUB, _by_approach(rubs, opening)


def _thinned(ok: Bool[np.ndarray, " n"]) -> Int[np.ndarray, " k"]:
    numbers = np.flatnonzero(ok)
    return numbers[:: max(1, len(numbers) // PLACES)]


def _kind(part: Float[np.ndarray, "n 3 3"], target: Target) -> GraspKind:
    """Return whether the fingers are around the whole part or at an edge."""
    whole = float(np.ptp(part.reshape(-1, 3) @ target.T_asset_tool[:3, 1]))
    return GraspKind.WHOLE if whole <= (1 + AROUND) * target.width else GraspKind.EDGE
