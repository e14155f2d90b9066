"""A run of the fake work in a process of its own, to be killed: python fake_run.py INPUT OUT"""

import signal
import sys
from pathlib import Path

from anymesh.applications.annotate.annotate import annotate
from anymesh.applications.annotate.workers import LocalWorkers
from anymesh.errors import AnymeshError
from anymesh.isolation import ChildLimits


def main(source: str, out: Path) -> None:
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs start with it ignored
    try:
        annotate(source, out, work=LocalWorkers(2, ChildLimits(memory=2 << 30, seconds=20.0, wall=20.0), ("fake_work", "run")))
    except AnymeshError as error:
        sys.exit(str(error))


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]).absolute())
