"""Compare own code with the libraries that could replace it (docs/decisions).

pip install xatlas genai-prices filelock scipy; python -m benchmarks.libraries [--dense]
--dense: only unwrap one surface of 81,920 faces by both; run it with a time limit.
Times are the best of three on one thread; only their ratios are meaningful.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import filelock
import genai_prices
import numpy as np
import trimesh
import xatlas
from scipy.spatial.transform import Rotation

from anymesh.export.rotations import quaternion, rpy
from anymesh.finishing.bake_charts import lay_out
from anymesh.loading import load_mesh
from anymesh.prompted.models.prices import PRICES, cost_of
from anymesh.types import JointType, Motion

SIZE, PADDING = 1024, 2  # [px]
MESHES = Path(__file__).parents[1] / "examples" / "meshes"


def seconds(call: Callable[[], object], repeats: int = 1) -> float:
    """Return the time of one call [s], the best of three series."""
    found = []
    for _ in range(3):
        begin = time.perf_counter()
        for _ in range(repeats):
            call()
        found.append((time.perf_counter() - begin) / repeats)
    return min(found)


def density(corners: np.ndarray, areas: np.ndarray) -> float:
    """Return the median resolution over the faces [px/m]. corners: (F, 3, 2) [px]; areas: (F,) [m2]."""
    a, b = np.moveaxis(corners[:, 1:] - corners[:, :1], 1, 0)
    return float(np.median(np.sqrt(np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2 / areas)))


def fitted_atlas(vertices: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, tuple[int, int]]:
    """Unwrap by xatlas, again with fewer texels per metre until it fits; return corners [px] and the size of the first run."""
    scale, first = 0.0, (0, 0)
    while True:
        atlas, options = xatlas.Atlas(), xatlas.PackOptions()
        atlas.add_mesh(vertices, faces)
        options.padding, options.texels_per_unit, options.resolution = 2 * PADDING, scale, 0 if scale else SIZE
        atlas.generate(xatlas.ChartOptions(), options)
        first = first if scale else (atlas.width, atlas.height)
        if scale and max(atlas.width, atlas.height) <= SIZE:
            _, corners, uv = atlas[0]
            return (uv * [atlas.width, atlas.height])[corners], first
        scale = atlas.texels_per_unit * SIZE / max(atlas.width, atlas.height) * (0.995 if scale else 1.0)


def compare_charts() -> None:
    for name in ("bucket", "toy_car", "valve"):
        mesh = load_mesh(MESHES / f"{name}.glb").mesh
        vertices, inverse = np.unique(mesh.vertices.astype(np.float32), axis=0, return_inverse=True)
        faces = inverse.reshape(-1)[mesh.faces].astype(np.uint32)
        own = density(lay_out(mesh, SIZE, PADDING).corners, mesh.face_areas)
        corners, first = fitted_atlas(vertices, faces)
        slower = seconds(lambda v=vertices, f=faces: fitted_atlas(v, f)) / seconds(lambda m=mesh: lay_out(m, SIZE, PADDING))
        gain = density(corners, mesh.face_areas) / own
        print(f"xatlas, {name}: first {first[0]} x {first[1]} px for {SIZE}; {gain:.2f} of px/m, {slower:.0f} of the time")


def compare_dense() -> None:
    sphere = trimesh.creation.icosphere(subdivisions=6)
    x, y, _ = sphere.vertices.T
    sphere.vertices = sphere.vertices * (1 + 0.05 * np.sin(9 * x) * np.cos(8 * y))[:, None]
    with tempfile.TemporaryDirectory() as folder:
        sphere.export(path := Path(folder) / "sphere.stl")
        mesh = load_mesh(path).mesh
    begin = time.perf_counter()
    lay_out(mesh, SIZE, PADDING)
    print(f"own, {len(mesh.faces)} faces: {time.perf_counter() - begin:.1f} s", flush=True)
    begin = time.perf_counter()
    xatlas.parametrize(sphere.vertices, sphere.faces)
    print(f"xatlas: {time.perf_counter() - begin:.1f} s")


def compare_prices() -> None:
    def theirs(name: str) -> float:
        provider, _, model = name.partition(":")
        usage = genai_prices.Usage(input_tokens=10_000, output_tokens=1000)
        return float(genai_prices.calc_price(usage, model, provider_id=provider).total_price)

    other = [name for name in PRICES if abs(theirs(name) / (cost_of(name, 10_000, 1000) or 1) - 1) > 1e-9]
    slower = seconds(lambda: theirs("openai:gpt-4o"), 300) / seconds(lambda: cost_of("openai:gpt-4o", 10_000, 1000), 300)
    print(f"genai-prices: {len(other)} of {len(PRICES)} prices differ today ({', '.join(other)}); {slower:.0f} of the time")


def compare_rotations() -> None:
    rng, amounts = np.random.default_rng(0), np.linspace(-3, 3, 18)
    axes = rng.normal(size=(300, 3))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    other = 0
    for axis in axes:
        own = Motion(JointType.REVOLUTE, axis, np.zeros(3), "").transforms(amounts)[:, :3, :3]
        other += int((own != Rotation.from_rotvec(amounts[:, None] * axis).as_matrix()).any((1, 2)).sum())
    matrices = Rotation.random(2000, random_state=1).as_matrix()
    turned = Rotation.from_matrix(matrices)
    quaternions = sum(
        (quaternion(m) != q).any() for m, q in zip(matrices, turned.as_quat(True, scalar_first=True), strict=True)
    )
    angles = sum((rpy(m) != a).any() for m, a in zip(matrices, turned.as_euler("xyz"), strict=True))
    slower = seconds(lambda: Rotation.from_matrix(matrices[0]).as_euler("xyz"), 300) / seconds(lambda: rpy(matrices[0]), 300)
    print(f"Rotation: other bits in {other} of {300 * 18} motions, {quaternions} quaternions and {angles} rpy of 2000")
    print(f"Rotation: rpy of one matrix takes {slower:.0f} of the time")


def try_filelock() -> None:
    with tempfile.TemporaryDirectory() as folder:
        try:
            filelock.FileLock(folder, timeout=0).acquire()
            print("filelock: locks a folder")
        except OSError as error:
            print(f"filelock: a folder gives {type(error).__name__}")
        path = Path(folder) / "run.lock"
        with filelock.FileLock(path, timeout=0):
            path.rename(path.with_name("moved.lock"))
            with filelock.FileLock(path, timeout=0):
                print("filelock: two holders after a rename")


if __name__ == "__main__":
    if "--dense" in sys.argv:
        sys.exit(compare_dense())
    compare_charts()
    compare_prices()
    compare_rotations()
    try_filelock()
