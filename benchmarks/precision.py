"""Measure how often written joints are right with `--precision P`, and the weights of articulations.

`python -m benchmarks.precision PLACE... [--work DIR] [--validation N] [--seed S] [--fit] [--markdown FILE]`. A place is a
folder of results of `anymesh eval`, or a data set as it names one, which is evaluated into a folder of DIR first: end to end,
and with its parts given. Results end to end give precision and coverage of the written joints against P, with intervals by a
bootstrap over kinds of objects (95 %), per place and together. Results with parts given say how often the true joint is among
the first articulations, and how far their weights are from that.

--fit fits the numbers of src/anymesh/correcting/calibration.json to half of the kinds, which the seed chooses, writes them, and
reports the other half. Refit them after the classifiers, on what is left out of training.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float
from scipy.optimize import minimize_scalar

from anymesh.correcting.articulations import calibration
from anymesh.correcting.proposals import combined
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.evaluate_sample import EvalProtocol
from anymesh.evaluation.evaluating import evaluate
from anymesh.evaluation.record import SETTINGS, record_of
from anymesh.evaluation.score import FoundJoint
from anymesh.names import legal_name
from anymesh.runtime import usable_cores
from benchmarks import ROOT, made_with, parser_of, table_head, table_row
from training.calibration import Scored, fit_confidence, log_odds
from training.splits import Use, first_of_kinds

NUMBERS = ROOT / "src" / "anymesh" / "correcting" / "calibration.json"
PRECISIONS = (0.0, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
RESAMPLES, INTERVAL = 1000, (2.5, 97.5)  # of the bootstrap; percentiles
BINS = 10  # of probabilities, for the calibration error
FIRST = (1, 2, 3, 5)
MEASURES = ("probability", "part times joint", "lower of the two", "joint alone", "part alone")


@dataclass(frozen=True)
class Place:
    """Results of one place: the joints that were found, the kind of object of each, and the number of true joints per kind."""

    name: str
    joints: tuple[FoundJoint, ...]
    kinds: tuple[str, ...]
    true: Mapping[str, int]

    @classmethod
    def of(cls, folder: Path) -> Place:
        """Read a folder of results; objects that failed count as such without a joint."""
        joints, kinds, true = [], [], dict[str, int]()
        for path in sorted((folder / "objects").glob("*.jsonl")):
            for record in (record_of(line) for line in path.read_text(encoding="utf-8").splitlines()):
                joints += record.score.found
                kinds += [record.category] * len(record.score.found)
                true[record.category] = true.get(record.category, 0) + record.score.true
        return cls(folder.name, tuple(joints), tuple(kinds), true)

    def only(self, kinds: set[str]) -> Place:
        """Return the results of some kinds."""
        kept = [k for k, kind in enumerate(self.kinds) if kind in kinds]
        true = {kind: n for kind, n in self.true.items() if kind in kinds}
        return Place(self.name, tuple(self.joints[k] for k in kept), tuple(self.kinds[k] for k in kept), true)


def together(places: Sequence[Place]) -> Place:
    """Return the results of all places as one; kinds of different places are different."""
    kinds = tuple(f"{p.name}/{kind}" for p in places for kind in p.kinds)
    true = {f"{p.name}/{kind}": n for p in places for kind, n in p.true.items()}
    return Place("together", tuple(j for p in places for j in p.joints), kinds, true)


def probabilities(
    joints: Sequence[FoundJoint], measure: str = MEASURES[0], numbers: Mapping[str, float] | None = None
) -> Float[np.ndarray, " n"]:
    """Return the probability that each joint is right, calibrated with numbers, those in use by default."""
    part, joint = (np.array(v, float) for v in ([j.part_confidence for j in joints], [j.confidence for j in joints]))
    part = np.where(joint == 1, 1.0, part)  # a certain joint says that its part moves
    numbers = calibration() if numbers is None else numbers
    both = np.array([1.0 if j == 1 else combined(p, j, numbers) for p, j in zip(part, joint, strict=True)])
    return dict(zip(MEASURES, (both, part * joint, np.minimum(part, joint), joint, part), strict=True))[measure]


def calibration_error(p: Float[np.ndarray, " n"], right: Bool[np.ndarray, " n"]) -> float:
    """Return the mean distance of probabilities from the share that is right, in bins of a tenth."""
    of = np.minimum((p * BINS).astype(int), BINS - 1)
    return float(sum(abs((p - right)[of == k].sum()) for k in range(BINS)) / max(len(p), 1))


def resampled(place: Place, p: Float[np.ndarray, " n"], seed: int) -> Iterator[tuple[float, float, float]]:
    """Yield precision, share written and share of true joints written right, of all kinds and of resamples of the kinds.

    p: 1 where a joint is written, else 0.
    """
    kinds = sorted(place.true)
    number = np.array([kinds.index(kind) for kind in place.kinds], int)
    right = np.array([j.right for j in place.joints], float)
    counts = np.stack([np.bincount(number, w, len(kinds)) for w in (p * right, p, np.ones(len(p)))], 1)
    counts = np.c_[counts, [place.true[kind] for kind in kinds]]
    rng = np.random.default_rng(seed)
    for k in range(RESAMPLES + 1):
        rows = counts if k == 0 else counts[rng.integers(len(kinds), size=len(kinds))]
        good, written, all_, true = rows.sum(0)
        yield (good / written if written else np.nan), written / max(all_, 1), good / max(true, 1)


def curve(place: Place, seed: int, numbers: Mapping[str, float] | None = None) -> list[str]:
    """Return a table of precision and coverage of written joints against P."""
    lines = table_head(("P", "written of found", "right of written", "written and right of true"))
    p = probabilities(place.joints, numbers=numbers)
    for least in PRECISIONS:
        samples = np.array(list(resampled(place, (p >= least).astype(float), seed)))
        low, high = np.nanpercentile(samples[1:], INTERVAL, axis=0) if np.isfinite(samples[0]).all() else samples[:2]
        cells = [f"{v:.2f} ({a:.2f} to {b:.2f})" for v, a, b in zip(samples[0], low, high, strict=True)]
        lines.append(table_row((f"{least:g}", cells[1], cells[0], cells[2])))
    return lines


def measures(place: Place, numbers: Mapping[str, float] | None = None) -> list[str]:
    """Return a table of what may stand for the probability of a joint: its calibration error, and how well it sorts joints.

    right above wrong: chance that a right joint has a higher one than a wrong joint.
    """
    lines = table_head(("measure", "mean", "right", "calibration error", "right above wrong"))
    right = np.array([j.right for j in place.joints], bool)
    for measure in MEASURES:
        p = probabilities(place.joints, measure, numbers)
        pairs = p[right][:, None] - p[~right]
        sorted_ = ((pairs > 0) + 0.5 * (pairs == 0)).mean() if pairs.size else np.nan
        values = (p.mean(), right.mean(), calibration_error(p, right), sorted_)
        lines.append(table_row((measure, *(f"{v:.2f}" for v in values))))
    return lines


def retempered(joint: FoundJoint, numbers: Mapping[str, float], before: Mapping[str, float]) -> Float[np.ndarray, " k"]:
    """Return the weights of the articulations of a joint with other numbers. before: those with which they were made."""
    weights = np.array(joint.weights)
    if len(weights) < 2:
        return weights
    shares = weights[1:] ** (before["temperature"] / numbers["temperature"])
    return np.r_[weights[0], (1 - weights[0]) * numbers["rest"] * shares / shares.sum()]


def fitted(joints: Sequence[FoundJoint], before: Mapping[str, float]) -> dict[str, float]:
    """Return the temperature and the share of the rest that make the true joints likeliest."""
    known = [j for j in joints if j.true]
    wrong = [j for j in known if j.true_one != 0]
    others = [j for j in wrong if j.true_one and len(j.weights) > 2]

    def loss(log_temperature: float) -> float:
        numbers = {"temperature": float(np.exp(log_temperature)), "rest": 1.0}
        shares = [retempered(j, numbers, before)[1:] for j in others]
        return -float(np.mean([np.log(s[(j.true_one or 0) - 1] / s.sum()) for s, j in zip(shares, others, strict=True)]))

    temperature = (
        float(np.exp(minimize_scalar(loss, bounds=(-2.0, 2.0), method="bounded").x)) if others else before["temperature"]
    )
    rest = sum(j.true_one is not None for j in wrong) / len(wrong) if wrong else before["rest"]
    return {"temperature": round(temperature, 3), "rest": round(rest, 3)}


def weights_table(places: Sequence[Place], numbers: Mapping[str, float], before: Mapping[str, float]) -> list[str]:
    """Return a table of how often the true joint is among the first articulations, and of the error of their weights."""
    lines = table_head(("parts given", "joints", *(f"among first {n}" for n in FIRST), "calibration error", "of the first"))
    for place in places:
        known = [j for j in place.joints if j.true]
        ranks = np.array([np.inf if j.true_one is None else j.true_one for j in known])
        weights = [retempered(j, numbers, before) for j in known]
        right = [np.arange(len(w)) == j.true_one for w, j in zip(weights, known, strict=True)]
        first = calibration_error(np.array([w[0] for w in weights]), np.array([r[0] for r in right]))
        errors = (calibration_error(np.concatenate(weights), np.concatenate(right)), first)
        shares = [float((ranks < n).mean()) for n in FIRST]
        lines.append(table_row((place.name, len(known), *(f"{v:.2f}" for v in (*shares, *errors)))))
    return lines


def half(kinds: Sequence[str], seed: int) -> set[str]:
    """Return half of the kinds, chosen by a seed."""
    order = np.random.default_rng(seed).permutation(sorted(set(kinds)))
    return set(order[: len(order) // 2].tolist())


def folders_of(place: str, work: Path, validation: int = 0) -> Iterator[tuple[str, Path]]:
    """Yield the protocol and the folder of the results of a place; a data set is evaluated first, as `--validation` says."""
    if (Path(place) / SETTINGS).is_file():
        yield json.loads((Path(place) / SETTINGS).read_text(encoding="utf-8"))["protocol"], Path(place)
        return
    only = first_of_kinds(Use.VALIDATION, open_dataset(place).objects(), validation) if validation else []
    for protocol in (EvalProtocol.END_TO_END, EvalProtocol.PARTS):
        folder = work / f"{legal_name(place)}-{protocol}"
        evaluate(place, folder, protocol=protocol, only=only, jobs=usable_cores())
        yield protocol, folder


def fitted_probability(joints: Sequence[FoundJoint]) -> dict[str, float]:
    """Return slope and offset of the log-odds of part times joint that make the joints that are right likeliest."""
    unsure = [j for j in joints if j.confidence < 1]
    odds = log_odds(np.array([j.part_confidence * j.confidence for j in unsure]))
    slope, offset = fit_confidence(Scored(odds, np.array([j.right for j in unsure]), ["one"] * len(unsure)))
    return {"slope": round(max(slope, 0.0), 3), "offset": round(offset, 3)}


def report(results: Mapping[str, Sequence[Place]], seed: int, *, fit: bool) -> str:
    """Return the report on results by protocol, and write the fitted numbers."""
    whole, given = results.get(EvalProtocol.END_TO_END, ()), results.get(EvalProtocol.PARTS, ())
    before, chosen, lines = calibration(), half([kind for p in (*whole, *given) for kind in p.true], seed), []
    numbers = dict(before)
    if fit and whole:
        numbers |= fitted_probability([j for place in whole for j in place.only(chosen).joints])
    if fit and given:
        numbers |= fitted([j for place in given for j in place.only(chosen).joints], before)
    if fit:
        NUMBERS.write_text(json.dumps(numbers) + "\n", encoding="utf-8")
        lines += [f"Fitted to {len(chosen)} kinds, which are left out below: {numbers}; before: {dict(before)}.", ""]
        whole, given = ([place.only(set(place.true) - chosen) for place in some] for some in (whole, given))
    for place in (*whole, *([together(whole)] if len(whole) > 1 else [])):
        count = f"{len(place.joints)} joints found, {sum(place.true.values())} true ones, {len(place.true)} kinds"
        lines += [f"## {place.name}: {count}", "", *curve(place, seed, numbers), "", *measures(place, numbers), ""]
    if given:
        lines += ["## Articulations", "", *weights_table(given, numbers, before), ""]
    return "\n".join(lines)


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("places", nargs="+", metavar="PLACE")
    parser.add_argument("--work", type=Path, default=Path("out/precision"), metavar="DIR")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--validation", type=int, default=0, metavar="N", help="first objects of each kind for validation only")
    parser.add_argument("--fit", action="store_true", help="fit the numbers of the weights to half of the kinds")
    parser.add_argument("--markdown", type=Path, metavar="FILE")
    options: argparse.Namespace = parser.parse_args()
    results: dict[str, list[Place]] = {}
    for place in options.places:
        for protocol, folder in folders_of(place, options.work, options.validation):
            results.setdefault(protocol, []).append(Place.of(folder))
    text = report(results, options.seed, fit=options.fit)
    print(text)
    if options.markdown:
        begin = f"# Precision of written joints, and weights of articulations\n\nMade with {made_with('numpy')}.\n\n"
        options.markdown.write_text(f"{begin}{text}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
