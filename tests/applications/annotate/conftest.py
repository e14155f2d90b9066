"""Collections of small files for the fake work."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from anymesh.applications.annotate.ledger import Ledger, driven_ledger
from anymesh.applications.annotate.workers import LocalWorkers
from anymesh.isolation import ChildLimits

TARGET = ("fake_work", "run")
LIMITS = ChildLimits(memory=2 << 30, seconds=20.0, wall=6.0)  # imports alone take seconds on a busy machine


@pytest.fixture
def workers(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., LocalWorkers]]:
    """Makes worker processes that run the fake work."""
    monkeypatch.syspath_prepend(Path(__file__).parent)
    made: list[LocalWorkers] = []

    def make(count: int = 2, limits: ChildLimits = LIMITS) -> LocalWorkers:
        made.append(LocalWorkers(count, limits, TARGET))
        return made[-1]

    yield make
    for some in made:
        some.close()


@pytest.fixture
def ledger(tmp_path: Path) -> Iterator[Ledger]:
    with driven_ledger(tmp_path / "out", 2) as made:
        yield made


@pytest.fixture
def collection(tmp_path: Path) -> Callable[..., Path]:
    """Writes a folder of meshes, which hold the words that the fake work does."""

    def make(**words: str) -> Path:
        folder = tmp_path / "in"
        folder.mkdir(exist_ok=True)
        for name, word in words.items():
            (folder / f"{name}.glb").write_text(word)
        return folder

    return make


@pytest.fixture
def metered(monkeypatch: pytest.MonkeyPatch) -> None:
    """Options count as those of a model, whose calls are counted."""
    monkeypatch.setattr("anymesh.applications.annotate.annotate.checked", lambda _: "openai:gpt-4o")
