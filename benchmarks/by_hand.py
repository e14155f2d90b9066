"""Measure what each score that is set by hand (`anymesh.scoring.by_hand`) costs when it is removed.

python -m benchmarks.by_hand DATASET [DATASET ...] [--change CHANGE] [--seconds LIMIT]

Each object is solved end to end by geometry, without names and with the true names of its parts. Patches, candidates and swept
motions do not depend on these scores, so they are computed once. After LIMIT no further object is begun. Prints a table.
"""

import argparse
import hashlib
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest.mock import patch

from anymesh.articulation import estimate, vetting
from anymesh.articulation.candidate_motions import CandidateMotions
from anymesh.articulation.rank_motions import motion_scores
from anymesh.evaluation.changes import changed
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.ground_truth import EvalSample, prepared
from anymesh.evaluation.record import Record
from anymesh.evaluation.score import score
from anymesh.evaluation.summary import summarize
from anymesh.geometry.surface import ObjectShape
from anymesh.motion.part_context import PartContext
from anymesh.pipeline import solving
from anymesh.scoring import by_hand
from anymesh.segmentation import segment
from anymesh.types import Mesh, Node, Segmentation

HEAD = "| removed | F1 | type | right | F1, named | type, named | right, named |\n|---|---|---|---|---|---|---|"


def removals() -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield for each score its name in the table and the constants of the module without it."""
    for name, value in vars(by_hand).items():
        if isinstance(value, float):
            yield name, {name: 0.0}
        elif name.isupper() and isinstance(value, Mapping):
            yield from ((f"{name}, {key}", {name: {k: v for k, v in value.items() if k != key}}) for key in value)


def key(value: Any) -> bytes:
    """Return what a function below depends on in an argument."""
    match value:
        case Mesh():
            return value.vertices.tobytes() + value.faces.tobytes() + repr(value.nodes).encode()
        case ObjectShape():
            return value.shape.corners.tobytes() + value.mesh_patch.tobytes()
        case PartContext():
            surfaces = value.part, value.parent, value.rest, value.without_part
            pivot = b"" if value.pivot is None else value.pivot.tobytes()
            return b"".join(s.corners.tobytes() for s in surfaces) + value.opening_direction.tobytes() + pivot
        case CandidateMotions():
            return motion_scores(value).tobytes()
        case Segmentation():
            return value.face_part.tobytes() + repr([part.name for part in value.parts]).encode()
        case EvalSample():
            return key(value.mesh)
        case str() | int() | tuple():
            return repr(value).encode()
        case _:
            return b""


# What depends on the scores only through its arguments.
COMPUTED_ONCE = (
    (solving, "divide_surface"), (segment, "find_contacts"), (segment, "examine_candidates"),
    (estimate, "score_motions"), (solving, "choose_motion"), (vetting, "estimate_joint"),
)  # fmt: skip


def once(function: Callable[..., Any]) -> Callable[..., Any]:
    known: dict[bytes, Any] = {}

    def look_up(*given: Any, **options: Any) -> Any:
        k = hashlib.sha256(b";".join(map(key, given))).digest()
        return known[k] if k in known else known.setdefault(k, function(*given, **options))

    return look_up


def measured(sample: EvalSample, rows: dict[str, dict[str, Any]]) -> Iterator[tuple[str, Record, Record]]:
    """Yield for each row its name, and the records without names and with the true names of the parts."""
    nodes = tuple(Node(part.name) for part in sample.truth.parts)
    named = replace(sample, mesh=replace(sample.mesh, face_node=sample.labels, nodes=nodes))
    score_once = once(score)
    with ExitStack() as stack:
        for module, name in COMPUTED_ONCE:
            stack.enter_context(patch.object(module, name, once(getattr(module, name))))
        for row, constants in rows.items():
            with patch.multiple(by_hand, **constants) if constants else ExitStack():
                plain, known = (Record(score_once(s, *solving.solve(s.mesh))) for s in (sample, named))
            yield row, plain, known


def main() -> None:
    parser = argparse.ArgumentParser(description="What each score that is set by hand is worth.")
    parser.add_argument("datasets", nargs="+", metavar="DATASET", help="as for `anymesh eval`")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="after which no further object is begun")
    parser.add_argument("--change", default="none", help="of the meshes, as for `anymesh eval`")
    options = parser.parse_args()
    end, rows = time.monotonic() + options.seconds, {"nothing": {}, **dict(removals())}
    records: dict[str, tuple[list[Record], list[Record]]] = {row: ([], []) for row in rows}
    objects = [(data, name) for data in map(open_dataset, options.datasets) for name in data.objects(None)]
    for data, name in objects:
        if time.monotonic() > end:
            break
        with tempfile.TemporaryDirectory() as folder:
            for row, plain, known in measured(changed(options.change, prepared(data.truth(name, Path(folder)))), rows):
                records[row][0].append(plain)
                records[row][1].append(known)
    whole = [summarize(some) for some in records["nothing"]]
    print(f"{whole[0].objects} of {len(objects)} objects, {whole[0].joints} joints\n\n{HEAD}")
    for row, both in records.items():
        cells = []
        for summary, kept in zip(map(summarize, both), whole, strict=True):
            for of in (lambda s: s.part_f1, lambda s: s.type_right, lambda s: s.success["right"]):
                cells.append(f"{of(kept):.3f}" if row == "nothing" else f"{of(summary) - of(kept):+.3f}")
        print(f"| {row} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
