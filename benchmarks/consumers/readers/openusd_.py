"""OpenUSD: what its parser of UsdPhysics holds of the USD, and the faults that its validators (usdchecker) find."""

from __future__ import annotations

from importlib.metadata import version

import numpy as np
from common import Asset, frame, placed, serve, turn_of
from pxr import Gf, Usd, UsdGeom, UsdPhysics, UsdValidation

DEGREE = np.pi / 180
AXES = {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1)}


def turn(quaternion: Gf.Quatf) -> np.ndarray:
    return turn_of(*quaternion.GetImaginary(), quaternion.GetReal())


def read(asset: Asset, variant: str) -> dict:
    stage = Usd.Stage.Open(str(asset.file(variant)))
    cache = UsdGeom.XformCache()
    world = {
        p.GetName(): np.array(cache.GetLocalToWorldTransform(p)).T
        for p in stage.Traverse()
        if p.HasAPI(UsdPhysics.RigidBodyAPI)
    }
    root = np.linalg.inv(world[asset.root])
    rest = {name: root @ T for name, T in world.items()}
    links, joints = {}, {}
    for prim in stage.Traverse():
        name = prim.GetName()
        if prim.HasAPI(UsdPhysics.MassAPI):
            mass = UsdPhysics.MassAPI(prim)
            values = (
                mass.GetCenterOfMassAttr().Get(),
                mass.GetDiagonalInertiaAttr().Get(),
                turn(mass.GetPrincipalAxesAttr().Get()),
            )
            links[name] = placed(rest[name], mass.GetMassAttr().Get(), *values)
        if name not in asset.joints or not prim.IsA(UsdPhysics.Joint):
            continue
        joint = UsdPhysics.Joint(prim)
        ends = [stage.GetPrimAtPath(rel.GetTargets()[0]).GetName() for rel in (joint.GetBody0Rel(), joint.GetBody1Rel())]
        slides, turns = prim.IsA(UsdPhysics.PrismaticJoint), prim.IsA(UsdPhysics.RevoluteJoint)
        record = joints[name] = {"type": "fixed", "parent": ends[0], "child": ends[1]}
        if not slides and not turns:
            continue
        kind, unit = (UsdPhysics.PrismaticJoint(prim), 1.0) if slides else (UsdPhysics.RevoluteJoint(prim), DEGREE)
        T = rest[ends[0]] @ frame(joint.GetLocalPos0Attr().Get(), turn(joint.GetLocalRot0Attr().Get()))
        limits = [a.Get() for a in (kind.GetLowerLimitAttr(), kind.GetUpperLimitAttr())]
        limits = [v * unit for v in limits] if np.isfinite(limits).all() else None
        record |= {"type": "prismatic" if slides else "revolute" if limits else "continuous", "limits": limits}
        record |= {"axis": T[:3, :3] @ AXES[kind.GetAxisAttr().Get()], "origin": T[:3, 3]}
        drive = UsdPhysics.DriveAPI.Get(prim, "linear" if slides else "angular")
        record["effort"] = drive.GetMaxForceAttr().Get()
    context = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators())
    faults = [f"{e.GetName()}: {e.GetMessage()}" for e in context.Validate(stage)]
    return {"version": f"OpenUSD {version('usd-core')}", "faults": faults, "joints": joints, "links": links}


serve(read)
