"""Draw the pictures of two pages for one of the examples.

python docs/pictures.py method FOLDER [NAME] [--part PART]     method.md: patches, candidates, motions and joints
python docs/pictures.py questions FOLDER [NAME] [--all]        vlm.md: a picture per question, and questions.txt
"""

from __future__ import annotations

import argparse
import shutil
import tempfile
from pathlib import Path

import numpy as np

from anymesh.articulation.candidate_motions import Candidate
from anymesh.articulation.estimate import part_motions
from anymesh.articulation.rank_motions import motion_scores
from anymesh.config import Config
from anymesh.evaluation.ground_truth import example_truths, prepared
from anymesh.evaluation.oracle import SimulatedVlm, oracle
from anymesh.loading import load_mesh, place_mesh
from anymesh.pipeline import articulate
from anymesh.pipeline.solving import Solver
from anymesh.prompted.motions.offers import MAX_SHOWN_ANGLE_RAD, MAX_SHOWN_TRAVEL_RATIO
from anymesh.prompted.pictures.sheet import question_sheet
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.rendering.marks import mark_color
from anymesh.rendering.render import encode, render
from anymesh.segmentation.contacts import find_contacts
from anymesh.segmentation.part_candidates import PartCandidates, part_candidates
from anymesh.segmentation.part_classifier import score_parts, shipped_classifier
from anymesh.segmentation.segment import assign_parts, examine_candidates
from anymesh.types import JointType, Mesh, Picture

EXAMPLES = Path(__file__).parents[1] / "examples"
MOST = 9  # candidates that are drawn
MOTIONS = 7  # motions that are drawn


def patches(studio: VisualPrompts, mesh: Mesh, tree: PartCandidates) -> Picture:
    """Every patch in a colour of its own."""
    color = np.array([mark_color(k) for k in tree.whole.mesh_patch], np.uint8)
    views = [render(mesh, view.camera, face_color=color, scene=studio.scene).color for view in studio.views[:4]]
    return question_sheet([encode(view, f"{len(tree.members[0])} patches") for view in views])


def candidates(studio: VisualPrompts, tree: PartCandidates, score: np.ndarray, chosen: list[int]) -> Picture:
    """The candidates of highest score, each marked, with its probability and whether it was chosen."""
    cards = []
    for k in np.argsort(-score, kind="stable")[:MOST]:
        marked = tree.members[k][tree.whole.mesh_patch].astype(np.int64)
        card = studio.card(marked, 1, f"p = {1 / (1 + np.exp(-score[k])):.2f}{', chosen' if int(k) in chosen else ''}")
        cards.append(card)
    return question_sheet(cards)


def motions(
    studio: VisualPrompts, moving: np.ndarray, ranked: list[tuple[float, Candidate]], scale: float, size: float
) -> Picture:
    """A part at rest and in its likeliest motions, likeliest first."""
    shown = ranked[:MOTIONS]
    amounts = [
        min(c.opening, MAX_SHOWN_ANGLE_RAD)
        if c.motion.kind is JointType.REVOLUTE
        else min(c.opening * scale, MAX_SHOWN_TRAVEL_RATIO * size)
        for _, c in shown
    ]
    title = f"log-odds of 1 and 2: {shown[0][0]:.1f}, {shown[1][0]:.1f}"
    return studio.strip(moving, title, [c.opening_motion for _, c in shown], amounts)


def draw_method(folder: Path, name: str, part: int) -> None:
    """Draw what the geometry answerer does with an example, step by step. part: whose motions are drawn."""
    config, path = Config(), EXAMPLES / "meshes" / f"{name}.glb"
    solver = Solver(place_mesh(load_mesh(path)).mesh, config)
    mesh = solver.geometry.mesh  # straight
    studio = VisualPrompts(mesh, config)
    contacts = find_contacts(solver.geometry.whole)
    tree = part_candidates(mesh, solver.geometry.whole, contacts)
    tree, place, rows = examine_candidates(mesh, tree)
    score, _ = score_parts(tree, place, rows)
    chosen = assign_parts(tree.overlap, shipped_classifier().probability(score))
    found = solver.parts().segmentation
    _, _, context, motions = sorted(part_motions(solver.geometry.whole, found), key=lambda m: m[0])[part - 1]
    scores = motion_scores(motions)
    ranked = [(float(scores[k]), motions.candidates[k]) for k in np.argsort(-scores, kind="stable")]
    drawn = {
        "patches": patches(studio, mesh, tree),
        "candidates": candidates(studio, tree, score, chosen),
        "motions": motions(studio, found.face_part == part, ranked, context.tolerance_length, context.part.box.diagonal),
    }
    for what, picture in drawn.items():
        (folder / f"{what}.png").write_bytes(picture.png)
    with tempfile.TemporaryDirectory() as out:
        articulate(path, Path(out) / "asset")
        shutil.copyfile(Path(out) / "asset" / "preview.png", folder / "joints.png")


def draw_questions(folder: Path, name: str, every: bool) -> None:
    """Draw what a model is shown for an example. every: all pictures of each question, not the first."""
    truth = next(t for t in example_truths(EXAMPLES) if t.name == name)
    mesh = place_mesh(load_mesh(truth.mesh)).mesh
    solver = Solver(mesh, answerer_factory=lambda fallback: SimulatedVlm(oracle(prepared(truth)), fallback))
    recognized = solver.answers.recognize()
    segmented = solver.parts("auto", recognized.recognition)
    jointed = solver.joints(segmented.segmentation, recognized.recognition)
    questions = []
    for exchange in (*recognized.exchanges, *segmented.exchanges, *jointed.exchanges):
        questions.append(f"{exchange.kind} ({len(exchange.pictures)} pictures)\n{exchange.text}\n-> {exchange.answer}\n")
        for k, picture in enumerate(exchange.pictures if every else exchange.pictures[:1], start=1):
            (folder / f"{name}_{exchange.kind}{f'_{k}' if every else ''}.png").write_bytes(picture.png)
    (folder / "questions.txt").write_text("\n".join(questions), encoding="utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the pictures of two pages for one of the examples.")
    parser.add_argument("what", choices=("method", "questions"))
    parser.add_argument("folder", type=Path, help="where the pictures go")
    parser.add_argument("name", nargs="?", help="an example; by default cabinet for method, microwave for questions")
    parser.add_argument("--part", type=int, default=1, help="for method: whose motions are drawn")
    parser.add_argument("--all", action="store_true", help="for questions: all pictures of each, not the first")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    if options.what == "method":
        draw_method(options.folder, options.name or "cabinet", options.part)
    else:
        draw_questions(options.folder, options.name or "microwave", options.all)


if __name__ == "__main__":
    main()
