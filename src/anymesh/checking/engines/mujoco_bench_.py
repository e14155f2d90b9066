"""MuJoCo: a URDF or MJCF as a model with one motor per joint, at rest, without gravity."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.checking.engines.files import find_file
from anymesh.checking.engines.motors import MIN_SETTLING_RATIO, REACHED_RATIO
from anymesh.errors import InputError
from anymesh.loading import load_mesh

TOUCH = 1e-4  # share of the asset's extent: bodies with deeper penetration at rest overlap
MOTOR_FREQUENCY_1S = 30.0  # [rad/s] natural frequency of a motor whose motion takes 1 s; lower for a longer one
MAX_MOTOR_FREQUENCY = 100.0  # [rad/s], for light links with much friction; rotor inertia is added to keep it
MAX_MOTION_SECONDS = 20.0  # [s] maximum duration of a motion; heavy links with little effort are slow
READ = (".obj", ".stl", ".msh")  # mesh formats that MuJoCo reads


def read_spec(mujoco: Any, path: Path) -> Any:
    """Read the file as an editable model, with package:// resolved, and meshes of other formats inserted as data.

    Raise ValueError or InputError if it cannot be read.
    """
    spec = mujoco.MjSpec.from_file(str(path))
    folder = path.parent / spec.meshdir
    for mesh in spec.meshes:
        if not mesh.file or (Path(mesh.file).suffix.lower() in READ and "://" not in mesh.file):
            continue
        mesh_path = find_file(mesh.file, folder)
        if mesh_path is None:
            raise InputError(f"the mesh {mesh.file} is not there")
        if mesh_path.suffix.lower() in READ:
            mesh.file = str(mesh_path.resolve())
        else:
            content = load_mesh(mesh_path).mesh
            mesh.file, mesh.uservert, mesh.userface = "", content.vertices.reshape(-1), content.faces.reshape(-1)
    return spec


@dataclass(frozen=True, eq=False)
class MujocoBench:
    """A model with a motor for each hinge and slide joint, and its state at rest."""

    mujoco: Any
    model: Any
    data: Any
    joints: tuple[int, ...]  # hinges and slides
    motors: dict[int, int]  # joint -> actuator
    ranges: np.ndarray  # (all joints, 2) [rad or m]
    seconds: np.ndarray  # (all joints,) duration of a motion from limit to limit
    rest_depth: dict[tuple[int, int], float]  # pair of bodies -> penetration at rest [m]
    anchors: np.ndarray  # (all joints, 3) at rest
    axes: np.ndarray  # (all joints, 3) at rest
    places: np.ndarray  # (geoms, 3) at rest

    @property
    def extent(self) -> float:
        return float(self.model.stat.extent)

    def body(self, index: int) -> str:
        return self.model.body(index).name


def make_bench(mujoco: Any, path: Path) -> tuple[MujocoBench, tuple[tuple[str, str, str], ...]]:
    """Create the bench, and the pairs of links that are not tested against each other, with the reason."""
    spec = read_spec(mujoco, path)
    _strip(spec, mujoco)
    spec.compiler.fusestatic = False  # links keep their names and their neighbours
    spec.option.gravity = (0, 0, 0)
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    model = spec.compile()
    excluded = [(model.body(a).name, model.body(b).name, "joined by a joint") for a, b in _joined(model)]
    for a, b, _ in excluded:
        spec.add_exclude(bodyname1=a, bodyname2=b)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    overlap = [p for p, depth in depths(model, data).items() if depth > TOUCH * model.stat.extent]
    for a, b in sorted(overlap):
        excluded.append((model.body(a).name, model.body(b).name, "overlap at rest"))
        spec.add_exclude(bodyname1=excluded[-1][0], bodyname2=excluded[-1][1])
    limited = model.jnt_limited.astype(bool)[:, None]
    ranges = np.where(limited, model.jnt_range, (-np.pi, np.pi)).reshape(-1, 2)
    single = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
    joints = tuple(k for k in range(model.njnt) if int(model.jnt_type[k]) in single)
    seconds = _add_motors(mujoco, spec, model, ranges, joints)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    rest = (depths(model, data), data.xanchor.copy(), data.xaxis.copy(), data.geom_xpos.copy())
    motors = {joint: number for number, joint in enumerate(joints)}
    return MujocoBench(mujoco, model, data, joints, motors, ranges, seconds, *rest), tuple(excluded)


def _joined(model: Any) -> list[tuple[int, int]]:
    """Return each body with its parent, and with bodies fixed to a moving parent, as MuJoCo filters contacts."""
    direct = [(int(model.body_parentid[b]), b) for b in range(1, model.nbody) if model.body_parentid[b] > 0]
    held = {b: int(model.body_weldid[model.body_parentid[model.body_weldid[b]]]) for b in range(1, model.nbody)}
    moving = [b for b in held if model.body_weldid[b] > 0 and held[b] > 0]
    fixed = [(a, b) for b in moving for a in range(1, model.nbody) if model.body_weldid[a] == held[b]]
    return direct + [pair for pair in fixed if pair not in direct]


def _strip(spec: Any, mujoco: Any) -> None:
    """Remove actuators, sensors, keyframes and free joints, and name unnamed elements."""
    for things in (spec.keys, spec.sensors, spec.actuators):
        for thing in list(things):
            spec.delete(thing)
    for joint in list(spec.joints):
        if joint.type == mujoco.mjtJoint.mjJNT_FREE:
            spec.delete(joint)
    for word, things in (("joint", spec.joints), ("body", spec.bodies)):
        for number, thing in enumerate(things):
            thing.name = thing.name or f"{word}_{number}"


def _add_motors(mujoco: Any, spec: Any, model: Any, ranges: np.ndarray, joints: tuple[int, ...]) -> np.ndarray:
    """Add a critically damped position motor per joint, strong enough to overcome dry friction within tolerance.

    Return the seconds that each needs for a smooth motion with half its effort.
    """
    seconds = np.ones(model.njnt)
    for index in joints:
        dof = model.jnt_dofadr[index]
        tolerance = REACHED_RATIO * float(np.ptp(ranges[index]))
        inertia = float(model.dof_M0[dof])
        effort = float(model.jnt_actfrcrange[index, 1]) if model.jnt_actfrclimited[index] else np.inf
        needed = np.pi * np.sqrt(inertia * float(np.ptp(ranges[index])) / max(effort, 1e-9))
        seconds[index] = min(max(1.0, needed), MAX_MOTION_SECONDS)
        kp = max(
            inertia * (MOTOR_FREQUENCY_1S / seconds[index]) ** 2, 4 * float(model.dof_frictionloss[dof]) / max(tolerance, 1e-9)
        )
        kp = max(kp, 2 * float(model.jnt_stiffness[index]) / REACHED_RATIO)  # a spring of the file counteracts it
        kp = max(kp, MIN_SETTLING_RATIO * float(model.dof_damping[dof]) / seconds[index])
        joint = spec.joint(model.joint(index).name)
        joint.armature = max(0.0, kp / MAX_MOTOR_FREQUENCY**2 - inertia)
        motor = spec.add_actuator(name=f"motor_{index}", target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        motor.ctrllimited = motor.forcelimited = int(mujoco.mjtLimited.mjLIMITED_FALSE)  # a file may have other defaults
        motor.gear = (1, 0, 0, 0, 0, 0)
        motor.set_to_position(kp=kp, kv=2 * float(np.sqrt(kp * (inertia + joint.armature))))
    return seconds


def depths(model: Any, data: Any) -> dict[tuple[int, int], float]:
    """Return the deepest penetration [m] of each pair of bodies in contact."""
    penetrations: dict[tuple[int, int], float] = {}
    for contact in data.contact[: data.ncon]:
        a, b = sorted(int(model.geom_bodyid[g]) for g in contact.geom)
        penetrations[a, b] = max(penetrations.get((a, b), 0.0), -float(contact.dist))
    return penetrations
