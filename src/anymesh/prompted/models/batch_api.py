"""Answers to the open questions of many objects by a provider's batch API: sent as one job, collected later."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from anymesh.errors import BudgetError, OptionError, OutputError
from anymesh.prompted.answerers.answers import open_in
from anymesh.prompted.answerers.file_answerer import open_questions
from anymesh.prompted.answerers.question_files import QuestionFolder, find_questions, read_question
from anymesh.prompted.models.prices import cost_of, max_input_tokens
from anymesh.prompted.models.vision import Request
from anymesh.runtime import read_json, write_whole

NOTE = "batch.json"  # in the folder of questions: the job that was sent
SHARE = 0.5  # of the price of single calls


@dataclass(frozen=True)
class BatchState:
    """Result of a call. state: sent, waiting or collected; count: questions in the job; answered, refused: of those."""

    state: str
    count: int
    answered: int = 0
    refused: tuple[str, ...] = ()

    def words(self) -> str:
        """Return the message for the user."""
        match self.state:
            case "sent":
                return f"sent {self.count} questions as one job; the same command collects the answers when it is done"
            case "waiting":
                return f"the job of {self.count} questions is not done yet; run the same command again later"
            case _:
                refusals = "".join(f"\n  {line}" for line in self.refused)
                counts = f"collected {self.answered} valid answers to {self.count} questions"
                return f"{counts}; run the command that asked again to resume{refusals}"


def answer_by_batch(folder: Path, model: str, *, max_cost: float | None = None) -> BatchState:
    """Collect the job that was sent from a folder of questions, or send its open questions as a job.

    Raise OptionError if no question is open, BudgetError if the job may cost more than max_cost [USD], ModelError if the
    provider fails.
    """
    from anymesh.prompted.models.pydantic_ai_ import connect
    from anymesh.prompted.models.pydantic_ai_batch_ import collect_batch, submit_batch

    note = read_json(folder / NOTE)
    if note is not None:
        if not {"model", "jobs", "questions"} <= set(note):
            raise OutputError(f"{folder / NOTE} is not the record of a job; remove it to send the questions again")
        if note.get("model") != model:
            raise OptionError(f"{folder} waits for a job of {note.get('model')}; collect it first, or remove {NOTE}")
        places = {name: folder / place for name, place in note["questions"].items()}
        asked = {name: q for name, path in places.items() if (q := read_question(path)) is not None}
        answers = collect_batch(connect(model), note["jobs"], {name: _request(q) for name, q in asked.items()})
        if answers is None:
            return BatchState("waiting", len(places))
        state = _write(asked, answers)
        (folder / NOTE).unlink()
        return state
    waiting = open_in(folder)
    if not waiting:
        raise OptionError(f"no question is open in {folder}")
    requests = {q.key[:40]: _request(q) for q in waiting}
    _check_cost(model, requests, max_cost)
    if not folder.is_dir():
        raise OutputError(f"{folder} is not a folder")
    jobs = submit_batch(connect(model), requests)
    places = {q.key[:40]: str(q.path.relative_to(folder)) for q in waiting}
    write_whole(folder / NOTE, json.dumps({"model": model, "jobs": jobs, "questions": places}, indent=1).encode())
    return BatchState("sent", len(requests))


def _request(question: QuestionFolder) -> Request:
    """Return the request of a question, with the reason if an earlier answer was refused."""
    record, refusal, last = question.record, question.refusal(), question.answer()
    why = "" if refusal is None else f"\n\nAn earlier answer to this was not valid: {last}\n{refusal}"
    return Request(question.kind, str(record["system"]), f"{record['text']}{why}", question.pictures(), question.schema)


def _check_cost(model: str, requests: Mapping[str, Request], max_cost: float | None) -> None:
    if max_cost is None:
        return
    costs = [cost_of(model, max_input_tokens(model, r), r.max_tokens) for r in requests.values()]
    known = [cost for cost in costs if cost is not None]
    if len(known) < len(costs):
        raise OptionError(f"--max-cost needs a known price, and that of {model} is not")
    if SHARE * sum(known) > max_cost:
        raise BudgetError(f"the job may cost up to {SHARE * sum(known):.4f} USD, which could exceed --max-cost {max_cost:g}")


def _write(asked: Mapping[str, QuestionFolder], answers: Mapping[str, Any]) -> BatchState:
    """Write the answers without replacing later ones; invalid ones stay open."""
    notes = []
    for name, question in asked.items():
        if question.answer() is not None and question.refusal() is None:
            continue
        if answers[name].text is None:
            notes.append(f"{question.path}: {answers[name].note}")
        else:
            question.write_answer(answers[name].text)
    left = open_questions([q for path in asked.values() for q in find_questions(path.path)])
    notes += [f"{q.path}: refused, {q.path / 'refused.md'} says why" for q in left if q.refusal() is not None]
    return BatchState("collected", len(asked), len(asked) - len(left), tuple(notes))
