"""Command line of `anymesh plan`."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Any

import typer

from anymesh.applications.plan.robot_packages_ import DEFAULT_ROBOT
from anymesh.cli.options import Force, Json, Quiet
from anymesh.cli.output import Shown, plain, print_result

AUTO = "auto"
AssetPath = Annotated[
    Path, typer.Argument(metavar="ASSET", help="A folder that anymesh made, or any URDF or MJCF with a joint that moves.")
]
RobotName = Annotated[str, typer.Option("--robot", help="ur5e (no network needed), panda, or the path of a URDF or MJCF.")]
JointName = Annotated[str, typer.Option("--joint", help="The joint's name, or that of the part it carries; auto: the surest.")]
To = Annotated[
    str | None,
    typer.Option("--to", help="Target: radians or metres, or with a unit: 60deg, 10mm; half of the range by default."),
]
Out = Annotated[
    Path | None,
    typer.Option("--out", "-o", metavar="FILE", help="The trajectory; default: ASSET_plan.json beside ASSET, with a picture."),
]
Kind = Annotated[
    str, typer.Option("--format", help="json (all), csv, or ros: the fields of trajectory_msgs/JointTrajectory as JSON.")
]
Base = Annotated[str, typer.Option(help="Robot's base in the asset frame: auto, or X,Y,Z,YAW in metres and degrees.")]
ContactKind = Annotated[str, typer.Option("--contact", help="auto, grasp or push.")]
Tool = Annotated[str | None, typer.Option(help="Body of the hand, for a robot by path whose tree branches before the hand.")]
Gripper = Annotated[str, typer.Option(help="Joints of the gripper of such a robot, comma-separated.")]
Speed = Annotated[float, typer.Option(help="Share of the joints' limits of velocity and acceleration.")]
Seconds = Annotated[float | None, typer.Option("--seconds", help="Time after which no further attempt is made.")]
Video = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="Replay it in MuJoCo on the asset itself: .mp4 (extra video) or .png, a contact sheet."),
]
SeedNumber = Annotated[int, typer.Option("--seed", help="From 0 up; the same input and seed give the same trajectory.")]


def plan(
    asset: AssetPath,
    joint: JointName = AUTO,
    to: To = None,
    out: Out = None,
    robot: RobotName = DEFAULT_ROBOT,
    kind: Kind = "json",
    base: Base = "auto",
    contact: ContactKind = "auto",
    tool: Tool = None,
    gripper: Gripper = "",
    speed: Speed = 0.3,
    seconds: Seconds = None,
    video: Video = None,
    seed: SeedNumber = 0,
    force: Force = False,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Plan how a robot arm moves a joint of ASSET: a grasp or a push, a free approach, the part's motion, in time."""
    from anymesh.applications.plan.planner import plan as find
    from anymesh.applications.plan.plans import parse_value, write_plan

    if out is None:
        out = asset.parent / f"{asset.resolve().stem}_plan.json"
        video = video or out.with_suffix(".png")
    joints = tuple(name for name in gripper.split(",") if name)
    with Shown(quiet or json_) as progress:
        planned = find(
            asset, robot=robot, joint=joint, to=None if to is None else parse_value(to),
            base=base, contact=contact, tool=tool, gripper=joints,
            seed=seed, speed=speed, seconds=math.inf if seconds is None else seconds, progress=progress,
        )  # fmt: skip
        write_plan(planned, out, kind, force=force)
        shown = None if video is None else _film(planned, asset, robot, tool, joints, video)
    _print_plan(planned, out, shown, json_, quiet)


def _film(planned: Any, asset: Path, robot: str, tool: str | None, gripper: tuple[str, ...], video: Path) -> tuple[Path, Any]:
    from anymesh.applications.plan.asset_ import open_object
    from anymesh.applications.plan.film_ import RATE, Film, write_film
    from anymesh.applications.plan.planner import open_arm
    from anymesh.applications.plan.replay_ import replay

    arm = open_arm(robot, tool=tool, gripper=gripper)
    thing = open_object(asset, planned.joint)
    seen = replay(planned.trajectory, thing, arm.robot, arm.hand, planned.base, planned.value[1], rate=RATE)
    return write_film(Film(thing, arm.robot, arm.hand, planned.base), seen.states, video), seen


def _print_plan(planned: Any, out: Path, shown: tuple[Path, Any] | None, json_: bool, quiet: bool) -> None:
    place = planned.target.T_asset_tool[:3, 3]
    row = {
        "joint": planned.joint,
        "to": f"{planned.value[1]:.4g} {planned.unit}",
        "contact": planned.target.contact.value,
        "at": ", ".join(f"{v:.3f}" for v in place),
        "base": str(planned.base),
        "seconds": planned.trajectory.duration,
    }
    record = {
        **row,
        "asset": planned.asset,
        "robot": planned.robot,
        "out": str(out),
        "notes": list(planned.notes),
        "timing": dict(planned.seconds),
    }
    if shown is not None:
        path, seen = shown
        done = "done" if seen.failure is None else seen.failure.value
        record["replay"] = {"video": str(path), "value": seen.value, "outcome": done}
    if json_ or not quiet:
        print_result(record, [row], tuple(row), json_, quiet)
    if not (json_ or quiet):
        for note in planned.notes:
            typer.echo(plain(note))
        if shown is not None:
            typer.echo(plain(f"replayed on the asset: {done}, at {seen.value:.4g} {planned.unit}; see {path}"))
        typer.echo(
            plain(f"wrote {out} ({len(planned.trajectory.time)} samples, planned in {sum(planned.seconds.values()):.1f} s)")
        )
