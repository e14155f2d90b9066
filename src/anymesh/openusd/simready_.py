"""An asset as NVIDIA's SimReady profile Robotics-Prop 4.0.0 asks for it: a folder of its own, with labels and metadata.

simready/<name>/simready_usd/<name>.usda     and beside it what `layered_` describes, and .thumbs/ with a picture
"""

from __future__ import annotations

import os
import shutil
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float
from PIL import Image

import anymesh
from anymesh.export.meshes import display_color, widest
from anymesh.export.model import ExportConfig, ExportLink, Model
from anymesh.geometry.raycast_ import RayScene
from anymesh.kinds.usual import kind_of
from anymesh.openusd.geometry_ import vec
from anymesh.openusd.layered_ import ENGINES, TEXTURES, LayeredAsset
from anymesh.openusd.writer_ import bind_surface, load_usd, usd_stage
from anymesh.physics.mechanism import HandleFrame
from anymesh.physics.resistance import Pull
from anymesh.physics.substances import Substance
from anymesh.rendering.drawing import Window, draw, ground, light_on, material_colors, render_target, sample, smoothed
from anymesh.rendering.viewpoints import orbit_camera
from anymesh.types import Asset
from anymesh.types.mesh import to_linear

SIMREADY = "simready"
INSIDE = "simready_usd"
THUMBNAIL = 256  # [px]
AZIMUTH, ELEVATION = 35.0, 24.0  # [deg] of the thumbnail
OBJECT = ("object", "Q223557")  # an unknown kind: a physical object
# A surface of unknown substance, which SimReady wants to have one: what PhysX gives it without.
UNKNOWN = Substance("unknown", 500.0, 0.0, 0.0, 0.0, static_friction=0.5, dynamic_friction=0.5, restitution=0.0)
REACH = 0.04  # [m] of the surface around a handle, about half of what a gripper's finger covers; an estimate
CLEAR = 0.01  # [m] by which the line leaves the handle on both sides
STEPS = 24  # directions that are tried
GRID = 12  # points along an edge of a triangle


def simready_file(name: str) -> str:
    """Return the file that others refer to, relative to the asset folder."""
    return f"{SIMREADY}/{name}/{INSIDE}/{name}.usda"


def write_simready(model: Model, folder: Path, config: ExportConfig) -> None:
    """Write simready/ anew into an asset folder. Raise MissingExtraError without OpenUSD."""
    pxr, model = load_usd(), model.tinted
    shutil.rmtree(folder / SIMREADY, ignore_errors=True)
    place = (folder / simready_file(model.asset.name)).parent
    stage = usd_stage(model, config, place / "payloads", TEXTURES)
    for body in model.bodies:
        _add_color(pxr, stage, model, body)
        _add_for_engines(pxr, stage, model, body)
    _add_labels(pxr, stage, model)
    _add_grasps(pxr, stage, model)
    layers = LayeredAsset(pxr, stage.GetRootLayer(), model.asset.name, place)
    layers.write({b.name: f"{b.name}_visual" for b in model.bodies}, _metadata(pxr, model))
    picture = place / f".thumbs/{THUMBNAIL}x{THUMBNAIL}/{model.asset.name}.usda.png"
    picture.parent.mkdir(parents=True)
    Image.fromarray(_thumbnail(model.asset)).save(picture, "PNG")


def kind_and_item(asset: Asset) -> tuple[str, str]:
    """Return the kind of an object and its item in Wikidata ("Q" and digits); a kind without an item is an object."""
    kind = kind_of(asset.category, asset.name)
    return (kind.name, kind.wikidata) if kind is not None and kind.wikidata else OBJECT


def _add_labels(pxr: Any, stage: Any, model: Model) -> None:
    """Label the asset by its kind, links by what they are, and materials by their names, which say what they are made of."""
    kind, code = kind_and_item(model.asset)
    top = f"/{model.asset.name}"
    rows = [(top, "class", kind), (top, "wikidata_qcode", code)]
    rows += [(f"{top}/links/{b.name}", "class", b.link.part.label) for b in model.bodies]
    materials = [p for p in stage.Traverse() if p.IsA(pxr.UsdShade.Material)]
    for path, taxonomy, label in (*rows, *((p.GetPath(), "material", p.GetName().lower()) for p in materials)):
        prim = stage.GetPrimAtPath(path)
        prim.AddAppliedSchema(f"SemanticsLabelsAPI:{taxonomy}")
        kinds = pxr.Sdf.ValueTypeNames.TokenArray
        prim.CreateAttribute(f"semantics:labels:{taxonomy}", kinds, custom=False).Set([label])


def _add_color(pxr: Any, stage: Any, model: Model, body: ExportLink) -> None:
    """Give a link one colour, which its mesh inherits where it has none: for viewers without materials."""
    link = stage.GetPrimAtPath(f"/{model.asset.name}/links/{body.name}")
    color = to_linear(np.array(display_color(model.asset.mesh, widest(body.link))[:3]))
    kinds, constant = pxr.Sdf.ValueTypeNames, pxr.UsdGeom.Tokens.constant
    primvar = pxr.UsdGeom.PrimvarsAPI(link).CreatePrimvar("displayColor", kinds.Color3fArray, constant)
    primvar.Set([vec(pxr, color)])


def _add_for_engines(pxr: Any, stage: Any, model: Model, body: ExportLink) -> None:
    """Add a surface and what Newton and MuJoCo want of each collider, and the resistance of its joint as MuJoCo has it."""
    link = stage.GetPrimAtPath(f"/{model.asset.name}/links/{body.name}")
    for prim in (p for p in link.GetChildren() if p.HasAPI(pxr.UsdPhysics.CollisionAPI)):
        if not prim.GetRelationship("material:binding:physics"):
            bind_surface(pxr, stage, prim, UNKNOWN)
        prim.AddAppliedSchema("MjcCollisionAPI")
        prim.AddAppliedSchema("NewtonCollisionAPI")
        if prim.IsA(pxr.UsdGeom.Mesh):
            prim.AddAppliedSchema("NewtonMeshCollisionAPI")
    joint = body.link.joint
    if joint is not None and joint.name in model.resistances:
        prim, r = stage.GetPrimAtPath(f"/{model.asset.name}/joints/{joint.name}"), model.resistances[joint.name]
        prim.AddAppliedSchema("MjcJointAPI")
        for name, value in (("damping", r.damping), ("frictionloss", r.friction), ("armature", r.armature)):
            prim.CreateAttribute(f"mjc:{name}", pxr.Sdf.ValueTypeNames.Double, custom=False).Set(float(value))


def _add_grasps(pxr: Any, stage: Any, model: Model) -> None:
    """Add a line through each handle, along which the fingers of a gripper close."""
    for body in model.bodies:
        joint = body.link.joint
        if joint is None or joint.name not in model.resistances:
            continue
        handle = next((h for h in model.handles if h.joint == joint.name), None)
        on = body if handle is None else next(b for b in model.bodies if b.name == handle.link)
        if handle is None:
            ends = grasp_line(body.link.triangles, model.resistances[joint.name].pull, body.link.origin)
        else:
            ends = handle_line(handle, on.link.origin)
        path = f"/{model.asset.name}/links/{on.name}/grasp_identifier_{joint.name}"
        curve = pxr.UsdGeom.BasisCurves.Define(stage, path)
        curve.CreateTypeAttr(pxr.UsdGeom.Tokens.linear)
        curve.CreateCurveVertexCountsAttr([2])
        curve.CreatePointsAttr([vec(pxr, end) for end in ends])
        curve.CreateWidthsAttr([0.002])
        curve.SetWidthsInterpolation(pxr.UsdGeom.Tokens.constant)
        now = pxr.Usd.TimeCode.Default()
        curve.CreateExtentAttr(pxr.UsdGeom.Boundable.ComputeExtentFromPlugins(curve, now))
        curve.CreatePurposeAttr(pxr.UsdGeom.Tokens.guide)


def _metadata(pxr: Any, model: Model) -> dict[str, Any]:
    """Return what a catalogue wants to know, in both places where validators look for it.

    The day is that of SOURCE_DATE_EPOCH, if it is set, so that a build can be repeated.
    """
    asset, (kind, code) = model.asset, kind_and_item(model.asset)
    epoch = os.environ.get("SOURCE_DATE_EPOCH")
    day = datetime.now(UTC) if epoch is None else datetime.fromtimestamp(int(epoch), UTC)
    size = np.ptp(asset.mesh.triangles.reshape(-1, 3), axis=0)
    known = {
        "asset_name": asset.name,
        "asset_type": "prop",
        "source_file": Path(asset.source.path).name,
        "usd_date_generated": day.date().isoformat(),
    }
    top = f"/{asset.name}"
    variants = {e: {"prim": top, "variantSetName": e, "activateOption": "Enabled"} for e in ENGINES.values()}
    nested = {
        **known,
        "author": f"articulate-anymesh {anymesh.__version__}",
        "asset_license": asset.source.credits.get("license", "as the mesh that it was made from"),
        "category": kind,
        "qcode": code,
        "rigid_body_count": len(model.bodies),
        "asset_extents": vec(pxr, size),
        "mass": float(sum(b.inertia.mass for b in model.bodies)),
        "Variants": {"Physics": variants},
        "validation": {"profile": "Robotics-Prop", "profile_version": "4.0.0"},
    }
    return {**known, "SimReady_Metadata": nested}


def _thumbnail(asset: Asset) -> np.ndarray:
    """Return a square RGB picture of the object at rest."""
    mesh = smoothed(asset.mesh)
    camera = orbit_camera(mesh.bounds, np.deg2rad(AZIMUTH), np.deg2rad(ELEVATION), THUMBNAIL)
    window = Window(0, 0, THUMBNAIL, THUMBNAIL)
    target = render_target(mesh, RayScene(mesh.vertices, mesh.faces), asset.segmentation.face_part)
    samples = sample(target, camera, window)
    return draw(samples, material_colors(mesh, samples), light_on(samples), ground(*window.shape))


def handle_line(handle: HandleFrame, origin: Float[np.ndarray, " 3"]) -> Float[np.ndarray, "2 3"]:
    """Return the ends of a line through a handle in the link frame [m], along which fingers close.

    It is as far below the surface as a round bar's middle, if the handle is that deep.
    """
    middle = handle.place - origin + min(handle.size[1], handle.size[2]) / 2 * handle.R[:, 2]
    half = handle.size[1] / 2 + CLEAR
    return np.stack([middle - half * handle.R[:, 1], middle + half * handle.R[:, 1]])


def grasp_line(triangles: Float[np.ndarray, "m 3 3"], pull: Pull, origin: Float[np.ndarray, " 3"]) -> Float[np.ndarray, "2 3"]:
    """Return the ends of a line in the link frame [m], across the direction of the pull, where the part is thinnest.

    triangles: of the part, in the link frame; origin: of that frame [m, asset frame].
    """
    at = pull.at - origin
    near = triangles[(triangles.min(1) <= at + REACH).all(1) & (triangles.max(1) >= at - REACH).all(1)]
    u, v = np.meshgrid(*[np.linspace(0, 1, GRID)] * 2)
    weights = np.stack([1 - u - v, u, v], -1)[u + v <= 1]
    points = (weights[None, :, :, None] * near[:, None]).sum(2).reshape(-1, 3)
    points = points[(np.abs(points - at) <= REACH).all(1)] if len(points) else points
    points = points if len(points) else triangles.reshape(-1, 3)
    first = np.cross(pull.direction, np.eye(3)[int(np.abs(pull.direction).argmin())])
    first /= np.linalg.norm(first)
    second = np.cross(pull.direction, first)
    angles = np.arange(STEPS) * np.pi / STEPS
    across = np.cos(angles)[:, None] * first + np.sin(angles)[:, None] * second
    along = points @ across.T
    thinnest = int(np.round(np.ptp(along, axis=0), 6).argmin())
    low, high = along[:, thinnest].min(), along[:, thinnest].max()
    deep = points @ pull.direction - at @ pull.direction
    inside = np.sign(deep.mean()) * min(high - low, np.ptp(deep)) / 2  # as far below the surface as a round bar's middle
    here = at - across[thinnest] * (at @ across[thinnest]) + inside * pull.direction
    return np.stack([here + (low - CLEAR) * across[thinnest], here + (high + CLEAR) * across[thinnest]])
