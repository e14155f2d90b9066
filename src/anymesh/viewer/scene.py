"""Drawings of an asset on pages, as plain values: simplified parts, axes, limits, inertia, exploded view, first view."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from anymesh.geometry.kinematics import joint_motion, joint_transform
from anymesh.geometry.simplify_ import simplify
from anymesh.mechanisms.following import follower_tables
from anymesh.physics.inertia import Inertia
from anymesh.rendering.marks import axis_line, ring
from anymesh.rendering.preview import BASE, LIFT, PALETTE, opened_view
from anymesh.runtime import read_json
from anymesh.types import Asset, Box, Brief, Cylinder, Hull, Joint, JointType, Mesh, Shape
from anymesh.types.motion import SLIDING
from anymesh.types.triangles import unshared

MAX_DISPLAY_FACES = 200_000  # maximum number of faces drawn; a denser object is decimated for display
MIN_PART_FACES = 200  # minimum number of faces of a part
APART = 0.35  # distance of a part from its parent in the exploded view, as a share of the diagonal
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
RING = 0.04  # radius of the ring around an axis in a report, as a share of the diagonal; as in the preview


@dataclass(frozen=True, eq=False)
class DisplayMesh(Brief):
    """Triangles to draw [m]."""

    vertices: Float[np.ndarray, "V 3"]
    faces: Int[np.ndarray, "F 3"]


def surface(mesh: Mesh, faces: Int[np.ndarray, " f"], most: int = MAX_DISPLAY_FACES) -> DisplayMesh:
    """Return some faces as a surface, decimated if the mesh has more than `most` faces."""
    if len(mesh.faces) <= most:
        piece = mesh.subset(faces)
        return DisplayMesh(piece.vertices, piece.faces)
    few = simplify(mesh.triangles[faces], max(MIN_PART_FACES, most * len(faces) // len(mesh.faces)))
    return DisplayMesh(*unshared(few))


@dataclass
class Surfaces(Brief):
    """Display surfaces of the parts. Decimated ones are cached while their mesh and faces are unchanged."""

    most: int = MAX_DISPLAY_FACES
    _of: Mesh | None = None
    _kept: dict[bytes, DisplayMesh] = field(default_factory=dict)

    def of(self, asset: Asset) -> dict[str, DisplayMesh]:
        """Return part name -> surface in the asset frame at rest."""
        mesh, surfaces, keys = asset.mesh, {}, {}
        if mesh is not self._of:
            self._of, self._kept = mesh, {}
        for number, part in enumerate(asset.segmentation.parts):
            faces = asset.segmentation.faces(number)
            keys[part.name] = key = hashlib.sha256(faces.tobytes()).digest()
            surfaces[part.name] = self._kept[key] if key in self._kept else surface(mesh, faces, self.most)
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
            offsets[name] = of(joint.parent) + APART * asset.mesh.diagonal * opening_direction(joint, middle)
        return offsets[name]

    return {part.name: of(part.name) for part in asset.segmentation.parts}


def opening_direction(joint: Joint, middle: Mapping[str, Float[np.ndarray, " 3"]]) -> Float[np.ndarray, " 3"]:
    """Return the direction in which a part leaves its parent: a slide opens, others go from centre to centre.

    middle: centre of each part's box.
    """
    if joint.type in SLIDING:
        return joint.axis if joint.limits is None or joint.limits[1] >= -joint.limits[0] else -joint.axis
    off = middle[joint.child] - middle[joint.parent]
    length = float(np.linalg.norm(off))
    return off / length if length > 0 else joint.axis


@dataclass(frozen=True, eq=False)
class JointLines(Brief):
    """Lines of a joint at rest: an arrow along its axis (two ends), the positive rotation, and the path between its limits."""

    arrow: Float[np.ndarray, "2 3"]
    sense: Float[np.ndarray, "k 2 3"]  # segments
    range: Float[np.ndarray, "m 2 3"]  # segments: path of the part's furthest point from limit to limit


def joint_lines(asset: Asset, joint: Joint) -> JointLines:
    """Return the lines that show a joint, in the asset frame at rest [m]."""
    number = next(k for k, p in enumerate(asset.segmentation.parts) if p.name == joint.child)
    corners, diagonal = asset.mesh.triangles[asset.segmentation.faces(number)].reshape(-1, 3), asset.mesh.diagonal
    slides = joint.type in SLIDING
    arrow, center = axis_line(corners, joint.origin, joint.axis, slides, diagonal)
    nothing = np.zeros((0, 2, 3))
    sense = nothing if slides else _segments(ring(center, joint.axis, RADIUS * diagonal))
    if joint.limits is None or joint.type is JointType.BALL:
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


def shown_range(asset: Asset, joint: Joint) -> tuple[float, float]:
    """Return the range over which a joint is shown [rad or m]; what lies loose is lifted by a share of the object's size."""
    return (0.0, LIFT * asset.mesh.diagonal) if joint.type is JointType.FREE else joint.span


def swayed(asset: Asset, joint: Joint, phase: float) -> float:
    """Return the position of a joint [rad or m] at a phase 0..1 of its play: rest, one limit, rest, the other limit."""
    if joint.limits is None and joint.type not in (JointType.FIXED, JointType.FREE):
        return 2 * np.pi * phase
    lower, upper = shown_range(asset, joint)
    if lower == 0 or upper == 0:
        return (lower + upper) * (1 - np.cos(2 * np.pi * phase)) / 2
    s = float(np.sin(2 * np.pi * phase))
    return upper * max(s, 0.0) - lower * min(s, 0.0)


def color_class(part: int) -> str:
    """Return the CSS class of a part's colour."""
    return "base" if part == 0 else f"c{(part - 1) % len(PALETTE)}"


def palette() -> dict[str, str]:
    """Return CSS class -> colour, with the colours of the preview."""
    rows = {"base": BASE} | {f"c{k}": color for k, color in enumerate(PALETTE)}
    return {name: "#{:02x}{:02x}{:02x}".format(*(int(v) for v in color)) for name, color in rows.items()}


@dataclass(frozen=True, eq=False)
class GripperMark(Brief):
    """A gripper at a part: its best grasp, or the frame of its handle.

    T: (4, 4) in the asset frame at rest, z along the approach, y along the closing direction; width: between the fingers [m];
    depth: of the tips ahead of the origin [m].
    """

    link: str
    T: Float[np.ndarray, "4 4"]
    width: float
    depth: float
    grasp: bool


def read_grippers(folder: Path, asset: Asset) -> tuple[GripperMark, ...]:
    """Return the best grasp of each joint that an asset's folder states, else its handle, without those that cannot be read."""
    grippers, origin = {}, {asset.segmentation.parts[0].name: np.zeros(3), **{j.child: j.origin for j in asset.joints}}
    stated = (read_json(folder / "asset.json") or {}, read_json(folder / "grasps.json") or {})
    for grasp, record in enumerate(stated):
        joints = record.get("joints")
        for joint in joints[: len(asset.joints)] if isinstance(joints, list) else ():
            with suppress(KeyError, TypeError, ValueError, IndexError, AttributeError):
                T, width, depth = _grasp(joint, record) if grasp else _handle(joint["handle"])
                link = joint["link"] if grasp else joint["handle"]["link"]
                T[:3, 3] += origin[link] * grasp  # which is in the frame of its link
                if np.isfinite([*T.ravel(), width, depth]).all() and np.allclose(T[:3, :3] @ T[:3, :3].T, np.eye(3), atol=1e-3):
                    grippers[joint["joint" if grasp else "name"]] = GripperMark(link, T, width, depth, bool(grasp))
    return tuple(grippers.values())


def _handle(handle: dict[str, Any]) -> tuple[Float[np.ndarray, "4 4"], float, float]:
    y, z = np.array(handle["closing"], float), np.array(handle["approach"], float)
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = np.stack([np.cross(y, z), y, z], 1), handle["place"]
    return T, float(handle["width"]), float(handle["depth"])


def _grasp(joint: dict[str, Any], record: dict[str, Any]) -> tuple[Float[np.ndarray, "4 4"], float, float]:
    best, tip = joint["grasps"][0], float(record["gripper"]["finger"]["tip"])
    T = np.array(best["pose"], float).reshape(4, 4)
    held = bool(best["prehensile"])
    return T, float(best["width"]), tip if held else 0.0  # what presses does so with its tips


def gripper_lines(gripper: GripperMark, size: float) -> Float[np.ndarray, "4 2 3"]:
    """Return two fingers, the palm and the arm of a gripper as segments in the asset frame [m]. size: of what is drawn [m]."""
    y, ahead = max(gripper.width, size / 4) / 2, min(gripper.depth, size)
    palm = [0, 0, -size / 2]
    own = np.array(
        [[[0, -y, ahead], [0, -y, palm[2]]], [[0, y, ahead], [0, y, palm[2]]], [[0, -y, palm[2]], [0, y, palm[2]]],
         [palm, [0, 0, -1.5 * size]]]
    )  # fmt: skip
    return own @ gripper.T[:3, :3].T + gripper.T[:3, 3]


def report_scene(asset: Asset, *, looks: bool, grippers: tuple[GripperMark, ...] = ()) -> dict[str, Any]:
    """Return plain values, lengths [m] in the asset frame at rest, parts by index. looks: start with materials."""
    number = {part.name: k for k, part in enumerate(asset.segmentation.parts)}
    carried = {joint.child: joint for joint in asset.joints}
    corners = {name: asset.mesh.triangles[asset.segmentation.face_part == k].reshape(-1, 3) for name, k in number.items()}
    middle = {name: (points.min(0) + points.max(0)) / 2 for name, points in corners.items()}
    links = []
    for name, k in number.items():
        joint = carried.get(name)
        origin = np.zeros(3) if joint is None else joint.origin
        away = np.zeros(3) if joint is None else opening_direction(joint, middle) * APART * asset.mesh.diagonal
        links.append(
            {
                "name": name,
                "color": palette()[color_class(k)],
                "parent": -1 if joint is None else number[joint.parent],
                "origin": _list(origin),
                "away": _list(away),
            }
        )
    joints = [_joint_data(asset, joint, number, corners[joint.child], middle[joint.child]) for joint in asset.joints]
    order = {joint.name: k for k, joint in enumerate(asset.joints)}
    for name, (leader, positions) in follower_tables(asset).items():
        joints[order[name]]["follows"] = {"joint": order[leader], "positions": positions}
    size = RING * asset.mesh.diagonal
    drawn = [
        {"link": number[g.link], "grasp": g.grasp, "lines": gripper_lines(g, 2 * size).reshape(-1).tolist()}
        for g in grippers
        if g.link in number
    ]
    return {"links": links, "joints": joints, "looks": looks, "ring": size, "grippers": drawn, **_first_view(asset)}


def _joint_data(asset: Asset, joint: Joint, number: dict[str, int], corners: np.ndarray, middle: np.ndarray) -> dict[str, Any]:
    ends, center = axis_line(corners, joint.origin, joint.axis, joint.type in SLIDING, asset.mesh.diagonal)
    endless = joint.limits is None and joint.type is not JointType.FREE
    axis = joint.axis if joint.type is JointType.FIXED else joint_motion(joint).axis
    return {
        "name": joint.name,
        "type": str(joint.type),
        "link": number[joint.child],
        "axis": _list(axis),
        "limits": None if endless else [float(v) for v in shown_range(asset, joint)],
        **({"pitch": joint.pitch} if joint.pitch else {}),
        "ends": [_list(end) for end in ends],
        "center": _list(center),
        "middle": _list(middle),
    }


def _first_view(asset: Asset) -> dict[str, Any]:
    """Return the view of the preview: its direction, and the box of the asset at rest and opened."""
    opened, camera = opened_view(asset)
    return {
        "toward": _list(-camera.T_world_camera[:3, 2]),  # from the object to the eye
        "low": _list(np.minimum(asset.mesh.bounds[0], opened.bounds[0])),
        "high": _list(np.maximum(asset.mesh.bounds[1], opened.bounds[1])),
    }


def _list(values: np.ndarray) -> list[float]:
    return [float(v) for v in values]
