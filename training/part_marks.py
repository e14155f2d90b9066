"""Draw regions of objects for viewers who say which of them move.

python -m training.part_marks ROWS FOLDER SPEC@SOURCE ... [--most 50] [--of-kind 1]

The objects on which stage A does worst, as in `failures.py`, and as many others at random, each as FOLDER/pictures/K.png:
the plain object, and three views with numbered regions. Regions: true parts, what the classifier took for parts, and large
pieces of the base. FOLDER/worst.jpg: a sheet of the worst. FOLDER/truth.json says which regions move and which the classifier
found; viewers must not see it. `part_answers.py` compares their answers with it.
"""

from __future__ import annotations

import io
import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Int, UInt8
from PIL import Image, ImageDraw

from anymesh.evaluation.ground_truth import EvalSample
from anymesh.geometry.raycast_ import RayScene
from anymesh.prompted.pictures.plates import mark_color
from anymesh.prompted.pictures.sheet import question_sheet
from anymesh.rendering.marks import font
from anymesh.rendering.render import View, encode, render
from anymesh.rendering.viewpoints import orbit_camera
from anymesh.segmentation.divide import object_shape
from training.collect_rows import called
from training.failures import Failure, failures
from training.part_scores import RIGHT
from training.worst_rows import SheetOptions, sheet_options, with_objects, write_sheet

ANGLES = [(float(a), e) for e in (25.0, -25.0) for a in range(0, 360, 45)]  # [deg, deg] azimuth and elevation of views
SHOWN, WELL = 3, 400  # views that are shown, and pixels with which a region is shown well
SIZE, TEXT, MIN_PIXELS = 600, 17, 40  # [px, px, px] of a view, of a number, and least visible part of a numbered region
MOST_PARTS, MOST_OTHERS = 8, 6  # true parts, and pieces of the base, that are marked in one object
MIN_AREA_SHARE = 0.004  # of the object's surface: smallest piece of the base that is marked
PLAIN = (205, 205, 205)


@dataclass(frozen=True, eq=False)
class Region:
    """Faces with one number. moves: whether they are a movable part; found: whether the classifier says so."""

    faces: Bool[np.ndarray, " F"]
    moves: bool
    found: bool


def regions(failure: Failure, sample: EvalSample, rng: np.random.Generator) -> list[Region]:
    """Return the regions of an object in random order."""
    rows, areas = failure.rows, sample.mesh.face_areas
    patch = object_shape(sample.mesh).mesh_patch
    chosen = failure.number[patch]
    in_part = np.isin(sample.labels, rows.moving)
    parts = [sample.labels == k for k in rows.moving]
    wrong = [(chosen == k) & ~in_part for k in range(1, int(chosen.max()) + 1) if _share(chosen == k, in_part, areas) < 0.5]
    rest = ~in_part & ~np.any([np.zeros_like(in_part), *wrong], axis=0)
    pieces = [rest & (patch == k) for k in np.unique(patch[rest])]
    pieces = sorted(pieces, key=lambda faces: -float(areas[faces].sum()))[1:]  # the largest piece stands for the base
    pieces = [faces for faces in pieces if areas[faces].sum() > MIN_AREA_SHARE * areas.sum()][:MOST_OTHERS]
    some = [parts[k] for k in rng.permutation(len(parts))[:MOST_PARTS]]
    found = [Region(faces, True, _found(faces, chosen, areas)) for faces in some]
    found += [Region(faces, False, True) for faces in wrong if areas[faces].sum() > 0]
    found += [Region(faces, False, _share(faces, chosen > 0, areas) > 0.5) for faces in pieces]
    return [found[k] for k in rng.permutation(len(found))]


def _share(faces: np.ndarray, within: np.ndarray, areas: np.ndarray) -> float:
    return float(areas[faces & within].sum() / max(areas[faces].sum(), 1e-300))


def _found(faces: np.ndarray, chosen: np.ndarray, areas: np.ndarray) -> bool:
    both = np.bincount(chosen, areas * faces)
    iou = both / np.maximum(np.bincount(chosen, areas) + areas[faces].sum() - both, 1e-300)
    return bool(iou[1:].max(initial=0) > RIGHT)


def draw(sample: EvalSample, marked: Sequence[Region]) -> tuple[UInt8[np.ndarray, "H W 3"], set[int]]:
    """Return the picture of an object, and the numbers, from 1, of the regions that can be seen in it."""
    mesh = replace(sample.mesh, corner_normal=None)
    number = np.zeros(len(mesh.faces) + 1, np.int64)  # the last stands for no face
    for k, region in enumerate(marked, start=1):
        number[:-1][region.faces] = k
    color = np.array([PLAIN, *(mark_color(k) for k in range(1, len(marked) + 1))], np.uint8)[number[:-1]]
    scene, cameras = RayScene(mesh.vertices, mesh.faces), [orbit_camera(mesh.bounds, *angles, SIZE) for angles in ANGLES]
    views = [render(mesh, camera, face_color=color, scene=scene) for camera in cameras]
    size = np.array([np.bincount(number[view.face].reshape(-1), minlength=len(marked) + 1)[1:] for view in views])
    best = _best_views(size)
    panels = [render(mesh, cameras[best[0]], face_color=np.full_like(color, PLAIN[0]), scene=scene).color]
    panels += [_numbered(views[v], number[views[v].face]) for v in best]
    seen = {int(k) + 1 for k in np.flatnonzero(size[best].max(0) >= MIN_PIXELS)}
    return np.concatenate([np.concatenate(panels[:2], 1), np.concatenate(panels[2:], 1)]), seen


def _best_views(size: Int[np.ndarray, "v n"]) -> list[int]:
    """Return the views that together show the regions best. size: pixels of each region in each view."""
    best: list[int] = []
    shown = np.minimum(size / WELL, 1)
    for _ in range(SHOWN):
        now = shown[best].max(0, initial=0)
        gain = np.maximum(shown - now, 0).sum(1) + 1e-6 * size.sum(1)
        gain[best] = -1
        best.append(int(gain.argmax()))
    return best


def _numbered(view: View, shown: Int[np.ndarray, "H W"]) -> UInt8[np.ndarray, "H W 3"]:
    picture = Image.fromarray(view.color)
    for k in np.unique(shown[shown > 0]):
        row, column = np.nonzero(shown == k)
        if len(row) >= MIN_PIXELS:
            at = int(np.argmin((row - row.mean()) ** 2 + (column - column.mean()) ** 2))
            where = (int(column[at]), int(row[at]))
            ImageDraw.Draw(picture).text(where, str(k), "black", font(TEXT), "mm", stroke_width=3, stroke_fill="white")
    return np.asarray(picture)


def chosen_objects(options: SheetOptions) -> Iterator[tuple[str, Failure, EvalSample]]:
    """Yield the worst objects, and as many of the others at random."""
    moving = [f for f in failures(options.rows) if f.rows.moving]
    worst = list(with_objects(moving, options))
    taken = {id(f) for f, _ in worst}
    others = [moving[k] for k in np.random.default_rng(0).permutation(len(moving)) if id(moving[k]) not in taken]
    yield from (("worst", *w) for w in worst)
    yield from (("random", *w) for w in with_objects(others, options))


def draw_all(argv: Sequence[str] | None = None) -> None:
    """Write the pictures and the truth."""
    options = sheet_options("Regions of objects, for viewers.", 1, argv)
    folder = options.out
    (folder / "pictures").mkdir(parents=True, exist_ok=True)
    rng, truth, worst = np.random.default_rng(0), {}, []
    for group, failure, sample in chosen_objects(options):
        marked = regions(failure, sample, rng)
        picture, seen = draw(sample, marked)
        told = {str(k): [r.moves, r.found] for k, r in enumerate(marked, start=1) if k in seen}
        key = len(truth) + 1
        truth[str(key)] = {"group": group, "object": f"{called(failure.rows)} {failure.rows.name}", "regions": told}
        Image.fromarray(picture).save(folder / "pictures" / f"{key}.png")
        if group == "worst":
            worst.append(encode(picture[:SIZE, SIZE:], called(failure.rows)))
        print(key, group, failure.caption, flush=True)
    with Image.open(io.BytesIO(question_sheet(worst).png)) as sheet:
        write_sheet(folder / "worst.jpg", np.asarray(sheet.convert("RGB")), [o["object"] for o in truth.values()][: len(worst)])
    (folder / "truth.json").write_text(json.dumps(truth) + "\n", encoding="utf-8")


if __name__ == "__main__":
    draw_all()
