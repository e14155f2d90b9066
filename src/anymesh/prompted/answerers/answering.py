"""Open the answerers other than geometry: models, files and recordings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from threading import Event

from anymesh.config import Config
from anymesh.errors import OptionError
from anymesh.pipeline.answering import AnswererSetup
from anymesh.pipeline.options import FILES, AnswererOptions
from anymesh.prompted.answerers.vlm_answerer import Patience
from anymesh.prompted.models.servers import SERVERS
from anymesh.prompted.questions.recognition import parse_labels
from anymesh.runtime import Deadline, cache_folder
from anymesh.types import Exchange
from anymesh.types.questions import VisualAnswerer


class RecordingFactory:
    """Factory of the answerers of one run; they share their patience, and their exchanges survive an error."""

    def __init__(self, make: Callable[[VisualAnswerer, Patience], VisualAnswerer]) -> None:
        self._make, self._patience, self._made = make, Patience(), list[VisualAnswerer]()

    def __call__(self, fallback: VisualAnswerer) -> VisualAnswerer:
        made = self._make(fallback, self._patience)
        self._made.append(made)
        return made

    def exchanges(self) -> tuple[Exchange, ...]:
        """Return all calls so far."""
        return tuple(e for answerer in self._made for e in answerer.exchanges)


def open_answerer(
    chosen: AnswererOptions, config: Config, about: str | None, deadline: Deadline, stop: Event | None
) -> AnswererSetup:
    """Return the setup of an answerer other than geometry; see `anymesh.pipeline.answering.choose_answerer`.

    Raise OptionError for options that are not valid, ModelError if a model cannot be asked at all (no key).
    """
    name, labels = chosen.answerer, chosen.parts_list
    config = replace(config, parts_list=parse_labels(labels.split(",") if isinstance(labels, str) else labels))
    if name.startswith(FILES):
        return _from_files(config, name, chosen, about, deadline, stop)
    from anymesh.prompted.answerers.vlm_answerer import VlmAnswerer
    from anymesh.prompted.models.connect import open_model  # import on use: only runs with a model need these modules

    model = open_model(
        name,
        cache=_cache(chosen.cache),
        max_calls=chosen.max_calls,
        max_cost=None if name.partition(":")[0] in SERVERS else chosen.max_cost,  # the user's own servers cost nothing
        timeout=chosen.timeout,
        spent=chosen.spent,
        limiter=chosen.limiter,
    )

    def renewed() -> RecordingFactory:
        return RecordingFactory(lambda fallback, patience: VlmAnswerer(model, fallback, patience, deadline.paused))

    asked = renewed()
    return AnswererSetup(config, name, asked, exchanges=asked.exchanges, new_factory=renewed)


def _cache(setting: Path | str | None) -> Path | None:
    """Return the folder of cached answers; "auto" is the user's cache folder, "off" and None are none."""
    return cache_folder() if setting == "auto" else None if setting in (None, "off") else Path(setting)


def _from_files(
    config: Config, name: str, options: AnswererOptions, about: str | None, deadline: Deadline, stop: Event | None
) -> AnswererSetup:
    from anymesh.prompted.answerers.file_answerer import FileAnswerer, still_answered
    from anymesh.prompted.answerers.question_files import QuestionStore

    folder = name.removeprefix(FILES)
    if not folder.strip():
        raise OptionError("answers from files need a folder: --answerer files:FOLDER")
    store = QuestionStore(Path(folder), about)
    return AnswererSetup(
        config,
        name,
        lambda fallback: FileAnswerer(
            store,
            fallback,
            wait=options.wait,
            paused=deadline.paused,
            stop=stop,
            suggest=options.suggest,
        ),
        lambda exchanges: still_answered(store, exchanges),
    )
