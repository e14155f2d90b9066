"""The command line of `anymesh eval`."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from anymesh.cli_options import Timeout, Wait
from anymesh.cli_output import Shown, cache_of, tell
from anymesh.config import DEFAULT_VIEWS
from anymesh.deadline import CALL_SECONDS

DatasetName = Annotated[
    str,
    typer.Argument(
        metavar="DATASET",
        help="examples, scene-synthesizer, sweethome3d, metaworld, libero, or one of partnet-mobility, urdf, mjcf and labelled "
        "with its folder: urdf:DIR.",
    ),
]
ReportOut = Annotated[
    Path, typer.Option("--out", "-o", metavar="DIR", help="Folder of the report; a stopped evaluation is resumed.")
]
ProtocolName = Annotated[
    str,
    typer.Option(
        help="parts (given), views (parts given, in one view), end-to-end, executability; or interaction, where DATASET is a "
        "folder of assets whose joints a scripted gripper moves."
    ),
]
Split = Annotated[str | None, typer.Option(help="A subset of the data set, such as ID, OOD or OneDoor.")]
Changes = Annotated[
    str, typer.Option("--changes", metavar="NAMES", help="Changes of each mesh, such as none,turned,noise.001,fused; or all.")
]
Views = Annotated[int, typer.Option(help="Views per object, for the protocol views.")]
Only = Annotated[str, typer.Option(metavar="NAMES", help="Only these objects.")]
Jobs = Annotated[int | None, typer.Option("--jobs", "-j", help="Parallel objects; one per core by default.")]
EvalAnswerer = Annotated[
    str, typer.Option("--answerer", help="As for articulate; or oracle (ground truth), or oracle:P (wrong with probability P).")
]

INTERACTION = "interaction"
SHOWN = ("change", "objects", "joints", "type", "angle", "line", "at part", "opens", "range", "part F1", "part mIoU", "runs")


def evaluate(
    dataset: DatasetName,
    out: ReportOut,
    protocol: ProtocolName = "parts",
    answerer: EvalAnswerer = "geometry",
    split: Split = None,
    changes: Changes = "none",
    views: Views = 1,
    only: Only = "",
    jobs: Jobs = None,
    proposer: Annotated[
        str, typer.Option(help="Source of masks for a model: exact, sam:WEIGHTS or exact+sam:WEIGHTS.")
    ] = "exact",
    viewpoints: Annotated[
        str, typer.Option(help="For a model: cameras as COUNT@ELEVATION[+AZIMUTH],... [deg].")
    ] = DEFAULT_VIEWS,
    verify: Annotated[str, typer.Option(help="motion, free, or off (the paper's method unchanged).")] = "motion",
    at_least: Annotated[
        int, typer.Option("--at-least", metavar="N", help="Parts that geometry accepts regardless of evidence.")
    ] = 0,
    timeout: Timeout = CALL_SECONDS,
    wait: Wait = False,
    max_calls: Annotated[int | None, typer.Option("--max-calls", help="Maximum number of model calls.")] = None,
    max_cost: Annotated[float | None, typer.Option("--max-cost", metavar="USD", help="Maximum cost of model calls.")] = None,
    cache: Annotated[str, typer.Option(metavar="DIR", help="Cache of model answers: auto, off, or a folder.")] = "auto",
    seed: Annotated[int, typer.Option(help="From 0 up.")] = 0,
    force: Annotated[bool, typer.Option("--force", help="Start again.")] = False,
    json_: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress, no summary.")] = False,
) -> None:
    """Evaluate all objects of a data set with known joints; write tables, pictures of the worst joints, a line per joint."""
    if protocol == INTERACTION:
        _interaction(dataset, out, _names(only), seed, force, json_, quiet)
        return
    from anymesh import evaluating
    from anymesh.evaluation.changes import CHANGES
    from anymesh.evaluation.summary import summarize
    from anymesh.evaluation.tables import group_table, grouped

    chosen = tuple(CHANGES) if changes == "all" else _names(changes)
    with Shown(quiet or json_) as progress:
        records = evaluating.evaluate(
            dataset, out, protocol=protocol, split=split, changes=chosen, views=views, only=_names(only), jobs=jobs,
            force=force, progress=progress, answerer=answerer, proposer=proposer, viewpoints=viewpoints, verify=verify,
            seed=seed, at_least=at_least, max_calls=max_calls, max_cost=max_cost, wait=wait, timeout=timeout,
            **cache_of(cache),
        )  # fmt: skip
    groups = grouped(records, lambda r: r.change)
    table = group_table("By change", groups)
    rows = [dict(zip(("change", *table.head[1:]), (cell.text for cell in row), strict=True)) for row in table.rows]
    head = tuple(name for name in SHOWN if name in ("change", *table.head))
    results = {name: asdict(summarize(some)) for name, some in groups}
    tell({"out": str(out), "results": results}, rows, head, json_, quiet)
    if not (json_ or quiet):
        typer.echo(f"wrote {out / 'report.html'}, report.md, worst.png and joints.jsonl")


def _interaction(assets: str, out: Path, only: tuple[str, ...], seed: int, force: bool, json_: bool, quiet: bool) -> None:
    from anymesh.applications.policy.interaction_ import evaluate_interaction, summary

    with Shown(quiet or json_) as progress:
        rows = evaluate_interaction(assets, out, only=only, seed=seed, force=force, progress=progress)
    shares = summary(rows)
    head = ("joints", "count", "interaction", "executable", "both")
    shown = [{"joints": name, "count": int(s["joints"]), **{k: f"{s[k]:.3f}" for k in head[2:]}} for name, s in shares.items()]
    tell({"out": str(out), "results": shares, "joints": [asdict(r) for r in rows]}, shown, head, json_, quiet)
    if not (json_ or quiet):
        typer.echo(f"wrote {out / 'report.md'}")


def _names(told: str) -> tuple[str, ...]:
    return tuple(name.strip() for name in told.split(",") if name.strip())
