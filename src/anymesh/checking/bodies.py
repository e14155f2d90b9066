"""Check "inertia": masses and inertia tensors that are possible for the shapes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from hashlib import blake2b
from typing import Any

import numpy as np
from jaxtyping import Bool, Float
from scipy.spatial import ConvexHull, QhullError

from anymesh.checking.content import Content, joined, rigid_groups, siblings
from anymesh.checking.engines.rest_ import Rest
from anymesh.checking.engines.robot import Inertial, Robot, RobotLink
from anymesh.checking.report import Finding, failure, warning
from anymesh.geometry.distance_ import distance_to_triangles, winding_number
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.surface import plain_triangles
from anymesh.kinds.usual import doubts, kind_of
from anymesh.physics.convex import hull_of
from anymesh.physics.decompose import split_components
from anymesh.physics.openings import openings_of
from anymesh.types.triangles import unshared

INERTIA, USUAL = "inertia", "usual"
REL_TOLERANCE = 1e-6  # relative, for rounded numbers
LIKE = 0.05  # relative; boxes that differ by less have the same size
GROWN = 0.1  # share of its diagonal; maximum distance of the centre of mass from the link's box
FAR = 0.5  # share of its diagonal; a centre of mass further out is a failure
LIGHTEST, HEAVIEST = 0.5, 22_600.0  # [kg/m3] of the link's box: a frame of thin sheet; osmium
SMALL, LARGE = 0.15, 1.1  # root mean square distance from the centre of mass, over the distance of the furthest corner
COLLISION = "collision"
STILL_RAD, STILL_M, SHOWN = np.radians(0.5), 1e-3, 4  # motion that contacts at rest may cause; joints named in a finding
OVERLAP = 0.01  # share of the object's diagonal; engines push apart links that overlap by more at rest
GRID = 16  # points per side of the grid on which cavities are searched
HOLLOW = 0.1  # minimum share of empty space in the convex hull of the visuals for a cavity
FILLED = 0.5  # share of the empty space; collision shapes that fill more close the cavity
BORE = 0.02  # of the object's diagonal: from a quarter of this radius, round openings of narrow components count
SMALLEST, MOST_COMPONENTS = (
    0.014,
    150,
)  # components of a link that are checked for openings: size in diagonals, number
BORE_FACES = 3000  # maximum number of faces of a component whose openings are checked
FACES = 10_000  # maximum number of faces of the visible surface, for this check


def check_inertia(content: Content) -> Iterator[Finding]:
    """Check that masses are positive, tensors are possible, centres of mass are in the link, and magnitudes fit the shape."""
    given = [(b, b.inertial) for b in content.robot.links if b.inertial is not None]
    moved = {link for j in content.robot.moving for link in content.robot.carried(j.child)}
    groups = rigid_groups(content.robot)
    masses = {link.name: i.mass for link, i in given}
    solid = {link.name for link in content.robot.links if link.collisions}
    for link in content.robot.links:
        shaped = bool(link.visuals or link.collisions)
        if link.inertial is not None or not shaped:
            continue
        if any(masses.get(name, 0) > 0 for name in groups[link.name]) or link.name not in moved:
            if content.robot.format == "URDF":  # in an MJCF it belongs to the world
                yield warning(INERTIA, link.name, "it has no inertia; engines that take links by themselves need one")
        elif groups[link.name] & solid:
            problem = "it moves and has no inertia; MuJoCo and PyBullet make one up, others reject it or leave the link out"
            yield warning(INERTIA, link.name, problem)
        else:
            yield failure(INERTIA, link.name, "it moves and has no inertia and no collision shape; engines reject it")
    for link, inertial in given:
        if inertial.mass == 0 and (link.name not in moved or sum(masses.get(n, 0) for n in groups[link.name]) > 0):
            yield warning(INERTIA, link.name, "its mass is 0 kg; engines that take links by themselves need one above 0")
            continue
        others = sum(masses.get(name, 0) for name in groups[link.name] - {link.name})
        if not inertial.tensor.any() and (link.name not in moved or others > 0):
            yield warning(INERTIA, link.name, "its moments are 0 kg m2; engines that take links by themselves need others")
            continue
        findings = tuple(_possible(link.name, inertial))
        if content.robot.format == "MJCF":  # its compiler accepts it
            findings = tuple(warning(f.check, f.subject, f.text) for f in findings)
        yield from findings
        if not findings:
            body = groups[link.name] if link.name in moved else frozenset[str]()
            yield from _fitting(content, link, inertial, body)
    yield from _placeholder(content, given)


def check_usual(content: Content, record: Mapping[str, Any]) -> Iterator[Finding]:
    """Check that size and total mass are plausible for the kind of object that its category or name tells.

    record: asset.json of our own output, else empty; links of others have no label, and a mass that was given is not doubted.
    """
    robot, given = content.robot, record.get("given_mass") is not None
    points = content.at_rest(frozenset(link.name for link in robot.links)).reshape(-1, 3)
    if not len(points) or not np.isfinite(points).all():
        return
    labels = {part["name"]: part["label"] for part in record.get("parts", ())}
    known = all(link.inertial is not None for link in robot.links if link.visuals or link.collisions)
    masses = [(labels.get(b.name, ""), b.inertial.mass) for b in robot.links if b.inertial is not None] if known else []
    kind = kind_of(record.get("category"), record.get("name", robot.name))
    for text in doubts(kind, np.ptp(points, axis=0), masses, given=given):
        yield warning(USUAL, "", text)


def _possible(link: str, inertial: Inertial) -> Iterator[Finding]:
    if not inertial.mass > 0:
        yield failure(INERTIA, link, f"its mass is {inertial.mass:.4g} kg; it must be above 0")
        return
    a, b, c = np.linalg.eigvalsh(inertial.tensor)
    shown = f"its principal moments are {a:.4g}, {b:.4g} and {c:.4g} kg m2"
    if not a > 0:
        yield failure(INERTIA, link, f"{shown}; all must be above 0")
    elif a + b < c * (1 - REL_TOLERANCE):
        yield failure(INERTIA, link, f"{shown}; none may exceed the sum of the others")


def _fitting(content: Content, link: RobotLink, inertial: Inertial, body: frozenset[str]) -> Iterator[Finding]:
    """Compare mass and tensor with the shape. body: the links that move as one with this one; empty if it does not move."""
    points = content.shown(link.name).reshape(-1, 3)
    if not len(points) or not np.isfinite(points).all():
        return
    low, high = points.min(0), points.max(0)
    diagonal = float(np.linalg.norm(high - low))
    outside = _outside(points, inertial.center)[0]
    if outside > GROWN * diagonal:
        shown = ", ".join(f"{v:.4g}" for v in inertial.center)
        problem = f"its centre of mass ({shown}) lies {outside:.3g} m outside of its box; valid is inside"
        yield failure(INERTIA, link.name, problem) if _far(content, body) else warning(INERTIA, link.name, problem)
        return
    volume = float(np.prod(np.maximum(high - low, 0.01 * diagonal)))
    density = inertial.mass / max(volume, 1e-300)
    if not LIGHTEST <= density <= HEAVIEST:
        problem = f"its mass of {inertial.mass:.4g} kg in its box is a density of {density:.3g} kg/m3"
        yield warning(INERTIA, link.name, f"{problem}; plausible is {LIGHTEST:g} to {HEAVIEST:g}")
    spread = float(np.sqrt(np.trace(inertial.tensor) / 2 / inertial.mass))
    farthest = float(np.linalg.norm(np.maximum(high - inertial.center, inertial.center - low)))
    if not SMALL <= spread / max(farthest, 1e-300) <= LARGE:
        problem = (
            f"its inertia corresponds to mass {spread:.3g} m from its centre; its farthest corner is {farthest:.3g} m away"
        )
        yield warning(INERTIA, link.name, f"{problem}; a ratio of {SMALL:g} to {LARGE:g} is plausible")


def _outside(points: Float[np.ndarray, "n 3"], center: Float[np.ndarray, " 3"]) -> tuple[float, float]:
    """Return how far a center lies outside the box of some points, and the diagonal of the box."""
    low, high = points.min(0), points.max(0)
    return float(np.maximum(low - center, center - high).max()), float(np.linalg.norm(high - low))


def _far(content: Content, body: frozenset[str]) -> bool:
    """Return whether the common centre of mass of links that move as one lies far outside of their box."""
    links = [link for link in content.robot.links if link.name in body]
    given = [(content.places[b.name], b.inertial) for b in links if b.inertial is not None]
    mass = sum(i.mass for _, i in given)
    if mass <= 0:
        return False
    center = sum((i.mass * (T[:3, :3] @ i.center + T[:3, 3]) for T, i in given), np.zeros(3)) / mass
    outside, diagonal = _outside(content.at_rest(body).reshape(-1, 3), center)
    return outside > FAR * diagonal


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
            INERTIA, "", f"{problem} (such as {size:.3g} kg m2): placeholders; valid is each link's own, from its shape"
        )


def check_collision(content: Content, rest: Rest | None, *, ours: bool) -> Iterator[Finding]:
    """Check collision shapes. rest: depths and motion at rest, None if unknown; ours: whether this package wrote the asset."""
    robot = content.robot
    groups = rigid_groups(robot)
    for joint in robot.moving:
        body = groups[joint.child]
        if any(content.visuals[name] for name in body) and not any(content.collisions[name] for name in body):
            problem = "it moves and has no collision shape; nothing can touch it"
            carried = any(content.collisions[name] for name in robot.carried(joint.child))  # as beyond the links of a waist
            accepted = carried or robot.format == "MJCF" or not any(content.collisions.values())
            yield (warning if accepted else failure)(COLLISION, joint.child, problem)
    known: dict[tuple[bytes, ...], list[str]] = {}  # wheels and legs have the same shapes many times
    for link in robot.links:
        kinds = (content.visuals[link.name], content.collisions[link.name])
        key = tuple(blake2b(b"".join(np.round(s.triangles, 9).tobytes() for s in kind)).digest() for kind in kinds)
        if key not in known:
            known[key] = [*_closed_openings(content, link.name)]
        yield from (warning(COLLISION, link.name, text) for text in known[key])
    if rest is not None:
        yield from _resting(content, rest, ours)


def _resting(content: Content, rest: Rest, ours: bool) -> Iterator[Finding]:
    """Yield which links penetrate each other at rest, and which joints their contacts move."""
    robot, adjacent = content.robot, joined(content.robot)
    names = {link.name for link in robot.links}
    for (a, b), depth in rest.depths.items():
        pair = frozenset((a, b))
        if depth <= OVERLAP * content.diagonal or pair in robot.excluded:
            continue
        problem = f"at rest it penetrates {a!r} by {depth:.3g} m (convex collision shapes)"
        if pair in adjacent or not pair <= names:
            yield warning(COLLISION, b, f"{problem}; engines that test contacts between joined links push them apart")
        elif not siblings(robot, a, b):
            yield warning(COLLISION, b, f"{problem}; where several joints place links, another posture may be free of it")
        else:
            yield failure(
                COLLISION, b, f"{problem}; they are pushed apart, at most {OVERLAP * content.diagonal:.2g} m is valid"
            )
    pushed = []
    for joint in robot.moving:
        moved = rest.moved.get(joint.name, 0.0)
        if moved <= (STILL_M if joint.type == "prismatic" else STILL_RAD):
            continue
        carried = robot.carried(joint.child)
        met = [p for p in rest.depths if (p[0] in carried) != (p[1] in carried) and frozenset(p) not in robot.excluded]
        by = max(met, key=lambda p: rest.depths[p], default=None)
        pushed.append(f"{joint.name!r} by {_amount(joint.type, moved)}" + (f" ({by[0]!r} and {by[1]!r} touch)" if by else ""))
    if pushed:
        shown = f"{', '.join(pushed[:SHOWN])}{f' and {len(pushed) - SHOWN} more' if len(pushed) > SHOWN else ''}"
        problem = f"at rest, contacts move {shown} in 2 s without gravity; valid are at most 0.5 degrees or 1 mm"
        yield (failure if ours else warning)(COLLISION, "", problem)


def still(robot: Robot, rest: Rest) -> str:
    """Describe the furthest that contacts move a joint of each kind at rest."""
    slides = {j.name for j in robot.moving if j.type == "prismatic"}
    turned = max((moved for name, moved in rest.moved.items() if name not in slides), default=0.0)
    slid = max((moved for name, moved in rest.moved.items() if name in slides), default=0.0)
    return f"contacts at rest move joints by at most {_amount('', turned)} and {_amount('prismatic', slid)} in 2 s"


def _amount(kind: str, moved: float) -> str:
    return f"{1000 * moved:.3g} mm" if kind == "prismatic" else f"{np.degrees(moved):.3g} degrees"


def _closed_openings(content: Content, link: str) -> Iterator[str]:
    """Yield what the collision shapes of a link close: a cavity, else a round opening."""
    seen, shapes = content.shown(link), [s.triangles for s in content.collisions[link]]
    if content.visuals[link] and shapes and np.isfinite(seen).all():
        surface = simplify(seen, FACES)
        yield from [*_cavity(surface, shapes)] or _bores(surface, shapes, content.diagonal)


def _cavity(surface: Float[np.ndarray, "F 3 3"], shapes: list[np.ndarray]) -> Iterator[str]:
    points = surface.reshape(-1, 3)
    low, high = points.min(0), points.max(0)
    steps = (high - low) / GRID
    axes = [low[k] + steps[k] * (np.arange(GRID) + 0.5) for k in range(3)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    inside = _in_hull(points, grid)
    if not inside.any():
        return
    empty = grid[inside]
    empty = empty[distance_to_triangles(empty, surface) > 0.5 * float(np.linalg.norm(steps))]
    empty = empty[winding_number(empty, *unshared(surface)) < 0.5] if len(empty) else empty
    if len(empty) < HOLLOW * inside.sum():
        return
    taken = np.zeros(len(empty), bool)
    for shape in shapes:
        taken |= _in_hull(shape.reshape(-1, 3), empty)
    if taken.mean() > FILLED:
        volume = float(taken.sum() * np.prod(steps))
        count = "one convex shape" if len(shapes) == 1 else f"{len(shapes)} convex shapes"
        problem = f"its collision ({count}) fills {taken.mean():.0%} of the empty space in it, {volume:.3g} m3"
        yield f"{problem}; use convex shapes that leave the cavity open"


def _bores(seen: Float[np.ndarray, "F 3 3"], shapes: list[np.ndarray], diagonal: float) -> Iterator[str]:
    """Check that balls which fit into the round openings of a surface fit between the collision shapes too."""
    hulls = [hull for shape in shapes if (hull := hull_of(shape.reshape(-1, 3))) is not None]
    if not hulls:
        return
    surface, _ = plain_triangles(seen, diagonal)
    closed, widest = 0, 0.0
    for component in split_components(surface, SMALLEST * diagonal, MOST_COMPONENTS):
        triangles = simplify(component.triangles, BORE_FACES)
        hull = hull_of(triangles.reshape(-1, 3))
        if hull is None:
            continue
        some = openings_of(triangles, hull, BORE * diagonal, solid=component.solid)
        free = np.min([some.distances(h) for h in hulls], axis=0) / some.radii if len(some) else np.zeros(0)
        shown = some.round & (distance_to_triangles(some.centers, surface) > 0.95 * some.radii)  # no rod in it
        filled = some.radii[shown & (free < FILLED)]
        closed, widest = closed + len(filled), max(widest, float(filled.max(initial=0.0)))
    if closed:
        count = "one convex shape" if len(hulls) == 1 else f"{len(hulls)} convex shapes"
        problem = f"its collision ({count}) closes a round opening, into which a ball of {2 * widest:.3g} m fits"
        yield f"{problem}; use convex shapes around the opening"


def _in_hull(points: Float[np.ndarray, "n 3"], asked: Float[np.ndarray, "m 3"]) -> Bool[np.ndarray, " m"]:
    """Return which query points lie in the convex hull; none if the hull is flat."""
    try:
        planes = ConvexHull(points).equations
    except QhullError:
        return np.zeros(len(asked), bool)
    return (asked @ planes[:, :3].T + planes[:, 3] <= 0).all(1)
