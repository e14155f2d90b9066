"""The command line of `anymesh segment`: Stage A alone."""

from __future__ import annotations

from typing import Annotated, Any

from anymesh.cli.from_options import OptionsOf, with_options
from anymesh.cli.options import Json, MeshPath, Out, Parts, Placement, Quiet, Running
from anymesh.cli.output import Shown, print_result
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
