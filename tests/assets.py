"""Small assets with known parts and joints, built from boxes."""

from __future__ import annotations

import io
from dataclasses import replace

import numpy as np
from PIL import Image

from anymesh.types import (
    Asset,
    Joint,
    JointType,
    Material,
    Mesh,
    Motion,
    Node,
    Part,
    Segmentation,
    Source,
    Texture,
)

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
CUBE_FACES = np.array([t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))])
QUAD_UV = np.array([[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1], [0, 1]]], np.float32)


def checker(size: int = 8) -> bytes:
    """A PNG of red and blue squares."""
    squares = np.indices((size, size)).sum(0) % 2
    pixels = np.where(squares[..., None] == 0, (200, 30, 30), (30, 30, 200)).astype(np.uint8)
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "PNG")
    return file.getvalue()


def box(low, high) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and outward faces of an axis-aligned box."""
    low, high = np.asarray(low, float), np.asarray(high, float)
    return low + CUBE * (high - low), CUBE_FACES


def solid(low, high) -> np.ndarray:
    """Return the triangles (12, 3, 3) of a box."""
    v, f = box(low, high)
    return v[f]


def mesh_of(pieces, face_material=None, **attributes) -> tuple[Mesh, np.ndarray]:
    """A mesh of (vertices, faces) pieces and the piece number of each face."""
    vertices, faces, number, offset = [], [], [], 0
    for index, (v, f) in enumerate(pieces):
        vertices.append(v)
        faces.append(f + offset)
        number.append(np.full(len(f), index))
        offset += len(v)
    count = np.concatenate(number)
    material = np.full(len(count), -1) if face_material is None else np.asarray(face_material)
    mesh = Mesh(
        vertices=np.concatenate(vertices),
        faces=np.concatenate(faces),
        face_node=np.zeros(len(count), int),
        nodes=(Node("all"),),
        face_material=material,
        **attributes,
    )
    return mesh, count


def source(path: str = "cabinet.glb") -> Source:
    return Source(path, "0" * 64, np.eye(4), "z", ("up as stored",))


def joint(name, kind, parent, child, origin, axis, limits, **more) -> Joint:
    axis = np.asarray(axis, float)
    return Joint(
        name,
        JointType(kind),
        parent,
        child,
        np.asarray(origin, float),
        axis / np.linalg.norm(axis),
        limits,
        0.9,
        "built so",
        **more,
    )


CABINET = {
    "base": [  # a case open at the front (-y), with a shelf
        box((0, 0, 0), (0.6, 0.4, 0.02)),
        box((0, 0, 0.98), (0.6, 0.4, 1)),
        box((0, 0, 0.02), (0.02, 0.4, 0.98)),
        box((0.58, 0, 0.02), (0.6, 0.4, 0.98)),
        box((0.02, 0.38, 0.02), (0.58, 0.4, 0.98)),
        box((0.02, 0.01, 0.6), (0.58, 0.38, 0.62)),
    ],
    "door": [box((0.005, -0.02, 0.025), (0.595, 0, 0.6))],
    "drawer": [box((0.03, -0.02, 0.65), (0.57, 0.36, 0.66)), box((0.03, -0.02, 0.66), (0.57, 0, 0.95))],
    "knob": [box((0.28, -0.06, 0.78), (0.32, -0.02, 0.82))],
}


def cabinet(names=("base", "door", "drawer", "knob"), name: str = "cabinet", **changes) -> Asset:
    """A case with a textured hinged door, a drawer, and a knob that turns on the drawer."""
    pieces = [piece for part in CABINET.values() for piece in part]
    counts = [len(part) for part in CABINET.values()]
    piece_part = np.repeat(np.arange(4), counts)
    part_of = np.repeat(piece_part, 12)
    materials = (
        Material("wood & <oak>", (0.5, 0.3, 0.1, 1.0), roughness=0.6),
        Material("paint", textures={"base_color": Texture(checker(), "image/png", "checker.png")}),
        Material("steel", (0.8, 0.8, 0.85, 1.0), metallic=1.0, roughness=0.2),
    )
    mesh, _ = mesh_of(
        pieces,
        np.array([0, 1, 0, 2])[part_of],
        materials=materials,
        corner_uv=np.tile(QUAD_UV, (len(part_of) // 2, 1, 1)),
    )
    normals = np.repeat(mesh.face_normals[:, None], 3, axis=1).astype(np.float32)
    colors = np.full((len(part_of), 3, 4), 255, np.uint8)
    colors[part_of == 3] = (10, 200, 90, 255)
    mesh = replace(mesh, corner_normal=normals, corner_color=colors)
    base, door, drawer, knob = names
    joints = (
        joint("hinge", "revolute", base, door, (0.6, 0, 0.3), (0, 0, 1), (0.0, 1.9)),
        joint("slide", "prismatic", base, drawer, (0.3, 0, 0.8), (0, -1, 0), (0.0, 0.3)),
        joint("turn", "continuous", drawer, knob, (0.3, -0.04, 0.8), (0, -1, 0), None),
    )
    fields = {"joints": joints, "answerer": "geometry", "warnings": ("a warning",), "timing": {"mesh": 0.25}}
    labels = ("base", "door", "drawer", "knob")
    parts = tuple(Part(n, label, 0.8, f"looks like a {label}") for n, label in zip(names, labels, strict=True))
    return Asset(name, source(), mesh, Segmentation(part_of, parts), **{**fields, **changes})


def slanted() -> Asset:
    """Joints of every kind about slanted axes, three levels deep, with limits on both sides."""
    pieces = [box((i, 0, 0), (i + 0.5, 0.4, 0.3)) for i in range(5)]
    mesh, part_of = mesh_of(pieces)
    joints = (
        joint("a", "revolute", "p0", "p1", (1, 0.1, 0.2), (1, 2, 3), (-2.5, 2.8)),
        joint("b", "prismatic", "p1", "p2", (2, -0.3, 0.1), (-1, 0.5, 0.2), (-0.4, 0.1)),
        joint("c", "continuous", "p2", "p3", (3.2, 0.2, 0.1), (0.3, -1, 0.4), None),
        joint("d", "fixed", "p3", "p4", (4, 0, 0), (0, 0, 1), None),
    )
    parts = tuple(Part(f"p{i}", "part") for i in range(5))
    return Asset("slanted", source(), mesh, Segmentation(part_of, parts), joints, "geometry")


def pistol(axis, limits=(0.0, 0.02)) -> Asset:
    """A grip below a barrel that reaches far to the front (-y), and a trigger in a slot at the front of the grip."""
    slot = [box((0, 0, 0), (0.03, 0.06, 0.1)), box((0, -0.02, 0), (0.01, 0, 0.1)), box((0.02, -0.02, 0), (0.03, 0, 0.1)),
            box((0, -0.3, 0.1), (0.03, 0.1, 0.15))]  # fmt: skip
    mesh, piece = mesh_of([*slot, box((0.011, -0.03, 0.06), (0.019, -0.008, 0.09))])
    slide = joint("pull", "prismatic", "body", "trigger", (0, 0, 0), axis, limits)
    parts = (Part("body", "body"), Part("trigger", "drawer"))
    return Asset("pistol", source(), mesh, Segmentation((piece == 4).astype(int), parts), (slide,), "geometry")


def poses(asset: Asset, positions: dict[str, float]) -> dict[str, np.ndarray]:
    """Where each part's rest placement goes, composing motions down the tree (asset frame); joints not named rest."""
    found = {asset.segmentation.parts[0].name: np.eye(4)}
    waiting = list(asset.joints)
    while waiting:
        j = waiting.pop(0)
        if j.parent not in found:
            waiting.append(j)
            continue
        step = np.eye(4)
        if j.type is not JointType.FIXED:
            kind = JointType.PRISMATIC if j.type is JointType.PRISMATIC else JointType.REVOLUTE
            step = Motion(kind, j.axis, j.origin, "test").transform(positions.get(j.name, 0.0))
        found[j.child] = found[j.parent] @ step
    return found


def posed_triangles(asset: Asset, positions: dict[str, float]) -> dict[str, np.ndarray]:
    """Corners of each part's faces, in the order of the source, after moving the joints."""
    moved = poses(asset, positions)
    result = {}
    for index, part in enumerate(asset.segmentation.parts):
        T = moved[part.name]
        result[part.name] = asset.mesh.triangles[asset.segmentation.faces(index)] @ T[:3, :3].T + T[:3, 3]
    return result


def within_limits(asset: Asset, rng: np.random.Generator) -> dict[str, float]:
    """Random joint positions."""
    limits = {j.name: j.limits or (-np.pi, np.pi) for j in asset.joints if j.type is not JointType.FIXED}
    return {name: float(rng.uniform(*ends)) for name, ends in limits.items()}


def read_obj(path) -> np.ndarray:
    """Corner positions (F, 3, 3) of an OBJ's faces, in the order of the file."""
    rows = [line.split() for line in path.read_text().splitlines() if line]
    v = np.array([r[1:4] for r in rows if r[0] == "v"], float)
    return v[np.array([[int(c.split("/")[0]) - 1 for c in r[1:]] for r in rows if r[0] == "f"])]
