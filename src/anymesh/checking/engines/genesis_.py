"""Genesis on the CPU: a URDF with Genesis' convex hulls of the collision meshes (kernels are compiled at first use)."""

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


def sweep_joints(path: Path) -> SweepReport:
    """Drive every joint of a URDF over its range. Raise InputError if Genesis cannot load it, MissingExtraError without it.

    Genesis is initialized once per process, so this should run in its own process.
    """
    genesis = load_engine("genesis", shown="Genesis", extra="genesis")
    robot = readable(read_urdf(path))
    genesis.init(backend=genesis.cpu, logging_level="error")
    return drive(_World(genesis, Path(path), motors_of(robot), robot.roots[0]), robot)


class _World:
    def __init__(self, genesis: Any, path: Path, motors: tuple[Motor, ...], root: str) -> None:
        self.engine = engine_version("genesis-world", "genesis")
        options = genesis.options.SimOptions(dt=STEP, gravity=(0.0, 0.0, 0.0))
        self.scene = genesis.Scene(show_viewer=False, sim_options=options)
        try:
            # By default it adds a rotor inertia of 0.1 to every joint and merges fixed links.
            shape = genesis.morphs.URDF(file=str(path), fixed=True, default_armature=0.0, merge_fixed_links=False)
            self.body = self.scene.add_entity(shape)
            self.scene.build()
        except Exception as error:  # its reader, trimesh and its own checks raise many types of errors
            raise InputError(f"Genesis cannot load {path}: {type(error).__name__}: {error}") from error
        by_name = {m.joint: m for m in motors}
        joints = [j for j in self.body.joints if j.n_dofs == 1 and j.name in by_name]
        self.order = [j.dofs_idx_local[0] for j in joints]
        lower, upper = (np.asarray(end.cpu(), float).reshape(-1) for end in self.body.get_dofs_limit())
        self.joints = [
            ReadBack(j.name, j.link.name, _limits(lower[k], upper[k])) for j, k in zip(joints, self.order, strict=True)
        ]
        chosen = [by_name[j.name] for j in joints]
        effort = np.array([m.effort for m in chosen], np.float32)
        self.body.set_dofs_kp(np.array([m.stiffness for m in chosen], np.float32), self.order)
        self.body.set_dofs_kv(np.array([m.damping for m in chosen], np.float32), self.order)
        self.body.set_dofs_force_range(-effort, effort, self.order)
        self.links = {link.name: link for link in self.body.links}
        self.root = root

    def reset(self) -> None:
        self.body.set_dofs_position(np.zeros(len(self.order), np.float32), self.order)
        self.body.zero_all_dofs_velocity()

    def step(self, targets: Float[np.ndarray, " n"]) -> None:
        self.body.control_dofs_position(targets.astype(np.float32), self.order)
        self.scene.step()

    def positions(self) -> Float[np.ndarray, " n"]:
        return np.asarray(self.body.get_dofs_position(self.order).cpu(), float).reshape(-1)

    def _placed(self, link: str) -> Float[np.ndarray, "4 4"]:
        """Return the pose of a link in the root's frame; a root called world has no link."""
        root = _matrix(self.links[self.root]) if self.root in self.links else np.eye(4)
        return np.linalg.inv(root) @ _matrix(self.links[link])

    def origin(self, link: str) -> Float[np.ndarray, " 3"]:
        return self._placed(link)[:3, 3]

    def turned(self, link: str) -> Float[np.ndarray, "3 3"]:
        return self._placed(link)[:3, :3]


def _limits(lower: float, upper: float) -> tuple[float, float] | None:
    return (float(lower), float(upper)) if np.isfinite([lower, upper]).all() else None


def _matrix(link: Any) -> Float[np.ndarray, "4 4"]:
    from scipy.spatial.transform import Rotation

    w, x, y, z = np.asarray(link.get_quat().cpu(), float).reshape(-1)
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = Rotation.from_quat([x, y, z, w]).as_matrix(), np.asarray(link.get_pos().cpu(), float).reshape(-1)
    return T
