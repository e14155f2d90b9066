"""Suppression of library output on the command line; log messages of this package are shown, each once."""

from __future__ import annotations

import logging
import os
import sys
import warnings
from collections.abc import Generator
from contextlib import contextmanager

from anymesh.cli.output import plain

OWN = "anymesh"
VARIABLE = "PYTHONWARNINGS"  # passes the warning filter to Python child processes


class _Once(logging.Handler):
    """Handler that writes each warning of this package to stderr, as one line, the first time that it occurs."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self._shown: set[str] = set()

    def emit(self, record: logging.LogRecord) -> None:
        text = plain(" ".join(record.getMessage().split()))
        if text not in self._shown:
            self._shown.add(text)
            sys.stderr.write(f"warning: {text}\n")


@contextmanager
def quiet_libraries() -> Generator[None]:
    """Silence Python warnings, also of child processes, and log records of libraries; for the command line only.

    Warnings that the user requested (`python -W`, PYTHONWARNINGS) are kept.
    """
    root, own = logging.getLogger(), logging.getLogger(OWN)
    sink, handler = logging.NullHandler(), _Once()  # records without any handler would go to stderr
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
