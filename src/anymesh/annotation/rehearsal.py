"""One object of a dry run: as `work`, but geometry answers in the place of a model, through the same pictures and words."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from anymesh.annotation.states import Outcome
from anymesh.annotation.work import Job, annotate_object
from anymesh.answering import Answerer, Answering, Asked
from anymesh.models.prices import cost_of
from anymesh.solving import GEOMETRY

SKETCH = "openai:gpt-4o"  # whose tokens are counted where the model's provider is not known


def rehearse_object(job: dict[str, Any]) -> dict[str, Any]:
    """Annotate an object without asking anybody; the record of the outcome also has `usage`. Returns an Outcome as values."""
    from anymesh.annotation import work

    what = Job(**job)
    answerer = str(what.options.get("answerer", GEOMETRY.name))
    if answerer == GEOMETRY.name:
        return annotate_object(job)
    return work.attempted(what, lambda: _rehearsed(what, answerer))


def _rehearsed(job: Job, answerer: str) -> Outcome:
    from unittest.mock import patch

    from anymesh import pipeline
    from anymesh.annotation.results import asset_columns, asset_usage
    from anymesh.annotation.states import Result
    from anymesh.annotation.work import local_mesh

    out = Path(job.out)
    out.parent.mkdir(parents=True, exist_ok=True)
    raise NotImplementedError


__all__ = ["Answerer", "Answering", "Asked", "Outcome", "cost_of", "rehearse_object", "replace"]
