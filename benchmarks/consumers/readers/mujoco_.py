"""MuJoCo, from the MJCF or from the URDF, or from what robosuite and RoboCasa make of the folders for them."""

from __future__ import annotations

from importlib import import_module
from importlib.metadata import version

import mujoco
import numpy as np
from common import Asset, finite, frame, motion, placed, serve

PREFIX = "thing_"  # of names in a scene of robosuite


def placed_in_robosuite(asset: Asset, variant: str) -> tuple[mujoco.MjModel, str]:
    """Return a world of robosuite with the asset on the ground, and the version of the project."""
    models, objects = import_module("robosuite.models"), import_module("robosuite.models.objects")
    world, path = models.MujocoWorldBase(), asset.file(variant).resolve()
    if variant == "robosuite":
        thing = objects.MujocoXMLObject(str(path), name=PREFIX[:-1], joints=None, duplicate_collision_geoms=False)
        said = f"robosuite {version('robosuite')}"
    else:
        fixture = import_module("robocasa.models.fixtures.fixture").Fixture
        thing = fixture(str(path.parent), name=PREFIX[:-1], duplicate_collision_geoms=False)
        size = [thing.width, thing.depth, thing.height]
        if not np.allclose(size, 2 * np.array(string_of(thing, "reg_main"))) or thing.horizontal_radius < max(size[:2]) / 2:
            raise ValueError(f"the fixture has the size {size}")
        said = f"RoboCasa {import_module('robocasa').__version__}"
    thing.set_pos([0, 0, -thing.bottom_offset[2]])
    world.merge_assets(thing)
    world.worldbody.append(thing.get_obj())
    return world.get_model(), said


def string_of(thing: object, name: str) -> list[float]:
    geom = next(g for g in thing.get_obj().iter("geom") if g.get("name") == PREFIX + name)
    return [float(v) for v in geom.get("size").split()]


def read(asset: Asset, variant: str) -> dict:
    model, title = None, f"MuJoCo {mujoco.__version__}"
    if variant in ("robosuite", "robocasa"):
        model, title = placed_in_robosuite(asset, variant)
    model = model or mujoco.MjModel.from_xml_path(str(asset.file(variant)))
    data = mujoco.MjData(model)

    def poses() -> dict[str, np.ndarray]:
        mujoco.mj_forward(model, data)
        found = {model.body(b).name.removeprefix(PREFIX): frame(data.xpos[b], data.xmat[b]) for b in range(model.nbody)}
        return {name: np.linalg.inv(found[asset.root]) @ T for name, T in found.items()}

    rest = poses()
    links = {}
    for b in range(1, model.nbody):
        w, x, y, z = model.body_iquat[b]
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, np.array([w, x, y, z]))
        name = model.body(b).name.removeprefix(PREFIX)
        links[name] = placed(rest[name], model.body_mass[b], model.body_ipos[b], model.body_inertia[b], turn.reshape(3, 3))
    joints, of_child = {}, {said["child"]: name for name, said in asset.joints.items()}  # RoboCasa wants names of its own
    for j in range(model.njnt):
        joint, slides = model.joint(j), model.jnt_type[j] == mujoco.mjtJoint.mjJNT_SLIDE
        if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE:
            continue
        body, dof = int(model.jnt_bodyid[j]), int(model.jnt_dofadr[j])
        at_rest = model.qpos0[model.jnt_qposadr[j]]
        limits = finite(*(model.jnt_range[j] - at_rest)) if model.jnt_limited[j] else None
        child = model.body(body).name.removeprefix(PREFIX)
        name = of_child.get(child, joint.name.removeprefix(PREFIX))
        amount = asset.amount(name)
        data.qpos[model.jnt_qposadr[j]] += amount
        moved = poses()[child]
        data.qpos[model.jnt_qposadr[j]] -= amount
        joints[name] = {
            "type": "prismatic" if slides else "continuous" if limits is None else "revolute",
            "parent": model.body(model.body_parentid[body]).name.removeprefix(PREFIX),
            "child": child,
            **motion(rest[child], moved, amount),
            "limits": limits,
            "damping": model.dof_damping[dof],
            "friction": model.dof_frictionloss[dof],
            "armature": model.dof_armature[dof],
            "stiffness": np.ravel(model.jnt_stiffness[j])[0],
            "reference": model.qpos_spring[model.jnt_qposadr[j]] - at_rest,
        }
        if model.jnt_actfrclimited[j]:
            joints[name]["effort"] = model.jnt_actfrcrange[j][1]
    for name, link in links.items():  # a body without a joint of its own is welded
        ids = [b for b in range(model.nbody) if model.body(b).name.removeprefix(PREFIX) == name]
        parent = model.body(model.body_parentid[ids[0]]).name.removeprefix(PREFIX)
        for said in asset.joints.values():
            if said["type"] == "fixed" and said["child"] == name and parent == said["parent"] and link:
                joints[said["name"]] = {"type": "fixed", "parent": parent, "child": name}
    return {"version": title, "joints": joints, "links": links}


serve(read)
