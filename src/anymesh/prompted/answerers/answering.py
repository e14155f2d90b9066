"""Open the answerers other than geometry: models, files and recordings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from threading import Event

from anymesh.config import Config
from anymesh.errors import OptionError
from anymesh.pipeline.answering import AnswererSetup
from anymesh.pipeline.options import FILES, Account, AnswererOptions
from anymesh.prompted.answerers.recordings import Cached, Replay
from anymesh.prompted.answerers.vlm_answerer import Patience, VlmAnswerer
from anymesh.prompted.models.budget import Budgeted, Limiter, RateLimited
from anymesh.prompted.models.reliability import kept_probe
from anymesh.prompted.models.retry import Retrying
from anymesh.prompted.models.servers import SERVERS
from anymesh.prompted.models.vision import VisionModel
from anymesh.prompted.pictures.sheet import MAX_PICTURES
from anymesh.prompted.questions.recognition import parse_labels
from anymesh.runtime import CALL_SECONDS, Deadline, cache_folder
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
    if chosen.cache != "off":
        config = replace(config, probed=kept_probe(name, config.pictures))
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
        most = pictures_per_call(config)
        return RecordingFactory(lambda fallback, patience: VlmAnswerer(model, fallback, patience, deadline.paused, most))

    asked = renewed()
    return AnswererSetup(config, name, asked, exchanges=asked.exchanges, new_factory=renewed)


def pictures_per_call(config: Config) -> int:
    """Return the number of pictures that a model takes in one call."""
    return 1 if config.pictures == "few" else MAX_PICTURES


def _cache(setting: Path | str | None) -> Path | None:
    """Return the folder of cached answers; "auto" is the user's cache folder, "off" and None are none."""
    return cache_folder() if setting == "auto" else None if setting in (None, "off") else Path(setting)


def _from_files(
    config: Config, name: str, options: AnswererOptions, about: str | None, deadline: Deadline, stop: Event | None
) -> AnswererSetup:
    from anymesh.prompted.answerers.file_answerer import FileAnswerer, still_answered
    from anymesh.prompted.answerers.question_files import OCCUPIED, QuestionStore, is_occupied

    folder = name.removeprefix(FILES)
    if not folder.strip():
        raise OptionError("answers from files need a folder: --answerer files:FOLDER")
    if is_occupied(Path(folder)):
        raise OptionError(OCCUPIED.format(name))
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
            one=config.pictures == "few",
        ),
        lambda exchanges: still_answered(store, exchanges),
    )


def open_model(
    name: str,
    *,
    cache: Path | None = None,
    max_calls: int | None = None,
    max_cost: float | None = None,
    spent: Account | None = None,
    limiter: Limiter | None = None,
    timeout: float = CALL_SECONDS,
) -> VisionModel:
    """Open the model of that name, or a recording of one (`replay:FOLDER`); cache: folder, None for no cache.

    The cache is the outermost wrapper, so hits do not count towards the budget. Retries are inside the budget, so only answers
    count.
    `timeout` [s] applies to one attempt; waiting for the limiter is not included.
    Raise OptionError for an invalid name or budget, ModelError without a key, MissingExtraError without the libraries.
    """
    from anymesh.prompted.models.pydantic_ai_ import connect  # import on use: a replay does not need it

    kind, _, folder = name.partition(":")
    if kind == "replay":
        if not folder:
            raise OptionError("a recording is named replay:FOLDER")
        return Replay(Path(folder))
    model: VisionModel = connect(name, timeout=timeout)
    model = Retrying(model if limiter is None else RateLimited(model, limiter))
    model = Budgeted(model, max_calls=max_calls, max_cost=max_cost, spent=spent)
    return model if cache is None else Cached(model, cache)
