"""Check "inertia": masses and inertia tensors that are possible for the shapes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from anymesh.checking.content import Content
from anymesh.checking.engines.robot import Inertial, RobotLink
from anymesh.checking.groups import rigid_groups
from anymesh.checking.report import Finding, failure, warning

CHECK = "inertia"
REL_TOLERANCE = 1e-6  # relative, for rounded numbers
LIKE = 0.05  # relative; boxes that differ by less have the same size
GROWN = 0.1  # share of its diagonal; maximum distance of the centre of mass from the link's box
FAR = 0.5  # share of its diagonal; a centre of mass further out is a failure
LIGHTEST, HEAVIEST = 0.5, 22_600.0  # [kg/m3] of the link's box: a frame of thin sheet; osmium
SMALL, LARGE = 0.15, 1.1  # root mean square distance from the centre of mass, over the distance of the furthest corner


def check_inertia(content: Content) -> Iterator[Finding]:
    """Check that masses are positive, tensors are possible, centres of mass are in the link, and magnitudes fit the shape."""
    given = [(b, b.inertial) for b in content.robot.links if b.inertial is not None]
    moved = {link for j in content.robot.moving for link in content.robot.carried(j.child)}
    for link in content.robot.links:
        shaped = bool(link.visuals or link.collisions)
        if link.inertial is None and shaped and link.name in moved:
            yield failure(CHECK, link.name, "it moves and has no inertia; engines reject it or use their own")
        elif link.inertial is None and shaped and content.robot.format == "URDF":  # in an MJCF it belongs to the world
            yield warning(CHECK, link.name, "it has no inertia; engines that let the base move need one")
    groups = rigid_groups(content.robot)
    masses = {link.name: i.mass for link, i in given}
    for link, inertial in given:
        if inertial.mass == 0 and (link.name not in moved or sum(masses.get(n, 0) for n in groups[link.name]) > 0):
            yield warning(CHECK, link.name, "its mass is 0 kg; engines that take links by themselves need one above 0")
            continue
        findings = tuple(_possible(link.name, inertial))
        yield from findings
        if not findings:
            yield from _fitting(content, link, inertial)
    yield from _placeholder(content, given)


def _possible(link: str, inertial: Inertial) -> Iterator[Finding]:
    if not inertial.mass > 0:
        yield failure(CHECK, link, f"its mass is {inertial.mass:.4g} kg; it must be above 0")
        return
    a, b, c = np.linalg.eigvalsh(inertial.tensor)
    shown = f"its principal moments are {a:.4g}, {b:.4g} and {c:.4g} kg m2"
    if not a > 0:
        yield failure(CHECK, link, f"{shown}; all must be above 0")
    elif a + b < c * (1 - REL_TOLERANCE):
        yield failure(CHECK, link, f"{shown}; none may exceed the sum of the others")


def _fitting(content: Content, link: RobotLink, inertial: Inertial) -> Iterator[Finding]:
    points = content.shown(link.name).reshape(-1, 3)
    if not len(points) or not np.isfinite(points).all():
        return
    low, high = points.min(0), points.max(0)
    diagonal = float(np.linalg.norm(high - low))
    outside = float(np.maximum(low - inertial.center, inertial.center - high).max())
    if outside > GROWN * diagonal:
        shown = ", ".join(f"{v:.4g}" for v in inertial.center)
        problem = f"its centre of mass ({shown}) lies {outside:.3g} m outside of its box; valid is inside"
        yield failure(CHECK, link.name, problem) if outside > FAR * diagonal else warning(CHECK, link.name, problem)
        return
    volume = float(np.prod(np.maximum(high - low, 0.01 * diagonal)))
    density = inertial.mass / max(volume, 1e-300)
    if not LIGHTEST <= density <= HEAVIEST:
        problem = f"its mass of {inertial.mass:.4g} kg in its box is a density of {density:.3g} kg/m3"
        yield warning(CHECK, link.name, f"{problem}; plausible is {LIGHTEST:g} to {HEAVIEST:g}")
    spread = float(np.sqrt(np.trace(inertial.tensor) / 2 / inertial.mass))
    farthest = float(np.linalg.norm(np.maximum(high - inertial.center, inertial.center - low)))
    if not SMALL <= spread / max(farthest, 1e-300) <= LARGE:
        problem = (
            f"its inertia corresponds to mass {spread:.3g} m from its centre; its farthest corner is {farthest:.3g} m away"
        )
        yield warning(CHECK, link.name, f"{problem}; a ratio of {SMALL:g} to {LARGE:g} is plausible")


def _placeholder(content: Content, given: list[tuple[RobotLink, Inertial]]) -> Iterator[Finding]:
    """Detect placeholder tensors: one tensor for boxes of several sizes, or tensors of balls for boxes that are not cubes."""
    known = [(i.tensor, np.ptp(content.shown(b.name).reshape(-1, 3), axis=0)) for b, i in given if len(content.shown(b.name))]
    if len(known) < 2:
        return
    tensors, sizes = (np.array(values) for values in zip(*known, strict=True))
    size = float(np.abs(tensors[0]).max())
    alike = np.allclose(sizes, sizes[0], rtol=LIKE)
    cubes = all(np.ptp(s) <= LIKE * s.max() for s in sizes)
    same = np.allclose(tensors, tensors[0], rtol=REL_TOLERANCE, atol=0)
    balls = all(np.allclose(t, t[0, 0] * np.eye(3), rtol=REL_TOLERANCE, atol=REL_TOLERANCE * abs(t[0, 0])) for t in tensors)
    if (same and not alike) or (balls and not cubes):
        problem = (
            f"all {len(tensors)} links have the tensor of a sphere" if balls else f"all {len(tensors)} links have one tensor"
        )
        yield warning(
            CHECK, "", f"{problem} (such as {size:.3g} kg m2): placeholders; valid is each link's own, from its shape"
        )
