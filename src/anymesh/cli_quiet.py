"""What libraries say is kept off the terminal of the command line; what this package logs is shown, each message once."""

from __future__ import annotations

import logging
import os
import sys
import warnings
from collections.abc import Generator
from contextlib import contextmanager

from anymesh.cli_output import plain

OWN = "anymesh"
VARIABLE = "PYTHONWARNINGS"  # how Python's child processes are told what to do with warnings


class _Once(logging.Handler):
    """Writes each warning of this package to stderr, as one line, the first time that it comes up."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self._said: set[str] = set()

    def emit(self, record: logging.LogRecord) -> None:
        text = plain(" ".join(record.getMessage().split()))
        if text not in self._said:
            self._said.add(text)
            sys.stderr.write(f"warning: {text}\n")


@contextmanager
def quiet_libraries() -> Generator[None]:
    """Silence Python warnings, of child processes too, and log records of libraries; for the command line alone.

    Warnings that a user asked for (`python -W`, PYTHONWARNINGS) stay as asked.
    """
    root, own = logging.getLogger(), logging.getLogger(OWN)
    sink, handler = logging.NullHandler(), _Once()  # a record that finds no handler at all would go to stderr
    asked, before = bool(sys.warnoptions), os.environ.get(VARIABLE)
    root.addHandler(sink)
    own.addHandler(handler)
    try:
        with warnings.catch_warnings():
            if not asked:
                warnings.simplefilter("ignore")
                os.environ[VARIABLE] = "ignore"
            yield
    finally:
        root.removeHandler(sink)
        own.removeHandler(handler)
        os.environ.pop(VARIABLE, None)
        if before is not None:
            os.environ[VARIABLE] = before
