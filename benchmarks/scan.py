"""Scans of the examples, recorded by a simulated depth camera, against the truth, and articulated end to end (docs/scan.md).

    python -m benchmarks.scan OUT [NAME ...] [--answers geometry,recorded] [--views 60] [--noise 0.0015] [--seed 0] [--pictures]

--answers: by geometry, and with the recorded answers of a general model to the pictures of the scans (recordings/scans/).
--pictures: scan the pictures without their depth (needs CUDA and the extra scan-gpu); no answers are recorded for these scans.
A folder an object: its recording, scan.glb, the assets, and the results; what is there is not made again. Prints the tables.
"""

from __future__ import annotations

import json
import shutil
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import anymesh
from anymesh.applications.scan import render_frames, scan
from anymesh.applications.scan.reading import read_frames
from anymesh.applications.scan.scanning import TO_GLTF
from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, read_ground_truth
from anymesh.evaluation.score import same_motion, score
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.triangle_set import sample_surface
from anymesh.loading import load_mesh, place_mesh
from anymesh.types import Asset, JointType, Mesh
from benchmarks import EXAMPLES, RECORDINGS, parser_of, table_head, table_row

NAMES = ("cabinet", "microwave", "fridge", "laptop", "drill", "storage_box", "stove")
POINTS = 50_000  # on each surface
SEEN = 0.002  # [m] a ray may end before the point that it is cast at


def measured(name: str, out: Path, views: int, noise: float, seed: int, pictures: bool) -> dict[str, Any]:
    """Record and scan one object, and compare the scan with its surface. pictures: scan without the recorded depth."""
    placed = place_mesh(load_mesh(true_example(name).mesh))
    if not (out / "frames").exists():
        render_frames(placed.mesh, out / "frames", views=views, noise=noise, seed=seed)
    began, spent = time.perf_counter(), time.process_time()
    recording = without_depth(out / "frames", out / "pictures") if pictures else out / "frames"
    report = scan(recording, out / "scan.glb", force=True)
    seconds, spent = time.perf_counter() - began, time.process_time() - spent
    T_world_mesh = np.array(json.loads((out / "frames" / "truth.json").read_text())["T_world_mesh"])
    T_scan_mesh = np.array(report.T_scan_world) @ T_world_mesh
    found = {"name": name, "seconds": seconds, "cpu": spent, "faces": report.faces, "voxel": report.voxel,
             "dropped": len(report.dropped), "open": report.open_share, "diagonal": placed.mesh.diagonal}  # fmt: skip
    T_glb_scan = np.eye(4)
    T_glb_scan[:3, :3] = TO_GLTF
    found["T_glb_loaded"] = (T_glb_scan @ T_scan_mesh @ placed.T_asset_source).tolist()
    return found | distances(placed.mesh, out, T_world_mesh, T_scan_mesh)


def without_depth(recording: Path, out: Path) -> Path:
    """Copy a recording without its depth; return the new folder."""
    shutil.copytree(recording / "color", out / "color", dirs_exist_ok=True)
    frames = json.loads((recording / "frames.json").read_text())
    frames["frames"] = [{k: v for k, v in frame.items() if k != "depth"} for frame in frames["frames"]]
    (out / "frames.json").write_text(json.dumps({k: v for k, v in frames.items() if k != "depth_scale"}))
    return out


def articulated(name: str, out: Path, answers: str, T_glb_loaded: np.ndarray) -> dict[str, Any]:
    """Score the asset of one scan.

    answers: "geometry" or "recorded"; T_glb_loaded: from the mesh as loaded to the scan's file.
    """
    truth = true_example(name)
    answerer = "geometry" if answers == "geometry" else f"replay:{RECORDINGS / 'scans' / name}"
    began = time.perf_counter()
    asset = anymesh.articulate(out / "scan.glb", out / answers, force=True, formats="urdf,glb", answerer=answerer)
    seconds = time.perf_counter() - began
    result = scored(truth, load_mesh(truth.mesh).mesh, asset, asset.source.T_asset_source @ T_glb_loaded)
    return {"name": name, "articulate": seconds, **result}


def true_example(name: str) -> GroundTruth:
    return read_ground_truth(EXAMPLES / "truth" / f"{name}.json", EXAMPLES / "meshes" / f"{name}.glb")


def distances(mesh: Mesh, out: Path, T_world_mesh: np.ndarray, T_scan_mesh: np.ndarray) -> dict[str, float]:
    """Accuracy (scan to true surface) and completeness (true surface that a camera saw to scan), shares of the diagonal."""
    made = load_mesh(out / "scan.glb").mesh
    vertices = (made.vertices @ TO_GLTF - T_scan_mesh[:3, 3]) @ T_scan_mesh[:3, :3]
    on = sample_surface(vertices[made.faces], POINTS, 0).points
    accuracy = distance_to_mesh(on, mesh.vertices, mesh.faces)[0] / mesh.diagonal
    true = sample_surface(mesh.triangles, POINTS, 0).points
    scene = RayScene(mesh.vertices, mesh.faces)
    seen = np.zeros(len(true), bool)
    for frame in read_frames(out / "frames").frames:
        T = np.linalg.inv(T_world_mesh) @ frame.T_world_camera
        inside = frame.camera.pixels((true - T[:3, 3]) @ T[:3, :3])[0] >= 0
        way = true - T[:3, 3]
        reach = scene.first_hit(np.repeat(T[None, :3, 3], len(true), 0), way).distance * np.linalg.norm(way, axis=1)
        seen |= inside & (reach > np.linalg.norm(way, axis=1) - SEEN)
    complete = distance_to_mesh(true[seen], vertices, made.faces)[0] / mesh.diagonal
    return {"accuracy": float(accuracy.mean()), "accuracy95": float(np.quantile(accuracy, 0.95)),
            "complete": float(complete.mean()), "complete95": float(np.quantile(complete, 0.95))}  # fmt: skip


def scored(truth: GroundTruth, mesh: Mesh, asset: Asset, T: np.ndarray) -> dict[str, Any]:
    """The asset's joints against the truth, whose labels go to the nearest faces. Parts that the scan does not show are left
    out of the truth, and listed."""
    there = mesh.transformed(T)
    labels = truth.labels[distance_to_mesh(asset.mesh.triangles.mean(1), there.vertices, there.faces)[1]]
    shown = np.bincount(labels, minlength=len(truth.parts)) > 0
    shown[0] = True
    names = {p.name for p, s in zip(truth.parts, shown, strict=True) if s}
    kept = replace(
        truth,
        parts=tuple(p for p in truth.parts if p.name in names),
        joints=tuple(j for j in truth.joints if j.child in names),
    )
    subject = EvalSample(kept, asset.mesh, (np.cumsum(shown) - 1)[labels], T)
    result = score(subject, asset.segmentation, asset.joints)
    joints = [{"part": j.part, "iou": j.iou, "type": j.type_true.value, "found": j.type_found and j.type_found.value,
               "angle": j.angle, "at_part": j.at_part, "opens_right": j.opens_right} for j in result.joints]  # fmt: skip
    hidden = [p.name for p in truth.parts if p.name not in names]
    return {"joints": joints, "predicted": result.predicted, "true": result.true, "matched": result.matched, "hidden": hidden}


def scan_table(rows: list[dict[str, Any]]) -> str:
    """Markdown: the accuracy of each scan."""
    lines = table_head(("object", "voxel mm", "accuracy % (95 %)", "completeness % (95 %)", "scan s (CPU s)"))
    lines += [
        f"| {r['name']} | {1000 * r['voxel']:.1f} | {100 * r['accuracy']:.3f} ({100 * r['accuracy95']:.3f}) "
        f"| {100 * r['complete']:.3f} ({100 * r['complete95']:.3f}) | {r['seconds']:.0f} ({r['cpu']:.0f}) |"
        for r in rows
    ]
    return "\n".join(lines)


def joint_table(rows: list[dict[str, Any]]) -> str:
    """Markdown: the joints of each asset, then the sums."""
    lines = table_head(("object", "joints found", "extra", "angle", "s"))
    for r in rows:
        found = [j for j in r["joints"] if j["found"]]
        angles = ", ".join(
            f"{j['part']} {j['angle']:.1f}{'' if j['type'] == j['found'] else ' as ' + j['found']}" for j in found
        )
        missed = ", ".join(j["part"] for j in r["joints"] if not j["found"])
        what = (angles or "-") + (f"; missed {missed}" if missed else "")
        counts = (f"{len(found)} of {len(r['joints'])}", r["predicted"] - r["matched"])
        lines.append(table_row((r["name"], *counts, what, f"{r['articulate']:.0f}")))
    joints = [j for r in rows for j in r["joints"]]
    good = sum(
        bool(j["found"]) and j["angle"] <= 5 and same_motion(JointType(j["type"]), JointType(j["found"])) for j in joints
    )
    count = sum(bool(j["found"]) for j in joints)
    lines.append(f"\n{count} of {len(joints)} joints found, {good} of them with the right motion and an axis within 5 degrees.")
    return "\n".join(lines)


def kept(place: Path, make: Callable[[], dict[str, Any]]) -> dict[str, Any]:
    """Return the result in a file, made if it is not there."""
    if not place.exists():
        result = make()
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(json.dumps(result, indent=1))
    return json.loads(place.read_text())


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("names", nargs="*", default=list(NAMES))
    parser.add_argument("--views", type=int, default=60)
    parser.add_argument("--noise", type=float, default=0.0015)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--answers", default="geometry,recorded")
    parser.add_argument("--pictures", action="store_true")
    options = parser.parse_args()
    how = {"views": options.views, "noise": options.noise, "seed": options.seed, "pictures": options.pictures}
    if options.pictures and "recorded" in options.answers:
        parser.error("--pictures: no answers are recorded for these scans; add --answers geometry")
    options.out /= "pictures" if options.pictures else ""
    scans = [kept(options.out / n / "scan.json", partial(measured, n, options.out / n, **how)) for n in options.names]
    print(scan_table(scans))
    for answers in options.answers.split(","):
        rows = []
        for row in scans:
            folder, T = options.out / row["name"], np.array(row["T_glb_loaded"])
            rows.append(kept(folder / f"{answers}.json", partial(articulated, row["name"], folder, answers, T)))
        print(f"\n{answers}\n\n{joint_table(rows)}", flush=True)


if __name__ == "__main__":
    main()
