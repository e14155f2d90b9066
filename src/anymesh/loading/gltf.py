"""glTF 2.0, binary or with files beside it: every placed node with triangles; instances are copied."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from jaxtyping import Float32

from anymesh.errors import InputError
from anymesh.loading.files import Folder, picture, picture_file, warn_unreadable
from anymesh.loading.gltf_data import Buffers, from_uri, item, parse_json, split_glb
from anymesh.loading.join import join, rgba, simple_mesh, unique_names, unit
from anymesh.types import Material, Mesh, Node, Texture
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
    meshes: dict[int, Mesh | None] = {}
    placed = []
    for index, T in _placed(name, tree):
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
        nodes = (Node(str(node.get("name") or labels[number]), labels[number]),)
        placed.append(replace(mesh.transformed(T), nodes=nodes))
    if not placed:
        modes = {p.get("mode", TRIANGLES) for m in tree["meshes"] for p in m["primitives"]}
        only = sorted({LEFT_OUT[m] for m in modes if m in LEFT_OUT})
        contents = f"only {' and '.join(only)}" if only else "no mesh in its scene"
        raise InputError(f"{name}: found {contents}; a scene with at least one triangle is needed")
    return join(placed)


def _ignored(node: dict[str, Any], mesh: dict[str, Any]) -> Iterator[str]:
    """Yield what moves or repeats a mesh and is not read."""
    if "skin" in node:
        yield "bones (a skin)"
    if any("targets" in p for p in mesh["primitives"]):
        yield "morph targets"
    if "EXT_mesh_gpu_instancing" in node.get("extensions", {}):
        yield "instances (EXT_mesh_gpu_instancing)"


def _placed(name: str, tree: dict[str, Any]) -> Iterator[tuple[int, np.ndarray]]:
    """Yield nodes of the scene with their transforms to it: parents first, siblings in reverse (face labels rely on it)."""
    nodes, scenes = tree.get("nodes", []), tree.get("scenes", [])
    if scenes:
        roots = scenes[tree.get("scene", 0)].get("nodes", [])
    else:
        children = {c for node in nodes for c in node.get("children", [])}
        roots = [k for k in range(len(nodes)) if k not in children]
    waiting = [(index, np.eye(4)) for index in roots]
    seen = set()
    while waiting:
        index, T_parent = waiting.pop()
        if index in seen or not 0 <= index < len(nodes):
            raise InputError(f"{name}: node {index} has two parents or is none of {len(nodes)}; valid is a tree of nodes")
        seen.add(index)
        T = T_parent @ _local(nodes[index])
        yield index, T
        waiting += [(child, T) for child in nodes[index].get("children", [])]


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
    look = looks[p["material"]] if "material" in p else None

    def corners(key: str) -> np.ndarray | None:
        values = buffers.array(attributes[key]) if key in attributes else None
        if values is not None and len(values) != len(vertices):
            raise InputError(f"{where}: {key} has {len(values)} elements; valid are {len(vertices)}, as many as positions")
        return values

    uv = corners(f"TEXCOORD_{look.uv_set if look else 0}")
    color, normal = corners("COLOR_0"), corners("NORMAL")
    normal = None if normal is None else unit(normal)
    mesh = simple_mesh(where, "mesh", vertices, faces, look.material if look else None)
    return replace(
        mesh,
        corner_uv=None if uv is None else (look or GltfMaterial(None)).place(uv)[faces],  # ty: ignore[invalid-argument-type]
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


@dataclass(frozen=True)
class GltfMaterial:
    """A material, and the texture coordinates of its pictures."""

    material: Material
    uv_set: int = 0
    transform: dict[str, Any] | None = None  # KHR_texture_transform of the base colour

    def place(self, uv: np.ndarray) -> Float32[np.ndarray, "n 2"]:
        """Return texture coordinates with the picture's transform applied and v upwards as in OBJ."""
        uv = np.nan_to_num(np.asarray(uv, np.float64)[:, :2])
        if self.transform:
            angle = float(self.transform.get("rotation", 0.0))
            c, s = np.cos(angle), np.sin(angle)
            uv = (uv * self.transform.get("scale", (1, 1))) @ np.array([[c, -s], [s, c]]) + self.transform.get("offset", (0, 0))
        return np.stack([uv[:, 0], 1 - uv[:, 1]], 1).astype(np.float32)


def read_materials(tree: dict[str, Any], buffers: Buffers, folder: Folder) -> list[GltfMaterial]:
    """Return the materials in the order of the file; a missing or broken picture gives a warning."""
    images = [_image(k, image, buffers, folder) for k, image in enumerate(tree.get("images", []))]
    return [_material(k, m, tree.get("textures", []), images) for k, m in enumerate(tree.get("materials", []))]


def _image(number: int, image: dict[str, Any], buffers: Buffers, folder: Folder) -> Texture | None:
    uri, name = image.get("uri"), str(image.get("name") or f"image_{number}")
    if uri is not None and not uri.startswith("data:"):
        return picture_file(folder, uri)
    try:
        data = buffers.view(image["bufferView"]) if uri is None else from_uri(uri, folder)
    except (InputError, LookupError, TypeError) as error:  # a picture is optional
        warn_unreadable(folder, name, error)
        return None
    return picture(folder, data, name)


def _material(number: int, m: dict[str, Any], textures: list[dict[str, Any]], images: list[Texture | None]) -> GltfMaterial:
    pbr, extensions = m.get("pbrMetallicRoughness", {}), m.get("extensions", {})
    color, base = pbr.get("baseColorFactor"), pbr.get("baseColorTexture")
    metallic, roughness = pbr.get("metallicFactor", 1.0), pbr.get("roughnessFactor", 1.0)
    old = extensions.get("KHR_materials_pbrSpecularGlossiness")
    if old is not None:  # an archived extension; its colour and gloss have counterparts
        color, base = old.get("diffuseFactor", color), old.get("diffuseTexture", base)
        metallic, roughness = 0.0, 1.0 - float(old.get("glossinessFactor", 1.0))
    named = {
        "base_color": base,
        "metallic_roughness": pbr.get("metallicRoughnessTexture"),
        "normal": m.get("normalTexture"),
        "occlusion": m.get("occlusionTexture"),
        "emissive": m.get("emissiveTexture"),
    }
    slot_textures = {slot: _texture(info, textures, images) for slot, info in named.items() if info is not None}
    mode, cutoff = m.get("alphaMode", "OPAQUE"), float(m.get("alphaCutoff", 0.5))
    material = Material(
        name=str(m.get("name") or f"material_{number}"),
        base_color=_factor(color, 4),
        metallic=_factor([metallic], 1)[0],
        roughness=_factor([roughness], 1)[0],
        emissive=_factor(m.get("emissiveFactor", (0.0, 0.0, 0.0)), 3),
        double_sided=bool(m.get("doubleSided", False)),
        alpha_mode=mode if mode in ("OPAQUE", "MASK", "BLEND") else "OPAQUE",
        alpha_cutoff=cutoff if np.isfinite(cutoff) else 0.5,
        textures={slot: t for slot, t in slot_textures.items() if t is not None},
    )
    main = base or next((info for info in named.values() if info is not None), {})
    moved = main.get("extensions", {}).get("KHR_texture_transform")
    return GltfMaterial(material, (moved or {}).get("texCoord", main.get("texCoord", 0)), moved)


def _texture(info: dict[str, Any], textures: list[dict[str, Any]], images: list[Texture | None]) -> Texture | None:
    texture = textures[info["index"]]
    extended = [e["source"] for e in texture.get("extensions", {}).values() if isinstance(e, dict) and "source" in e]
    sources = [texture["source"]] if "source" in texture else []
    return next((images[s] for s in (*extended, *sources) if images[s] is not None), None)


def _factor(values: Any, width: int) -> Any:
    """Return numbers clipped to 0..1; 1 if there are none."""
    if values is None:
        return (1.0,) * width
    v = np.nan_to_num(np.asarray(values, np.float64).reshape(width), nan=1.0)
    return tuple(float(x) for x in np.clip(v, 0, 1))
