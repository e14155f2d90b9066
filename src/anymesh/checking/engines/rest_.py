"""Rest in MuJoCo: which links penetrate each other, and how far their contacts move the joints."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.locate import MJCF, kind_of
from anymesh.checking.engines.mjcf_ import load_errors, read_spec, without_ground
from anymesh.checking.engines.mujoco_ import depths
from anymesh.mujoco_ import is_unstable, load_mujoco, name_elements

LIGHT = 1e-9  # [kg, kg m2] for links without inertia and shape in the file
SECONDS = 2.0  # [s] duration of the simulation
MIN_STEP = 5e-4  # [s] smallest time step


@dataclass(frozen=True)
class Rest:
    """depths: pair of links -> penetration at rest [m]; moved: joint -> how far contacts move it in SECONDS [rad or m].

    A simulation that becomes unstable moves all joints by infinity.
    """

    depths: Mapping[tuple[str, str], float]
    moved: Mapping[str, float]


def at_rest(path: Path) -> Rest:
    """Simulate a URDF or MJCF without gravity, with contacts and without, from the rest pose; return what contacts move.

    Links that a joint connects penetrate, and push each other in a URDF. An MJCF is simulated as it is written. In both, pairs
    that the file excludes do not count, and the ground (planes and height fields of the world) touches nothing.
    Raise InputError if MuJoCo cannot load the file, MissingExtraError without MuJoCo.
    """
    mujoco = load_mujoco()
    with load_errors(mujoco, path):
        model = _model(mujoco, Path(path))
    data = mujoco.MjData(model)
    filtered, everything = int(model.opt.disableflags), int(mujoco.mjtDisableBit.mjDSBL_FILTERPARENT)
    model.opt.disableflags = filtered | everything
    mujoco.mj_forward(model, data)
    met = depths(model, data)
    if kind_of(Path(path)) == MJCF:
        model.opt.disableflags = filtered
    single = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
    joints = [k for k in range(model.njnt) if int(model.jnt_type[k]) in single]
    moved = np.zeros(len(joints))
    if any(depth > 0 for depth in met.values()):
        at = model.jnt_qposadr[joints]
        pushed = _positions(mujoco, model, at)
        model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
        moved = np.abs(pushed - _positions(mujoco, model, at)).max(0, initial=0.0)
    return Rest(
        {(model.body(a).name, model.body(b).name): depth for (a, b), depth in sorted(met.items())},
        {model.joint(k).name: float(np.nan_to_num(d, nan=np.inf)) for k, d in zip(joints, moved, strict=True)},
    )


def _model(mujoco: Any, path: Path) -> Any:
    spec = read_spec(mujoco, path)
    spec.compiler.fusestatic = False
    spec.compiler.discardvisual = False
    spec.compiler.boundmass = spec.compiler.boundinertia = LIGHT
    spec.option.gravity = (0, 0, 0)
    spec.option.timestep = max(spec.option.timestep, MIN_STEP)
    without_ground(spec, mujoco)
    name_elements(spec)
    return spec.compile()


def _positions(mujoco: Any, model: Any, at: np.ndarray) -> Float[np.ndarray, "steps n"]:
    """Return qpos at some addresses after each step; not a number once it is unstable."""
    data = mujoco.MjData(model)
    rows = np.full((round(SECONDS / model.opt.timestep), len(at)), np.nan)
    for row in rows:
        mujoco.mj_step(model, data)
        if is_unstable(data):
            break
        row[:] = data.qpos[at]
    return rows
