"""MuJoCo: load a URDF or MJCF unchanged, move every joint through its range, and report faults."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.checking.engines.motors import REACHED_RATIO
from anymesh.checking.engines.mujoco_bench_ import MujocoBench, depths, make_bench
from anymesh.checking.engines.report import JointSweep, SweepReport
from anymesh.errors import InputError
from anymesh.mujoco_ import load_mujoco

DEEP = 0.01  # share of the asset's extent: penetration or displacement that counts as a fault
LEGS = (1.0, 1.0, -1.0, -1.0)  # sequence of motor targets: +1 upper limit, -1 lower; a repeated one holds the position


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
    try:
        bench, excluded = make_bench(mujoco, Path(path))
    except (ValueError, mujoco.FatalError, InputError) as error:
        raise InputError(f"MuJoCo cannot load {path}: {' '.join(str(error).split())}") from error
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


@dataclass(frozen=True)
class _Drive:
    lower: float
    upper: float
    drift: float
    off: float
    blew_up: bool


def _driven(bench: MujocoBench, index: int, posture: np.ndarray) -> _Drive:
    """Drive the joint to the upper limit, then to the lower one, while motors hold the other joints in `posture`."""
    mujoco, model, data = bench.mujoco, bench.model, bench.data
    mujoco.mj_resetData(model, data)
    data.qpos[:] = posture
    motors = bench.motors
    for joint, motor in motors.items():
        data.ctrl[motor] = posture[model.jnt_qposadr[joint]]
    address = model.jnt_qposadr[index]
    geoms = np.flatnonzero(model.geom_bodyid == model.jnt_bodyid[index])
    others = np.arange(model.nq) != address
    lower, upper = bench.ranges[index]
    reached, drift, off, blew_up, start = {1.0: 0.0, -1.0: 0.0}, 0.0, 0.0, False, 0.0
    smooth = (1 - np.cos(np.linspace(0, np.pi, round(bench.seconds[index] / model.opt.timestep)))) / 2
    for way in LEGS:
        goal = float(upper if way > 0 else lower)
        for command in start + (goal - start) * smooth:
            data.ctrl[motors[index]] = command
            mujoco.mj_step(model, data)
            drift = max(drift, float(np.abs((data.qpos - posture)[others]).max(initial=0.0)))
        start = goal
        mujoco.mj_forward(model, data)
        blew_up |= not np.isfinite(data.qpos).all() or any(w.number for w in data.warning)
        off = max(off, _off(bench, index, float(data.qpos[address]), data.geom_xpos[geoms], geoms))
        reached[way] = float(data.qpos[address])
    return _Drive(reached[-1.0], reached[1.0], drift, off, bool(blew_up))


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
        return ("the simulation became unstable",)
    span = sweep.upper - sweep.lower
    faults = []
    for word, limit, reached in (
        ("upper", sweep.upper, sweep.reached_upper),
        ("lower", sweep.lower, sweep.reached_lower),
    ):
        if abs(reached - limit) > REACHED_RATIO * span:
            faults.append(f"a motor brings it to {reached:.4g} only, not to its {word} limit {limit:.4g}")
    if abs(sweep.reached_upper - sweep.reached_lower) < REACHED_RATIO * span:
        faults.append("it does not move")
    if sweep.penetration is not None and sweep.penetration > DEEP * bench.extent:
        faults.append(f"on its way it penetrates {sweep.against!r} by {sweep.penetration:.4g} m")
    if sweep.off > DEEP * bench.extent:
        faults.append(f"its link is {sweep.off:.4g} m from where the joint should place it")
    return tuple(faults)
