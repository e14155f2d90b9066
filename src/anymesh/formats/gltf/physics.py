"""Bodies, colliders and joints in the physics extensions of glTF, beside the animation of a written GLB.

Two drafts say the same: KHR_physics_rigid_bodies with KHR_implicit_shapes (Babylon.js, Blender and Godot by plugins), and OMI's
physics_body, physics_shape and physics_joint (Godot). Both are optional to readers.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, assert_never

import numpy as np

from anymesh.export.glb import INDICES, VERTICES, GlbBuffer
from anymesh.export.model import ExportLink, Model, drives
from anymesh.export.notation import principal, quaternion, turning_x_to
from anymesh.export.options import Base, Driven
from anymesh.formats.gltf.joints import KHR, OMI, OMI_BODY
from anymesh.names import legal_names
from anymesh.physics.mechanism import HandleFrame
from anymesh.physics.substances import Substance
from anymesh.types import Box, Cylinder, Hull, Joint, JointType, Shape

KHR_SHAPES, OMI_SHAPES = "KHR_implicit_shapes", "OMI_physics_shape"
ALONG_Y = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])  # rotates the axis of glTF's cylinders, Y, to Z
Node = dict[str, Any]


def add_physics(model: Model, document: dict[str, Any], buffer: GlbBuffer) -> None:
    """Add the physics of a model to the document of its GLB, whose node i + 1 is link i.

    A joint lies in the link that it moves, since importers look for a moving body there, and refers to a node in its parent.
    The X of both is the reversed axis, so that positions of the parent relative to the link, which the extensions limit,
    have the joint's sign. A fixed base is static.
    """
    physics = _Physics(model, document, buffer)
    for index, body in enumerate(model.bodies):
        physics.add_body(index + 1, body)
    for joint in (j for j in model.asset.joints if j.type is not JointType.FREE):
        physics.add_joint(joint)
    for handle in model.handles:
        physics.add_handle(handle)
    physics.finish()


class _Physics:
    """Nodes, shapes and joints that are added to a document."""

    def __init__(self, model: Model, document: dict[str, Any], buffer: GlbBuffer) -> None:
        self._model, self._document, self._buffer = model, document, buffer
        self._nodes: list[Node] = document["nodes"]
        self._hulls: list[int] = []
        self._number = {body.name: k + 1 for k, body in enumerate(model.bodies)}
        self._origin = {link.name: link.origin for link in model.links}
        self._excluded = {frozenset((pair.a, pair.b)) for pair in model.exclusions}
        self._drives = drives(model)
        self._top: dict[str, dict[str, list[Any]]] = {
            KHR_SHAPES: {"shapes": []}, KHR: {"physicsJoints": [], "physicsMaterials": [], "collisionFilters": []},
            OMI_SHAPES: {"shapes": []}, OMI_BODY: {"physicsMaterials": [], "collisionFilters": []}, OMI: {"physicsJoints": []},
        }  # fmt: skip

    def add_body(self, number: int, body: ExportLink) -> None:
        """Add the mass of a link, and a node below it for each of its shapes."""
        moments, axes = principal(body.inertia.tensor)
        motion: dict[str, Any] = {
            "mass": _plain(body.inertia.mass),
            "centerOfMass": _plains(body.inertia.center),
            "inertiaDiagonal": [float(f"{m:.9g}") for m in moments],  # 0 would be infinite
            "inertiaOrientation": _xyzw(axes),
        }
        moves = body.link.joint is not None or self._model.how.base is Base.FREE
        own = {OMI_BODY: {"motion": {"type": "dynamic" if moves else "static"} | motion}}
        self._nodes[number]["extensions"] = ({KHR: {"motion": motion}} if moves else {}) | own
        apart = self._filter(body.name)
        for k, (shape, _, substance) in enumerate(body.collisions()):
            kept = apart | self._surface(substance)
            geometry, own_shape = self._shape(f"{body.name}_hull_{k}", shape)
            placed = _placed(shape.center, shape.rotation) if isinstance(shape, Box) else {}
            placed = _placed(shape.center, shape.rotation @ ALONG_Y) if isinstance(shape, Cylinder) else placed
            collider = {KHR: {"collider": {"geometry": geometry} | kept}, OMI_BODY: {"collider": {"shape": own_shape} | kept}}
            self._below(number, {"name": f"{body.name}_shape_{k}"} | placed | {"extensions": collider})

    def add_handle(self, handle: HandleFrame) -> None:
        """Add a node for a handle, with its size."""
        number, sizes = self._number[handle.link], dict(zip(("length", "width", "depth"), _plains(handle.size), strict=True))
        placed = _placed(handle.place - self._origin[handle.link], handle.R)
        self._below(number, {"name": handle.name, **placed, "extras": {"handle": {"joint": handle.joint, **sizes}}})

    def _surface(self, substance: Substance | None) -> dict[str, int]:
        """Return the friction and restitution of a shape, which both extensions call a physics material."""
        if substance is None:
            return {}
        keys = {"staticFriction": substance.static_friction, "dynamicFriction": substance.dynamic_friction}
        content = {"name": substance.name, **keys, "restitution": substance.restitution}
        for kind in (KHR, OMI_BODY):
            materials = self._top[kind]["physicsMaterials"]
            if content not in materials:
                materials.append(content)
        return {"physicsMaterial": self._top[KHR]["physicsMaterials"].index(content)}

    def _filter(self, name: str) -> dict[str, int]:
        """Return the filter of a link that touches nothing of others; joints have a switch of their own for what they join."""
        joined = {frozenset((j.parent, j.child)) for j in self._model.asset.joints}
        apart = sorted({other for pair in self._excluded - joined if name in pair for other in pair - {name}})
        if not apart:
            return {}
        for kind in (KHR, OMI_BODY):
            self._top[kind]["collisionFilters"].append({"collisionSystems": [name], "notCollideWithSystems": apart})
        return {"collisionFilter": len(self._top[KHR]["collisionFilters"]) - 1}

    def _shape(self, name: str, shape: Shape) -> tuple[dict[str, Any], int]:
        """Return the geometry of a shape in KHR, and its number in OMI."""
        match shape:
            case Box():
                content: dict[str, Any] = {"type": "box", "box": {"size": _plains(shape.size)}}
            case Cylinder():
                radius = _plain(shape.radius)
                sizes = {"height": _plain(shape.length), "radiusBottom": radius, "radiusTop": radius}
                content = {"type": "cylinder", "cylinder": sizes}
            case Hull():
                return self._hull(name, shape)
            case _:
                assert_never(shape)
        own, theirs = self._top[OMI_SHAPES]["shapes"], self._top[KHR_SHAPES]["shapes"]
        own.append(content)
        theirs.append(content)
        return {"shape": len(theirs) - 1}, len(own) - 1

    def _hull(self, name: str, hull: Hull) -> tuple[dict[str, Any], int]:
        """Add a hull as a mesh whose node lies in a scene that is not shown. Blender would draw a node of no scene."""
        kind = np.min_scalar_type(len(hull.vertices))  # the largest number is no index
        indices = self._buffer.accessor(hull.faces.reshape(-1).astype(kind), target=INDICES)
        positions = self._buffer.accessor(hull.vertices.astype(np.float32), target=VERTICES, bounds=True)
        primitive = {"attributes": {"POSITION": positions}, "indices": indices}
        self._document["meshes"].append({"name": name, "primitives": [primitive]})
        mesh = len(self._document["meshes"]) - 1
        self._nodes.append({"name": name, "mesh": mesh})
        self._hulls.append(len(self._nodes) - 1)
        self._top[OMI_SHAPES]["shapes"].append({"type": "convex", "convex": {"mesh": mesh}})
        return {"node": len(self._nodes) - 1, "convexHull": True}, len(self._top[OMI_SHAPES]["shapes"]) - 1

    def add_joint(self, joint: Joint) -> None:
        """Add a joint with its limits and drives, and the nodes of its frames."""
        frame = np.eye(3) if joint.type is JointType.FIXED else turning_x_to(-joint.axis / np.linalg.norm(joint.axis))
        shift = self._origin[joint.child] - self._origin[joint.parent]
        end = self._below(self._number[joint.parent], {"name": f"{joint.name}_parent", **_placed(shift, frame)})
        number = len(self._top[KHR]["physicsJoints"])
        touch = {} if frozenset((joint.parent, joint.child)) in self._excluded else {"enableCollision": True}
        content = {"joint": number, "connectedNode": end} | touch
        node = {"name": f"{joint.name}_child"} | _placed(np.zeros(3), frame)
        self._below(self._number[joint.child], node | {"extensions": {KHR: {"joint": content}, OMI: content}})
        stated: dict[str, Any] = {"name": joint.name, "limits": _limits(joint)}
        if joint.type is not JointType.FIXED:
            stated["drives"] = self._forces(joint)
        for kind in (KHR, OMI):
            self._top[kind]["physicsJoints"].append({key: value for key, value in stated.items() if value})

    def _forces(self, joint: Joint) -> list[dict[str, Any]]:
        """Return damping and a spring, as a drive, and the joint's drive; some engines keep the last."""
        kind = "linear" if joint.type is JointType.PRISMATIC else "angular"
        start = {"type": kind, "mode": "force", "axis": 0, "velocityTarget": 0.0}
        axes = (0, 1, 2) if joint.type is JointType.BALL else (0,)
        forces = [start | {"axis": axis, "damping": _plain(self._model.resistances[joint.name].damping)} for axis in axes]
        m = self._model.mechanisms.get(joint.name)
        if m is not None and m.stiffness:
            forces[0] |= {"stiffness": _plain(m.stiffness), "positionTarget": _plain(m.reference)}
        if self._model.how.drives is Driven.POSITION and joint.name in self._drives:
            drive = self._drives[joint.name]
            gains = {"stiffness": _plain(drive.stiffness), "damping": _plain(drive.damping), "maxForce": _plain(drive.effort)}
            forces.append(start | {"positionTarget": 0.0} | gains)
        return forces

    def _below(self, number: int, node: Node) -> int:
        """Add a node below a link."""
        self._nodes.append(node)
        self._nodes[number].setdefault("children", []).append(len(self._nodes) - 1)
        return len(self._nodes) - 1

    def finish(self) -> None:
        """Make names unique, and name the extensions."""
        for node, name in zip(self._nodes, legal_names([n["name"] for n in self._nodes]), strict=True):
            node["name"] = name
        if self._hulls:
            self._document["scenes"].append({"name": "collision", "nodes": self._hulls})
        kept = {kind: {key: things for key, things in top.items() if things} for kind, top in self._top.items()}
        self._document.setdefault("extensions", {}).update({kind: top for kind, top in kept.items() if top})
        used = {OMI_BODY, *self._document["extensions"], *self._document.get("extensionsUsed", [])}
        used |= {kind for node in self._nodes for kind in node.get("extensions", {})}
        self._document["extensionsUsed"] = sorted(used)


def _limits(joint: Joint) -> list[dict[str, Any]]:
    """Return the limits of the axes of a joint whose axis is X."""
    own, other = ("linearAxes", "angularAxes") if joint.type is JointType.PRISMATIC else ("angularAxes", "linearAxes")
    still = {"min": 0.0, "max": 0.0}
    if joint.type is JointType.FIXED:
        return [{own: [0, 1, 2]} | still, {other: [0, 1, 2]} | still]
    if joint.type is JointType.BALL:
        cone = [] if joint.limits is None else [{own: [1, 2], "min": -_plain(joint.limits[1]), "max": _plain(joint.limits[1])}]
        return [{other: [0, 1, 2]} | still, *cone]
    if joint.type is JointType.SCREW:  # the extensions cannot couple its axes
        limits = [{other: [1, 2]} | still, {own: [1, 2]} | still]
        if joint.limits is not None:
            low, high = sorted(_plain(joint.pitch / (2 * np.pi) * end) for end in joint.limits)
            limits.append({other: [0], "min": low, "max": high})
    else:
        limits = [{other: [0, 1, 2]} | still, {own: [1, 2]} | still]
    if joint.limits is not None:
        limits.append({own: [0], "min": _plain(joint.limits[0]), "max": _plain(joint.limits[1])})
    return limits


def _placed(place: Sequence[float] | np.ndarray, rotation: np.ndarray) -> Node:
    """Return the transform of a node, without what is zero."""
    node = {"translation": _plains(place), "rotation": _xyzw(rotation)}
    return {key: value for key, value in node.items() if value not in ([0.0] * 3, [0.0, 0.0, 0.0, 1.0])}


def _xyzw(rotation: np.ndarray) -> list[float]:
    return _plains(np.roll(quaternion(rotation), -1))


def _plains(values: Iterable[float]) -> list[float]:
    return [_plain(v) for v in values]


def _plain(value: float) -> float:
    """Round to nine significant digits, which float32 needs; what is zero up to rounding becomes 0."""
    return 0.0 if abs(value) < 1e-12 else float(f"{float(value):.9g}")
