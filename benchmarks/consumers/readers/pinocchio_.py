"""Pinocchio, from the URDF."""

from __future__ import annotations

import numpy as np
import pinocchio
from common import Asset, finite, motion, placed, serve


def kind_of(name: str) -> str:
    if name.startswith("JointModelP"):
        return "prismatic"
    return "continuous" if "Unbounded" in name or name.startswith("JointModelRUB") else "revolute"


def read(asset: Asset, variant: str) -> dict:
    model = pinocchio.buildModelFromUrdf(str(asset.file("urdf")))
    data = model.createData()

    def poses(q: np.ndarray) -> dict[str, np.ndarray]:
        pinocchio.framesForwardKinematics(model, data, q)
        bodies = [k for k, f in enumerate(model.frames) if f.type == pinocchio.FrameType.BODY]
        return {model.frames[k].name: np.array(data.oMf[k].homogeneous) for k in bodies}

    neutral = pinocchio.neutral(model)
    rest, joints = poses(neutral), {}
    base = model.frames[model.getFrameId(asset.root, pinocchio.FrameType.BODY)].inertia
    links = {asset.root: placed(rest[asset.root], base.mass, base.lever, base.inertia)}
    for f in model.frames:
        if f.type == pinocchio.FrameType.FIXED_JOINT and f.name in asset.joints:
            said = asset.joints[f.name]
            joints[f.name] = {"type": "fixed", "parent": model.frames[f.parentFrame].name, "child": said["child"]}
    for k in range(1, model.njoints):
        name, joint = model.names[k], model.joints[k]
        said, amount = asset.joints[name], asset.amount(name)
        step = np.zeros(model.nv)
        step[joint.idx_v] = amount
        child = said["child"]
        parent = model.frames[model.frames[model.getFrameId(name)].parentFrame].name
        inertia = model.inertias[k]  # of the child and of what is fixed to it
        links[child] = placed(rest[child], inertia.mass, inertia.lever, inertia.inertia)
        moved = poses(pinocchio.integrate(model, neutral, step))[child]
        v = joint.idx_v
        limits = None
        if joint.nq == 1:
            limits = finite(model.lowerPositionLimit[joint.idx_q], model.upperPositionLimit[joint.idx_q])
        joints[name] = {"type": kind_of(joint.shortname()), "parent": parent, "child": child, "limits": limits}
        joints[name] |= motion(rest[child], moved, amount)
        joints[name] |= {"damping": model.damping[v], "friction": model.friction[v], "armature": model.armature[v]}
        joints[name] |= {"effort": model.effortLimit[v], "velocity": model.velocityLimit[v]}
    return {"version": f"Pinocchio {pinocchio.__version__}", "joints": joints, "links": links}


serve(read)
