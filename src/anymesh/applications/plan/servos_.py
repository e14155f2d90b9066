"""Position servos for the joints of an arm and its gripper, where the robot's file has none."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from jaxtyping import Float

STIFFNESS = 50.0  # [1/rad] over the effort limit: full effort at a lag of 0.02 rad, as in MuJoCo Menagerie's Panda
DAMPING = 0.1  # [s] damping over stiffness
ARMATURE, FRICTION_DAMPING = 0.1, 1.0  # [kg m2], [N m s/rad] for joints of a URDF, which states no rotor inertia
FINGER_STIFFNESS, FINGER_DAMPING = 400.0, 20.0  # [1/m], [s/m] over the closing force: full force from 2.5 mm on
USUAL_EFFORT = 50.0  # [N m] if a file states none


def add_servos(
    mujoco: Any, spec: Any, model: Any, arm: Sequence[int], fingers: Sequence[int], closing_force: float
) -> Float[np.ndarray, " J"]:
    """Add position servos to joints of the arm without one and to a gripper without actuators; return the servos' lag [s]."""
    servo = int(mujoco.mjtBias.mjBIAS_AFFINE)
    at: dict[int, Any] = {}
    drives_fingers = False
    for number, actuator in enumerate(list(spec.actuators)):
        joint = int(model.actuator_trnid[number, 0])
        on_joint = int(model.actuator_trntype[number]) == int(mujoco.mjtTrn.mjTRN_JOINT)
        if on_joint and joint in arm:
            if int(model.actuator_biastype[number]) == servo:
                at[joint] = actuator
            else:
                spec.delete(actuator)
        else:
            drives_fingers = True
    lag = []
    for joint in arm:
        name = model.joint(joint).name
        if joint not in at:
            effort = float(model.jnt_actfrcrange[joint, 1]) if model.jnt_actfrclimited[joint] else USUAL_EFFORT
            at[joint] = _add_servo(mujoco, spec, name, effort * STIFFNESS, effort * STIFFNESS * DAMPING, effort)
            made = spec.joint(name)
            made.armature = max(float(made.armature), ARMATURE)
            made.damping = [max(float(np.ravel(made.damping)[0]), FRICTION_DAMPING), 0, 0]
        lag.append(float(-at[joint].biasprm[2] / at[joint].gainprm[0]))
    if not drives_fingers:
        for joint in fingers:
            force = closing_force / max(len(fingers), 1)
            _add_servo(mujoco, spec, model.joint(joint).name, force * FINGER_STIFFNESS, force * FINGER_DAMPING, force)
            spec.joint(model.joint(joint).name).armature = ARMATURE
    return np.array(lag)


def _add_servo(mujoco: Any, spec: Any, joint: str, stiffness: float, damping: float, effort: float) -> Any:
    servo = spec.add_actuator(name=joint, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    servo.set_to_position(kp=stiffness, kv=damping)
    servo.forcelimited, servo.forcerange = 1, [-effort, effort]
    return servo
