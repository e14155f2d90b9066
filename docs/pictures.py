"""Draw the pictures of README and docs from today's results for the examples.

python docs/pictures.py all                                    all of them, into docs/images (about six minutes on two cores)
python docs/pictures.py method FOLDER [NAME] [--part PART]     those of method.md: patches, candidates, motions and joints
python docs/pictures.py questions FOLDER [NAME] [--all]        a picture per question (as in vlm.md), and questions.txt

Not drawn here: those of reports, which `benchmarks/` writes (noise, worst joints and parts), and those of the applications.
"""

from __future__ import annotations

import argparse
import shutil
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

from anymesh.articulation.candidate_motions import Candidate
from anymesh.articulation.estimate import part_motions
from anymesh.articulation.rank_motions import motion_scores
from anymesh.config import Config
from anymesh.evaluation.ground_truth import example_truths, prepared
from anymesh.evaluation.oracle import SimulatedVlm, oracle
from anymesh.loading import load_mesh, place_mesh
from anymesh.pipeline import articulate
from anymesh.pipeline.solving import Solver
from anymesh.prompted.answerers.answering import pictures_per_call
from anymesh.prompted.motions.offers import MAX_SHOWN_ANGLE_RAD, MAX_SHOWN_TRAVEL_RATIO
from anymesh.prompted.pictures.plates import mark_color
from anymesh.prompted.pictures.sheet import question_sheet
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.prompted.questions.recognition import Recognize
from anymesh.prompted.stages import FEW_PARTS
from anymesh.rendering.render import encode, render
from anymesh.segmentation.contacts import find_contacts
from anymesh.segmentation.part_candidates import PartCandidates, part_candidates
from anymesh.segmentation.part_classifier import score_parts, shipped_classifier
from anymesh.segmentation.segment import assign_parts, examine_candidates
from anymesh.types import Exchange, JointType, Mesh, Picture
from anymesh.viewer.pictures_ import write_picture

USUAL = Config(ask="all")
EXAMPLES = Path(__file__).parents[1] / "examples"
IMAGES = Path(__file__).parent / "images"
SHELF = ("cabinet", "fridge", "laptop", "microwave", "storage_box", "stove", "toy_car", "valve")  # on the first page
PREVIEWS = {
    "microwave.png": "microwave",
    "tutorials/cabinet.png": "cabinet",
    "tutorials/box.png": "storage_box",
    "tutorials/drill.png": "drill",
}
FRONT = 0.0  # azimuth from which the front of every example is seen [deg], which the truth does not state
MOST = 9  # candidates that are drawn
MOTIONS = 7  # motions that are drawn
MOST_PICTURES = pictures_per_call(USUAL)
REGIONS, REGION_PX = 4, 400  # close-ups of regions that are drawn, and the longer side of one


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
    _, _, context, swept = sorted(part_motions(solver.geometry.whole, found), key=lambda m: m[0])[part - 1]
    scores = motion_scores(swept)
    ranked = [(float(scores[k]), swept.candidates[k]) for k in np.argsort(-scores, kind="stable")]
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


def asked(name: str, config: Config = USUAL) -> list[Exchange]:
    """Return what a model is asked about an example, with the answers of one that sees the ground truth."""
    truth = next(t for t in example_truths(EXAMPLES) if t.name == name)
    mesh = place_mesh(load_mesh(truth.mesh)).mesh
    known, most = oracle(prepared(truth)), pictures_per_call(config)
    solver = Solver(mesh, config, lambda fallback: SimulatedVlm(known, fallback, most=most))
    recognized = solver.answers.recognize()
    recognized = replace(recognized, recognition=replace(recognized.recognition, front=FRONT))
    segmented = solver.parts("auto", recognized.recognition)
    jointed = solver.joints(segmented.segmentation, recognized.recognition)
    return [*recognized.exchanges, *segmented.exchanges, *jointed.exchanges]


def draw_questions(folder: Path, name: str, every: bool) -> None:
    """Draw what a model is shown for an example. every: all pictures of each question, not the first."""
    questions = []
    for exchange in asked(name):
        questions.append(f"{exchange.kind} ({len(exchange.pictures)} pictures)\n{exchange.text}\n-> {exchange.answer}\n")
        for k, picture in enumerate(exchange.pictures if every else exchange.pictures[:1], start=1):
            (folder / f"{name}_{exchange.kind}{f'_{k}' if every else ''}.png").write_bytes(picture.png)
    (folder / "questions.txt").write_text("\n".join(questions), encoding="utf-8")


class _SeesAMachine(SimulatedVlm):
    """A reference answerer that calls the object a machine of many parts, which is then asked about region by region."""

    def ask(self, question):
        answer = super().ask(question)
        if not isinstance(question, Recognize):
            return answer
        many = tuple(replace(label, count=FEW_PARTS) for label in answer.labels)
        return replace(answer, machine=True, front=FRONT, labels=many)


def draw_regions(name: str) -> Picture:
    """Return the first close-ups of the regions of an example with many moving parts, on one sheet."""
    truth = next(t for t in example_truths(EXAMPLES) if t.name == name)
    known = oracle(prepared(truth))
    solver = Solver(
        place_mesh(load_mesh(truth.mesh)).mesh, USUAL, lambda fallback: _SeesAMachine(known, fallback, most=MOST_PICTURES)
    )
    regions = solver.answers.recognize().exchanges[-1]
    return question_sheet(regions.pictures[:REGIONS], largest=REGION_PX)


def draw_vlm(folder: Path) -> None:
    """Draw the pictures of vlm.md."""
    first: dict[str, Exchange] = {}
    paper = Config(verify="free")
    for name, config in (("microwave", USUAL), ("microwave", paper), ("sliding_window", paper)):  # which slides along arrows
        for exchange in asked(name, config):
            first.setdefault(exchange.kind, exchange)
    first["sheet"] = asked("microwave", Config(pictures="few"))[0]
    for page, kind, k in (
        ("view", "recognize", 0),
        ("sheet", "sheet", 0),
        ("marks", "marks", 0),
        ("inside", "marks", -2),
        ("kinds", "kinds", 0),
        ("points", "points", 0),
        ("arrows", "arrows", 0),
        ("motions", "motions", 0),
    ):
        (folder / f"{page}.png").write_bytes(first[kind].pictures[k].png)
    (folder / "regions.png").write_bytes(draw_regions("toy_car").png)
    with Image.open(folder / "sheet.png") as sheet:
        sheet.thumbnail((900, 1000))
        sheet.convert("P", palette=Image.Palette.ADAPTIVE).save(folder / "sheet.png")


def draw_tutorials(images: Path) -> None:
    """Draw the film of the first page, the previews, the contact sheet, and the questions of the tutorial with a model."""
    (images / "tutorials").mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as temporary:
        work = Path(temporary)
        for path in sorted((EXAMPLES / "meshes").glob("*.glb")):
            articulate(path, work / "all" / path.stem)
        for name in SHELF:
            shutil.copytree(work / "all" / name, work / "shelf" / name)
        write_picture(work / "shelf", images / "shelf.gif")
        write_picture(work / "all", images / "tutorials" / "sheet.png", columns=7)
        for picture, name in PREVIEWS.items():
            shutil.copyfile(work / "all" / name / "preview.png", images / picture)
    for exchange in asked("laptop"):
        if exchange.kind in ("marks", "motions"):
            (images / "tutorials" / f"{exchange.kind}.png").write_bytes(question_sheet(list(exchange.pictures)).png)


def draw_all(images: Path) -> None:
    draw_tutorials(images)
    draw_method(images / "method", "cabinet", 1)
    draw_vlm(images / "vlm")


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the pictures of README and docs from today's results for the examples.")
    parser.add_argument("what", choices=("all", "method", "questions"))
    parser.add_argument("folder", type=Path, nargs="?", default=IMAGES, help="where the pictures go (default: docs/images)")
    parser.add_argument("name", nargs="?", help="an example; by default cabinet for method, microwave for questions")
    parser.add_argument("--part", type=int, default=1, help="for method: whose motions are drawn")
    parser.add_argument("--all", action="store_true", help="for questions: all pictures of each, not the first")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    if options.what == "all":
        draw_all(options.folder)
    elif options.what == "method":
        draw_method(options.folder, options.name or "cabinet", options.part)
    else:
        draw_questions(options.folder, options.name or "microwave", options.all)


if __name__ == "__main__":
    main()
