"""MuJoCo: load a URDF as it is, move every joint through its range, report what happens."""

from __future__ import annotations

import logging
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from anymesh.errors import InputError, MissingExtraError
from anymesh.simulation.report import JointSweep, SweepReport

log = logging.getLogger("anymesh")
NEAR = 0.02  # of a joint's range: reached, or not moved
DEEP = 0.01  # of the asset's extent: penetration or displacement that counts
TOUCH = 1e-4  # of the asset's extent: bodies deeper in each other than this at rest overlap
STIFF = 30.0  # [rad/s] natural frequency of the motors
QUICK = 100.0  # [rad/s] and their highest, for light links with much friction; a rotor's inertia is added to keep it
SLOWEST = 20.0  # [s] a way; heavy links with little effort need their time
LEGS = (1.0, 1.0, -1.0, -1.0)  # where the motor is led, a way's time each: +1 upper limit, -1 lower, twice means held


def _mujoco() -> ModuleType:
    try:
        import mujoco
    except ImportError as error:
        raise MissingExtraError("MuJoCo is not installed; `pip install articulate-anymesh[sim]` brings it") from error
    return mujoco


def sweep_joints(urdf_path: Path, *, steps: int = 100) -> SweepReport:
    """Moves every joint of a URDF through its range, first placed in `steps` positions, then driven by a motor.

    No gravity. Links collide as the convex hulls of their collision meshes, so links that a joint connects, and links
    that overlap at rest, are not tested against each other; the report lists them. Continuous joints make half a turn
    each way. A joint that another link blocks (a tray behind a door) is tried again with that link's joint opened, which
    the report says. InputError when MuJoCo cannot load the file, MissingExtraError without MuJoCo.
    """
    mujoco = _mujoco()
    try:
        bench, excluded = _bench(mujoco, Path(urdf_path))
    except ValueError as error:
        raise InputError(f"MuJoCo cannot load {urdf_path}: {error}") from error
    joints = tuple(_cleared_sweep(bench, index, steps) for index in range(bench.model.njnt))
    return SweepReport(f"mujoco {mujoco.__version__}", joints, excluded)


@dataclass(frozen=True, eq=False)
class _Bench:
    """A model with a motor a joint (actuator i drives joint i), and its state at rest."""

    mujoco: Any
    model: Any
    data: Any
    ranges: np.ndarray  # (joints, 2) [rad or m]
    seconds: np.ndarray  # (joints,) for one way
    rest_depth: dict[tuple[int, int], float]  # pair of bodies -> penetration at rest [m]
    anchors: np.ndarray  # (joints, 3) at rest
    axes: np.ndarray  # (joints, 3) at rest
    places: np.ndarray  # (geoms, 3) at rest

    @property
    def extent(self) -> float:
        return float(self.model.stat.extent)

    def body(self, index: int) -> str:
        return self.model.body(index).name


def _bench(mujoco: Any, urdf_path: Path) -> tuple[_Bench, tuple[tuple[str, str, str], ...]]:
    spec = mujoco.MjSpec.from_file(str(urdf_path))
    spec.option.gravity = (0, 0, 0)
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    model = spec.compile()
    excluded = [
        (model.body(model.body_parentid[b]).name, model.body(b).name, "joined by a joint")
        for b in range(1, model.nbody)
        if model.body_parentid[b] > 0
    ]
    for a, b, _ in excluded:
        spec.add_exclude(bodyname1=a, bodyname2=b)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    overlap = [p for p, depth in _depths(model, data).items() if depth > TOUCH * model.stat.extent]
    for a, b in sorted(overlap):
        excluded.append((model.body(a).name, model.body(b).name, "overlap at rest"))
        spec.add_exclude(bodyname1=excluded[-1][0], bodyname2=excluded[-1][1])
    limited = model.jnt_limited.astype(bool)[:, None]
    ranges = np.where(limited, model.jnt_range, (-np.pi, np.pi)).reshape(-1, 2)
    seconds = _add_motors(mujoco, spec, model, ranges)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    rest = (_depths(model, data), data.xanchor.copy(), data.xaxis.copy(), data.geom_xpos.copy())
    return _Bench(mujoco, model, data, ranges, seconds, *rest), tuple(excluded)


def _add_motors(mujoco: Any, spec: Any, model: Any, ranges: np.ndarray) -> np.ndarray:
    """A critically damped position motor a joint, strong enough to overcome its dry friction within tolerance.

    Returns the seconds that each needs for one way with half its effort, smoothly.
    """
    seconds = np.ones(model.njnt)
    for index in range(model.njnt):
        dof = model.jnt_dofadr[index]
        tolerance = NEAR * float(np.ptp(ranges[index]))
        inertia = float(model.dof_M0[dof])
        effort = float(model.jnt_actfrcrange[index, 1]) if model.jnt_actfrclimited[index] else np.inf
        needed = np.pi * np.sqrt(inertia * float(np.ptp(ranges[index])) / max(effort, 1e-9))
        seconds[index] = min(max(1.0, needed), SLOWEST)
        kp = max(inertia * (STIFF / seconds[index]) ** 2, 4 * float(model.dof_frictionloss[dof]) / tolerance)
        joint = spec.joint(model.joint(index).name)
        joint.armature = max(0.0, kp / QUICK**2 - inertia)
        motor = spec.add_actuator(name=f"motor_{index}", target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        motor.set_to_position(kp=kp, kv=2 * float(np.sqrt(kp * (inertia + joint.armature))))
    return seconds


def _depths(model: Any, data: Any) -> dict[tuple[int, int], float]:
    """Deepest penetration [m] of each pair of bodies in contact."""
    found: dict[tuple[int, int], float] = {}
    for contact in data.contact[: data.ncon]:
        a, b = sorted(int(model.geom_bodyid[g]) for g in contact.geom)
        found[a, b] = max(found.get((a, b), 0.0), -float(contact.dist))
    return found


def _cleared_sweep(bench: _Bench, index: int, steps: int) -> JointSweep:
    """The sweep at rest, or if another joint's link is in the way, with that joint at its upper limit."""
    model = bench.model
    posture = np.array(model.qpos0)
    opened: list[str] = []
    found = _sweep(bench, index, steps, posture)
    for _ in range(model.njnt - 1):
        blocking = [k for k in range(model.njnt) if bench.body(int(model.jnt_bodyid[k])) == found.against and k != index]
        free = [k for k in blocking if not _carried(model, int(model.jnt_bodyid[k]))[model.jnt_bodyid[index]]]
        if not found.faults or not free or model.joint(free[0]).name in opened:
            break
        opened.append(model.joint(free[0]).name)
        posture[model.jnt_qposadr[free[0]]] = bench.ranges[free[0], 1]
        found = replace(_sweep(bench, index, steps, posture), opened=tuple(opened))
    return found


def _sweep(bench: _Bench, index: int, steps: int, posture: np.ndarray) -> JointSweep:
    model = bench.model
    lower, upper = (float(v) for v in bench.ranges[index])
    turns = model.jnt_type[index] == bench.mujoco.mjtJoint.mjJNT_HINGE
    kind = "prismatic" if not turns else "revolute" if model.jnt_limited[index] else "continuous"
    penetration, against = _placed(bench, index, np.linspace(lower, upper, steps), posture)
    driven = _driven(bench, index, posture)
    result = JointSweep(
        name=model.joint(index).name,
        type=kind,
        lower=lower,
        upper=upper,
        reached_lower=driven.lower,
        reached_upper=driven.upper,
        penetration=penetration,
        against=against,
        drift=driven.drift,
        off=driven.off,
        faults=(),
    )
    return replace(result, faults=_faults(bench, result, driven.blew_up))


def _placed(bench: _Bench, index: int, positions: np.ndarray, posture: np.ndarray) -> tuple[float, str]:
    """The deepest that any two links get beyond rest [m] while the joint is placed along its range, and into which."""
    model, data = bench.model, bench.data
    worst, against = 0.0, ""
    moved = _carried(model, int(model.jnt_bodyid[index]))
    for position in positions:
        bench.mujoco.mj_resetData(model, data)
        data.qpos[:] = posture
        data.qpos[model.jnt_qposadr[index]] = position
        bench.mujoco.mj_fwdPosition(model, data)
        for pair, depth in _depths(model, data).items():
            growth = depth - bench.rest_depth.get(pair, 0.0)
            if growth > worst:
                worst, against = growth, bench.body(pair[1] if moved[pair[0]] else pair[0])
    return worst, against


def _carried(model: Any, body: int) -> np.ndarray:
    """(bodies,) True for a body and all that it carries."""
    found = np.zeros(model.nbody, bool)
    for b in range(model.nbody):
        found[b] = b == body or (b > 0 and found[model.body_parentid[b]])
    return found


@dataclass(frozen=True)
class _Drive:
    lower: float
    upper: float
    drift: float
    off: float
    blew_up: bool


def _driven(bench: _Bench, index: int, posture: np.ndarray) -> _Drive:
    """The joint led by its motor to the upper limit, then the lower, while the others' motors hold them in `posture`."""
    mujoco, model, data = bench.mujoco, bench.model, bench.data
    mujoco.mj_resetData(model, data)
    data.qpos[:] = posture
    data.ctrl[:] = posture[model.jnt_qposadr]
    address = model.jnt_qposadr[index]
    geoms = np.flatnonzero(model.geom_bodyid == model.jnt_bodyid[index])
    others = np.arange(model.nq) != address
    lower, upper = bench.ranges[index]
    reached, drift, off, blew_up, start = {1.0: 0.0, -1.0: 0.0}, 0.0, 0.0, False, 0.0
    smooth = (1 - np.cos(np.linspace(0, np.pi, round(bench.seconds[index] / model.opt.timestep)))) / 2
    for way in LEGS:
        goal = float(upper if way > 0 else lower)
        for command in start + (goal - start) * smooth:
            data.ctrl[index] = command
            mujoco.mj_step(model, data)
            drift = max(drift, float(np.abs((data.qpos - posture)[others]).max(initial=0.0)))
        start = goal
        mujoco.mj_forward(model, data)
        blew_up |= not np.isfinite(data.qpos).all() or any(w.number for w in data.warning)
        off = max(off, _off(bench, index, float(data.qpos[address]), data.geom_xpos[geoms], geoms))
        reached[way] = float(data.qpos[address])
    return _Drive(reached[-1.0], reached[1.0], drift, off, bool(blew_up))


def _off(bench: _Bench, index: int, position: float, places: np.ndarray, geoms: np.ndarray) -> float:
    """How far the link's shapes are from where the joint alone would have put them [m]."""
    axis, anchor, rest = bench.axes[index], bench.anchors[index], bench.places[geoms]
    if bench.model.jnt_type[index] == bench.mujoco.mjtJoint.mjJNT_SLIDE:
        expected = rest + position * axis
    else:
        r = rest - anchor
        turned = np.cos(position) * r + np.sin(position) * np.cross(axis, r)
        expected = anchor + turned + (1 - np.cos(position)) * (r @ axis)[:, None] * axis
    return float(np.linalg.norm(places - expected, axis=1).max(initial=0.0))


def _faults(bench: _Bench, found: JointSweep, blew_up: bool) -> tuple[str, ...]:
    if blew_up or not np.isfinite([found.reached_lower, found.reached_upper, found.off]).all():
        return ("the simulation became unstable",)
    span = found.upper - found.lower
    faults = []
    for word, limit, reached in (
        ("upper", found.upper, found.reached_upper),
        ("lower", found.lower, found.reached_lower),
    ):
        if abs(reached - limit) > NEAR * span:
            faults.append(f"a motor brings it to {reached:.4g} only, not to its {word} limit {limit:.4g}")
    if abs(found.reached_upper - found.reached_lower) < NEAR * span:
        faults.append("it is stuck")
    if found.penetration > DEEP * bench.extent:
        faults.append(f"on its way it goes {found.penetration:.4g} m into {found.against!r}")
    if found.off > DEEP * bench.extent:
        faults.append(f"its link is {found.off:.4g} m from where the joint should hold it")
    return tuple(faults)
