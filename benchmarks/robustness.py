"""The examples end to end after they were turned, scaled, or shaken: what a scan or a careless export does to a mesh.

python benchmarks/robustness.py      writes benchmarks/robustness.md
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from accuracy import EXAMPLES

from anymesh.evaluation.protocols import evaluate
from anymesh.evaluation.score import table
from anymesh.evaluation.truth import example_truths
from anymesh.geometry.topology import weld
from anymesh.solving import solve
from anymesh.types import Mesh

HEAD = """# Robustness

`python benchmarks/robustness.py`: the 21 examples end to end, on geometry alone. Noise: Gaussian, of every welded corner, in
shares of the object's diagonal.

"""


def turned(mesh: Mesh, yaw: float, scale: float) -> tuple[Mesh, np.ndarray]:
    """The mesh turned about z by `yaw` [rad] and scaled, and the transform that did it (4, 4)."""
    c, s = np.cos(yaw), np.sin(yaw)
    T = np.diag([scale, scale, scale, 1.0])
    T[:2, :2] = scale * np.array([[c, -s], [s, c]])
    return mesh.transformed(T), T


def shaken(mesh: Mesh, noise: float) -> tuple[Mesh, np.ndarray]:
    """The mesh with Gaussian noise of `noise` diagonals on every welded corner, so that no seam opens."""
    corner = weld(mesh.vertices)
    shift = np.random.default_rng(0).normal(size=(int(corner.max()) + 1, 3)) * noise * mesh.diagonal
    return replace(mesh, vertices=mesh.vertices + shift[corner], corner_normal=None), np.eye(4)


CASES = {
    "as shipped": lambda mesh: (mesh, np.eye(4)),
    "turned by 29 deg": lambda mesh: turned(mesh, 0.5, 1.0),
    "turned by 126 deg, scaled by 0.3": lambda mesh: turned(mesh, 2.2, 0.3),
    "noise .0001": lambda mesh: shaken(mesh, 1e-4),
    "noise .0002": lambda mesh: shaken(mesh, 2e-4),
    "noise .0005": lambda mesh: shaken(mesh, 5e-4),
}


def main() -> None:
    truths = example_truths(EXAMPLES)
    rows: list[str] = []
    for case, change in CASES.items():
        lines = table([evaluate(t, solve, change=change) for t in truths]).splitlines()
        rows = rows or [lines[0].replace("object", "case"), lines[1]]
        rows.append(lines[-1].replace("**all**", case))
        print(rows[-1], flush=True)
    Path(__file__).with_suffix(".md").write_text(HEAD + "\n".join(rows) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
