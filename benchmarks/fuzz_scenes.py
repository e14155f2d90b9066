"""Hostile scenes from a seed: an arrangement of parts, faults in their surfaces, and what a file may say of them.

The same seed gives the same scene. A scene is written as it is, faults and all, to GLB, OBJ, PLY, STL or OFF. `FIXTURES` are
scenes of a known class of failure, by name.
"""

from __future__ import annotations

import io
import json
import struct
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float
from PIL import Image

from benchmarks.fuzz_shapes import (
    ARRANGEMENTS,
    Part,
    Rng,
    ball,
    bars_through_board,
    merged,
    path_tube,
    placed,
    rod,
    tube_lamp,
)

FORMATS = ("glb", "glb", "glb", "obj", "ply", "stl", "off")  # GLB more often: it alone has nodes, transforms, materials
NAMES = (
    "", "door", "door", "base", "Tür links", "扉", "a/b\\c", "<&>\"'", "..", "x" * 400, "1", "link name", "nul\tl", "🚪", "-",
)  # fmt: skip
EXTREME = 0.15  # share of scenes in units far from metres, and of those far from the origin
FAULTY = 0.5  # share of scenes with faults in some of their surfaces
MOST_FAULTS = 4
FLOAT, UINT = 5126, 5125  # component types of glTF
UV_LOOKS = ("textured", "uv out of range", "missing texture", "broken texture")


@dataclass(frozen=True)
class Scene:
    """What is written to one file. unit: factor on all coordinates; offset: then added [units of the file]."""

    name: str
    format: str
    parts: tuple[Part, ...]
    unit: float = 1.0
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    faults: tuple[str, ...] = ()
    looks: str = "plain"  # of LOOKS
    options: dict[str, str] = field(default_factory=dict)  # of `articulate`


LOOKS = ("plain", "plain", "colors", "textured", "no uv", "uv out of range", "missing texture", "broken texture")


def _flip_some(part: Part, rng: Rng) -> Part:
    faces = part.faces.copy()
    turned = rng.random(len(faces)) < rng.choice([0.1, 0.5, 1.0])
    faces[turned] = faces[turned, ::-1]
    return replace(part, faces=faces)


def _duplicate_faces(part: Part, rng: Rng) -> Part:
    again = part.faces[rng.random(len(part.faces)) < 0.4]
    return replace(part, faces=np.concatenate([part.faces, again[:, ::-1] if rng.random() < 0.5 else again]))


def _unmerge(part: Part, rng: Rng) -> Part:
    jitter = 10.0 ** rng.uniform(-12, -6) if rng.random() < 0.3 else 0.0
    vertices = part.vertices[part.faces].reshape(-1, 3)
    vertices = vertices + jitter * rng.normal(size=vertices.shape)
    return replace(part, vertices=vertices, faces=np.arange(len(vertices)).reshape(-1, 3))


def _zero_area(part: Part, rng: Rng) -> Part:
    if not len(part.vertices):
        return part
    a, b = rng.integers(0, len(part.vertices), (2, 8))
    return replace(part, faces=np.concatenate([part.faces, np.stack([a, b, np.where(rng.random(8) < 0.5, a, b)], 1)]))


def _flatten(part: Part, rng: Rng) -> Part:
    vertices = part.vertices.copy()
    vertices[:, int(rng.integers(3))] *= rng.choice([0.0, 1e-9, 1e-5])
    return replace(part, vertices=vertices)


def _drop_faces(part: Part, rng: Rng) -> Part:
    return replace(part, faces=part.faces[rng.random(len(part.faces)) < rng.uniform(0.3, 0.95)])


def _stray_vertices(part: Part, rng: Rng) -> Part:
    return replace(part, vertices=np.concatenate([part.vertices, rng.normal(0, 1e4, (5, 3))]))


def _jitter(part: Part, rng: Rng) -> Part:
    size = float(np.ptp(part.vertices, axis=0).max()) if len(part.vertices) else 0.0
    return replace(part, vertices=part.vertices + 10.0 ** rng.uniform(-8, -1.5) * size * rng.normal(size=part.vertices.shape))


def _shear(part: Part, rng: Rng) -> Part:
    T = part.T.copy()
    T[:3, :3] = T[:3, :3] @ (np.eye(3) + rng.normal(0, 0.6, (3, 3)))
    return replace(part, T=T)


def _mirror(part: Part, rng: Rng) -> Part:
    return replace(part, T=part.T @ np.diag([*rng.choice([-1.0, 1.0], 3), 1.0]))


def _squash_node(part: Part, rng: Rng) -> Part:
    scale = np.ones(4)
    scale[int(rng.integers(3))] = rng.choice([0.0, 1e-8, 1e5])
    return replace(part, T=part.T @ np.diag(scale))


def _far(part: Part, rng: Rng) -> Part:
    T = part.T.copy()
    T[:3, 3] += rng.normal(size=3) * 10.0 ** rng.uniform(1, 3.5)
    return replace(part, T=T)


def _into_another(part: Part, rng: Rng) -> Part:
    T = part.T.copy()
    T[:3, 3] += rng.normal(0, 0.2, 3)
    return replace(part, T=T)


FAULTS = {
    "flipped faces": _flip_some,
    "duplicate faces": _duplicate_faces,
    "duplicate vertices": _unmerge,
    "zero-area faces": _zero_area,
    "flattened": _flatten,
    "missing faces": _drop_faces,
    "stray vertices": _stray_vertices,
    "jitter": _jitter,
    "sheared node": _shear,
    "mirrored node": _mirror,
    "squashed node": _squash_node,
    "far apart": _far,
    "interpenetrating": _into_another,
}


def scene(seed: int) -> Scene:
    """The scene of a seed, 0 or more."""
    rng = np.random.default_rng([0xA5, seed])
    names = list(ARRANGEMENTS)
    weights = np.array([ARRANGEMENTS[n][0] for n in names], float)
    kind = names[int(rng.choice(len(names), p=weights / weights.sum()))]
    parts = _named(ARRANGEMENTS[kind][1](rng), rng)
    faults: list[str] = []
    if rng.random() < FAULTY:
        faults = [str(f) for f in rng.choice(list(FAULTS), int(rng.integers(1, MOST_FAULTS + 1)), replace=False)]
        struck = [rng.random(len(parts)) < rng.choice([0.2, 1.0]) for _ in faults]
        for fault, where in zip(faults, struck, strict=True):
            parts = [FAULTS[fault](p, rng) if hit else p for p, hit in zip(parts, where, strict=True)]
    far = 10.0 ** rng.uniform(2, 7) * rng.normal(size=3) if rng.random() < EXTREME / 2 else np.zeros(3)
    return Scene(
        f"{seed:05d}",
        str(rng.choice(FORMATS)),
        tuple(parts),
        unit=float(10.0 ** rng.uniform(-6, 6)) if rng.random() < EXTREME else 1.0,
        offset=(float(far[0]), float(far[1]), float(far[2])),
        faults=(kind, *faults),
        looks=str(rng.choice(LOOKS)),
        options=_options(rng),
    )


def chandelier(beads: int = 2000, sections: int = 6, rings: int = 5) -> list[Part]:
    """Curved open tubes with strings of beads: 2,000 components and 120,000 faces by default."""
    arms, strings = [], []
    turn = np.linspace(0, 2 * np.pi, 8, endpoint=False)
    for a in turn:
        out = np.linspace(0, 0.4, 7)
        arms.append(path_tube(np.stack([out * np.cos(a), 0.1 * np.sin(8 * out), out * np.sin(a)], 1), 0.006))
    for k in range(beads):
        a, t = turn[k % 8], (k // 8) / max(beads // 8, 1)
        at = (0.4 * t * np.cos(a), -0.05 - 0.3 * t * (1 - t), 0.4 * t * np.sin(a))
        strings.append(placed(ball(sections, rings), 0.8 / max(beads // 8, 1) / 2, at))
    rod_ = rod((0, 0, 0), (0, 0.5, 0), 0.01)
    return [Part("stem", *rod_), Part("arms", *merged(arms)), Part("beads", *merged(strings))]


def crossing_sticks(count: int = 700) -> list[Part]:
    """Long sticks in random directions through one place, most of which cross most others."""
    rng = np.random.default_rng(0)
    ends = rng.normal(size=(count, 3))
    ends /= 2 * np.linalg.norm(ends, axis=1, keepdims=True)
    middles = rng.uniform(-0.2, 0.2, (count, 3))
    return [Part("sticks", *merged([rod(m - e, m + e, 0.004, 4) for m, e in zip(middles, ends, strict=True)]))]


FIXTURES: dict[str, Callable[[], list[Part]]] = {
    "bars through a board": bars_through_board,
    "chandelier": chandelier,
    "crossing sticks": crossing_sticks,
    "lamp of thin tubes": tube_lamp,
}


def fixture(name: str) -> Scene:
    """A scene of a known class of failure."""
    return Scene(name, "glb", tuple(FIXTURES[name]()), faults=(name,))


def _named(parts: list[Part], rng: Rng) -> list[Part]:
    """Names as artists, scanners and other languages give them; most stay."""
    if rng.random() < 0.6:
        return parts
    return [replace(p, name=str(rng.choice(NAMES))) if rng.random() < 0.5 else p for p in parts]


def _options(rng: Rng) -> dict[str, str]:
    return {
        "up": str(rng.choice(["auto", "auto", "x", "y", "z"])),
        "scale": str(rng.choice(["auto", "auto", "auto", "0.5:longest"])),
        "base": str(rng.choice(["fixed", "free"])),
        "drives": str(rng.choice(["passive", "position"])),
    }


def write_scene(scene: Scene, folder: Path) -> Path:
    """The file of a scene, with what belongs to it beside it."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{scene.name.replace(' ', '_')}.{scene.format}"
    write = {"glb": _glb, "obj": _obj, "ply": _ply, "stl": _stl, "off": _off}[scene.format]
    path.write_bytes(write(scene, folder))
    return path


def _in_scene(part: Part, scene: Scene) -> Float[np.ndarray, "V 3"]:
    """The vertices in the coordinates of the file."""
    return (part.vertices @ part.T[:3, :3].T + part.T[:3, 3]) * scene.unit + scene.offset


def _joined(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    offsets = np.cumsum([0, *(len(p.vertices) for p in scene.parts)])
    faces = [p.faces + o for p, o in zip(scene.parts, offsets, strict=False)]
    return np.concatenate([_in_scene(p, scene) for p in scene.parts]), np.concatenate(faces)


def _uv(part: Part, looks: str) -> Float[np.ndarray, "V 2"]:
    """Texture coordinates from two of the coordinates."""
    return (part.vertices[:, :2] * (1e6 if looks == "uv out of range" else 1.0)).astype(np.float32)


def _picture(looks: str) -> bytes:
    if looks == "broken texture":
        return b"\x89PNG\r\n\x1a\n broken"
    file = io.BytesIO()
    Image.fromarray(np.indices((4, 4)).sum(0).astype(np.uint8)[..., None].repeat(3, 2) * 40).save(file, "PNG")
    return file.getvalue()


def _looks(scene: Scene) -> dict[str, Any]:
    """Materials, textures and images of a GLB."""
    material: dict[str, Any] = {"name": "paint", "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.3, 0.2, 1.0]}}
    made: dict[str, Any] = {"materials": [material]}
    if scene.looks in ("textured", "no uv", "uv out of range", "missing texture", "broken texture"):
        material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
        made |= {"textures": [{"source": 0}], "images": [{"uri": "paint.png"}]}
    return made


def _write_picture(scene: Scene, folder: Path) -> None:
    if scene.looks in ("textured", "no uv", "uv out of range", "broken texture"):
        (folder / "paint.png").write_bytes(_picture(scene.looks))


class _Binary:
    """The buffer of a GLB, with its views and accessors."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.views: list[dict[str, int]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(self, values: np.ndarray, kind: str) -> int:
        raw = np.ascontiguousarray(values).tobytes()
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(raw)})
        self.data += raw + bytes(-len(raw) % 4)
        component = FLOAT if values.dtype.kind == "f" else UINT
        accessor = {"bufferView": len(self.views) - 1, "componentType": component, "count": len(values), "type": kind}
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def _glb(scene: Scene, folder: Path) -> bytes:
    binary, nodes, meshes = _Binary(), [], []
    _write_picture(scene, folder)
    for part in scene.parts:
        attributes = {"POSITION": binary.add(part.vertices.astype(np.float32), "VEC3")}
        if scene.looks in UV_LOOKS:
            attributes["TEXCOORD_0"] = binary.add(_uv(part, scene.looks), "VEC2")
        if scene.looks == "colors":
            attributes["COLOR_0"] = binary.add(2 * np.abs(part.vertices).astype(np.float32), "VEC3")
        index = binary.add(part.faces.astype(np.uint32).ravel(), "SCALAR")
        primitive: dict[str, Any] = {"attributes": attributes, "indices": index}
        if scene.looks != "plain":
            primitive["material"] = 0
        nodes.append({"name": part.name, "mesh": len(meshes), "matrix": part.T.T.ravel().tolist()})
        meshes.append({"primitives": [primitive]})
    empty = [{"name": "empty"}, {"name": "camera", "translation": [9, 9, 9]}]
    nodes += empty
    root = {"name": "root", "children": list(range(len(nodes))), "scale": [scene.unit] * 3, "translation": list(scene.offset)}
    nodes.append(root)
    tree = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [len(nodes) - 1]}],
        "nodes": nodes,
        "meshes": meshes,
        "accessors": binary.accessors,
        "bufferViews": binary.views,
        "buffers": [{"byteLength": len(binary.data)}],
        **(_looks(scene) if scene.looks != "plain" else {}),
    }
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    chunks = [struct.pack("<I4s", len(data), kind) + bytes(data) for data, kind in ((text, b"JSON"), (binary.data, b"BIN\0"))]
    return struct.pack("<4sII", b"glTF", 2, 12 + sum(map(len, chunks))) + b"".join(chunks)


def _obj(scene: Scene, folder: Path) -> bytes:
    textured = scene.looks not in ("plain", "colors", "no uv")
    lines, start = [], 1
    if scene.looks != "plain":
        _write_picture(scene, folder)
        lines.append("mtllib paint.mtl")
        (folder / "paint.mtl").write_text("newmtl paint\nKd .8 .3 .2\n" + ("map_Kd paint.png\n" if textured else ""))
    for part in scene.parts:
        lines += [f"o {part.name}", *(f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in _in_scene(part, scene).tolist())]
        if textured:
            lines += [f"vt {u:.6g} {v:.6g}" for u, v in _uv(part, scene.looks).tolist()]
        if scene.looks != "plain":
            lines.append("usemtl paint" if scene.looks != "no uv" else "usemtl missing")
        form = "f {0}/{0} {1}/{1} {2}/{2}" if textured else "f {} {} {}"
        lines += [form.format(*face) for face in (part.faces + start).tolist()]
        start += len(part.vertices)
    return "\n".join([*lines, ""]).encode()


def _ply(scene: Scene, folder: Path) -> bytes:
    vertices, faces = _joined(scene)
    colors = scene.looks != "plain"
    head = [
        "ply",
        "format binary_little_endian 1.0",
        f"element vertex {len(vertices)}",
        *(f"property double {a}" for a in "xyz"),
        *(f"property uchar {c}" for c in ("red", "green", "blue") if colors),
        f"element face {len(faces)}",
        "property list uchar int vertex_indices",
        "end_header",
    ]
    kinds = [("p", "<f8", 3)] + [("c", "u1", 3)] * colors
    points = np.zeros(len(vertices), kinds)
    points["p"] = vertices
    if colors:
        points["c"] = np.arange(len(vertices))[:, None] % 256
    rows = np.zeros(len(faces), [("n", "u1"), ("i", "<i4", 3)])
    rows["n"], rows["i"] = 3, faces
    return "\n".join([*head, ""]).encode() + points.tobytes() + rows.tobytes()


def _stl(scene: Scene, folder: Path) -> bytes:
    vertices, faces = _joined(scene)
    rows = np.zeros(len(faces), [("n", "<f4", 3), ("p", "<f4", (3, 3)), ("a", "<u2")])
    rows["p"] = vertices[faces]
    return bytes(80) + struct.pack("<I", len(rows)) + rows.tobytes()


def _off(scene: Scene, folder: Path) -> bytes:
    vertices, faces = _joined(scene)
    lines = ["OFF", f"{len(vertices)} {len(faces)} 0", *(f"{x:.17g} {y:.17g} {z:.17g}" for x, y, z in vertices.tolist())]
    return "\n".join([*lines, *(f"3 {a} {b} {c}" for a, b, c in faces.tolist()), ""]).encode()
