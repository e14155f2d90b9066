"""A push of every joint without motors: it must move by its position, and be at rest again afterwards.

A motor hides what a hand meets: some engines apply strong damping explicitly, so that a light link stands still or shakes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float

STEP = 0.005  # [s] simulated time step
SLOWEST_STEP = 1 / 60  # [s] the longest usual step of an engine that applies damping explicitly (Isaac Sim)
STILL_RATIO = 0.1  # share of the expected motion below which a joint does not move
SHAKING_RATIO = 1e-3  # share of the range: back and forth from step to step by more is shaking
STRENGTH = 1.5  # ratio of the push to what is needed to cross the range in time
WATCHED = 100  # steps at the end, of those after the push
LEFT_ALONE = 200  # steps after the push


@runtime_checkable
class PassiveWorld(Protocol):
    """Protocol of one asset in one engine whose motors can be off; joints in the order of its names."""

    def reset(self, positions: Float[np.ndarray, " n"]) -> None:
        """Set the joints to positions [rad or m], at rest."""

    def push(self, forces: Float[np.ndarray, " n"]) -> None:
        """Advance by STEP seconds with motors off and a force or torque at each joint [N or N m]."""

    def positions(self) -> Float[np.ndarray, " n"]:
        """Return the positions of the joints."""


@dataclass(frozen=True)
class Resisting:
    """What resists a push of a joint.

    inertia [kg or kg m2], friction and effort [N or N m], damping [N s/m or N m s/rad], stiffness [N/m or N m/rad] of a spring,
    which is relaxed at `relaxed` [m or rad].
    """

    inertia: float
    friction: float
    damping: float
    effort: float
    stiffness: float = 0.0
    relaxed: float = 0.0

    @property
    def most_damping(self) -> float:
        """The largest damping that an engine can apply explicitly without standing still or shaking."""
        return self.inertia / SLOWEST_STEP

    def force(self, aim: float, seconds: float) -> float:
        """Return a force within the effort that brings the joint to `aim` [rad or m] in time, if any does."""
        spring = self.stiffness * max(aim - self.relaxed, 0.0)
        needed = self.friction + spring + self.damping * aim / seconds + 2 * self.inertia * aim / seconds**2
        return min(STRENGTH * needed, self.effort)

    def reached(self, force: float, aim: float, seconds: float) -> float:
        """Return where a constant force brings the joint in time, `aim` at most [rad or m]."""
        at = speed = 0.0
        for _ in range(round(seconds / STEP)):
            pull = force - self.friction - self.stiffness * (at - self.relaxed)
            speed = max(speed + STEP * pull / self.inertia, 0.0) / (1 + STEP * self.damping / self.inertia)
            at = min(at + STEP * speed, aim)
        return at


def damping_text(damping: float, resisting: Resisting, slides: bool) -> str | None:
    """Describe damping that is too strong for a light link; None if it is not. slides: of a prismatic joint."""
    if damping <= resisting.most_damping:
        return None
    unit = "N s/m" if slides else "N m s/rad"
    inertia = (
        f"moving mass of {resisting.inertia:.3g} kg" if slides else f"inertia about its axis of {resisting.inertia:.3g} kg m2"
    )
    return (
        f"its damping {damping:.3g} {unit} is too strong for the {inertia}; at most {resisting.most_damping:.3g} {unit} does "
        "(the inertia divided by 1/60 s): with more, the joint stands still in PhysX and shakes in PyBullet"
    )


def push_faults(
    world: PassiveWorld, index: int, resisting: Resisting, limits: tuple[float, float], seconds: float, start: np.ndarray
) -> list[str]:
    """Push one joint halfway to its farther limit without motors, leave it alone, and describe what is wrong.

    index: of the joint; limits: lower and upper [rad or m]; seconds: for the push; start: (n,) positions of all joints.
    """
    sign = 1.0 if limits[1] - start[index] >= start[index] - limits[0] else -1.0
    aim = abs((limits[1] if sign > 0 else limits[0]) - start[index]) / 2
    resisting = replace(resisting, relaxed=sign * float(resisting.relaxed - start[index]))
    if resisting.stiffness * resisting.relaxed > resisting.friction:
        return []  # a spring opens it by itself
    forces = np.zeros(len(start))
    force = resisting.force(aim, seconds)
    forces[index] = sign * force
    expected = resisting.reached(force, aim, seconds)
    world.reset(start)
    farthest = 0.0
    for _ in range(round(seconds / STEP)):
        world.push(forces)
        farthest = max(farthest, sign * float(world.positions()[index] - start[index]))
        if farthest >= aim:
            break
    at = []
    for step in range(LEFT_ALONE):
        world.push(0 * forces)
        if step >= LEFT_ALONE - WATCHED:
            at.append(float(world.positions()[index]))
    steps = np.diff(at)
    faults = []
    if not np.isfinite([farthest, *at]).all():
        return ["without motors, its position becomes infinite after a push"]
    if farthest < STILL_RATIO * expected:
        push = f"a push of {force:.3g} for {seconds:.3g} s without motors"
        faults.append(f"{push} moves it by {farthest:.3g} instead of {expected:.3g}, read from its position")
    shaken = float(np.abs(steps).mean())
    if (steps[1:] * steps[:-1] < 0).mean() > 0.5 and shaken > SHAKING_RATIO * float(np.ptp(limits)):
        faults.append(f"without motors it shakes by {shaken:.3g} from step to step at rest, {shaken / STEP:.3g} per second")
    return faults


class MujocoPassive:
    """A compiled model of MuJoCo without motors, as a PassiveWorld of all its joints; those that are not pushed are held."""

    def __init__(self, mujoco: Any, model: Any) -> None:
        self.mujoco, self.model, self.data = mujoco, model, mujoco.MjData(model)
        self.contacts, self.start = True, np.array(model.qpos0[model.jnt_qposadr])
        self.held = np.ones(model.njnt, bool)

    def reset(self, positions: Float[np.ndarray, " n"]) -> None:
        self.mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[self.model.jnt_qposadr] = self.start = positions
        self.held[:] = True

    def push(self, forces: Float[np.ndarray, " n"]) -> None:
        m, data = self.model, self.data
        self.held &= forces == 0
        data.qfrc_applied[m.jnt_dofadr] = forces
        flag = int(self.mujoco.mjtDisableBit.mjDSBL_CONTACT)
        m.opt.disableflags = m.opt.disableflags & ~flag if self.contacts else m.opt.disableflags | flag
        self.mujoco.mj_step(m, data, max(1, round(STEP / m.opt.timestep)))
        data.qpos[m.jnt_qposadr[self.held]] = self.start[self.held]
        data.qvel[m.jnt_dofadr[self.held]] = 0.0

    def positions(self) -> Float[np.ndarray, " n"]:
        return self.data.qpos[self.model.jnt_qposadr]

    def resisting(self, index: int, effort: float, start: Float[np.ndarray, " n"]) -> Resisting:
        """Return what resists a joint: inertia at the start with the file's armature, friction, damping and spring."""
        m, dof = self.model, self.model.jnt_dofadr[index]
        self.reset(start)
        self.mujoco.mj_forward(m, self.data)
        inertia, unit = np.zeros(m.nv), np.zeros(m.nv)
        unit[dof] = 1.0
        self.mujoco.mj_mulM(m, self.data, inertia, unit)
        values = (inertia[dof], m.dof_frictionloss[dof], m.dof_damping[dof], effort, m.jnt_stiffness[index])
        return Resisting(*(float(v) for v in values), relaxed=float(m.qpos_spring[m.jnt_qposadr[index]]))
