"""Named states: closed, half and open. What covers or contains something opens; controls and wheels stay as they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from anymesh.geometry.kinematics import carried_links, joint_transform, link_transforms
from anymesh.mechanisms.closing import closed as loops_closed
from anymesh.mechanisms.closing import giving_way, loop_gap
from anymesh.mechanisms.resisting import KINDS, kind_of
from anymesh.physics.collision import CollisionConfig
from anymesh.physics.contacts_ import ContactBench
from anymesh.types import Asset, Joint, JointType, Shape
from anymesh.types.motion import led
from anymesh.types.triangles import transformed

PLAY = 0.05  # of a joint's range: what it moves the other way without being modelled open; an estimate
ALIKE = 0.01  # of the size: a part as near to what it moves on at both ends swings both ways; an estimate
OPENING = ("weight", "hinge")  # forms of the kinds of joints that open
OPEN = 1e-3  # of the diagonal: a loop that opens further is not closed
SHARES = np.linspace(1.0, 0.0, 11)  # of its way that a joint takes if something is in its way
Positions = Mapping[str, float]  # of joints by name [rad or m]


def named_states(
    asset: Asset, shapes: Mapping[str, Sequence[Shape]], excluded: Sequence[tuple[str, str]] = ()
) -> dict[str, Positions]:
    """Return the position of each joint that takes part, by name of the state; nothing if none does.

    Open is the end of a joint's range to which it opens, half is the middle; a joint goes there as far as no larger part is in
    its way. Joints of doors, drawers, lids and the like take part; where an asset has none, all joints with limits do. What
    follows them, or is moved by them through a loop, is added; what lies on loops stays at rest if these cannot be closed.

    shapes: for collision, of each link; excluded: pairs of links that may touch.
    """
    states = _leading(asset, shapes, excluded)
    whole: dict[str, Positions] = {name: dict(led(asset.joints, loops_closed(asset, at))) for name, at in states.items()}
    if not asset.loops or all(loop_gap(asset, link_transforms(asset, at)) < OPEN for at in whole.values()):
        return whole
    still = {j.name for j in giving_way(asset)}
    states = {name: {joint: q for joint, q in at.items() if joint not in still} for name, at in states.items()}
    return {name: dict(led(asset.joints, at)) for name, at in states.items() if at}


def _leading(asset: Asset, shapes: Mapping[str, Sequence[Shape]], excluded: Sequence[tuple[str, str]]) -> dict[str, Positions]:
    led_by_loops = {j.name for j in giving_way(asset)[1:]}
    able = [j for j in asset.joints if j.mimic is None and j.type is not JointType.BALL and j.name not in led_by_loops]
    limited = [j for j in able if j.limits is not None]
    kinds = {j.name: KINDS[kind_of(asset, j)] for j in limited}
    ours = [j for j in limited if kinds[j.name].form in OPENING and not kinds[j.name].torque] or limited
    if not ours:
        return {}
    closed = {j.name: closed_at(asset, j) for j in ours}
    opened = {j.name: j.limits[1] if j.limits else 0.0 for j in ours}
    half = {name: (closed[name] + opened[name]) / 2 for name in closed}
    if len(ours) == 1:  # collision shapes leave each joint free by itself
        return {"closed": closed, "half": half, "open": opened}
    area = {j.name: asset.mesh.face_areas[asset.segmentation.faces(asset.segmentation.numbers[j.child])].sum() for j in ours}
    scene = _Poses(asset, shapes, excluded, sorted(area, key=lambda name: -area[name]))
    return {"closed": closed, "half": scene.free(closed, half), "open": scene.free(closed, opened)}


def closed_at(asset: Asset, joint: Joint) -> float:
    """Return where a joint is closed [rad or m]: at rest, or at its lower limit if its part is modelled open.

    That is so if the box around its part and what that moves on is smaller there than at rest and at the upper limit.
    """
    lower, upper = joint.limits or (0.0, 0.0)
    if -lower <= PLAY * (upper - lower):
        return 0.0
    number = asset.segmentation.numbers
    part, parent = (
        asset.mesh.triangles[asset.segmentation.faces(number[n])].reshape(-1, 3) for n in (joint.child, joint.parent)
    )

    def size(position: float) -> float:
        return float(np.ptp(np.concatenate([transformed(part, joint_transform(joint, position)), parent]), axis=0).sum())

    return lower if size(lower) < min((1 - 1e-6) * size(0.0), (1 - ALIKE) * size(upper)) else 0.0


class _Poses:
    """The collision shapes of all links at any positions. order: of joints, the first of which have the right of way."""

    def __init__(
        self, asset: Asset, shapes: Mapping[str, Sequence[Shape]], excluded: Sequence[tuple[str, str]], order: Sequence[str]
    ) -> None:
        self.asset, self.order, self.bench = asset, order, ContactBench(shapes, excluded)
        origins = {asset.segmentation.parts[0].name: np.zeros(3)} | {j.child: j.origin for j in asset.joints}
        self.frames = {name: np.block([[np.eye(3), at[:, None]], [0, 0, 0, 1]]) for name, at in origins.items()}
        self.carried = {j.name: set(carried_links(asset, j)) for j in asset.joints}
        self.least = CollisionConfig().contact * asset.mesh.diagonal

    def contacts(self, at: Positions) -> list[tuple[str, str]]:
        """Return the pairs of links that touch."""
        poses = {name: T @ self.frames[name] for name, T in link_transforms(self.asset, at).items()}
        return [(c.first[0], c.second[0]) for c in self.bench.contacts(poses, self.least)]

    def free(self, closed: Positions, wanted: Positions) -> Positions:
        """Return positions in which each joint, in their order, is as far on its way to what is wanted as it can be."""
        if not self.contacts(wanted):
            return wanted
        at = dict(closed)
        for name in self.order:
            own = self.carried[name]
            ways = [{**at, name: closed[name] + float(share) * (wanted[name] - closed[name])} for share in SHARES]
            at = next((way for way in ways if not any((a in own) != (b in own) for a, b in self.contacts(way))), ways[0])
        return at
