"""Transcript of a run that a budget or an error ended: its questions and answers until then."""

from __future__ import annotations

import logging
from collections.abc import Generator, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from anymesh.entry_points import REMOVE_TRANSCRIPT, WRITE_TRANSCRIPT, load
from anymesh.errors import OpenQuestionError, OutputError
from anymesh.pipeline.answering import AnswererSetup
from anymesh.pipeline.storage.packing import JOINTS, RECOGNITION, SEGMENTATION
from anymesh.pipeline.storage.run_folder import RunFolder
from anymesh.types import Exchange

log = logging.getLogger("anymesh")


@contextmanager
def kept_transcript(run: RunFolder, who: AnswererSetup) -> Generator[None]:
    """Write OUT.transcript beside the output if the run ends early, else remove that of an earlier run."""
    folder = run.target.parent / f"{run.target.name}.transcript"
    try:
        yield
    except OpenQuestionError:
        raise  # the folders of its questions contain them
    except BaseException:
        _write(run, who, folder)
        raise
    if folder.exists():
        with suppress(OSError):
            load(REMOVE_TRANSCRIPT)(folder)


def _write(run: RunFolder, who: AnswererSetup, folder: Path) -> None:
    saved = list(_saved(run))
    exchanges = [*saved, *(e for e in who.exchanges() if e not in saved)]
    if exchanges:
        try:
            load(WRITE_TRANSCRIPT)(exchanges, folder)
            log.warning("what was asked and answered until then: %s", folder / "index.html")
        except OSError as error:  # the error that ended the run is more important
            log.warning("the transcript cannot be written to %s: %s", folder, error.strerror or error)


def _saved(run: RunFolder) -> Iterator[Exchange]:
    for stage in (RECOGNITION, SEGMENTATION, JOINTS):
        with suppress(OutputError):
            yield from run.need(stage).exchanges
