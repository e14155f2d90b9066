"""The pictures that a model is shown for one object, for docs/vlm.md.

python -m benchmarks.pictures FOLDER [NAME]        one picture a question, and the texts and answers in questions.txt
"""

from __future__ import annotations

import argparse
from pathlib import Path

from anymesh.evaluation.ground_truth import example_truths
from anymesh.evaluation.oracle import oracle
from anymesh.evaluation.protocols import prepared
from anymesh.evaluation.simulated_vlm import SimulatedVlm
from anymesh.loading import load_mesh, place_mesh
from anymesh.pipeline.solving import Solver

EXAMPLES = Path(__file__).parents[1] / "examples"


def main() -> None:
    parser = argparse.ArgumentParser(description="The pictures that a model is shown for one object.")
    parser.add_argument("folder", type=Path, help="where they go")
    parser.add_argument("name", nargs="?", default="microwave", help="an example")
    parser.add_argument("--all", action="store_true", help="all pictures of each question, not the first")
    options = parser.parse_args()
    truth = next(t for t in example_truths(EXAMPLES) if t.name == options.name)
    placed = place_mesh(load_mesh(truth.mesh))
    solver = Solver(placed.mesh, answerer_factory=lambda instead: SimulatedVlm(oracle(prepared(truth)), instead))
    recognized = solver.recognize()
    segmented = solver.parts("auto", recognized.recognition)
    jointed = solver.joints(segmented.segmentation, recognized.recognition)
    options.folder.mkdir(parents=True, exist_ok=True)
    questions = []
    for exchange in (*recognized.exchanges, *segmented.exchanges, *jointed.exchanges):
        questions.append(f"{exchange.kind} ({len(exchange.pictures)} pictures)\n{exchange.text}\n-> {exchange.answer}\n")
        for k, picture in enumerate(exchange.pictures if options.all else exchange.pictures[:1], start=1):
            (options.folder / f"{options.name}_{exchange.kind}{f'_{k}' if options.all else ''}.png").write_bytes(picture.png)
    (options.folder / "questions.txt").write_text("\n".join(questions), encoding="utf-8")


if __name__ == "__main__":
    main()
