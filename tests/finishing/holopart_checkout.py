"""A checkout that has HoloPart's command line and files, and completes parts by their convex hulls, or fails as asked."""

from pathlib import Path

SCRIPT = """
import argparse, os, sys, time

parser = argparse.ArgumentParser()
parser.add_argument("--mesh-input", type=str, required=True)
parser.add_argument("--output-dir", type=str, default="./output")
parser.add_argument("--seed", type=int, default=42)
parser.add_argument("--num-inference-steps", type=int, default=50)
parser.add_argument("--guidance-scale", type=float, default=3.5)
parser.add_argument("--batch_size", type=int, default=8)
args = parser.parse_args()
fault = FAULT
assert not [name for name in os.environ if name.endswith("_API_KEY")], "a key"
assert os.path.isfile("scripts/inference_holopart.py"), "not run in its folder"
if fault == "hang":
    time.sleep(60)
if fault == "talks of a key":
    sys.exit("RuntimeError: hf_abcdefghijklmnopqrstuvwxyz0123456789 is refused")
if fault == "crash":
    raise RuntimeError("min(): Expected reduction dim 0 to have non-zero size.")
os.makedirs(args.output_dir, exist_ok=True)
target = os.path.join(args.output_dir, "output.glb")
if fault == "nothing":
    sys.exit(0)
if fault == "garbage":
    open(target, "wb").write(b"glTF" + bytes(40))
    sys.exit(0)
if fault == "no file of its kind":
    open(os.path.join(args.output_dir, "output.obj"), "w").write("o")
    sys.exit(0)

import numpy as np
import trimesh

scene = trimesh.load(args.mesh_input)
whole = scene.dump(concatenate=True)
assert np.abs(whole.bounds).max() <= 1.0, "not in its box"
done = []
for name, part in scene.geometry.items():
    points = part.sample(2000, seed=0)
    axes = np.linalg.svd(points - points.mean(0), full_matrices=False)[2]
    sides = np.ptp((points - points.mean(0)) @ axes.T, axis=0)
    if fault == "thin" and sides.min() < LIMIT * sides.max():
        raise RuntimeError("min(): Expected reduction dim 0 to have non-zero size.")
    hull = part.convex_hull
    center = (points.max(0) + points.min(0)) / 2
    hull = trimesh.Trimesh((hull.vertices - center).astype(np.float32), hull.faces)
    hull.visual.vertex_colors = np.array([0.2, 0.5, 0.7])
    hull.name = name
    hull.apply_translation(center)
    done.append(hull)
trimesh.Scene(done).export(target)
"""


def checkout(folder: Path, fault: str = "", limit: float = 0.03) -> Path:
    """limit: of the longest side, the thickness under which it crashes on a part when its fault is "thin"."""
    (folder / "scripts").mkdir(parents=True)
    script = SCRIPT.replace("FAULT", repr(fault)).replace("LIMIT", repr(limit))
    (folder / "scripts" / "inference_holopart.py").write_text(script)
    return folder
