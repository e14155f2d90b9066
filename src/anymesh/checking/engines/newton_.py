"""Newton: a URDF read by its builder, solved by its MuJoCo solver on the CPU (kernels are compiled at first use)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.driving import STEP, ReadBack, drive
from anymesh.checking.engines.motors import Motor, motors_of, readable
from anymesh.checking.engines.outside import engine_version, load_engine
from anymesh.checking.engines.report import SweepReport
from anymesh.checking.engines.urdf import read_urdf
from anymesh.errors import InputError

UNLIMITED = 1e6  # limits beyond this mean that there is no limit


def sweep_joints(path: Path) -> SweepReport:
    """Drive every joint of a URDF over its range. Raise InputError if Newton cannot load it, MissingExtraError without it."""
    newton, warp = (load_engine(name, shown="Newton", extra="newton") for name in ("newton", "warp"))
    warp.config.quiet = True
    robot = readable(read_urdf(path))
    return drive(_World(newton, warp, Path(path), motors_of(robot), robot.roots[0]), robot)


class _World:
    def __init__(self, newton: Any, warp: Any, path: Path, motors: tuple[Motor, ...], root: str) -> None:
        self.engine = engine_version("newton", "newton")
        self.warp = warp
        builder = newton.ModelBuilder(gravity=(0.0, 0.0, 0.0))
        try:
            builder.add_urdf(str(path), floating=False, hide_visuals=True)
        except Exception as error:  # its reader and trimesh raise many types of errors
            raise InputError(f"Newton cannot load {path}: {type(error).__name__}: {error}") from error
        by_name = {m.joint: m for m in motors}
        self.joints: list[ReadBack] = []
        self.order: list[int] = []  # indices of coordinates
        self.bodies = {_last(label): k for k, label in enumerate(builder.body_label)}
        for k, label in enumerate(builder.joint_label):
            if _last(label) not in by_name:
                continue
            dof, motor = builder.joint_qd_start[k], by_name[_last(label)]
            limits = (float(builder.joint_limit_lower[dof]), float(builder.joint_limit_upper[dof]))
            child = _last(builder.body_label[builder.joint_child[k]])
            self.joints.append(ReadBack(_last(label), child, limits if np.abs(limits).max() < UNLIMITED else None))
            self.order.append(builder.joint_q_start[k])
            builder.joint_target_ke[dof], builder.joint_target_kd[dof] = motor.stiffness, motor.damping
            builder.joint_target_mode[dof] = newton.JointTargetMode.POSITION
            builder.joint_effort_limit[dof] = motor.effort
        self.root = self.bodies[root]
        self.model = builder.finalize(device="cpu")
        self.solver = newton.solvers.SolverMuJoCo(self.model, use_mujoco_cpu=True)
        self.control = self.model.control()
        self._newton = newton
        self.reset()

    def reset(self) -> None:
        self.now, self.next = self.model.state(), self.model.state()
        for state in (self.now, self.next):
            state.joint_q.zero_()
            state.joint_qd.zero_()

    def step(self, targets: Float[np.ndarray, " n"]) -> None:
        goal = np.zeros(self.control.joint_target_q.shape, np.float32)
        goal[self.order] = targets
        self.control.joint_target_q.assign(goal)
        self.solver.step(self.now, self.next, self.control, None, STEP)
        self.now, self.next = self.next, self.now

    def positions(self) -> Float[np.ndarray, " n"]:
        return self.now.joint_q.numpy()[self.order].astype(float)

    def _placed(self, link: str) -> Float[np.ndarray, "4 4"]:
        rows = self.now.body_q.numpy().astype(float)
        root, body = (_matrix(rows[k]) for k in (self.root, self.bodies[link]))
        return np.linalg.inv(root) @ body

    def origin(self, link: str) -> Float[np.ndarray, " 3"]:
        return self._placed(link)[:3, 3]

    def turned(self, link: str) -> Float[np.ndarray, "3 3"]:
        return self._placed(link)[:3, :3]


def _last(label: str) -> str:
    """Return the name in a label of the form robot/link."""
    return label.rsplit("/", 1)[-1]


def _matrix(row: np.ndarray) -> Float[np.ndarray, "4 4"]:
    """Convert a position and quaternion (x, y, z, w) to a matrix."""
    from scipy.spatial.transform import Rotation

    T = np.eye(4)
    T[:3, :3], T[:3, 3] = Rotation.from_quat(row[3:]).as_matrix(), row[:3]
    return T
