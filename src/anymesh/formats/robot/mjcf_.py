"""MJCF: a MuJoCo model built with MuJoCo's own spec, compiled before it is written.

MuJoCo reads one material per mesh, and PNG only. Its XML is written again with ten digits instead of six, and with position
actuators in a form that all versions read.
"""

from __future__ import annotations

import io
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, assert_never
from xml.etree import ElementTree

import numpy as np
from jaxtyping import Float
from PIL import Image

from anymesh.errors import OutputError
from anymesh.export.meshes import display_color, material_names, painted, texture_files, visible, with_four_corners, write_obj
from anymesh.export.model import FOLDER, Drive, ExportConfig, ExportLink, Model, drives
from anymesh.export.notation import moments, number, quaternion, vector
from anymesh.export.options import Base, Driven
from anymesh.mechanisms.equalities import add_equalities, lift_name, lifts
from anymesh.mujoco_ import load_mujoco
from anymesh.names import legal_names
from anymesh.physics.mechanism import Mechanism
from anymesh.physics.resistance import Resistance
from anymesh.types import Box, Cylinder, Hull, Joint, JointType, Material, Mesh, Shape
from anymesh.types.exchange import PNG

PIECES = f"{FOLDER}/mjcf"  # separate folder: `door_2.obj` in it is the second material of door, not a link door_2
VISUAL, COLLISION = "visual", "collision"
MJCF_SLOTS = ("base_color", "normal", "emissive")
BLENDED = 0.99  # opacity below which MuJoCo blends, so that the alpha of a picture counts
FIRM = {  # else what friction holds creeps, a knob by turns per second, and springs press parts into their stops
    "solreflimit": "0.004 1",
    "solimplimit": "0.99 0.999 0.001",
    "solreffriction": "0.004 1",
    "solimpfriction": "0.9999 0.9999 0.001",
}
CATCHES = 2  # group of the actuators that are catches and detents, which no command moves
HANDLES, PLATE = 4, 5e-4  # group of the sites, which viewers hide at first; half thickness [m]
# [bytes] larger visual meshes are not loaded to compile the model: of a million faces, that takes 2 s and 700 MB
MOST_COMPILED, STAND_IN = 4 << 20, b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
PLACES = 5  # group of the sites of places
DRIVES = 1  # group of the actuators: `actuatorgroupdisable="1"` makes the asset passive


def write_mjcf(model: Model, folder: Path, config: ExportConfig) -> None:
    """Write <name>.xml into an asset folder with its meshes/, and files specific to MuJoCo into meshes/mjcf/.

    Contacts between a link and its parent count, as with a fixed root, unless they are excluded.

    Raise MissingExtraError without MuJoCo, OutputError if it cannot compile the model.
    """
    mujoco, model, files = load_mujoco(), model.tiled, texture_files(model.tinted.asset.mesh, model.tiled.asset.mesh)
    spec = _spec(mujoco, model, folder)
    looks = {body.name: geom_materials(model.asset.mesh, body, folder, config) for body in model.bodies}
    shown = {look.material: look for body_looks in looks.values() for look in body_looks if look.material is not None}
    _add_materials(mujoco, spec, model.asset.mesh, shown, png_textures(model.asset.mesh, folder, shown, files))
    names = material_names(model.asset.mesh.materials)
    frames: dict[str, Any] = {}
    for body in _parents_first(model):
        joint = body.link.joint
        parent = spec.worldbody if joint is None or joint.type is JointType.FREE else frames[joint.parent]
        frames[body.name] = _add_body(model, body, parent)
        _add_joint(mujoco, frames[body.name], joint, model)
        _add_geoms(mujoco, spec, frames[body.name], body, looks[body.name], names)
    for pair in model.exclusions:
        spec.add_exclude(bodyname1=pair.a, bodyname2=pair.b)
    motors = drives(model)
    for name, drive in motors.items():
        _add_drive(mujoco, spec, model, name, drive)
    try:
        compiled = spec.compile()
    except ValueError as error:
        raise OutputError(f"MuJoCo cannot compile {model.asset.name}: {error}") from error
    text = with_digits(spec.to_xml(), model, motors, compiled)
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


def _add_materials(
    mujoco: Any, spec: Any, mesh: Mesh, looks: Mapping[int, GeomMaterial], files: Mapping[tuple[int, str], str]
) -> None:
    """Add the materials and textures that geoms use; MuJoCo's own renderer shows the base colour, others more."""
    roles = mujoco.mjtTextureRole
    slots = dict(zip(MJCF_SLOTS, (roles.mjTEXROLE_RGB, roles.mjTEXROLE_NORMAL, roles.mjTEXROLE_EMISSIVE), strict=True))
    clear = {path for (k, slot), path in files.items() if slot == "base_color" and _clear(mesh.materials[k])}
    for path in sorted(set(files.values())):
        channels = 4 if path in clear else 3
        spec.add_texture(name=Path(path).stem, file=path, type=mujoco.mjtTexture.mjTEXTURE_2D, nchannel=channels)
    names = material_names(mesh.materials)
    for index, look in sorted(looks.items()):
        source = mesh.materials[index]
        rgba = (*look.rgba[:3], min(look.rgba[3], BLENDED)) if _clear(source) else look.rgba
        material = spec.add_material(name=names[index], rgba=rgba, metallic=source.metallic, roughness=source.roughness)
        material.emission = 0.0 if "emissive" in source.textures else min(1.0, float(max(source.emissive)))
        textures = list(material.textures)
        for slot, role in slots.items():
            if (index, slot) in files:
                textures[int(role)] = Path(files[index, slot]).stem
        material.textures = textures


def _clear(m: Material) -> bool:
    """Return whether the alpha of the base colour's picture counts."""
    return m.alpha_mode != "OPAQUE" and "base_color" in m.textures and m.textures["base_color"].transparent


def _add_body(model: Model, body: ExportLink, parent: Any) -> Any:
    frame = parent.add_body(name=body.name, pos=_place(model, body))
    frame.explicitinertial, frame.mass, frame.ipos = True, body.inertia.mass, body.inertia.center
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = body.inertia.tensor
    frame.fullinertia = [xx, yy, zz, xy, xz, yz]
    return frame


def _place(model: Model, body: ExportLink) -> Float[np.ndarray, " 3"]:
    """Return where a body lies in the one around it: its parent, or the world if it is the root or free."""
    joint = body.link.joint
    within = None if joint is None or joint.type is JointType.FREE else joint.parent
    return body.link.origin - next((link.origin for link in model.links if link.name == within), np.zeros(3))


def _add_joint(mujoco: Any, frame: Any, joint: Joint | None, model: Model) -> None:
    """Add the joint that carries a body, in its frame; none for a fixed one."""
    if joint is None:
        if model.how.base is Base.FREE:
            frame.add_freejoint(name=f"{frame.name}_free")
        return
    if joint.type is JointType.FREE:
        frame.add_freejoint(name=joint.name)
    if joint.name not in model.resistances:
        return
    types, resistance = mujoco.mjtJoint, model.resistances[joint.name]
    kind = {JointType.PRISMATIC: types.mjJNT_SLIDE, JointType.BALL: types.mjJNT_BALL}.get(joint.type, types.mjJNT_HINGE)
    added = frame.add_joint(name=joint.name, type=kind, axis=joint.axis, armature=resistance.armature)
    if joint.type is JointType.SCREW:
        frame.add_joint(name=lift_name(joint), type=types.mjJNT_SLIDE, axis=joint.axis)
    added.frictionloss, added.damping = resistance.friction, [resistance.damping, 0, 0]
    added.limited = int(joint.limits is not None)
    if joint.limits is not None:
        added.range = joint.limits
    if joint.type is not JointType.BALL:
        added.actfrclimited, added.actfrcrange = 1, [-resistance.effort, resistance.effort]


def _add_geoms(
    mujoco: Any, spec: Any, frame: Any, body: ExportLink, looks: Iterable[GeomMaterial], names: Sequence[str]
) -> None:
    for look in looks:
        mesh = spec.add_mesh(name=look.name, file=look.path)
        if Path(spec.modelfiledir, look.path).stat().st_size > MOST_COMPILED:
            spec.assets = spec.assets | {look.path: STAND_IN}
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL  # a sheet has no volume
        geom = frame.add_geom(spec.find_default(VISUAL), name=look.name, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=look.name)
        if look.material is None:
            geom.rgba = look.rgba
        else:
            geom.material = names[look.material]
    for k, (shape, path, substance) in enumerate(body.collisions()):
        geom = frame.add_geom(spec.find_default(COLLISION), name=f"{body.name}_collision_{k}")
        if substance is not None:
            geom.friction[0] = substance.dynamic_friction
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
    if model.how.drives is Driven.PASSIVE:
        motor.set_to_motor()
        motor.ctrllimited, motor.ctrlrange = 1, [-drive.effort, drive.effort]
        return
    motor.set_to_position(kp=drive.stiffness, kv=drive.damping)
    if joint.limits is not None:
        motor.ctrllimited, motor.ctrlrange = 1, joint.limits


@dataclass(frozen=True)
class GeomMaterial:
    """A visual geom. path: relative to the asset folder; material: into the mesh's, None for a colour only; rgba: sRGB."""

    name: str
    path: str
    material: int | None
    rgba: tuple[float, ...]


def geom_materials(mesh: Mesh, body: ExportLink, folder: Path, config: ExportConfig) -> list[GeomMaterial]:
    """Return the visual geoms of a body: its visual OBJ, or one OBJ per material, written here, if it has several."""
    primitives = visible(body.link, config)
    names = material_names(mesh.materials)
    geoms = []
    for k, p in enumerate(primitives):
        path = body.visual_path()
        if len(primitives) > 1:
            (folder / PIECES).mkdir(exist_ok=True)
            path = f"{PIECES}/{body.name}_{k}.obj"
            write_obj(folder / path, body.name, None, [with_four_corners(p)], names)
        material = None if painted(mesh, p) else p.material
        geoms.append(GeomMaterial(f"{body.name}_visual_{k}", path, material, display_color(mesh, p)))
    return geoms


def png_textures(mesh: Mesh, folder: Path, used: Collection[int], files: Mapping[bytes, str]) -> dict[tuple[int, str], str]:
    """Write the textures of some materials as PNG beside the others, named alike; return their paths by material and slot."""
    paths: dict[tuple[int, str], str] = {}
    for index in sorted(used):
        for slot, texture in mesh.materials[index].textures.items():
            if slot not in MJCF_SLOTS or texture.data not in files:
                continue
            path = f"{FOLDER}/{Path(files[texture.data]).stem}.png"
            (folder / path).write_bytes(_png(texture.data))
            paths[index, slot] = path
    return paths


def _png(data: bytes) -> bytes:
    """Return the bytes of a PNG unchanged, and another image converted."""
    if data.startswith(PNG):
        return data
    file = io.BytesIO()
    Image.open(io.BytesIO(data)).convert("RGB").save(file, "PNG")
    return file.getvalue()


def with_digits(text: str, model: Model, motors: Mapping[str, Drive], compiled: Any) -> str:
    """Return the MJCF of a model, as compiled, with its numbers at full precision; elements are found by name."""
    root = ElementTree.fromstring(text)
    origins = {link.name: link.origin for link in model.links}
    bodies = {element.get("name"): element for element in root.iter("body")}
    for body in model.bodies:
        element = bodies[body.name]
        if body.link.joint is not None:
            element.set("pos", vector(_place(model, body)))
        _inertial(element, body)
        _geoms(element, body)
    for handle in model.handles:  # a plate on its surface
        place, size = vector(handle.place - origins[handle.link]), vector((*handle.size[:2] / 2, PLATE))
        words = {"name": handle.name, "type": "box", "pos": place, "quat": vector(quaternion(handle.R)), "size": size}
        ElementTree.SubElement(bodies[handle.link], "site", words, group=str(HANDLES))
    for at in model.places:
        middle, turned = at.place + at.size[2] / 2 * at.R[:, 2] - origins[at.link], vector(quaternion(at.R))
        words = {"name": at.name, "type": "box", "pos": vector(middle), "quat": turned, "size": vector(at.size / 2)}
        ElementTree.SubElement(bodies[at.link], "site", words, group=str(PLACES), rgba="0.2 0.6 1 0.3")
    joints = {element.get("name"): element for element in root.iter("joint")}
    for joint in model.asset.joints:
        if joint.type is JointType.SCREW:
            joints[lift_name(joint)].set("axis", vector(joint.axis / np.linalg.norm(joint.axis)))
        if joint.name in model.resistances:
            _joint(joints[joint.name], joint, model.resistances[joint.name], model.mechanisms.get(joint.name))
    for element in root.iter("texture"):
        element.attrib.pop("colorspace", None)  # inferred at compile time; older versions do not know the attribute
    actuators = root.find("actuator")
    if actuators is not None:
        _actuators(actuators, model, motors)
        _catches(actuators, model)
    add_equalities(root, model)
    _add_keyframes(root, model, compiled)
    if credits := model.asset.source.credits:  # by MuJoCo's spec, some texts would be written as XML that is broken
        custom = ElementTree.SubElement(root, "custom")
        for key, value in credits.items():
            ElementTree.SubElement(custom, "text", name=f"credits_{key}", data=value)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode") + "\n"


def _add_keyframes(root: ElementTree.Element, model: Model, compiled: Any) -> None:
    """Add a keyframe for each state, in which position drives are commanded to stay there."""
    driven = [str(e.get("joint")) if e.tag == "position" else "" for e in root.iterfind("actuator/*")]
    keys = ElementTree.SubElement(root, "keyframe") if model.states else root
    for name, at in model.states.items():
        qpos = compiled.qpos0.copy()
        for joint, position in {**at, **lifts(model.asset, at)}.items():
            qpos[compiled.joint(joint).qposadr[0]] = position
        ctrl = {"ctrl": vector([at.get(joint, 0.0) for joint in driven])} if any(driven) else {}
        ElementTree.SubElement(keys, "key", {"name": name, "qpos": vector(qpos), **ctrl})


def _inertial(element: ElementTree.Element, body: ExportLink) -> None:
    inertial = element.find("inertial")
    if inertial is None:
        raise ValueError(f"body {body.name!r} was written without its inertia")
    entries = moments(body.inertia.tensor)
    inertial.attrib.clear()
    inertial.set("pos", vector(body.inertia.center))
    inertial.set("mass", number(body.inertia.mass))
    inertial.set("fullinertia", " ".join(entries[key] for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")))


def _joint(element: ElementTree.Element, joint: Joint, resistance: Resistance, mechanism: Mechanism | None) -> None:
    if joint.type is not JointType.BALL:
        element.set("axis", vector(joint.axis / np.linalg.norm(joint.axis)))
        element.set("actuatorfrcrange", vector((-resistance.effort, resistance.effort)))
    element.set("damping", number(resistance.damping))
    element.set("frictionloss", number(resistance.friction))
    if resistance.armature:
        element.set("armature", number(resistance.armature))
    if joint.limits is not None:
        element.set("range", vector(joint.limits))
    element.attrib.update(FIRM)
    if mechanism is not None:
        element.set("solimplimit", "0.9999 0.9999 0.001")  # a spring presses a light button through its stop else
    if mechanism is not None and mechanism.stiffness:
        element.attrib.update(stiffness=number(mechanism.stiffness), springref=number(mechanism.reference))


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
    passive = model.how.drives is Driven.PASSIVE
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


def _catches(actuators: ElementTree.Element, model: Model) -> None:
    """Add catches and detents: forces of the joint's position alone. Detents are the cogging of motors that nothing drives."""
    joints = [joint.name for joint in model.asset.joints]
    names = legal_names([*joints, *(f"{name}_{m.kind}" for name, m in model.mechanisms.items())])[len(joints) :]
    for name, (joint, m) in zip(names, model.mechanisms.items(), strict=True):
        words = {"name": name, "joint": joint, "group": str(CATCHES)}
        if m.slope:
            words |= {"gainprm": "0", "biastype": "affine", "biasprm": vector((-m.slope * m.at, m.slope, 0.0))}
            ElementTree.SubElement(actuators, "general", words, forcerange=vector((m.least, m.most)), forcelimited="true")
        if m.torque:
            words |= {"motorconst": "1e-9", "resistance": "1e9", "cogging": vector((m.torque, float(m.steps), np.pi))}
            ElementTree.SubElement(actuators, "dcmotor", words)
