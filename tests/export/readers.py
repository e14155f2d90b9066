"""Content of each format, read independently of the writers: yourdfpy, MuJoCo, OpenUSD; SDFormat and GLB here."""

from __future__ import annotations

import json
from pathlib import Path

import mujoco
import numpy as np
import trimesh
import yourdfpy
from read_content import KINDS, Body, Read, box, chain, cloud, cylinder, frame, motion, obj_points
from read_sdf_usd import read_sdf, read_usd
from scipy.spatial.transform import Rotation


def read_urdf(folder: Path, name: str) -> Read:
    robot = yourdfpy.URDF.load(str(folder / f"{name}.urdf"), mesh_dir=str(folder), load_meshes=False)
    joints = {}
    for j in robot.joint_map.values():
        joints[j.name] = {"type": j.type, "parent": j.parent, "child": j.child}
        if j.type != "fixed":
            joints[j.name] |= {
                "limits": None if j.type == "continuous" else (j.limit.lower, j.limit.upper),
                "effort": j.limit.effort,
                "velocity": j.limit.velocity,
                "damping": float(j.dynamics.damping),
                "friction": float(j.dynamics.friction),
            }
    bodies = {}
    for link in robot.robot.links:
        body = bodies[link.name] = Body(link.inertial.mass, link.inertial.origin[:3, 3], link.inertial.inertia)
        for c in link.collisions:
            g, T = c.geometry, c.origin
            if g.box is not None:
                body.supports.append(box(T, g.box.size))
            elif g.cylinder is not None:
                body.supports.append(cylinder(T, g.cylinder.radius, g.cylinder.length))
            else:
                body.supports.append(cloud(obj_points(folder / g.mesh.filename) @ T[:3, :3].T + T[:3, 3]))

    def poses(positions):
        robot.update_cfg({**dict.fromkeys(robot.actuated_joint_names, 0.0), **positions})
        return {link: robot.get_transform(link) for link in robot.link_map}

    return Read(joints, bodies, poses, None)


def read_mjcf(folder: Path, name: str) -> Read:
    model = mujoco.MjModel.from_xml_path(str(folder / f"{name}.xml"))
    data = mujoco.MjData(model)
    names = [model.body(b).name for b in range(model.nbody)]
    joints = {}
    for k in range(model.njnt):
        j, dof = model.joint(k), model.jnt_dofadr[k]
        if model.jnt_type[k] == mujoco.mjtJoint.mjJNT_FREE:
            continue
        slides = model.jnt_type[k] == mujoco.mjtJoint.mjJNT_SLIDE
        motor = model.actuator(j.name)
        child = int(model.jnt_bodyid[k])
        joints[j.name] = {
            "type": "prismatic" if slides else "revolute" if model.jnt_limited[k] else "continuous",
            "parent": names[model.body_parentid[child]],
            "child": names[child],
            "limits": tuple(j.range) if model.jnt_limited[k] else None,
            "effort": float(model.jnt_actfrcrange[k, 1]),
            "damping": float(np.atleast_2d(model.dof_damping.T)[0][dof]),
            "friction": float(model.dof_frictionloss[dof]),
            "drive": (float(motor.gainprm[0]), float(-motor.biasprm[2]), float(motor.forcerange[1])),
        }
    bodies = {}
    for b in range(1, model.nbody):
        R = Rotation.from_quat(model.body_iquat[b], scalar_first=True).as_matrix()
        bodies[names[b]] = Body(model.body_mass[b], model.body_ipos[b], (R * model.body_inertia[b]) @ R.T)
    for g in np.flatnonzero(model.geom_contype):
        body = bodies[names[model.geom_bodyid[g]]]
        T = frame(model.geom_pos[g], Rotation.from_quat(model.geom_quat[g], scalar_first=True).as_matrix())
        match mujoco.mjtGeom(model.geom_type[g]):
            case mujoco.mjtGeom.mjGEOM_BOX:
                body.supports.append(box(T, 2 * model.geom_size[g]))
            case mujoco.mjtGeom.mjGEOM_CYLINDER:
                body.supports.append(cylinder(T, model.geom_size[g, 0], 2 * model.geom_size[g, 1]))
            case _:
                mesh = model.mesh(model.geom_dataid[g])
                v = model.mesh_vert[mesh.vertadr[0] : mesh.vertadr[0] + mesh.vertnum[0]]
                body.supports.append(cloud(v @ T[:3, :3].T + T[:3, 3]))

    def poses(positions):
        mujoco.mj_resetData(model, data)
        for key, value in positions.items():
            data.joint(key).qpos = value
        mujoco.mj_kinematics(model, data)
        return {n: frame(data.body(n).xpos, data.body(n).xmat.reshape(3, 3)) for n in names[1:]}

    return Read(joints, bodies, poses, all(model.jnt_type != mujoco.mjtJoint.mjJNT_FREE))


def read_glb(folder: Path, name: str) -> Read:
    raw = (folder / f"{name}.glb").read_bytes()
    nodes = json.loads(raw[20 : 20 + int.from_bytes(raw[12:16], "little")])["nodes"]
    joints = {}
    for node in nodes[1:]:
        for child in (nodes[i] for i in node.get("children", [])):
            said = child["extras"]["joint"]
            joints[said["name"]] = {**said, "parent": node["name"], "child": child["name"]}
            joints[said["name"]]["rest"] = frame(child.get("translation", (0, 0, 0)))
            if said["type"] == "fixed":
                del joints[said["name"]]["limits"]
    scene = trimesh.load(folder / f"{name}.glb")  # independent reader of the tree at rest
    up = frame(rotation=Rotation.from_quat(nodes[0]["rotation"]).as_matrix())
    move = chain(joints, nodes[1]["name"], lambda j, q: j["rest"] @ motion(KINDS[j["type"]], j["axis"], q))
    for link, T in move({}).items():
        np.testing.assert_allclose(scene.graph.get(link)[0], up @ T, atol=1e-6)
    return Read(joints, {}, move, None)


READERS = {"urdf": read_urdf, "mjcf": read_mjcf, "usd": read_usd, "sdf": read_sdf, "glb": read_glb}
