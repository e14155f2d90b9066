"""One small asset per mechanism, built from boxes: what turns or slides together, a screw, a ball, a loose lid and a loop."""

from __future__ import annotations

import numpy as np
from assets import box, joint, mesh_of, source

from anymesh.types import Asset, JointType, Loop, Mimic, Part, Segmentation

UP, ACROSS = np.array([0.0, 0, 1]), np.array([0.0, 1, 0])


def asset_of(name, pieces, joints, loops=()) -> Asset:
    """An asset of named boxes, the first of which is the base."""
    mesh, part = mesh_of([box(*piece) for piece in pieces.values()])
    parts = tuple(Part(n, "base" if k == 0 else "part") for k, n in enumerate(pieces))
    return Asset(name, source(f"{name}.glb"), mesh, Segmentation(part, parts), tuple(joints), "geometry", loops=tuple(loops))


def doors() -> Asset:
    """Twin leaves that open together; the right one turns the other way. A drawer's stages come out together, in a chain."""
    pieces = {
        "base": ((0, 0, 0), (1, 0.4, 0.02)),
        "left": ((0, -0.05, 0.1), (0.49, -0.02, 0.5)),
        "right": ((0.51, -0.05, 0.1), (1, -0.02, 0.5)),
        "outer": ((0.2, 0.1, 0.6), (0.4, 0.4, 0.65)),
        "middle": ((0.2, 0.1, 0.66), (0.4, 0.4, 0.7)),
        "inner": ((0.2, 0.1, 0.71), (0.4, 0.4, 0.75)),
    }
    joints = (
        joint("hinge", "revolute", "base", "left", (0, -0.02, 0.3), -UP, (0.0, 1.5)),
        joint("twin", "revolute", "base", "right", (1, -0.02, 0.3), -UP, (-1.5, 0.0), mimic=Mimic("hinge", -1.0)),
        joint("first", "prismatic", "base", "outer", (0.3, 0.25, 0.6), -ACROSS, (0.0, 0.2)),
        joint("second", "prismatic", "outer", "middle", (0.3, 0.25, 0.68), -ACROSS, (0.0, 0.1), mimic=Mimic("first", 0.5)),
        joint("third", "prismatic", "middle", "inner", (0.3, 0.25, 0.73), -ACROSS, (0.0, 0.2), mimic=Mimic("second", 2.0)),
    )
    return asset_of("doors", pieces, joints)


def lever() -> Asset:
    """Twin doors on one lever, which turn twice as far as it does."""
    pieces = {
        "base": ((0, 0, 0), (1, 0.4, 0.02)),
        "lever": ((0.45, -0.1, 0.6), (0.55, -0.05, 0.7)),
        "left": ((0, -0.05, 0.1), (0.49, -0.02, 0.5)),
        "right": ((0.51, -0.05, 0.1), (1, -0.02, 0.5)),
    }
    joints = (
        joint("lever_joint", "revolute", "base", "lever", (0.5, -0.07, 0.65), ACROSS, (0.0, 0.75)),
        joint("left_joint", "revolute", "base", "left", (0, -0.02, 0.3), -UP, (0.0, 1.5), mimic=Mimic("lever_joint", 2.0)),
        joint("right_joint", "revolute", "base", "right", (1, -0.02, 0.3), -UP, (-1.5, 0.0), mimic=Mimic("lever_joint", -2.0)),
    )
    return asset_of("lever", pieces, joints)


def gears() -> Asset:
    """A wheel that drives another one endlessly, twice as fast and the other way round."""
    pieces = {
        "base": ((0, 0, 0), (1, 0.4, 0.1)),
        "wheel": ((0.1, 0.1, 0.12), (0.5, 0.3, 0.2)),
        "pinion": ((0.65, 0.15, 0.12), (0.75, 0.25, 0.2)),
    }
    joints = (
        joint("wheel_joint", "continuous", "base", "wheel", (0.3, 0.2, 0.15), UP, None),
        joint("pinion_joint", "continuous", "base", "pinion", (0.7, 0.2, 0.15), UP, None, mimic=Mimic("wheel_joint", -2.0)),
    )
    return asset_of("gears", pieces, joints)


def jar(limits: tuple[float, float] | None = (0.0, 12.0)) -> Asset:
    """A lid that screws up by 2 cm a turn."""
    pieces = {"jar": ((0, 0, 0), (0.2, 0.2, 0.2)), "lid": ((0.02, 0.02, 0.22), (0.18, 0.16, 0.25))}
    return asset_of("jar", pieces, [joint("thread", "screw", "jar", "lid", (0.1, 0.1, 0.2), UP, limits, pitch=0.02)])


def stick() -> Asset:
    """A stick on a ball joint, within a cone of half a radian."""
    pieces = {"base": ((0, 0, 0), (0.4, 0.4, 0.1)), "stick": ((0.18, 0.19, 0.15), (0.22, 0.21, 0.5))}
    return asset_of("stick", pieces, [joint("socket", "ball", "base", "stick", (0.2, 0.2, 0.12), UP, (0.0, 0.5))])


def pot() -> Asset:
    """A pot with a lid that only lies on it."""
    pieces = {"pot": ((0, 0, 0), (0.3, 0.3, 0.2)), "lid": ((0, 0, 0.202), (0.3, 0.3, 0.22))}
    return asset_of("pot", pieces, [joint("lift", "free", "pot", "lid", (0.15, 0.15, 0.202), UP, None)])


def linkage() -> Asset:
    """A parallelogram of four bars: base, crank and rocker, and the coupler on the crank, which a loop joins to the rocker."""
    pieces = {
        "base": ((0, 0, 0), (0.6, 0.1, 0.05)),
        "crank": ((0.09, -0.03, 0.06), (0.11, -0.01, 0.3)),
        "rocker": ((0.49, -0.03, 0.06), (0.51, -0.01, 0.3)),
        "coupler": ((0.05, -0.06, 0.27), (0.55, -0.04, 0.29)),
    }
    joints = (
        joint("crank_joint", "revolute", "base", "crank", (0.1, 0, 0.08), ACROSS, (-0.6, 0.6)),
        joint("rocker_joint", "revolute", "base", "rocker", (0.5, 0, 0.08), ACROSS, (-0.6, 0.6)),
        joint("coupler_joint", "revolute", "crank", "coupler", (0.1, 0, 0.28), ACROSS, (-0.6, 0.6)),
    )
    return asset_of("linkage", pieces, joints, [Loop("pin", "coupler", "rocker", np.array([0.5, 0, 0.28]), ACROSS)])


MECHANISMS = (doors, gears, jar, stick, pot, linkage)
OF_TYPE = {JointType.SCREW: jar, JointType.BALL: stick, JointType.FREE: pot}
