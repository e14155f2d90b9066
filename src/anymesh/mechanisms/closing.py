"""Closed loops: the positions that other joints take when one moves, and how far a loop is open."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from jaxtyping import Float

from anymesh.export.glb import Track
from anymesh.geometry.kinematics import Position, link_transforms
from anymesh.types import Asset, Joint, JointType, Loop
from anymesh.types.motion import leaders

STEP = 0.25  # [rad, or of the asset's diagonal] by which a position grows before the loops are closed again
ROUNDS, SMALL, CLOSED = 20, 1e-6, 1e-12  # of Newton's method; its difference; gap over the diagonal at which it ends
APART = 0.1  # of the diagonal: distance of the points that hold two links together; an estimate
Transforms = Mapping[str, Float[np.ndarray, "4 4"]]


def loop_error(loop: Loop, transforms: Transforms, size: float) -> Float[np.ndarray, " k"]:
    """Return what is left open of a loop at a pose [m]: the way between the places of its links, then the turn times a size.

    Along its axis, a slide may move; about its axis, a hinge may turn; a ball may turn anyhow.
    """
    A, B = transforms[loop.first], transforms[loop.second]
    way = B[:3, :3] @ loop.origin + B[:3, 3] - A[:3, :3] @ loop.origin - A[:3, 3]
    axis = A[:3, :3] @ loop.axis
    match loop.kind:
        case JointType.BALL:
            return way
        case JointType.REVOLUTE:
            return np.r_[way, size * (B[:3, :3] @ loop.axis - axis)]
        case JointType.PRISMATIC:
            way = way - (way @ axis) * axis
    return np.r_[way, size * (B[:3, :3] - A[:3, :3]).ravel()]


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


def closed(asset: Asset, positions: Mapping[str, Position]) -> dict[str, Position]:
    """Return positions of joints by name with those that the loops imply, from rest on in small steps.

    Joints without a position that lie on a loop give way; they may leave their limits. Where no pose closes the loops, the
    nearest to one is returned: `loop_gap` tells.
    """
    free = [j.name for j in giving_way(asset) if j.name not in positions]
    balls = {j.name for j in asset.joints if j.type is JointType.BALL}
    slots = np.cumsum([0, *(3 if name in balls else 1 for name in free)])
    size, x = asset.mesh.diagonal, np.zeros(slots[-1])

    def at(share: float, x: Float[np.ndarray, " n"]) -> dict[str, Position]:
        own: dict[str, Position] = {
            name: x[a:b] if name in balls else float(x[a]) for name, a, b in zip(free, slots, slots[1:], strict=False)
        }
        return own | {name: share * value for name, value in positions.items()}

    def left(share: float, x: Float[np.ndarray, " n"]) -> Float[np.ndarray, " m"]:
        T = link_transforms(asset, at(share, x))
        return np.concatenate([loop_error(loop, T, size) for loop in asset.loops])

    if not free or not asset.loops:
        return dict(positions)
    slides = {j.name for j in asset.joints if j.type is JointType.PRISMATIC}
    far = max((float(np.linalg.norm(v)) / (size if name in slides else 1.0) for name, v in positions.items()), default=0.0)
    shares = np.linspace(0, 1, 2 + int(far / STEP))[1:]
    for share in shares:
        for _ in range(ROUNDS):
            error = left(share, x)
            if np.linalg.norm(error) < CLOSED * size:
                break
            J = np.stack([(left(share, x + step) - error) / SMALL for step in SMALL * np.eye(len(x))], 1)
            x = x - np.linalg.lstsq(J, error, 1e-6)[0]
    return at(1.0, x)


def led_tracks(asset: Asset, made: Sequence[Track]) -> tuple[Track, ...]:
    """Return tracks with those of followers, as their leaders have them; the first joint of a loop leads the others."""
    tracks, ways, joints = {t.joint.name: t for t in made}, leaders(asset.joints), {j.name: j for j in asset.joints}
    looped = [j for j in giving_way(asset) if j.type is not JointType.BALL]
    for driver in [tracks[j.name] for j in looped[:1]]:
        poses = [closed(asset, {driver.joint.name: float(amount)}) for amount in driver.amounts]
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
