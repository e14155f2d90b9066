"""Test that a child process that crashes, hangs or exhausts memory fails its own call only."""

from __future__ import annotations

import math
import os
import signal
import subprocess
import sys
import textwrap
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from anymesh.isolation import ChildError, ChildLimits, ChildPool, Failure

FAULTY = "faulty"
HERE = Path(__file__).parent
ONE_THREAD = os.environ | {"OPENBLAS_NUM_THREADS": "1"}


@pytest.fixture
def pool(monkeypatch):
    monkeypatch.syspath_prepend(HERE)
    with ChildPool(1, ChildLimits(seconds=20.0, memory=3 << 30)) as made:
        yield made


def alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_results_come_back_from_a_warm_child(pool):
    first = pool.run(FAULTY, "process", {})
    assert first != os.getpid()
    assert pool.run(FAULTY, "process", {}) == first
    assert pool.run(FAULTY, "add", {"a": 2, "b": 3}) == 5


@pytest.mark.parametrize(
    ("function", "arguments", "failure", "told"),
    [
        ("crash", {}, Failure.CRASH, f"signal {int(signal.SIGSEGV)}"),
        ("eat", {"size": 8 << 30}, Failure.MEMORY, "allocate"),
        ("fail", {}, Failure.ERROR, "error: ValueError: three legs"),
        ("refuse", {}, Failure.INVALID, "invalid: --up: found 'w'"),
        ("give_up", {}, Failure.TIME, "time limit: more than 9 faces"),
    ],
)
def test_a_failure_is_told_and_the_next_call_works(pool, function, arguments, failure, told):
    with pytest.raises(ChildError, match=told) as caught:
        pool.run(FAULTY, function, arguments)
    assert caught.value.failure is failure
    assert pool.run(FAULTY, "add", {"a": 1, "b": 1}) == 2


def test_messages_come_back_in_order_before_the_result(monkeypatch):
    monkeypatch.syspath_prepend(HERE)
    seen = []
    with ChildPool(1, ChildLimits(seconds=math.inf, memory=0)) as pool:
        assert pool.run(FAULTY, "count", {"to": 3}, on_message=lambda *fields: seen.append(fields)) == 3
    assert seen == [("step", 0), ("step", 1), ("step", 2)]


def test_a_call_that_hangs_is_ended_at_its_time_limit(pool):
    hanging = pool.run(FAULTY, "process", {})
    begin = time.monotonic()
    with pytest.raises(ChildError) as caught:
        pool.run(FAULTY, "hang", {}, seconds=0.5)
    assert caught.value.failure is Failure.TIME
    assert time.monotonic() - begin < 10
    assert not alive(hanging)
    assert pool.run(FAULTY, "process", {}) != hanging


def test_a_call_may_use_so_much_processor_time_however_busy_the_machine_is(pool):
    with pytest.raises(ChildError) as caught:
        pool.run(FAULTY, "spin", {}, seconds=1.0)
    assert caught.value.failure is Failure.TIME
    assert pool.run(FAULTY, "add", {"a": 1, "b": 1}) == 2


def test_the_processor_time_of_earlier_calls_does_not_count(pool):
    for _ in range(4):  # a limit of 2 s leaves a second for imports
        assert pool.run(FAULTY, "work", {"seconds": 0.9}, seconds=2.0) == 0.9


def test_what_native_code_prints_does_not_reach_the_answers_or_the_terminal(pool, capfd):
    assert pool.run(FAULTY, "chatter", {}) == "done"
    assert capfd.readouterr() == ("", "")


def test_a_child_has_one_thread(monkeypatch):
    monkeypatch.syspath_prepend(HERE)
    with ChildPool(2) as pool:
        assert pool.run(FAULTY, "threads", {}) == "1"


def test_more_threads_than_children_wait_their_turn(pool):
    with ThreadPoolExecutor(4) as threads:
        sums = list(threads.map(lambda k: pool.run(FAULTY, "add", {"a": k, "b": 1}), range(8)))
    assert sums == list(range(1, 9))


def test_children_end_with_the_pool_even_at_work(monkeypatch):
    monkeypatch.syspath_prepend(HERE)
    pool = ChildPool(1)
    child = pool.run(FAULTY, "process", {})
    with ThreadPoolExecutor(1) as thread:
        hanging = thread.submit(pool.run, FAULTY, "hang", {})
        time.sleep(0.3)
        pool.close()
        with pytest.raises(ChildError):
            hanging.result(timeout=10)
    assert not alive(child)


def test_a_warm_child_answers_also_when_a_module_is_missing(monkeypatch):
    monkeypatch.syspath_prepend(HERE)
    with ChildPool(8) as pool:
        for _ in range(2):  # the second time there is one
            pool.warm(FAULTY, "no_such_module")
        assert len(pool._live) == 1
        assert pool.run(FAULTY, "add", {"a": 1, "b": 2}) == 3


def test_further_children_are_started_when_calls_wait_long(monkeypatch):
    monkeypatch.syspath_prepend(HERE)
    with ChildPool(2) as pool, ThreadPoolExecutor(2) as threads:
        assert len({pool.run(FAULTY, "process", {}) for _ in range(5)}) == 1
        assert len({*threads.map(lambda _: pool.run(FAULTY, "rest", {"seconds": 0.4}), range(8))}) == 2


@pytest.mark.skipif(sys.platform != "linux", reason="children are forked on Linux")
def test_a_process_with_one_thread_forks_children_which_fail_alone():
    script = textwrap.dedent(f"""
        import sys
        sys.path.insert(0, {str(HERE)!r})
        from anymesh.isolation import ChildError, ChildLimits, ChildPool
        with ChildPool(4, ChildLimits(memory=3 << 30)) as pool:
            pool.fork("faulty")
            forked = [child._process._process.pid for child in pool._live]
            assert pool.run("faulty", "process", {{}}) in forked and len(forked) == 2
            for function, arguments, told in (("crash", {{}}, "signal 11"), ("eat", {{"size": 8 << 30}}, "allocate")):
                try:
                    pool.run("faulty", function, arguments)
                except ChildError as error:
                    assert told in str(error)
            assert pool.run("faulty", "add", {{"a": 2, "b": 3}}) == 5
    """)
    done = subprocess.run([sys.executable, "-c", script], env=ONE_THREAD, capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("start", ["", "shared_pool().fork('faulty')"])
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_children_at_work_end_with_their_parent(how, start):
    script = textwrap.dedent(f"""
        import signal, sys
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs start with it ignored
        sys.path.insert(0, {str(HERE)!r})
        from anymesh.isolation import shared_pool
        {start}
        print(shared_pool().run("faulty", "process", {{}}), flush=True)
        shared_pool().run("faulty", "hang", {{}})
    """)
    env = os.environ | {"OPENBLAS_NUM_THREADS": "1"}
    process = subprocess.Popen(
        [sys.executable, "-c", script], env=env, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    child = int(process.stdout.readline())
    time.sleep(0.5)
    process.send_signal(how)
    process.wait(timeout=20)
    deadline = time.monotonic() + 5
    while alive(child) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not alive(child)


def test_a_child_is_replaced_after_so_many_calls(monkeypatch):
    monkeypatch.syspath_prepend(HERE)
    with ChildPool(1, ChildLimits(calls=2)) as pool:
        first, second, third = (pool.run(FAULTY, "process", {}) for _ in range(3))
    assert first == second != third


def test_elapsed_time_has_a_limit_of_its_own(monkeypatch):
    monkeypatch.syspath_prepend(HERE)
    with ChildPool(1, ChildLimits(seconds=30.0, wall=0.5)) as pool, pytest.raises(ChildError, match=r"time limit: 0\.5 s"):
        pool.run(FAULTY, "hang", {})
