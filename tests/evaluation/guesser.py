"""Answerer that draws random answers, valid by the schema of each question."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, cast

import numpy as np

from anymesh.prompted.questions.asking import check_schema
from anymesh.prompted.questions.grounding import WhichMarks, WhichViews
from anymesh.prompted.questions.prompting import WhichArrows, WhichKinds, WhichMotions, WhichPoints
from anymesh.prompted.questions.recognition import Recognize
from anymesh.types import Exchange
from anymesh.types.motion import BASE
from anymesh.types.questions import Answer, Question

WORDS = ("door", "lid", "drawer", "knob", "wheel", "handle", "arm", "button")
MAX_KINDS, MAX_PARTS = 4, 6  # maximum number of labels, and of parts in an answer about marks
OWNED = 0.7  # share of the marks that belong to a part
RARE = 0.1  # share of the marks that are unsure, or to be split
Pools = Mapping[str, list[int]]  # allowed values of integers, by name


class Guesser:
    """Answerer that draws random answers from each question's schema and the numbers in its pictures.

    pictured: whether it reads the pictures, so that they are drawn as for a model.
    """

    exchanges: tuple[Exchange, ...] = ()
    warnings: tuple[str, ...] = ()

    def __init__(self, seed: int, *, pictured: bool = False) -> None:
        self.name, self._pictured = f"guesses of seed {seed}", pictured
        self._rng = np.random.default_rng(seed)

    def ask(self, question: Question[Answer]) -> Answer:
        """Return a random answer. Raise BadAnswerError if it is not valid, which is a bug of this class."""
        if self._pictured:
            _ = tuple(question.pictures)
        answer = self._found(question)
        check_schema(answer, question.schema())
        return question.parse(answer)

    def _found(self, question: Question[Any]) -> dict[str, Any]:
        schema = question.schema()
        match question:
            case Recognize():
                return self._recognition(question)
            case WhichViews():
                views = list(range(1, len(question.faces) + 1))
                rows = [{"label": label, "views": self._some(views, 0.6)} for label in question.labels]
                return self._drawn(schema, {}) | {"parts": rows}
            case WhichMarks():
                return self._drawn(schema, {}) | self._marks(question)
            case WhichKinds():
                pools: list[Pools] = [{} for _ in question.parts]
            case WhichPoints():
                pools = [{"points": self._points(t.min_points, t.max_points, len(t.points))} for t in question.tables]
            case WhichArrows():
                pools = [{"arrow": list(range(1, len(t.directions) + 1))} for t in question.tables]
            case WhichMotions():
                pools = [{"motion": list(range(len(t.motions) + 1))} for t in question.tables]
            case _:
                raise TypeError(f"no way to guess {type(question).__name__}")
        row = schema["properties"]["parts"]["items"]
        return self._drawn(schema, {}) | {
            "parts": [self._drawn(row, {"part": [k], **own}) for k, own in enumerate(pools, start=1)]
        }

    def _drawn(self, schema: Mapping[str, Any], pools: Pools, name: str = "") -> Any:
        """Draw a value that satisfies a schema. pools: values for an integer, or the whole value of a list of integers."""
        kind, rng = schema["type"], self._rng
        if kind == "object":
            return {key: self._drawn(part, pools, key) for key, part in schema["properties"].items()}
        if kind == "array":
            return list(pools.get(name, []))
        if kind == "integer":
            return int(rng.choice(pools.get(name, [0])))
        if kind == "number":
            return float(rng.uniform(-1, 1))
        if kind == "boolean":
            return bool(rng.random() < 0.5)
        return str(rng.choice(schema["enum"])) if "enum" in schema else "a guess"

    def _some(self, items: list[int], share: float) -> list[int]:
        return [n for n in items if self._rng.random() < share]

    def _points(self, least: int, most: int, count: int) -> list[int]:
        many = int(self._rng.integers(least, min(most, count) + 1))
        return [int(n) + 1 for n in self._rng.choice(count, many, replace=False)]

    def _recognition(self, question: Recognize) -> dict[str, Any]:
        rng = self._rng
        labels = [str(w) for w in rng.choice(WORDS, int(rng.integers(1, MAX_KINDS + 1)), replace=False)]
        row = question.schema()["properties"]["parts"]["items"]
        parts = []
        for k, label in enumerate(labels):
            drawn = {"label": label, "parent": str(rng.choice([BASE, *labels[: k + 1]]))}
            limits = {"lower": -float(rng.integers(0, 30)), "upper": float(rng.integers(1, 180))}
            part = cast(dict[str, Any], self._drawn(row, {})) | drawn | limits
            parts.append(part | {"lower": 0.0, "upper": 0.0} if part["moves"] == "continuous" else part)
        size = float(10 ** rng.uniform(-1.5, 0.7))
        front = int(rng.integers(0, len(question.azimuths) + 1))
        return self._drawn(question.schema(), {}) | {
            "category": "thing", "longest_side_m": size, "front": front, "parts": parts
        }  # fmt: skip

    def _marks(self, question: WhichMarks) -> dict[str, Any]:
        regions = question.regions
        present = [np.unique(r[r >= 0]) for r in regions]
        every = [int(n) for n in np.unique(np.concatenate([np.zeros(0, int), *present]))]
        parts = []
        for view, marks in enumerate([every] if question.consistent else present, start=1):
            owner = self._rng.integers(0, MAX_PARTS, len(marks))
            owner[self._rng.random(len(marks)) > OWNED] = -1
            for k in range(MAX_PARTS):
                at = {} if question.consistent else {"view": view}
                own = [int(n) for n in np.asarray(marks)[owner == k]]
                parts.append({"label": question.labels[k % len(question.labels)], "instance": k + 1, **at, "marks": own})
        split = {"split": self._some(every, RARE)} if question.splittable else {}
        return {"parts": parts, "unsure": self._some(every, RARE), **split}
