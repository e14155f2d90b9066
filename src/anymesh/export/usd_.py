"""USD: one binary stage, Z up, metres and kilograms, with UsdPhysics and the joint attributes of PhysX and Newton."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import ModuleType
from typing import Any, assert_never

import numpy as np

from anymesh.errors import MissingExtraError
from anymesh.export.drives import Drive, drives
from anymesh.export.materials import write_textures
from anymesh.export.model import FOLDER, Base, ExportLink, Model
from anymesh.export.rotations import principal, quaternion, turning_x_to
from anymesh.export.settings import ExportConfig
from anymesh.export.usd_materials_ import UsdMaterials
from anymesh.names import legal_names
from anymesh.types import Box, Cylinder, Hull, Joint, JointType, Shape
from anymesh.types.mesh import TEXTURE_SLOTS

NOISE = 1e-12  # [m, kg m^2] smaller values are rounding


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
        raise MissingExtraError("USD is not installed; install it with `pip install articulate-anymesh[usd]`") from error
    return pxr


def write_usd(model: Model, folder: Path, config: ExportConfig) -> None:
    """Write <name>.usdc into an asset folder, and the textures that it refers to into its meshes/.

    Links are siblings under /<name>/links, each at its origin; joints are under /<name>/joints, materials under
    /<name>/materials.

    Raise MissingExtraError without OpenUSD.
    """
    pxr = load_usd()
    (folder / FOLDER).mkdir(exist_ok=True)
    textures = write_textures(model.asset.mesh, folder / FOLDER, TEXTURE_SLOTS)
    stage = pxr.Usd.Stage.CreateInMemory()
    pxr.UsdGeom.SetStageUpAxis(stage, pxr.UsdGeom.Tokens.z)
    pxr.UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    pxr.UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    top = f"/{model.asset.name}"
    root = pxr.UsdGeom.Xform.Define(stage, top).GetPrim()
    stage.SetDefaultPrim(root)
    pxr.UsdPhysics.ArticulationRootAPI.Apply(root)
    for scope in ("links", "joints", "materials"):
        pxr.UsdGeom.Scope.Define(stage, f"{top}/{scope}")
    looks = UsdMaterials(pxr, stage, f"{top}/materials", model.asset.mesh, textures)
    for body in model.bodies:
        _add_body(pxr, stage, top, body, looks, config)
    _add_exclusions(pxr, stage, top, model)
    _add_root_joint(pxr, stage, top, model)
    motors = drives(model)
    for joint in model.asset.joints:
        _add_joint(pxr, stage, top, model, joint, motors)
    scene = legal_names([model.asset.name, "physics_scene"])[-1]
    pxr.UsdPhysics.Scene.Define(stage, f"/{scene}")  # beside the asset, so that a reference to it adds no second scene
    stage.GetRootLayer().Export(str(folder / f"{model.asset.name}.usdc"))


def _link(top: str, name: str) -> str:
    return f"{top}/links/{name}"


def _vec(pxr: Any, values: np.ndarray) -> Any:
    return pxr.Gf.Vec3f(*(float(v) if abs(v) > NOISE else 0.0 for v in values))


def _quat(pxr: Any, rotation: np.ndarray) -> Any:
    return pxr.Gf.Quatf(*(float(v) for v in quaternion(rotation)))


def _add_body(pxr: Any, stage: Any, top: str, body: ExportLink, looks: UsdMaterials, config: ExportConfig) -> None:
    frame = pxr.UsdGeom.Xform.Define(stage, _link(top, body.name))
    frame.AddTranslateOp().Set(pxr.Gf.Vec3d(*(float(v) for v in body.link.origin)))
    prim = frame.GetPrim()
    pxr.UsdPhysics.RigidBodyAPI.Apply(prim)
    mass = pxr.UsdPhysics.MassAPI.Apply(prim)
    moments, axes = principal(body.inertia.tensor)
    mass.CreateMassAttr(float(body.inertia.mass))
    mass.CreateCenterOfMassAttr(_vec(pxr, body.inertia.center))
    mass.CreateDiagonalInertiaAttr(_vec(pxr, moments))
    mass.CreatePrincipalAxesAttr(_quat(pxr, axes))
    looks.add_visual(f"{prim.GetPath()}/visual", body.link, config)
    for index, shape in enumerate(body.shapes):
        geometry = _add_shape(pxr, stage, f"{prim.GetPath()}/collision_{index}", shape)
        geometry.CreatePurposeAttr(pxr.UsdGeom.Tokens.guide)  # not drawn
        pxr.UsdPhysics.CollisionAPI.Apply(geometry.GetPrim())


def _add_shape(pxr: Any, stage: Any, path: str, shape: Shape) -> Any:
    match shape:
        case Box():
            geometry = pxr.UsdGeom.Cube.Define(stage, path)
            geometry.CreateSizeAttr(1.0)
            geometry.CreateExtentAttr([(-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)])
            _place(pxr, geometry, shape)
            geometry.AddScaleOp().Set(_vec(pxr, shape.size))
        case Cylinder():
            geometry = pxr.UsdGeom.Cylinder.Define(stage, path)
            geometry.CreateAxisAttr(pxr.UsdGeom.Tokens.z)
            geometry.CreateRadiusAttr(float(shape.radius))
            geometry.CreateHeightAttr(float(shape.length))
            corner = np.array([shape.radius, shape.radius, shape.length / 2])
            geometry.CreateExtentAttr([_vec(pxr, -corner), _vec(pxr, corner)])
            _place(pxr, geometry, shape)
        case Hull():
            geometry = pxr.UsdGeom.Mesh.Define(stage, path)
            vertices = np.ascontiguousarray(shape.vertices, np.float32)
            geometry.CreatePointsAttr(pxr.Vt.Vec3fArray.FromNumpy(vertices))
            geometry.CreateFaceVertexCountsAttr([3] * len(shape.faces))
            geometry.CreateFaceVertexIndicesAttr(shape.faces.reshape(-1).tolist())
            geometry.CreateSubdivisionSchemeAttr(pxr.UsdGeom.Tokens.none)
            geometry.CreateExtentAttr([_vec(pxr, vertices.min(0)), _vec(pxr, vertices.max(0))])
            approximation = pxr.UsdPhysics.MeshCollisionAPI.Apply(geometry.GetPrim())
            approximation.CreateApproximationAttr(pxr.UsdPhysics.Tokens.convexHull)
        case _:
            assert_never(shape)
    return geometry


def _place(pxr: Any, geometry: Any, shape: Box | Cylinder) -> None:
    geometry.AddTranslateOp().Set(pxr.Gf.Vec3d(*(float(v) for v in shape.center)))
    geometry.AddOrientOp().Set(_quat(pxr, shape.rotation))


def _add_exclusions(pxr: Any, stage: Any, top: str, model: Model) -> None:
    for pair in model.exclusions:
        filtered = pxr.UsdPhysics.FilteredPairsAPI.Apply(stage.GetPrimAtPath(_link(top, pair.a)))
        filtered.CreateFilteredPairsRel().AddTarget(_link(top, pair.b))


def _add_root_joint(pxr: Any, stage: Any, top: str, model: Model) -> None:
    """Fix the root to the place of the asset; the other side of the joint is the asset's frame, which is no body."""
    if model.base is Base.FREE:
        return
    name = legal_names([*(j.name for j in model.asset.joints), "fixed_base"], fallback="joint")[-1]
    fixed = pxr.UsdPhysics.FixedJoint.Define(stage, f"{top}/joints/{name}")
    fixed.CreateBody0Rel().SetTargets([top])
    fixed.CreateBody1Rel().SetTargets([_link(top, model.bodies[0].name)])


def _add_joint(pxr: Any, stage: Any, top: str, model: Model, joint: Joint, motors: Mapping[str, Drive]) -> None:
    origins = {link.name: link.origin for link in model.links}
    kinds = {JointType.FIXED: pxr.UsdPhysics.FixedJoint, JointType.PRISMATIC: pxr.UsdPhysics.PrismaticJoint}
    added = kinds.get(joint.type, pxr.UsdPhysics.RevoluteJoint).Define(stage, f"{top}/joints/{joint.name}")
    added.CreateBody0Rel().SetTargets([_link(top, joint.parent)])
    added.CreateBody1Rel().SetTargets([_link(top, joint.child)])
    added.CreateLocalPos0Attr(_vec(pxr, origins[joint.child] - origins[joint.parent]))
    added.CreateLocalPos1Attr(pxr.Gf.Vec3f(0))
    turned = np.eye(3) if joint.type is JointType.FIXED else turning_x_to(joint.axis)
    added.CreateLocalRot0Attr(_quat(pxr, turned))
    added.CreateLocalRot1Attr(_quat(pxr, turned))
    excluded = {frozenset((pair.a, pair.b)) for pair in model.exclusions}
    added.CreateCollisionEnabledAttr(frozenset((joint.parent, joint.child)) not in excluded)
    if joint.type is JointType.FIXED:
        return
    added.CreateAxisAttr(pxr.UsdGeom.Tokens.x)
    per_unit = 1.0 if joint.type is JointType.PRISMATIC else float(np.pi / 180)  # USD's angles are in degrees
    if joint.limits is not None:
        added.CreateLowerLimitAttr(joint.limits[0] / per_unit)
        added.CreateUpperLimitAttr(joint.limits[1] / per_unit)
    kind = "linear" if joint.type is JointType.PRISMATIC else "angular"
    motor = motors[joint.name]
    drive = pxr.UsdPhysics.DriveAPI.Apply(added.GetPrim(), kind)
    drive.CreateTypeAttr(pxr.UsdPhysics.Tokens.force)
    drive.CreateMaxForceAttr(motor.effort)
    drive.CreateTargetPositionAttr(0.0)
    drive.CreateStiffnessAttr(motor.stiffness * per_unit)
    drive.CreateDampingAttr(motor.damping * per_unit)
    _add_resistance(pxr, added.GetPrim(), joint, kind, per_unit)


def _add_resistance(pxr: Any, prim: Any, joint: Joint, kind: str, per_unit: float) -> None:
    """Add damping, dry friction and velocity as attributes of PhysX and of Newton, since UsdPhysics has none."""
    values = {
        f"physxJointAxis:{kind}:maxJointVelocity": joint.velocity / per_unit,
        f"physxJointAxis:{kind}:staticFrictionEffort": joint.friction,
        f"physxJointAxis:{kind}:dynamicFrictionEffort": joint.friction,
        f"physxJointAxis:{kind}:viscousFrictionCoefficient": joint.damping * per_unit,
        "newton:velocityLimit": joint.velocity / per_unit,
        "newton:friction": joint.friction,
        "newton:damping": joint.damping * per_unit,
    }
    prim.AddAppliedSchema(f"PhysxJointAxisAPI:{kind}")
    prim.AddAppliedSchema("NewtonJointAPI")
    for name, value in values.items():
        prim.CreateAttribute(name, pxr.Sdf.ValueTypeNames.Float, custom=False).Set(float(value))
