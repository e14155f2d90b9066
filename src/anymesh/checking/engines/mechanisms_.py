"""Mechanisms in MuJoCo, as they are written: what follows, closed loops, balls, and parts that only lift off.

Only joints that lead are moved, each by a constraint on it alone, slowly and without gravity, friction and contacts. Which lead
follows from the Jacobian of the file's constraints at rest.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.driving import ENDLESS, UNSTABLE, ProvedMechanism
from anymesh.checking.engines.mjcf_ import load_errors, read_spec, without_ground
from anymesh.mujoco_ import is_unstable, load_mujoco, name_elements
from anymesh.types import Brief

OPEN = 1e-3  # share of the object's extent: a loop that opens further is not closed
BEHIND = 0.02  # share of a follower's range, or of its way where it has none: as far as it may be from its place
SECONDS = 4.0  # [s] of a motion from rest to a limit
STEP = 2e-3  # [s]
MOVE = "anymesh moves "  # prefix of the constraints that move joints
FREE_RATIO = 1e-6  # of the largest singular value: below it, a direction of motion is free
SLACK_RAD = float(np.deg2rad(2))  # by which limits of a ball, which are soft, may be passed
LIFTED = 0.05  # share of the extent that a loose part is lifted


@dataclass(frozen=True, eq=False)
class _Held(Brief):
    """Points of two bodies that a loop holds together, in their frames [m]. number: of the constraint."""

    number: int
    name: str
    bodies: tuple[int, int]
    points: tuple[Float[np.ndarray, " 3"], Float[np.ndarray, " 3"]]


def prove_mechanisms(path: Path) -> tuple[ProvedMechanism, ...]:
    """Move what leads in a URDF or MJCF; return what follows and how well, every loop, ball and loose part.

    Raise InputError if MuJoCo cannot load the file, MissingExtraError without MuJoCo.
    """
    mujoco = load_mujoco()
    with load_errors(mujoco, path):
        spec = read_spec(mujoco, Path(path))
        name_elements(spec)
        for things in (spec.keys, spec.sensors, spec.actuators):
            for thing in list(things):
                spec.delete(thing)
        without_ground(spec, mujoco)
        spec.option.gravity, spec.option.timestep = (0, 0, 0), STEP
        spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        for joint in spec.joints:  # a constraint that moves each joint that leads, off at first
            if joint.type in (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE):
                spec.add_equality(name=f"{MOVE}{joint.name}", type=mujoco.mjtEq.mjEQ_JOINT, name1=joint.name, active=False)
        return tuple(_MechanismBench(mujoco, spec.compile()).proved())


class _MechanismBench:
    def __init__(self, mujoco: Any, model: Any) -> None:
        self.mujoco, self.model, self.data = mujoco, model, mujoco.MjData(model)
        self.extent, kinds = float(model.stat.extent), mujoco.mjtEq
        self.move = {int(model.eq_obj1id[e]): e for e in range(model.neq) if model.eq(e).name.startswith(MOVE)}
        own = [e for e in range(model.neq) if e not in self.move.values() and model.eq_active0[e]]
        joints = [e for e in own if model.eq_type[e] == kinds.mjEQ_JOINT and model.eq_obj2id[e] >= 0]
        self.follow = {int(model.eq_obj1id[e]): (int(model.eq_obj2id[e]), np.array(model.eq_data[e, :5])) for e in joints}
        mujoco.mj_forward(model, self.data)
        self.held = [self._held(e) for e in own if int(model.eq_type[e]) in (int(kinds.mjEQ_CONNECT), int(kinds.mjEQ_WELD))]
        self.J = self._jacobian() if self.follow or self.held else np.zeros((0, model.nv))
        self.leading = self._leading() if len(self.J) else []

    def proved(self) -> Iterator[ProvedMechanism]:
        contact = int(self.mujoco.mjtDisableBit.mjDSBL_CONTACT)
        self.model.opt.disableflags |= contact
        if self.follow or self.held:
            friction = self.model.dof_frictionloss.copy()
            self.model.dof_frictionloss[:] = 0  # of what is far heavier than what leads
            yield from self._coupled()
            self.model.dof_frictionloss[:] = friction
        ball, free = (int(kind) for kind in (self.mujoco.mjtJoint.mjJNT_BALL, self.mujoco.mjtJoint.mjJNT_FREE))
        yield from map(self._ball, np.flatnonzero(self.model.jnt_type == ball).tolist())
        self.model.opt.disableflags &= ~contact
        base = next((b for b in range(1, self.model.nbody) if self.model.body_parentid[b] == 0), 0)  # it may float
        loose = np.flatnonzero((self.model.jnt_type == free) & (self.model.jnt_bodyid != base))
        yield from map(self._free, loose.tolist())

    def _held(self, e: int) -> _Held:
        model, data = self.model, self.data
        sites = model.eq_objtype[e] == self.mujoco.mjtObj.mjOBJ_SITE
        ids = int(model.eq_obj1id[e]), int(model.eq_obj2id[e])
        first, second = (int(model.site_bodyid[k]) for k in ids) if sites else ids
        place = data.site_xpos[ids[0]] if sites else data.xpos[first] + data.xmat[first].reshape(3, 3) @ model.eq_data[e, :3]
        if not sites and model.eq_type[e] == self.mujoco.mjtEq.mjEQ_WELD:
            place = data.xpos[second] + data.xmat[second].reshape(3, 3) @ model.eq_data[e, :3]
        a, b = (data.xmat[k].reshape(3, 3).T @ (place - data.xpos[k]) for k in (first, second))
        name = model.eq(e).name or f"{model.body(first).name} and {model.body(second).name}"
        return _Held(e, name, (first, second), (a, b))

    def _jacobian(self) -> Float[np.ndarray, "m n"]:
        model, data = self.model, self.data
        J = np.zeros((data.nefc, model.nv))
        if self.mujoco.mj_isSparse(model):
            self.mujoco.mju_sparse2dense(J, data.efc_J, data.efc_J_rownnz, data.efc_J_rowadr, data.efc_J_colind)
        else:
            J[:] = data.efc_J.reshape(J.shape)
        return J[: data.ne]

    def _stuck(self, held: _Held) -> bool:
        """Return whether a loop acts on joints, of which none can move."""
        _, values, directions = np.linalg.svd(self.J)
        free = directions[int((values > FREE_RATIO * values.max(initial=1e-9)).sum()) :]
        on = np.abs(self.J[self.data.efc_id[: len(self.J)] == held.number]).max(axis=0, initial=0) > FREE_RATIO
        return bool(on.any() and not (np.abs(free[:, on]) > FREE_RATIO).any())

    def _leading(self) -> list[int]:
        """Return the hinges and slides that constraints move, but for those without a choice, as `mechanisms.closing` does."""
        model, J = self.model, self.J
        joints = sorted(self.move, key=lambda k: (k in self.follow, k))
        dofs = [int(model.jnt_dofadr[k]) for k in joints]
        order = dofs + [d for d in range(model.nv) if d not in dofs]
        leading, rank = [], 0
        for k in reversed(range(len(order))):
            values = np.linalg.svd(J[:, order[k:]], compute_uv=False)
            now = int((values > FREE_RATIO * values.max(initial=1e-9)).sum())
            if now == rank and k < len(joints) and J[:, order[k]].any():
                leading.insert(0, joints[k])
            rank = now
        return leading

    def _coupled(self) -> Iterator[ProvedMechanism]:
        """Move every joint that leads to both limits, and return the largest errors of what follows and of loops."""
        behind, opened, unstable = dict.fromkeys(self.follow, 0.0), [0.0] * len(self.held), False
        for lead in self.leading:
            for goal in self._range(lead):
                unstable |= not self._moved(lead, goal, behind, opened)
                reached = float(self._amounts()[lead])
                if abs(reached - goal) > BEHIND * float(np.ptp(self._range(lead))):
                    fault = f"it comes to {reached:.3g} only, not to its limit {goal:.3g}"
                    yield ProvedMechanism("leader", self.model.joint(lead).name, abs(reached - goal), (fault,))
        for joint, error in behind.items():
            most, name = BEHIND * float(np.ptp(self._range(joint))), self.model.joint(joint).name
            fault = f"it is up to {error:.3g} from where its leader puts it; at most {most:.3g} is valid"
            yield ProvedMechanism("follower", name, error, (UNSTABLE,) if unstable else (fault,) if error > most else ())
        most = OPEN * self.extent
        stuck = {held.name for held in self.held if self._stuck(held)}
        for held, error in zip(self.held, opened, strict=True):
            if held.name in stuck:
                yield ProvedMechanism("loop", held.name, error, ("it holds its joints fast: none of them can move",))
                continue
            fault = f"it opens by {error:.3g} m; at most {most:.3g} m, .1 % of the extent, is valid"
            yield ProvedMechanism("loop", held.name, error, (UNSTABLE,) if unstable else (fault,) if error > most else ())

    def _range(self, joint: int) -> tuple[float, float]:
        turns = self.model.jnt_type[joint] == self.mujoco.mjtJoint.mjJNT_HINGE
        most = np.pi if turns else self.extent
        low, high = self.model.jnt_range[joint] - self.model.qpos0[self.model.jnt_qposadr[joint]]
        if not self.model.jnt_limited[joint]:
            return -most, most
        return (float(low), float(high)) if high - low <= ENDLESS * most else (max(float(low), -most), min(float(high), most))

    def _amounts(self) -> Float[np.ndarray, " n"]:
        """Return how far hinges and slides are from rest [rad or m], by the number of the joint."""
        return self.data.qpos[self.model.jnt_qposadr] - self.model.qpos0[self.model.jnt_qposadr]

    def _moved(self, lead: int, goal: float, behind: dict[int, float], opened: list[float]) -> bool:
        """Move a joint from rest to a limit; return whether the simulation stayed stable."""
        mujoco, model, data = self.mujoco, self.model, self.data
        mujoco.mj_resetData(model, data)
        for joint in self.leading:
            data.eq_active[self.move[joint]] = True
            model.eq_data[self.move[joint], 0] = 0.0
        for share in (1 - np.cos(np.linspace(0, np.pi, round(SECONDS / STEP)))) / 2:
            model.eq_data[self.move[lead], 0] = share * goal
            mujoco.mj_step(model, data)
            if is_unstable(data):
                return False
            q = self._amounts()
            for joint, (leader, coefficients) in self.follow.items():
                error = abs(float(q[joint] - np.polynomial.polynomial.polyval(q[leader], coefficients)))
                behind[joint] = max(behind[joint], error)
            for k, held in enumerate(self.held):
                a, b = (
                    data.xpos[body] + data.xmat[body].reshape(3, 3) @ p
                    for body, p in zip(held.bodies, held.points, strict=True)
                )
                opened[k] = max(opened[k], float(np.linalg.norm(a - b)))
        return True

    def _ball(self, joint: int) -> ProvedMechanism:
        """Turn a ball about all axes of its frame until its limit holds it."""
        mujoco, model, data = self.mujoco, self.model, self.data
        dof, at = int(model.jnt_dofadr[joint]), int(model.jnt_qposadr[joint])
        limit = float(model.jnt_range[joint, 1]) if model.jnt_limited[joint] else np.pi
        turned, dofs = 0.0, slice(dof, dof + 3)
        friction = model.dof_frictionloss[dofs].copy()
        model.dof_frictionloss[dofs] = 0  # what overcomes it would press into the limit, which is soft
        for k, sign in ((k, sign) for k in range(3) for sign in (1, -1)):
            mujoco.mj_resetData(model, data)
            pull = 10 * float(model.dof_M0[dof + k]) + float(model.dof_damping[dof + k])  # turns it within about a second
            data.qfrc_applied[dof + k] = sign * pull * limit
            for _ in range(round(1.5 / STEP)):
                mujoco.mj_step(model, data)
                turned = max(
                    turned, 2 * float(np.arccos(min(abs(float(data.qpos[at : at + 4] @ model.qpos0[at : at + 4])), 1.0)))
                )
        model.dof_frictionloss[dofs] = friction
        faults = [f"it turns by {turned:.3g} rad, beyond its limit of {limit:.3g}"] if turned > limit + SLACK_RAD else []
        faults += [f"it turns by {turned:.3g} rad only"] if turned < limit / 2 else []
        return ProvedMechanism("ball", model.joint(joint).name, turned, tuple(faults))

    def _free(self, joint: int) -> ProvedMechanism:
        """Lift a loose part with its own weight for a second, among contacts."""
        mujoco, model, data = self.mujoco, self.model, self.data
        mujoco.mj_resetData(model, data)
        body = int(model.jnt_bodyid[joint])
        data.xfrc_applied[body, 2] = float(model.body_subtreemass[body]) * 9.81
        start, lifted = float(data.qpos[model.jnt_qposadr[joint] + 2]), 0.0
        for _ in range(round(1.0 / STEP)):
            mujoco.mj_step(model, data)
            lifted = max(lifted, float(data.qpos[model.jnt_qposadr[joint] + 2]) - start)
        fault = f"it is lifted by {lifted:.3g} m only; something holds it"
        return ProvedMechanism("free", model.joint(joint).name, lifted, (fault,) if lifted < LIFTED * self.extent else ())
