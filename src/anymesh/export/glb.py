"""GLB: one animated glTF 2.0 file, Y up, with a node per link in the kinematic tree, materials and textures inside.

The animation moves all joints at once through their whole range and back, in a loop.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
from jaxtyping import Float, Float32

import anymesh
from anymesh.entry_points import LED_TRACKS, resolve
from anymesh.export.links import Link, Primitive
from anymesh.export.model import ExportConfig
from anymesh.geometry.kinematics import joint_motion
from anymesh.names import legal_names
from anymesh.types import Asset, Brief, Joint, JointType, Material, Texture
from anymesh.types.mesh import CLAMP, MIRROR, REPEAT, to_linear

FLOAT, UBYTE, USHORT, UINT = 5126, 5121, 5123, 5125
VERTICES, INDICES = 34962, 34963  # bufferView targets
KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
COMPONENTS = {"float32": FLOAT, "uint8": UBYTE, "uint16": USHORT, "uint32": UINT}
Y_UP = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]  # rotates +Z to +Y
WRAP = {REPEAT: 10497, MIRROR: 33648, CLAMP: 33071}
LIFT = 0.25  # of the diagonal, by which the animation lifts what is free; an estimate
NEAREST, LINEAR, MIPMAPS = 9728, 9729, 9987
UNLIT, STRONG = "KHR_materials_unlit", "KHR_materials_emissive_strength"
TEXTURE_KEYS = {"normal": "normalTexture", "occlusion": "occlusionTexture", "emissive": "emissiveTexture"}
STRENGTHS = {"normal": "scale", "occlusion": "strength"}
PBR_KEYS = {"base_color": "baseColorTexture", "metallic_roughness": "metallicRoughnessTexture"}


def glb_bytes(asset: Asset, links: Sequence[Link], config: ExportConfig, extend: Extend | None = None) -> bytes:
    """Return the GLB of an asset with legal names. Nodes are link frames under a root node that rotates Z up to Y up.

    extend: adds to the document.
    """
    buffer = GlbBuffer()
    looks = _Materials(asset, buffer)
    meshes = [{"name": link.name, "primitives": [looks.primitive(p) for p in link.primitives]} for link in links]
    stated = asset.source.credits
    credits = {"copyright": stated["credit"], "extras": dict(stated)} if stated else {}  # as Sketchfab has them
    document: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": f"articulate-anymesh {anymesh.__version__}", **credits},
        "scene": 0,
        "scenes": [{"name": asset.name, "nodes": [0]}],
        "nodes": _nodes(asset, links),
        "meshes": meshes,
        **looks.document(),
    }
    animation = _animation(asset, links, buffer, config)
    if animation["channels"]:
        document["animations"] = [animation]
    if extend is not None:
        extend(document, buffer)
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
        **({"pitch": joint.pitch} if joint.pitch else {}),
        **({"mimic": asdict(joint.mimic)} if joint.mimic else {}),
    }


def _animation(asset: Asset, links: Sequence[Link], buffer: GlbBuffer, config: ExportConfig) -> dict[str, Any]:
    number = {link.name: i + 1 for i, link in enumerate(links)}
    origin = {link.name: link.origin for link in links}
    samplers, channels = [], []
    for track in tracks(asset, config):
        rest = origin[track.joint.child] - origin[track.joint.parent]
        times = buffer.accessor(track.times, bounds=True)
        for path, values in track.values(rest).items():
            samplers.append({"input": times, "interpolation": "LINEAR", "output": buffer.accessor(values)})
            target = {"node": number[track.joint.child], "path": path}
            channels.append({"sampler": len(samplers) - 1, "target": target})
    return {"name": "articulation", "channels": channels, "samplers": samplers}


class _Materials:
    """Materials, textures and images in use, each written once on first use."""

    def __init__(self, asset: Asset, buffer: GlbBuffer) -> None:
        self._mesh, self._buffer = asset.mesh, buffer
        self._materials: dict[int, int] = {}
        self._images: dict[tuple[bytes, str], int] = {}
        self._extensions: set[str] = set()
        self._entries: dict[str, list[Any]] = {"materials": [], "textures": [], "images": [], "samplers": []}

    def primitive(self, p: Primitive) -> dict[str, Any]:
        buffer = self._buffer
        attributes = {"POSITION": buffer.accessor(p.positions.astype(np.float32), target=VERTICES, bounds=True)}
        if p.normals is not None:
            attributes["NORMAL"] = buffer.accessor(p.normals, target=VERTICES)
        if p.uv is not None:
            flipped = np.stack([p.uv[:, 0], 1 - p.uv[:, 1]], 1).astype(np.float32)
            attributes["TEXCOORD_0"] = buffer.accessor(flipped, target=VERTICES)
        used = self._mesh.materials[p.material].textures.values() if p.material >= 0 else ()
        for k in range(1, 1 + max((t.uv_set for t in used), default=0)):
            u, v = p.more_uv[:, 2 * k - 2 : 2 * k].T  # ty: ignore[not-subscriptable]
            attributes[f"TEXCOORD_{k}"] = buffer.accessor(np.stack([u, 1 - v], 1).astype(np.float32), target=VERTICES)
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
        return entries | ({"extensionsUsed": sorted(self._extensions)} if self._extensions else {})

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
            strength = max(1.0, *m.emissive)
            material["emissiveFactor"] = [unit(c / strength) for c in m.emissive]
            if strength > 1:
                self._extend(material, STRONG, {"emissiveStrength": float(strength)})
        if m.unlit:
            self._extend(material, UNLIT, {})
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
                        place[key] = self._texture(m.textures[slot], STRENGTHS.get(slot))
        return material

    def _extend(self, material: dict[str, Any], name: str, content: dict[str, Any]) -> None:
        material.setdefault("extensions", {})[name] = content
        self._extensions.add(name)

    def _texture(self, texture: Texture, strength: str | None) -> dict[str, Any]:
        """Return the textureInfo. strength: the key of the texture's strength, if it has one."""
        key = (texture.data, texture.mime)
        if key not in self._images:
            self._images[key] = len(self._images)
            image = {"mimeType": texture.mime, "bufferView": self._buffer.view(texture.data)}
            self._entries["images"].append(({"name": texture.name} if texture.name else {}) | image)
        filters = {"magFilter": NEAREST if texture.nearest else LINEAR, "minFilter": MIPMAPS}
        sampler = self._entry("samplers", filters | {"wrapS": WRAP[texture.wrap[0]], "wrapT": WRAP[texture.wrap[1]]})
        info: dict[str, Any] = {"index": self._entry("textures", {"sampler": sampler, "source": self._images[key]})}
        if texture.uv_set:
            info["texCoord"] = texture.uv_set
        return info | ({strength: texture.strength} if strength and texture.strength != 1 else {})

    def _entry(self, kind: str, entry: dict[str, Any]) -> int:
        """Return the place of an entry, which is added if it is new."""
        if entry not in self._entries[kind]:
            self._entries[kind].append(entry)
        return self._entries[kind].index(entry)


class GlbBuffer:
    """Collects accessors and images; equal arrays for the same use are stored once."""

    def __init__(self) -> None:
        self._chunks: list[bytes] = []
        self._length = 0
        self._known: dict[tuple[Any, ...], int] = {}
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def view(self, data: bytes, target: int | None = None) -> int:
        """Add a buffer view of some bytes, starting at a multiple of 4."""
        view: dict[str, Any] = {"buffer": 0, "byteOffset": self._length, "byteLength": len(data)}
        if target is not None:
            view["target"] = target
        padded = data + b"\0" * (-len(data) % 4)
        self._chunks.append(padded)
        self._length += len(padded)
        self.views.append(view)
        return len(self.views) - 1

    def accessor(self, array: np.ndarray, *, target: int | None = None, bounds: bool = False, normalized: bool = False) -> int:
        """Add an accessor of a (n,) or (n, k) array; `bounds` adds its minimum and maximum, as positions and times need."""
        array = np.ascontiguousarray(array)
        data = array.tobytes()
        key = (hashlib.sha256(data).digest(), array.shape, array.dtype.str, target, bounds, normalized)
        if key in self._known:
            return self._known[key]
        columns = array.reshape(len(array), -1)
        accessor: dict[str, Any] = {
            "bufferView": self.view(data, target),
            "componentType": COMPONENTS[array.dtype.name],
            "count": len(array),
            "type": KINDS[columns.shape[1]],
        }
        if bounds:
            accessor |= {"min": columns.min(0).tolist(), "max": columns.max(0).tolist()}
        if normalized:
            accessor["normalized"] = True
        self.accessors.append(accessor)
        self._known[key] = len(self.accessors) - 1
        return self._known[key]

    def encode(self, document: Mapping[str, Any]) -> bytes:
        """Return the GLB file: header, JSON chunk padded with spaces, binary chunk padded with zeros."""
        whole = {**document, "accessors": self.accessors, "bufferViews": self.views, "buffers": [{"byteLength": self._length}]}
        text = json.dumps(whole, separators=(",", ":"), allow_nan=False).encode("ascii")
        text += b" " * (-len(text) % 4)
        total = 12 + 8 + len(text) + 8 + self._length
        head = b"glTF" + np.array([2, total, len(text)], "<u4").tobytes() + b"JSON"
        return b"".join([head, text, np.array([self._length], "<u4").tobytes(), b"BIN\0", *self._chunks])


Extend = Callable[[dict[str, Any], GlbBuffer], None]


@dataclass(frozen=True, eq=False)
class Track(Brief):
    """Keys of one joint. times: ascending [s]; amounts: at these times [rad or m]."""

    joint: Joint
    times: Float32[np.ndarray, " n"]
    amounts: Float[np.ndarray, " n"]

    def values(self, rest: Float[np.ndarray, " 3"]) -> dict[str, Float32[np.ndarray, "n k"]]:
        """Return the keys by glTF path: quaternions xyzw without sign changes, and translations from `rest` [m]."""
        motion = joint_motion(self.joint)
        slides = motion.kind is JointType.PRISMATIC
        along = self.amounts[:, None] * (1.0 if slides else motion.pitch / (2 * np.pi)) * motion.axis
        moves = {"translation": (rest + along).astype(np.float32)} if slides or motion.pitch else {}
        half = self.amounts[:, None] / 2
        quaternion = np.hstack([np.sin(half) * motion.axis, np.cos(half)])
        turned = (quaternion / np.linalg.norm(quaternion, axis=1, keepdims=True)).astype(np.float32)
        return moves if slides else {"rotation": turned, **moves}


def tracks(asset: Asset, config: ExportConfig) -> tuple[Track, ...]:
    """Return keys of all moving joints: first up to the upper limits and back, then down to the lower ones and back.

    A direction that no joint has is left out. A joint without it rests in the meantime. Continuous joints rotate once, at
    constant speed; what is free is lifted. Followers move with their leaders, and the links of a loop with its first joint.
    """
    moving = [j for j in asset.joints if j.type is not JointType.FIXED and j.mimic is None]
    lift = {"type": JointType.PRISMATIC, "limits": (0.0, LIFT * asset.mesh.diagonal)}
    moving = [replace(j, **lift) if j.type is JointType.FREE else j for j in moving]
    up = any(j.limits is None or j.limits[1] > 0 for j in moving)
    down = any(j.limits is not None and j.limits[0] < 0 for j in moving)
    length = config.seconds_a_way * (up + down)
    made = tuple(_track(j, up, length, config) for j in moving)
    return resolve(LED_TRACKS)(asset, made) if asset.loops or any(j.mimic for j in asset.joints) else made


def _track(joint: Joint, up: bool, length: float, config: ExportConfig) -> Track:
    turns = joint.type is not JointType.PRISMATIC
    step = np.deg2rad(config.degrees_a_key)
    if joint.limits is None:
        count = int(np.ceil(2 * np.pi / step))
        whole = np.linspace(0, 1, count + 1)
        return Track(joint, (length * whole).astype(np.float32), 2 * np.pi * whole)
    times, amounts = [0.0], [0.0]
    for limit, begin in ((joint.limits[1], 0.0), (joint.limits[0], config.seconds_a_way * up)):
        if limit == 0:
            continue
        half = int(np.ceil(abs(limit) * np.pi / 2 / step)) if turns else 0  # the steepest step of the cosine
        count = 2 * max(12, half)
        share = np.linspace(0, 1, count + 1)
        if begin > times[-1]:
            times.append(begin)
            amounts.append(0.0)
        times += (begin + config.seconds_a_way * share[1:]).tolist()
        amounts += (limit * (1 - np.cos(2 * np.pi * share[1:])) / 2).tolist()
    amounts[-1] = 0.0
    if times[-1] < length:
        times.append(length)
        amounts.append(0.0)
    return Track(joint, np.array(times, np.float32), np.array(amounts))
