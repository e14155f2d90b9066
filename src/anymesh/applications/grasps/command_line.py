"""Command line of `anymesh grasps`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from anymesh.applications.plan.command_line import AssetPath, SeedNumber
from anymesh.cli.options import Json, Quiet
from anymesh.cli.output import Shown, print_result

JointName = Annotated[str | None, typer.Option("--joint", help="The joint's name; all that move by default.")]
Out = Annotated[
    Path | None,
    typer.Option("--out", "-o", metavar="FILE", help="Default: grasps.json in ASSET, or beside a file, with a picture."),
]
Stroke = Annotated[float, typer.Option(help="Largest gap between the fingers of the gripper [m].")]
Finger = Annotated[str, typer.Option(metavar="L,W,T", help="Length, width and thickness of a finger [m].")]
Force = Annotated[float, typer.Option(help="Largest force of a finger [N].")]
COLUMNS = ("joint", "grasps", "best", "score", "reached", "slip")


def grasps(
    asset: AssetPath,
    joint: JointName = None,
    out: Out = None,
    stroke: Stroke = 0.085,
    finger: Finger = "0.072,0.020,0.012",
    force: Force = 30.0,
    seed: SeedNumber = 0,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Rank grasps of the moving parts: a parallel gripper closes on each in MuJoCo and moves its joint (extra plan)."""
    from anymesh.applications.grasps.grasps import NAME, grasps_record, write_grasps
    from anymesh.applications.grasps.ranking_ import rank_grasps, write_picture
    from anymesh.applications.policy.robots_ import Gripper

    gripper = Gripper.parse(stroke, finger, force)
    out = out or (asset / NAME if asset.is_dir() else asset.with_name(f"{asset.stem}_{NAME}"))
    with Shown(quiet or json_) as progress:
        ranked = rank_grasps(asset, joint, gripper=gripper, seed=seed, progress=progress)
        write_grasps(out, ranked, gripper, seed)
        shown = write_picture(out.with_suffix(".png"), asset, ranked, gripper)
    rows = []
    for j in ranked:
        row = {"joint": j.joint, "grasps": len(j.grasps), "best": "-", "score": "-", "reached": j.reason, "slip": "-"}
        for g in j.grasps[:1]:
            reached, slip = f"{g.reached:.3g} of {j.goal:.3g}", f"{1000 * g.slip:.0f} mm"
            row |= {"best": g.kind.value, "score": f"{g.score:.2f}", "reached": reached, "slip": slip}
        rows.append(row)
    print_result({"out": str(out), **grasps_record(ranked, gripper, seed)}, rows, COLUMNS, json_, quiet)
    if not (json_ or quiet):
        typer.echo(f"wrote {out}" + (f" and {shown}" if shown else ""))
