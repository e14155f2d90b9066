"""Measure whether collision shapes let joints move: ours and others, with true parts and joints given.

python -m benchmarks.collision [--coacd] [SET ...]      writes reports/collision.md; a set as `anymesh eval` names it;
                                                        --coacd: also one CoACD run per link, which takes minutes per object

A joint is free if, at 21 positions over its range, no two shapes of different links penetrate by more than .1 % of the
diagonal where the surfaces do not intersect. Shapes are computed without the cache.
"""

from __future__ import annotations

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


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("sets", nargs="*", default=SETS, metavar="SET")
    parser.add_argument("--coacd", action="store_true")
    options = parser.parse_args()
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
