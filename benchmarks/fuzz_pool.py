"""Runs cases in warm worker processes; a worker that crashes, hangs or eats memory is recorded and replaced."""

from __future__ import annotations

import json
import os
import queue
import re
import select
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
WORKER = ROOT / "benchmarks" / "fuzz_worker.py"
POLL = 0.5  # [s] between looks at the memory
GRACE = 2.0  # [s] for the stack of a worker over its time limit to be written
RENEW = 2 * 1024**3  # [bytes] of resident memory after a case, above which a worker is replaced
PAGE = os.sysconf("SC_PAGE_SIZE")
FRAME = re.compile(r'File "[^"]*?anymesh/([^"]+)", line (\d+) in (\S+)')

Case = dict[str, Any]
Result = dict[str, Any]


class Worker:
    """One child process and what it writes to standard error."""

    def __init__(self, folder: Path, memory: int) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self._log, self._memory = folder / "stderr.txt", memory
        self._env = {
            **os.environ,
            "ANYMESH_CACHE": str(folder / "cache"),
            "PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path]),
        }
        self._child: subprocess.Popen[bytes] | None = None

    def run(self, case: Case, limit: float, stop: threading.Event) -> Result | None:
        """The result of a case, whatever becomes of the process; None once `stop` is set."""
        child = self._child or self._start()
        assert child.stdin is not None
        assert child.stdout is not None
        start, begin = self._log.stat().st_size, time.monotonic()
        child.stdin.write(json.dumps(case).encode() + b"\n")
        child.stdin.flush()
        found: Result | None = None
        while found is None and not stop.is_set():
            seconds = time.monotonic() - begin
            if select.select([child.stdout], [], [], POLL)[0]:
                line = child.stdout.readline()
                found = json.loads(line) if line.endswith(b"\n") else self._crashed(child, start)
            elif seconds > limit:
                found = self._stopped("over time limit", child, start)
            elif _resident(child.pid) > self._memory:
                found = self._stopped("over memory limit", child, start)
        if found is None:
            return None
        found.setdefault("seconds", round(time.monotonic() - begin, 1))
        if self._child and _resident(child.pid) > RENEW:
            self.close()
        return found

    def close(self) -> None:
        """Ends the process and all of its group."""
        if self._child:
            _kill(self._child)
        self._child = None

    def _start(self) -> subprocess.Popen[bytes]:
        with self._log.open("wb") as log:
            self._child = subprocess.Popen(
                [sys.executable, str(WORKER)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=log,
                env=self._env,
                start_new_session=True,
            )
        return self._child

    def _crashed(self, child: subprocess.Popen[bytes], start: int) -> Result:
        code = child.wait()
        self.close()
        name = signal.Signals(-code).name if code < 0 else f"exit code {code}"
        return {"outcome": "crash", "kind": name, **self._stack(start)}

    def _stopped(self, outcome: str, child: subprocess.Popen[bytes], start: int) -> Result:
        os.kill(child.pid, signal.SIGUSR1)
        time.sleep(GRACE)
        self.close()
        return {"outcome": outcome, "kind": outcome, **self._stack(start)}

    def _stack(self, start: int) -> Result:
        """The stack of the thread that crashed, or of the main thread, as faulthandler writes it: innermost first."""
        text = self._log.read_bytes()[start:].decode(errors="replace")
        stacks = re.split(r"(?m)^(?=(?:Current thread|Thread) 0x)", text)
        current = next((s for s in stacks if s.startswith("Current")), stacks[-1])
        frames = [f"{path}:{name} {line}" for path, line, name in FRAME.findall(current)]
        return {"where": frames[0] if frames else "", "trace": frames[::-1][-14:], "message": _last_words(stacks[0])}


def _last_words(text: str) -> str:
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return " | ".join(lines[-3:])[:300]


def _resident(pid: int) -> int:
    try:
        return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * PAGE
    except (OSError, IndexError, ValueError):
        return 0


def _kill(child: subprocess.Popen[bytes]) -> None:
    with suppress(ProcessLookupError):
        os.killpg(child.pid, signal.SIGKILL)
    child.wait()
    for stream in (child.stdin, child.stdout):
        if stream:
            with suppress(BrokenPipeError):
                stream.close()


def run_all(
    cases: list[Case], folder: Path, *, workers: int, limit: float, memory: int, done: Callable[[Case, Result], None]
) -> None:
    """Runs cases in their order. limit: [s] for each run of one; memory: [bytes]; `done` gets each result, one at a time."""
    waiting: queue.SimpleQueue[Case] = queue.SimpleQueue()
    for case in cases:
        waiting.put(case)
    lock, stop = threading.Lock(), threading.Event()

    def work(number: int) -> None:
        place = folder / f"worker_{number}"
        worker = Worker(place, memory)
        try:
            while not stop.is_set():
                try:
                    case = waiting.get_nowait()
                except queue.Empty:
                    return
                seconds = limit * (2 if case.get("twice") else 1)
                result = worker.run({**case, "work": str(place / "case")}, case.get("limit", seconds), stop)
                if result:
                    with lock:
                        done(case, result)
        finally:
            worker.close()

    threads = [threading.Thread(target=work, args=(k,), daemon=True) for k in range(workers)]
    for thread in threads:
        thread.start()
    try:
        for thread in threads:
            while thread.is_alive():
                thread.join(POLL)
    except KeyboardInterrupt:
        stop.set()
        for thread in threads:
            thread.join()
        raise
