"""MuJoCo: load a URDF or MJCF unchanged, move every joint through its range, and report faults."""

from __future__ import annotations

from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.checking.engines.driving import (
    DEEP,
    MIN_SETTLING_RATIO,
    REACHED_RATIO,
    UNSTABLE,
    JointSweep,
    SweepReport,
    motor_faults,
    place_faults,
)
from anymesh.checking.engines.robot import find_file
from anymesh.errors import InputError
from anymesh.loading import load_mesh
from anymesh.mujoco_ import is_unstable, load_mujoco, name_elements

TOUCH = 1e-4  # share of the asset's extent: bodies with deeper penetration at rest overlap
MOTOR_FREQUENCY_1S = 30.0  # [rad/s] natural frequency of a motor whose motion takes 1 s; lower for a longer one
MAX_MOTOR_FREQUENCY = 100.0  # [rad/s], for light links with much friction; rotor inertia is added to keep it
MAX_MOTION_SECONDS = 20.0  # [s] maximum duration of a motion; heavy links with little effort are slow
READ = (".obj", ".stl", ".msh")  # mesh formats that MuJoCo reads
LEGS = (1.0, 1.0, -1.0, -1.0)  # sequence of motor targets: +1 upper limit, -1 lower; a repeated one holds the position
LIGHT = 1e-9  # [kg, kg m2] for links without inertia in the file, where only the rest pose is used


@contextmanager
def load_errors(mujoco: Any, path: Path) -> Generator[None]:
    """Turn MuJoCo's errors about a file into InputError."""
    try:
        yield
    except (ValueError, mujoco.FatalError, InputError) as error:
        raise InputError(f"MuJoCo cannot load {path}: {' '.join(str(error).split())}") from error


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
    joints: tuple[int, ...]  # hinges and slides; the motor of each has the number of its place here
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
    return MujocoBench(mujoco, model, data, joints, ranges, seconds, *rest), tuple(excluded)


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
    name_elements(spec)


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


def sweep_joints(path: Path, *, steps: int = 100) -> SweepReport:
    """Move every joint of a URDF or MJCF through its range, first placed at `steps` positions, then driven by a motor.

    There is no gravity; a free joint of an MJCF's root is removed. Links collide as the convex hulls of their collision meshes,
    so links that are connected by a joint, and links that overlap at rest, are not tested against each other; the report lists
    them.
    Continuous joints make half a turn each way. A joint that is blocked by another link (such as a tray behind a door) is tried
    again with that link's joint opened, which the report states.
    Raise InputError if MuJoCo cannot load the file, MissingExtraError without MuJoCo.
    """
    mujoco = load_mujoco()
    with load_errors(mujoco, path):
        bench, excluded = make_bench(mujoco, Path(path))
    joints = tuple(_cleared_sweep(bench, index, steps) for index in bench.joints)
    return SweepReport(f"mujoco {mujoco.__version__}", joints, excluded)


def _cleared_sweep(bench: MujocoBench, index: int, steps: int) -> JointSweep:
    """Sweep a joint at rest, or if another joint's link is in the way, with that joint at its upper limit."""
    model = bench.model
    posture = np.array(model.qpos0)
    opened: list[str] = []
    sweep = _sweep(bench, index, steps, posture)
    for _ in range(len(bench.joints) - 1):
        blocking = [k for k in bench.joints if bench.body(int(model.jnt_bodyid[k])) == sweep.against and k != index]
        free = [k for k in blocking if not _carried(model, int(model.jnt_bodyid[k]))[model.jnt_bodyid[index]]]
        if not sweep.faults or not free or model.joint(free[0]).name in opened:
            break
        opened.append(model.joint(free[0]).name)
        posture[model.jnt_qposadr[free[0]]] = bench.ranges[free[0], 1]
        sweep = replace(_sweep(bench, index, steps, posture), opened=tuple(opened))
    return sweep


def _sweep(bench: MujocoBench, index: int, steps: int, posture: np.ndarray) -> JointSweep:
    model = bench.model
    lower, upper = (float(v) for v in bench.ranges[index])
    turns = model.jnt_type[index] == bench.mujoco.mjtJoint.mjJNT_HINGE
    kind = "prismatic" if not turns else "revolute" if model.jnt_limited[index] else "continuous"
    penetration, against = _placed(bench, index, np.linspace(lower, upper, steps), posture)
    reached, drift, off, blew_up = _driven(bench, index, posture)
    sweep = JointSweep(model.joint(index).name, kind, lower, upper, *reached, penetration, against, drift, off, faults=())
    return replace(sweep, faults=_faults(bench, sweep, blew_up))


def _placed(bench: MujocoBench, index: int, positions: np.ndarray, posture: np.ndarray) -> tuple[float, str]:
    """Return the maximum penetration beyond that at rest [m] along the joint's range, and the other link."""
    model, data = bench.model, bench.data
    worst, against = 0.0, ""
    moved = _carried(model, int(model.jnt_bodyid[index]))
    for position in positions:
        bench.mujoco.mj_resetData(model, data)
        data.qpos[:] = posture
        data.qpos[model.jnt_qposadr[index]] = position
        bench.mujoco.mj_fwdPosition(model, data)
        for pair, depth in depths(model, data).items():
            growth = depth - bench.rest_depth.get(pair, 0.0)
            if growth > worst:
                worst, against = growth, bench.body(pair[1] if moved[pair[0]] else pair[0])
    return worst, against


def _carried(model: Any, body: int) -> np.ndarray:
    """Return (bodies,) True for a body and all its descendants."""
    carried = np.zeros(model.nbody, bool)
    for b in range(model.nbody):
        carried[b] = b == body or (b > 0 and carried[model.body_parentid[b]])
    return carried


def _driven(bench: MujocoBench, index: int, posture: np.ndarray) -> tuple[tuple[float, float], float, float, bool]:
    """Drive the joint to the upper limit, then to the lower one, while motors hold the other joints in `posture`.

    Return the lower and upper position that it reached, `drift` and `off` of the sweep, and whether it became unstable.
    """
    mujoco, model, data = bench.mujoco, bench.model, bench.data
    mujoco.mj_resetData(model, data)
    data.qpos[:] = posture
    for motor, joint in enumerate(bench.joints):
        data.ctrl[motor] = posture[model.jnt_qposadr[joint]]
    address, own_motor = model.jnt_qposadr[index], bench.joints.index(index)
    geoms = np.flatnonzero(model.geom_bodyid == model.jnt_bodyid[index])
    others = np.arange(model.nq) != address
    lower, upper = bench.ranges[index]
    reached, drift, off, blew_up, start = {1.0: 0.0, -1.0: 0.0}, 0.0, 0.0, False, 0.0
    smooth = (1 - np.cos(np.linspace(0, np.pi, round(bench.seconds[index] / model.opt.timestep)))) / 2
    for way in LEGS:
        goal = float(upper if way > 0 else lower)
        for command in start + (goal - start) * smooth:
            data.ctrl[own_motor] = command
            mujoco.mj_step(model, data)
            drift = max(drift, float(np.abs((data.qpos - posture)[others]).max(initial=0.0)))
        start = goal
        mujoco.mj_forward(model, data)
        blew_up |= is_unstable(data)
        off = max(off, _off(bench, index, float(data.qpos[address]), data.geom_xpos[geoms], geoms))
        reached[way] = float(data.qpos[address])
    return (reached[-1.0], reached[1.0]), drift, off, bool(blew_up)


def _off(bench: MujocoBench, index: int, position: float, places: np.ndarray, geoms: np.ndarray) -> float:
    """Compute the distance of the link's shapes from their positions by the joint alone [m]."""
    axis, anchor, rest = bench.axes[index], bench.anchors[index], bench.places[geoms]
    if bench.model.jnt_type[index] == bench.mujoco.mjtJoint.mjJNT_SLIDE:
        expected = rest + position * axis
    else:
        r = rest - anchor
        turned = np.cos(position) * r + np.sin(position) * np.cross(axis, r)
        expected = anchor + turned + (1 - np.cos(position)) * (r @ axis)[:, None] * axis
    return float(np.linalg.norm(places - expected, axis=1).max(initial=0.0))


def _faults(bench: MujocoBench, sweep: JointSweep, blew_up: bool) -> tuple[str, ...]:
    if blew_up or not np.isfinite([sweep.reached_lower, sweep.reached_upper, sweep.off]).all():
        return (UNSTABLE,)
    faults = motor_faults((sweep.lower, sweep.upper), (sweep.reached_lower, sweep.reached_upper))
    if sweep.penetration is not None and sweep.penetration > DEEP * bench.extent:
        faults.append(f"on its way it penetrates {sweep.against!r} by {sweep.penetration:.4g} m")
    return (*faults, *place_faults(sweep.off, bench.extent))


def rest_contacts(path: Path) -> dict[tuple[str, str], float]:
    """Return the deepest penetration [m] of each pair of links in contact.

    Pairs connected by a joint are included, pairs excluded by the file are not. Raise InputError if MuJoCo cannot load the
    file, MissingExtraError without MuJoCo.
    """
    mujoco = load_mujoco()
    with load_errors(mujoco, path):
        spec = read_spec(mujoco, Path(path))
        spec.compiler.fusestatic = False
        spec.compiler.discardvisual = False
        spec.compiler.boundmass = spec.compiler.boundinertia = LIGHT
        spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_FILTERPARENT)
        name_elements(spec)
        model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return {(model.body(a).name, model.body(b).name): depth for (a, b), depth in sorted(depths(model, data).items())}
