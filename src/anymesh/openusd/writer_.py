"""USD: one binary stage, Z up, metres and kilograms, with UsdPhysics and the joint attributes of PhysX and Newton.

A link is one mesh, called after it, its materials are UsdPreviewSurface, its corner colours displayColor.
"""

from __future__ import annotations

import struct
import zipfile
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from types import ModuleType
from typing import Any

import numpy as np

from anymesh.errors import MissingExtraError, pip_install
from anymesh.export.meshes import texture_files, visible, write_textures
from anymesh.export.model import FOLDER, Drive, ExportConfig, ExportLink, Model, drives
from anymesh.export.notation import principal, turning_x_to
from anymesh.export.options import Base
from anymesh.formats.packed import EPOCH, PLAIN_FILE
from anymesh.formats.robot.urdf import LIGHT
from anymesh.mechanisms.places import PlaceFrame
from anymesh.mechanisms.serial import one_axis
from anymesh.names import legal_names
from anymesh.openusd.geometry_ import add_shape, add_visual, place, quat, vec
from anymesh.openusd.materials_ import UsdMaterials
from anymesh.openusd.states_ import add_states
from anymesh.physics.mechanism import HandleFrame, Mechanism
from anymesh.physics.resistance import Resistance
from anymesh.physics.substances import Substance
from anymesh.types import Hull, Joint, JointType, Loop, Mimic
from anymesh.types.mesh import TEXTURE_SLOTS
from anymesh.types.motion import leaders

# A USDZ is a zip without compression whose files begin at multiples of 64 bytes; the header of each is padded to that.
ALIGNED, HEADER, EXTRA, PADDING = 64, 30, 4, 0x1986


def load_usd() -> ModuleType:
    """Import OpenUSD. Raise MissingExtraError without it."""
    try:
        import pxr
        import pxr.Gf
        import pxr.Sdf
        import pxr.Usd
        import pxr.UsdGeom
        import pxr.UsdPhysics
        import pxr.UsdShade
        import pxr.Vt
    except ImportError as error:
        raise MissingExtraError(f"USD is not installed; install it with {pip_install('usd')}") from error
    return pxr


def write_usd(model: Model, folder: Path, config: ExportConfig) -> None:
    """Write <name>.usdc into an asset folder, and the textures that it refers to into its meshes/.

    Raise MissingExtraError without OpenUSD.
    """
    stage = usd_stage(model.tinted, config, folder, FOLDER)
    add_states(load_usd(), stage, model)
    stage.GetRootLayer().Export(str(folder / f"{model.asset.name}.usdc"))


def write_usdz(model: Model, folder: Path, config: ExportConfig) -> None:
    """Write <name>.usdz into an asset folder: the same stage with its textures, in one file.

    Raise MissingExtraError without OpenUSD.
    """
    name = model.asset.name
    with TemporaryDirectory(dir=folder) as made, (folder / f"{name}.usdz").open("wb") as sink:
        place = Path(made)
        write_usd(model, place, config)
        with zipfile.ZipFile(sink, "w", zipfile.ZIP_STORED) as archive:
            for file in (place / f"{name}.usdc", *sorted((place / FOLDER).iterdir())):  # the stage is first, as specified
                entry = zipfile.ZipInfo(file.relative_to(place).as_posix(), EPOCH)
                entry.external_attr, entry.create_system = PLAIN_FILE, 3
                gap = -(sink.tell() + HEADER + len(entry.filename) + EXTRA) % ALIGNED
                entry.extra = struct.pack("<HH", PADDING, gap) + bytes(gap)
                archive.writestr(entry, file.read_bytes())


def usd_stage(model: Model, config: ExportConfig, folder: Path, pictures: str) -> Any:
    """Return a stage of a tinted model, and write the textures that it refers to into the folder `pictures` of a folder.

    Links are siblings under /<name>/links, each at its origin; joints are under /<name>/joints, materials under
    /<name>/materials, physics materials under /<name>/surfaces.
    """
    pxr = load_usd()
    (folder / pictures).mkdir(parents=True, exist_ok=True)
    textures = texture_files(model.asset.mesh)
    write_textures(model.asset.mesh, folder / pictures, TEXTURE_SLOTS, textures)
    stage = pxr.Usd.Stage.CreateInMemory()
    pxr.UsdGeom.SetStageUpAxis(stage, pxr.UsdGeom.Tokens.z)
    pxr.UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    pxr.UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    if credits := model.asset.source.credits:
        stage.GetRootLayer().customLayerData = {"credits": dict(credits)}
    top = f"/{model.asset.name}"
    root = pxr.UsdGeom.Xform.Define(stage, top).GetPrim()
    stage.SetDefaultPrim(root)
    pxr.UsdPhysics.ArticulationRootAPI.Apply(root)
    for scope in ("links", "joints", "materials"):
        pxr.UsdGeom.Scope.Define(stage, f"{top}/{scope}")
    looks = UsdMaterials(pxr, stage, f"{top}/materials", model.asset.mesh, f"./{pictures}", textures)
    for body in model.bodies:
        _add_body(pxr, stage, top, body, looks, config)
    _add_exclusions(pxr, stage, top, model)
    _add_root_joint(pxr, stage, top, model)
    for handle in model.handles:
        frame = _add_frame(pxr, stage, top, model, handle)
        for name, value in zip(("length", "width", "depth"), handle.size, strict=True):
            frame.CreateAttribute(f"handle:{name}", pxr.Sdf.ValueTypeNames.Float).Set(float(value))
    for at in model.places:
        frame = _add_frame(pxr, stage, top, model, at)
        frame.CreateAttribute("place:size", pxr.Sdf.ValueTypeNames.Float3).Set(vec(pxr, at.size))
        frame.CreateAttribute("place:inside", pxr.Sdf.ValueTypeNames.Bool).Set(at.inside)
    motors = drives(model)
    ways, taken = leaders(model.asset.joints), [*(b.name for b in model.bodies), *(j.name for j in model.asset.joints)]
    ordered = sorted(model.asset.joints, key=lambda joint: joint.name in ways)  # a follower's schema depends on its leader
    for joint in (replace(j, mimic=ways.get(j.name)) for j in ordered if j.type is not JointType.FREE):
        steps = (joint,) if joint.type is JointType.BALL else one_axis(joint, taken, model.asset.mesh.diagonal)
        for step in steps:
            _add_joint(pxr, stage, top, model, step, motors)
            if step.child != joint.child:
                _add_light_body(pxr, stage, top, next(b for b in model.bodies if b.name == joint.child), step.child)
    for loop in model.asset.loops:
        _add_loop(pxr, stage, model, loop)
    scene = legal_names([model.asset.name, "physics_scene"])[-1]
    pxr.UsdPhysics.Scene.Define(stage, f"/{scene}")  # beside the asset, so that a reference to it adds no second scene
    return stage


def _link(top: str, name: str) -> str:
    return f"{top}/links/{name}"


def _add_body(pxr: Any, stage: Any, top: str, body: ExportLink, looks: UsdMaterials, config: ExportConfig) -> None:
    prim = _add_light_body(pxr, stage, top, body, body.name, 1.0)
    primitives, path = visible(body.link, config), f"{prim.GetPath()}/{body.name}_visual"
    mesh, counts = add_visual(pxr, stage, path, primitives, looks.mesh)
    looks.add_subsets(mesh, primitives, counts)
    looks.bind(stage, path, primitives, str)
    for index, (shape, _, substance) in enumerate(body.collisions()):
        collider = add_shape(pxr, stage, f"{prim.GetPath()}/{body.name}_collision_{index}", shape).GetPrim()
        pxr.UsdPhysics.CollisionAPI.Apply(collider)
        if isinstance(shape, Hull):
            hull = pxr.UsdPhysics.MeshCollisionAPI.Apply(collider)
            hull.CreateApproximationAttr(pxr.UsdPhysics.Tokens.convexHull)
        if substance is not None:
            bind_surface(pxr, stage, collider, substance)


def _add_light_body(pxr: Any, stage: Any, top: str, body: ExportLink, name: str, share: float = LIGHT) -> Any:
    """Add a body at the place of a link with a share of its mass, and return its prim."""
    frame = pxr.UsdGeom.Xform.Define(stage, _link(top, name))
    place(pxr, frame, body.link.origin)
    prim = frame.GetPrim()
    pxr.UsdPhysics.RigidBodyAPI.Apply(prim)
    mass = pxr.UsdPhysics.MassAPI.Apply(prim)
    moments, axes = principal(body.inertia.tensor)
    mass.CreateMassAttr(share * float(body.inertia.mass))
    mass.CreateCenterOfMassAttr(vec(pxr, body.inertia.center))
    mass.CreateDiagonalInertiaAttr(vec(pxr, share * moments))
    mass.CreatePrincipalAxesAttr(quat(pxr, axes))
    return prim


def bind_surface(pxr: Any, stage: Any, collider: Any, substance: Substance) -> None:
    """Bind the physics material of a substance to a collider; it is written if it is not there."""
    scope = pxr.UsdGeom.Scope.Define(stage, f"{stage.GetDefaultPrim().GetPath()}/surfaces")
    material = pxr.UsdShade.Material.Define(stage, f"{scope.GetPath()}/{substance.name}")
    surface = pxr.UsdPhysics.MaterialAPI.Apply(material.GetPrim())
    surface.CreateStaticFrictionAttr(substance.static_friction)
    surface.CreateDynamicFrictionAttr(substance.dynamic_friction)
    surface.CreateRestitutionAttr(substance.restitution)
    surface.CreateDensityAttr(substance.density)
    pxr.UsdShade.MaterialBindingAPI.Apply(collider).Bind(material, pxr.UsdShade.Tokens.fallbackStrength, "physics")


def _add_exclusions(pxr: Any, stage: Any, top: str, model: Model) -> None:
    for pair in model.exclusions:
        filtered = pxr.UsdPhysics.FilteredPairsAPI.Apply(stage.GetPrimAtPath(_link(top, pair.a)))
        filtered.CreateFilteredPairsRel().AddTarget(_link(top, pair.b))


def _add_root_joint(pxr: Any, stage: Any, top: str, model: Model) -> None:
    """Fix the root to the place of the asset; the other side of the joint is the asset's frame, which is no body."""
    if model.how.base is Base.FREE:
        return
    name = legal_names([*(j.name for j in model.asset.joints), "fixed_base"], fallback="joint")[-1]
    fixed = pxr.UsdPhysics.FixedJoint.Define(stage, f"{top}/joints/{name}")
    fixed.CreateBody0Rel().SetTargets([top])
    fixed.CreateBody1Rel().SetTargets([_link(top, model.bodies[0].name)])


def _add_frame(pxr: Any, stage: Any, top: str, model: Model, at: HandleFrame | PlaceFrame) -> Any:
    """Add the frame of a handle or place below its link; return its prim."""
    frame = pxr.UsdGeom.Xform.Define(stage, f"{_link(top, at.link)}/{at.name}")
    place(pxr, frame, at.place - next(link.origin for link in model.links if link.name == at.link))
    frame.AddOrientOp().Set(quat(pxr, at.R))
    return frame.GetPrim()


def _add_joint(pxr: Any, stage: Any, top: str, model: Model, joint: Joint, motors: Mapping[str, Drive]) -> None:
    added = _between(pxr, stage, model, joint, joint.type, (joint.parent, joint.child))
    excluded = {frozenset((pair.a, pair.b)) for pair in model.exclusions}
    added.CreateCollisionEnabledAttr(frozenset((joint.parent, joint.child)) not in excluded)
    if joint.type is JointType.FIXED:
        return
    added.CreateAxisAttr(pxr.UsdGeom.Tokens.x)
    if joint.type is JointType.BALL:
        _add_ball(pxr, added, joint, model.resistances[joint.name])
        return
    per_unit = 1.0 if joint.type is JointType.PRISMATIC else float(np.pi / 180)  # USD's angles are in degrees
    if joint.limits is not None:
        added.CreateLowerLimitAttr(joint.limits[0] / per_unit)
        added.CreateUpperLimitAttr(joint.limits[1] / per_unit)
    kind = "linear" if joint.type is JointType.PRISMATIC else "angular"
    if joint.name in motors:
        motor = motors[joint.name]
        drive = pxr.UsdPhysics.DriveAPI.Apply(added.GetPrim(), kind)
        drive.CreateTypeAttr(pxr.UsdPhysics.Tokens.force)
        drive.CreateMaxForceAttr(motor.effort)
        drive.CreateTargetPositionAttr(0.0)
        drive.CreateStiffnessAttr(motor.stiffness * per_unit)
        drive.CreateDampingAttr(motor.damping * per_unit)
    if joint.name in model.resistances:
        _add_resistance(pxr, added.GetPrim(), model.resistances[joint.name], kind, per_unit)
    if joint.name in model.mechanisms:
        _add_mechanism(pxr, added.GetPrim(), model.mechanisms[joint.name], per_unit)
    if joint.mimic is not None:
        _add_mimic(pxr, stage, added.GetPrim(), joint.mimic, per_unit)


def _between(pxr: Any, stage: Any, model: Model, at: Joint | Loop, kind: JointType, links: tuple[str, str]) -> Any:
    """Add a joint of a kind between two links, whose X is the axis of what it stands for."""
    physics, origins = pxr.UsdPhysics, {link.name: link.origin for link in model.links}
    kinds = {JointType.FIXED: physics.FixedJoint, JointType.PRISMATIC: physics.PrismaticJoint}
    top, define = str(stage.GetDefaultPrim().GetPath()), {**kinds, JointType.BALL: physics.SphericalJoint}
    added = define.get(kind, physics.RevoluteJoint).Define(stage, f"{top}/joints/{at.name}")
    added.CreateBody0Rel().SetTargets([_link(top, links[0])])
    added.CreateBody1Rel().SetTargets([_link(top, links[1])])
    added.CreateLocalPos0Attr(vec(pxr, at.origin - origins.get(links[0], at.origin)))
    added.CreateLocalPos1Attr(vec(pxr, at.origin - origins.get(links[1], at.origin)))
    turned = np.eye(3) if kind is JointType.FIXED else turning_x_to(at.axis)
    added.CreateLocalRot0Attr(quat(pxr, turned))
    added.CreateLocalRot1Attr(quat(pxr, turned))
    return added


def _add_loop(pxr: Any, stage: Any, model: Model, loop: Loop) -> None:
    """Add a joint that closes a loop, which is no part of the tree."""
    added = _between(pxr, stage, model, loop, loop.kind, (loop.first, loop.second))
    added.CreateCollisionEnabledAttr(False)
    if loop.kind is not JointType.FIXED:
        added.CreateAxisAttr(pxr.UsdGeom.Tokens.x)
    added.CreateExcludeFromArticulationAttr(True)


def _add_ball(pxr: Any, added: Any, joint: Joint, r: Resistance) -> None:
    """Add the cone and the resistance of a ball, which only Newton has."""
    if joint.limits is not None:
        added.CreateConeAngle0LimitAttr(float(np.rad2deg(joint.limits[1])))
        added.CreateConeAngle1LimitAttr(float(np.rad2deg(joint.limits[1])))
    added.GetPrim().AddAppliedSchema("NewtonJointAPI")
    for name, value in (("friction", r.friction), ("damping", r.damping), ("armature", r.armature)):
        added.GetPrim().CreateAttribute(f"newton:{name}", pxr.Sdf.ValueTypeNames.Float, custom=False).Set(float(value))


def _add_mimic(pxr: Any, stage: Any, prim: Any, m: Mimic, per_unit: float) -> None:
    """Add what a joint follows, as Newton has it, and as PhysX has it, where a turn follows a turn.

    Newton multiplies positions in rad and m; PhysX does not let slides follow.
    """
    leader, kinds = prim.GetPath().GetParentPath().AppendChild(m.joint), pxr.Sdf.ValueTypeNames
    prim.AddAppliedSchema("NewtonMimicAPI")
    prim.CreateRelationship("newton:mimicJoint", custom=False).SetTargets([leader])
    values = {"newton:mimicCoef0": m.offset / per_unit, "newton:mimicCoef1": m.ratio}
    if per_unit != 1 and stage.GetPrimAtPath(leader).GetTypeName() == "PhysicsRevoluteJoint":
        prim.AddAppliedSchema("PhysxMimicJointAPI:rotX")
        prim.CreateRelationship("physxMimicJoint:rotX:referenceJoint", custom=False).SetTargets([leader])
        axis = prim.CreateAttribute("physxMimicJoint:rotX:referenceJointAxis", kinds.Token, False, pxr.Sdf.VariabilityUniform)
        axis.Set("rotX")
        values |= {"physxMimicJoint:rotX:gearing": -m.ratio, "physxMimicJoint:rotX:offset": -m.offset / per_unit}
    for name, value in values.items():
        prim.CreateAttribute(name, kinds.Float, custom=False).Set(float(value))


def _add_resistance(pxr: Any, prim: Any, r: Resistance, kind: str, per_unit: float) -> None:
    """Add damping, dry friction and velocity as attributes of PhysX and of Newton, since UsdPhysics has none."""
    values = {
        f"physxJointAxis:{kind}:maxJointVelocity": r.velocity / per_unit,
        f"physxJointAxis:{kind}:staticFrictionEffort": r.friction,
        f"physxJointAxis:{kind}:dynamicFrictionEffort": r.friction,
        f"physxJointAxis:{kind}:viscousFrictionCoefficient": r.damping * per_unit,
        "newton:velocityLimit": r.velocity / per_unit,
        "newton:friction": r.friction,
        "newton:damping": r.damping * per_unit,
        f"physxJointAxis:{kind}:armature": r.armature,
        "newton:armature": r.armature,
    }
    prim.AddAppliedSchema(f"PhysxJointAxisAPI:{kind}")
    prim.AddAppliedSchema("NewtonJointAPI")
    for name, value in values.items():
        prim.CreateAttribute(name, pxr.Sdf.ValueTypeNames.Float, custom=False).Set(float(value))


def _add_mechanism(pxr: Any, prim: Any, m: Mechanism, per_unit: float) -> None:
    """Add a spring as PhysX has it, a fixed tendon of one joint, and as MuJoCo and Newton have it.

    A drive is no spring: it is commanded, and Newton moves a target outside the limits, as a preload needs, to their middle.
    """
    kinds = pxr.Sdf.ValueTypeNames
    # without these, hinges creep that friction holds
    firm = {"mjc:solreffriction": [0.004, 1.0], "mjc:solimpfriction": [0.9999, 0.9999, 0.001, 0.5, 2.0]}
    values: list[tuple[str, Any, Any]] = [(name, kinds.DoubleArray, value) for name, value in firm.items()]
    if m.stiffness:
        tendon, axis = "physxTendon:spring", "transX" if per_unit == 1 else "rotX"
        values += [
            (f"{tendon}:stiffness", kinds.Float, m.stiffness),
            (f"{tendon}:restLength", kinds.Float, m.reference),
            (f"{tendon}:gearing", kinds.FloatArray, [per_unit]),
            (f"{tendon}:forceCoefficient", kinds.FloatArray, [1.0]),
            (f"{tendon}:jointAxis", kinds.TokenArray, [axis]),
            ("mjc:stiffness", kinds.Double, m.stiffness),
            ("mjc:springref", kinds.Double, m.reference / per_unit),
        ]
        prim.AddAppliedSchema("PhysxTendonAxisAPI:spring")
        prim.AddAppliedSchema("PhysxTendonAxisRootAPI:spring")
    prim.AddAppliedSchema("MjcJointAPI")
    for name, kind, value in values:
        fixed = pxr.Sdf.VariabilityUniform if name.startswith("mjc:") or "Axis" in name else pxr.Sdf.VariabilityVarying
        prim.CreateAttribute(name, kind, custom=False, variability=fixed).Set(value)
