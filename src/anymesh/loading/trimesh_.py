"""Mesh files by trimesh: a scene to our Mesh, with nothing merged, dropped or reordered."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.errors import InputError
from anymesh.types import Material, Mesh, Node, Texture

OPTIONS: dict[str, dict[str, Any]] = {".obj": {"split_objects": True, "group_material": True}}


def read_scene(path: Path) -> tuple[Mesh, tuple[str, ...]]:
    """The whole scene in file coordinates, and warnings. Raises InputError."""
    import trimesh
    from trimesh.resolvers import FilePathResolver

    suffix = path.suffix.lower()
    try:
        scene = trimesh.load_scene(
            str(path), file_type=suffix[1:], resolver=FilePathResolver(str(path.resolve())), process=False,
            **OPTIONS.get(suffix, {}),
        )  # fmt: skip
    except InputError:
        raise
    except Exception as error:  # whatever a broken file makes the reader raise is one thing to the user
        raise InputError(f"{path.name} cannot be read as {suffix[1:].upper()}: {type(error).__name__}: {error}") from None
    placed = []
    for node in scene.graph.nodes_geometry:
        T, name = scene.graph[node]
        geometry = scene.geometry[name]
        if isinstance(geometry, trimesh.Trimesh) and len(geometry.faces):
            placed.append((str(node), str(name), np.asarray(T, float), geometry))
    if not placed:
        kinds = sorted({type(g).__name__ for g in scene.geometry.values()})
        found = f"only {', '.join(kinds)}" if kinds and kinds != ["Trimesh"] else "nothing"
        raise InputError(f"{path.name}: found {found}; a mesh with at least one triangle is needed")
    return _join(path.name, placed)


def _join(name: str, placed: list[tuple[str, str, np.ndarray, Any]]) -> tuple[Mesh, tuple[str, ...]]:
    materials: list[Material] = []
    number: dict[int, int] = {}
    meshes = []
    for k, (node, geometry_name, T, geometry) in enumerate(placed):
        vertices = np.asarray(geometry.vertices, np.float64)
        if not np.isfinite(vertices[np.asarray(geometry.faces)]).all() or not np.isfinite(T).all():
            raise InputError(f"{name}: node {node!r} has vertices that are not finite (NaN or infinite)")
        if np.asarray(geometry.faces).min() < 0 or np.asarray(geometry.faces).max() >= len(vertices):
            raise InputError(f"{name}: node {node!r} has face indices outside its {len(vertices)} vertices")
        vertices = np.where(np.isfinite(vertices), vertices, 0.0)
        meshes.append(_one(k, node, geometry_name, vertices, geometry, materials, number).transformed(T))
    return _concatenate(meshes, tuple(materials)), ()


def _one(
    k: int,
    node: str,
    geometry_name: str,
    vertices: np.ndarray,
    geometry: Any,
    materials: list[Material],
    number: dict[int, int],
) -> Mesh:
    faces = np.asarray(geometry.faces, np.int64)
    visual = geometry.visual
    uv = color = None
    face_material = np.full(len(faces), -1, np.int64)
    if visual.kind == "texture":
        raw = getattr(visual, "uv", None)
        if raw is not None and len(raw) == len(vertices):
            uv = np.nan_to_num(np.asarray(raw, np.float32)[:, :2])[faces]
        face_material[:] = _material(visual.material, materials, number)
        attribute = (visual.vertex_attributes or {}).get("color") if hasattr(visual, "vertex_attributes") else None
        if attribute is not None and len(attribute) == len(vertices):
            color = _rgba(np.asarray(attribute))[faces]
    elif visual.kind == "vertex":
        color = np.asarray(visual.vertex_colors, np.uint8)[faces]
    elif visual.kind == "face":
        color = np.repeat(np.asarray(visual.face_colors, np.uint8)[:, None], 3, 1)
    normals = geometry._cache.cache.get("vertex_normals")
    corner_normal = None
    if normals is not None and len(normals) == len(vertices) and np.isfinite(normals).all():
        corner_normal = np.asarray(normals, np.float32)[faces]
    return Mesh(
        vertices, faces, np.full(len(faces), k, np.int64), (Node(node, geometry_name),), face_material,
        corner_uv=uv, corner_color=color, corner_normal=corner_normal,
    )  # fmt: skip


def _rgba(values: np.ndarray) -> np.ndarray:
    if values.dtype.kind == "f":
        values = np.clip(values * 255 + 0.5, 0, 255)
    elif values.dtype == np.uint16:
        values = values / 257
    values = values.astype(np.uint8)
    if values.shape[1] == 3:
        values = np.c_[values, np.full(len(values), 255, np.uint8)]
    return values[:, :4]


def _material(material: Any, materials: list[Material], number: dict[int, int]) -> int:
    """The number of a material, ours made from trimesh's when it is first met."""
    if material is None:
        return -1
    if id(material) not in number:
        number[id(material)] = len(materials)
        materials.append(_convert(material))
    return number[id(material)]


def _convert(material: Any) -> Material:
    name = str(getattr(material, "name", None) or "material")
    if hasattr(material, "baseColorFactor"):
        slots = {
            "base_color": material.baseColorTexture,
            "metallic_roughness": material.metallicRoughnessTexture,
            "normal": material.normalTexture,
            "occlusion": material.occlusionTexture,
            "emissive": material.emissiveTexture,
        }
        factor = material.baseColorFactor
        color = _factor(factor) if factor is not None else (1.0, 1.0, 1.0, 1.0)
        emissive = material.emissiveFactor
        return Material(
            name=name,
            base_color=color,
            metallic=_number(material.metallicFactor, 1.0 if material.metallicRoughnessTexture is not None else 0.0),
            roughness=_number(material.roughnessFactor, 1.0),
            emissive=_factor(emissive)[:3] if emissive is not None else (0.0, 0.0, 0.0),
            double_sided=bool(material.doubleSided),
            alpha_mode=str(material.alphaMode or "OPAQUE"),
            alpha_cutoff=_number(material.alphaCutoff, 0.5),
            textures={slot: t for slot, image in slots.items() if (t := _texture(image)) is not None},
        )
    image = getattr(material, "image", None)
    texture = _texture(image)
    diffuse = getattr(material, "diffuse", None)
    color = _factor(diffuse) if diffuse is not None else (0.7, 0.7, 0.7, 1.0)
    if texture is not None and max(color[:3]) < 0.02:
        color = (1.0, 1.0, 1.0, color[3])  # a picture times black would be black
    return Material(name=name, base_color=color, textures={"base_color": texture} if texture else {})


def _factor(value: Any) -> tuple[float, float, float, float]:
    v = np.asarray(value).reshape(-1)
    rgba = v.astype(np.float64) / (255.0 if v.dtype.kind in "ui" else 1.0)
    rgba = np.r_[rgba, np.ones(4)][:4] if len(rgba) < 4 else rgba[:4]
    r, g, b, a = (float(x) for x in np.clip(np.nan_to_num(rgba, nan=1.0), 0, 1))
    return (r, g, b, a)


def _number(value: Any, default: float) -> float:
    return default if value is None else float(value)


def _texture(image: Any) -> Texture | None:
    """A picture as the bytes of a PNG, or of the JPEG that it came from when that can be kept."""
    if image is None:
        return None
    buffer = io.BytesIO()
    plain = image if image.mode in ("RGB", "RGBA", "L", "LA", "P", "1", "I;16") else image.convert("RGBA")
    if getattr(image, "format", None) == "JPEG" and plain.mode in ("RGB", "L"):
        plain.save(buffer, "JPEG", quality=95, subsampling=0)
        return Texture(buffer.getvalue(), "image/jpeg", _stem(image))
    plain.save(buffer, "PNG")
    return Texture(buffer.getvalue(), "image/png", _stem(image))


def _stem(image: Any) -> str:
    return Path(str(getattr(image, "filename", "") or "")).stem


def _concatenate(meshes: list[Mesh], materials: tuple[Material, ...]) -> Mesh:
    offsets = np.cumsum([0] + [len(m.vertices) for m in meshes[:-1]])

    def corners(attribute: str, width: int, dtype: type, fill: float) -> np.ndarray | None:
        values = [getattr(m, attribute) for m in meshes]
        if all(v is None for v in values):
            return None
        filled = [
            v if v is not None else np.full((len(m.faces), 3, width), fill, dtype) for v, m in zip(values, meshes, strict=True)
        ]
        return np.concatenate(filled)

    with_normals = all(m.corner_normal is not None for m in meshes)
    return Mesh(
        np.concatenate([m.vertices for m in meshes]),
        np.concatenate([m.faces + o for m, o in zip(meshes, offsets, strict=True)]),
        np.concatenate([m.face_node for m in meshes]),
        tuple(m.nodes[0] for m in meshes),
        np.concatenate([m.face_material for m in meshes]),
        materials,
        corners("corner_uv", 2, np.float32, 0),
        corners("corner_color", 4, np.uint8, 255),
        np.concatenate([m.corner_normal for m in meshes]) if with_normals else None,
    )
