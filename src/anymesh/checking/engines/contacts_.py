"""Penetration depths of links at rest in MuJoCo, which collides the convex hulls of their collision shapes."""

from __future__ import annotations

from pathlib import Path

from anymesh.checking.engines.mujoco_bench_ import depths, read_spec
from anymesh.errors import InputError
from anymesh.mujoco_ import load_mujoco

LIGHT = 1e-9  # [kg, kg m2] for links without inertia in the file; only the rest pose is used


def rest_contacts(path: Path) -> dict[tuple[str, str], float]:
    """Return the deepest penetration [m] of each pair of links in contact.

    Pairs connected by a joint are included, pairs excluded by the file are not. Raise InputError if MuJoCo cannot load the
    file, MissingExtraError without MuJoCo.
    """
    mujoco = load_mujoco()
    try:
        spec = read_spec(mujoco, Path(path))
        spec.compiler.fusestatic = False
        spec.compiler.discardvisual = False
        spec.compiler.boundmass = spec.compiler.boundinertia = LIGHT
        spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_FILTERPARENT)
        for number, body in enumerate(spec.bodies):
            body.name = body.name or f"body_{number}"
        model = spec.compile()
    except (ValueError, mujoco.FatalError, InputError) as error:
        raise InputError(f"MuJoCo cannot load {path}: {' '.join(str(error).split())}") from error
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return {(model.body(a).name, model.body(b).name): depth for (a, b), depth in sorted(depths(model, data).items())}
