"""MJCF: a MuJoCo model built with MuJoCo's own spec, compiled before it is written."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, assert_never

import numpy as np

from anymesh.errors import OutputError
from anymesh.export.drives import Drive, drives
from anymesh.export.meshes import material_names
from anymesh.export.mjcf_digits import with_digits
from anymesh.export.mjcf_materials import GeomMaterial, geom_materials, png_textures
from anymesh.export.model import Base, Driven, ExportLink, Model
from anymesh.export.rotations import quaternion
from anymesh.export.settings import ExportConfig
from anymesh.mujoco_ import load_mujoco
from anymesh.types import Box, Cylinder, Hull, Joint, JointType, Mesh, Shape

VISUAL, COLLISION = "visual", "collision"
DRIVES = 1  # group of the actuators: `actuatorgroupdisable="1"` makes the asset passive


def write_mjcf(model: Model, folder: Path, config: ExportConfig) -> None:
    """Write <name>.xml into an asset folder with its meshes/, and files specific to MuJoCo into meshes/mjcf/.

    Contacts between a link and its parent count, as with a fixed root, unless they are excluded.

    Raise MissingExtraError without MuJoCo, OutputError if it cannot compile the model.
    """
    mujoco = load_mujoco()
    spec = _spec(mujoco, model, folder)
    looks = {body.name: geom_materials(model.asset.mesh, body, folder, config) for body in model.bodies}
    _add_materials(mujoco, spec, model.asset.mesh, folder, [look for body_looks in looks.values() for look in body_looks])
    names = material_names(model.asset.mesh.materials)
    frames: dict[str, Any] = {}
    for body in _parents_first(model):
        joint = body.link.joint
        parent = spec.worldbody if joint is None else frames[joint.parent]
        frames[body.name] = _add_body(model, body, parent)
        _add_joint(mujoco, frames[body.name], joint, model.base)
        _add_geoms(mujoco, spec, frames[body.name], body, looks[body.name], names)
    for pair in model.exclusions:
        spec.add_exclude(bodyname1=pair.a, bodyname2=pair.b)
    motors = drives(model)
    for name, drive in motors.items():
        _add_drive(mujoco, spec, model, name, drive)
    try:
        spec.compile()
    except ValueError as error:
        raise OutputError(f"MuJoCo cannot compile {model.asset.name}: {error}") from error
    text = with_digits(spec.to_xml(), model, motors)
    (folder / f"{model.asset.name}.xml").write_text(text, encoding="utf-8", newline="\n")


def _parents_first(model: Model) -> list[ExportLink]:
    """Return the bodies, each after its parent."""
    parent = {j.child: j.parent for j in model.asset.joints}

    def depth(name: str) -> int:
        return 1 + depth(parent[name]) if name in parent else 0

    return sorted(model.bodies, key=lambda body: depth(body.name))


def _spec(mujoco: Any, model: Model, folder: Path) -> Any:
    spec = mujoco.MjSpec()
    spec.modelname, spec.modelfiledir = model.asset.name, str(folder)
    spec.compiler.degree = False
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST  # keeps the damping of light links stable
    spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_FILTERPARENT)
    visual = spec.add_default(VISUAL, spec.default).geom
    visual.contype, visual.conaffinity, visual.group = 0, 0, 2
    spec.add_default(COLLISION, spec.default).geom.group = 3
    return spec


def _add_materials(mujoco: Any, spec: Any, mesh: Mesh, folder: Path, looks: Iterable[GeomMaterial]) -> None:
    """Add the materials and textures that geoms use; MuJoCo's own renderer shows the base colour, others more."""
    roles = mujoco.mjtTextureRole
    slots = {"base_color": roles.mjTEXROLE_RGB, "normal": roles.mjTEXROLE_NORMAL, "emissive": roles.mjTEXROLE_EMISSIVE}
    used = {look.material: look for look in looks if look.material is not None}
    files = png_textures(mesh, folder, used, slots)
    for path in sorted(set(files.values())):
        spec.add_texture(name=Path(path).stem, file=path, type=mujoco.mjtTexture.mjTEXTURE_2D)
    names = material_names(mesh.materials)
    for index, look in sorted(used.items()):
        source = mesh.materials[index]
        material = spec.add_material(name=names[index], rgba=look.rgba, metallic=source.metallic, roughness=source.roughness)
        material.emission = 0.0 if "emissive" in source.textures else float(max(source.emissive))
        textures = list(material.textures)
        for slot, role in slots.items():
            if (index, slot) in files:
                textures[int(role)] = Path(files[index, slot]).stem
        material.textures = textures


def _add_body(model: Model, body: ExportLink, parent: Any) -> Any:
    origins = {link.name: link.origin for link in model.links}
    joint = body.link.joint
    place = body.link.origin - (np.zeros(3) if joint is None else origins[joint.parent])
    frame = parent.add_body(name=body.name, pos=place)
    frame.explicitinertial, frame.mass, frame.ipos = True, body.inertia.mass, body.inertia.center
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = body.inertia.tensor
    frame.fullinertia = [xx, yy, zz, xy, xz, yz]
    return frame


def _add_joint(mujoco: Any, frame: Any, joint: Joint | None, base: Base) -> None:
    """Add the joint that carries a body, in its frame; none for a fixed one."""
    if joint is None:
        if base is Base.FREE:
            frame.add_freejoint(name=f"{frame.name}_free")
        return
    if joint.type is JointType.FIXED:
        return
    slides = joint.type is JointType.PRISMATIC
    kind = mujoco.mjtJoint.mjJNT_SLIDE if slides else mujoco.mjtJoint.mjJNT_HINGE
    added = frame.add_joint(name=joint.name, type=kind, axis=joint.axis, frictionloss=joint.friction)
    added.damping = [joint.damping, 0, 0]
    added.limited = int(joint.limits is not None)
    if joint.limits is not None:
        added.range = joint.limits
    added.actfrclimited, added.actfrcrange = 1, [-joint.effort, joint.effort]


def _add_geoms(
    mujoco: Any, spec: Any, frame: Any, body: ExportLink, looks: Iterable[GeomMaterial], names: Sequence[str]
) -> None:
    for look in looks:
        mesh = spec.add_mesh(name=look.name, file=look.path)
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL  # a sheet has no volume
        geom = frame.add_geom(spec.find_default(VISUAL), name=look.name, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=look.name)
        if look.material is None:
            geom.rgba = look.rgba
        else:
            geom.material = names[look.material]
    for number, (shape, path) in enumerate(zip(body.shapes, body.hull_paths(), strict=True)):
        geom = frame.add_geom(spec.find_default(COLLISION), name=f"{body.name}_collision_{number}")
        _shape(mujoco, spec, geom, shape, path)


def _shape(mujoco: Any, spec: Any, geom: Any, shape: Shape, path: str | None) -> None:
    if not isinstance(shape, Hull):
        geom.pos, geom.quat = shape.center, quaternion(shape.rotation)
    match shape:
        case Box():
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_BOX, shape.size / 2
        case Cylinder():
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_CYLINDER, [shape.radius, shape.length / 2, 0]
        case Hull():
            mesh = spec.add_mesh(name=geom.name, file=path)
            geom.type, geom.meshname = mujoco.mjtGeom.mjGEOM_MESH, mesh.name
        case _:
            assert_never(shape)


def _add_drive(mujoco: Any, spec: Any, model: Model, name: str, drive: Drive) -> None:
    joint = next(j for j in model.asset.joints if j.name == name)
    motor = spec.add_actuator(name=name, target=name, trntype=mujoco.mjtTrn.mjTRN_JOINT, group=DRIVES)
    motor.forcelimited, motor.forcerange = 1, [-drive.effort, drive.effort]
    if model.driven is Driven.PASSIVE:
        motor.set_to_motor()
        motor.ctrllimited, motor.ctrlrange = 1, [-drive.effort, drive.effort]
        return
    motor.set_to_position(kp=drive.stiffness, kv=drive.damping)
    if joint.limits is not None:
        motor.ctrllimited, motor.ctrlrange = 1, joint.limits
