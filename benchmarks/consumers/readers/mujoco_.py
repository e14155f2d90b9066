"""MuJoCo, from the MJCF or from the URDF."""

from __future__ import annotations

import mujoco
import numpy as np
from common import Asset, finite, frame, motion, placed, serve


def read(asset: Asset, variant: str) -> dict:
    model = mujoco.MjModel.from_xml_path(str(asset.file(variant)))
    data = mujoco.MjData(model)

    def poses() -> dict[str, np.ndarray]:
        mujoco.mj_forward(model, data)
        found = {model.body(b).name: frame(data.xpos[b], data.xmat[b]) for b in range(model.nbody)}
        return {name: np.linalg.inv(found[asset.root]) @ T for name, T in found.items()}

    rest = poses()
    links = {}
    for b in range(1, model.nbody):
        w, x, y, z = model.body_iquat[b]
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, np.array([w, x, y, z]))
        name = model.body(b).name
        links[name] = placed(rest[name], model.body_mass[b], model.body_ipos[b], model.body_inertia[b], turn.reshape(3, 3))
    joints = {}
    for j in range(model.njnt):
        joint, slides = model.joint(j), model.jnt_type[j] == mujoco.mjtJoint.mjJNT_SLIDE
        if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE:
            continue
        body, dof = int(model.jnt_bodyid[j]), int(model.jnt_dofadr[j])
        limits = finite(*model.jnt_range[j]) if model.jnt_limited[j] else None
        child, amount = model.body(body).name, asset.amount(joint.name)
        data.qpos[model.jnt_qposadr[j]] += amount
        moved = poses()[child]
        data.qpos[model.jnt_qposadr[j]] -= amount
        joints[joint.name] = {
            "type": "prismatic" if slides else "continuous" if limits is None else "revolute",
            "parent": model.body(model.body_parentid[body]).name,
            "child": child,
            **motion(rest[child], moved, amount),
            "limits": limits,
            "damping": model.dof_damping[dof],
            "friction": model.dof_frictionloss[dof],
            "armature": model.dof_armature[dof],
            "stiffness": np.ravel(model.jnt_stiffness[j])[0],
            "reference": model.qpos_spring[model.jnt_qposadr[j]],
        }
        if model.jnt_actfrclimited[j]:
            joints[joint.name]["effort"] = model.jnt_actfrcrange[j][1]
    for name, link in links.items():  # a body without a joint of its own is welded
        parent = model.body(model.body_parentid[model.body(name).id]).name
        for said in asset.joints.values():
            if said["type"] == "fixed" and said["child"] == name and parent == said["parent"] and link:
                joints[said["name"]] = {"type": "fixed", "parent": parent, "child": name}
    return {"version": f"MuJoCo {mujoco.__version__}", "joints": joints, "links": links}


serve(read)
