"""Articulated object: the joint to move, the surface of its part, and the collision model."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.applications.plan.plans import PlanError
from anymesh.applications.plan.robot_ import bodies_below, single_joints
from anymesh.checking.engines.locate import find_description
from anymesh.checking.engines.mujoco_ import read_spec
from anymesh.errors import InputError, OptionError
from anymesh.mujoco_ import load_mujoco
from anymesh.runtime import read_json
from anymesh.types import Brief, JointType, Motion

AUTO = "auto"
USUAL_RATIO, USUAL_TURN = 0.5, np.deg2rad(60.0)  # share of a range that is planned by default; of endless joints [rad]
OVERLAP = 1e-4  # share of the object's extent; links that overlap by more at rest do not collide


@dataclass(frozen=True, eq=False)
class ArticulatedObject(Brief):
    """Joint of an asset at rest, in the asset frame.

    part: link moved by the joint; limits: [rad or m], None for a continuous joint; carried: names of all links that move with
    the joint; part_triangles, other_triangles: (n, 3, 3) visible surfaces [m]; spec: MuJoCo spec without actuators; opened:
    values of other joints that are not at rest.
    """

    name: str
    path: Path
    spec: Any
    joint: str
    part: str
    motion: Motion
    limits: tuple[float, float] | None
    carried: tuple[str, ...]
    part_triangles: Float[np.ndarray, "n 3 3"]
    other_triangles: Float[np.ndarray, "m 3 3"]
    opened: tuple[tuple[str, float], ...] = ()

    @property
    def turns(self) -> bool:
        return self.motion.kind is JointType.REVOLUTE

    def say(self, value: float) -> str:
        """Format a value of the joint for messages, in degrees or millimetres."""
        return f"{np.rad2deg(value):.1f} deg" if self.turns else f"{1000 * value:.1f} mm"

    def usual_value(self) -> float:
        """Return half of the range in its longer direction, 60 degrees of an endless joint [rad or m]."""
        return USUAL_TURN if self.limits is None else USUAL_RATIO * max(self.limits, key=abs)

    def check_value(self, value: float) -> float:
        """Return the value, clipped to the joint's range. Raise PlanError with the nearest value if it is outside the range."""
        if not np.isfinite(value):
            raise PlanError(f"--to: found {value}; a finite number is needed")
        if self.limits is None:
            return value
        low, high = self.limits
        nearest = float(np.clip(value, low, high))
        if abs(nearest - value) > 1e-6 * max(high - low, 1e-9):
            raise PlanError(
                f"{self.joint} moves from {self.say(low)} to {self.say(high)}, found {self.say(value)}; "
                f"the nearest value is {self.say(nearest)} ({nearest:.4g})",
                nearest,
            )
        return nearest


def open_object(path: str | Path, joint: str, opened: tuple[tuple[str, float], ...] = ()) -> ArticulatedObject:
    """Read an asset folder, a URDF or an MJCF.

    joint: name of the joint or of the part that it moves, or auto: the one of highest confidence, else the first; opened:
    values of other joints [rad or m].

    Raise InputError if there is nothing to read, OptionError if the joint does not exist or does not move.
    """
    mujoco = load_mujoco()
    file = description(Path(path))
    try:
        spec = read_spec(mujoco, file)
        spec.compiler.fusestatic = False
        for mesh in spec.meshes:
            mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
        for motor in list(spec.actuators):
            spec.delete(motor)
        model = spec.compile()
    except (ValueError, mujoco.FatalError) as error:
        raise InputError(f"MuJoCo cannot load {file}: {' '.join(str(error).split())}") from error
    data = mujoco.MjData(model)
    for name, value in opened:
        data.qpos[model.joint(name).qposadr[0]] = value
    mujoco.mj_forward(model, data)
    number = _joint(model, _surest(model, Path(path)) if joint == AUTO else joint)
    body = int(model.jnt_bodyid[number])
    carried = tuple(model.body(int(b)).name for b in np.flatnonzero(bodies_below(model, [body])))
    shown = shown_geoms(model)
    rigid = model.body_weldid[model.geom_bodyid] == model.body_weldid[body]  # with all that is fixed to it
    mine = [geom_triangles(mujoco, model, data, g) for g in shown if rigid[g]]
    others = [geom_triangles(mujoco, model, data, g) for g in shown if not rigid[g]]
    if not mine:
        raise InputError(f"{model.body(body).name} of {file.name} has no shape to touch")
    _exclude_overlaps(mujoco, spec, model, data)
    slides = int(model.jnt_type[number]) == int(mujoco.mjtJoint.mjJNT_SLIDE)
    kind = JointType.PRISMATIC if slides else JointType.REVOLUTE
    low, high = (float(v) for v in model.jnt_range[number])
    return ArticulatedObject(
        file.stem,
        file,
        spec,
        model.joint(number).name,
        model.body(body).name,
        Motion(kind, data.xaxis[number].copy(), data.xanchor[number].copy(), "asset"),
        (low, high) if model.jnt_limited[number] else None,
        carried,
        np.concatenate(mine),
        np.concatenate([np.zeros((0, 3, 3)), *others]),
        opened,
    )


def description(path: Path) -> Path:
    """Return the MJCF beside the URDF if there is one, since it states which links do not collide."""
    file = find_description(path)
    beside = file.with_suffix(".xml")
    return beside if path.is_dir() and beside.is_file() else file


def _surest(model: Any, folder: Path) -> str:
    """Return the moving joint of highest confidence, the first of equal ones; "" if no joint moves."""
    stated = (read_json(folder / "asset.json") or {}).get("joints", [])
    confidence = {j.get("name"): float(j.get("confidence", 0.0)) for j in stated if isinstance(j, dict)}
    return max((model.joint(j).name for j in single_joints(model)), key=lambda n: confidence.get(n, 0.0), default="")


def _joint(model: Any, name: str) -> int:
    moving = single_joints(model)
    by_name = {model.joint(j).name: j for j in moving}
    by_part = {model.body(int(model.jnt_bodyid[j])).name: j for j in moving}
    index = by_name.get(name, by_part.get(name))
    if index is None:
        raise OptionError(f"--joint: found {name!r}; valid are {', '.join(by_name) or 'none, since no joint moves'}")
    return index


def shown_geoms(model: Any) -> list[int]:
    """Return the visual geoms, and the collision geoms of links without visual ones."""
    seen = [g for g in range(model.ngeom) if not (model.geom_contype[g] or model.geom_conaffinity[g])]
    covered = {int(model.geom_bodyid[g]) for g in seen}
    return seen + [g for g in range(model.ngeom) if g not in seen and int(model.geom_bodyid[g]) not in covered]


def geom_triangles(mujoco: Any, model: Any, data: Any, geom: int) -> Float[np.ndarray, "n 3 3"]:
    """Return the surface of a geom in the world frame [m]; round shapes as polyhedra, and nothing for planes."""
    from anymesh.checking.engines.mjcf_ import geom_shape
    from anymesh.checking.engines.robot import shape_triangles

    shape = geom_shape(mujoco, model, geom, np.eye(4))
    if shape is None:
        return np.zeros((0, 3, 3))
    own = shape_triangles(shape) if shape.triangles is None else shape.triangles
    return own @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]


def _exclude_overlaps(mujoco: Any, spec: Any, model: Any, data: Any) -> None:
    """Exclude pairs of links that a joint connects or that overlap at rest from collision, beside the file's exclusions."""
    known = {frozenset((e.bodyname1, e.bodyname2)) for e in spec.excludes}
    pairs = {(int(model.body_parentid[b]), b) for b in range(1, model.nbody)}
    deep = OVERLAP * float(model.stat.extent)
    pairs |= {
        _ordered(int(model.geom_bodyid[c.geom1]), int(model.geom_bodyid[c.geom2]))
        for c in data.contact[: data.ncon]
        if c.dist < -deep
    }
    for a, b in sorted(pairs):
        names = model.body(a).name, model.body(b).name
        if a and b and a != b and frozenset(names) not in known:
            spec.add_exclude(bodyname1=names[0], bodyname2=names[1])


def _ordered(a: int, b: int) -> tuple[int, int]:
    return (a, b) if a < b else (b, a)
