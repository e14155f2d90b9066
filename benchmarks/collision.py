"""Measure whether collision shapes let joints move: ours and others, with true parts and joints given.

python -m benchmarks.collision [--coacd] [SET ...]      writes reports/collision.md; a set as `anymesh eval` names it;
                                                        --coacd: also one CoACD run per link, which takes minutes per object
python -m benchmarks.collision --rings [BASE]           prints the table of round openings; BASE: src/ of another checkout

A joint is free if, at 21 positions over its range, no two shapes of different links penetrate by more than .1 % of the
diagonal where the surfaces do not intersect. Shapes are computed without the cache.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np

from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.ground_truth import prepared
from anymesh.export.links import Link, split_links
from anymesh.geometry.topology import weld
from anymesh.physics.clear import ComponentShapes, ContactScene, LinkSurface
from anymesh.physics.collision import CollisionConfig, collision_shapes, joint_poses
from anymesh.physics.convex import hull_of
from anymesh.physics.decompose import Component
from anymesh.types import Asset, JointType, Shape
from benchmarks import REPORTS, made_with, parser_of, table_head, table_row

SETS = ("examples", "scene-synthesizer", "metaworld", "libero")
DEEP = 1e-3  # of the diagonal
Shapes = dict[str, tuple[Shape, ...]]


def one_hull(asset: Asset, links: tuple[Link, ...]) -> Shapes:
    found = {link.name: hull_of(link.triangles.reshape(-1, 3), 1e-3 * asset.mesh.diagonal) for link in links}
    return {name: () if hull is None else (hull,) for name, hull in found.items()}


def one_coacd(asset: Asset, links: tuple[Link, ...]) -> Shapes:
    """CoACD on all of a link at its usual concavity, as it is often done; its own remesh makes a link one solid.

    Needs: pip install coacd
    """
    import coacd

    found = {}
    for link in links:
        corners = link.triangles.reshape(-1, 3)
        _, first, faces = np.unique(weld(corners), return_index=True, return_inverse=True)
        pieces = coacd.run_coacd(coacd.Mesh(corners[first], faces.reshape(-1, 3)), threshold=0.05, preprocess_mode="on")
        found[link.name] = tuple(hull for points, _ in pieces if (hull := hull_of(points)) is not None)
    return found


def ours(asset: Asset, links: tuple[Link, ...]) -> Shapes:
    found = collision_shapes(asset, {k.name: k.triangles for k in links}, {k.name: k.origin for k in links})
    return dict(found.shapes)


WAYS: dict[str, Callable[[Asset, tuple[Link, ...]], Shapes]] = {
    "one hull per link": one_hull,
    "one CoACD per link": one_coacd,
    "ours": ours,
}


def free_joints(asset: Asset, links: tuple[Link, ...], shapes: Shapes) -> tuple[int, int]:
    """How many joints are free, of how many that move."""
    size, config = asset.mesh.diagonal, CollisionConfig()
    surfaces = {link.name: LinkSurface(link.triangles) for link in links}
    origins = {link.name: link.origin for link in links}
    pieces = [ComponentShapes(name, Component(np.zeros((0, 3, 3)), False), 0, some) for name, some in shapes.items()]
    free = moving = 0
    for joint in asset.joints:
        if joint.type is not JointType.FIXED:
            scene = ContactScene(surfaces, joint_poses(asset, origins, joint, 21), DEEP * size, config.crossing * size)
            moving += 1
            free += not any(
                {pieces[f.first[0]].link, pieces[f.second[0]].link} & {joint.child} for f in scene.faults(pieces).found
            )
    return free, moving


def measured(spec: str, ways: Sequence[str]) -> Iterator[tuple[str, int, int, int, int, float]]:
    """Of each object and way: its name, free joints, moving joints, shapes, links, seconds."""
    data = open_dataset(spec)
    for name in data.objects():
        with tempfile.TemporaryDirectory() as folder:
            asset = prepared(data.truth(name, Path(folder))).asset()
        links = split_links(asset)
        for way, make in ((way, WAYS[way]) for way in ways):
            begin = time.perf_counter()
            shapes = make(asset, links)
            seconds = time.perf_counter() - begin
            yield way, *free_joints(asset, links, shapes), sum(map(len, shapes.values())), len(links), seconds


RINGS = """
import sys, time, numpy as np
from anymesh.geometry.distance_ import distance_to_triangles
from manifold3d import CrossSection, Manifold
from anymesh.physics.convex import as_hull, planes
from anymesh.physics.decompose import Component, Resolution, component_shapes
rod = lambda r, h, n: Manifold.cylinder(h, r, r, n, True)
SHAPES = {
    "tube": (lambda n: rod(.05, .1, n) - rod(.04, 1, n), .04),
    "washer": (lambda n: rod(.03, .003, n) - rod(.015, 1, n), .015),
    "bored plate": (lambda n: Manifold.cube((.2, .15, .02), True) - rod(.04, 1, n), .04),
    "torus": (lambda n: CrossSection.circle(.03, 24).translate((.1, 0)).revolve(n), .07),
    "nut": (lambda n: rod(.02, .01, 6) - rod(.01, 1, n), .01),
    "mug": (lambda n: rod(.04, .1, n) - rod(.036, .1, n).translate((0, 0, .005)), .036),
    "pipe": (lambda n: rod(.025, 1, n) - rod(.02, 2, n), .02),
}
for name, (make, bore) in SHAPES.items():
    for sides in (8, 12, 16, 24, 32, 33, 64, 128, 256):
        mesh = make(sides).to_mesh64()
        t = np.asarray(mesh.vert_properties)[:, :3][np.asarray(mesh.tri_verts, np.int64)]
        size = float(np.linalg.norm(np.ptp(t.reshape(-1, 3), axis=0)))
        begin = time.process_time()
        shapes = component_shapes(Component(t, True), Resolution(.02 * size, .002 * size, 24))
        spent = time.process_time() - begin
        hulls = [as_hull(s) for s in shapes]
        inside = any(planes(h)[:, 3].max() <= 0 for h in hulls)  # the middle of the bore is the origin
        middle = np.zeros((1, 3))
        free = 0 if inside else min(float(distance_to_triangles(middle, h.vertices[h.faces])[0]) for h in hulls) / bore
        print(f"{name}|{sides}|{len(shapes)}|{max(free, 0):.2f}|{spent:.3f}", flush=True)
"""  # run with the source of each checkout


def rings(base: str | None) -> None:
    """Print hulls, the free share of the bore's radius and processor seconds of rings, and those of another checkout."""
    rows: list[list[list[str]]] = []
    for source in [str(Path(__file__).parent.parent / "src"), *([base] if base else [])]:
        environment = {**os.environ, "PYTHONPATH": source}
        done = subprocess.run([sys.executable, "-c", RINGS], env=environment, capture_output=True, text=True, check=True)
        rows.append([line.split("|") for line in done.stdout.splitlines()])
    print("\n".join(table_head(("shape", "sides", *["hulls", "free radius", "seconds"] * len(rows)))))
    for pair in zip(*rows, strict=True):
        print(table_row((*pair[0][:2], *(cell for row in pair for cell in row[2:]))))


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("--rings", nargs="?", const="", metavar="BASE")
    parser.add_argument("sets", nargs="*", default=SETS, metavar="SET")
    parser.add_argument("--coacd", action="store_true")
    options = parser.parse_args()
    if options.rings is not None:
        rings(options.rings or None)
        return
    rows = []
    ways = [way for way in WAYS if options.coacd or way != "one CoACD per link"]
    for spec in options.sets:
        found = list(measured(spec, ways))
        for way in ways:
            mine = np.array([row[1:] for row in found if row[0] == way])
            free, moving, shapes, links, _ = mine.sum(0)
            times = np.sort(mine[:, 4])
            share = f"{free:.0f}/{moving:.0f} ({free / moving:.1%})"
            cells = (spec.split(":")[0], way, share, f"{shapes / links:.1f}", f"{np.median(times):.2f}", f"{times[-1]:.1f}")
            rows.append(table_row(cells))
            print(rows[-1], flush=True)
    head = table_head(("set", "shapes", "joints free", "shapes per link", "seconds per object, median", "most"))
    footer = f"{made_with('manifold3d', 'mujoco', 'numpy')}; `python -m benchmarks.collision`."
    text = "\n\n".join(["# Collision shapes", (__doc__ or "").split("\n\n", 2)[2].strip(), "\n".join([*head, *rows]), footer])
    (REPORTS / "collision.md").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
