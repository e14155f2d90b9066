"""How far the answers of a model can be trusted: by a probe of it, if there was one, else as usual.

A probe asks questions with known answers (`prompted.probe`). Its counts are kept for each model, and are settings of its runs.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int

from anymesh.runtime import cache_folder, write_whole
from anymesh.types import Brief

RELIABILITIES = (0.97, 0.9, 0.7, 0.4, 0.1)
SHARES = (0.55, 0.27, 0.1, 0.05, 0.03)  # of answerers with each reliability, before any of their answers is known
MARKS, PRIOR_MARKS = "marks", 10.0  # number of marked parts that the usual confidence in them counts for; an estimate
# which of the four answers that are weighed each kind of question gives: kind of joint, recognized motion, line, picked motion
WEIGHED = {"kinds": 0, "recognize": 1, "points": 2, "arrows": 2, "motions": 3}
FORMAT = "anymesh-probe-1"  # changes with the questions of the probe
Z95 = 1.96  # of an interval that holds with a probability of .95
ProbeCount = tuple[str, int, int, float]  # kind of question, right answers, answers, probability to guess one rightly


@dataclass(frozen=True, eq=False)
class Trust(Brief):
    """Reliabilities that an answerer may have in the four answers that are weighed, and how likely each combination is.

    grid: the reliabilities; levels: indices into them; weights: logarithms of probabilities.
    """

    grid: Float[np.ndarray, " r"]
    levels: Int[np.ndarray, "n 4"]
    weights: Float[np.ndarray, " n"]


def trust(probed: Iterable[ProbeCount] = ()) -> Trust:
    """Return how far answers are trusted before any is known.

    Without a probe, an answerer is as reliable in one answer as in the others. With one, each has a reliability of its own.
    """
    grid, usual = np.array(RELIABILITIES), np.log(SHARES)
    counts = [count for count in probed if count[0] in WEIGHED]
    if not counts:
        return Trust(grid, np.repeat(np.arange(len(grid))[:, None], 4, 1), usual)
    own = np.repeat(usual[None], 4, 0)
    for question, right, asked, chance in counts:
        likely = grid + (1 - grid) * chance
        own[WEIGHED[question]] += right * np.log(likely) + (asked - right) * np.log(1 - likely)
    own -= np.logaddexp.reduce(own, axis=1)[:, None]
    levels = np.indices((len(grid),) * 4).reshape(4, -1)
    return Trust(grid, levels.T, own[np.arange(4)[:, None], levels].sum(0))


def given_answer(right: Float[np.ndarray, " n"], reliability: float, choices: int) -> Float[np.ndarray, " n"]:
    """Return the probability of an answer. right: of a reliable answerer; choices: number of possible answers."""
    return reliability * right + (1 - reliability) / choices


def confidence_in_marks(usual: float, probed: Iterable[ProbeCount]) -> float:
    """Return the confidence in a part that was marked. usual: without a probe."""
    right, asked = next(((r, n) for question, r, n, _ in probed if question == MARKS), (0, 0))
    return usual * (PRIOR_MARKS + right / usual) / (PRIOR_MARKS + asked) if asked else usual


def interval(right: int, asked: int) -> tuple[float, float]:
    """Return Wilson's 95 % interval of a share (Wilson 1927), 0 to 1 if nothing was asked."""
    if not asked:
        return 0.0, 1.0
    share, n = right / asked, asked
    middle, half = share + Z95**2 / (2 * n), Z95 * math.sqrt(share * (1 - share) / n + Z95**2 / (4 * n**2))
    low, high = ((middle + side * half) / (1 + Z95**2 / n) for side in (-1, 1))
    return max(low, 0.0), min(high, 1.0)


def in_words(probed: Iterable[ProbeCount], *questions: str) -> str:
    """Return what a probe found about some kinds of question, in words, "" for nothing."""
    told = [f"{right} of {asked} {question}" for question, right, asked, _ in probed if question in questions]
    return f" (its probe: {', '.join(told)} right)" if told else ""


def keep_probe(model: str, pictures: str, counts: Iterable[ProbeCount]) -> Path:
    """Write the result of a probe to the user's cache folder. Raise OSError if that cannot be written."""
    path = _path(model, pictures)
    path.parent.mkdir(parents=True, exist_ok=True)
    record = {"format": FORMAT, "model": model, "pictures": pictures, "counts": [list(count) for count in counts]}
    write_whole(path, json.dumps(record, indent=1).encode())
    return path


def kept_probe(model: str, pictures: str) -> tuple[ProbeCount, ...]:
    """Return the result of the last probe of a model; () if there is none that can be read."""
    try:
        record = json.loads(_path(model, pictures).read_bytes())
        counts = tuple((str(q), int(right), int(asked), float(chance)) for q, right, asked, chance in record["counts"])
        known = (record["format"], record["model"], record["pictures"]) == (FORMAT, model, pictures)
        known = known and all(0 <= right <= asked <= 1000 and 0 <= chance < 1 for _, right, asked, chance in counts)
    except (OSError, ValueError, LookupError, TypeError, RecursionError):
        return ()
    return counts if known else ()


def _path(model: str, pictures: str) -> Path:
    return cache_folder("probes") / f"{hashlib.sha256(f'{model} {pictures}'.encode()).hexdigest()[:32]}.json"
