"""The command line of `anymesh joints`: Stage B alone."""

from __future__ import annotations

from typing import Annotated, Any

from anymesh.cli.from_options import OptionsOf, with_options
from anymesh.cli.options import Folder, Json, Quiet, Time
from anymesh.cli.output import JOINT_COLUMNS, Shown, joint_row, print_result
from anymesh.pipeline.options import AnswererOptions


@with_options
def joints(
    folder: Folder,
    *,
    answering: Annotated[dict[str, Any], OptionsOf(AnswererOptions, without=("parts_list", "at_least", "proposer"))],
    time: Time,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Run only Stage B: find the joints of the parts in DIR. Continue with `anymesh export DIR`."""
    from anymesh import pipeline

    with Shown(quiet or json_) as progress:
        estimated_joints = pipeline.joints(folder, progress=progress, **time, **answering)
    rows = [joint_row(j) for j in estimated_joints]
    print_result({"out": str(folder), "joints": rows}, rows, JOINT_COLUMNS, json_, quiet)
