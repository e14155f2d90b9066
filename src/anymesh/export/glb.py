"""GLB: one animated glTF 2.0 file, Y up, with a node per link in the kinematic tree, materials and textures inside."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

import anymesh
from anymesh.export.animation import tracks
from anymesh.export.glb_buffer import INDICES, VERTICES, GlbBuffer
from anymesh.export.links import Link, Primitive
from anymesh.export.settings import ExportConfig
from anymesh.names import legal_names
from anymesh.types import Asset, Joint, Material, Texture
from anymesh.types.mesh import to_linear

Y_UP = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]  # rotates +Z to +Y
DEFAULT_SAMPLER = {"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497}
TEXTURE_KEYS = {"normal": "normalTexture", "occlusion": "occlusionTexture", "emissive": "emissiveTexture"}
PBR_KEYS = {"base_color": "baseColorTexture", "metallic_roughness": "metallicRoughnessTexture"}


def glb_bytes(asset: Asset, links: Sequence[Link], config: ExportConfig) -> bytes:
    """Return the GLB of an asset with legal names.

    Nodes are link frames under a root node that rotates Z up to Y up.
    """
    buffer = GlbBuffer()
    looks = _Materials(asset, buffer)
    meshes = [{"name": link.name, "primitives": [looks.primitive(p) for p in link.primitives]} for link in links]
    document: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": f"articulate-anymesh {anymesh.__version__}"},
        "scene": 0,
        "scenes": [{"name": asset.name, "nodes": [0]}],
        "nodes": _nodes(asset, links),
        "meshes": meshes,
        **looks.document(),
    }
    animation = _animation(asset, links, buffer, config)
    if animation["channels"]:
        document["animations"] = [animation]
    return buffer.encode(document)


def _nodes(asset: Asset, links: Sequence[Link]) -> list[dict[str, Any]]:
    """Return the nodes: node 0 rotates the asset, node i + 1 is link i."""
    number = {link.name: i + 1 for i, link in enumerate(links)}
    origin = {link.name: link.origin for link in links}
    root_name = legal_names([*number, asset.name])[-1]
    nodes: list[dict[str, Any]] = [{"name": root_name, "rotation": Y_UP, "children": [1]}]
    for index, link in enumerate(links):
        node: dict[str, Any] = {"name": link.name, "mesh": index}
        if link.joint is not None:
            shift = link.origin - origin[link.joint.parent]
            node["translation"] = [float(v) + 0.0 for v in shift.astype(np.float32)]
        node["extras"] = {"label": link.part.label} | ({} if link.joint is None else {"joint": _joint(link.joint)})
        children = [number[j.child] for j in asset.joints if j.parent == link.name]
        if children:
            node["children"] = children
        nodes.append(node)
    return nodes


def _joint(joint: Joint) -> dict[str, Any]:
    """Return the joint's data that glTF cannot express; the axis is in the node's frame, which the root node rotates."""
    return {
        "name": joint.name,
        "type": str(joint.type),
        "axis": [float(v) for v in joint.axis],
        "limits": None if joint.limits is None else [float(v) for v in joint.limits],
    }


def _animation(asset: Asset, links: Sequence[Link], buffer: GlbBuffer, config: ExportConfig) -> dict[str, Any]:
    number = {link.name: i + 1 for i, link in enumerate(links)}
    origin = {link.name: link.origin for link in links}
    samplers, channels = [], []
    for track in tracks(asset.joints, config):
        rest = origin[track.joint.child] - origin[track.joint.parent]
        path, values = track.values(rest)
        times = buffer.accessor(track.times, bounds=True)
        samplers.append({"input": times, "interpolation": "LINEAR", "output": buffer.accessor(values)})
        target = {"node": number[track.joint.child], "path": path}
        channels.append({"sampler": len(samplers) - 1, "target": target})
    return {"name": "articulation", "channels": channels, "samplers": samplers}


class _Materials:
    """Materials, textures and images in use, each written once on first use."""

    def __init__(self, asset: Asset, buffer: GlbBuffer) -> None:
        self._mesh, self._buffer = asset.mesh, buffer
        self._materials: dict[int, int] = {}
        self._textures: dict[tuple[bytes, str], int] = {}
        self._entries: dict[str, list[dict[str, Any]]] = {"materials": [], "textures": [], "images": []}

    def primitive(self, p: Primitive) -> dict[str, Any]:
        buffer = self._buffer
        attributes = {"POSITION": buffer.accessor(p.positions.astype(np.float32), target=VERTICES, bounds=True)}
        if p.normals is not None:
            attributes["NORMAL"] = buffer.accessor(p.normals, target=VERTICES)
        if p.uv is not None:
            flipped = np.stack([p.uv[:, 0], 1 - p.uv[:, 1]], 1).astype(np.float32)
            attributes["TEXCOORD_0"] = buffer.accessor(flipped, target=VERTICES)
        if p.colors is not None:
            color = np.c_[to_linear(p.colors[:, :3] / 255), p.colors[:, 3:] / 255]  # bytes would cause banding in dark colours
            color = np.rint(color * 65535).astype(np.uint16)
            attributes["COLOR_0"] = buffer.accessor(color, target=VERTICES, normalized=True)
        kind = np.uint16 if len(p.positions) < 0xFFFF else np.uint32
        indices = buffer.accessor(p.triangles.reshape(-1).astype(kind), target=INDICES)
        primitive: dict[str, Any] = {"attributes": attributes, "indices": indices}
        if p.material >= 0:
            primitive["material"] = self._material(p.material)
        return primitive

    def document(self) -> dict[str, Any]:
        """Return the top-level entries, without empty ones (glTF forbids them)."""
        entries: dict[str, Any] = {key: value for key, value in self._entries.items() if value}
        return entries | ({"samplers": [DEFAULT_SAMPLER]} if self._textures else {})

    def _material(self, index: int) -> int:
        if index not in self._materials:
            self._materials[index] = len(self._materials)
            self._entries["materials"].append(self._describe(self._mesh.materials[index]))
        return self._materials[index]

    def _describe(self, m: Material) -> dict[str, Any]:
        def unit(value: float) -> float:
            return float(min(max(value, 0.0), 1.0))

        pbr: dict[str, Any] = {
            "baseColorFactor": [unit(c) for c in m.base_color],
            "metallicFactor": unit(m.metallic),
            "roughnessFactor": unit(m.roughness),
        }
        material: dict[str, Any] = {"name": m.name, "pbrMetallicRoughness": pbr}
        if any(m.emissive):
            material["emissiveFactor"] = [unit(c) for c in m.emissive]
        if m.double_sided:
            material["doubleSided"] = True
        if m.alpha_mode != "OPAQUE":
            material["alphaMode"] = m.alpha_mode
        if m.alpha_mode == "MASK":
            material["alphaCutoff"] = float(m.alpha_cutoff)
        if self._mesh.corner_uv is not None:
            for keys, place in ((PBR_KEYS, pbr), (TEXTURE_KEYS, material)):
                for slot, key in keys.items():
                    if slot in m.textures:
                        place[key] = {"index": self._texture(m.textures[slot])}
        return material

    def _texture(self, texture: Texture) -> int:
        key = (texture.data, texture.mime)
        if key not in self._textures:
            self._textures[key] = len(self._textures)
            image = {"mimeType": texture.mime, "bufferView": self._buffer.view(texture.data)}
            self._entries["images"].append(({"name": texture.name} if texture.name else {}) | image)
            self._entries["textures"].append({"sampler": 0, "source": self._textures[key]})
        return self._textures[key]
