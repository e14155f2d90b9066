"""Newton: a URDF read by its builder, solved by its MuJoCo solver on the CPU (kernels are compiled at first use)."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from warnings import catch_warnings

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.driving import STEP, Limits, Motor, ProvedMechanism, engine_version, load_engine, pose_matrix
from anymesh.checking.engines.mechanisms_ import prove_mechanisms
from anymesh.checking.engines.robot import Robot
from anymesh.errors import InputError

UNLIMITED = 1e6  # limits beyond this mean that there is no limit


class World:
    """The asset of a URDF in Newton. Raise InputError if it cannot be loaded, MissingExtraError without the engine."""

    def __init__(self, path: Path, robot: Robot, motors: Mapping[str, Motor]) -> None:
        newton, warp = (load_engine(name, shown="Newton", extra="newton") for name in ("newton", "warp"))
        warp.config.quiet = True
        self.engine = engine_version("newton", "newton")
        builder = newton.ModelBuilder(gravity=(0.0, 0.0, 0.0))
        try:
            builder.add_urdf(str(path), floating=False, hide_visuals=True)
        except Exception as error:  # its reader and trimesh raise many types of errors
            raise InputError(f"Newton cannot load {path}: {type(error).__name__}: {error}") from error
        self.limits: dict[str, Limits] = {}
        self.order: list[int] = []  # indices of coordinates
        self.dofs: list[int] = []
        self.bodies = {_last(label): k for k, label in enumerate(builder.body_label)}
        for k, label in enumerate(builder.joint_label):
            name = _last(label)
            if name not in motors:
                continue
            dof, motor = builder.joint_qd_start[k], motors[name]
            limits = (float(builder.joint_limit_lower[dof]), float(builder.joint_limit_upper[dof]))
            self.limits[name] = limits if np.abs(limits).max() < UNLIMITED else None
            self.order.append(builder.joint_q_start[k])
            self.dofs.append(dof)
            builder.joint_target_ke[dof], builder.joint_target_kd[dof] = motor.stiffness, motor.damping
            builder.joint_target_mode[dof] = newton.JointTargetMode.POSITION
            builder.joint_effort_limit[dof] = motor.effort
        self.root = self.bodies[robot.roots[0]]
        self.model = builder.finalize(device="cpu")
        self.solver = newton.solvers.SolverMuJoCo(self.model, use_mujoco_cpu=True)
        self.control = self.model.control()
        self.newton, self.driven = newton, True
        self.reset(np.zeros(len(self.order)))

    def reset(self, positions: Float[np.ndarray, " n"]) -> None:
        self.now, self.next = self.model.state(), self.model.state()
        q = np.zeros(self.now.joint_q.shape, np.float32)
        q[self.order] = positions
        for state in (self.now, self.next):
            state.joint_q.assign(q)
            state.joint_qd.zero_()

    def step(self, targets: Float[np.ndarray, " n"]) -> None:
        goal = np.zeros(self.control.joint_target_q.shape, np.float32)
        goal[self.order] = targets
        self.control.joint_target_q.assign(goal)
        self.solver.step(self.now, self.next, self.control, None, STEP)
        self.now, self.next = self.next, self.now

    def push(self, forces: Float[np.ndarray, " n"]) -> None:
        if self.driven:
            self.model.joint_target_ke.zero_()
            self.model.joint_target_kd.zero_()
            self.solver.notify_model_changed(self.newton.ModelFlags.JOINT_DOF_PROPERTIES)
            self.driven = False
        applied = np.zeros(self.control.joint_f.shape, np.float32)
        applied[self.dofs] = forces
        self.control.joint_f.assign(applied)
        self.solver.step(self.now, self.next, self.control, None, STEP)
        self.now, self.next = self.next, self.now

    def positions(self) -> Float[np.ndarray, " n"]:
        return self.now.joint_q.numpy()[self.order].astype(float)

    def pose(self, link: str) -> Float[np.ndarray, "4 4"]:
        rows = self.now.body_q.numpy().astype(float)
        root, body = (pose_matrix(rows[k][:3], rows[k][3:]) for k in (self.root, self.bodies[link]))
        return np.linalg.inv(root) @ body


def prove(path: Path) -> tuple[ProvedMechanism, ...]:
    """Return what Newton makes of the mechanisms of an MJCF: its MuJoCo solver writes the model that it steps as an MJCF."""
    newton = load_engine("newton", shown="Newton", extra="newton")
    builder = newton.ModelBuilder(gravity=(0.0, 0.0, 0.0))
    with TemporaryDirectory() as folder, catch_warnings(action="ignore"):
        written = Path(folder) / "newton.xml"
        builder.add_mjcf(str(path), parse_visuals=False)
        newton.solvers.SolverMuJoCo(builder.finalize(device="cpu"), use_mujoco_cpu=True, save_to_mjcf=str(written))
        return prove_mechanisms(written)


def _last(label: str) -> str:
    """Return the name in a label of the form robot/link."""
    return label.rsplit("/", 1)[-1]
