"""A run of the fake work in a process of its own, to be killed: python fake_run.py INPUT OUT"""

import signal
import sys
from pathlib import Path

from anymesh.applications.annotate.claims import begun_run
from anymesh.applications.annotate.entering import enter_objects
from anymesh.applications.annotate.inputs import find_objects
from anymesh.applications.annotate.outages import Outage
from anymesh.applications.annotate.runner import Plan, Runner
from anymesh.applications.annotate.salvage import open_ledger
from anymesh.applications.annotate.workers import LocalWorkers, ObjectLimits


def main(source: str, out: Path) -> None:
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs start with it ignored
    workers = LocalWorkers(2, ObjectLimits(2 << 30, 20.0, 20.0), ("fake_work", "run"))
    with open_ledger(out) as ledger:
        enter_objects(ledger, find_objects(source, without=out))
        with begun_run(ledger, 2) as run:
            try:
                Runner(ledger, run, workers, Plan({}), Outage(60.0)).loop()
            finally:
                workers.close()


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]).absolute())
