"""`anymesh generate` measured on surfaces whose joints are known: from files, and through a program that makes them.

python -m benchmarks.generate --work DIR [--markdown FILE] [--only NAME ...]
python -m benchmarks.generate --stand-in "a retro microwave" --write FILE.glb

The stand-in is no generator: it takes the shipped example that the prompt names, wraps it on a grid into one closed surface of
about 50,000 faces without an inside (the change `fused` of `anymesh eval`), and writes it in a box of length 1 about the
origin, as open image-to-3D models do.
"""

from __future__ import annotations

import json
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from anymesh.applications.generate import generate
from anymesh.checking import check_asset
from anymesh.evaluation.changes import changed, moved
from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, example_truths, prepared
from anymesh.evaluation.score import ObjectScore, score
from anymesh.finishing.scene_glb import Y_UP, scene_glb
from anymesh.types import Asset, Segmentation
from anymesh.viewer.pictures_ import write_picture
from benchmarks import EXAMPLES, parser_of, table_head, table_row

FUSED = ("cabinet_fused", "laptop_fused", "microwave_fused", "stove_fused")  # as shipped, through --mesh
WRAPPED = ("cabinet", "fridge", "laptop", "microwave", "storage_box", "stove", "toaster")  # through the stand-in
ANGLE, LINE = 5.0, 0.1  # [deg], and half diagonals: a joint within both, of the right type and opening side, is right
T_Y_UP = np.block([[Y_UP, np.zeros((3, 1))], [np.zeros((1, 3)), np.ones((1, 1))]])


def stand_in(prompt: str) -> tuple[bytes, EvalSample, np.ndarray]:
    """The GLB, the wrapped object, and the transform (4, 4) from it to the coordinates of the GLB."""
    words = prompt.lower().split()
    truth = next(t for t in example_truths(EXAMPLES) if t.name in WRAPPED and set(t.name.split("_")) <= set(words))
    subject = changed("fused", prepared(truth))
    low, high = subject.mesh.bounds
    T = np.diag([*[1 / (high - low).max()] * 3, 1.0])
    T[:3, 3] = -T[0, 0] * (low + high) / 2
    T = T_Y_UP @ T
    return scene_glb({"object": subject.mesh}, T), subject, T


def scored(asset: Asset, subject: EvalSample, T_file_subject: np.ndarray) -> ObjectScore:
    """The asset against the truth, on the faces that its mesh file had."""
    assert asset.source_face is not None
    old = np.flatnonzero(asset.source_face >= 0)
    part = np.zeros(len(subject.mesh.faces), int)
    part[asset.source_face[old]] = asset.segmentation.face_part[old]
    placed = moved(subject, asset.source.T_asset_source @ T_file_subject)
    return score(placed, Segmentation(part, asset.segmentation.parts), asset.joints)


def right(result: ObjectScore) -> int:
    """Joints of the right type, within ANGLE and LINE of the true axis, that open to the right side."""
    return sum(
        j.type_right and (j.angle or 0.0) <= ANGLE and (j.line_distance or 0.0) <= LINE and j.opens_right is not False
        for j in result.joints
    )


def row(name: str, made: str, work: Path, subject: EvalSample, T: np.ndarray, **how: object) -> str:
    """Generate one object anew; return its row of the table."""
    out = work / f"{made}-{name}"
    begin = time.perf_counter()
    asset = generate(out=out, force=out.exists(), **how)  # ty: ignore[invalid-argument-type]
    seconds = time.perf_counter() - begin
    write_picture(out, work / f"{out.name}.png", size=400)
    record = json.loads((out / "generation.json").read_text())["mesh"]
    result = scored(asset, subject, T)
    sizes = f"{asset.mesh.extents.max():.2f} / {subject.mesh.extents.max():.2f}"
    stages = ", ".join(f"{stage} {s:.0f}" for stage, s in asset.timing.items())
    joints = (f"{right(result)} of {result.true}", len(asset.joints), sizes, "yes" if check_asset(out).ok else "no")
    return table_row((name, made, f"{record['faces']:,}", record["components"], *joints, f"{seconds:.0f}", stages))


def rows(work: Path, only: list[str]) -> Iterator[str]:
    """Every object on both roads."""
    truths: dict[str, GroundTruth] = {t.name: t for t in example_truths(EXAMPLES)}
    for name in [n for n in FUSED if not only or n in only]:
        subject = prepared(truths[name])
        T_file = np.linalg.inv(subject.T)
        yield row(name, "file", work, subject, T_file, prompt=None, mesh=truths[name].mesh)
    for name in [n for n in WRAPPED if not only or n in only]:
        prompt = f"a retro {name.replace('_', ' ')}"
        _, subject, T = stand_in(prompt)
        command = f"command:'{sys.executable}' -m benchmarks.generate --stand-in {{prompt}} --write {{out}}"
        yield row(name, "program", work, subject, T, prompt=prompt, generator=command)


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("--work", type=Path)
    parser.add_argument("--markdown", type=Path)
    parser.add_argument("--only", nargs="*", default=[])
    parser.add_argument("--stand-in", metavar="PROMPT")
    parser.add_argument("--write", type=Path)
    options = parser.parse_args()
    if options.stand_in is not None:
        options.write.write_bytes(stand_in(options.stand_in)[0])
        return
    work = options.work or Path(tempfile.mkdtemp())
    head = "object, mesh from, faces, components, joints right, joints found, longest side / true [m], check, s, of these"
    lines = table_head(head.split(", "))
    for found in rows(work, options.only):
        lines.append(found)
        print(lines[-1], flush=True)
    if options.markdown is not None:
        options.markdown.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
