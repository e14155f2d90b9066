"""The only module that imports MuJoCo."""

from __future__ import annotations

import logging
from typing import Any

import numpy as np

from anymesh.errors import MissingExtraError

log = logging.getLogger("anymesh")


def load_mujoco() -> Any:
    """Import MuJoCo, and redirect its warnings to our log, since by default it writes a file to the working folder."""
    try:
        import mujoco as untyped
    except ImportError:
        raise MissingExtraError("mujoco is missing; it is a dependency of articulate-anymesh; reinstall that") from None
    mujoco: Any = untyped  # its compiled names have no stubs
    mujoco.set_mju_user_warning(_warn)
    return mujoco


def name_elements(spec: Any) -> None:
    """Name the joints and bodies that have no name."""
    for word, things in (("joint", spec.joints), ("body", spec.bodies)):
        for number, thing in enumerate(things):
            thing.name = thing.name or f"{word}_{number}"


def is_unstable(data: Any) -> bool:
    """Return whether a simulation diverged or warned."""
    return not np.isfinite(data.qpos).all() or bool(data.warning.number.any())


def _warn(message: str) -> None:
    log.debug("MuJoCo: %s", message)
