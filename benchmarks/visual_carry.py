"""Carry recorded answers over to motion questions that are asked anew, as after a change of which motions are shown.

python benchmarks/visual_carry.py OLD NEW --place infinigen=DIR ... [--only 001] [--jobs 2]

OLD: a folder of `visual.py ask`, with its check files. NEW gets its questions and answers, but those about motions: these are
asked again, and the motion is chosen that takes the part to where the recorded one took it. What has no such motion, and any
other question without an answer, stays open and is listed. Then `visual.py ask NEW` goes on, and `visual.py keep NEW` keeps.
"""

from __future__ import annotations

import argparse
import json
import shutil
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from visual import PROTOCOLS, Item, ask, items, results_of

from anymesh.evaluation.examine import Protocol
from anymesh.models.question_files import CHECK, QuestionFolder, find_questions
from anymesh.reasoning.files import open_questions
from anymesh.reasoning.prompting import MotionTable, WhichMotions
from anymesh.reasoning.saved_question import unpack_question
from anymesh.types import Motion, MotionKind

KIND = "motions"
ROUNDS = 8  # of questions about one object
NEAR, SAME = 0.15, 0.01  # share of the way, and of the diagonal: motions that keep the part's points this near are one


def tables_of(question: QuestionFolder) -> tuple[MotionTable, ...]:
    """Read the motions that a question shows."""
    asked = unpack_question((question.path / CHECK).read_bytes(), question.pictures())
    assert isinstance(asked, WhichMotions)
    return asked.tables


def chosen_before(folder: Path) -> list[tuple[MotionTable, int, str]]:
    """Return the motions that were chosen in a folder of questions: the table, the number (0: none) and what the part is."""
    found = []
    for question in find_questions(folder):
        if question.kind == KIND and not question.outdated and (text := question.answer()):
            parts = {p["part"]: p for p in json.loads(text)["parts"]}
            for k, table in enumerate(tables_of(question), 1):
                found.append((table, int(parts[k]["motion"]), parts[k].get("part_is", "right")))
    return found


def carry(question: QuestionFolder, before: Sequence[tuple[MotionTable, int, str]]) -> bool:
    """Answer a question about motions as before; return whether every part has its motion."""
    parts = []
    for k, table in enumerate(tables_of(question), 1):
        same = [row for row in before if np.array_equal(row[0].part.faces, table.part.faces)]
        if not same:
            return False
        picked = [(old, number) for old, number, _ in same if number]
        motion = next((n for old, number in picked if (n := same_motion(old, number, table))), 0)
        parts.append({"part": k, "motion": motion, "part_is": same[0][2]})
        if picked and not motion:
            return False
    fit = "part_is" in json.dumps(question.schema)
    kept = parts if fit else [{"part": p["part"], "motion": p["motion"]} for p in parts]
    question.write_answer(json.dumps({"reason": "carried over: moves as the recorded choice", "parts": kept}))
    return True


def same_motion(old: MotionTable, number: int, new: MotionTable) -> int:
    """Return the number of the motion of a table that takes the part to where one of another table took it; 0 for none.

    A turn may go the other way where the first way is not shown.
    """
    points, amount = old.part.points, old.amounts[number - 1]
    goal = _moved(old.motions[number - 1], amount, points)
    way = float(np.linalg.norm(goal - points, axis=1).mean())
    reach = max(NEAR * way, SAME * (old.part.diagonal or 0.0))
    for reverse in (1.0, -1.0):
        off = []
        for motion, shown in zip(new.motions, new.amounts, strict=True):
            alike = motion.kind is old.motions[number - 1].kind and (reverse > 0 or motion.kind is MotionKind.TURN)
            there = _moved(motion, reverse * float(np.sign(shown)) * abs(amount), points)
            off.append(float(np.linalg.norm(there - goal, axis=1).mean()) if alike else np.inf)
        if off and min(off) < reach:
            return int(np.argmin(off)) + 1
    return 0


def _moved(motion: Motion, amount: float, points: np.ndarray) -> np.ndarray:
    T = motion.transform(amount)
    return points @ T[:3, :3].T + T[:3, 3]


def carried(item: Item, old: Path, new: Path) -> list[str]:
    """Carry one object over, both protocols; return a line on each."""
    lines = []
    for protocol, after in zip(PROTOCOLS, (None, Protocol.END_TO_END), strict=True):
        source, place = old / item.number / protocol, new / item.number / protocol
        if not place.exists() and source.exists():
            shutil.copytree(source, place, ignore=shutil.ignore_patterns(f"*-{KIND}"))
        before, state = chosen_before(source), ""
        for _ in range(ROUNDS):
            state = ask(item, protocol, new, wait=False, after=after)
            waiting = [q for q in open_questions(find_questions(place)) if q.kind == KIND]
            if not waiting or not min([carry(q, before) for q in waiting]):
                break
        lines.append(state)
    return lines


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description="Carry recorded answers over to motion questions that are asked anew.")
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("--place", action="append", default=[], metavar="SET=DIR")
    parser.add_argument("--only", action="append", default=[])
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args(argv)
    found = items(dict(p.split("=", 1) for p in options.place), options.only)
    results_of(options.new).mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor(options.jobs, get_context("spawn")) as pool:
        for lines in pool.map(carried, found, [options.old] * len(found), [options.new] * len(found)):
            print("\n".join(lines), flush=True)


if __name__ == "__main__":
    main()
