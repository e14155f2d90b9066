"""The command line of `anymesh eval`."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer

from anymesh.cli.options import Json, OptionsOf, Quiet, with_options
from anymesh.cli.output import Shown, plain, print_result
from anymesh.entry_points import EVALUATE_INTERACTION, INTERACTION_SUMMARY, resolve
from anymesh.pipeline.options import AnswererOptions

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
Up = Annotated[str, typer.Option(help="What points up in the changed meshes: mesh (their z), given (the truth), infer.")]
Only = Annotated[str, typer.Option(metavar="NAMES", help="Only these objects.")]
Jobs = Annotated[int | None, typer.Option("--jobs", "-j", help="Parallel objects; one per core by default.")]
EVALUATION_HELPS = {"answerer": "As for articulate; or oracle (ground truth), or oracle:P (wrong with probability P)."}
EvalAnswerer = Annotated[
    dict[str, Any],
    OptionsOf(
        AnswererOptions,
        without=("parts_list", "category"),
        helps=EVALUATION_HELPS,
        flags={"viewpoints": ("--viewpoints",)},  # --views is the number of views of the protocol
    ),
]

INTERACTION = "interaction"
MAX_ERRORS = 5  # failed objects that are named; the report lists all
SHOWN = ("change", "objects", "joints", "type", "angle", "line", "at part", "opens", "range", "part F1", "part mIoU", "runs")


@with_options
def evaluate(
    dataset: DatasetName,
    out: ReportOut,
    *,
    protocol: ProtocolName = "parts",
    split: Split = None,
    changes: Changes = "none",
    views: Views = 1,
    up: Up = "mesh",
    only: Only = "",
    jobs: Jobs = None,
    answering: EvalAnswerer,
    force: Annotated[bool, typer.Option("--force", help="Start again.")] = False,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Evaluate all objects of a data set with known joints; write tables, pictures of the worst joints, a line per joint."""
    if protocol == INTERACTION:
        _interaction(dataset, out, _names(only), answering["seed"], force, json_, quiet)
        return
    from anymesh.evaluation import evaluating
    from anymesh.evaluation.changes import CHANGES
    from anymesh.evaluation.summary import group_table, grouped, summarize

    chosen = tuple(CHANGES) if changes == "all" else _names(changes)
    with Shown(quiet or json_) as progress:
        records = evaluating.evaluate(
            dataset, out, protocol=protocol, split=split, changes=chosen, views=views, up=up, only=_names(only), jobs=jobs,
            force=force, progress=progress, **answering,
        )  # fmt: skip
    groups = grouped(records, lambda r: r.change)
    table = group_table("By change", groups)
    rows = [dict(zip(("change", *table.head[1:]), (cell.text for cell in row), strict=True)) for row in table.rows]
    head = tuple(name for name in SHOWN if name in ("change", *table.head))
    results = {name: asdict(summarize(some)) for name, some in groups}
    failed = {r.title: r.error for r in records if r.error}
    if not (json_ or quiet):
        for title, error in list(failed.items())[:MAX_ERRORS]:
            typer.echo(plain(f"warning: {title}: {error}"))
        if len(failed) > MAX_ERRORS:
            typer.echo(f"warning: {len(failed) - MAX_ERRORS} more objects failed; the report lists all of them")
    print_result({"out": str(out), "results": results, "errors": failed}, rows, head, json_, quiet)
    if not (json_ or quiet):
        typer.echo(f"wrote {out / 'report.html'}, report.md, worst.png and joints.jsonl")


def _interaction(assets: str, out: Path, only: tuple[str, ...], seed: int, force: bool, json_: bool, quiet: bool) -> None:
    evaluate_interaction, summary = resolve(EVALUATE_INTERACTION), resolve(INTERACTION_SUMMARY)
    with Shown(quiet or json_) as progress:
        rows = evaluate_interaction(assets, out, only=only, seed=seed, force=force, progress=progress)
    shares = summary(rows)
    head = ("joints", "count", "interaction", "executable", "both")
    shown = [{"joints": name, "count": int(s["joints"]), **{k: f"{s[k]:.3f}" for k in head[2:]}} for name, s in shares.items()]
    print_result({"out": str(out), "results": shares, "joints": [asdict(r) for r in rows]}, shown, head, json_, quiet)
    if not (json_ or quiet):
        typer.echo(f"wrote {out / 'report.md'}")


def _names(text: str) -> tuple[str, ...]:
    return tuple(name.strip() for name in text.split(",") if name.strip())
