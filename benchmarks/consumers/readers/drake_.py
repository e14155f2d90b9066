"""Drake, from the URDF or from the SDFormat."""

from __future__ import annotations

from importlib.metadata import version

import numpy as np
from common import Asset, finite, motion, placed, serve
from pydrake.all import AddMultibodyPlantSceneGraph, DiagramBuilder, Parser

KINDS = {"revolute": "revolute", "prismatic": "prismatic", "weld": "fixed"}


def read(asset: Asset, variant: str) -> dict:
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, time_step=0.001)
    (model,) = Parser(plant).AddModels(str(asset.file(variant)))
    root = plant.GetBodyByName(asset.root, model)
    if not any(plant.get_joint(j).child_body().index() == root.index() for j in plant.GetJointIndices(model)):
        plant.WeldFrames(plant.world_frame(), root.body_frame())
    plant.Finalize()
    context = plant.CreateDefaultContext()

    def pose(body) -> np.ndarray:
        base = plant.EvalBodyPoseInWorld(context, root).GetAsMatrix4()
        return np.linalg.inv(base) @ plant.EvalBodyPoseInWorld(context, body).GetAsMatrix4()

    bodies = [plant.get_body(k) for k in plant.GetBodyIndices(model)]
    rest = {b.name(): pose(b) for b in bodies}
    links = {}
    for b in bodies:
        inertia = b.CalcSpatialInertiaInBodyFrame(context)
        about = inertia.Shift(inertia.get_com()).CalcRotationalInertia().CopyToFullMatrix3()
        links[b.name()] = placed(rest[b.name()], inertia.get_mass(), inertia.get_com(), about)
    actuators = {
        plant.get_joint_actuator(k).joint().name(): plant.get_joint_actuator(k) for k in plant.GetJointActuatorIndices()
    }
    joints = {}
    for j in plant.GetJointIndices(model):
        joint = plant.get_joint(j)
        if joint.parent_body().name() == "world":
            continue
        child = joint.child_body()
        record = {"type": KINDS[joint.type_name()], "parent": joint.parent_body().name(), "child": child.name()}
        joints[joint.name()] = record
        if joint.num_positions() == 0:
            continue
        amount, k = asset.amount(joint.name()), joint.position_start()
        q = np.zeros(plant.num_positions())
        q[k] = amount
        plant.SetPositions(context, q)
        record |= motion(rest[child.name()], pose(child), amount)
        plant.SetPositions(context, 0 * q)
        limits = finite(joint.position_lower_limits()[0], joint.position_upper_limits()[0])
        record |= {"limits": limits, "damping": joint.default_damping_vector()[0]}
        if limits is None and record["type"] == "revolute":
            record["type"] = "continuous"
        if np.isfinite(joint.velocity_upper_limits()[0]):
            record["velocity"] = joint.velocity_upper_limits()[0]
        if joint.name() in actuators:
            actuator = actuators[joint.name()]
            record["effort"] = actuator.effort_limit()
            record["armature"] = actuator.default_rotor_inertia() * actuator.default_gear_ratio() ** 2
    return {"version": f"Drake {version('drake')}", "joints": joints, "links": links}


serve(read)
