"""Count scenes whose objects are found exactly, and single objects that are divided into several.

python -m benchmarks.scenes [DATASET ...]      rows of examples, then the objects of data sets, such as urdf:FOLDER sweethome3d

Prints two tables. Rows: two to six examples of .4 to 3 m beside each other, right if exactly the true objects are found.
"""

from __future__ import annotations

import random
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

from anymesh.applications.scenes.objects import find_objects
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.loading import load_mesh, place_mesh
from anymesh.loading.join import join
from anymesh.types import Mesh, Node
from benchmarks import EXAMPLES, parser_of, table_head, table_row

UNLIKE_OBJECTS = ("sliding_window", "tilted_drawer", "tilting_flap", "valve")  # examples that are parts, or stand on nothing
SIZES = (0.4, 3.0)  # [m] longest sides of the objects in a row
GAPS = (0.0, 0.02, 0.05, 0.2)  # [m]
ROWS = 12  # of mixed objects, and as many of equal ones
GRAPHS = ("a node per object", "nodes of all parts", "one node")


def row_of(meshes: list[Mesh], gap: float, graph: str) -> tuple[Mesh, np.ndarray]:
    """Return objects in a row, and the object of each face. graph: one of GRAPHS."""
    at, placed = 0.0, []
    for k, mesh in enumerate(meshes):
        T = np.eye(4)
        T[0, 3] = at + mesh.extents[0] / 2
        at += mesh.extents[0] + gap
        nodes = mesh.nodes
        if graph == GRAPHS[0]:
            nodes = tuple(replace(n, path=(f"object_{k}", f"object_{k}/{i}")) for i, n in enumerate(nodes))
        placed.append(replace(mesh.transformed(T), nodes=nodes))
    scene = join(placed)
    if graph == GRAPHS[2]:
        scene = replace(scene, face_node=np.zeros(len(scene.faces), np.int64), nodes=(Node("scene"),))
    return scene, np.repeat(np.arange(len(meshes)), [len(m.faces) for m in meshes])


def told_apart(scene: Mesh, truth: np.ndarray) -> bool:
    """Whether exactly the true objects are found."""
    proposed = sorted(o.faces.tolist() for o in find_objects(scene))
    return proposed == sorted(np.flatnonzero(truth == k).tolist() for k in np.unique(truth))


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("datasets", nargs="*")
    names = parser.parse_args().datasets
    meshes = [
        place_mesh(load_mesh(p)).mesh for p in sorted((EXAMPLES / "meshes").glob("*.glb")) if p.stem not in UNLIKE_OBJECTS
    ]
    singles = {"examples": [len(find_objects(mesh)) for mesh in meshes]}
    meshes = [m for m in meshes if SIZES[0] < m.extents.max() < SIZES[1]]
    print(*table_head(("gap [m]", *GRAPHS)), sep="\n")
    rng = random.Random(0)
    for gap in GAPS:
        right = []
        for graph in GRAPHS:
            rows = [[rng.choice(meshes) for _ in range(rng.randint(2, 6))] for _ in range(ROWS)]
            rows += [[rng.choice(meshes)] * rng.randint(2, 6) for _ in range(ROWS)]
            right.append(f"{sum(told_apart(*row_of(row, gap, graph)) for row in rows)} of {len(rows)}")
        print(table_row((f"{gap:g}", *right)))
    for name in names:
        data, singles[name] = open_dataset(name), []
        for one in data.objects(None):
            with tempfile.TemporaryDirectory() as folder:
                singles[name].append(len(find_objects(place_mesh(load_mesh(data.truth(one, Path(folder)).mesh)).mesh)))
    print("", *table_head(("single objects of", "tried", "taken for several")), sep="\n")
    for name, counts in singles.items():
        print(table_row((name.partition(":")[0], len(counts), sum(n > 1 for n in counts))))


if __name__ == "__main__":
    main()
