"""The one place that brings MuJoCo in."""

from __future__ import annotations

import logging
from typing import Any

from anymesh.errors import MissingExtraError

log = logging.getLogger("anymesh")


def load_mujoco() -> Any:
    """MuJoCo, with its warnings in our log: left alone, it writes a file into the folder that a user works in."""
    try:
        import mujoco as untyped
    except ImportError:
        raise MissingExtraError("mujoco is missing; it comes with articulate-anymesh, install that again") from None
    mujoco: Any = untyped  # its compiled names have no stubs
    mujoco.set_mju_user_warning(_tell)
    return mujoco


def _tell(message: str) -> None:
    log.debug("MuJoCo: %s", message)
