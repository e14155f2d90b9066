"""Choose the answerer of both stages from the options of a run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field
from functools import cache
from hashlib import sha256
from importlib.resources import files
from pathlib import Path
from threading import Event

from anymesh.config import Config
from anymesh.entry_points import OPEN_ANSWERER, resolve
from anymesh.errors import OptionError
from anymesh.pipeline.options import GEOMETRY, AnswererOptions, Answering
from anymesh.runtime import Deadline
from anymesh.types import Exchange
from anymesh.types.questions import AnswererFactory

CLASSIFIERS = ("segmentation/part_classifier.npz", "articulation/unswept_classifier.npz", "articulation/motion_classifier.npz")


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
        chosen = {k: v for k, v in asdict(self.config).items() if k not in without}
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
    config = Config(
        seed=chosen.seed, category=chosen.category, proposer=chosen.proposer, verify=chosen.verify, ask=chosen.ask,
        pictures=chosen.pictures, detail=chosen.detail, viewpoints=chosen.viewpoints, at_least=chosen.at_least,
    )  # fmt: skip
    if chosen.answerer != GEOMETRY:
        return resolve(OPEN_ANSWERER)(chosen, config, about, deadline or Deadline(), stop)
    if chosen.parts_list:
        raise OptionError("--parts-list: geometry cannot find parts by name; choose a model or files with --answerer")
    return AnswererSetup(config, GEOMETRY, None)


def object_name(mesh: str | Path) -> str:
    """Return the name of a mesh among others.

    It consists of the names of its folder and file, since many data sets give every file the same name.
    """
    path = Path(mesh).absolute()
    return f"{path.parent.name}/{path.name}"
