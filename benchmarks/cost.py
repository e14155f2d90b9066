"""What a vision-language model is asked for the shipped examples: calls, tokens, dollars, seconds, cold and from the cache.

python -m benchmarks.cost [--like openai:gpt-4o] [--change fused] [--markdown FILE] [NAME ...]

No model is called: ground truth says the answers through the road of a model (pictures, schema, JSON, checks, cache). Tokens
are estimates by the provider's formula for pictures and 4 letters a token for words; seconds are this program's own.
--change fused takes each object as one surface of about 50,000 faces, as generators make them.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path

from anymesh.evaluation.changes import CHANGES, changed
from anymesh.evaluation.ground_truth import GroundTruth, example_truths, prepared
from anymesh.evaluation.oracle import SimulatedVlm, oracle
from anymesh.export.asset_json import usage
from anymesh.pipeline.solving import Solver
from benchmarks import EXAMPLES

HEAD = """# Cost of a model

`python -m benchmarks.cost --change {change} --markdown FILE`. Answers are the oracle's, so no question is repeated. Tokens
are estimated as `{like}` counts them, dollars by the table in `prompted/models/budget.py`; seconds are those of this program,
without the model: of the first run (wall and processor), and of a second one, which takes every answer from the cache,
without calls or cost.

| object | faces | parts | calls | pictures | tokens in | tokens out | USD | s | processor s | s cached |
|---|---|---|---|---|---|---|---|---|---|---|
"""


def row(truth: GroundTruth, change: str, like: str, cache: Path) -> str:
    sample = changed(change, prepared(truth))
    seconds, busy, exchanges, parts = [], [], [], 0
    for _ in range(2):
        begin, start = time.perf_counter(), time.process_time()
        solver = Solver(sample.mesh, answerer_factory=lambda fallback: SimulatedVlm(oracle(sample), fallback, like, cache))
        recognized = solver.recognize()
        segmented = solver.parts("auto", recognized.recognition)
        jointed = solver.joints(segmented.segmentation, recognized.recognition)
        seconds.append(time.perf_counter() - begin)
        busy.append(time.process_time() - start)
        exchanges.append((*recognized.exchanges, *segmented.exchanges, *jointed.exchanges))
        parts = len(segmented.segmentation.parts) - 1
    cold, again = (usage(e) for e in exchanges)
    if again["cached_calls"] != again["calls"] or again["calls"] != cold["calls"]:
        raise SystemExit(f"{truth.name}: the second run asked anew: {cold}, {again}")
    shown = sum(len(e.pictures) for e in exchanges[0])
    counts = (len(sample.mesh.faces), parts, cold["calls"], shown, cold["input_tokens"], cold["output_tokens"])
    times = (f"{t:.1f}" for t in (seconds[0], busy[0], seconds[1]))
    cells = (truth.name, *map(str, counts), f"{cold['cost_usd']:.3f}", *times)
    return f"| {' | '.join(cells)} |"


def main() -> None:
    parser = argparse.ArgumentParser(description="What a vision-language model is asked for the shipped examples.")
    parser.add_argument("names", nargs="*", help="examples; all when none is named")
    parser.add_argument("--like", default="openai:gpt-4o", help="whose tokens and prices")
    parser.add_argument("--change", default="none", choices=list(CHANGES), help="of each mesh, as in `anymesh eval`")
    parser.add_argument("--markdown", type=Path, help="file to write the table to")
    options = parser.parse_args()
    lines = []
    with tempfile.TemporaryDirectory() as folder:
        for truth in example_truths(EXAMPLES):
            if not options.names or truth.name in options.names:
                lines.append(row(truth, options.change, options.like, Path(folder)))
                print(lines[-1], flush=True)
    if options.markdown:
        options.markdown.write_text(
            HEAD.format(like=options.like, change=options.change) + "\n".join(lines) + "\n", encoding="utf-8"
        )


if __name__ == "__main__":
    main()
