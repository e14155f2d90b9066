"""Dry run of one object: as `work`, but geometry answers in place of a model, with the same pictures and prompts."""

from __future__ import annotations

import json
import time
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from anymesh.applications.annotate.states import Result
from anymesh.applications.annotate.work import Job, annotate_object, local_mesh
from anymesh.applications.annotate.workers import as_outcome
from anymesh.errors import AnymeshError
from anymesh.evaluation.simulated_vlm import SimulatedVlm
from anymesh.export.asset_json import usage
from anymesh.loading import load_mesh, place_mesh
from anymesh.pipeline.options import GEOMETRY, Answering
from anymesh.pipeline.solving import Solver
from anymesh.prompted.answerers.answering import choose_answerer


def rehearse_object(job: dict[str, Any]) -> dict[str, Any]:
    """Annotate an object without a model; return an AttemptOutcome as a dictionary, with the estimated usage in its record."""
    what = Job(**job)
    answerer = str(what.options.get("answerer", GEOMETRY))
    free = {k: v for k, v in what.options.items() if k not in ("parts_list", "max_calls", "max_cost", "cache")}
    made = annotate_object(job | {"options": {**free, "answerer": GEOMETRY}, "metered": False})
    if answerer == GEOMETRY or made["result"] != Result.DONE:
        return made
    begin = time.perf_counter()
    try:
        asked = asked_of_a_model(what, answerer)
    except AnymeshError as error:
        return made | {"result": str(Result.REFUSED), "error": str(error)}
    stages = json.loads(as_outcome(made).record["stage_seconds"])
    seconds = time.perf_counter() - begin + stages.get("export", 0.0)
    return made | {"seconds": seconds, "record": {**made["record"], "usage": asked}}


def asked_of_a_model(job: Job, like: str) -> Mapping[str, Any]:
    """Return calls, tokens and cost [USD] of both stages for a model of that name; nothing is sent.

    Answers are as short as the schema allows; a model's reasons and reasoning tokens are not included.
    """
    options: Answering = {k: v for k, v in job.options.items() if k in Answering.__annotations__}  # ty: ignore[invalid-assignment]
    config = choose_answerer({**options, "answerer": GEOMETRY, "parts_list": (), "max_cost": None}).config
    config = replace(config, parts_list=tuple(options.get("parts_list", ())))
    placement = {name: str(job.options.get(name, "auto")) for name in ("up", "scale")}
    placed = place_mesh(load_mesh(local_mesh(job.source), root=job.options.get("root")), **placement)
    solver = Solver(placed.mesh, config, lambda fallback: SimulatedVlm(fallback, fallback, like))
    recognized = solver.recognize()
    segmented = solver.parts(str(job.options.get("parts", "auto")), recognized.recognition)
    jointed = solver.joints(segmented.segmentation, recognized.recognition)
    return usage((*recognized.exchanges, *segmented.exchanges, *jointed.exchanges))
