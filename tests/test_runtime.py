"""Test that threads and processes are as many as the cores that a process may use, not as many as the machine has."""

from __future__ import annotations

import os
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import pytest

from anymesh.runtime import usable_cores


@pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="the system cannot keep a process to a core")
def test_a_process_that_is_kept_to_one_core_has_one() -> None:
    mine = os.sched_getaffinity(0)
    assert usable_cores() == len(mine)
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        pool.submit(os.sched_setaffinity, 0, {min(mine)}).result()
        assert pool.submit(usable_cores).result() == 1


def test_elsewhere_it_has_all_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(os, "sched_getaffinity", raising=False)
    monkeypatch.setattr(os, "cpu_count", lambda: 3)
    assert usable_cores() == 3
    monkeypatch.setattr(os, "cpu_count", lambda: None)
    assert usable_cores() == 1
