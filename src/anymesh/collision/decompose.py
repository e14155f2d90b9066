"""The collision shapes of one link at a given fineness: primitives, hulls of convex components, decompositions of others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from anymesh.collision.coacd_ import decompose
from anymesh.collision.convex import hull_of, planes
from anymesh.collision.primitives import fitted
from anymesh.collision.split import patch_of, split_surface
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.topology import components, weld
from anymesh.types import Hull, Shape

FACES = 3000  # of a component, for decomposition; more add seconds, not accuracy
LIMITS = (0.01, 1.0)  # of CoACD's concavity


@dataclass(frozen=True)
class Fineness:
    """gap: how far a shape may stand off the surface [m]; wall: thickness of open shells [m]; most: pieces a component."""

    gap: float
    wall: float
    most: int


@dataclass(frozen=True, eq=False)
class Component:
    """A connected piece of a link's surface, in the link frame [m]; solid: closed, wound outwards."""

    triangles: Float[np.ndarray, "n 3 3"]
    solid: bool


def split_components(triangles: Float[np.ndarray, "n 3 3"], least: float) -> list[Component]:
    """The components of a link that need shapes of their own: not those smaller than `least` [m], unless all are; not those
    without a surface; and not those within the hull of a convex one."""
    found = components(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))
    pieces = [triangles[found.label == k] for k in range(found.count)]
    sizes = [float(np.linalg.norm(np.ptp(piece.reshape(-1, 3), axis=0))) for piece in pieces]
    kept: list[Component] = []
    around: list[np.ndarray] = []  # planes of the hulls of convex components
    for k in np.argsort(sizes, kind="stable")[::-1]:
        corners = pieces[k].reshape(-1, 3)
        slack = 1e-6 * sizes[k]
        if sizes[k] < min(least, max(sizes)) or any((corners @ p[:, :3].T + p[:, 3] <= slack).all() for p in around):
            continue
        kept.append(Component(pieces[k][:, ::-1] if found.flip[k] else pieces[k], bool(found.solid[k])))
        hull = hull_of(corners) if found.solid[k] else None
        if hull is not None and bool((_heights(corners, hull) > -slack).all()):
            around.append(planes(hull))
    return kept


def _heights(points: np.ndarray, hull: Hull) -> np.ndarray:
    sides = planes(hull)
    return np.max(points @ sides[:, :3].T + sides[:, 3], axis=1)


def component_shapes(component: Component, fineness: Fineness) -> tuple[Shape, ...]:
    """One shape where the hull is near enough to the surface; else pieces of a solid (CoACD) or of an open surface."""
    triangles = simplify(component.triangles, FACES)
    whole = patch_of(triangles, fineness.wall)
    if whole is None:
        return ()
    if whole.gap <= fineness.gap:
        return (fitted(hull_of(component.triangles.reshape(-1, 3)) or whole.hull),)
    _, first, faces = np.unique(weld(triangles.reshape(-1, 3)), return_index=True, return_inverse=True)
    vertices, faces = triangles.reshape(-1, 3)[first], faces.reshape(-1, 3)
    if component.solid and components(vertices, faces).solid.all():
        half = float(np.ptp(vertices, axis=0).max()) / 2
        corners = decompose(vertices, faces, concavity=float(np.clip(fineness.gap / half, *LIMITS)))
        hulls = [hull for points in corners if (hull := hull_of(points)) is not None]
    else:
        hulls = split_surface(triangles, gap=fineness.gap, wall=fineness.wall, most=fineness.most)
    return tuple(fitted(hull) for hull in hulls)


def least_box(triangles: Float[np.ndarray, "n 3 3"], wall: float) -> Shape:
    """A box round a link that has no extent to make a hull of, `wall` [m] thick at least."""
    corners = triangles.reshape(-1, 3)
    low, high = corners.min(0), corners.max(0)
    half = np.maximum(high - low, wall) / 2
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    hull = hull_of((low + high) / 2 + signs * half)
    assert hull is not None  # a box with a thickness
    return fitted(hull)
