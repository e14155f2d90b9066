"""Gripper model: the tool frame, and the finger positions for a given gap, measured in simulation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from anymesh.applications.plan.robot_ import RobotArm, finger_bodies, positions_of, without_visuals
from anymesh.errors import OptionError
from anymesh.mujoco_ import load_mujoco
from anymesh.types import Brief

STOPS = 9  # measured postures of the gripper, from closed to open
SETTLE = 300  # simulation steps for the fingers to settle in each
PAD = 0.010  # [m] from the fingertips back to the middle of the grasp
NEAR_TIP = 0.005  # [m] from the tips; shapes that reach this far are the pads
CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)


@dataclass(frozen=True, eq=False)
class Hand(Brief):
    """Measured geometry of a gripper.

    T_wrist_tool: (4, 4); gap: (k,) between the pads [m], rising; reach: (k,) from the tool's origin to the tips [m];
    posture: (k, F) of the gripper's joints; control: (k, A) of its actuators.
    """

    T_wrist_tool: Float[np.ndarray, "4 4"]
    gap: Float[np.ndarray, " k"]
    reach: Float[np.ndarray, " k"]
    posture: Float[np.ndarray, "k F"]
    control: Float[np.ndarray, "k A"]

    @property
    def stroke(self) -> float:
        """Largest gap [m]."""
        return float(self.gap[-1])

    def posture_at(self, gap: float) -> Float[np.ndarray, " F"]:
        """Return the positions of the gripper's joints for a gap [m], clipped to its range."""
        return self._at(self.posture, gap)

    def control_at(self, gap: float) -> Float[np.ndarray, " A"]:
        """Return the actuator controls for a gap [m]."""
        return self._at(self.control, gap)

    def reach_at(self, gap: float) -> float:
        """Return how far the tips are ahead of the tool's origin [m]."""
        return float(np.interp(gap, self.gap, self.reach))

    def _at(self, table: np.ndarray, gap: float) -> np.ndarray:
        return np.array([np.interp(gap, self.gap, column) for column in table.T])


def measure_hand(robot: RobotArm) -> Hand:
    """Open and close the gripper in a separate simulation and measure how its fingers move.

    Raise OptionError if no two fingers close on one another.
    """
    if not robot.fingers:
        raise OptionError(f"{robot.name} has no gripper: no joints after its last branching; name them with --gripper")
    mujoco = load_mujoco()
    bench = _Bench(mujoco, robot)
    states = bench.states()
    closing = bench.closing(states)
    order = slice(None) if bench.span(states[0], closing) < bench.span(states[-1], closing) else slice(None, None, -1)
    states = states[order]
    T = bench.tool(states[0], closing)
    tips = np.array([bench.tip(s, T) for s in states])
    gaps = np.array([bench.gap(s, T) for s in states])
    if gaps[-1] - gaps[0] < PAD:
        raise OptionError(f"the gripper of {robot.name} opens by {1000 * (gaps[-1] - gaps[0]):.0f} mm; it needs two fingers")
    rising = np.maximum.accumulate(np.maximum(gaps, 0.0)) + 1e-9 * np.arange(len(gaps))
    posture = np.array([s.qpos[bench.fingers] for s in states])
    return Hand(T, rising, tips, posture, np.array([s.control for s in states]))


@dataclass(frozen=True, eq=False)
class _State(Brief):
    qpos: Float[np.ndarray, " q"]
    control: Float[np.ndarray, " A"]
    points: tuple[Float[np.ndarray, "_ 3"], ...]  # of each finger shape, in the wrist's frame

    @property
    def middles(self) -> Float[np.ndarray, "g 3"]:
        return np.array([p.mean(0) for p in self.points])


class _Bench:
    """Simulation of the robot alone, its arm fixed, without gravity."""

    def __init__(self, mujoco: Any, robot: RobotArm) -> None:
        spec = without_visuals(robot.spec)
        spec.option.gravity = (0, 0, 0)
        spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST  # stable for stiff servos on light fingers
        for motor in [a for a in spec.actuators if a.target in robot.joints]:
            spec.delete(motor)
        for name in robot.joints:  # fix the arm, so that the fingers do not move it
            spec.delete(spec.joint(name))
        self.mujoco, self.robot = mujoco, robot
        self.model = model = spec.compile()
        self.data = mujoco.MjData(model)
        self.fingers = positions_of(model, robot.fingers)
        self.wrist = int(model.body(robot.wrist).id)
        collides = (model.geom_contype | model.geom_conaffinity) != 0
        self.geoms = np.flatnonzero(finger_bodies(model, robot.fingers)[model.geom_bodyid] & collides)
        still = np.setdiff1d(np.arange(model.ngeom), self.geoms)
        model.geom_contype[still] = model.geom_conaffinity[still] = 0  # no longer neighbours of the fingers without joints

    def states(self) -> list[_State]:
        """Return the settled gripper at `STOPS` controls from one end of their range to the other."""
        model, data = self.model, self.data
        ends = np.array([self._ends(a) for a in range(model.nu)]).reshape(-1, 2)
        states = []
        for share in np.linspace(0, 1, STOPS):
            data.ctrl[:] = ends[:, 0] + share * (ends[:, 1] - ends[:, 0])
            for _ in range(SETTLE):
                self.mujoco.mj_step(model, data)
            self.mujoco.mj_kinematics(model, data)
            states.append(_State(data.qpos.copy(), data.ctrl.copy(), tuple(self._points(int(g)) for g in self.geoms)))
        return states

    def _ends(self, actuator: int) -> np.ndarray:
        model = self.model
        if model.actuator_ctrllimited[actuator]:
            return model.actuator_ctrlrange[actuator]
        return model.jnt_range[int(model.actuator_trnid[actuator, 0])]

    def _points(self, geom: int) -> Float[np.ndarray, "n 3"]:
        """Return the vertices of a mesh or the corners of another shape's bounding box, in the wrist's frame."""
        model, data = self.model, self.data
        if int(model.geom_type[geom]) == int(self.mujoco.mjtGeom.mjGEOM_MESH):
            mesh = int(model.geom_dataid[geom])
            first = int(model.mesh_vertadr[mesh])
            own = model.mesh_vert[first : first + int(model.mesh_vertnum[mesh])].astype(float)
        else:
            own = model.geom_aabb[geom, :3] + CORNERS * model.geom_aabb[geom, 3:]
        world = own @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]
        return (world - data.xpos[self.wrist]) @ data.xmat[self.wrist].reshape(3, 3)

    def closing(self, states: list[_State]) -> Float[np.ndarray, " 3"]:
        """Return the direction along which the fingers move most, in the wrist's frame; its largest component is positive."""
        moved = states[-1].middles - states[0].middles
        _, _, axes = np.linalg.svd(moved, full_matrices=False)
        return axes[0] * np.sign(axes[0][np.abs(axes[0]).argmax()])

    def span(self, state: _State, closing: np.ndarray) -> float:
        """Return the distance between the centres of the fingers along the closing direction [m]."""
        return float(np.ptp(state.middles @ closing))

    def tool(self, closed: _State, closing: np.ndarray) -> Float[np.ndarray, "4 4"]:
        """Return the tool's frame: z from the wrist to the tips, y along the closing direction, origin between the pads."""
        points = np.concatenate(closed.points)
        ahead = points.mean(0) - (points.mean(0) @ closing) * closing
        axis = int(np.abs(ahead).argmax())
        if np.abs(ahead[axis]) > 0.99 * np.linalg.norm(ahead):  # most hands are aligned with an axis of their flange
            ahead = np.sign(ahead[axis]) * np.eye(3)[axis]
        ahead = ahead / np.linalg.norm(ahead)
        y = closing - (closing @ ahead) * ahead
        y /= np.linalg.norm(y)
        T = np.eye(4)
        T[:3, :3] = np.stack([np.cross(y, ahead), y, ahead], 1)
        own = points @ T[:3, :3]
        top = own[:, 2].max()
        tips = own[own[:, 2] > top - NEAR_TIP]
        T[:3, 3] = T[:3, :3] @ np.array([tips[:, 0].mean(), (tips[:, 1].min() + tips[:, 1].max()) / 2, top - PAD])
        return T

    def _pads(self, state: _State, T: np.ndarray) -> tuple[Float[np.ndarray, "n 3"], Int[np.ndarray, " n"]]:
        """Return points of the shapes that reach to the tips, in the tool's frame, and the side of each."""
        shapes = [(p - T[:3, 3]) @ T[:3, :3] for p in state.points]
        top = max(p[:, 2].max() for p in shapes)
        reaching = [p[p[:, 2] > top - 2 * PAD] for p in shapes if p[:, 2].max() > top - NEAR_TIP]
        side = [np.full(len(p), int(np.sign(p[:, 1].mean()))) for p in reaching]
        return np.concatenate(reaching), np.concatenate(side)

    def tip(self, state: _State, T: np.ndarray) -> float:
        return float(self._pads(state, T)[0][:, 2].max())

    def gap(self, state: _State, T: np.ndarray) -> float:
        pads, side = self._pads(state, T)
        if not ((side > 0).any() and (side < 0).any()):
            return 0.0
        return float(pads[side > 0, 1].min() - pads[side < 0, 1].max())
