"""Genesis on the CPU: a URDF with Genesis' convex hulls of the collision meshes (kernels are compiled at first use)."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.driving import STEP, Motor, engine_version, finite_limits, load_engine, pose_matrix
from anymesh.checking.engines.robot import Robot
from anymesh.errors import InputError


class World:
    """The asset of a URDF in Genesis. Raise InputError if it cannot be loaded, MissingExtraError without the engine."""

    def __init__(self, path: Path, robot: Robot, motors: Mapping[str, Motor]) -> None:
        genesis = load_engine("genesis", shown="Genesis", extra="genesis")
        genesis.init(backend=genesis.cpu, logging_level="error")  # once per process, so this should be one of its own
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
        joints = [j for j in self.body.joints if j.n_dofs == 1 and j.name in motors]
        self.order = [j.dofs_idx_local[0] for j in joints]
        lower, upper = (np.asarray(end.cpu(), float).reshape(-1) for end in self.body.get_dofs_limit())
        self.limits = {j.name: finite_limits(lower[k], upper[k]) for j, k in zip(joints, self.order, strict=True)}
        chosen = [motors[j.name] for j in joints]
        effort = np.array([m.effort for m in chosen], np.float32)
        self.body.set_dofs_kp(np.array([m.stiffness for m in chosen], np.float32), self.order)
        self.body.set_dofs_kv(np.array([m.damping for m in chosen], np.float32), self.order)
        self.body.set_dofs_force_range(-effort, effort, self.order)
        self.links = {link.name: link for link in self.body.links}
        self.root = robot.roots[0]

    def reset(self, positions: Float[np.ndarray, " n"]) -> None:
        self.body.set_dofs_position(positions.astype(np.float32), self.order)
        self.body.zero_all_dofs_velocity()

    def step(self, targets: Float[np.ndarray, " n"]) -> None:
        self.body.control_dofs_position(targets.astype(np.float32), self.order)
        self.scene.step()

    def push(self, forces: Float[np.ndarray, " n"]) -> None:
        self.body.control_dofs_force(forces.astype(np.float32), self.order)
        self.scene.step()

    def positions(self) -> Float[np.ndarray, " n"]:
        return np.asarray(self.body.get_dofs_position(self.order).cpu(), float).reshape(-1)

    def pose(self, link: str) -> Float[np.ndarray, "4 4"]:
        """Return the pose of a link in the root's frame; a root called world has no link."""
        root = _matrix(self.links[self.root]) if self.root in self.links else np.eye(4)
        return np.linalg.inv(root) @ _matrix(self.links[link])


def _matrix(link: Any) -> Float[np.ndarray, "4 4"]:
    position, (w, x, y, z) = (np.asarray(part.cpu(), float).reshape(-1) for part in (link.get_pos(), link.get_quat()))
    return pose_matrix(position, np.array([x, y, z, w]))
