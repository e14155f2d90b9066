"""The command line of `anymesh segment`: Stage A alone."""

from __future__ import annotations

from typing import Annotated, Any

from anymesh.cli.from_options import OptionsOf, with_options
from anymesh.cli.options import Folder, Formats, Json, MeshPath, Out, Package, Parts, Placement, Quiet, Running, Time, Zip
from anymesh.cli.output import JOINT_COLUMNS, Shown, joint_row, print_asset, print_result
from anymesh.pipeline.options import AnswererOptions


@with_options
def segment(
    mesh: MeshPath,
    out: Out,
    *,
    parts: Parts = "auto",
    answering: Annotated[dict[str, Any], OptionsOf(AnswererOptions, without=("verify",))],
    placement: Placement,
    running: Running,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Run only Stage A: find the parts. Continue with `anymesh joints DIR`."""
    from anymesh import pipeline

    with Shown(quiet or json_) as progress:
        segmentation = pipeline.segment(mesh, out, parts=parts, progress=progress, **placement, **running, **answering)
    rows = [
        {"name": p.name, "label": p.label, "faces": len(segmentation.faces(k)), "confidence": p.confidence, "reason": p.reason}
        for k, p in enumerate(segmentation.parts)
    ]
    print_result({"out": str(out), "parts": rows}, rows, ("name", "label", "faces", "confidence", "reason"), json_, quiet)


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


@with_options
def export(
    folder: Folder,
    *,
    writing: Formats,
    package: Package = None,
    zip_: Zip = None,
    time: Time,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Write the files of the asset whose stages are in DIR."""
    from anymesh import pipeline

    with Shown(quiet or json_) as progress:
        asset = pipeline.export_asset(folder, package=package, archive=zip_, progress=progress, **writing, **time)
    print_asset(asset, folder, json_, quiet)
