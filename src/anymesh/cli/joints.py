"""The command line of `anymesh joints`: Stage B alone."""

from __future__ import annotations

from anymesh.cli.options import (
    AnswererName,
    Cache,
    Category,
    Folder,
    Json,
    MaxCalls,
    MaxCost,
    Quiet,
    Seed,
    TimeLimit,
    Timeout,
    Verify,
    Viewpoints,
    Wait,
)
from anymesh.cli.output import JOINT_COLUMNS, Shown, cache_of, chosen_answerer, joint_row, tell
from anymesh.config import DEFAULT_VIEWS
from anymesh.deadline import CALL_SECONDS, DEFAULT_SECONDS


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
