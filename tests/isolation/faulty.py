"""Functions for child processes in the tests; each fails on purpose like native code."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable

import numpy as np

from anymesh.errors import OptionError


def add(a: int, b: int) -> int:
    return a + b


def crash() -> None:
    os.kill(os.getpid(), signal.SIGSEGV)


def hang() -> None:
    time.sleep(60)


def eat(size: int) -> int:
    return len(np.ones(size, np.uint8))


def fail() -> None:
    raise ValueError("three legs")


def give_up() -> None:
    raise TimeoutError("more than 9 faces")


def refuse() -> None:
    raise OptionError("--up: found 'w'")


def count(to: int, report: Callable[..., None]) -> int:
    for k in range(to):
        report("step", k)
    return to


def chatter() -> str:
    os.write(1, b"native noise on standard output")
    return "done"


def process() -> int:
    return os.getpid()


def rest(seconds: float) -> int:
    time.sleep(seconds)
    return os.getpid()


def threads() -> str:
    return os.environ["OMP_NUM_THREADS"]


def spin() -> None:
    while True:
        pass


def work(seconds: float) -> float:
    end = time.process_time() + seconds
    while time.process_time() < end:
        pass
    return seconds
