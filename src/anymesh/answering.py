"""Who answers the questions of both stages: from the names that users give to what the solver asks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypedDict

from anymesh.config import Config, SegmentationConfig
from anymesh.errors import OptionError
from anymesh.models.cache import cache_folder
from anymesh.reasoning.recognition import told_labels
from anymesh.solving import GEOMETRY, Seeing


class Answering(TypedDict, total=False):
    """Who answers the questions of both stages, and how. All have defaults.

    answerer: geometry, openai:MODEL, anthropic:MODEL, google:MODEL, openai-compatible:BASE_URL#MODEL or replay:FOLDER;
    category: what the object is; seed: from 0 up; parts_list: labels of the parts that move, which a model is then not asked
    for; at_least: parts that geometry takes however thin the evidence is; proposer: of masks for a model, exact, sam:..., or
    exact+sam:...; verify: motion, free or off; max_calls, max_cost [USD]: no call is made that would pass them; cache: folder
    of answers (None: no cache).
    """

    answerer: str
    category: str | None
    seed: int
    parts_list: Sequence[str] | str
    at_least: int
    proposer: str
    verify: str
    max_calls: int | None
    max_cost: float | None
    cache: Path | str | None


@dataclass(frozen=True, eq=False)
class Answerer:
    """The settings of a run, the name of who answers, and what makes the answerer (None: geometry)."""

    config: Config
    name: str
    see: Seeing | None

    def settings(self, *without: str) -> dict[str, object]:
        """What the result of a stage hangs on, without what that stage does not use."""
        return {**{k: v for k, v in self.config.as_dict().items() if k not in without}, "answerer": self.name}


def choose_answerer(options: Answering) -> Answerer:
    """Raises OptionError for what is not valid, ModelError where a model cannot be asked at all (no key)."""
    unknown = sorted(set(options) - set(Answering.__annotations__))
    if unknown:
        raise OptionError(f"found the options {unknown}; valid are {', '.join(Answering.__annotations__)}")
    told = options.get("parts_list", ())
    name, labels = options.get("answerer", GEOMETRY.name), told_labels(told.split(",") if isinstance(told, str) else told)
    config = Config(
        seed=options.get("seed", 0),
        category=options.get("category"),
        parts_list=labels,
        proposer=options.get("proposer", "exact"),
        verify=options.get("verify", "motion"),
        segmentation=SegmentationConfig(at_least=options.get("at_least", 0)),
    )
    if name == GEOMETRY.name:
        if labels:
            raise OptionError("--parts-list: geometry cannot find parts by their names; it needs an --answerer that sees")
        return Answerer(config, name, None)
    from anymesh.models.connect import open_model  # only those who ask a model wait for its modules
    from anymesh.reasoning.vlm import VlmAnswerer

    cache = options["cache"] if "cache" in options else cache_folder()
    cache = None if cache is None else Path(cache)
    model = open_model(name, cache=cache, max_calls=options.get("max_calls"), max_cost=options.get("max_cost"))
    return Answerer(config, name, lambda instead: VlmAnswerer(model, instead))
