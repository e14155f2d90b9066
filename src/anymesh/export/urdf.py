"""URDF: the kinematic tree with visual, collision and inertial for every link."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from xml.etree import ElementTree

import numpy as np

from anymesh.export.inertia import Inertia
from anymesh.export.links import Link, Primitive
from anymesh.export.meshes import collision_path, material_names, visual_path
from anymesh.types import Asset, Joint, JointType, Mesh
from anymesh.types.color import to_srgb
from anymesh.types.triangles import face_cross

GREY = (0.7, 0.7, 0.7, 1.0)
# MuJoCo by default drops visuals and folders of mesh names, and fuses links that do not move.
MUJOCO = {"discardvisual": "false", "fusestatic": "false", "strippath": "false", "balanceinertia": "true"}


def urdf_text(asset: Asset, links: Sequence[Link], inertias: Mapping[str, Inertia]) -> str:
    """The URDF of an asset with legal names; mesh paths are relative to its folder.

    Every link frame has the asset's axes, so joint origins are differences and axes stand as they are.
    """
    robot = ElementTree.Element("robot", name=asset.name)
    ElementTree.SubElement(ElementTree.SubElement(robot, "mujoco"), "compiler", MUJOCO)
    names = material_names(asset.mesh.materials)
    origins = {link.name: link.origin for link in links}
    for link in links:
        _add_link(robot, link, inertias[link.name], _appearance(asset.mesh, link, names))
    for joint in asset.joints:
        _add_joint(robot, joint, origins)
    ElementTree.indent(robot)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ElementTree.tostring(robot, encoding="unicode") + "\n"


def number(value: float) -> str:
    """Ten significant digits; what is zero but for rounding is 0."""
    return "0" if abs(value) < 1e-12 else f"{float(value):.10g}"


def _vector(values: Iterable[float]) -> str:
    return " ".join(number(v) for v in values)


def _appearance(mesh: Mesh, link: Link, names: Sequence[str]) -> tuple[str, tuple[float, ...]]:
    """Name and display colour (RGBA 0..1) of the material that covers most of the link."""

    def area(p: Primitive) -> float:
        t = p.positions[p.triangles]
        return float(np.linalg.norm(face_cross(t), axis=1).sum())

    widest = max(link.primitives, key=area)
    if widest.colors is not None and (widest.material < 0 or not mesh.materials[widest.material].textures):
        color = widest.colors.mean(0) / 255
        return f"{link.name}_color", tuple(float(c) for c in color)
    if widest.material < 0:
        return "unassigned", GREY
    *color, alpha = mesh.materials[widest.material].base_color
    return names[widest.material], (*to_srgb(color).tolist(), alpha)


def _add_link(robot: ElementTree.Element, link: Link, inertia: Inertia, appearance: tuple[str, tuple[float, ...]]) -> None:
    sub = ElementTree.SubElement
    element = sub(robot, "link", name=link.name)
    inertial = sub(element, "inertial")
    sub(inertial, "origin", xyz=_vector(inertia.center), rpy="0 0 0")
    sub(inertial, "mass", value=number(inertia.mass))
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = inertia.tensor
    noise = 1e-12 * (xx + yy + zz)
    values = {"ixx": xx, "ixy": xy, "ixz": xz, "iyy": yy, "iyz": yz, "izz": zz}
    sub(inertial, "inertia", {key: f"{v:.10g}" if abs(v) > noise else "0" for key, v in values.items()})
    for tag, path in (("visual", visual_path(link)), ("collision", collision_path(link))):
        shape = sub(element, tag)
        sub(shape, "origin", xyz="0 0 0", rpy="0 0 0")
        sub(sub(shape, "geometry"), "mesh", filename=path)
        if tag == "visual":
            name, color = appearance
            sub(sub(shape, "material", name=name), "color", rgba=" ".join(f"{c:.6g}" for c in color))


def _add_joint(robot: ElementTree.Element, joint: Joint, origins: Mapping[str, np.ndarray]) -> None:
    sub = ElementTree.SubElement
    element = sub(robot, "joint", name=joint.name, type=str(joint.type))
    sub(element, "origin", xyz=_vector(origins[joint.child] - origins[joint.parent]), rpy="0 0 0")
    sub(element, "parent", link=joint.parent)
    sub(element, "child", link=joint.child)
    if joint.type is JointType.FIXED:
        return
    sub(element, "axis", xyz=_vector(joint.axis / np.linalg.norm(joint.axis)))
    limit = {"effort": number(joint.effort), "velocity": number(joint.velocity)}
    if joint.limits is not None:
        limit = {"lower": number(joint.limits[0]), "upper": number(joint.limits[1])} | limit
    sub(element, "limit", limit)
    sub(element, "dynamics", damping=number(joint.damping), friction=number(joint.friction))
