"""Collision shapes of an asset: convex, near the surface, cavities open, moving parts free."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float

from anymesh.collision.clear import Piece, Scene, clear
from anymesh.collision.crossing import Surface
from anymesh.collision.decompose import Component, Fineness, component_shapes, least_box, split_components
from anymesh.collision.settings import CollisionConfig
from anymesh.collision.store import content_key, load_shapes, save_shapes
from anymesh.geometry.kinematics import link_transforms
from anymesh.geometry.simplify_ import simplify
from anymesh.types import Asset, Joint, JointType, Shape

__all__ = ["Collision", "CollisionConfig", "collision_shapes", "joint_poses"]
FACES = 50_000  # of a link, for the question whether surfaces cross
SMALL = 0.3  # components smaller than this share of the first gap need no shape beside larger ones


@dataclass(frozen=True, eq=False)
class Collision:
    """Shapes a link, in its frame; overlapping: pairs of links whose surfaces go through each other at rest; false_before:
    pairs of shapes that touched at a sampled pose though the surfaces do not, before they were planed and refined; tight:
    pairs of links of which some still do."""

    shapes: Mapping[str, tuple[Shape, ...]]
    overlapping: tuple[tuple[str, str], ...]
    false_before: int
    tight: tuple[tuple[str, str], ...]


def collision_shapes(
    asset: Asset,
    triangles: Mapping[str, Float[np.ndarray, "n 3 3"]],
    origins: Mapping[str, Float[np.ndarray, " 3"]],
    config: CollisionConfig = CollisionConfig(),  # noqa: B008 - frozen
    cache: Path | None = None,
) -> Collision:
    """Shapes for every link. triangles: a link, in its frame [m]; origins: where link frames lie at rest [m]."""
    size = asset.mesh.diagonal
    wall = min(config.wall * size, config.wall_most)

    def shapes_of(component: Component, level: int) -> tuple[Shape, ...]:
        fineness = Fineness(config.gaps[level] * size, wall, config.pieces[level])
        key = content_key(component.triangles, component.solid, fineness.gap, fineness.wall, fineness.most)
        found = load_shapes(cache, key)
        if found is None:
            found = component_shapes(component, fineness)
            save_shapes(cache, key, found)
        return found

    parts = [(link, c) for link, t in triangles.items() for c in split_components(t, SMALL * config.gaps[0] * size)]
    with ThreadPoolExecutor() as pool:  # CoACD works outside the lock
        first = pool.map(lambda part: shapes_of(part[1], 0), parts)
        pieces = [Piece(link, c, 0, shapes) for (link, c), shapes in zip(parts, first, strict=True)]
    scene = Scene(
        {link: Surface(simplify(t, FACES)) for link, t in triangles.items()},
        list(_poses(asset, origins, config.poses)),
        config.contact * size,
        config.crossing * size,
    )
    done = clear(scene, pieces, shapes_of, levels=len(config.gaps), rounds=config.rounds)
    found = {link: tuple(s for p in done.pieces if p.link == link for s in p.shapes) for link in triangles}
    found = {link: shapes or (least_box(triangles[link], wall),) for link, shapes in found.items()}
    return Collision(found, scene.overlapping, done.before, done.left)


def joint_poses(
    asset: Asset, origins: Mapping[str, Float[np.ndarray, " 3"]], joint: Joint, count: int
) -> list[dict[str, Float[np.ndarray, "4 4"]]]:
    """Where link frames are at rest, and at `count` places of one joint over its range, the others at rest."""
    lower, upper = (-np.pi, np.pi) if joint.limits is None else joint.limits
    places = [0.0, *(float(v) for v in np.linspace(lower, upper, count) if v != 0)]
    return [_placed(asset, origins, {joint.name: v}) for v in places]


def _poses(
    asset: Asset, origins: Mapping[str, Float[np.ndarray, " 3"]], count: int
) -> Iterator[dict[str, Float[np.ndarray, "4 4"]]]:
    """Where link frames are at rest, with each joint alone over its range, and with all joints opened."""
    moving = [j for j in asset.joints if j.type is not JointType.FIXED]
    yield _placed(asset, origins, {})
    for joint in moving:
        yield from joint_poses(asset, origins, joint, count)[1:]
    yield _placed(asset, origins, {j.name: np.pi if j.limits is None else j.limits[1] for j in moving})


def _placed(
    asset: Asset, origins: Mapping[str, Float[np.ndarray, " 3"]], positions: Mapping[str, float]
) -> dict[str, Float[np.ndarray, "4 4"]]:
    placed = link_transforms(asset, positions)
    for name, origin in origins.items():
        shift = np.eye(4)
        shift[:3, 3] = origin
        placed[name] = placed[name] @ shift
    return placed
