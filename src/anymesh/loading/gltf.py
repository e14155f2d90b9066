"""glTF 2.0, binary or with files beside it: every placed node with triangles; instances are copied."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from anymesh.entry_points import GLTF_JOINTS, resolve
from anymesh.errors import InputError
from anymesh.loading.files import Folder
from anymesh.loading.gltf_data import Buffers, item, parse_json, split_glb
from anymesh.loading.gltf_materials import GltfMaterial, read_materials
from anymesh.loading.join import join, rgba, simple_mesh, unique_names, unit
from anymesh.types import Mesh, Node
from anymesh.types.mesh import to_srgb

TRIANGLES = 4  # primitive mode
READ = ("KHR_texture_transform", "KHR_mesh_quantization", "EXT_texture_webp")
LEFT_OUT = {0: "points", 1: "lines", 2: "lines", 3: "lines"}


def read_gltf(data: bytes, folder: Folder) -> Mesh:
    """Return the default scene in file coordinates. Raise InputError if it is not valid."""
    name = folder.path.name
    binary = None
    if data[:4] == b"glTF":
        data, binary = split_glb(name, data)
    tree = parse_json(name, data)
    buffers = Buffers(tree, binary, folder)
    for extension in tree.get("extensionsRequired", []):
        if extension not in READ and not extension.startswith("KHR_materials_"):
            folder.warn(f"the file requires the extension {extension}, which is not read")
    looks = read_materials(tree, buffers, folder)
    labels = unique_names(str(m.get("name") or f"mesh_{k}") for k, m in enumerate(tree["meshes"]))
    unique = unique_names(node_name(node, k, labels) for k, node in enumerate(tree.get("nodes", [])))
    meshes: dict[int, Mesh | None] = {}
    placed, home, scene = [], [], dict[int, np.ndarray]()
    for index, T, path in _placed(name, tree):
        scene[index] = T
        node = tree["nodes"][index]
        number = node.get("mesh")
        if number is None:
            continue
        source = item(tree["meshes"], number)
        if number not in meshes:
            meshes[number] = _mesh(folder, f"mesh {labels[number]!r}", source, buffers, looks)
        mesh = meshes[number]
        if mesh is None:
            continue
        for what in _ignored(node, source):
            folder.warn(f"a mesh has {what}, which are ignored")
        if not np.isfinite(T).all():
            raise InputError(f"{name}: node {index} has a transform that is not finite")
        chain = tuple(unique[k] for k in path)
        nodes = (Node(node_name(node, index, labels), labels[number], path=chain if len(chain) > 1 else ()),)
        placed.append(replace(mesh.transformed(T), nodes=nodes))
        home.append(index)
    if not placed:
        modes = {p.get("mode", TRIANGLES) for m in tree["meshes"] for p in m["primitives"]}
        only = sorted({LEFT_OUT[m] for m in modes if m in LEFT_OUT})
        contents = f"only {' and '.join(only)}" if only else "no mesh in its scene"
        raise InputError(f"{name}: found {contents}; a scene with at least one triangle is needed")
    joined = join(placed)
    if folder.joints and tree.keys() & {"animations", "extensions"}:
        return resolve(GLTF_JOINTS)(joined, home, tree, scene, buffers, folder)
    return joined


def node_name(node: dict[str, Any], number: int, labels: list[str]) -> str:
    """Return the name of a node, else that of its mesh. labels: those of all meshes."""
    mesh = node.get("mesh")
    return str(node.get("name") or (f"node_{number}" if mesh is None else item(labels, mesh)))


def _ignored(node: dict[str, Any], mesh: dict[str, Any]) -> Iterator[str]:
    """Yield what moves or repeats a mesh and is not read."""
    if "skin" in node:
        yield "bones (a skin)"
    if any("targets" in p for p in mesh["primitives"]):
        yield "morph targets"
    if "EXT_mesh_gpu_instancing" in node.get("extensions", {}):
        yield "instances (EXT_mesh_gpu_instancing)"


def _placed(name: str, tree: dict[str, Any]) -> Iterator[tuple[int, np.ndarray, tuple[int, ...]]]:
    """Yield nodes of the scene with their transforms to it and the nodes down to them.

    Parents come first, siblings in reverse (face labels rely on it).
    """
    nodes, scenes = tree.get("nodes", []), tree.get("scenes", [])
    if scenes:
        roots = scenes[tree.get("scene", 0)].get("nodes", [])
    else:
        children = {c for node in nodes for c in node.get("children", [])}
        roots = [k for k in range(len(nodes)) if k not in children]
    waiting: list[tuple[int, np.ndarray, tuple[int, ...]]] = [(index, np.eye(4), (index,)) for index in roots]
    seen = set()
    while waiting:
        index, T_parent, path = waiting.pop()
        if index in seen or not 0 <= index < len(nodes):
            raise InputError(f"{name}: node {index} has two parents or is none of {len(nodes)}; valid is a tree of nodes")
        seen.add(index)
        T = T_parent @ _local(nodes[index])
        yield index, T, path
        waiting += [(child, T, (*path, child)) for child in nodes[index].get("children", [])]


def _local(node: dict[str, Any]) -> np.ndarray:
    if "matrix" in node:
        return np.array(node["matrix"], np.float64).reshape(4, 4).T
    T = np.eye(4)
    x, y, z, w = np.array(node.get("rotation", (0, 0, 0, 1)), np.float64)
    n = x * x + y * y + z * z + w * w
    s = 2 / n if n > 0 else 0.0
    R = np.array(
        [
            [1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
            [s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)],
            [s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)],
        ]
    )
    T[:3, :3] = R * np.array(node.get("scale", (1, 1, 1)), np.float64).reshape(3)
    T[:3, 3] = node.get("translation", (0, 0, 0))
    return T


def _mesh(folder: Folder, label: str, mesh: dict[str, Any], buffers: Buffers, looks: list[GltfMaterial]) -> Mesh | None:
    """Return the triangles of a mesh's primitives as one node; None if there are none."""
    where = f"{folder.path.name}, {label}"
    primitives = [p for p in mesh["primitives"] if p.get("mode", TRIANGLES) not in LEFT_OUT]
    meshes = [made for p in primitives if (made := _primitive(where, p, buffers, looks)) is not None]
    if len(meshes) < len(primitives):
        folder.warn(f"{label} has a primitive without triangles, which is left out")
    if not meshes:
        return None
    joined = join(meshes)
    return replace(joined, face_node=np.zeros(len(joined.faces), np.int64), nodes=joined.nodes[:1])


def _display(color: np.ndarray) -> np.ndarray:
    """Convert COLOR_0 from linear to display values 0..1; alpha is unchanged."""
    full = 1.0 if color.dtype.kind == "f" else float(np.iinfo(color.dtype).max)
    values = np.nan_to_num(color.astype(np.float64) / full, nan=1.0)
    return np.c_[to_srgb(values[:, :3]), values[:, 3:]]


def _primitive(where: str, p: dict[str, Any], buffers: Buffers, looks: list[GltfMaterial]) -> Mesh | None:
    """Return the triangles of a primitive; None if there are none."""
    attributes = p["attributes"]
    if "POSITION" not in attributes:
        raise InputError(f"{where}: found a primitive without positions, which triangles need")
    vertices = buffers.array(attributes["POSITION"])
    index = buffers.array(p["indices"])[:, 0].astype(np.int64) if "indices" in p else np.arange(len(vertices))
    faces = _faces(where, p.get("mode", TRIANGLES), index)
    if not len(faces):
        return None
    look = looks[p["material"]] if "material" in p else GltfMaterial(None)

    def corners(key: str) -> np.ndarray | None:
        values = buffers.array(attributes[key]) if key in attributes else None
        if values is not None and len(values) != len(vertices):
            raise InputError(f"{where}: {key} has {len(values)} elements; valid are {len(vertices)}, as many as positions")
        return values

    uv, more_uv = look.coordinates(corners)
    color, normal = corners("COLOR_0"), corners("NORMAL")
    normal = None if normal is None else unit(normal)
    mesh = simple_mesh(where, "mesh", vertices, faces, look.material)
    return replace(
        mesh,
        corner_uv=None if uv is None else uv[faces],
        corner_more_uv=None if more_uv is None else more_uv[faces],
        corner_color=None if color is None else rgba(_display(color))[faces],
        corner_normal=None if normal is None else normal[faces],
    )


def _faces(where: str, mode: int, index: np.ndarray) -> np.ndarray:
    match mode:
        case 4:
            if len(index) % 3:
                raise InputError(f"{where}: found {len(index)} indices; triangles need a multiple of 3")
            return index.reshape(-1, 3)
        case 5:
            faces = np.stack([index[:-2], index[1:-1], index[2:]], 1)
            faces[1::2] = faces[1::2][:, [0, 2, 1]]
            return faces[(faces != np.roll(faces, 1, axis=1)).all(1)]  # repeated indices only lead to the next strip
        case 6:
            return np.stack([index[1:-1], index[2:], np.full(max(len(index) - 2, 0), index[0])], 1)
        case _:
            raise InputError(f"{where}: found the primitive mode {mode}; valid are 4, 5 and 6 (triangles)")
