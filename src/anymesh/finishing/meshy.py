"""Paid tasks of Meshy, created once, waited for and resumed by a rerun; retexturing is one of them."""

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
    read_key,
)
from anymesh.finishing.web import LostError
from anymesh.prompted.models.retry import persist
from anymesh.runtime import read_json, write_whole
from anymesh.types import Brief

log = logging.getLogger("anymesh")
T = TypeVar("T")
OVER = ("FAILED", "EXPIRED", "CANCELED", "CANCELLED")
LONGEST_PROMPT = 600  # characters
LARGEST_MODEL = 100_000_000  # [bytes] of a model sent as a data URI


@dataclass(frozen=True)
class Bought:
    """Finished paid task. credits: that it took; seed: drawn by the service, None if not stated."""

    task: str
    credits: float
    seed: int | None = None


@dataclass(frozen=True)
class Started:
    """Paid task as its state file has it. task: its id; bought: once it has succeeded."""

    task: str
    bought: Bought | None = None


@dataclass(frozen=True)
class Order(Brief):
    """Task to be paid for once. body: of the request, JSON; state: the file that stores the task's id."""

    kind: TaskKind
    body: bytes = field(repr=False)
    state: Path

    @property
    def digest(self) -> str:
        """SHA-256 of the request."""
        return hashlib.sha256(self.body).hexdigest()

    def started(self) -> Started | None:
        """Read the task of an earlier run; None if the file is about another request, is missing or cannot be read."""
        held = read_json(self.state) or {}
        task, bought = held.get("task"), held.get("bought")
        if held.get("request") != self.digest or not (isinstance(task, str) and TASK_ID.fullmatch(task)):
            return None
        if not isinstance(bought, dict) or not isinstance(bought.get("credits"), int | float):
            return Started(task)
        seed = bought.get("seed")
        return Started(task, Bought(task, float(bought["credits"]), seed if isinstance(seed, int) else None))

    def store(self, task: str | None, bought: Bought | None = None) -> None:
        """Write the state; task: None before it is created.

        Raise OutputError if that fails, so that no task is bought that a rerun could not find.
        """
        record = {"request": self.digest, "task": task, "bought": None if bought is None else asdict(bought)}
        try:
            self.state.parent.mkdir(parents=True, exist_ok=True)
            write_whole(self.state, (json.dumps(record, indent=1) + "\n").encode())
        except OSError as error:
            raise OutputError(f"the state of a paid task cannot be kept in {self.state}: {error.strerror}") from None

    def forget(self) -> str:
        """Delete the state of a task that is of no more use, and say what a rerun does."""
        self.state.unlink(missing_ok=True)
        return f"a rerun makes a new one (about {self.kind.credits} credits)"


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

    def run(self, order: Order) -> Bought:
        """Return the finished task of an order: that of an earlier run, or else a new one.

        Raise ModelError without a key or a result, BudgetError before a task beyond the limit, OutputError if the id of the
        task cannot be stored.
        """
        held = order.started()
        if held is not None:
            task = held.task
            log.info("meshy: resuming task %s", task)
        else:
            task = self._create(order)
            order.store(task)
        finished = self._wait(order, task)
        self.credits += finished.credits if held is None else 0.0
        bought = Bought(task, finished.credits, finished.seed)
        order.store(task, bought)
        return bought

    def fetch(self, order: Order, task: str) -> bytes:
        """Download the GLB of a finished task. Its signed address expires, so it is requested each time."""

        def fetch() -> bytes:
            url = self.look(order, task).url
            if url is None:
                raise ModelError(f"meshy: task {task} succeeded without a GLB")
            return download_glb(url, 10 * self.timeout)

        return self._persist(fetch)

    def look(self, order: Order, task: str) -> Task:
        """Return the state of a task. Raise ModelError, and forget the task, if the service no longer has it."""
        try:
            return get_task(order.kind, task, self.timeout)
        except RefusedError as error:
            if error.status != 404:
                raise
        raise ModelError(f"meshy: the service no longer has task {task}; {order.forget()}")

    def check_budget(self, *kinds: TaskKind) -> None:
        """Raise BudgetError if paying for a task of each kind would exceed the limit."""
        if self.max_calls is None or self.calls + len(kinds) <= self.max_calls:
            return
        credits = sum(kind.credits for kind in kinds)
        what = f"{kinds[0].name} takes" if len(kinds) == 1 else f"{' and '.join(kind.name for kind in kinds)} take"
        spent = f"spent so far: {self.calls} tasks, {self.credits:g} credits"
        raise BudgetError(f"meshy: {what} about {credits} credits and would exceed --max-calls {self.max_calls}; {spent}")

    def _create(self, order: Order) -> str:
        """Create a task and return its id."""
        self.check_budget(order.kind)
        order.store(None)  # fail before the payment if the id could not be stored after it

        def create() -> str:
            try:
                return create_task(order.kind, order.body, self.timeout)
            except LostError as error:
                lost = error
            raise ModelError(  # another attempt might pay twice
                f"{lost}; a task may have been made and paid: look at your account before a rerun, which makes another one "
                f'unless you write its id as "task" into {order.state}'
            )

        task = self._persist(create)
        self.calls += 1
        return task

    def _wait(self, order: Order, task: str) -> Task:
        """Wait until the task has succeeded and return it."""
        end, pause = time.monotonic() + self.patience, 2.0
        while True:
            now = self._persist(lambda: self.look(order, task))
            self.watch(order.kind, now)
            if now.status == "SUCCEEDED":
                return now
            if now.status in OVER:
                raise ModelError(f"meshy: task {task} is {now.status}{now.error}; {order.forget()}")
            if time.monotonic() > end:
                raise ModelError(f"meshy: task {task} is still {now.status} after {self.patience:g} s; a rerun resumes it")
            log.info("meshy: task %s is %s, %d %%", task, now.status, now.progress)
            self.sleep(pause)
            pause = min(30.0, 1.3 * pause)

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
        order = Order(RETEXTURE, self._body(glb, prompt), self.state)
        return self.fetch(order, self.run(order).task)

    def _body(self, glb: bytes, prompt: str) -> bytes:
        uri = "data:application/octet-stream;base64," + base64.b64encode(glb).decode("ascii")
        if len(uri) > LARGEST_MODEL:
            raise ModelError(f"meshy: the model takes {len(uri)} bytes to send, at most {LARGEST_MODEL} are accepted")
        asked = {"ai_model": self.model, "enable_original_uv": True, "enable_pbr": True}
        return json.dumps({"model_url": uri, "text_style_prompt": prompt, **asked}).encode()
