"""Draw the objects on which stage A does worst, by classifiers that were not trained on their source or kind.

python -m training.failures ROWS OUT.jpg SPEC@SOURCE ... [--most 50] [--of-kind 2]

ROWS: as for `training/train_parts.py`, which must have measured them; SPEC: the data sets of these rows. Green: right,
orange: part of a wrong choice, red: missed, blue: no part, purple: not among the candidates. On the right the base is left out.
OUT.txt lists the objects.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import Int
from PIL import Image

from anymesh.evaluation.ground_truth import EvalSample
from anymesh.geometry.raycast_ import RayScene
from anymesh.prompted.pictures.sheet import question_sheet
from anymesh.rendering.render import encode, render
from anymesh.rendering.viewpoints import orbit_camera
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.segment import assign_parts
from anymesh.types import Mesh, Picture
from training.collect_rows import called
from training.part_rows import PartRows, read_rows
from training.part_scores import RIGHT, Counts, overlap_of, owners, scored
from training.train_parts import calibrated, chances, read_scores
from training.worst_rows import sheet_options, with_objects, write_sheet

BASE, CORRECT, MIXED, MISSED, WRONG, ABSENT = range(6)
COLORS = np.array([[205, 205, 205], [70, 170, 80], [235, 150, 50], [215, 60, 50], [70, 100, 225], [150, 80, 190]], np.uint8)
AZIMUTH, ELEVATION, SIZE = 35.0, 25.0, 340  # [deg], [deg], [px]
OWN = "kinds"  # the source that is divided by kind; every other source is left out whole


@dataclass(frozen=True, eq=False)
class Failure:
    """An object with its choice of parts. number: (P,) chosen part of each patch from 1, 0 for the base."""

    rows: PartRows
    counts: Counts
    number: Int[np.ndarray, " P"]

    @property
    def errors(self) -> int:
        """Parts missed and parts found that are none."""
        return self.counts.true + self.counts.found - 2 * self.counts.right

    @property
    def caption(self) -> str:
        return f"{called(self.rows)} {self.rows.name}: {self.counts.right} of {self.counts.true}, {self.counts.found} found"


def failures(folder: Path) -> list[Failure]:
    """Return all objects, those with the lowest F1 and then the most errors first."""
    rows = read_rows(folder)
    found = []
    scores = read_scores(folder, rows)
    calibration = calibrated(rows, scores["kind"])
    on_sources, on_kinds = (chances(scores[left], *calibration) for left in ("source", "kind"))
    for r, source, kind in zip(rows, on_sources, on_kinds, strict=True):
        chosen = assign_parts(overlap_of(r), kind if r.source == OWN else source)
        found.append(Failure(r, scored(r, chosen), owners(r, chosen)))
    return sorted(found, key=lambda f: (f.counts.f1, -f.errors, f.caption))


def states(failure: Failure, sample: EvalSample) -> Int[np.ndarray, " F"]:
    """Return one of the states, the indices of COLORS, per face."""
    rows, mesh = failure.rows, sample.mesh
    chosen = failure.number[object_shape(mesh).mesh_patch]
    count = len(sample.truth.parts)
    both = np.bincount(chosen * count + sample.labels, mesh.face_areas, (chosen.max() + 1) * count).reshape(-1, count)
    iou = both / np.maximum(both.sum(1, keepdims=True) + both.sum(0) - both, 1e-300)
    state = np.where(chosen > 0, WRONG, BASE)
    inside = rows.members @ rows.area
    for part in rows.moving:
        own = sample.labels == part
        best = (inside[:, part] / np.maximum(inside.sum(1) + rows.area[:, part].sum() - inside[:, part], 1e-300)).max()
        state[own] = np.where(chosen[own] > 0, MIXED, MISSED if best > RIGHT else ABSENT)
        if iou[1:, part].max(initial=0) > RIGHT:
            state[own] = CORRECT
    return state


def picture(mesh: Mesh, state: Int[np.ndarray, " F"], caption: str) -> Picture:
    """Draw the object, and beside it what is not base."""
    panels = []
    for kept in (np.ones(len(state), bool), state != BASE):
        if not kept.any():
            continue
        some = mesh.subset(kept)
        camera = orbit_camera(mesh.bounds, AZIMUTH, ELEVATION, SIZE)
        panels.append(render(some, camera, face_color=COLORS[state[kept]], scene=RayScene(some.vertices, some.faces)).color)
    return encode(np.concatenate(panels, 1), caption)


def main(argv: Sequence[str] | None = None) -> None:
    options = sheet_options("A contact sheet of the worst objects.", 2, argv)
    cards = []
    for failure, sample in with_objects(failures(options.rows), options):
        plain = replace(sample.mesh, corner_normal=None)
        cards.append(picture(plain, states(failure, sample), failure.caption))
        print(failure.caption, flush=True)
    with Image.open(io.BytesIO(question_sheet(cards).png)) as sheet:
        write_sheet(options.out, np.asarray(sheet.convert("RGB")), [c.caption for c in cards])


if __name__ == "__main__":
    main()
