"""The command line of the single stages: `anymesh segment`, `anymesh joints`, `anymesh export`."""

from __future__ import annotations

from anymesh.cli.options import (
    FORMATS,
    AnswererName,
    AtLeast,
    BaseName,
    Cache,
    Category,
    Drives,
    Folder,
    Force,
    Formats,
    Json,
    MaxCalls,
    MaxCost,
    MeshPath,
    Out,
    Package,
    Parts,
    PartsList,
    Proposer,
    Quiet,
    Root,
    Scale,
    Seed,
    TimeLimit,
    Timeout,
    Up,
    Verify,
    Viewpoints,
    Wait,
    Zip,
)
from anymesh.cli.output import JOINT_COLUMNS, Shown, cache_of, chosen_answerer, joint_row, split_labels, tell, tell_asset
from anymesh.config import DEFAULT_VIEWS
from anymesh.deadline import CALL_SECONDS, DEFAULT_SECONDS


def segment(
    mesh: MeshPath,
    out: Out,
    parts: Parts = "auto",
    answerer: AnswererName = "geometry",
    parts_list: PartsList = "",
    at_least: AtLeast = 0,
    proposer: Proposer = "exact",
    viewpoints: Viewpoints = DEFAULT_VIEWS,
    category: Category = None,
    timeout: Timeout = CALL_SECONDS,
    wait: Wait = False,
    max_calls: MaxCalls = None,
    max_cost: MaxCost = None,
    cache: Cache = "auto",
    seed: Seed = 0,
    up: Up = "auto",
    scale: Scale = "auto",
    root: Root = None,
    force: Force = False,
    time_limit: TimeLimit = DEFAULT_SECONDS,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Run only Stage A: find the parts. Continue with `anymesh joints DIR`."""
    from anymesh import pipeline

    answerer = chosen_answerer(answerer, quiet or json_)
    with Shown(quiet or json_) as progress:
        found = pipeline.segment(
            mesh, out, parts=parts, up=up, scale=scale, root=root, force=force, progress=progress, time_limit=time_limit,
            answerer=answerer, parts_list=split_labels(parts_list), at_least=at_least, proposer=proposer, viewpoints=viewpoints,
            category=category, seed=seed, max_calls=max_calls, max_cost=max_cost, wait=wait, timeout=timeout, **cache_of(cache),
        )  # fmt: skip
    rows = [
        {"name": p.name, "label": p.label, "faces": len(found.faces(k)), "confidence": p.confidence, "reason": p.reason}
        for k, p in enumerate(found.parts)
    ]
    tell({"out": str(out), "parts": rows}, rows, ("name", "label", "faces", "confidence", "reason"), json_, quiet)


def joints(
    folder: Folder,
    answerer: AnswererName = "geometry",
    viewpoints: Viewpoints = DEFAULT_VIEWS,
    verify: Verify = "motion",
    category: Category = None,
    timeout: Timeout = CALL_SECONDS,
    wait: Wait = False,
    max_calls: MaxCalls = None,
    max_cost: MaxCost = None,
    cache: Cache = "auto",
    seed: Seed = 0,
    time_limit: TimeLimit = DEFAULT_SECONDS,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Run only Stage B: find the joints of the parts in DIR. Continue with `anymesh export DIR`."""
    from anymesh import pipeline

    answerer = chosen_answerer(answerer, quiet or json_)
    with Shown(quiet or json_) as progress:
        found = pipeline.joints(
            folder, progress=progress, time_limit=time_limit, answerer=answerer, viewpoints=viewpoints,
            verify=verify, category=category, seed=seed, max_calls=max_calls, max_cost=max_cost, wait=wait,
            timeout=timeout, **cache_of(cache),
        )  # fmt: skip
    rows = [joint_row(j) for j in found]
    tell({"out": str(folder), "joints": rows}, rows, JOINT_COLUMNS, json_, quiet)


def export(
    folder: Folder,
    base: BaseName = "fixed",
    formats: Formats = FORMATS,
    drives: Drives = "passive",
    package: Package = None,
    zip_: Zip = None,
    time_limit: TimeLimit = DEFAULT_SECONDS,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Write the files of the asset whose stages are in DIR."""
    from anymesh import pipeline

    with Shown(quiet or json_) as progress:
        asset = pipeline.export(
            folder, base=base, formats=formats, drives=drives, package=package, archive=zip_,
            time_limit=time_limit, progress=progress,
        )  # fmt: skip
    tell_asset(asset, folder, json_, quiet)
