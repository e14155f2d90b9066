"""Groups of links that are connected by fixed joints."""

from __future__ import annotations

from anymesh.checking.engines.robot import Robot


def rigid_groups(robot: Robot) -> dict[str, frozenset[str]]:
    """Map each link to the links that are rigidly connected to it, including itself."""
    group = {link.name: {link.name} for link in robot.links}
    for joint in robot.joints:
        if joint.type == "fixed":
            merged = group[joint.parent] | group[joint.child]
            for name in merged:
                group[name] = merged
    return {name: frozenset(names) for name, names in group.items()}


def joined(robot: Robot) -> frozenset[frozenset[str]]:
    """Return the pairs of links that are in the same rigid group, or whose groups are connected by a joint."""
    group = rigid_groups(robot)
    pairs = {frozenset((a, b)) for names in group.values() for a in names for b in names}
    for joint in robot.joints:
        pairs |= {frozenset((a, b)) for a in group[joint.parent] for b in group[joint.child]}
    return frozenset(pairs)
