"""Small scenes with known joints, built from boxes [m, Z up, front at -Y]: part name -> pieces, the base first."""

from __future__ import annotations

import numpy as np
from assets import box, mesh_of

from anymesh.pipeline.solving import Solver
from anymesh.types import Joint, Mesh, Part, Segmentation

Piece = tuple[np.ndarray, np.ndarray]
Scene = dict[str, list[Piece]]


def built(scene: Scene) -> tuple[Mesh, Segmentation]:
    """Return the mesh and its true parts, with labels that do not indicate their motion."""
    mesh, piece = mesh_of([p for pieces in scene.values() for p in pieces])
    part_of_piece = np.repeat(np.arange(len(scene)), [len(pieces) for pieces in scene.values()])
    return mesh, Segmentation(part_of_piece[piece], tuple(Part(name, "part") for name in scene))


def joints_of(scene: Scene, T: np.ndarray | None = None) -> dict[str, Joint]:
    """Return the joint of every part, by the part's name; T (4, 4) first moves the whole scene."""
    mesh, segmentation = built(scene)
    mesh = mesh if T is None else mesh.transformed(T)
    return {j.child: j for j in Solver(mesh).joints(segmentation).joints}


def similarity(degrees: float, shift=(0.0, 0.0, 0.0), factor: float = 1.0) -> np.ndarray:
    """Return a rotation about z, followed by scaling and translation."""
    c, s = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
    T = np.eye(4)
    T[:3, :3] = factor * np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    T[:3, 3] = shift
    return T


def tilted(pieces: list[Piece], degrees: float) -> list[Piece]:
    """Return pieces rotated about x."""
    c, s = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
    return [(v @ np.array([[1, 0, 0], [0, c, s], [0, -s, c]]), f) for v, f in pieces]


def prism(radius: float, ends: tuple[float, float], x: float, z: float, sides: int = 24) -> Piece:
    """Return a solid cylinder along y between two positions."""
    k, n = np.arange(sides), (np.arange(sides) + 1) % sides
    ring = np.c_[np.sin(k * 2 * np.pi / sides), np.zeros(sides), np.cos(k * 2 * np.pi / sides)] * radius + (x, 0, z)
    v = np.concatenate([ring + np.array([0, e, 0]) for e in ends] + [[(x, e, z)] for e in ends])
    a, b = np.full(sides, 2 * sides), np.full(sides, 2 * sides + 1)
    return v, np.concatenate(
        [np.c_[k, n, n + sides], np.c_[k, n + sides, k + sides], np.c_[a, n, k], np.c_[b, k + sides, n + sides]]
    )


def case(h: float) -> list[Piece]:
    """Return boards around a space that is open at the front, 0.6 wide and 0.4 deep."""
    return [
        box((0, 0, 0), (0.6, 0.4, 0.02)),
        box((0, 0, h - 0.02), (0.6, 0.4, h)),
        box((0, 0, 0.02), (0.02, 0.4, h - 0.02)),
        box((0.58, 0, 0.02), (0.6, 0.4, h - 0.02)),
        box((0.02, 0.38, 0.02), (0.58, 0.4, h - 0.02)),
    ]


def bar(x: tuple[float, float], z: tuple[float, float]) -> list[Piece]:
    """Return a handle on two posts in front of y = -0.022, along x or z, whichever is longer."""
    upright = z[1] - z[0] > x[1] - x[0]
    low, high = np.array([x[0], -0.06, z[0]]), np.array([x[1], -0.022, z[1]])
    end = np.array([0, 0, z[1] - z[0] - 0.012]) if upright else np.array([x[1] - x[0] - 0.012, 0, 0])
    return [box((x[0], -0.07, z[0]), (x[1], -0.06, z[1])), box(low, high - end), box(low + end, high)]


def door(handle: str) -> Scene:
    """Return a panel in front of a case, with its handle at the left or the right as seen from the front."""
    x = (0.03, 0.045) if handle == "left" else (0.555, 0.57)
    return {"base": case(0.8), "leaf": [box((0.002, -0.022, 0.002), (0.598, -0.002, 0.798)), *bar(x, (0.3, 0.5))]}


def drawer(depth: float = 0.35, degrees: float = 0.0) -> Scene:
    """Return a tray with a panel and a handle in a low case, all of it tilted."""
    tray = [
        box((0.025, -0.002, 0.025), (0.575, depth, 0.035)),
        box((0.025, -0.002, 0.035), (0.035, depth, 0.2)),
        box((0.565, -0.002, 0.035), (0.575, depth, 0.2)),
        box((0.035, depth - 0.01, 0.035), (0.565, depth, 0.2)),
    ]
    front = [box((0.005, -0.022, 0.005), (0.595, -0.002, 0.275)), *bar((0.2, 0.4), (0.13, 0.142))]
    return {"base": tilted(case(0.28), degrees), "box": tilted([*front, *tray], degrees)}


def wheel() -> Scene:
    """Return a disc on the end of an axle that protrudes from a block."""
    axle = prism(0.03, (-0.08, 0.001), 0.0, 0.2)
    return {"base": [box((-0.2, 0, 0.1), (0.2, 0.2, 0.3)), axle], "disc": [prism(0.1, (-0.05, -0.02), 0.0, 0.2)]}


def lid() -> Scene:
    """Return a plate on an open box, with a handle at the front."""
    walls = [box((0, y, 0), (0.6, y + 0.01, 0.3)) for y in (0, 0.39)]
    walls += [box((x, 0.01, 0), (x + 0.01, 0.39, 0.3)) for x in (0, 0.59)]
    plate = [box((0, 0, 0.301), (0.6, 0.4, 0.32)), box((0.26, -0.025, 0.303), (0.34, 0, 0.315))]
    return {"base": [box((0.01, 0.01, 0), (0.59, 0.39, 0.01)), *walls], "plate": plate}


def slider() -> Scene:
    """Return a pane between rails above and below, half as long as the rails, from x = 0."""
    rails = [box((0, y, z), (1, y + 0.02, z + 0.06)) for y in (0, 0.06) for z in (0, 0.54)]
    webs = [box((0, 0.02, z), (1, 0.06, z + 0.02)) for z in (0, 0.58)]
    ends = [box((x, 0, 0), (x + 0.03, 0.08, 0.6)) for x in (-0.03, 1)]
    return {"base": [*rails, *webs, *ends], "pane": [box((0.002, 0.025, 0.022), (0.5, 0.055, 0.578))]}
