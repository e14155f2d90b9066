"""Collision shapes of an asset: convex, close to the surface, with open cavities and freely moving parts."""

from __future__ import annotations

import heapq
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from jaxtyping import Float

from anymesh.entry_points import CLOSED, resolve
from anymesh.geometry.kinematics import carried_links, joint_motion, link_transforms
from anymesh.geometry.simplify_ import simplify
from anymesh.isolation import ChildPool, shared_pool
from anymesh.physics.clear import ComponentShapes, ContactScene, LinkSurface, clear, cross
from anymesh.physics.contacts_ import ContactBench
from anymesh.physics.convex import as_hull, engine_shape, fitted, hull_of, thinned, volume
from anymesh.physics.decompose import FACES, Component, Decomposer, Fallback, Resolution, smallest_box, split_components
from anymesh.physics.openings import Openings, openings_of
from anymesh.runtime import COLLISION, Deadline
from anymesh.types import Asset, Hull, Joint, Shape
from anymesh.types.motion import STILL, leaders

MAX_CROSSING_FACES = 50_000  # faces of a link for tests of crossing surfaces
MAX_POSES, MIN_POSES = 2000, 3  # sampled poses: maximum in all, minimum per joint
RUBBING_POSES = 73  # of each joint, for touches between the sampled poses
MIN_KEPT = 0.88  # share of the radius of openings; a link that keeps less is warned about
NEIGHBOURS = 12  # nearest shapes with which one may be merged
MIN_COMPONENT_SIZE_RATIO = 0.3  # of the first gap: smaller components get no shape beside larger ones


@dataclass(frozen=True)
class CollisionConfig:
    """Accuracy of shapes, and thresholds of false contacts.

    Lengths are relative to the object's diagonal unless stated otherwise.
    """

    # maximum distance of a shape from the surface; the next value is used at false contacts
    gaps: tuple[float, ...] = (0.02, 0.006)
    pieces: tuple[int, ...] = (24, 64)  # maximum number of pieces of an open component at each of these
    wall: float = 0.002  # thickness of open shells, at most `wall_most`
    wall_most: float = 0.005  # [m]
    contact: float = 1e-4  # penetration from which shapes touch; engines push them apart
    crossing: float = 0.003  # penetration from which surfaces really collide; sweeps tolerate the same
    rest_gap: float = 0.002  # between shapes of different links at rest, at most `rest_gap_most`; PyBullet grows hulls by 1 mm
    rest_gap_most: float = 0.002  # [m]
    poses: int = 17  # poses of each joint over its range
    rounds: int = 10  # rounds of trimming and refinement
    seconds: float = 20.0  # [s] processor time for one division of one component; then the next method is tried
    most_components: int = 150  # components per link with separate shapes; the smaller ones beyond share hulls
    hulls: int | None = None  # maximum number of shapes per link, None for no limit


@dataclass(frozen=True, eq=False)
class Collision:
    """Collision shapes per link, in its frame.

    overlapping: pairs of links whose surfaces cross at rest; false_before: number of pairs of shapes that touched at a sampled
    pose although the surfaces do not, before trimming and refinement; tight: pairs of links that still have false contacts, or
    touch their parent on their way; warnings: per link, deviations from the intended method, and why; openings: if shapes are
    limited, the mean share of the radius of a link's openings that they leave free, for links with openings.
    """

    shapes: Mapping[str, tuple[Shape, ...]]
    overlapping: tuple[tuple[str, str], ...]
    false_before: int
    tight: tuple[tuple[str, str], ...]
    warnings: tuple[str, ...] = ()
    openings: Mapping[str, float] = field(default_factory=dict)


def collision_shapes(
    asset: Asset,
    triangles: Mapping[str, Float[np.ndarray, "n 3 3"]],
    origins: Mapping[str, Float[np.ndarray, " 3"]],
    config: CollisionConfig = CollisionConfig(),
    cache: Path | None = None,
    *,
    deadline: Deadline | None = None,
    pool: ChildPool | None = None,
) -> Collision:
    """Make collision shapes for every link. Components that are not convex are divided in child processes.

    triangles: per link, in its frame [m]; origins: of link frames at rest [m]; deadline: after it, each component gets one hull
    and false contacts stay; pool: of child processes, by default the shared one of this process.
    """
    deadline = deadline or Deadline()
    size = asset.mesh.diagonal
    wall = min(config.wall * size, config.wall_most)
    decomposer = Decomposer(pool or shared_pool(), cache, config.seconds)
    fallbacks: dict[str, Fallback] = {}
    parts = [
        (link, c)
        for link, t in triangles.items()
        for c in split_components(t, MIN_COMPONENT_SIZE_RATIO * config.gaps[0] * size, config.most_components)
    ]
    owner = {id(c): link for link, c in parts}

    def late() -> bool:
        if late := deadline.late(COLLISION):
            deadline.leave_out("collision: false contacts remain")
        return late

    def shapes_of(some: Sequence[Component], levels: Sequence[int]) -> list[tuple[Shape, ...]]:
        if deadline.late(COLLISION):
            deadline.leave_out("collision: one convex hull per component")
            return [_one_hull(c, wall) for c in some]
        resolution = [Resolution(config.gaps[k] * size, wall, config.pieces[k]) for k in levels]
        divided = decomposer.divide(some, resolution)
        fallbacks.update({owner[id(c)]: d.fallback for c, d in zip(some, divided, strict=True) if d.fallback is not None})
        return [tuple(engine_shape(s) for s in d.shapes) for d in divided]

    with ThreadPoolExecutor(1) as thread:  # while the child processes divide components
        surfaces = thread.submit(lambda: {link: LinkSurface(simplify(t, MAX_CROSSING_FACES)) for link, t in triangles.items()})
        first = shapes_of([c for _, c in parts], [0] * len(parts))
    pieces = [ComponentShapes(link, c, 0, shapes) for (link, c), shapes in zip(parts, first, strict=True)]
    scene = ContactScene(
        surfaces.result(),
        sampled_poses(asset, origins, config.poses),
        config.contact * size,
        config.crossing * size,
        min(config.rest_gap * size, config.rest_gap_most),
    )
    done = clear(scene, pieces, shapes_of, levels=len(config.gaps), rounds=config.rounds, late=late)
    kept: dict[str, float] = {}
    if config.hulls is not None:
        openings = {link: _link_openings([c for name, c in parts if name == link], config.gaps[0] * size) for link in triangles}
        limited = _limited(done.pieces, openings, config.hulls)
        again = clear(scene, limited, shapes_of, levels=1, rounds=config.rounds, late=late)
        done = replace(again, before=done.before)
        kept = {
            link: some.share_kept([as_hull(s) for p in done.pieces if p.link == link for s in p.shapes])
            for link, some in openings.items()
            if len(some)
        }
    link_shapes = {link: tuple(engine_shape(s) for p in done.pieces if p.link == link for s in p.shapes) for link in triangles}
    link_shapes = {link: shapes or (smallest_box(triangles[link], wall),) for link, shapes in link_shapes.items()}
    warnings = tuple(
        f"link {link}: collision made by {f.used}, since {'; '.join(f.reasons)}" for link, f in sorted(fallbacks.items())
    )
    limits = tuple(
        f"link {link}: its collision shapes keep {share:.0%} of the radius of its openings; a higher --hulls than "
        f"{config.hulls} keeps more"
        for link, share in sorted(kept.items())
        if share < MIN_KEPT
    )
    rubs = set[tuple[str, str]]() if late() else _rubbing(asset, origins, link_shapes, scene)
    tight = tuple(sorted({*done.left, *rubs} - {*scene.overlapping}))
    return Collision(link_shapes, scene.overlapping, done.before, tight, (*warnings, *limits, *deadline.warnings()), kept)


def _rubbing(
    asset: Asset, origins: Mapping[str, np.ndarray], shapes: Mapping[str, tuple[Shape, ...]], scene: ContactScene
) -> set[tuple[str, str]]:
    """Return pairs of a link and its parent that touch on the way, also between sampled poses, while the surfaces do not."""
    pairs = set()
    for joint in (j for j in asset.joints if j.span != STILL):
        a, b = sorted((joint.parent, joint.child))
        bench = ContactBench({name: shapes[name] for name in (a, b)}, margin=scene.contact)
        way = joint_poses(asset, origins, joint, RUBBING_POSES)[1:]  # rest is no place on the way
        depths = [max((c.depth for c in bench.contacts(pose, -scene.contact)), default=-np.inf) for pose in way]
        worst = way[int(np.argmax(depths))]
        real = max(depths) > scene.crossing and cross(scene.surfaces[a], worst[a], scene.surfaces[b], worst[b], scene.crossing)
        pairs |= set() if real or max(depths) == -np.inf else {(a, b)}
    return pairs


def _link_openings(parts: Sequence[Component], gap: float) -> Openings:
    """Return the openings of all components of a link."""
    few = [(simplify(c.triangles, FACES), c.solid) for c in parts]
    hulls = [hull_of(t.reshape(-1, 3)) for t, _ in few]
    return Openings.joined(
        [openings_of(t, hull, gap, solid=solid) for (t, solid), hull in zip(few, hulls, strict=True) if hull is not None]
    )


def _limited(pieces: Sequence[ComponentShapes], openings: Mapping[str, Openings], most: int) -> list[ComponentShapes]:
    """Merge shapes of links with more than `most`, those first that take least of the openings, then add least volume.

    The first component of such a link has all of its shapes.
    """
    limited = []
    for link, own in openings.items():
        of_link = [p for p in pieces if p.link == link]
        shapes = [s for p in of_link for s in p.shapes]
        if len(shapes) <= most:
            limited += of_link
            continue
        merged = merged_hulls([as_hull(s) for s in shapes], own, most)
        limited.append(replace(of_link[0], shapes=tuple(engine_shape(fitted(hull)) for hull in merged)))
    return limited


def merged_hulls(hulls: Sequence[Hull], openings: Openings, most: int) -> list[Hull]:
    """Merge hulls until there are at most `most`: pairs that take least of the openings, then add least volume, first."""
    kept = dict(enumerate(hulls))
    taken = {k: openings.taken(hull) for k, hull in kept.items()}
    queue: list[tuple[float, float, int, int, Hull]] = []

    def add(a: int, others: Sequence[int]) -> None:
        middle = kept[a].vertices.mean(0)
        others = sorted(others, key=lambda b: round(float(np.linalg.norm(kept[b].vertices.mean(0) - middle)), 9))
        for b in others[:NEIGHBOURS]:
            hull = hull_of(np.concatenate([kept[a].vertices, kept[b].vertices]))
            if hull is not None:
                more = openings.taken(hull) - taken[a] - taken[b], volume(hull) - volume(kept[a]) - volume(kept[b])
                heapq.heappush(queue, (round(more[0], 12), round(more[1], 15), min(a, b), max(a, b), thinned(hull)))

    for a in list(kept):
        add(a, [b for b in kept if b > a])
    new = len(kept)
    while len(kept) > most:
        if not queue:
            first = min(kept)
            add(first, [b for b in kept if b != first])
            if not queue:
                return [kept[k] for k in sorted(kept, key=lambda k: -volume(kept[k]))[:most]]
        *_, a, b, hull = heapq.heappop(queue)
        if a in kept and b in kept:
            del kept[a], kept[b]
            kept[new], taken[new] = hull, openings.taken(hull)
            add(new, [b for b in kept if b != new])
            new += 1
    return list(kept.values())


def _one_hull(component: Component, wall: float) -> tuple[Shape, ...]:
    hull = hull_of(component.triangles.reshape(-1, 3), wall)
    return () if hull is None else (engine_shape(thinned(hull)),)


def joint_poses(
    asset: Asset, origins: Mapping[str, Float[np.ndarray, " 3"]], joint: Joint, count: int
) -> list[dict[str, Float[np.ndarray, "4 4"]]]:
    """Return the poses of link frames at rest, and at `count` positions of one joint over its range with the others at rest."""
    rest = _placed(asset, origins, {})
    return [rest, *_alone(asset, rest, joint, count)]


def sampled_poses(
    asset: Asset, origins: Mapping[str, Float[np.ndarray, " 3"]], count: int
) -> list[dict[str, Float[np.ndarray, "4 4"]]]:
    """Return the poses of link frames at rest, with each joint alone over its range, and with all joints open.

    Followers move with their leader, and links of loops with each other: with loops, all joints are not opened at once.
    Each joint has `count` positions, or fewer if the total would exceed MAX_POSES, but at least MIN_POSES. Links that a joint
    does not move share their transform with the rest pose.
    """
    moving = [j for j in asset.joints if j.span != STILL and j.mimic is None]
    count = int(np.clip(MAX_POSES // max(len(moving), 1), min(MIN_POSES, count), count))
    rest = _placed(asset, origins, {})
    alone = [pose for joint in moving for pose in _alone(asset, rest, joint, count)]
    opened = {j.name: j.span[1] for j in moving}
    return [rest, *alone, *([] if asset.loops else [_placed(asset, origins, opened)])]


def _alone(
    asset: Asset, rest: dict[str, Float[np.ndarray, "4 4"]], joint: Joint, count: int
) -> list[dict[str, Float[np.ndarray, "4 4"]]]:
    """Return poses with one joint at positions of its range other than 0."""
    ways = leaders(asset.joints)
    name = ways[joint.name].joint if joint.name in ways else joint.name
    span = next(j.span for j in asset.joints if j.name == name)
    amounts = [float(v) for v in np.linspace(*span, count) if v != 0]
    if not ways and not asset.loops:
        carried, moved = carried_links(asset, joint), joint_motion(joint).transforms(np.array(amounts))
        return [rest | {name: T @ rest[name] for name in carried} for T in moved]
    led = (link_transforms(asset, at) for at in resolve(CLOSED)(asset, name, amounts))
    return [{link: at if (T[link] == np.eye(4)).all() else T[link] @ at for link, at in rest.items()} for T in led]


def _placed(
    asset: Asset, origins: Mapping[str, Float[np.ndarray, " 3"]], positions: Mapping[str, float]
) -> dict[str, Float[np.ndarray, "4 4"]]:
    placed = link_transforms(asset, positions)
    for name, origin in origins.items():
        shift = np.eye(4)
        shift[:3, 3] = origin
        placed[name] = placed[name] @ shift
    return placed
