"""Compare methods that divide non-convex solids: failures, time, number of pieces, false contacts.

python -m benchmarks.decomposers [--path NAME=FOLDER ...] [SET ...]     writes benchmarks/decomposers.md; a set as `anymesh
                                                        eval` names it; --path: another coacd, unpacked in a folder

True parts and joints are given. Each call runs in a child process with limits of 10 s and 4 GiB; a solid whose call fails
gets one hull. False contacts are pairs of shapes that touch at a sampled pose where the surfaces do not, before they are
cleared. The seconds are wall time in the child processes. V-HACD is the package vhacdx. The exact cuts use manifold3d.
Needs: pip install coacd vhacdx
"""

from __future__ import annotations

import collections
import datetime
import platform
import sys
import tempfile
import time
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path

import numpy as np

from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.protocols import prepared
from anymesh.export.links import split_links
from anymesh.geometry.simplify_ import simplify
from anymesh.isolation import ChildError, ChildLimits, ChildPool
from anymesh.physics.collision import MIN_COMPONENT_SIZE_RATIO, CollisionConfig, sampled_poses
from anymesh.physics.collision.clear import ComponentShapes, ContactScene
from anymesh.physics.collision.convex import hull_of
from anymesh.physics.collision.crossing import LinkSurface
from anymesh.physics.collision.decompose import Component, Resolution, component_shapes, split_components
from anymesh.physics.collision.primitives import fitted
from anymesh.physics.collision.split import patch_of, solid_mesh, split_surface

PAGE = Path(__file__).with_suffix(".md")
SETS = ("examples", "scene-synthesizer", "metaworld", "libero")
SECONDS = 10.0
COACD = {"preprocess_mode": "off", "seed": 0, "mcts_iterations": 20, "mcts_nodes": 10, "resolution": 200}  # several times
# faster than the defaults, with as many pieces


def divide(way: str, component: Component, resolution: Resolution) -> tuple[list[np.ndarray], float]:
    """The corners of the pieces of a component, and the seconds that took. The function that children run."""
    name, _, folder = way.partition("=")
    if folder:
        sys.path.insert(0, folder)
    begin = time.perf_counter()
    triangles = simplify(component.triangles, 3000)
    if name == "cuts by planes":
        made = [
            h.vertices
            for h in split_surface(triangles, gap=resolution.gap, wall=resolution.wall, max_pieces=resolution.max_pieces)
        ]
    elif name.startswith("V-HACD"):
        import vhacdx

        vertices, faces = solid_mesh(triangles)
        made = [p for p, _ in vhacdx.compute_vhacd(vertices, faces.astype(np.uint32), 32, 100_000, asyncACD=False)]
    else:
        import coacd

        coacd.set_log_level("off")
        vertices, faces = solid_mesh(simplify(triangles, 1000))
        concavity = float(np.clip(resolution.gap / (np.ptp(vertices, axis=0).max() / 2), 0.01, 1.0))
        made = [p for p, _ in coacd.run_coacd(coacd.Mesh(vertices, faces), threshold=concavity, **COACD)]
    return [np.asarray(p, float) for p in made], time.perf_counter() - begin


def divide_ours(component: Component, resolution: Resolution) -> tuple[list, float]:
    begin = time.perf_counter()
    return list(component_shapes(component, resolution)), time.perf_counter() - begin


@dataclass
class Tally:
    """What one way did over all links."""

    links: int = 0
    components: int = 0
    failed: collections.Counter = field(default_factory=collections.Counter)
    seconds: list[float] = field(default_factory=list)
    pieces: list[int] = field(default_factory=list)
    contacts: int = 0


def shapes_of(pool: ChildPool, way: str, component: Component, resolution: Resolution, tally: Tally) -> tuple:
    whole = patch_of(simplify(component.triangles, 3000), resolution.wall)
    if whole is None or whole.gap <= resolution.gap or not component.solid:
        return () if whole is None else (fitted(whole.hull),)
    tally.components += 1
    try:
        if way == "ours":
            found, seconds = pool.run("decomposers", "divide_ours", {"component": component, "resolution": resolution})
        else:
            corners, seconds = pool.run("decomposers", "divide", {"way": way, "component": component, "resolution": resolution})
            found = [fitted(hull) for points in corners if (hull := hull_of(points, resolution.wall)) is not None]
    except ChildError as error:
        tally.failed[error.failure.value] += 1
        return (fitted(whole.hull),)
    tally.seconds.append(seconds)
    tally.pieces.append(len(found))
    return tuple(found)


def measure(spec: str, pools: dict[str, ChildPool], tallies: dict[str, Tally]) -> None:
    config, data = CollisionConfig(), open_dataset(spec)
    for name in data.objects():
        with tempfile.TemporaryDirectory() as folder:
            asset = prepared(data.truth(name, Path(folder))).asset()
        links, size = split_links(asset), asset.mesh.diagonal
        resolution = Resolution(config.gaps[0] * size, min(config.wall * size, config.wall_most), config.pieces[0])
        surfaces = {k.name: LinkSurface(simplify(k.triangles, 50_000)) for k in links}
        poses = sampled_poses(asset, {k.name: k.origin for k in links}, config.poses)
        scene = ContactScene(surfaces, poses, config.contact * size, config.crossing * size)
        for way, tally in tallies.items():
            tally.links += len(links)
            parts = [
                (k.name, c)
                for k in links
                for c in split_components(k.triangles, MIN_COMPONENT_SIZE_RATIO * config.gaps[0] * size)
            ]
            pieces = [ComponentShapes(n, c, 0, shapes_of(pools[way], way, c, resolution, tally)) for n, c in parts]
            tally.contacts += len(scene.faults(pieces).found)


def main() -> None:
    words, folders = sys.argv[1:], []
    while "--path" in words:
        at = words.index("--path")
        folders.append(words[at + 1])
        del words[at : at + 2]
    ways = ["ours", "CoACD", "V-HACD", "cuts by planes", *folders]
    tallies = {way: Tally() for way in ways}
    pools = {way: ChildPool(1, ChildLimits(SECONDS, 4 << 30)) for way in ways}
    done = []
    for spec in words or SETS:
        measure(spec, pools, tallies)
        done.append(spec.partition(":")[0])
        write_page(tallies, done)
        print(spec, tallies["ours"].links, flush=True)


def write_page(tallies: dict[str, Tally], sets: list[str]) -> None:
    """Write what was measured so far."""
    head = "way | solids | crash | time limit | error | seconds, median | 9 of 10 below | sum | pieces, mean | false contacts"
    rows = [f"| {head} |", "|---" * 10 + "|"]
    for way, t in tallies.items():
        failed = " | ".join(str(t.failed[kind]) for kind in ("crash", "time limit", "error"))
        times = " | ".join(f"{v:.2f}" for v in (*np.percentile(t.seconds or [0.0], [50, 90]), sum(t.seconds)))
        label = "exact cuts of the solid (used)" if way == "ours" else way.partition("=")[0]
        rows.append(f"| {label} | {t.components} | {failed} | {times} | {np.mean(t.pieces or [0]):.1f} | {t.contacts} |")
    packages = ", ".join(f"{p} {version(p)}" for p in ("coacd", "vhacdx", "manifold3d", "mujoco", "numpy"))
    links = f"{tallies['ours'].links} links of {', '.join(sets)}."
    footer = f"{links} {datetime.date.today()}, Python {platform.python_version()}, {packages}."
    title = "# Methods of convex decomposition"
    PAGE.write_text("\n\n".join([title, (__doc__ or "").strip(), "\n".join(rows), footer]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
