"""Mechanisms in engines: joints that lead are brought to a position, and what follows is read.

python moving_.py ENGINE FILE LEADS: LEADS is JSON, joint -> position; prints JSON, joint -> position, after a line of its own.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

STEPS, RAMP = 3000, 2000  # of a motion, and of its beginning in which the goal moves
MARK = "positions: "


def pinocchio(path: Path, leads: dict[str, float]) -> dict[str, float]:
    import pinocchio as pin

    model = pin.buildModelFromUrdf(str(path), mimic=True)
    q, names = pin.neutral(model), {name: k for k, name in enumerate(model.names) if k}
    for name, value in leads.items():
        at, wide = model.idx_qs[names[name]], model.joints[names[name]].nq
        q[at : at + wide] = [value] if wide == 1 else [np.cos(value), np.sin(value)]
    data = model.createData()
    pin.forwardKinematics(model, data, q)
    at = dict[str, float]()
    for name, k in names.items():
        T = model.jointPlacements[k].actInv(data.oMi[model.parents[k]].actInv(data.oMi[k]))
        axis = [float(v) for v in ElementTree.parse(path).find(f"joint[@name='{name}']/axis").get("xyz").split()]
        at[name] = float(np.dot(axis, T.translation + pin.log3(T.rotation)))  # of one axis each
    return at | leads


def pybullet(path: Path, leads: dict[str, float]) -> dict[str, float]:
    import pybullet as p

    p.connect(p.DIRECT)
    body = p.loadURDF(str(path), useFixedBase=True)
    number = {p.getJointInfo(body, k)[1].decode(): k for k in range(p.getNumJoints(body))}
    for k in number.values():
        p.setJointMotorControl2(body, k, p.VELOCITY_CONTROL, force=0)
    for _ in range(STEPS):
        for name, value in leads.items():
            p.setJointMotorControl2(body, number[name], p.POSITION_CONTROL, targetPosition=value, force=200, maxVelocity=1)
        p.stepSimulation()
    return {name: p.getJointState(body, k)[0] for name, k in number.items()}


def sapien(path: Path, leads: dict[str, float]) -> dict[str, float]:
    import sapien
    from sapien.physx import PhysxCpuSystem

    scene, plain = sapien.Scene([PhysxCpuSystem()]), path.with_name(f"sapien_{path.name}")
    scene.set_timestep(2e-3)
    plain.write_text(re.sub(r"<visual.*?</visual>", "", path.read_text(), flags=re.S))  # it draws, and has no device
    loader = scene.create_urdf_loader()
    loader.fix_root_link = True
    robot = loader.load(str(plain))
    for joint in robot.active_joints:
        if joint.name in leads:
            joint.set_drive_properties(500, 50, 200, "force")
            joint.set_drive_target(leads[joint.name])
    for _ in range(STEPS):
        robot.set_qf(robot.compute_passive_force(True, True))
        scene.step()
    return dict(zip((j.name for j in robot.active_joints), robot.qpos.tolist(), strict=True))


def drake(path: Path, leads: dict[str, float]) -> dict[str, float]:
    from pydrake.all import MultibodyPlant, Parser, Simulator

    plant = MultibodyPlant(1e-3)
    (model,) = Parser(plant).AddModels(str(path))
    root = next(iter(plant.GetBodyIndices(model)))
    if path.suffix == ".urdf":
        plant.WeldFrames(plant.world_frame(), plant.get_body(root).body_frame())
    plant.mutable_gravity_field().set_gravity_vector([0, 0, 0])
    joints = {j.name(): j for j in map(plant.get_joint, plant.GetJointIndices(model)) if j.num_positions() == 1}
    for name in leads:
        if path.suffix == ".urdf":  # passive joints have no actuator there
            plant.AddJointActuator(f"{name}_motor", joints[name], 1000)
    plant.Finalize()
    context, input_ = plant.CreateDefaultContext(), plant.get_actuation_input_port()
    simulator, actuators = Simulator(plant, context), list(map(plant.get_joint_actuator, plant.GetJointActuatorIndices()))
    for k in range(STEPS):
        q, v, u = plant.GetPositions(context), plant.GetVelocities(context), np.zeros(input_.size())
        for actuator in actuators:
            joint = actuator.joint()
            if joint.name() in leads:
                goal = leads[joint.name()] * min(1, k / RAMP)
                u[actuator.input_start()] = 80 * (goal - q[joint.position_start()]) - 20 * v[joint.velocity_start()]
        input_.FixValue(context, u)
        simulator.AdvanceTo((k + 1) * 1e-3)
    return {name: float(plant.GetPositions(context)[joint.position_start()]) for name, joint in joints.items()}


def genesis(path: Path, leads: dict[str, float]) -> dict[str, float]:
    import genesis as gs

    gs.init(backend=gs.cpu, logging_level="error")
    scene = gs.Scene(sim_options=gs.options.SimOptions(gravity=(0, 0, 0)), show_viewer=False)
    urdf = path.suffix == ".urdf"
    thing = scene.add_entity(gs.morphs.URDF(file=str(path), fixed=True) if urdf else gs.morphs.MJCF(file=str(path)))
    scene.build()
    dofs = {j.name: j.dofs_idx_local[0] for j in thing.joints if j.n_dofs == 1}
    for name in leads:
        thing.set_dofs_kp(np.array([200.0]), [dofs[name]])
        thing.set_dofs_kv(np.array([40.0]), [dofs[name]])
        thing.control_dofs_position(np.array([leads[name]]), [dofs[name]])
    for _ in range(STEPS // 5):
        scene.step()
    positions = thing.get_dofs_position().cpu().tolist()
    return {name: positions[k] for name, k in dofs.items()}


def physx(path: Path, leads: dict[str, float]) -> dict[str, float]:
    """PhysX by ovphysx, from the USD beside the URDF."""
    from anymesh.checking.engines.driving import motors_of, readable
    from anymesh.checking.engines.physx_ import World
    from anymesh.checking.engines.robot import read_urdf

    robot = readable(read_urdf(path))
    world = World(path, robot, motors_of(robot))
    world.reset(np.zeros(len(world.names)))
    for word, value in (("jointStiffness", 50.0), ("jointDamping", 5.0), ("jointMaxForce", 1e4)):
        world._write(world.joint, word, {name: value if name in leads else 0.0 for name in world.names})
    goal = np.array([leads.get(name, 0.0) for name in world.names])
    for k in range(STEPS // 2):
        world.step(goal * min(1.0, 2 * k / RAMP))
    return dict(zip(world.names, world.positions().tolist(), strict=True))


ENGINES: dict[str, Callable[[Path, dict[str, float]], dict[str, float]]] = {
    f.__name__: f for f in (pinocchio, pybullet, sapien, drake, genesis, physx)
}

if __name__ == "__main__":
    print(MARK + json.dumps(ENGINES[sys.argv[1]](Path(sys.argv[2]), json.loads(sys.argv[3]))))
