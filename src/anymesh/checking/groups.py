"""Links that fixed joints make one body."""

from __future__ import annotations

from anymesh.simulation.robot import Robot


def rigid_groups(robot: Robot) -> dict[str, frozenset[str]]:
    """Each link -> the links that are one body with it, itself among them."""
    group = {link.name: {link.name} for link in robot.links}
    for joint in robot.joints:
        if joint.type == "fixed":
            merged = group[joint.parent] | group[joint.child]
            for name in merged:
                group[name] = merged
    return {name: frozenset(names) for name, names in group.items()}


def joined(robot: Robot) -> frozenset[frozenset[str]]:
    """Pairs of links of two bodies that a joint connects, or of one body."""
    group = rigid_groups(robot)
    found = {frozenset((a, b)) for names in group.values() for a in names for b in names}
    for joint in robot.joints:
        found |= {frozenset((a, b)) for a in group[joint.parent] for b in group[joint.child]}
    return frozenset(found)
