"""Named states in USD: variants of the asset's prim, which hold where its links are, and the positions of its joints."""

from __future__ import annotations

from typing import Any

import numpy as np

from anymesh.export.model import Model
from anymesh.geometry.kinematics import link_transforms
from anymesh.openusd.geometry_ import place, quat
from anymesh.types import JointType

SET, REST = "state", "rest"  # the variant set, and its variant of an asset that is modelled in none of the states


def add_states(pxr: Any, stage: Any, model: Model) -> None:
    """Add the variant set `state`; the pose at rest is selected. Links that move have their transforms in the variants alone.

    A variant is weaker than what is written outside of it, so it could not move a link that has a transform there.
    """
    states = {name: {j: v for j, v in at.items() if abs(v) > 1e-9} for name, at in model.states.items()}
    if not states:
        return
    if all(states.values()):
        states[REST] = {}
    root, joints = stage.GetDefaultPrim(), {j.name: j for j in model.asset.joints}
    poses = {name: link_transforms(model.asset, at) for name, at in states.items()}
    moved = [link for link in model.links if any(not np.allclose(T[link.name], np.eye(4)) for T in poses.values())]
    variants = root.GetVariantSets().AddVariantSet(SET)
    for link in moved:
        prim = stage.GetPrimAtPath(f"{root.GetPath()}/links/{link.name}")
        for name in prim.GetPropertyNames():
            if name.startswith("xformOp"):
                prim.RemoveProperty(name)
    for name, at in states.items():
        variants.AddVariant(name)
        variants.SetVariantSelection(name)
        with variants.GetVariantEditContext():
            for link in moved:
                T, frame = poses[name][link.name], pxr.UsdGeom.Xform.Get(stage, f"{root.GetPath()}/links/{link.name}")
                place(pxr, frame, T[:3, :3] @ link.origin + T[:3, 3])
                if not np.allclose(T[:3, :3], np.eye(3)):
                    frame.AddOrientOp().Set(quat(pxr, T[:3, :3]))
            for joint, value in at.items():
                slides = joints[joint].type is JointType.PRISMATIC
                kind, prim = ("linear" if slides else "angular"), stage.GetPrimAtPath(f"{root.GetPath()}/joints/{joint}")
                prim.AddAppliedSchema(f"PhysicsJointStateAPI:{kind}")
                position = prim.CreateAttribute(f"state:{kind}:physics:position", pxr.Sdf.ValueTypeNames.Float, custom=False)
                position.Set(float(value if slides else np.rad2deg(value)))
    variants.SetVariantSelection(next(name for name, at in states.items() if not at))
