"""Choose the answerer of both stages from the options of a run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from hashlib import sha256
from importlib.resources import files
from pathlib import Path
from threading import Event

from anymesh.config import Config, SegmentationConfig
from anymesh.errors import OptionError
from anymesh.pipeline.options import GEOMETRY, AnswererOptions, Answering
from anymesh.prompted.answerers.patience import Patience
from anymesh.prompted.models.cache import cache_folder
from anymesh.prompted.models.servers import SERVERS
from anymesh.prompted.questions.asking import AnswererFactory, VisualAnswerer
from anymesh.prompted.questions.recognition import parse_labels
from anymesh.runtime import Deadline
from anymesh.types import Exchange

FILES = "files:"
CLASSIFIERS = (
    "segmentation/part_classifier.npz", "articulation/unswept_classifier.npz", "articulation/motion_classifier.npz"
)  # fmt: skip


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


@dataclass(frozen=True, eq=False)
class AnswererSetup:
    """The settings of a run, the name of the answerer, and its factory (None: geometry).

    is_current: returns whether a saved stage still has the answers that it was made with; exchanges: returns every call to a
    model in this run; new_factory: makes the same answerer for another run, with the same model and budget.
    """

    config: Config
    name: str
    factory: AnswererFactory | None
    is_current: Callable[[Sequence[Exchange]], bool] = field(default=lambda exchanges: True)
    exchanges: Callable[[], tuple[Exchange, ...]] = tuple
    new_factory: Callable[[], AnswererFactory] | None = None

    def settings(self, *without: str) -> dict[str, object]:
        """Return the settings that the result of a stage depends on, without those that the stage does not use."""
        chosen = {k: v for k, v in self.config.as_dict().items() if k not in without}
        return {**chosen, "answerer": self.name, "classifiers": _digest_of_classifiers()}


@cache
def _digest_of_classifiers() -> str:
    """Return a digest of the shipped classifiers, so that results of former ones are not used again."""
    return sha256(b"".join((files("anymesh") / place).read_bytes() for place in CLASSIFIERS)).hexdigest()


def choose_answerer(
    options: Answering, *, about: str | None = None, deadline: Deadline | None = None, stop: Event | None = None
) -> AnswererSetup:
    """Return the answerer that the options choose.

    deadline: paused while waiting for an answer; about, stop: for answers in files, the object's name, and the event that ends
    the waiting.

    Raise OptionError for options that are not valid, ModelError if a model cannot be asked at all (no key).
    """
    unknown = sorted(set(options) - set(Answering.__annotations__))
    if unknown:
        raise OptionError(f"found the options {unknown}; valid are {', '.join(Answering.__annotations__)}")
    chosen = AnswererOptions(**options)
    name = chosen.answerer
    config, limit = _config(chosen), deadline or Deadline()
    if name == GEOMETRY:
        if config.parts_list:
            raise OptionError("--parts-list: geometry cannot find parts by name; choose a model or files with --answerer")
        return AnswererSetup(config, name, None)
    if name.startswith(FILES):
        return _from_files(config, name, chosen, about, limit, stop)
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
        return RecordingFactory(lambda fallback, patience: VlmAnswerer(model, fallback, patience, limit.paused))

    asked = renewed()
    return AnswererSetup(config, name, asked, exchanges=asked.exchanges, new_factory=renewed)


def _config(options: AnswererOptions) -> Config:
    """Return the settings of a run that the options change."""
    labels = options.parts_list
    config = Config(
        seed=options.seed,
        category=options.category,
        parts_list=parse_labels(labels.split(",") if isinstance(labels, str) else labels),
        proposer=options.proposer,
        verify=options.verify,
        segmentation=SegmentationConfig(at_least=options.at_least),
    )
    return replace(config, views=replace(config.views, around=options.viewpoints))


def _cache(setting: Path | str | None) -> Path | None:
    """Return the folder of cached answers; "auto" is the user's cache folder, "off" and None are none."""
    return cache_folder() if setting == "auto" else None if setting in (None, "off") else Path(setting)


def object_name(mesh: str | Path) -> str:
    """Return the name of a mesh among others.

    It consists of the names of its folder and file, since many data sets give every file the same name.
    """
    path = Path(mesh).absolute()
    return f"{path.parent.name}/{path.name}"


def _from_files(
    config: Config, name: str, options: AnswererOptions, about: str | None, deadline: Deadline, stop: Event | None
) -> AnswererSetup:
    from anymesh.prompted.answerers.file_answerer import FileAnswerer, still_answered
    from anymesh.prompted.answerers.question_store import QuestionStore

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
