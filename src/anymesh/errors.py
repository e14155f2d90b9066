"""Errors that this package raises on purpose: one subclass of AnymeshError per case that a caller may handle.

A message says what was found and what would have been valid. `exit_code` is the exit code of the command line.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

DEFECT = 70  # exit code of an internal defect: EX_SOFTWARE of sysexits.h
RESUMES = "the same command resumes"  # note of an interrupt after which finished stages are kept
STAGE = "in the stage "  # prefix of the note that names the stage of an error
SECRET = re.compile(r"[A-Za-z0-9+/=_-]{32,}|\S*\*{3,}\S*|\b(?:sk-|AIza|Bearer )\S+")  # looks like a key, or like data
MAX_QUOTE = 200  # maximum number of characters of another program's message that are quoted
PLACE = re.compile(  # an address; a path in quotes, as Python prints it; a path
    r"\b\w[\w+.-]*://[^\s#'\"]*|(['\"])[^'\"]*[\\/](?P<quoted>[^'\"\\/]*)\1"
    r"|(?:(?<!\w)[A-Za-z]:)?[^\s:#'\"(),=<>]*[\\/](?P<name>[^\\/\s:#'\"(),=<>]*)"
)
LONGEST = 500  # maximum number of characters of a redacted text
PIP_TARGET = "."  # what pip installs: the checkout, from its folder, until the package is on PyPI; then its name


class AnymeshError(Exception):
    """Base of all errors of this package; only its subclasses are raised."""

    exit_code = DEFECT


class InputError(AnymeshError):
    """The mesh, or a file it refers to, cannot be used: missing, truncated, empty, not finite, outside its folder."""

    exit_code = 3


class OptionError(AnymeshError):
    """An option has a value that is not valid, alone or for this input."""

    exit_code = 2


class OutputError(AnymeshError):
    """The output folder exists, cannot be written, or lacks a stage's result that the next stage needs."""

    exit_code = 4


class MissingExtraError(AnymeshError):
    """An optional dependency is not installed; the message names the extra that provides it."""

    exit_code = 5


class ModelError(AnymeshError):
    """An external model cannot be asked: no key, refused, unreachable after every retry.

    The error holds no key and no header.
    """

    exit_code = 6


class BudgetError(ModelError):
    """The next call would exceed --max-calls or --max-cost. Earlier answers are kept; a rerun continues from there."""

    exit_code = 7


class OpenQuestionError(ModelError):
    """A question has no answer in its folder yet.

    Finished stages are kept; a rerun continues from there.
    folders: of the open questions.
    """

    exit_code = 9

    def __init__(self, message: str, folders: Sequence[Path] = ()) -> None:
        super().__init__(message)
        self.folders = tuple(folders)

    def __reduce__(self) -> tuple[type[OpenQuestionError], tuple[str, tuple[Path, ...]]]:
        return type(self), (str(self), self.folders)  # evaluations pass it between processes


def note_stage(error: BaseException, stage: str) -> None:
    """Add to an error's traceback the stage in which it was raised."""
    error.add_note(f"{STAGE}{stage}")


def failed_stage(error: BaseException) -> str | None:
    """Return the stage that was noted on an error, None if there is none."""
    notes = (note for note in getattr(error, "__notes__", ()) if note.startswith(STAGE))
    return next((note.removeprefix(STAGE) for note in notes), None)


def redacted(text: str) -> str:
    """Return a text as one line without addresses, folders, and what looks like a key or like data."""

    def shown(place: re.Match[str]) -> str:
        if place["quoted"] is not None:
            return f"{place[1]}{place['quoted']}{place[1]}"
        return "[address]" if place["name"] is None else place["name"]

    return SECRET.sub("[removed]", PLACE.sub(shown, " ".join(text.split())))[:LONGEST]


def pip_install(extra: str) -> str:
    """Return the command that installs an extra, as messages quote it."""
    return f"`pip install '{PIP_TARGET}[{extra}]'`"
