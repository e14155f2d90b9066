"""Drawings of an asset on the live page, as plain arrays: simplified parts, axes, limits, inertia."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float, Int

from anymesh.geometry.kinematics import joint_transform
from anymesh.geometry.simplify_ import simplify
from anymesh.physics.inertia import Inertia
from anymesh.rendering.marks import axis_line, ring
from anymesh.rendering.preview import BASE, PALETTE
from anymesh.types import Asset, Box, Cylinder, Hull, Joint, JointType, Mesh, Shape

MAX_DISPLAY_FACES = 200_000  # maximum number of faces drawn; a denser object is decimated for display
MIN_PART_FACES = 200  # minimum number of faces of a part
APART = 0.3  # distance of a part from its parent in the exploded view, as a share of the diagonal
RADIUS = 0.05  # radius of the ring around an axis, as a share of the diagonal
SIDES = 24  # of a drawn cylinder
FADED = 0.65  # share of white in the colour of unselected parts
SHADES = (1.0, 0.78, 0.9, 0.68)  # of the collision shapes of one part
BOX = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float) / 2
BOX_FACES = np.array([
    [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7],
    [1, 7, 3],
])  # fmt: skip
BOX_EDGES = np.array([[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]])
Color = tuple[int, int, int]


@dataclass(frozen=True, eq=False)
class DisplayMesh:
    """Triangles to draw [m]."""

    vertices: Float[np.ndarray, "V 3"]
    faces: Int[np.ndarray, "F 3"]


@dataclass
class Surfaces:
    """Display surfaces of the parts. Decimated ones are cached while their mesh and faces are unchanged."""

    most: int = MAX_DISPLAY_FACES
    _of: Mesh | None = None
    _kept: dict[bytes, DisplayMesh] = field(default_factory=dict)

    def of(self, asset: Asset) -> dict[str, DisplayMesh]:
        """Return part name -> surface in the asset frame at rest."""
        mesh, surfaces, keys = asset.mesh, {}, {}
        if mesh is not self._of:
            self._of, self._kept = mesh, {}
        dense = len(mesh.faces) > self.most
        for number, part in enumerate(asset.segmentation.parts):
            faces = asset.segmentation.faces(number)
            keys[part.name] = key = hashlib.sha256(faces.tobytes()).digest()
            if key in self._kept:
                surfaces[part.name] = self._kept[key]
            elif dense:
                few = simplify(mesh.triangles[faces], max(MIN_PART_FACES, self.most * len(faces) // len(mesh.faces)))
                surfaces[part.name] = DisplayMesh(few.reshape(-1, 3), np.arange(3 * len(few)).reshape(-1, 3))
            else:
                piece = mesh.subset(faces)
                surfaces[part.name] = DisplayMesh(piece.vertices, piece.faces)
        self._kept |= {keys[name]: surface for name, surface in surfaces.items()}
        return surfaces

    def note(self, asset: Asset) -> str:
        """Return a note on the displayed surface, "" if it is exact."""
        count = len(asset.mesh.faces)
        if count <= self.most:
            return ""
        return f"Decimated for display to about {self.most:,} of {count:,} faces; corrections and files use them all."


def color_of(number: int, *, faded: bool = False) -> Color:
    """Return the colour of a part, as in the preview."""
    r, g, b = (float(v) for v in (BASE if number == 0 else PALETTE[(number - 1) % len(PALETTE)]))
    share = FADED if faded else 0.0
    return round(r + share * (255 - r)), round(g + share * (255 - g)), round(b + share * (255 - b))


def shade_of(number: int, shape: int) -> Color:
    """Return the colour of a part's collision shape: that of the part, in shades that distinguish neighbours."""
    r, g, b = color_of(number)
    share = SHADES[shape % len(SHADES)]
    return round(share * r), round(share * g), round(share * b)


def apart(asset: Asset) -> dict[str, Float[np.ndarray, " 3"]]:
    """Return part name -> offset in the exploded view [m]: away from its parent, in its opening direction."""
    middle, offsets = {}, {asset.segmentation.parts[0].name: np.zeros(3)}
    for number, part in enumerate(asset.segmentation.parts):
        corners = asset.mesh.triangles[asset.segmentation.faces(number)].reshape(-1, 3)
        middle[part.name] = (corners.min(0) + corners.max(0)) / 2
    carried = {j.child: j for j in asset.joints}

    def of(name: str) -> np.ndarray:
        if name not in offsets:
            joint = carried[name]
            offsets[name] = of(joint.parent) + APART * asset.mesh.diagonal * _opening_direction(joint, middle)
        return offsets[name]

    return {part.name: of(part.name) for part in asset.segmentation.parts}


def _opening_direction(joint: Joint, middle: dict[str, np.ndarray]) -> np.ndarray:
    if joint.type is JointType.PRISMATIC:
        return joint.axis
    off = middle[joint.child] - middle[joint.parent]
    length = float(np.linalg.norm(off))
    return off / length if length > 1e-9 else joint.axis


@dataclass(frozen=True, eq=False)
class JointLines:
    """Lines of a joint at rest: an arrow along its axis (two ends), the positive rotation, and the path between its limits."""

    arrow: Float[np.ndarray, "2 3"]
    sense: Float[np.ndarray, "k 2 3"]  # segments
    range: Float[np.ndarray, "m 2 3"]  # segments: path of the part's furthest point from limit to limit


def joint_lines(asset: Asset, joint: Joint) -> JointLines:
    """Return the lines that show a joint, in the asset frame at rest [m]."""
    number = next(k for k, p in enumerate(asset.segmentation.parts) if p.name == joint.child)
    corners, diagonal = asset.mesh.triangles[asset.segmentation.faces(number)].reshape(-1, 3), asset.mesh.diagonal
    slides = joint.type is JointType.PRISMATIC
    arrow, center = axis_line(corners, joint.origin, joint.axis, slides, diagonal)
    nothing = np.zeros((0, 2, 3))
    sense = nothing if slides else _segments(ring(center, joint.axis, RADIUS * diagonal))
    if joint.limits is None:
        return JointLines(arrow, sense, nothing)
    arm = corners - joint.origin
    arm = arm - (arm @ joint.axis)[:, None] * joint.axis
    tip = corners.mean(0) if slides else corners[np.linalg.norm(arm, axis=1).argmax()]
    steps = (joint_transform(joint, p) for p in np.linspace(*joint.limits, 2 if slides else 33))
    path = np.array([T[:3, :3] @ tip + T[:3, 3] for T in steps])
    ends = [nothing] if slides else [np.stack([path[k], _on_axis(joint, path[k])])[None] for k in (0, -1)]
    return JointLines(arrow, sense, np.concatenate([_segments(path), *ends]))


def _on_axis(joint: Joint, point: np.ndarray) -> np.ndarray:
    return joint.origin + ((point - joint.origin) @ joint.axis) * joint.axis


def _segments(points: np.ndarray) -> Float[np.ndarray, "k 2 3"]:
    return np.stack([points[:-1], points[1:]], 1)


def box_lines(points: Float[np.ndarray, "n 3"], wider: float) -> Float[np.ndarray, "12 2 3"]:
    """Return the edges of the axis-aligned box of points, enlarged by `wider` [m] on each side."""
    low, high = points.min(0) - wider, points.max(0) + wider
    return ((low + high) / 2 + BOX * (high - low))[BOX_EDGES]


def shape_surface(shape: Shape) -> DisplayMesh:
    """Return a collision shape as triangles in its link's frame."""
    match shape:
        case Box():
            return DisplayMesh(shape.center + (BOX * shape.size) @ shape.rotation.T, BOX_FACES)
        case Hull():
            return DisplayMesh(shape.vertices, shape.faces)
        case Cylinder():
            t = 2 * np.pi * np.arange(SIDES) / SIDES
            rim = np.c_[shape.radius * np.cos(t), shape.radius * np.sin(t)]
            half = np.full(SIDES, shape.length / 2)
            local = np.concatenate([np.c_[rim, -half], np.c_[rim, half], [[0, 0, -half[0]], [0, 0, half[0]]]])
            k, n = np.arange(SIDES), (np.arange(SIDES) + 1) % SIDES
            low, high = np.full(SIDES, 2 * SIDES), np.full(SIDES, 2 * SIDES + 1)
            sides = [
                np.c_[k, n, n + SIDES],
                np.c_[k, n + SIDES, k + SIDES],
                np.c_[n, k, low],
                np.c_[k + SIDES, n + SIDES, high],
            ]
            return DisplayMesh(shape.center + local @ shape.rotation.T, np.concatenate(sides))


def inertia_box(inertia: Inertia) -> DisplayMesh:
    """Return the box of uniform density with this mass and these moments, in the link's frame."""
    moments, axes = np.linalg.eigh(inertia.tensor)
    squares = 6 * (moments.sum() - 2 * moments) / max(inertia.mass, 1e-12)
    size = np.sqrt(np.maximum(squares, 0))
    return DisplayMesh(inertia.center + (BOX * size) @ axes.T, BOX_FACES)


def swayed(joint: Joint, phase: float) -> float:
    """Return the position of a joint [rad or m] at a phase 0..1 of its play: rest, one limit, rest, the other limit."""
    if joint.type is JointType.FIXED:
        return 0.0
    if joint.limits is None:
        return 2 * np.pi * phase
    lower, upper = joint.limits
    if lower == 0 or upper == 0:
        return (lower + upper) * (1 - np.cos(2 * np.pi * phase)) / 2
    s = float(np.sin(2 * np.pi * phase))
    return upper * max(s, 0.0) - lower * min(s, 0.0)
