"""MuJoCo: load a URDF or MJCF unchanged, move every joint through its range, and report faults."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.checking.engines.driving import (
    DEEP,
    DEFAULT_EFFORT,
    ENDLESS,
    MIN_SETTLING_RATIO,
    REACHED_RATIO,
    UNSTABLE,
    JointSweep,
    SweepReport,
    distance_off,
    motor_faults,
    place_faults,
)
from anymesh.checking.engines.locate import mjcf_beside
from anymesh.checking.engines.mechanisms_ import prove_mechanisms
from anymesh.checking.engines.mjcf_ import load_errors, read_spec, without_ground
from anymesh.checking.engines.pushing import MujocoPassive, push_faults
from anymesh.mujoco_ import is_unstable, load_mujoco, name_elements
from anymesh.types import Brief

TOUCH = 1e-4  # share of the asset's extent: bodies with deeper penetration at rest overlap
MOTOR_FREQUENCY_1S = 30.0  # [rad/s] natural frequency of a motor whose motion takes 1 s; lower for a longer one
MAX_MOTOR_FREQUENCY = 100.0  # [rad/s], for light links with much friction; rotor inertia is added to keep it
MAX_MOTION_SECONDS = 20.0  # [s] maximum duration of a motion; heavy links with little effort are slow
LEGS = (1.0, 1.0, -1.0, -1.0)  # sequence of motor targets: +1 upper limit, -1 lower; a repeated one holds the position
TRIES = 5  # positions of another joint that may be in the way
Coupling = tuple[str, str, np.ndarray]  # a joint, its leader ("" for none), and coefficients of a polynomial


@dataclass(frozen=True, eq=False)
class MujocoBench(Brief):
    """A model with a motor for each hinge and slide joint, and its state at rest."""

    mujoco: Any
    model: Any
    data: Any
    joints: tuple[int, ...]  # hinges and slides; the motor of each has the number of its place here
    ranges: np.ndarray  # (all joints, 2) [rad or m]
    seconds: np.ndarray  # (all joints,) duration of a motion from limit to limit
    rest_depth: dict[tuple[int, int], float]  # pair of bodies -> penetration at rest [m]
    followers: Mapping[int, tuple[int, np.ndarray]]  # joint -> the one that it follows, and coefficients of the polynomial
    undriven: Mapping[int, str]  # joints that are not driven themselves -> why
    passive: MujocoPassive  # the same without motors

    @property
    def extent(self) -> float:
        return float(self.model.stat.extent)

    def body(self, index: int) -> str:
        return self.model.body(index).name

    def posture(self, moved: Mapping[int, float]) -> np.ndarray:
        """Return qpos with some joints moved, and with those that follow, within their limits."""
        q = np.array(self.model.qpos0)
        address = self.model.jnt_qposadr
        for joint in self.joints:  # engines push a joint whose rest position is outside its limits
            q[address[joint]] = np.clip(q[address[joint]], *self.ranges[joint])
        for joint, position in moved.items():
            q[address[joint]] = position
        for _ in range(len(self.followers)):  # leaders may follow others
            for joint, (leader, coefficients) in self.followers.items():
                x = 0.0 if leader < 0 else q[address[leader]] - self.model.qpos0[address[leader]]
                wanted = self.model.qpos0[address[joint]] + np.polynomial.polynomial.polyval(x, coefficients)
                q[address[joint]] = np.clip(wanted, *self.ranges[joint])
        return q


def make_bench(mujoco: Any, path: Path) -> tuple[MujocoBench, tuple[tuple[str, str, str], ...]]:
    """Create the bench, and the pairs of links that are not tested against each other, with the reason."""
    spec = read_spec(mujoco, path)
    couplings, loops = _strip(spec, mujoco)
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
    unlimited = np.where(model.jnt_type == mujoco.mjtJoint.mjJNT_SLIDE, model.stat.extent, np.pi)[:, None] * (-1.0, 1.0)
    limited &= np.ptp(model.jnt_range, axis=1)[:, None] <= ENDLESS * unlimited[:, 1:]
    stated = np.where(model.jnt_limited.astype(bool)[:, None], model.jnt_range, unlimited)
    ranges = np.where(limited, stated, np.clip(unlimited, stated[:, :1], stated[:, 1:])).reshape(
        -1, 2
    )  # of many turns, the first
    single = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
    joints = tuple(k for k in range(model.njnt) if int(model.jnt_type[k]) in single)
    followers, undriven = _coupled(model, joints, couplings, loops)
    passive = MujocoPassive(mujoco, model)
    seconds = _add_motors(mujoco, spec, model, ranges, joints)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    rest = depths(model, data)
    return MujocoBench(mujoco, model, data, joints, ranges, seconds, rest, followers, undriven, passive), tuple(excluded)


def _joined(model: Any) -> list[tuple[int, int]]:
    """Return each body with its parent, and with bodies fixed to a moving parent, as MuJoCo filters contacts."""
    direct = [(int(model.body_parentid[b]), b) for b in range(1, model.nbody) if model.body_parentid[b] > 0]
    held = {b: int(model.body_weldid[model.body_parentid[model.body_weldid[b]]]) for b in range(1, model.nbody)}
    moving = [b for b in held if model.body_weldid[b] > 0 and held[b] > 0]
    fixed = [(a, b) for b in moving for a in range(1, model.nbody) if model.body_weldid[a] == held[b]]
    return direct + [pair for pair in fixed if pair not in direct]


def _strip(spec: Any, mujoco: Any) -> tuple[list[Coupling], list[tuple[str, str]]]:
    """Remove actuators, sensors, keyframes, tendons, free and ball joints, equalities, the ground; name unnamed elements.

    Return the joints that equalities couple, and the pairs of bodies that they hold together.
    """
    name_elements(spec)
    kinds, objects = mujoco.mjtEq, mujoco.mjtObj
    couplings, loops = [], []
    mocap = {body.name for body in spec.bodies if body.mocap}
    for e in spec.equalities:
        if e.active and e.type == kinds.mjEQ_JOINT:
            couplings.append((e.name1, e.name2, np.array(e.data[:5])))
        elif e.active and e.type in (kinds.mjEQ_CONNECT, kinds.mjEQ_WELD):
            sites = e.objtype == objects.mjOBJ_SITE
            bodies = [spec.site(name).parent.name if sites else name or "world" for name in (e.name1, e.name2)]
            loops += [] if mocap & set(bodies) else [(bodies[0], bodies[1])]
    for things in (spec.keys, spec.sensors, spec.actuators, spec.equalities, spec.tendons):
        for thing in list(things):
            spec.delete(thing)
    for joint in list(spec.joints):
        joint.margin = 0.0  # a limit that acts earlier keeps a motor from it
        if joint.type in (mujoco.mjtJoint.mjJNT_FREE, mujoco.mjtJoint.mjJNT_BALL):
            spec.delete(joint)
    without_ground(spec, mujoco)
    return couplings, loops


def _coupled(
    model: Any, joints: tuple[int, ...], couplings: list[Coupling], loops: list[tuple[str, str]]
) -> tuple[dict[int, tuple[int, np.ndarray]], dict[int, str]]:
    followers: dict[int, tuple[int, np.ndarray]] = {}
    undriven: dict[int, str] = {}
    for name, leader_name, coefficients in couplings:
        joint, leader = model.joint(name).id, model.joint(leader_name).id if leader_name else -1
        if joint in joints and leader in (*joints, -1) and joint not in followers and joint != leader:
            followers[joint] = leader, coefficients
            undriven[joint] = f"follows {leader_name}" if leader_name else "held by the file"
    for bodies in loops:
        above = [_bodies_to_root(model, model.body(name).id) for name in bodies]
        for body in set(above[0]) ^ set(above[1]):
            first = int(model.body_jntadr[body])
            loop = range(first, first + int(model.body_jntnum[body])) if first >= 0 else ()
            undriven |= {k: f"part of a closed loop of {bodies[0]} and {bodies[1]}" for k in loop if k in joints}
    return followers, undriven


def _bodies_to_root(model: Any, body: int) -> list[int]:
    bodies = [body]
    while bodies[-1] > 0:
        bodies.append(int(model.body_parentid[bodies[-1]]))
    return bodies


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
        turns = float(np.ptp(ranges[index])) / np.pi if model.jnt_type[index] == mujoco.mjtJoint.mjJNT_HINGE else 0.0
        seconds[index] = min(max(1.0, needed, turns), MAX_MOTION_SECONDS)  # a faster turn throws what it carries
        kp = max(
            inertia * (MOTOR_FREQUENCY_1S / seconds[index]) ** 2, 4 * float(model.dof_frictionloss[dof]) / max(tolerance, 1e-9)
        )
        rest = float(model.qpos_spring[model.jnt_qposadr[index]])
        far = max(float(np.abs(ranges[index] - rest).max()) * REACHED_RATIO / max(tolerance, 1e-9), 1.0)  # in ranges
        kp = max(kp, 2 * far * float(model.jnt_stiffness[index]) / REACHED_RATIO)  # a spring of the file counteracts it
        kp = max(kp, MIN_SETTLING_RATIO * float(model.dof_damping[dof]) / seconds[index])
        joint = spec.joint(model.joint(index).name)
        if np.any(joint.springdamper):  # the compiler would make another spring for another inertia
            joint.springdamper = (0.0, 0.0)
            joint.stiffness = _first(joint.stiffness, model.jnt_stiffness[index])
            joint.damping = _first(joint.damping, model.dof_damping[dof])
        added = max(0.0, kp / MAX_MOTOR_FREQUENCY**2 - inertia)
        joint.armature = float(model.dof_armature[dof]) + added  # the file's own is part of the inertia
        motor = spec.add_actuator(name=f"motor_{index}", target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        motor.ctrllimited = motor.forcelimited = int(mujoco.mjtLimited.mjLIMITED_FALSE)  # a file may have other defaults
        motor.gear = (1, 0, 0, 0, 0, 0)
        motor.set_to_position(kp=kp, kv=2 * float(np.sqrt(kp * (inertia + added))))
    return seconds


def _first(of: Any, value: float) -> Any:
    """Return a value as MuJoCo takes it: since version 4, the first coefficient of a polynomial."""
    return float(value) if np.ndim(of) == 0 else np.eye(len(of))[0] * float(value)


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
    them. Joints that follow others move with these.
    Continuous joints make half a turn each way. A joint that is blocked by another link (such as a tray behind a door) is tried
    again with the joints between the two links moved, which the report states.
    Raise InputError if MuJoCo cannot load the file, MissingExtraError without MuJoCo.
    """
    mujoco = load_mujoco()
    with load_errors(mujoco, path):
        bench, excluded = make_bench(mujoco, Path(path))
    driven = [index for index in bench.joints if index not in bench.undriven]
    joints = tuple(_pushed(bench, index, _cleared_sweep(bench, index, steps)) for index in driven)
    undriven = tuple((bench.model.joint(k).name, why) for k, why in bench.undriven.items())
    mechanisms = prove_mechanisms(mjcf_beside(Path(path)) or Path(path))
    return SweepReport(f"mujoco {mujoco.__version__}", joints, excluded, undriven, mechanisms)


def _pushed(bench: MujocoBench, index: int, sweep: JointSweep) -> JointSweep:
    """Add the faults of a push without motors, if the joint has none so far and leads no other."""
    if sweep.faults or index in {leader for leader, _ in bench.followers.values()}:
        return sweep
    model, (lower, upper) = bench.model, bench.ranges[index]
    effort = float(model.jnt_actfrcrange[index, 1]) if model.jnt_actfrclimited[index] else DEFAULT_EFFORT
    start = bench.posture({k: float(bench.ranges[k, 1]) for k in bench.joints if model.joint(k).name in sweep.opened})
    start = start[model.jnt_qposadr]
    resisting, limits = bench.passive.resisting(index, effort, start), (float(lower), float(upper))
    args = bench.passive, index, resisting, limits, float(bench.seconds[index]), start
    if not (faults := push_faults(*args)):
        return sweep
    bench.passive.contacts = False
    touching = not push_faults(*args)
    bench.passive.contacts = True
    cause = "; contacts of its link are the cause" if touching else ""
    return replace(sweep, faults=tuple(fault + cause for fault in faults), touching=touching)


def _cleared_sweep(bench: MujocoBench, index: int, steps: int) -> JointSweep:
    """Sweep a joint at rest, or if another link is in the way, with joints between the two links moved."""
    moved: dict[int, float] = {}
    first = sweep = _sweep(bench, index, steps, moved)
    between = _between(bench, index, sweep.against) if sweep.faults else []
    for _ in between:
        own = [
            k
            for k in _between(bench, index, sweep.against)
            if bench.body(int(bench.model.jnt_bodyid[k])) == sweep.against and k not in moved
        ]
        if not sweep.faults or not own:
            break
        moved[own[0]] = float(bench.ranges[own[0], 1])
        opened = tuple(bench.model.joint(k).name for k in moved)
        sweep = replace(_sweep(bench, index, steps, moved), opened=opened)
    if not sweep.faults:
        return sweep
    if any(_serial(bench.model, index, other) for other in between):
        return replace(first, posture=True)
    for other in between:
        for position in np.linspace(*bench.ranges[other][::-1], TRIES):
            tried = _sweep(bench, index, steps, {other: float(position)})
            if not tried.faults:
                return replace(tried, opened=(bench.model.joint(other).name,))
    return sweep


def _serial(model: Any, a: int, b: int) -> bool:
    """Return whether one of two joints carries the other, as in an arm, whose user chooses the posture."""
    first, second = int(model.jnt_bodyid[a]), int(model.jnt_bodyid[b])
    return bool(_carried(model, first)[second] or _carried(model, second)[first])


def _between(bench: MujocoBench, index: int, against: str) -> list[int]:
    """Return the other driven joints on which the place of a joint's link relative to another link depends."""
    model = bench.model
    names = [bench.body(b) for b in range(model.nbody)]
    if against not in names:
        return []
    mine, other = (_bodies_to_root(model, b) for b in (int(model.jnt_bodyid[index]), names.index(against)))
    carried = _carried(model, int(model.jnt_bodyid[index]))
    apart = (set(mine) ^ set(other)) | set(np.flatnonzero(carried).tolist())
    return [k for k in bench.joints if k != index and k not in bench.undriven and int(model.jnt_bodyid[k]) in apart]


def _sweep(bench: MujocoBench, index: int, steps: int, moved: Mapping[int, float]) -> JointSweep:
    model = bench.model
    lower, upper = (float(v) for v in bench.ranges[index])
    turns = model.jnt_type[index] == bench.mujoco.mjtJoint.mjJNT_HINGE
    kind = "prismatic" if not turns else "revolute" if model.jnt_limited[index] else "continuous"
    penetration, against = _placed(bench, index, np.linspace(lower, upper, steps), moved)
    reached, drift, off, blew_up = _driven(bench, index, moved)
    sweep = JointSweep(model.joint(index).name, kind, lower, upper, *reached, penetration, against, drift, off, faults=())
    return replace(sweep, faults=_faults(bench, sweep, blew_up))


def _placed(bench: MujocoBench, index: int, positions: np.ndarray, moved: Mapping[int, float]) -> tuple[float, str]:
    """Return the maximum penetration beyond that at rest [m] along the joint's range, and the other link."""
    model, data = bench.model, bench.data
    worst, against = 0.0, ""
    led = _carried(model, int(model.jnt_bodyid[index]))
    for position in positions:
        bench.mujoco.mj_resetData(model, data)
        data.qpos[:] = bench.posture({**moved, index: float(position)})
        bench.mujoco.mj_fwdPosition(model, data)
        for pair, depth in depths(model, data).items():
            growth = depth - bench.rest_depth.get(pair, 0.0)
            if growth > worst:
                worst, against = growth, bench.body(pair[1] if led[pair[0]] else pair[0])
    return worst, against


def _carried(model: Any, body: int) -> np.ndarray:
    """Return (bodies,) True for a body and all its descendants."""
    carried = np.zeros(model.nbody, bool)
    for b in range(model.nbody):
        carried[b] = b == body or (b > 0 and carried[model.body_parentid[b]])
    return carried


def _driven(bench: MujocoBench, index: int, moved: Mapping[int, float]) -> tuple[tuple[float, float], float, float, bool]:
    """Drive the joint to the upper limit, then to the lower one; motors hold the other joints, or move them as they follow.

    Return the lower and upper position that it reached, `drift` and `off` of the sweep, and whether it became unstable.
    """
    mujoco, model, data = bench.mujoco, bench.model, bench.data
    addresses = model.jnt_qposadr[list(bench.joints)]
    mujoco.mj_resetData(model, data)
    data.qpos[:] = start_posture = bench.posture(moved)
    data.ctrl[:] = start_posture[addresses]
    address = model.jnt_qposadr[index]
    geoms = np.flatnonzero(model.geom_bodyid == model.jnt_bodyid[index])
    mujoco.mj_kinematics(model, data)
    place = data.xaxis[index].copy(), data.xanchor[index].copy(), data.geom_xpos[geoms].copy()
    others = np.ones(model.nq, bool)
    followers = [model.jnt_qposadr[k] for k in bench.followers if k != index]
    others[[address, *followers]] = False
    lower, upper = bench.ranges[index]
    reached, drift, off, blew_up, start = {1.0: 0.0, -1.0: 0.0}, 0.0, 0.0, False, float(start_posture[address])
    smooth = (1 - np.cos(np.linspace(0, np.pi, round(bench.seconds[index] / model.opt.timestep)))) / 2
    for way in LEGS:
        goal = float(upper if way > 0 else lower)
        for command in start + (goal - start) * smooth:
            if bench.followers:
                data.ctrl[:] = bench.posture({**moved, index: command})[addresses]
            data.ctrl[bench.joints.index(index)] = command
            mujoco.mj_step(model, data)
            drift = max(drift, float(np.abs((data.qpos - start_posture)[others]).max(initial=0.0)))
        start = goal
        mujoco.mj_forward(model, data)
        blew_up |= is_unstable(data)
        reached[way] = float(data.qpos[address])
        data.qpos[others] = start_posture[others]  # what moves the other joints does not count
        led = data.qpos[followers].copy()
        data.qpos[followers] = start_posture[followers]
        mujoco.mj_kinematics(model, data)
        step = reached[way] - float(start_posture[address])
        off = max(off, distance_off(model.jnt_type[index] == mujoco.mjtJoint.mjJNT_SLIDE, step, place, data.geom_xpos[geoms]))
        data.qpos[followers] = led
    return (reached[-1.0], reached[1.0]), drift, off, bool(blew_up)


def _faults(bench: MujocoBench, sweep: JointSweep, blew_up: bool) -> tuple[str, ...]:
    if blew_up or not np.isfinite([sweep.reached_lower, sweep.reached_upper, sweep.off]).all():
        return (UNSTABLE,)
    faults = motor_faults((sweep.lower, sweep.upper), (sweep.reached_lower, sweep.reached_upper))
    if sweep.penetration is not None and sweep.penetration > DEEP * bench.extent:
        faults.append(f"on its way it penetrates {sweep.against!r} by {sweep.penetration:.4g} m")
    return (*faults, *place_faults(sweep.off, bench.extent))
