"""Newton, from the URDF, the MJCF, the USD, or SimReady with its variant for Newton; positions by its forward kinematics."""

from __future__ import annotations

import tempfile
from pathlib import Path

import newton
import numpy as np
import warp
from common import Asset, finite, frame, motion, placed, serve, turn_of

PLACE = tempfile.TemporaryDirectory()
warp.config.quiet = True


def read(asset: Asset, variant: str) -> dict:
    builder = newton.ModelBuilder()
    newton.solvers.SolverMuJoCo.register_custom_attributes(builder)  # else it leaves out springs
    path = str(asset.enabled("Newton", Path(PLACE.name)) if variant == "simready" else asset.file(variant))
    if variant == "urdf":
        builder.add_urdf(path, floating=False)
    elif variant == "mjcf":
        builder.add_mjcf(path)
    else:
        builder.add_usd(path)
    model = builder.finalize(device="cpu")
    names = [label.rsplit("/", 1)[-1] for label in builder.body_label]

    def poses(q: np.ndarray) -> dict[str, np.ndarray]:
        state, zeros = model.state(), warp.zeros(model.joint_dof_count, dtype=float, device="cpu")
        newton.eval_fk(model, warp.array(q, dtype=float, device="cpu"), zeros, state)
        rows = state.body_q.numpy().astype(float)
        found = {name: frame(row[:3], turn_of(*row[3:])) for name, row in zip(names, rows, strict=True)}
        root = np.linalg.inv(found[asset.root]) if asset.root in found else np.eye(4)
        return {name: root @ T for name, T in found.items()}

    start = model.joint_q.numpy().astype(float)
    rest = poses(start)
    mass, center, inertia = (a.numpy().astype(float) for a in (model.body_mass, model.body_com, model.body_inertia))
    links = {name: placed(rest[name], mass[k], center[k], inertia[k]) for k, name in enumerate(names)}
    kept = ("limit_lower", "limit_upper", "effort_limit", "velocity_limit", "damping", "friction", "armature", "stiffness")
    values = {key: getattr(model, f"joint_{key}").numpy().astype(float) for key in kept}
    joints = {}
    for k, label in enumerate(builder.joint_label):
        name, kind = label.rsplit("/", 1)[-1], newton.JointType(builder.joint_type[k])
        parent, child = builder.joint_parent[k], names[builder.joint_child[k]]
        if parent < 0:
            continue
        record = joints[name] = {"type": kind.name.lower(), "parent": names[parent], "child": child}
        if kind is newton.JointType.FIXED:
            continue
        dof, q, amount = builder.joint_qd_start[k], start.copy(), asset.amount(name)
        q[builder.joint_q_start[k]] += amount
        limits = finite(values["limit_lower"][dof], values["limit_upper"][dof])
        if limits is None and kind is newton.JointType.REVOLUTE:
            record["type"] = "continuous"
        record |= {"limits": limits, **motion(rest[child], poses(q)[child], amount)}
        record |= {"effort": values["effort_limit"][dof], "velocity": values["velocity_limit"][dof]}
        record |= {key: values[key][dof] for key in ("damping", "friction", "armature", "stiffness")}
        record["reference"] = builder.joint_rest_q[builder.joint_q_start[k]]
    return {"version": f"Newton {newton.__version__}", "joints": joints, "links": links}


serve(read)
