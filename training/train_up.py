"""Train the classifier of the direction that points up (`anymesh.loading.upright`), and measure it on what was left out.

python -m training.train_up SPEC ...            writes benchmarks/reports/up.md: leave one source out, leave kinds out
python -m training.train_up SPEC ... --write    also trains on all and writes up_classifier.npz with its manifest

SPEC: a data set as for `anymesh eval`, with @NAME to name the source otherwise; its objects stand upright. Each is rotated at
random, so that no axis of the file is up. Needs lightgbm. For the shipped classifier:
    python -m training.kinds KINDS --seed 11 --count 6
    python -m training.train_up urdf:KINDS@kinds labelled:INFINIGEN@infinigen sweethome3d metaworld libero scene-synthesizer \
        mjcf:ROBOSUITE/models/assets/robots@robosuite --write
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float

from anymesh.evaluation.changes import changed
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.loading.upright import Stander, up_candidates, up_features
from training.boosting import Model, Sample, Scores, fit, held_out, leave_kinds_out, leave_sources_out, manifest_of, write
from training.collect_rows import kind_of, open_object

MODELS = tuple(Model(300, seed) for seed in range(2))
SOURCE = 0.5  # power by which the objects of a source count less the more they are
RIGHT = float(np.cos(np.deg2rad(5)))  # a candidate closer than this to the true direction is right
ROOT = Path(__file__).parents[1]
WRITTEN = ROOT / "src" / "anymesh" / "loading" / "up_classifier.npz"


@dataclass(frozen=True, eq=False)
class UpRows:
    """The candidates of one object. cosine: (n,) of the angle to the true direction."""

    source: str
    kind: str
    name: str
    names: tuple[str, ...]
    features: Float[np.ndarray, "n k"]
    cosine: Float[np.ndarray, " n"]


def rows_of(job: tuple[str, str, str]) -> UpRows | None:
    """Return the candidates of one object (data set, source, name), rotated at random; None if it is flat."""
    spec, source, name = job
    sample = changed("spun", open_object(spec, name, ""))
    shape = Stander.of(sample.mesh)
    if shape is None:
        return None
    candidates = up_candidates(shape)
    features = up_features(shape, candidates)
    table = np.array([list(f.values()) for f in features])
    kind = kind_of(name, sample.truth.category)
    return UpRows(source, kind, name, tuple(features[0]), table, candidates @ sample.up)


def samples_of(rows: Sequence[UpRows]) -> list[Sample]:
    """Return the candidates of each object as a sample: the nearest to the true direction is right, if it is near."""
    count = Counter(r.source for r in rows)
    return [Sample(r.source, r.kind, r.features, _target(r).astype(float), count[r.source] ** -SOURCE) for r in rows]


def _target(r: UpRows) -> Bool[np.ndarray, " n"]:
    return (r.cosine == r.cosine.max()) & (r.cosine > RIGHT)


def table(rows: Sequence[UpRows], scores: Scores) -> list[str]:
    """Return lines of a table, one for each source."""
    lines = ["| | objects | offered | right | upside down | on its side |", "|---|---|---|---|---|---|"]
    for source in [*sorted({r.source for r in rows}), "all"]:
        chosen = [k for k, r in enumerate(rows) if source in (r.source, "all")]
        best = np.array([rows[k].cosine[scores[k].argmax()] for k in chosen])
        shares = [np.mean([rows[k].cosine.max() > RIGHT for k in chosen])]
        shares += [np.mean(best > RIGHT), np.mean(best < -RIGHT), np.mean(np.abs(best) < 0.5)]
        lines.append(f"| {source} | {len(chosen)} | {' | '.join(f'{share:.2f}' for share in shares)} |")
    return lines


def right_of(rows: Sequence[UpRows], scores: Scores) -> float:
    """Return the share of objects for which the candidate with the highest score is right."""
    return round(float(np.mean([r.cosine[s.argmax()] > RIGHT for r, s in zip(rows, scores, strict=True)])), 3)


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("specs", nargs="+", metavar="SPEC")
    parser.add_argument("--write", action="store_true", help="train on all and write the classifier")
    options = parser.parse_args(argv)
    jobs = []
    for argument in options.specs:
        spec, _, source = argument.partition("@")
        jobs += [(spec, source or spec.split(":")[0], name) for name in open_dataset(spec).objects()]
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as workers:
        rows = [r for r in workers.map(rows_of, jobs, chunksize=4) if r is not None]
    samples = samples_of(rows)
    by_source = held_out(samples, leave_sources_out(samples), MODELS)
    by_kind = held_out(samples, leave_kinds_out(samples), MODELS)
    lines = [
        "# The direction that points up, on objects that the classifier was not trained on",
        "",
        "`python -m training.train_up`; objects rotated at random, without names. Offered: a candidate is within 5 degrees.",
        "",
        "## Trained on all other sources",
        "",
        *table(rows, by_source),
        "",
        "## Trained on other kinds (4 folds, a kind in one fold)",
        "",
        *table(rows, by_kind),
    ]
    (ROOT / "benchmarks" / "reports" / "up.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    if options.write:
        objects = [(r.source, r.kind, r.name) for r in rows]
        models = [asdict(model) for model in MODELS]
        scores = {"right, kinds left out": right_of(rows, by_kind), "right, sources left out": right_of(rows, by_source)}
        manifest = manifest_of(rows[0].names, objects, models=models, scores=scores)
        write(WRITTEN, manifest, fit(samples, MODELS))


if __name__ == "__main__":
    main()
