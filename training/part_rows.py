"""The candidates for parts of objects with known parts, with their features, kept in a folder: one file per object.

python -m training.part_rows FOLDER SPEC ... [--change fused] [--most N] [--workers 2]

SPEC: a data set as for `anymesh eval`, with @NAME to name the source otherwise. Names of nodes and materials are removed.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Bool, Float, Float32, Int

from anymesh.evaluation.ground_truth import EvalSample
from anymesh.segmentation.contacts import find_contacts
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.part_candidates import part_candidates
from anymesh.segmentation.segment import examine_candidates
from training.collect_rows import collect_all, kind_of

ARRAYS = ("features", "members", "area", "place", "spread", "contact", "near")


@dataclass(frozen=True, eq=False)
class PartRows:
    """The candidates of one object.

    features: (n, k) with `names`; members: (n, P) which patches each candidate has; area: (P, T) of each patch in each true
    part [m^2]; moving: true parts that have a joint; carried: of each of these, it and what hangs on it; form: the change.
    """

    source: str
    kind: str
    name: str
    form: str
    names: tuple[str, ...]
    features: Float32[np.ndarray, "n k"]
    members: Bool[np.ndarray, "n P"]
    area: Float[np.ndarray, "P T"]
    moving: tuple[int, ...]
    carried: tuple[tuple[int, ...], ...]
    place: Float32[np.ndarray, "n 12"]
    spread: Float32[np.ndarray, "n 3"]
    contact: Float32[np.ndarray, "P P"]
    near: Int[np.ndarray, "k 2"]

    def iou(self) -> Float[np.ndarray, " n"]:
        """Return the largest IoU of each candidate with a true part, alone or with what it carries."""
        return np.max([np.zeros(len(self.members)), *(self.iou_with(k) for k in self.moving)], axis=0)

    def iou_with(self, part: int) -> Float[np.ndarray, " n"]:
        """Return the IoU of each candidate with a moving part, alone or with what it carries, whichever is larger."""
        inside, best = self.members @ self.area, np.zeros(len(self.members))
        for true in ([part], list(self.carried[self.moving.index(part)])):
            both = inside[:, true].sum(1)
            best = np.maximum(best, both / (inside.sum(1) + self.area[:, true].sum() - both))
        return best

    def save(self, path: Path) -> None:
        """Write an .npz file."""
        fields = {key: getattr(self, key) for key in ("source", "kind", "name", "form", "names", "moving", "carried")}
        arrays = {key: getattr(self, key) for key in ARRAYS}
        np.savez_compressed(path, told=np.frombuffer(json.dumps(fields).encode(), np.uint8), **arrays)


def read_rows(folder: Path) -> list[PartRows]:
    """Read all objects of a folder that have candidates, in the order of their file names."""
    found = []
    for path in sorted(folder.glob("*.npz")):
        with np.load(path) as file:
            fields: dict[str, Any] = json.loads(bytes(file["told"]).decode())
            arrays = {key: file[key] for key in ARRAYS}
        fields["names"], fields["moving"] = tuple(fields["names"]), tuple(fields["moving"])
        fields["carried"] = tuple(tuple(group) for group in fields["carried"])
        if len(arrays["features"]):
            found.append(PartRows(**fields, **arrays))
    return found


def rows_of(sample: EvalSample, source: str, form: str = "") -> PartRows:
    """Find and measure the candidates of an object."""
    mesh, truth = sample.mesh, sample.truth
    whole = object_shape(mesh)
    contacts = find_contacts(whole)
    candidates = part_candidates(mesh, whole, contacts)
    examined, place, rows = examine_candidates(mesh, candidates)
    names = tuple(rows[0]) if rows else ()
    shape = len(contacts.shapes), len(truth.parts)
    area = np.bincount(whole.mesh_patch * shape[1] + sample.labels, mesh.face_areas, shape[0] * shape[1]).reshape(shape)
    number = {part.name: k for k, part in enumerate(truth.parts)}
    parent = {number[j.child]: number.get(j.parent, 0) for j in truth.joints}
    return PartRows(
        source, kind_of(truth.name, truth.category), truth.name, form, names,
        np.array([[row[n] for n in names] for row in rows], np.float32), examined.members, area,
        tuple(parent), tuple(tuple(k for k in parent if top in _line(k, parent)) for top in parent),
        place.astype(np.float32), examined.spread.astype(np.float32), contacts.area_matrix, contacts.near,
    )  # fmt: skip


def _line(k: int, parent: dict[int, int]) -> list[int]:
    """The part and what it hangs on."""
    line: list[int] = []
    while k in parent and k not in line:
        line.append(k)
        k = parent[k]
    return line


def write_rows(path: Path, sample: EvalSample, source: str, form: str) -> None:
    """Write the rows of one object."""
    rows_of(sample, source, form).save(path)


def main(argv: Sequence[str] | None = None) -> None:
    collect_all("Candidates for parts, with their features.", write_rows, argv)


if __name__ == "__main__":
    main()
