"""The command line of `anymesh segment`: Stage A alone."""

from __future__ import annotations

from anymesh.cli.options import (
    AnswererName,
    AtLeast,
    Cache,
    Category,
    Force,
    Json,
    MaxCalls,
    MaxCost,
    MeshPath,
    Out,
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
    Viewpoints,
    Wait,
)
from anymesh.cli.output import Shown, cache_of, chosen_answerer, split_labels, tell
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
