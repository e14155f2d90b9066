"""Writes a scene as it is, faults and all, to GLB, OBJ, PLY, STL or OFF."""

from __future__ import annotations

import io
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float
from PIL import Image

from benchmarks.fuzz_arrangements import Part
from benchmarks.fuzz_scenes import Scene

FLOAT, UINT = 5126, 5125  # component types of glTF


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
        if scene.looks in ("textured", "uv out of range", "missing texture", "broken texture"):
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
