"""glTF 2.0, binary or with files beside it: every placed node with triangles; instances are copied."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.entry_points import GLTF_JOINTS, resolve
from anymesh.errors import InputError
from anymesh.formats.credits import gltf_credits
from anymesh.formats.gltf.buffers import Buffers, DataError, item, parse_json, split_glb
from anymesh.formats.gltf.materials import read_materials
from anymesh.formats.gltf.primitives import GltfMeshes, Pose
from anymesh.loading.files import MAX_FACES, Folder
from anymesh.loading.join import join, unique_names
from anymesh.loading.scene_graph import is_generic, leave_out_warning
from anymesh.types import Brief, Mesh, Node

READ = (
    "KHR_texture_transform", "KHR_mesh_quantization", "KHR_texture_basisu", "KHR_draco_mesh_compression",
    "EXT_meshopt_compression", "KHR_meshopt_compression", "EXT_mesh_gpu_instancing", "KHR_node_visibility", "MSFT_lod",
    "KHR_lights_punctual",
)  # fmt: skip
MAX_DEPTH = 500  # nodes within each other
LEFT_OUT = {  # reasons why a node is not part of the object
    "hidden": "hidden node{} {} left out (KHR_node_visibility)",
    "coarse": "coarser level{} of detail {} left out, the finest is kept (MSFT_lod)",
    "camera": "mesh{} below a camera {} left out",
}


def read_gltf(data: bytes, folder: Folder) -> Mesh:
    """Return the default scene in file coordinates. Raise InputError if it is not valid."""
    name = folder.path.name
    binary = None
    if data[:4] == b"glTF":
        data, binary = split_glb(name, data)
    tree = parse_json(name, data)
    folder.credits = gltf_credits(tree)
    buffers = Buffers(tree, binary, folder)
    for extension in tree.get("extensionsRequired", []):
        if extension not in READ and not extension.startswith(("KHR_materials_", "EXT_texture_", "MSFT_texture_")):
            folder.warn(f"the file requires the extension {extension}, which is not read")
    labels = unique_names(str(m.get("name") or f"mesh_{k}") for k, m in enumerate(tree["meshes"]))
    meshes = GltfMeshes(tree, buffers, folder, read_materials(tree, buffers, folder), labels)
    scene = GltfScene(meshes, _placed(name, tree, folder), _unique(tree, labels))
    for index in _visible(tree, scene.at, scene.names, folder):
        scene.place(index)
    for what, count in meshes.left_out.items():
        folder.warn(f"left out: {count} {what}" if count > 1 or what[-1] == ")" else f"left out: {what}")
    if not scene.placed:
        why = "; ".join(meshes.left_out) or "no mesh in its scene"
        raise InputError(f"{name}: found {why}; a scene with at least one triangle is needed")
    joined = join(scene.placed)
    if folder.joints and tree.keys() & {"animations", "extensions", "skins"}:
        return resolve(GLTF_JOINTS)(joined, scene.home, tree, {k: node.T for k, node in scene.at.items()}, buffers, folder)
    return joined


def _unique(tree: dict[str, Any], labels: Sequence[str]) -> list[str]:
    """Return the unique names of all nodes; a node without a name has that of its mesh."""
    return unique_names(_name(node, k, labels) for k, node in enumerate(tree.get("nodes", [])))


def _name(node: dict[str, Any], index: int, labels: Sequence[str]) -> str:
    mesh = node.get("mesh")
    return str(node.get("name") or (labels[mesh] if isinstance(mesh, int) and 0 <= mesh < len(labels) else f"node_{index}"))


@dataclass(frozen=True)
class PlacedNode(Brief):
    """A node of the scene. T: to the scene; path: indices of the nodes from the root to it; left_out: a reason of LEFT_OUT."""

    T: Float[np.ndarray, "4 4"]
    path: tuple[int, ...]
    left_out: str = ""


def _placed(name: str, tree: dict[str, Any], folder: Folder) -> dict[int, PlacedNode]:
    """Return the nodes of the scene: parents first, siblings in reverse (face labels rely on it)."""
    nodes = tree.setdefault("nodes", [])
    if not nodes:
        nodes += [{"mesh": k} for k in range(len(tree["meshes"]))]  # a library of meshes
        tree["scenes"] = []
    coarse = {k for node in nodes for k in node.get("extensions", {}).get("MSFT_lod", {}).get("ids", [])}
    waiting: list[tuple[int, np.ndarray, tuple[int, ...], str]] = [(k, np.eye(4), (k,), "") for k in _roots(tree, folder)]
    seen: dict[int, PlacedNode] = {}
    while waiting:
        index, T_parent, path, why = waiting.pop()
        if index in seen or not 0 <= index < len(nodes):
            raise InputError(f"{name}: node {index} has two parents or is none of {len(nodes)}; valid is a tree of nodes")
        if len(path) > MAX_DEPTH:
            raise InputError(f"{name}: found nodes over {MAX_DEPTH} within each other, which is the most that is read")
        node = nodes[index]
        if node.get("extensions", {}).get("KHR_node_visibility", {}).get("visible", True) is False:
            why = "hidden"
        why = why or ("coarse" if index in coarse else "")
        T = T_parent @ _local(node)
        seen[index] = PlacedNode(T, path, why)
        why = why or ("camera" if "camera" in node else "")
        waiting += [(child, T, (*path, child), why) for child in node.get("children", [])]
    return seen


def _roots(tree: dict[str, Any], folder: Folder) -> list[int]:
    """Return the roots of the default scene, else of the first that has a mesh; without scenes, the nodes without a parent."""
    nodes, scenes = tree["nodes"], tree.get("scenes") or []
    if not scenes:
        children = {c for node in nodes for c in node.get("children", [])}
        return [k for k in range(len(nodes)) if k not in children]

    def with_mesh(scene: dict[str, Any], beside: set[int]) -> bool:
        waiting, seen = list(scene.get("nodes", [])), set(beside)
        while waiting:
            index = waiting.pop()
            if index in seen or not 0 <= index < len(nodes):
                continue
            if "mesh" in nodes[index]:
                return True
            seen.add(index)
            waiting += nodes[index].get("children", [])
        return False

    default = tree.get("scene", 0)
    order = [default, *(k for k in range(len(scenes)) if k != default)]
    filled = [k for k in order if isinstance(k, int) and 0 <= k < len(scenes) and with_mesh(scenes[k], set())]
    others = sum(with_mesh(scenes[k], _colliders(nodes)) for k in filled[1:])
    if others:
        folder.warn(f"{others} other scene{'s are' if others > 1 else ' is'} left out; scene {filled[0]} is read")
    return scenes[filled[0]].get("nodes", []) if filled else []


def _colliders(nodes: Sequence[dict[str, Any]]) -> set[int]:
    """Return the nodes that others refer to for their collision shape."""
    referred = set()
    for node in nodes:
        with suppress(LookupError, TypeError, ValueError):
            referred.add(int(node["extensions"]["KHR_physics_rigid_bodies"]["collider"]["geometry"]["node"]))
    return referred


def _visible(tree: dict[str, Any], placed: dict[int, PlacedNode], names: Sequence[str], folder: Folder) -> list[int]:
    """Return the nodes with a mesh that are part of the object, all if none is; one warning names each kind that is not."""
    with_mesh = [index for index in placed if "mesh" in tree["nodes"][index]]
    kept = [index for index in with_mesh if not placed[index].left_out]
    if not kept:
        return with_mesh
    for reason, text in LEFT_OUT.items():
        if without := [names[index] for index in with_mesh if placed[index].left_out == reason]:
            folder.warn(leave_out_warning(without, text))
    return kept


def _local(node: dict[str, Any]) -> Float[np.ndarray, "4 4"]:
    if "matrix" in node:
        return np.array(node["matrix"], np.float64).reshape(4, 4).T
    return _transforms(
        [node.get("translation", (0, 0, 0))], [node.get("rotation", (0, 0, 0, 1))], [node.get("scale", (1, 1, 1))]
    )[0]


def _transforms(translation: Any, rotation: Any, scale: Any) -> Float[np.ndarray, "n 4 4"]:
    """Return matrices of translations (n, 3), quaternions (n, 4) and scales (n, 3)."""
    x, y, z, w = np.asarray(rotation, np.float64).T
    n = x * x + y * y + z * z + w * w
    s = np.divide(2, n, out=np.zeros_like(n), where=n > 0)
    T = np.zeros((len(n), 4, 4))
    R = [
        [1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
        [s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)],
        [s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)],
    ]
    T[:, :3, :3] = np.array(R).transpose(2, 0, 1) * np.asarray(scale, np.float64)[:, None]
    T[:, :3, 3] = translation
    T[:, 3, 3] = 1
    return T


@dataclass(eq=False)
class GltfScene:
    """What is placed of a scene.

    home: for each node of the placed meshes, in order, the node of the file that carries it: its own or a bone, None if it
    bends.
    """

    meshes: GltfMeshes
    at: dict[int, PlacedNode]
    names: list[str]
    placed: list[Mesh] = field(default_factory=list)
    home: list[int | None] = field(default_factory=list)
    faces: int = 0
    _read: dict[Any, Any] = field(default_factory=dict)

    def place(self, index: int) -> None:
        """Place the mesh of a node, once per instance."""
        node = self.meshes.tree["nodes"][index]
        number, name = node["mesh"], self.meshes.folder.path.name
        weights = tuple(node.get("weights") or item(self.meshes.tree["meshes"], number).get("weights") or ())
        pose = self._pose(node.get("skin"), number)
        key = (number, weights, node.get("skin") if pose else None)
        if key not in self._read:
            self._read[key] = self.meshes.read(number, weights, pose)
        if self._read[key] is None:
            return
        mesh, bone = self._read[key]
        chain = self.at[index].path
        label, own = self.meshes.labels[number], _name(node, index, self.meshes.labels)
        if pose is not None:
            self._place_skinned(mesh, bone, pose, index)
            return
        transforms = self._instances(node, self.at[index].T)
        self.faces += len(transforms) * len(mesh.faces)
        if self.faces > MAX_FACES:
            raise InputError(f"{name} places more than {MAX_FACES} faces, which is the most that is handled")
        for k, T in enumerate(transforms):
            if not np.isfinite(T).all():
                raise InputError(f"{name}: node {index} has a transform that is not finite")
            path = (*(self.names[i] for i in chain), *((f"{self.names[index]}.{k}",) if len(transforms) > 1 else ()))
            made = Node(own, label, path=path if len(path) > 1 else (), pivot=tuple(T[:3, 3].tolist()))
            self.placed.append(replace(mesh.transformed(T), nodes=(made,)))
            self.home.append(index)

    def _pose(self, number: int | None, mesh: int) -> Pose | None:
        """Return the rest pose of a mesh's skin; None, with a warning, if it cannot be read."""
        if number is None:
            return None
        if not all({"JOINTS_0", "WEIGHTS_0"} <= p["attributes"].keys() for p in self.meshes.tree["meshes"][mesh]["primitives"]):
            self.meshes.folder.warn("a mesh with a skin has no joints or weights, and is placed without its bones")
            return None
        try:
            skin = item(self.meshes.tree.get("skins", []), number)
            joints = skin["joints"]
            bind = np.tile(np.eye(4), (len(joints), 1, 1))
            if "inverseBindMatrices" in skin:
                stored = self.meshes.buffers.array(skin["inverseBindMatrices"])[: len(joints)].reshape(-1, 4, 4)
                bind[: len(stored)] = stored.transpose(0, 2, 1)
            matrices = np.array([self._to_scene(j) for j in joints]) @ bind
        except (DataError, LookupError, TypeError, ValueError) as error:
            self.meshes.folder.warn(f"the bones of skin {number} cannot be read, its meshes are placed without them ({error})")
            return None
        return Pose(matrices, joints) if np.isfinite(matrices).all() and len(joints) else None

    def _to_scene(self, index: int) -> np.ndarray:
        """Return the transform of a node to the scene; a joint need not be in it."""
        nodes, T = self.meshes.tree["nodes"], np.eye(4)
        for _ in range(len(nodes)):
            if index in self.at:
                return self.at[index].T @ T
            T = _local(item(nodes, index)) @ T
            above = next((k for k, node in enumerate(nodes) if index in node.get("children", [])), None)
            if above is None:
                return T
            index = above
        raise ValueError("its joints are in a circle")

    def _place_skinned(self, mesh: Mesh, bone: np.ndarray, pose: Pose, index: int) -> None:
        """Place a mesh at its rest pose, with a node for each joint that moves a part of it rigidly."""
        moving, face_node = np.unique(bone, return_inverse=True)
        own = _name(self.meshes.tree["nodes"][index], index, self.meshes.labels)
        nodes = []
        for joint in moving:
            home = index if joint < 0 else pose.nodes[joint]
            path = () if home not in self.at else tuple(self.names[k] for k in self.at[home].path)
            path = path if joint < 0 else (*path, self.names[index])
            name = own if joint < 0 or len(moving) == 1 else self.names[home]
            name = f"{own}_{name}" if name != own and is_generic(name) else name
            nodes.append(
                Node(name, self.meshes.labels[self.meshes.tree["nodes"][index]["mesh"]], path=path if len(path) > 1 else ())
            )
            self.home.append(None if joint < 0 else home)
        self.placed.append(replace(mesh, face_node=face_node.reshape(-1), nodes=tuple(nodes)))

    def _instances(self, node: dict[str, Any], T: np.ndarray) -> np.ndarray:
        """Return the transforms of a node's instances (EXT_mesh_gpu_instancing), else its own."""
        keys = node.get("extensions", {}).get("EXT_mesh_gpu_instancing", {}).get("attributes", {})
        values = {key: self.meshes.buffers.array(keys[key]) for key in ("TRANSLATION", "ROTATION", "SCALE") if key in keys}
        if not values:
            return T[None]
        count = min(len(v) for v in values.values())
        default = {"TRANSLATION": (0, 0, 0), "ROTATION": (0, 0, 0, 1), "SCALE": (1, 1, 1)}
        return T @ _transforms(*(values.get(key, np.tile(rest, (count, 1)))[:count] for key, rest in default.items()))
