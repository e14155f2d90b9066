"""Retexturing by Meshy: a paid task is made once, waited for, and found again by a rerun."""

from __future__ import annotations

import base64
import hashlib
import json
import logging
import random
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

from anymesh.errors import BudgetError, ModelError, OptionError
from anymesh.models.meshy_api import CREDITS, RefusedError, Task, create_task, download_glb, get_task, list_tasks, read_key
from anymesh.models.meshy_task import Pending, read_pending, write_pending
from anymesh.models.retry import persist
from anymesh.models.web import LostError

log = logging.getLogger("anymesh")
T = TypeVar("T")
LONGEST_PROMPT = 600  # characters
LARGEST_MODEL = 100_000_000  # [bytes] of a model sent as a data URI
OVER = ("FAILED", "EXPIRED", "CANCELED", "CANCELLED")


def check_prompt(prompt: str) -> str:
    """Without spaces around it. Raises OptionError for one that the service does not take."""
    found = prompt.strip()
    if not 0 < len(found) <= LONGEST_PROMPT:
        raise OptionError(f"a texture prompt has 1 to {LONGEST_PROMPT} characters, found {len(found)}")
    return found


@dataclass
class Meshy:
    """Retextures a GLB. Holds no key: it is taken from MESHY_API_KEY at each call.

    state: the file that keeps the task's id; max_calls: tasks that may be paid for; timeout [s] of one call (of a download
    ten times that), patience [s] for a task. `calls` and `credits` are what was spent.
    """

    state: Path
    model: str = "latest"
    max_calls: int | None = None
    timeout: float = 60.0
    patience: float = 3600.0  # the service asks to allow an hour
    sleep: Callable[[float], None] = field(default=time.sleep, repr=False)
    chance: Callable[[], float] = field(default=random.random, repr=False)
    name: str = field(default="meshy", init=False)
    calls: int = field(default=0, init=False)
    credits: float = field(default=0.0, init=False)

    def __post_init__(self) -> None:
        if self.max_calls is not None and self.max_calls < 0:
            raise OptionError(f"--max-calls must be 0 or more, found {self.max_calls}")
        if not (self.timeout > 0 and self.patience > 0):
            raise OptionError(f"time-outs must be more than 0 s, found {self.timeout:g} and {self.patience:g}")

    def retexture(self, glb: bytes, prompt: str) -> bytes:
        """The GLB with new textures, on the texture coordinates that it has.

        Raises ModelError without a key or a result, BudgetError instead of a task too many, OptionError for a prompt that
        is not valid, OutputError where the task's id cannot be kept.
        """
        prompt = check_prompt(prompt)
        read_key()  # better missed now than after the packing
        body = self._body(glb, prompt)
        digest = hashlib.sha256(body).hexdigest()
        held = read_pending(self.state, digest)
        task = held.task if held else None
        bought = self.calls
        if task is None:
            task = self._lost(held, prompt) or self._create(body, digest, prompt)
            write_pending(self.state, Pending(digest, task))
        else:
            log.info("meshy: going on with task %s", task)
        took = self._wait(task).credits
        self.credits += took if self.calls > bought else 0.0
        return self._persist(lambda: self._fetch(task))

    def _body(self, glb: bytes, prompt: str) -> bytes:
        uri = "data:application/octet-stream;base64," + base64.b64encode(glb).decode("ascii")
        if len(uri) > LARGEST_MODEL:
            raise ModelError(f"meshy: the model takes {len(uri)} bytes to send, at most {LARGEST_MODEL} are taken")
        asked = {"ai_model": self.model, "enable_original_uv": True, "enable_pbr": True}
        return json.dumps({"model_url": uri, "text_style_prompt": prompt, **asked}).encode()

    def _create(self, body: bytes, digest: str, prompt: str) -> str:
        """The id of a new task. One whose id never arrived is looked for before another is made."""
        if self.max_calls is not None and self.calls >= self.max_calls:
            spent = f"spent so far: {self.calls} tasks, {self.credits:g} credits"
            raise BudgetError(
                f"meshy: a task takes about {CREDITS} credits and would pass --max-calls {self.max_calls}; {spent}"
            )
        before = self._tasks()
        pending = Pending(digest, None, None if before is None else tuple(task.id for task in before))
        write_pending(self.state, pending)

        def create() -> str:
            try:
                return create_task(body, self.timeout)
            except LostError as error:
                lost = error
            found = self._lost(pending, prompt)
            if found is None and pending.known is None:
                raise ModelError(f"{lost}; a task may have been made and paid, look at your account before a rerun")
            if found is None:
                raise lost
            return found

        task = self._persist(create)
        self.calls += 1
        return task

    def _lost(self, held: Pending | None, prompt: str) -> str | None:
        """The task that was made for this request though its id never arrived, as far as the service lists it."""
        if held is None or held.known is None:
            return None
        new = [task.id for task in self._tasks() or () if task.id not in held.known and task.prompt == prompt]
        return new[0] if new else None

    def _tasks(self) -> list[Task] | None:
        """The latest tasks; None where they cannot be listed."""
        try:
            return self._persist(lambda: list_tasks(self.timeout))
        except ModelError as error:
            if isinstance(error, RefusedError) and error.status in (401, 403):
                raise
            log.warning("%s; tasks cannot be listed, so one whose id is lost cannot be found again", error)
            return None

    def _wait(self, task: str) -> Task:
        """The task when it has succeeded."""
        end, pause = time.monotonic() + self.patience, 2.0
        while True:
            now = self._persist(lambda: self._look(task))
            if now.status == "SUCCEEDED":
                return now
            if now.status in OVER:
                self.state.unlink(missing_ok=True)
                raise ModelError(
                    f"meshy: task {task} is {now.status}{now.error}; a rerun makes a new one (about {CREDITS} credits)"
                )
            if time.monotonic() > end:
                raise ModelError(f"meshy: task {task} is still {now.status} after {self.patience:g} s; a rerun goes on with it")
            log.info("meshy: task %s is %s, %d %%", task, now.status, now.progress)
            self.sleep(pause)
            pause = min(30.0, 1.3 * pause)

    def _look(self, task: str) -> Task:
        try:
            return get_task(task, self.timeout)
        except RefusedError as error:
            if error.status != 404:
                raise
        self.state.unlink(missing_ok=True)
        raise ModelError(f"meshy: the service knows no task {task} any more; a rerun makes a new one (about {CREDITS} credits)")

    def _fetch(self, task: str) -> bytes:
        """The address is asked for each time: it is signed, and valid for a while only."""
        url = self._look(task).url
        if url is None:
            raise ModelError(f"meshy: task {task} succeeded and names no GLB")
        return download_glb(url, 10 * self.timeout)

    def _persist(self, call: Callable[[], T]) -> T:
        return persist(call, sleep=self.sleep, chance=self.chance)
