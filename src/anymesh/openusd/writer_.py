"""USD: one binary stage, Z up, metres and kilograms, with UsdPhysics and the joint attributes of PhysX and Newton.

A link is one mesh, its materials are UsdPreviewSurface, its corner colours displayColor.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any, assert_never

import numpy as np

from anymesh.errors import MissingExtraError
from anymesh.export.links import Link, Primitive
from anymesh.export.meshes import GREY, material_names, painted, texture_files, visible, write_textures
from anymesh.export.model import FOLDER, Drive, ExportConfig, ExportLink, Model, drives
from anymesh.export.notation import principal, quaternion, turning_x_to
from anymesh.export.options import Base
from anymesh.names import legal_names
from anymesh.physics.mechanism import Mechanism
from anymesh.physics.resistance import Resistance
from anymesh.types import Box, Cylinder, Hull, Joint, JointType, Material, Mesh, Shape, Texture
from anymesh.types.mesh import TEXTURE_SLOTS, to_linear

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
    pxr, model = load_usd(), model.tinted
    (folder / FOLDER).mkdir(exist_ok=True)
    textures = texture_files(model.asset.mesh)
    write_textures(model.asset.mesh, folder / FOLDER, TEXTURE_SLOTS, textures)
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
    if model.how.base is Base.FREE:
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
    _add_resistance(pxr, added.GetPrim(), model.resistances[joint.name], kind, per_unit)
    if joint.name in model.mechanisms:
        _add_mechanism(pxr, added.GetPrim(), model.mechanisms[joint.name], per_unit)


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
    firm = {"mjc:solreffriction": [0.004, 1.0], "mjc:solimpfriction": [0.999, 0.999, 0.001, 0.5, 2.0]}
    values: list[tuple[str, Any, Any]] = [
        (name, kinds.DoubleArray, value) for name, value in firm.items()
    ]  # else hinges creep that friction holds
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
        prim.CreateAttribute(name, kind, custom=False).Set(value)


class UsdMaterials:
    """Writes visual meshes, and each material once on first use."""

    def __init__(self, pxr: Any, stage: Any, scope: str, mesh: Mesh, textures: Mapping[bytes, str]) -> None:
        self._pxr, self._stage, self._scope, self._mesh, self._textures = pxr, stage, scope, mesh, textures
        self._names = material_names(mesh.materials)
        self._made: dict[int, Any] = {}

    def add_visual(self, path: str, link: Link, config: ExportConfig) -> None:
        """Add the mesh of a link; several materials become face subsets."""
        pxr, primitives = self._pxr, visible(link, config)
        mesh = pxr.UsdGeom.Mesh.Define(self._stage, path)
        points = np.concatenate([p.positions for p in primitives]).astype(np.float32)
        offsets = np.cumsum([0, *(len(p.positions) for p in primitives)])
        faces = np.concatenate([p.triangles + start for p, start in zip(primitives, offsets, strict=False)])
        mesh.CreatePointsAttr(pxr.Vt.Vec3fArray.FromNumpy(points))
        mesh.CreateFaceVertexCountsAttr(pxr.Vt.IntArray.FromNumpy(np.full(len(faces), 3, np.int32)))
        mesh.CreateFaceVertexIndicesAttr(pxr.Vt.IntArray.FromNumpy(faces.reshape(-1).astype(np.int32)))
        mesh.CreateSubdivisionSchemeAttr(pxr.UsdGeom.Tokens.none)
        mesh.CreateExtentAttr(pxr.Vt.Vec3fArray.FromNumpy(np.array([points.min(0), points.max(0)])))
        sides = [self._mesh.materials[p.material].double_sided for p in primitives if p.material >= 0]
        mesh.CreateDoubleSidedAttr(any(sides))
        self._add_primvars(mesh, primitives)
        self._bind(mesh, primitives)

    def _add_primvars(self, mesh: Any, primitives: Sequence[Primitive]) -> None:
        """Add normals, texture coordinates (v up, as in USD) and colours of the corners."""
        pxr, kinds = self._pxr, self._pxr.Sdf.ValueTypeNames
        api, vertex = pxr.UsdGeom.PrimvarsAPI(mesh), pxr.UsdGeom.Tokens.vertex
        normals = [p.normals for p in primitives if p.normals is not None]
        uv = [p.uv for p in primitives if p.uv is not None]
        if len(normals) == len(primitives):
            mesh.CreateNormalsAttr(pxr.Vt.Vec3fArray.FromNumpy(np.concatenate(normals).astype(np.float32)))
            mesh.SetNormalsInterpolation(vertex)
        if len(uv) == len(primitives):
            st = api.CreatePrimvar("st", kinds.TexCoord2fArray, vertex)
            st.Set(pxr.Vt.Vec2fArray.FromNumpy(np.concatenate(uv).astype(np.float32)))
        more = [p.more_uv for p in primitives if p.more_uv is not None]
        for k in range(more[0].shape[1] // 2 if more else 0):
            st = api.CreatePrimvar(f"st{k + 1}", kinds.TexCoord2fArray, vertex)
            st.Set(pxr.Vt.Vec2fArray.FromNumpy(np.ascontiguousarray(np.concatenate(more)[:, 2 * k : 2 * k + 2])))
        if any(p.material < 0 or painted(self._mesh, p) for p in primitives):
            colors = np.concatenate([_colors(p) for p in primitives])
            display = mesh.CreateDisplayColorPrimvar(vertex)
            display.Set(pxr.Vt.Vec3fArray.FromNumpy(to_linear(colors[:, :3]).astype(np.float32)))
            if (colors[:, 3] < 1).any():
                opacity = mesh.CreateDisplayOpacityPrimvar(vertex)
                opacity.Set(pxr.Vt.FloatArray.FromNumpy(np.ascontiguousarray(colors[:, 3], np.float32)))

    def _bind(self, mesh: Any, primitives: Sequence[Primitive]) -> None:
        shade, start = self._pxr.UsdShade, 0
        for p in primitives:
            at, start = np.arange(start, start + len(p.triangles), dtype=np.int32), start + len(p.triangles)
            if p.material < 0 or painted(self._mesh, p):
                continue  # displayColor is used
            prim = mesh.GetPrim()
            if len(primitives) > 1:
                binding = shade.MaterialBindingAPI.Apply(prim)
                subset = binding.CreateMaterialBindSubset(self._names[p.material], self._pxr.Vt.IntArray.FromNumpy(at))
                prim = subset.GetPrim()
            shade.MaterialBindingAPI.Apply(prim).Bind(self._material(p.material))

    def _material(self, index: int) -> Any:
        if index not in self._made:
            self._made[index] = self._make(f"{self._scope}/{self._names[index]}", self._mesh.materials[index])
        return self._made[index]

    def _make(self, path: str, m: Material) -> Any:
        """Convert glTF's metallic-roughness model to UsdPreviewSurface; factors scale the textures."""
        pxr, kinds = self._pxr, self._pxr.Sdf.ValueTypeNames
        material = pxr.UsdShade.Material.Define(self._stage, path)
        surface = pxr.UsdShade.Shader.Define(self._stage, f"{path}/surface")
        surface.CreateIdAttr("UsdPreviewSurface")
        material.CreateSurfaceOutput().ConnectToSource(surface.ConnectableAPI(), "surface")
        alpha = m.base_color[3] if m.alpha_mode != "OPAQUE" else 1.0
        for name, kind, value in (
            ("diffuseColor", kinds.Color3f, pxr.Gf.Vec3f(*m.base_color[:3])),
            ("emissiveColor", kinds.Color3f, pxr.Gf.Vec3f(*m.emissive)),
            ("metallic", kinds.Float, m.metallic),
            ("roughness", kinds.Float, m.roughness),
            ("opacity", kinds.Float, alpha),
            ("opacityThreshold", kinds.Float, m.alpha_cutoff if m.alpha_mode == "MASK" else 0.0),
        ):
            surface.CreateInput(name, kind).Set(value)
        bump, shade = (m.textures[slot].strength if slot in m.textures else 1.0 for slot in ("normal", "occlusion"))
        reads = {
            "base_color": ("sRGB", m.base_color, (0, 0, 0, 0), {"diffuseColor": "rgb"}),
            "metallic_roughness": ("raw", (1, m.roughness, m.metallic, 1), (0, 0, 0, 0), {"roughness": "g", "metallic": "b"}),
            "normal": ("raw", (2 * bump, 2 * bump, 2, 1), (-bump, -bump, -1, 0), {"normal": "rgb"}),
            "occlusion": ("raw", (shade, shade, shade, 1), (*[1 - shade] * 3, 0), {"occlusion": "r"}),
            "emissive": ("sRGB", (*m.emissive, 1), (0, 0, 0, 0), {"emissiveColor": "rgb"}),
        }
        if m.alpha_mode != "OPAQUE":
            reads["base_color"][3]["opacity"] = "a"
        for slot, (space, scale, bias, outputs) in reads.items():
            if slot in m.textures and m.textures[slot].data in self._textures:
                shader = self._texture(path, slot, m.textures[slot], space)
                shader.CreateInput("scale", kinds.Float4).Set(pxr.Gf.Vec4f(*(float(v) for v in scale)))
                shader.CreateInput("bias", kinds.Float4).Set(pxr.Gf.Vec4f(*(float(v) for v in bias)))
                _connect(pxr, surface, shader, outputs)
        return material

    def _texture(self, path: str, slot: str, texture: Texture, space: str) -> Any:
        """Add a texture shader that reads its coordinates from `st`, or `st1` and so on."""
        pxr, kinds = self._pxr, self._pxr.Sdf.ValueTypeNames
        varname = f"st{texture.uv_set or ''}"
        reader = pxr.UsdShade.Shader.Define(self._stage, f"{path}/{varname}")
        reader.CreateIdAttr("UsdPrimvarReader_float2")
        reader.CreateInput("varname", kinds.String).Set(varname)
        shader = pxr.UsdShade.Shader.Define(self._stage, f"{path}/{slot}")
        shader.CreateIdAttr("UsdUVTexture")
        shader.CreateInput("file", kinds.Asset).Set(f"./{FOLDER}/{self._textures[texture.data]}")
        shader.CreateInput("sourceColorSpace", kinds.Token).Set(space)
        for name, wrap in zip(("wrapS", "wrapT"), texture.wrap, strict=True):
            shader.CreateInput(name, kinds.Token).Set(wrap)
        result = reader.CreateOutput("result", kinds.Float2)
        shader.CreateInput("st", kinds.Float2).ConnectToSource(result)
        return shader


def _connect(pxr: Any, surface: Any, shader: Any, outputs: Mapping[str, str]) -> None:
    kinds = pxr.Sdf.ValueTypeNames
    types = {"diffuseColor": kinds.Color3f, "emissiveColor": kinds.Color3f, "normal": kinds.Normal3f}
    for name, channel in outputs.items():
        output = shader.CreateOutput(channel, kinds.Float3 if channel == "rgb" else kinds.Float)
        surface.CreateInput(name, types.get(name, kinds.Float)).ConnectToSource(output)


def _colors(p: Primitive) -> np.ndarray:
    """Return (n, 4) sRGB and alpha 0..1 of the corners; grey for a primitive without colours and material."""
    if p.colors is not None:
        return p.colors / 255
    return np.tile(np.array(GREY if p.material < 0 else (1.0, 1, 1, 1)), (len(p.positions), 1))
