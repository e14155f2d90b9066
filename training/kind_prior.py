"""Measure what the moving parts of an object's kind add to the choice of parts and motions.

python -m training.kind_prior FOLDER ROWS [--motions]

FOLDER: objects named KIND__NUMBER as `labelled:FOLDER` of `anymesh eval` reads them, with names of links; ROWS: candidates for
parts of these, or of some, as `training/part_rows.py` writes them; --motions: also those of parts given, in seconds for
each object.

The table is made of half of the objects of each kind, without LEFT_OUT kinds. The others are measured: half of their kinds, on
which the weights were chosen, the other half, and the kinds left out, which are known through names of others or not at all.
"""

from __future__ import annotations

import argparse
import random
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from anymesh.articulation.estimate import part_motions
from anymesh.articulation.rank_motions import rank_motions
from anymesh.kinds.moving_parts import PartTable
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.part_classifier import combined, is_cut, relations, shipped_classifier
from anymesh.segmentation.segment import assign_parts, conflicts, with_copies
from training.collect_rows import open_object
from training.kind_parts import ABOUT, MECHANISMS, RECORD, read_object, table
from training.motion_rows import how_right
from training.part_rows import PartRows, read_rows
from training.part_scores import Counts, overlap_of, scored

SEED, LEFT_OUT = 74, 30  # kinds, as in the training of classifiers
NAMES: dict[str, Callable[[str], str]] = {  # what is known of an object, from the name of its kind
    "no name": lambda kind: "",
    "kind": lambda kind: ABOUT.split(kind)[0],
    "last two words": lambda kind: "_".join(ABOUT.split(kind)[0].split("_")[-2:]),
}


def divided(names: Sequence[str]) -> tuple[list[str], dict[str, list[str]]]:
    """Return the objects of the table, and those that are measured, by group."""
    kinds = sorted({kind_of(name) for name in names})
    left, rng = set(random.Random(SEED).sample(kinds, LEFT_OUT)), random.Random(1)
    counted, others = list[str](), dict[str, list[str]]()
    for kind in kinds:
        mine = [name for name in names if kind_of(name) == kind]
        rng.shuffle(mine)
        if kind in left:
            continue
        half = (len(mine) + 1) // 2
        counted += mine[:half]
        others |= {kind: mine[half:]} if mine[half:] else {}
    order = sorted(others)
    rng.shuffle(order)
    chosen = set(order[: len(order) // 2])
    groups = {
        "kinds that weights were chosen on": [n for kind, some in others.items() if kind in chosen for n in some],
        "other kinds": [n for kind, some in others.items() if kind not in chosen for n in some],
        "kinds left out": [n for n in names if kind_of(n) in left],
    }
    return counted, {what: [n for n in some if not MECHANISMS.search(kind_of(n))] for what, some in groups.items()}


def kind_of(name: str) -> str:
    return name.split("__")[0]


def found_parts(rows: PartRows, parts: PartTable, text: str) -> Counts:
    """Return how many parts of an object are found."""
    classifier, overlap = shipped_classifier(), overlap_of(rows)
    pairs = relations(overlap, rows.members, rows.contact, rows.near, rows.place)
    networks = classifier.score_together(rows.features, rows.place, pairs)
    score = combined(classifier.score(rows.features), networks, is_cut(rows.features, rows.names))
    usual = parts.find(text)
    score = score if usual is None else usual.part_scores(score, rows.place.astype(float), conflicts(overlap))
    chance = classifier.probability(score)
    return scored(rows, with_copies(overlap, assign_parts(overlap, chance), chance))


def right_motions(folder: Path, name: str, parts: PartTable) -> dict[str, list[bool]]:
    """Return whether the motion of each part of an object is right, if its parts are given."""
    sample = open_object(f"labelled:{folder}", name, "")
    whole = object_shape(sample.mesh, labels=sample.labels)
    joints = {j.child: sample.joint(j) for j in sample.truth.joints}
    right: dict[str, list[bool]] = {how: [] for how in NAMES}
    for i, _, context, motions in part_motions(whole, sample.segmentation()):
        joint = joints.get(sample.truth.parts[i].name)
        if joint is None:
            continue
        center = sample.mesh.triangles[sample.labels == i].reshape(-1, 3).mean(0)
        for how, name_of in NAMES.items():
            usual = parts.find(name_of(kind_of(name)))
            offered = motions if usual is None else usual.motions(context, motions)
            best = offered.candidates[rank_motions(offered).ranking[0]]
            right[how].append(how_right(joint, best.motion, center, sample.unit) > 0)
    return right


def f1(found: Iterable[Counts]) -> float:
    return sum(found, Counts()).f1


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description="Measure what the moving parts of an object's kind add.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("rows", type=Path)
    parser.add_argument("--motions", action="store_true")
    options = parser.parse_args(argv)
    counted, groups = divided(sorted(path.parent.name for path in options.folder.glob(f"*/{RECORD}")))
    parts = PartTable(tuple(table(read_object(options.folder / name) for name in counted)))
    rows = {r.name: replace(r, kind=kind_of(r.name)) for r in read_rows(options.rows) if not r.form}
    for what, names in groups.items():
        mine = [rows[name] for name in names if name in rows]
        print(f"{what}: {len(mine)} objects of {len({r.kind for r in mine})} kinds")
        for how, name_of in NAMES.items():
            found = [found_parts(r, parts, name_of(r.kind)) for r in mine]
            both = list(zip(mine, found, strict=True))
            each = [f1(c for r, c in both if r.kind == kind) for kind in sorted({r.kind for r in mine})]
            print(f"  {how}: F1 {f1(found):.3f}, mean over kinds {np.mean(each):.3f}")
        if options.motions:
            right = [right_motions(options.folder, r.name, parts) for r in mine]
            for how in NAMES:
                print(f"  {how}: right motions {np.mean([ok for r in right for ok in r[how]]):.3f}")


if __name__ == "__main__":
    main()
