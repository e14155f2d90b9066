"""Closed loops: the positions that other joints take when one moves, and how far a loop is open."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache

import numpy as np
from jaxtyping import Float

from anymesh.export.glb import Track
from anymesh.geometry.kinematics import Position, joint_motion, joint_transform, link_transforms
from anymesh.types import Asset, Joint, JointType, Loop, Mimic
from anymesh.types.motion import leaders

STEP = 0.25  # [rad, or of the asset's diagonal] by which a position grows before the loops are closed again
ROUNDS, SMALL, CLOSED = 20, 1e-6, 1e-12  # of Newton's method; its difference; gap over the diagonal at which it ends
APART = 0.1  # of the diagonal: distance of the points that hold two links together; an estimate
Transforms = Mapping[str, Float[np.ndarray, "*n 4 4"]]


def loop_error(loop: Loop, transforms: Transforms, size: float) -> Float[np.ndarray, "*n k"]:
    """Return what is left open of a loop at poses [m]: the way between the places of its links, then the turn times a size.

    Along its axis, a slide may move; about its axis, a hinge may turn; a ball may turn anyhow.
    """
    A, B = transforms[loop.first], transforms[loop.second]
    R, S = A[..., :3, :3], B[..., :3, :3]
    way, axis = S @ loop.origin + B[..., :3, 3] - R @ loop.origin - A[..., :3, 3], R @ loop.axis
    match loop.kind:
        case JointType.BALL:
            return way
        case JointType.REVOLUTE:
            return np.concatenate([way, size * (S @ loop.axis - axis)], -1)
        case JointType.PRISMATIC:
            way = way - (way * axis).sum(-1, keepdims=True) * axis
    return np.concatenate([way, size * (S - R).reshape(*way.shape[:-1], 9)], -1)


def loop_points(loop: Loop, size: float) -> list[Float[np.ndarray, " 3"]]:
    """Return points at which two links are held together, in the asset frame at rest [m]: none for a loop that slides.

    Two on the axis are a hinge, three a weld. size: of the asset.
    """
    if loop.kind is JointType.PRISMATIC:
        return []
    arms = np.stack([0 * loop.axis, loop.axis, np.roll(loop.axis, 1) + 0.1])
    return list(loop.origin + APART * size * arms[: {JointType.BALL: 1, JointType.REVOLUTE: 2}.get(loop.kind, 3)])


def loop_gap(asset: Asset, transforms: Transforms) -> float:
    """Return how far the loops of an asset are open at a pose, at most, over its diagonal."""
    size = asset.mesh.diagonal
    return max((float(np.linalg.norm(loop_error(loop, transforms, size))) / size for loop in asset.loops), default=0.0)


def closed(asset: Asset, positions: Mapping[str, Position], before: Mapping[str, Position] = {}) -> dict[str, Position]:
    """Return positions of joints by name with those that the loops imply, from rest on in small steps.

    before: such positions from which to go on, instead of from rest. Joints on a loop without a position give way; they may
    leave their limits. Where no pose closes the loops, the nearest to one is returned: `loop_gap` tells.
    """
    free = [j.name for j in giving_way(asset) if j.name not in positions]
    balls = {j.name for j in asset.joints if j.type is JointType.BALL}
    slots = np.cumsum([0, *(3 if name in balls else 1 for name in free)])
    size, x = asset.mesh.diagonal, np.concatenate([np.zeros(0), *(_start(before, n, n in balls) for n in free)])
    start = {name: before.get(name, 0.0) for name in positions}

    def at(share: float, x: Float[np.ndarray, " n"]) -> dict[str, Position]:
        own: dict[str, Position] = {
            name: x[a:b] if name in balls else float(x[a]) for name, a, b in zip(free, slots, slots[1:], strict=False)
        }
        return own | given(share)

    def given(share: float) -> dict[str, Position]:
        return {name: start[name] + share * (value - start[name]) for name, value in positions.items()}

    def left(share: float, x: Float[np.ndarray, "k n"]) -> Float[np.ndarray, "k m"]:
        """Return what is open at several positions of the joints that give way."""
        rows = {n: x[:, a:b] if n in balls else x[:, a] for n, a, b in zip(free, slots, slots[1:], strict=False)}
        T = _placed(asset, rows | given(share), len(x))
        return np.concatenate([loop_error(loop, T, size) for loop in asset.loops], 1)

    if not free or not asset.loops:
        return dict(positions)
    slides = {j.name for j in asset.joints if j.type is JointType.PRISMATIC}
    ways = {name: float(np.linalg.norm(value - start[name])) for name, value in positions.items()}
    far = max((way / (size if name in slides else 1.0) for name, way in ways.items()), default=0.0)
    shares = np.linspace(0, 1, 2 + int(far / STEP))[1:]
    for share in shares:
        for _ in range(ROUNDS):
            error, *moved = left(share, x + SMALL * np.eye(len(x) + 1, len(x), -1))
            if np.linalg.norm(error) < CLOSED * size:
                break
            x = x - np.linalg.lstsq((np.stack(moved, 1) - error[:, None]) / SMALL, error, 1e-6)[0]
    return at(1.0, x)


def closed_over(asset: Asset, name: str, amounts: Sequence[float]) -> list[dict[str, Position]]:
    """Return the same at several positions of one joint, from one to the next while the loops close."""
    made = dict[float, dict[str, Position]]()
    for side in (1, -1):
        last = dict[str, Position]()
        for amount in sorted((a for a in amounts if a * side >= 0), key=abs):
            made[amount] = closed(asset, {name: amount}, last)
            closes = asset.loops and loop_gap(asset, link_transforms(asset, made[amount])) < SMALL
            last = made[amount] if closes else {}
    return [made[amount] for amount in amounts]


def _start(before: Mapping[str, Position], name: str, ball: bool) -> Float[np.ndarray, " n"]:
    return np.broadcast_to(before.get(name, 0.0), 3 if ball else 1)


def _placed(asset: Asset, positions: Mapping[str, np.ndarray | float], count: int) -> dict[str, Float[np.ndarray, "k 4 4"]]:
    """Return transforms from rest of the links on the branches of loops at several positions: (k,), of balls (k, 3)."""
    branches, ways = _branches(asset)
    at = {**positions, **{n: m.ratio * positions.get(m.joint, 0.0) + m.offset for n, m in ways.items()}}
    T = {loop_end: np.tile(np.eye(4), (count, 1, 1)) for loop in asset.loops for loop_end in (loop.first, loop.second)}
    for joint in branches:
        value, above = np.asarray(at.get(joint.name, 0.0)), T.get(joint.parent, np.eye(4))
        if joint.type is JointType.BALL and value.ndim:
            T[joint.child] = above @ np.stack([joint_transform(joint, v) for v in np.broadcast_to(value, (count, 3))])
        elif joint.type is not JointType.FIXED:
            T[joint.child] = above @ joint_motion(joint).transforms(np.broadcast_to(value, count))
        else:
            T[joint.child] = above @ np.tile(np.eye(4), (count, 1, 1))
    return T


@lru_cache(maxsize=4)
def _branches(asset: Asset) -> tuple[tuple[Joint, ...], Mapping[str, Mimic]]:
    """Return the joints that carry the links of loops, from the root on, and what follows what."""
    carrier, joints = {j.child: j for j in asset.joints}, dict[str, Joint]()
    for name in (end for loop in asset.loops for end in (loop.first, loop.second)):
        way = list[Joint]()
        while name in carrier:
            way.append(carrier[name])
            name = carrier[name].parent
        joints |= {j.name: j for j in reversed(way)}
    return tuple(joints.values()), leaders(asset.joints)


def led_tracks(asset: Asset, made: Sequence[Track]) -> tuple[Track, ...]:
    """Return tracks with those of followers, as their leaders have them; the first joint of a loop leads the others."""
    tracks, ways, joints = {t.joint.name: t for t in made}, leaders(asset.joints), {j.name: j for j in asset.joints}
    looped = [j for j in giving_way(asset) if j.type is not JointType.BALL]
    for driver in [tracks[j.name] for j in looped[:1]]:
        poses = closed_over(asset, driver.joint.name, driver.amounts.tolist())
        for j in looped[1:]:
            tracks[j.name] = Track(j, driver.times, np.array([pose[j.name] for pose in poses], float))
    for name, way in ways.items():
        leader = tracks[way.joint]
        tracks[name] = Track(joints[name], leader.times, way.ratio * leader.amounts + way.offset)
    return tuple(tracks[name] for name in joints if name in tracks)


def giving_way(asset: Asset) -> list[Joint]:
    """Return the joints that lie on a loop and follow none."""
    carrier = {j.child: j for j in asset.joints}

    def above(name: str) -> set[str]:
        names = set[str]()
        while name in carrier:
            names.add(carrier[name].name)
            name = carrier[name].parent
        return names

    on = set[str]().union(*(above(loop.first) ^ above(loop.second) for loop in asset.loops))
    ways = leaders(asset.joints)
    leads = {way.joint for name, way in ways.items() if name in on}
    still = (JointType.FIXED, JointType.FREE)
    return [j for j in asset.joints if j.name in on | leads and j.mimic is None and j.type not in still]
