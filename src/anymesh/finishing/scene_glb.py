"""Exchange of meshes with external models as GLB: one node and one geometry per mesh, without node transforms."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.errors import InputError
from anymesh.export.glb import INDICES, VERTICES, GlbBuffer
from anymesh.formats.gltf.scene import read_gltf
from anymesh.loading.files import Folder
from anymesh.types import Mesh
from anymesh.types.triangles import unique_rows

Y_UP = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])  # from Z up
SAMPLER = {"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497}


def scene_glb(meshes: Mapping[str, Mesh], T_scene_asset: Float[np.ndarray, "4 4"]) -> bytes:
    """Encode named meshes, moved by a transform.

    Each has one primitive, with faces in their order, and the first material's base colour if the mesh has texture coordinates.
    Readers that make a geometry of each primitive thus find one geometry per part.
    """
    buffer = GlbBuffer()
    entries: dict[str, list[Any]] = {"nodes": [], "meshes": [], "materials": [], "textures": [], "images": []}
    for name, mesh in meshes.items():
        moved = mesh.transformed(T_scene_asset)
        primitive = _primitive(moved, buffer)
        if moved.corner_uv is not None and moved.materials:
            primitive["material"] = len(entries["materials"])
            entries["materials"].append(_material(moved, buffer, entries))
        entries["nodes"].append({"name": name, "mesh": len(entries["meshes"])})
        entries["meshes"].append({"name": name, "primitives": [primitive]})
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(entries["nodes"])))}],
        **{key: value for key, value in entries.items() if value},
    }
    return buffer.encode(document | ({"samplers": [SAMPLER]} if entries["textures"] else {}))


def read_scene(glb: bytes, name: str) -> Mesh:
    """Read a returned GLB, in its own coordinates; textures in other files are left out, since it has no folder.

    Raise InputError if it is not a usable mesh.
    """
    try:
        return read_gltf(glb, Folder(Path("of-no-folder") / name))
    except InputError:
        raise
    except Exception as error:  # the reader raises many types of errors for a broken file
        raise InputError(f"{name} is not a readable GLB ({type(error).__name__})") from None


def _primitive(mesh: Mesh, buffer: GlbBuffer) -> dict[str, Any]:
    corners = mesh.faces.reshape(-1)
    columns = [corners.astype(np.uint64)]
    if mesh.corner_uv is not None:
        uv = np.ascontiguousarray(mesh.corner_uv.reshape(-1, 2)) + np.float32(0)
        columns += [c.astype(np.uint64) for c in uv.view(np.uint32).T]
    first, inverse = unique_rows(columns)
    positions = mesh.vertices[corners[first]].astype(np.float32)
    attributes = {"POSITION": buffer.accessor(positions, target=VERTICES, bounds=True)}
    if mesh.corner_uv is not None:
        flipped = np.stack([uv[first, 0], 1 - uv[first, 1]], 1).astype(np.float32)
        attributes["TEXCOORD_0"] = buffer.accessor(flipped, target=VERTICES)
    return {"attributes": attributes, "indices": buffer.accessor(inverse.astype(np.uint32), target=INDICES)}


def _material(mesh: Mesh, buffer: GlbBuffer, entries: dict[str, list[Any]]) -> dict[str, Any]:
    material = mesh.materials[0]
    pbr: dict[str, Any] = {
        "baseColorFactor": [float(c) for c in material.base_color],
        "metallicFactor": float(material.metallic),
        "roughnessFactor": float(material.roughness),
    }
    texture = material.textures.get("base_color")
    if texture is not None:
        entries["images"].append({"mimeType": texture.mime, "bufferView": buffer.view(texture.data)})
        entries["textures"].append({"sampler": 0, "source": len(entries["images"]) - 1})
        pbr["baseColorTexture"] = {"index": len(entries["textures"]) - 1}
    return {"name": material.name, "pbrMetallicRoughness": pbr}
