"""SDFormat: model.sdf, and the model.config that Gazebo needs to find it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import assert_never
from xml.etree import ElementTree

import numpy as np

from anymesh.export.meshes import display_color, painted, widest
from anymesh.export.model import ExportConfig, ExportLink, Model
from anymesh.export.notation import DRAKE, document, moments, number, rpy, vector
from anymesh.export.options import Base
from anymesh.mechanisms.closing import loop_points
from anymesh.names import legal_names
from anymesh.physics.substances import Substance
from anymesh.types import Box, Cylinder, Hull, Joint, JointType, Mesh, Shape
from anymesh.types.motion import leaders

VERSION, COUPLED = "1.9", "1.11"  # the least that has joints that follow others, and the pitch of a screw in metres
FILE, CONFIG_FILE = "model.sdf", "model.config"
OWN = "{urn:articulate-anymesh}"  # elements of a namespace are kept and passed over by readers
ElementTree.register_namespace("anymesh", OWN[1:-1])


def write_sdf(model: Model, folder: Path, config: ExportConfig) -> None:
    """Write model.sdf and model.config into an asset folder with its meshes/."""
    for name, text in ((FILE, sdf_text(model)), (CONFIG_FILE, config_text(model))):
        (folder / name).write_text(text, encoding="utf-8", newline="\n")


def config_text(model: Model) -> str:
    """Return the model.config of a model."""
    root = ElementTree.Element("model")
    ElementTree.SubElement(root, "name").text = model.asset.name
    ElementTree.SubElement(root, "version").text = "1.0"
    ElementTree.SubElement(root, "sdf", version=_version(model)).text = FILE
    source, text = model.asset.source, "An articulated object, made by Articulate AnyMesh"
    if "author" in source.credits:
        ElementTree.SubElement(ElementTree.SubElement(root, "author"), "name").text = source.credits["author"]
    ElementTree.SubElement(root, "description").text = f"{text} from: {source.credits['credit']}" if source.credits else text
    return document(root)


def sdf_text(model: Model) -> str:
    """Return the SDFormat of a model.

    A link's frame is also its joint's, so a joint has no pose and its axis is unchanged. A fixed base is a fixed joint to the
    world, since <static> would also fix the other joints. SDFormat does not allow a link and a joint of the same name, so such
    a joint's name gets a number.
    """
    model = model.tiled
    asset = model.asset
    root = ElementTree.Element("sdf", version=_version(model))
    element = ElementTree.SubElement(root, "model", name=asset.name, canonical_link=model.bodies[0].name)
    _leaf(element, "self_collide", "true" if _only_neighbours_excluded(model) else "false")
    for key, text in asset.source.credits.items():
        _leaf(element, f"{OWN}{key}", text)
    origins = {link.name: link.origin for link in model.links}
    for body in model.bodies:
        link = _add_link(element, body, origins)
        _add_visual(link, asset.mesh, body, body.visual_path(model.how.visuals))
    names = joint_names(model)
    if model.how.base is Base.FIXED:
        fixed = ElementTree.SubElement(element, "joint", name=legal_names([*origins, *names.values(), "fixed_base"])[-1])
        fixed.set("type", "fixed")
        _leaf(fixed, "parent", "world")
        _leaf(fixed, "child", model.bodies[0].name)
    ways = leaders(asset.joints)
    for joint in (replace(j, mimic=ways.get(j.name)) for j in asset.joints if j.type is not JointType.FREE):
        _add_joint(element, joint, names, model)
    _add_loops(element, model, origins)
    taken = [*origins, *names.values()]
    frames = (*model.handles, *model.places)
    for at, name in zip(frames, legal_names([*taken, *(f.name for f in frames)])[len(taken) :], strict=True):
        frame = ElementTree.SubElement(element, "frame", name=name, attached_to=at.link)
        _leaf(frame, "pose", _pose(at.place - origins[at.link], at.R))
    return document(root)


def _version(model: Model) -> str:
    return COUPLED if any(j.mimic is not None or j.type is JointType.SCREW for j in model.asset.joints) else VERSION


def joint_names(model: Model) -> Mapping[str, str]:
    """Return the names of the joints in SDFormat, where no joint may have a link's name."""
    joints = [j.name for j in model.asset.joints]
    taken = [link.name for link in model.links]
    return dict(zip(joints, legal_names([*taken, *joints])[len(taken) :], strict=True))


def _only_neighbours_excluded(model: Model) -> bool:
    """Return whether all excluded pairs are connected by a joint.

    Such links never collide in Gazebo. Other pairs can only be excluded all at once.
    """
    joined = {frozenset((j.parent, j.child)) for j in model.asset.joints}
    return all(frozenset((pair.a, pair.b)) in joined for pair in model.exclusions)


def _leaf(parent: ElementTree.Element, tag: str, text: str) -> ElementTree.Element:
    element = ElementTree.SubElement(parent, tag)
    element.text = text
    return element


def _add_link(model: ElementTree.Element, body: ExportLink, origins: Mapping[str, np.ndarray]) -> ElementTree.Element:
    element = ElementTree.SubElement(model, "link", name=body.name)
    joint = body.link.joint
    if joint is not None:
        pose = _leaf(element, "pose", _pose(body.link.origin - origins[joint.parent], np.eye(3)))
        pose.set("relative_to", joint.parent)
    inertial = ElementTree.SubElement(element, "inertial")
    _leaf(inertial, "pose", _pose(body.inertia.center, np.eye(3)))
    _leaf(inertial, "mass", number(body.inertia.mass))
    tensor = ElementTree.SubElement(inertial, "inertia")
    for key, value in moments(body.inertia.tensor).items():
        _leaf(tensor, key, value)
    for index, (shape, path, substance) in enumerate(body.collisions()):
        collision = ElementTree.SubElement(element, "collision", name=f"collision_{index}")
        if not isinstance(shape, Hull):
            _leaf(collision, "pose", _pose(shape.center, shape.rotation))
        _add_shape(ElementTree.SubElement(collision, "geometry"), shape, path)
        if substance is not None:
            _add_surface(collision, substance)
    return element


def _add_surface(collision: ElementTree.Element, substance: Substance) -> None:
    """Add friction, equal in all directions (Drake: static and dynamic), and restitution."""
    surface = ElementTree.SubElement(collision, "surface")
    ode = ElementTree.SubElement(ElementTree.SubElement(surface, "friction"), "ode")
    for tag in ("mu", "mu2"):
        _leaf(ode, tag, number(substance.dynamic_friction))
    bounce = ElementTree.SubElement(surface, "bounce")
    _leaf(bounce, "restitution_coefficient", number(substance.restitution))
    _leaf(bounce, "threshold", "0.1")  # [m/s] slower contacts do not bounce, as in DART; by default none does


def _add_visual(link: ElementTree.Element, mesh: Mesh, body: ExportLink, path: str) -> None:
    """Add the visual mesh with its own materials, or a colour if it has none."""
    visual = ElementTree.SubElement(link, "visual", name="visual")
    _leaf(ElementTree.SubElement(ElementTree.SubElement(visual, "geometry"), "mesh"), "uri", path)
    if all(painted(mesh, p) for p in body.link.primitives):
        color = " ".join(f"{c:.6g}" for c in display_color(mesh, widest(body.link)))
        material = ElementTree.SubElement(visual, "material")
        _leaf(material, "ambient", color)
        _leaf(material, "diffuse", color)


def _add_shape(geometry: ElementTree.Element, shape: Shape, path: str | None) -> None:
    match shape:
        case Box():
            _leaf(ElementTree.SubElement(geometry, "box"), "size", vector(shape.size))
        case Cylinder():
            element = ElementTree.SubElement(geometry, "cylinder")
            _leaf(element, "radius", number(shape.radius))
            _leaf(element, "length", number(shape.length))
        case Hull():
            _leaf(ElementTree.SubElement(geometry, "mesh"), "uri", str(path))
        case _:
            assert_never(shape)


def _add_joint(top: ElementTree.Element, joint: Joint, names: Mapping[str, str], model: Model) -> None:
    resistance, mechanism = model.resistances.get(joint.name), model.mechanisms.get(joint.name)
    element = ElementTree.SubElement(top, "joint", name=names[joint.name], type=str(joint.type))
    _leaf(element, "parent", joint.parent)
    _leaf(element, "child", joint.child)
    if resistance is None:  # fixed
        return
    if joint.type is JointType.SCREW:
        _leaf(element, "screw_thread_pitch", number(joint.pitch))
    if joint.type is JointType.BALL:  # has no axis; the cone is ours
        _leaf(element, f"{OWN}cone", "inf" if joint.limits is None else number(joint.limits[1]))
        return
    axis = ElementTree.SubElement(element, "axis")
    _leaf(axis, "xyz", vector(joint.axis / np.linalg.norm(joint.axis)))
    if (m := joint.mimic) is not None:
        follows = ElementTree.SubElement(axis, "mimic", joint=names[m.joint])
        for tag, value in (("multiplier", m.ratio), ("offset", m.offset), ("reference", 0.0)):
            _leaf(follows, tag, number(value))
    limit = ElementTree.SubElement(axis, "limit")
    if joint.limits is not None:
        _leaf(limit, "lower", number(joint.limits[0]))
        _leaf(limit, "upper", number(joint.limits[1]))
    _leaf(limit, "effort", number(resistance.effort))
    _leaf(limit, "velocity", number(resistance.velocity))
    dynamics = ElementTree.SubElement(axis, "dynamics")
    _leaf(dynamics, "damping", number(resistance.damping))
    _leaf(dynamics, "friction", number(resistance.friction))
    if mechanism is not None and mechanism.stiffness:
        _leaf(dynamics, "spring_reference", number(mechanism.reference))
        _leaf(dynamics, "spring_stiffness", number(mechanism.stiffness))


def _add_loops(top: ElementTree.Element, model: Model, origins: Mapping[str, np.ndarray]) -> None:
    """Add closed loops as elements of our own, since engines refuse a link of two joints, and as points that Drake ties."""
    for loop in model.asset.loops:
        element = ElementTree.SubElement(top, f"{OWN}loop", name=loop.name, type=str(loop.kind))
        for tag, link in (("first", loop.first), ("second", loop.second)):
            side = _leaf(element, f"{OWN}{tag}", link)
            side.set("xyz", vector(loop.origin - origins[link]))
            side.set("axis", vector(loop.axis))
        for point in loop_points(loop, model.asset.mesh.diagonal):
            ball = ElementTree.SubElement(top, f"{DRAKE}ball_constraint")
            for key, link in (("A", loop.first), ("B", loop.second)):
                _leaf(ball, f"{DRAKE}ball_constraint_body_{key}", link)
            for key, link in (("p_AP", loop.first), ("p_BQ", loop.second)):
                _leaf(ball, f"{DRAKE}ball_constraint_{key}", vector(point - origins[link]))


def _pose(place: np.ndarray, rotation: np.ndarray) -> str:
    return f"{vector(place)} {vector(rpy(rotation))}"
