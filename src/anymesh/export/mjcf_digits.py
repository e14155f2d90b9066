"""Post-processing of MuJoCo's XML: ten digits instead of six, and position actuators in a form that all versions read."""

from __future__ import annotations

from collections.abc import Mapping
from xml.etree import ElementTree

import numpy as np

from anymesh.export.drives import Drive
from anymesh.export.model import Driven, ExportLink, Model
from anymesh.export.rotations import quaternion
from anymesh.export.xml_text import moments, number, vector
from anymesh.types import Box, Cylinder, Hull, Joint


def with_digits(text: str, model: Model, motors: Mapping[str, Drive]) -> str:
    """Return the MJCF of a model with its numbers at full precision; elements are found by name."""
    root = ElementTree.fromstring(text)
    origins = {link.name: link.origin for link in model.links}
    bodies = {element.get("name"): element for element in root.iter("body")}
    for body in model.bodies:
        joint = body.link.joint
        element = bodies[body.name]
        if joint is not None:
            element.set("pos", vector(body.link.origin - origins[joint.parent]))
        _inertial(element, body)
        _geoms(element, body)
    joints = {element.get("name"): element for element in root.iter("joint")}
    for joint in model.asset.joints:
        if joint.name in joints:
            _joint(joints[joint.name], joint)
    for element in root.iter("texture"):
        element.attrib.pop("colorspace", None)  # inferred at compile time; older versions do not know the attribute
    actuators = root.find("actuator")
    if actuators is not None:
        _actuators(actuators, model, motors)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode") + "\n"


def _inertial(element: ElementTree.Element, body: ExportLink) -> None:
    inertial = element.find("inertial")
    if inertial is None:
        raise ValueError(f"body {body.name!r} was written without its inertia")
    entries = moments(body.inertia.tensor)
    inertial.attrib.clear()
    inertial.set("pos", vector(body.inertia.center))
    inertial.set("mass", number(body.inertia.mass))
    inertial.set("fullinertia", " ".join(entries[key] for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")))


def _joint(element: ElementTree.Element, joint: Joint) -> None:
    element.set("axis", vector(joint.axis / np.linalg.norm(joint.axis)))
    element.set("damping", number(joint.damping))
    element.set("frictionloss", number(joint.friction))
    element.set("actuatorfrcrange", vector((-joint.effort, joint.effort)))
    if joint.limits is not None:
        element.set("range", vector(joint.limits))


def _geoms(element: ElementTree.Element, body: ExportLink) -> None:
    """Set positions and sizes of primitives; meshes are placed by their files."""
    shapes = {f"{body.name}_collision_{i}": shape for i, shape in enumerate(body.shapes)}
    for geom in element.findall("geom"):
        shape = shapes.get(str(geom.get("name")))
        if shape is None or isinstance(shape, Hull):
            geom.attrib.pop("pos", None)  # the compiler's recentering of a mesh and its inverse, with rounding
            geom.attrib.pop("quat", None)
            continue
        geom.set("pos", vector(shape.center))
        geom.set("quat", vector(quaternion(shape.rotation)))
        match shape:
            case Box():
                geom.set("size", vector(shape.size / 2))
            case Cylinder():
                geom.set("size", vector((shape.radius, shape.length / 2)))


def _actuators(actuators: ElementTree.Element, model: Model, motors: Mapping[str, Drive]) -> None:
    """Replace `general` and its parameters by the equivalent `motor` or `position`."""
    passive = model.driven is Driven.PASSIVE
    joints = {j.name: j for j in model.asset.joints}
    for element in list(actuators):
        name = str(element.get("name"))
        limits, drive = joints[name].limits, motors[name]
        span = vector((-drive.effort, drive.effort))
        words = {"name": name, "joint": name, "group": str(element.get("group")), "forcerange": span, "forcelimited": "true"}
        if passive:
            words |= {"ctrlrange": span, "ctrllimited": "true"}
        else:
            words |= {"kp": number(drive.stiffness), "kv": number(drive.damping)}
            words |= {} if limits is None else {"ctrlrange": vector(limits), "ctrllimited": "true"}
        element.tag = "motor" if passive else "position"
        element.attrib.clear()
        element.attrib.update(words)
