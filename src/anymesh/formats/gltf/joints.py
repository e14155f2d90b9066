"""Joints that a glTF file states: animations of nodes, KHR_physics_rigid_bodies and OMI_physics_joint."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np
from jaxtyping import Float
from scipy.spatial.transform import Rotation

from anymesh.errors import InputError
from anymesh.formats.gltf.buffers import Buffers, item
from anymesh.loading.files import Folder
from anymesh.stated.animated import FULL_TURN_RAD, Animations, NodeTrack, SceneNode, animated_joints
from anymesh.stated.bodies import Body, BodyJoint, joints_of_bodies
from anymesh.types import JointType, Mesh, StatedJoint

KHR, OMI_BODY, OMI = "KHR_physics_rigid_bodies", "OMI_physics_body", "OMI_physics_joint"
POINTER = re.compile(r"/nodes/(\d+)/(translation|rotation|scale)")
REST = {"translation": (0.0, 0.0, 0.0), "rotation": (0.0, 0.0, 0.0, 1.0), "scale": (1.0, 1.0, 1.0)}
FIXED_WITHIN = 1e-6  # [rad or m] an axis with a shorter range is fixed
Placed = Mapping[int, Float[np.ndarray, "4 4"]]  # the nodes of the scene, parents first, and their transforms to it
Range = tuple[float, float]


def stated_joints(
    mesh: Mesh, home: Sequence[int | None], tree: dict[str, Any], placed: Placed, buffers: Buffers, folder: Folder
) -> Mesh:
    """Return the mesh of a scene with the joints that the file states; without, with a warning, if these are broken.

    home: the glTF node that carries each node of the mesh: its own, or a bone. Joints of physics extensions have priority.
    """
    try:
        return _stated(mesh, home, tree, placed, buffers, folder)
    except (LookupError, TypeError, ValueError, AttributeError) as error:  # no fault of an animation refuses a mesh
        folder.warn(f"the animations or physics joints are broken, and left out ({type(error).__name__})")
        return mesh


def _stated(
    mesh: Mesh, home: Sequence[int | None], tree: dict[str, Any], placed: Placed, buffers: Buffers, folder: Folder
) -> Mesh:
    joints = list(_physics_joints(KHR, tree, placed, folder)) or list(_physics_joints(OMI, tree, placed, folder))
    if joints:
        body = [None if h is None else _body(tree, _parents(tree), h) for h in home]
        names: dict[Body, str] = {k: _name(tree, k) for k in placed if _is_dynamic(tree["nodes"][k])}
        mesh = joints_of_bodies(mesh, body, names, joints, folder)
        if mesh.joints:
            return mesh
    animations = _animations(tree, buffers, folder)
    bones = {b for skin in tree.get("skins", []) for b in skin.get("joints", [])}
    if not animations:
        return _at_bones(mesh, home, bones, tree, placed)
    bones -= _above(tree, home)
    bent = [name for name, tracks in animations if bones & tracks.keys()]
    if bent:
        folder.warn(f'the animation "{bent[0]}" bends a mesh by bones; it is read at rest')
    return animated_joints(mesh, home, _scene(tree, placed), animations, folder)


def _at_bones(mesh: Mesh, home: Sequence[int | None], bones: set[int], tree: dict[str, Any], placed: Placed) -> Mesh:
    """Return the mesh with joints at the heads of bones that move a part of it rigidly; their axes are not known.

    The base is what moves with no bone, or else the part of the uppermost bone, of several the largest.
    """
    parents, area = _parents(tree), np.bincount(mesh.face_node, mesh.face_areas, len(mesh.nodes))
    size = {b: sum(float(a) for a, h in zip(area, home, strict=True) if h == b) for b in bones & placed.keys() & set(home)}
    above = {b: [k for k in _upwards(parents, b)[1:] if k in size] for b in size}
    order = sorted(size, key=lambda b: (len(above[b]), -size[b], b))
    if all(h in size for h in home):
        order = order[1:]
    number = {b: k for k, b in enumerate(order)}
    joints = tuple(
        StatedJoint(
            JointType.REVOLUTE, placed[b][:3, 3], np.array([0.0, 0.0, 1.0]), None, range_known=False, axis_known=False,
            name=_name(tree, b), reason=f'at the bone "{_name(tree, b)}"',
            parent=next((number[k] for k in above[b] if k in number), None),
        )
        for b in order
    )  # fmt: skip
    nodes = tuple(replace(n, joint=-1 if h is None else number.get(h, -1)) for n, h in zip(mesh.nodes, home, strict=True))
    return replace(mesh, nodes=nodes, joints=joints)


def _name(tree: dict[str, Any], index: int) -> str:
    return str(tree["nodes"][index].get("name") or f"node_{index}")


def _parents(tree: dict[str, Any]) -> dict[int, int]:
    return {child: k for k, node in enumerate(tree["nodes"]) for child in node.get("children", [])}


def _above(tree: dict[str, Any], home: Sequence[int | None]) -> set[int]:
    """Return the nodes that carry nodes of the mesh."""
    parents = _parents(tree)
    return {k for start in home if start is not None for k in _upwards(parents, start)}


def _upwards(parents: dict[int, int], index: int) -> list[int]:
    """Return a node and those above it; a circle ends where it closes."""
    chain = [index]
    while (above := parents.get(chain[-1])) is not None and above not in chain:
        chain.append(above)
    return chain


def _scene(tree: dict[str, Any], placed: Placed) -> dict[int, SceneNode]:
    parents, nodes = _parents(tree), {}
    for k, T in placed.items():
        parent = parents[k] if parents.get(k) in placed else None
        axis = tree["nodes"][k].get("extras", {})
        axis = axis.get("joint", {}).get("axis") if isinstance(axis, dict) and isinstance(axis.get("joint"), dict) else None
        opens = None
        with suppress(TypeError, ValueError):  # extras are anything
            opens = None if axis is None else T[:3, :3] @ np.array(axis, float).reshape(3)
        nodes[k] = SceneNode(_name(tree, k), parent, np.eye(4) if parent is None else placed[parent], T, opens)
    return nodes


def _animations(tree: dict[str, Any], buffers: Buffers, folder: Folder) -> Animations:
    """Return what the animations do to nodes; a warning counts channels that are broken or move no node."""
    animations, others, broken = list[tuple[str, dict[int, NodeTrack]]](), 0, 0
    for animation in tree.get("animations", []):
        channels: dict[int, dict[str, Channel]] = {}
        for channel in animation.get("channels", []):
            target = channel.get("target", {})
            pointer = target.get("extensions", {}).get("KHR_animation_pointer", {}).get("pointer", "")
            match = POINTER.fullmatch(str(pointer))
            index, path = (int(match[1]), match[2]) if match else (target.get("node"), target.get("path"))
            if path not in REST or not isinstance(index, int):
                others += 1
                continue
            try:
                item(tree["nodes"], index)
                channels.setdefault(index, {})[path] = _channel(item(animation["samplers"], channel["sampler"]), path, buffers)
            except (InputError, LookupError, TypeError, ValueError):
                broken += 1
        tracks = {k: _track(tree["nodes"][k], paths) for k, paths in channels.items()}
        animations.append((str(animation.get("name") or ""), tracks))
    if others:
        folder.warn(f"{others} channels of animations that move no node (shapes, materials, lights) are left out")
    if broken:
        folder.warn(f"{broken} broken channels of animations are left out")
    return animations


Channel = tuple[Float[np.ndarray, " n"], Callable[[Float[np.ndarray, " k"]], np.ndarray]]  # keys, and values at some times


def _channel(sampler: dict[str, Any], path: str, buffers: Buffers) -> Channel:
    """Return the keys of a sampler and its values at any times. Raise ValueError if it is not valid."""
    times = buffers.array(sampler["input"])[:, 0].astype(np.float64)
    values, mode = buffers.array(sampler["output"]).astype(np.float64), sampler.get("interpolation", "LINEAR")
    rows = 3 if mode == "CUBICSPLINE" else 1
    if not len(times) or values.shape != (rows * len(times), len(REST[path])):
        raise ValueError
    if not (np.isfinite(times).all() and np.isfinite(values).all() and (np.diff(times) >= 0).all()):
        raise ValueError
    keys = values.reshape(len(times), rows, -1)
    turns = path == "rotation"
    if turns and rows == 3 and np.allclose(np.linalg.norm(keys[:, ::2], axis=2), 1, atol=1e-3):
        keys, mode = keys[:, 1:2], "LINEAR"  # a compressor took the tangents for quaternions, too, and normalised them

    def at(when: Float[np.ndarray, " k"]) -> np.ndarray:
        low = np.clip(np.searchsorted(times, when, "right") - 1, 0, len(times) - 1)
        high = np.minimum(low + 1, len(times) - 1)
        length = times[high] - times[low]
        share = np.divide(when - times[low], length, out=np.zeros_like(when), where=length > 0).clip(0, 1)[:, None]
        if mode == "STEP":
            return keys[low, 0]
        if mode == "CUBICSPLINE":
            return _hermite(keys[low], keys[high], share, length[:, None])
        return _slerp(keys[low, 0], keys[high, 0], share) if turns else keys[low, 0] + share * (keys[high, 0] - keys[low, 0])

    return times, at


def _hermite(a: np.ndarray, b: np.ndarray, t: np.ndarray, length: np.ndarray) -> np.ndarray:
    """Interpolate keys of in-tangent, value and out-tangent (glTF 2.0, appendix C)."""
    value, out, into, end = a[:, 1], length * a[:, 2], length * b[:, 0], b[:, 1]
    return (2 * t**3 - 3 * t**2 + 1) * value + (t**3 - 2 * t**2 + t) * out + (3 * t**2 - 2 * t**3) * end + (t**3 - t**2) * into


def _slerp(a: np.ndarray, b: np.ndarray, t: np.ndarray) -> np.ndarray:
    cosine = (a * b).sum(1, keepdims=True)
    b = np.where(cosine < 0, -b, b)  # the short way round
    angle = np.arccos(np.clip(np.abs(cosine), 0, 1))
    flat = angle < 1e-6
    sine = np.where(flat, 1.0, np.sin(angle))
    return np.where(flat, a + t * (b - a), (np.sin((1 - t) * angle) * a + np.sin(t * angle) * b) / sine)


def _track(node: dict[str, Any], channels: dict[str, Channel]) -> NodeTrack:
    rest = {path: np.array(node.get(path, value), np.float64) for path, value in REST.items()}
    if "matrix" in node:
        T = np.array(node["matrix"], np.float64).reshape(4, 4).T
        scale = np.maximum(np.linalg.norm(T[:3, :3], axis=0), 1e-12)
        rest = {"translation": T[:3, 3], "rotation": Rotation.from_matrix(T[:3, :3] / scale).as_quat(), "scale": scale}

    def sample(when: Float[np.ndarray, " k"]) -> Float[np.ndarray, "k 4 4"]:
        value = {p: channels[p][1](when) if p in channels else np.tile(rest[p], (len(when), 1)) for p in REST}
        length = np.linalg.norm(value["rotation"], axis=1, keepdims=True)
        rotation = np.where(length > 0, value["rotation"], REST["rotation"])
        T = np.tile(np.eye(4), (len(when), 1, 1))
        T[:, :3, :3] = Rotation.from_quat(rotation).as_matrix() * value["scale"][:, None]
        T[:, :3, 3] = value["translation"]
        return T

    return NodeTrack(np.unique(np.concatenate([times for times, _ in channels.values()])), sample)


def _extension(thing: dict[str, Any], name: str) -> dict[str, Any]:
    content = thing.get("extensions", {}).get(name, {})
    return content if isinstance(content, dict) else {}


def _is_dynamic(node: dict[str, Any]) -> bool:
    """Return whether a node is a body that moves by itself."""
    omi = _extension(node, OMI_BODY)
    kind = omi.get("type", omi.get("motion", {}).get("type", "static"))
    return "motion" in _extension(node, KHR) or kind not in ("static", "trigger")


def _body(tree: dict[str, Any], parents: dict[int, int], index: int) -> Body:
    """Return the body that a node belongs to: itself or the nearest above, None for the world."""
    return next((k for k in _upwards(parents, index) if _is_dynamic(tree["nodes"][k])), None)


def _physics_joints(kind: str, tree: dict[str, Any], placed: Placed, folder: Folder) -> Iterator[BodyJoint]:
    """Yield the joints of an extension; a warning counts those that are broken or not of one axis."""
    parents, free, broken = _parents(tree), 0, 0
    for index, T in placed.items():
        content = _extension(tree["nodes"][index], kind)
        stated = content.get("joint") if kind == KHR else content or None
        if stated is None:
            continue
        try:
            a, b, limits = _connected(_extension(tree, kind), stated, index)
            axes = _ranges(limits, override="constraints" in stated)
            ends = _body(tree, parents, a), _body(tree, parents, b)
            joint = _body_joint(axes, T, placed[index if "constraints" in stated else b], ends, f"from {kind}")
        except (LookupError, TypeError, ValueError, AttributeError):
            broken += 1
            continue
        free += joint is None
        if joint is not None:
            above = joint.type is JointType.FIXED and joint.b in _upwards(parents, index)
            yield joint.seen_from(joint.b) if above else joint  # what is welded has the name of the upper body
    if free:
        folder.warn(f"{free} physics joints that move along several axes, or none that is limited, are left out")
    if broken:
        folder.warn(f"{broken} broken physics joints are left out")


def _connected(document: dict[str, Any], stated: dict[str, Any], index: int) -> tuple[int, int, list[dict[str, Any]]]:
    """Return both nodes of a joint and its limits; in earlier versions of OMI_physics_joint, it refers to its constraints."""
    if "constraints" in stated:
        limits = [item(document["constraints"], k) for k in stated["constraints"]]
        named = [{"min": c.get("lowerLimit", 0.0), "max": c.get("upperLimit", 0.0)} | c for c in limits]
        return int(stated["nodeA"]), int(stated["nodeB"]), named
    return index, int(stated["connectedNode"]), item(document["physicsJoints"], stated["joint"]).get("limits", [])


def _ranges(limits: list[dict[str, Any]], override: bool) -> dict[tuple[str, int], Range]:
    """Return the range of each of the six axes; endless where nothing limits it."""
    ranges = {(kind, k): (-np.inf, np.inf) for kind in ("linearAxes", "angularAxes") for k in range(3)}
    for limit in limits:
        low, high = float(limit.get("min", -np.inf)), float(limit.get("max", np.inf))
        for kind in ("linearAxes", "angularAxes"):
            axes = limit.get(kind, [])
            for k in axes:
                before = ranges[kind, k]
                apart = high if len(axes) == 1 or low == high else np.inf  # of several axes, a distance or a cone
                ranges[kind, k] = (low, apart) if override else (max(before[0], low), min(before[1], apart))
    return ranges


def _body_joint(
    axes: dict[tuple[str, int], Range], T_a: np.ndarray, T_b: np.ndarray, ends: tuple[Body, Body], reason: str
) -> BodyJoint | None:
    """Return a joint of one axis of b relative to a, None if there are several; limits are relative to the pose at rest."""
    moving = [key for key, (low, high) in axes.items() if high - low > FIXED_WITHIN]
    sliding = [k for kind, k in moving if kind == "linearAxes"]
    if len(moving) == 2 and len(sliding) == 1 and moving[1][1] == sliding[0]:
        moving = moving[:1]  # a slider may turn about its line
    if len(moving) > 1:
        return None
    R_a = T_a[:3, :3] / np.linalg.norm(T_a[:3, :3], axis=0)
    R_b = T_b[:3, :3] / np.linalg.norm(T_b[:3, :3], axis=0)
    if not moving:
        return BodyJoint(*ends, JointType.FIXED, T_a[:3, 3], R_a[:, 0], None, reason)
    kind, k = moving[0]
    if kind == "linearAxes":
        now = float(R_a[:, k] @ (T_b[:3, 3] - T_a[:3, 3]))
    else:
        x = Rotation.from_matrix(R_a.T @ R_b).as_quat()
        now = float(2 * np.arctan2(x[k], x[3]))
    low, high = axes[kind, k][0] - now, axes[kind, k][1] - now
    finite = bool(np.isfinite([low, high]).all())
    joint_type = JointType.PRISMATIC if kind == "linearAxes" else JointType.REVOLUTE
    if joint_type is JointType.REVOLUTE and not high - low <= FULL_TURN_RAD:
        joint_type, finite = JointType.CONTINUOUS, False
    known = finite or joint_type is JointType.CONTINUOUS
    return BodyJoint(*ends, joint_type, T_a[:3, 3], R_a[:, k], (low, high) if finite else None, reason, known)
