"""Retexturing by Meshy: a paid task is created once, waited for, and resumed by a rerun."""

from __future__ import annotations

import base64
import hashlib
import json
import logging
import random
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TypeVar

from anymesh.errors import BudgetError, ModelError, OptionError, OutputError
from anymesh.finishing.meshy_api import (
    RETEXTURE,
    TASK_ID,
    RefusedError,
    Task,
    TaskKind,
    create_task,
    download_glb,
    get_task,
    list_tasks,
    read_key,
)
from anymesh.finishing.web import LostError
from anymesh.prompted.models.retry import persist
from anymesh.runtime import write_whole

log = logging.getLogger("anymesh")
T = TypeVar("T")
OVER = ("FAILED", "EXPIRED", "CANCELED", "CANCELLED")
AROUND = 900.0  # [s] largest difference between request and creation of a task that is matched by time
LONGEST_PROMPT = 600  # characters
LARGEST_MODEL = 100_000_000  # [bytes] of a model sent as a data URI


@dataclass(frozen=True)
class Bought:
    """Finished paid task. credits: that it took; seed: drawn by the service, None if not stated."""

    task: str
    credits: float
    seed: int | None = None


@dataclass(frozen=True)
class Pending:
    """Stored state of a paid task.

    request: digest of the request; task: its id, None until its creation is confirmed; known: ids of the tasks that existed
    before it, None if they could not be listed; asked: start time of its creation [s since 1970]; bought: once it has
    succeeded.
    """

    request: str
    task: str | None
    known: tuple[str, ...] | None = None
    asked: float = 0.0
    bought: Bought | None = None


def read_pending(path: Path, request: str) -> Pending | None:
    """Read the state of this request; None if the file is about another one, is missing or cannot be read."""
    try:
        held = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    if not isinstance(held, dict) or held.get("request") != request:
        return None
    task, known, asked = held.get("task"), held.get("known"), held.get("asked")
    valid = task if isinstance(task, str) and TASK_ID.fullmatch(task) else None
    ids = tuple(k for k in known if isinstance(k, str)) if isinstance(known, list) else None
    when = float(asked) if isinstance(asked, int | float) else 0.0
    return Pending(request, valid, ids, when, _bought(valid, held.get("bought")))


def _bought(task: str | None, held: object) -> Bought | None:
    if task is None or not isinstance(held, dict) or not isinstance(held.get("credits"), int | float):
        return None
    seed = held.get("seed")
    return Bought(task, float(held["credits"]), seed if isinstance(seed, int) else None)


def write_pending(path: Path, pending: Pending) -> None:
    """Write the state. Raise OutputError if that fails, so that no task is bought that a rerun could not find."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, (json.dumps(asdict(pending), indent=1) + "\n").encode())
    except OSError as error:
        raise OutputError(f"the state of a paid task cannot be kept in {path}: {error.strerror}") from None


@dataclass(frozen=True)
class Order:
    """Task to be paid for once.

    body: of the request, JSON; state: the file that stores the task's id; prompt: as task objects repeat it, None if they
    repeat nothing that identifies the task; seed: of the task that it refines.
    """

    kind: TaskKind
    body: bytes = field(repr=False)
    state: Path
    prompt: str | None = None
    seed: int | None = None

    @property
    def digest(self) -> str:
        """SHA-256 of the request."""
        return hashlib.sha256(self.body).hexdigest()

    def may_be(self, task: Task, asked: float) -> bool:
        """Return whether a listed task can be this one. asked: time of the request [s since 1970]."""
        if task.type not in ("", self.kind.type) or (None not in (self.seed, task.seed) and self.seed != task.seed):
            return False
        return abs(task.created - asked) < AROUND if self.prompt is None else task.prompt == self.prompt


@dataclass
class PaidTasks:
    """Client that creates tasks, waits for them, and downloads their results.

    It stores no key: MESHY_API_KEY is read at each call. state: the file that stores a task's id; max_calls: maximum number of
    paid tasks; timeout: of one call [s] (ten times that for a download); patience: for a task [s]. `calls` and `credits` count
    what this object spent.
    """

    state: Path
    model: str = "latest"
    max_calls: int | None = None
    timeout: float = 60.0
    patience: float = 3600.0  # the service's documentation recommends an hour
    sleep: Callable[[float], None] = field(default=time.sleep, repr=False)
    chance: Callable[[], float] = field(default=random.random, repr=False)
    watch: Callable[[TaskKind, Task], None] = field(default=lambda kind, task: None, repr=False)
    name: str = field(default="meshy", init=False)
    calls: int = field(default=0, init=False)
    credits: float = field(default=0.0, init=False)

    def __post_init__(self) -> None:
        if self.max_calls is not None and self.max_calls < 0:
            raise OptionError(f"--max-calls must be 0 or more, found {self.max_calls}")
        if not (self.timeout > 0 and self.patience > 0):
            raise OptionError(f"time-outs must be more than 0 s, found {self.timeout:g} and {self.patience:g}")

    def held(self, order: Order) -> Pending | None:
        """Return what an earlier run stored about this order; None if it was not started."""
        return read_pending(order.state, order.digest)

    def run(self, order: Order) -> Bought:
        """Return the finished task of an order: that of an earlier run, or else a new one.

        Raise ModelError without a key or a result, BudgetError before a task beyond the limit, OutputError if the id of the
        task cannot be stored.
        """
        held, before = self.held(order), self.calls
        task = held.task if held else None
        if task is None:
            task = self._lost(held, order) or self._create(order)
            write_pending(order.state, Pending(order.digest, task))
        else:
            log.info("meshy: resuming task %s", task)
        finished = self._wait(order, task)
        self.credits += finished.credits if self.calls > before else 0.0
        bought = Bought(task, finished.credits, finished.seed)
        write_pending(order.state, Pending(order.digest, task, bought=bought))
        return bought

    def fetch(self, order: Order, task: str) -> bytes:
        """Download the GLB of a finished task. Its signed address expires, so it is requested each time."""

        def fetch() -> bytes:
            url = self._look(order, task).url
            if url is None:
                raise ModelError(f"meshy: task {task} succeeded without a GLB")
            return download_glb(url, 10 * self.timeout)

        return self._persist(fetch)

    def check_budget(self, *kinds: TaskKind) -> None:
        """Raise BudgetError if paying for a task of each kind would exceed the limit."""
        if self.max_calls is None or self.calls + len(kinds) <= self.max_calls:
            return
        credits = sum(kind.credits for kind in kinds)
        what = f"{kinds[0].name} takes" if len(kinds) == 1 else f"{' and '.join(kind.name for kind in kinds)} take"
        spent = f"spent so far: {self.calls} tasks, {self.credits:g} credits"
        raise BudgetError(f"meshy: {what} about {credits} credits and would exceed --max-calls {self.max_calls}; {spent}")

    def _create(self, order: Order) -> str:
        """Create a task and return its id. If the id does not arrive, look for the task before creating another one."""
        self.check_budget(order.kind)
        before = self._tasks(order.kind)
        known = None if before is None else tuple(task.id for task in before)
        pending = Pending(order.digest, None, known, time.time())
        write_pending(order.state, pending)

        def create() -> str:
            try:
                return create_task(order.kind, order.body, self.timeout)
            except LostError as error:
                lost = error
            task_id = self._lost(pending, order)
            if task_id is None and pending.known is None:
                raise ModelError(f"{lost}; a task may have been made and paid, look at your account before a rerun")
            if task_id is None:
                raise lost
            return task_id

        task = self._persist(create)
        self.calls += 1
        return task

    def _lost(self, held: Pending | None, order: Order) -> str | None:
        """Return the id of a task that was created for this order but whose id did not arrive, if the service lists it."""
        if held is None or held.known is None:
            return None
        new = [task for task in self._tasks(order.kind) or () if task.id not in held.known and order.may_be(task, held.asked)]
        if len(new) > 1 and order.prompt is None:
            ids = ", ".join(task.id for task in new)
            raise ModelError(
                f"meshy: one of the tasks {ids} may be the one that was paid for, and they cannot be told apart; write its "
                f'id as "task" into {order.state}, or remove that file to pay for another'
            )
        return new[0].id if new else None

    def _tasks(self, kind: TaskKind) -> list[Task] | None:
        """Return the latest tasks; None if they cannot be listed."""
        try:
            return self._persist(lambda: list_tasks(kind, self.timeout))
        except ModelError as error:
            if isinstance(error, RefusedError) and error.status in (401, 403):
                raise
            log.warning("%s; tasks cannot be listed, so one whose id is lost cannot be found again", error)
            return None

    def _wait(self, order: Order, task: str) -> Task:
        """Wait until the task has succeeded and return it."""
        end, pause, kind = time.monotonic() + self.patience, 2.0, order.kind
        while True:
            now = self._persist(lambda: self._look(order, task))
            self.watch(kind, now)
            if now.status == "SUCCEEDED":
                return now
            if now.status in OVER:
                order.state.unlink(missing_ok=True)
                again = f"a rerun makes a new one (about {kind.credits} credits)"
                raise ModelError(f"meshy: task {task} is {now.status}{now.error}; {again}")
            if time.monotonic() > end:
                raise ModelError(f"meshy: task {task} is still {now.status} after {self.patience:g} s; a rerun resumes it")
            log.info("meshy: task %s is %s, %d %%", task, now.status, now.progress)
            self.sleep(pause)
            pause = min(30.0, 1.3 * pause)

    def _look(self, order: Order, task: str) -> Task:
        try:
            return get_task(order.kind, task, self.timeout)
        except RefusedError as error:
            if error.status != 404:
                raise
        order.state.unlink(missing_ok=True)
        again = f"a rerun makes a new one (about {order.kind.credits} credits)"
        raise ModelError(f"meshy: the service no longer has task {task}; {again}")

    def _persist(self, call: Callable[[], T]) -> T:
        return persist(call, sleep=self.sleep, chance=self.chance)


def check_prompt(prompt: str) -> str:
    """Return the prompt without surrounding spaces. Raise OptionError if the service does not accept it."""
    text = prompt.strip()
    if not 0 < len(text) <= LONGEST_PROMPT:
        raise OptionError(f"a texture prompt has 1 to {LONGEST_PROMPT} characters, found {len(text)}")
    return text


@dataclass
class Meshy(PaidTasks):
    """Client that retextures a GLB."""

    def retexture(self, glb: bytes, prompt: str) -> bytes:
        """Return the GLB with new textures, on its existing texture coordinates.

        Raise ModelError without a key or a result, BudgetError before a task beyond the limit, OptionError for a prompt that is
        not valid, OutputError if the task's id cannot be stored.
        """
        prompt = check_prompt(prompt)
        read_key()  # report a missing key before packing the data
        order = Order(RETEXTURE, self._body(glb, prompt), self.state, prompt)
        return self.fetch(order, self.run(order).task)

    def _body(self, glb: bytes, prompt: str) -> bytes:
        uri = "data:application/octet-stream;base64," + base64.b64encode(glb).decode("ascii")
        if len(uri) > LARGEST_MODEL:
            raise ModelError(f"meshy: the model takes {len(uri)} bytes to send, at most {LARGEST_MODEL} are accepted")
        asked = {"ai_model": self.model, "enable_original_uv": True, "enable_pbr": True}
        return json.dumps({"model_url": uri, "text_style_prompt": prompt, **asked}).encode()
