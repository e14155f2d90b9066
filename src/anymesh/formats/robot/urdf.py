"""URDF: the kinematic tree with visual, collision and inertial for every link."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import assert_never
from xml.etree import ElementTree

import numpy as np

from anymesh.export.links import Link
from anymesh.export.meshes import display_color, material_names, painted, widest
from anymesh.export.model import ExportConfig, ExportLink, Model, drives
from anymesh.export.notation import DRAKE, document, moments, number, rpy, vector
from anymesh.export.options import Driven, Visuals
from anymesh.mechanisms.closing import loop_points
from anymesh.mechanisms.serial import one_axis
from anymesh.physics.inertia import Inertia
from anymesh.physics.resistance import Resistance
from anymesh.types import Asset, Box, Cylinder, Hull, Joint, JointType, Mesh, Shape
from anymesh.types.motion import leaders

LIGHT = 1e-3  # mass of a link between joints that move one part, over that of the part; an estimate
FREELY = (0.0, 100.0)  # effort and velocity of a joint that nothing resists
# By default, MuJoCo drops visuals and folders of mesh names, and fuses static links.
MUJOCO = {"discardvisual": "false", "fusestatic": "false", "strippath": "false", "balanceinertia": "true"}


def write_urdf(model: Model, folder: Path, config: ExportConfig) -> None:
    """Write <name>.urdf into an asset folder with its meshes/."""
    (folder / f"{model.asset.name}.urdf").write_text(urdf_text(model), encoding="utf-8", newline="\n")


def urdf_text(model: Model) -> str:
    """Return the URDF of a model; mesh paths are relative to its folder.

    Every link frame has the asset's axes, so joint origins are differences and axes are unchanged. The simulator decides
    whether the root is fixed (PyBullet's `useFixedBase`, Isaac's `fix_base`; MuJoCo fixes it), so there is no `world` link.
    """
    model = model.tiled
    asset = model.asset
    robot = ElementTree.Element("robot", name=asset.name)
    seen = {} if model.how.visuals is Visuals.OBJ else {"discardvisual": "true"}  # MuJoCo does not read others
    ElementTree.SubElement(ElementTree.SubElement(robot, "mujoco"), "compiler", MUJOCO | seen)
    if asset.source.credits:
        ElementTree.SubElement(robot, "credits", dict(asset.source.credits))
    names = material_names(asset.mesh.materials)
    origins = {link.name: link.origin for link in model.links}
    for body in model.bodies:
        _add_link(robot, body, body.visual_path(model.how.visuals), _appearance(asset.mesh, body.link, names))
    ways = leaders(asset.joints)
    for joint in (replace(j, mimic=ways.get(j.name)) for j in asset.joints):
        shift, all_resist = origins[joint.child] - origins[joint.parent], joint.type is JointType.BALL
        for step in one_axis(joint, [*origins, *(j.name for j in asset.joints)], asset.mesh.diagonal):
            resists = all_resist or step.name == joint.name
            _add_joint(robot, step, shift, model.resistances.get(joint.name) if resists else None)
            shift = 0 * shift
            if step.child != joint.child:
                part = next(body for body in model.bodies if body.name == joint.child)
                _add_inertial(ElementTree.SubElement(robot, "link", name=step.child), part.inertia, LIGHT)
    _add_loops(robot, asset, origins)
    for name, m in model.mechanisms.items():
        if m.stiffness:  # Gazebo alone reads it
            gazebo = ElementTree.SubElement(robot, "gazebo", reference=name)
            ElementTree.SubElement(gazebo, "springStiffness").text = number(m.stiffness)
            ElementTree.SubElement(gazebo, "springReference").text = number(m.reference)
    if model.how.drives is Driven.POSITION:
        _add_drives(robot, model)
    return document(robot)


def _appearance(mesh: Mesh, link: Link, names: Sequence[str]) -> tuple[str, tuple[float, ...]]:
    """Return name and display colour (RGBA 0..1) of the material that covers most of the link."""
    most = widest(link)
    if painted(mesh, most):
        return f"{link.name}_color", display_color(mesh, most)
    return names[most.material], display_color(mesh, most)


def _add_link(robot: ElementTree.Element, body: ExportLink, visual_path: str, look: tuple[str, tuple[float, ...]]) -> None:
    sub = ElementTree.SubElement
    element = sub(robot, "link", name=body.name)
    _add_inertial(element, body.inertia)
    visual = sub(element, "visual")
    sub(visual, "origin", xyz="0 0 0", rpy="0 0 0")
    sub(sub(visual, "geometry"), "mesh", filename=visual_path)
    name, color = look
    sub(sub(visual, "material", name=name), "color", rgba=" ".join(f"{c:.6g}" for c in color))
    for shape, path, substance in body.collisions():
        collision = _add_collision(element, shape, path)
        if substance is not None:
            proximity = sub(collision, f"{DRAKE}proximity_properties")
            sub(proximity, f"{DRAKE}mu_static", value=number(substance.static_friction))
            sub(proximity, f"{DRAKE}mu_dynamic", value=number(substance.dynamic_friction))
    if body.substances and (most := body.substances[0].substance):
        friction = number(most.dynamic_friction)
        contact = sub(element, "contact")
        sub(contact, "lateral_friction", value=friction)
        sub(contact, "restitution", value=number(most.restitution))
        gazebo = sub(robot, "gazebo", reference=body.name)
        sub(gazebo, "mu1").text = friction
        sub(gazebo, "mu2").text = friction


def _add_inertial(link: ElementTree.Element, inertia: Inertia, share: float = 1.0) -> None:
    """Add a share of an inertia to a link."""
    inertial = ElementTree.SubElement(link, "inertial")
    ElementTree.SubElement(inertial, "origin", xyz=vector(inertia.center), rpy="0 0 0")
    ElementTree.SubElement(inertial, "mass", value=number(share * inertia.mass))
    ElementTree.SubElement(inertial, "inertia", moments(share * inertia.tensor))


def _add_collision(link: ElementTree.Element, shape: Shape, path: str | None) -> ElementTree.Element:
    sub = ElementTree.SubElement
    element = sub(link, "collision")
    center, rotation = (np.zeros(3), np.eye(3)) if isinstance(shape, Hull) else (shape.center, shape.rotation)
    sub(element, "origin", xyz=vector(center), rpy=vector(rpy(rotation)))
    geometry = sub(element, "geometry")
    match shape:
        case Box():
            sub(geometry, "box", size=vector(shape.size))
        case Cylinder():
            sub(geometry, "cylinder", radius=number(shape.radius), length=number(shape.length))
        case Hull():
            sub(geometry, "mesh", filename=str(path))
        case _:
            assert_never(shape)
    return element


def _add_joint(robot: ElementTree.Element, joint: Joint, shift: np.ndarray, resistance: Resistance | None) -> None:
    """Add a joint of one axis. shift: its place in its parent [m]; resistance: None if nothing resists."""
    sub = ElementTree.SubElement
    element = sub(robot, "joint", name=joint.name, type=str(joint.type))
    sub(element, "origin", xyz=vector(shift), rpy="0 0 0")
    sub(element, "parent", link=joint.parent)
    sub(element, "child", link=joint.child)
    if joint.type is JointType.FIXED:
        return
    sub(element, "axis", xyz=vector(joint.axis / np.linalg.norm(joint.axis)))
    effort, velocity = FREELY if resistance is None else (resistance.effort, resistance.velocity)
    limit = {"effort": number(effort), "velocity": number(velocity)}
    if joint.limits is not None:
        limit = {"lower": number(joint.limits[0]), "upper": number(joint.limits[1])} | limit
    sub(element, "limit", limit)
    if resistance is not None:
        sub(element, "dynamics", damping=number(resistance.damping), friction=number(resistance.friction))
    if (m := joint.mimic) is not None:
        sub(element, "mimic", joint=m.joint, multiplier=number(m.ratio), offset=number(m.offset))


def _add_loops(robot: ElementTree.Element, asset: Asset, origins: Mapping[str, np.ndarray]) -> None:
    """Add closed loops, which URDF lacks, as an element of our own, and as the constraints of points that Drake has."""
    sub = ElementTree.SubElement
    for loop in asset.loops:
        element = sub(robot, "loop", name=loop.name, type=str(loop.kind))
        for side, link in (("first", loop.first), ("second", loop.second)):
            sub(element, side, link=link, xyz=vector(loop.origin - origins[link]), axis=vector(loop.axis))
        for point in loop_points(loop, asset.mesh.diagonal):
            ball = sub(robot, f"{DRAKE}ball_constraint")
            for name, link in (("A", loop.first), ("B", loop.second)):
                sub(ball, f"{DRAKE}ball_constraint_body_{name}", name=link)
            for name, link in (("p_AP", loop.first), ("p_BQ", loop.second)):
                sub(ball, f"{DRAKE}ball_constraint_{name}", value=vector(point - origins[link]))


def _add_drives(robot: ElementTree.Element, model: Model) -> None:
    """Add an actuator with gains for each joint, which Drake needs, and the block of ROS 2 with its mock hardware."""
    sub, gains = ElementTree.SubElement, drives(model)
    for name, drive in gains.items():
        transmission = sub(robot, "transmission", name=f"{name}_transmission")
        sub(transmission, "type").text = "transmission_interface/SimpleTransmission"
        for tag in ("joint", "actuator"):
            end = sub(transmission, tag, name=name)
            sub(end, "hardwareInterface").text = "hardware_interface/PositionJointInterface"
        sub(end, "mechanicalReduction").text = "1"
        sub(end, f"{DRAKE}controller_gains", p=number(drive.stiffness), d=number(drive.damping))
    control = sub(robot, "ros2_control", name=model.asset.name, type="system")
    sub(sub(control, "hardware"), "plugin").text = "mock_components/GenericSystem"
    for joint in (j for j in model.asset.joints if j.name in gains):
        element = sub(control, "joint", name=joint.name)
        command = sub(element, "command_interface", name="position")
        for key, limit in zip(("min", "max"), joint.limits or (), strict=False):
            sub(command, "param", name=key).text = number(limit)
        sub(sub(element, "state_interface", name="position"), "param", name="initial_value").text = "0"
        sub(element, "state_interface", name="velocity")
