"""PhysX of Isaac Sim by ovphysx on the CPU: the USD beside a URDF, with the motors of this check in place of its drives."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.driving import STEP, Limits, Motor, engine_version, finite_limits, load_engine, pose_matrix
from anymesh.checking.engines.robot import Robot
from anymesh.errors import InputError

SUFFIXES = (".usdc", ".usda", ".usd")
UNLIMITED = 1e6  # [deg or m] limits beyond this mean that there is no limit


class World:
    """The USD beside a URDF in PhysX. Raise InputError if it cannot be loaded, MissingExtraError without the engine."""

    def __init__(self, path: Path, robot: Robot, motors: Mapping[str, Motor]) -> None:
        ovphysx, stages = (load_engine(name, shown="ovphysx", extra="physx") for name in ("ovphysx", "ovstage"))
        schemas = load_engine("ovphysx.samples.python_samples.schema_support", shown="ovphysx", extra="physx")
        self.types = load_engine("ovphysx.types", shown="ovphysx", extra="physx")
        self.engine = engine_version("ovphysx", "ovphysx")
        usd = next((path.with_suffix(s) for s in SUFFIXES if path.with_suffix(s).is_file()), None)
        if usd is None:
            raise InputError(f"PhysX reads USD, and found none beside {path.name}; write it with --formats usd,urdf")
        ovphysx.set_global_config(self.types.GlobalConfigKey.NUM_THREADS, 0)  # a few links: threads cost more than they give
        ovphysx.PhysX.set_cpu_mode(True)
        self.physx = ovphysx.PhysX()
        try:
            stages.population.register_usd_schemas([*map(str, schemas.physx_schema_paths()), str(ovphysx.newton_schema_root())])
            self.stage = stages.Stage("check")
            stages.population.open_usd(self.stage, str(usd), ordinal=1, domains=stages.PopulationDomain.ALL)
            self.stage.advance_write_floor(ordinal=1).wait()
            self.physx.wait_task(self.physx.attach_ovstage(self.stage, read_ordinal=1))
            self.physx.warmup()
            self.physx.wait_all()
        except Exception as error:  # its reader raises many types of errors
            raise InputError(f"PhysX cannot load {usd}: {type(error).__name__}: {error}") from error
        self.paths = stages.PathDictionary(self.stage)
        self.joint, self.link = self.types.SimObjectType.ARTICULATION_JOINT, self.types.SimObjectType.ARTICULATION_LINK
        moving = {j.name: j for j in robot.moving}
        self.names = [name for name in self._read(self.joint, "jointPosition") if name in moving]
        self.unit = {name: 1.0 if moving[name].type == "prismatic" else 180 / np.pi for name in self.names}
        ends = self._read(self.joint, "jointLimit")
        self.limits: dict[str, Limits] = {name: self._limits(name, ends[name].reshape(-1)) for name in self.names}
        self._write(self.link, "disableGravity", dict.fromkeys(self._read(self.link, "disableGravity"), 1))
        self.motors = {name: motors[name] for name in self.names}
        gains = {
            "jointStiffness": {n: m.stiffness / self.unit[n] for n, m in self.motors.items()},
            "jointDamping": {n: m.damping / self.unit[n] for n, m in self.motors.items()},
            "jointMaxForce": {n: m.effort for n, m in self.motors.items()},
        }
        for word, values in gains.items():
            self._write(self.joint, word, values)
        self.root, self.driven = robot.roots[0], True

    def _limits(self, name: str, ends: np.ndarray) -> Limits:
        lower, upper = (float(v) for v in ends)
        return finite_limits(lower / self.unit[name], upper / self.unit[name]) if max(-lower, upper) < UNLIMITED else None

    def _read(self, kind: Any, attribute: str) -> dict[str, np.ndarray]:
        """Return the values of a column by the names of the prims."""
        columns = {}
        with self.physx.read_sync(kind, [attribute], scope=self.types.ObjectScope.ALL) as result:
            for group in result.groups:
                names = [str(p).rsplit("/", 1)[-1] for p in self.paths.get_path_strings(group.prim_list)]
                rows = [t.numpy() for t in group.tensors] if group.is_array else group.tensors[0].numpy()
                columns |= {name: np.array(row, float) for name, row in zip(names, rows, strict=True)}
        return columns

    def _write(self, kind: Any, attribute: str, values: Mapping[str, float]) -> None:
        """Write a column; prims that are not named keep what they have."""
        with self.physx.write_sync(kind, attribute, scope=self.types.ObjectScope.ALL) as session:
            for group in session.groups:
                names = [str(p).rsplit("/", 1)[-1] for p in self.paths.get_path_strings(group.prim_list)]
                if kind == self.joint:  # of joints, a tensor each
                    for tensor, name in zip(group.tensors, names, strict=True):
                        if name in values:
                            tensor.assign(np.full(tensor.shape, values[name], np.float32))
                else:
                    old = group.tensors[0].numpy()
                    group.tensors[0].assign(np.array([values.get(n, o) for n, o in zip(names, old, strict=True)], old.dtype))
                session.commit_sync(group)

    def reset(self, positions: Float[np.ndarray, " n"]) -> None:
        at = {name: float(v) * self.unit[name] for name, v in zip(self.names, positions, strict=True)}
        for word, values in (("jointPosition", at), ("jointPositionTarget", at), ("jointVelocity", dict.fromkeys(at, 0.0))):
            self._write(self.joint, word, values)

    def step(self, targets: Float[np.ndarray, " n"]) -> None:
        goals = {name: float(v) * self.unit[name] for name, v in zip(self.names, targets, strict=True)}
        self._write(self.joint, "jointPositionTarget", goals)
        self.physx.step_sync(STEP)

    def push(self, forces: Float[np.ndarray, " n"]) -> None:
        if self.driven:
            for word in ("jointStiffness", "jointDamping"):
                self._write(self.joint, word, dict.fromkeys(self.names, 0.0))
            self.driven = False
        self._write(self.joint, "jointActuationForce", dict(zip(self.names, forces.tolist(), strict=True)))
        self.physx.step_sync(STEP)

    def positions(self) -> Float[np.ndarray, " n"]:
        columns = self._read(self.joint, "jointPosition")
        return np.array([float(columns[name].reshape(-1)[0]) / self.unit[name] for name in self.names])

    def pose(self, link: str) -> Float[np.ndarray, "4 4"]:
        place, turn = self._read(self.link, "position"), self._read(self.link, "orientation")
        root, body = (pose_matrix(place[name], turn[name]) for name in (self.root, link))
        return np.linalg.inv(root) @ body
