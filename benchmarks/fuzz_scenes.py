"""Hostile scenes from a seed: an arrangement of parts, faults in their surfaces, and what a file may say of them.

The same seed gives the same scene. `FIXTURES` are scenes of a known class of failure, by name.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from benchmarks.fuzz_arrangements import ARRANGEMENTS, FIXTURES, Part
from benchmarks.fuzz_shapes import Rng

FORMATS = ("glb", "glb", "glb", "obj", "ply", "stl", "off")  # GLB more often: it alone has nodes, transforms, materials
NAMES = (
    "",
    "door",
    "door",
    "base",
    "Tür links",
    "扉",
    "a/b\\c",
    "<&>\"'",
    "..",
    "x" * 400,
    "1",
    "link name",
    "nul\tl",
    "🚪",
    "-",
)
EXTREME = 0.15  # share of scenes in units far from metres, and of those far from the origin
FAULTY = 0.5  # share of scenes with faults in some of their surfaces
MOST_FAULTS = 4


@dataclass(frozen=True)
class Scene:
    """What is written to one file. unit: factor on all coordinates; offset: then added [units of the file]."""

    name: str
    format: str
    parts: tuple[Part, ...]
    unit: float = 1.0
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    faults: tuple[str, ...] = ()
    looks: str = "plain"  # of LOOKS
    options: dict[str, str] = field(default_factory=dict)  # of `articulate`


LOOKS = ("plain", "plain", "colors", "textured", "no uv", "uv out of range", "missing texture", "broken texture")


def _flip_some(part: Part, rng: Rng) -> Part:
    faces = part.faces.copy()
    turned = rng.random(len(faces)) < rng.choice([0.1, 0.5, 1.0])
    faces[turned] = faces[turned, ::-1]
    return replace(part, faces=faces)


def _duplicate_faces(part: Part, rng: Rng) -> Part:
    again = part.faces[rng.random(len(part.faces)) < 0.4]
    return replace(part, faces=np.concatenate([part.faces, again[:, ::-1] if rng.random() < 0.5 else again]))


def _unmerge(part: Part, rng: Rng) -> Part:
    jitter = 10.0 ** rng.uniform(-12, -6) if rng.random() < 0.3 else 0.0
    vertices = part.vertices[part.faces].reshape(-1, 3)
    vertices = vertices + jitter * rng.normal(size=vertices.shape)
    return replace(part, vertices=vertices, faces=np.arange(len(vertices)).reshape(-1, 3))


def _zero_area(part: Part, rng: Rng) -> Part:
    if not len(part.vertices):
        return part
    a, b = rng.integers(0, len(part.vertices), (2, 8))
    return replace(part, faces=np.concatenate([part.faces, np.stack([a, b, np.where(rng.random(8) < 0.5, a, b)], 1)]))


def _flatten(part: Part, rng: Rng) -> Part:
    vertices = part.vertices.copy()
    vertices[:, int(rng.integers(3))] *= rng.choice([0.0, 1e-9, 1e-5])
    return replace(part, vertices=vertices)


def _drop_faces(part: Part, rng: Rng) -> Part:
    return replace(part, faces=part.faces[rng.random(len(part.faces)) < rng.uniform(0.3, 0.95)])


def _stray_vertices(part: Part, rng: Rng) -> Part:
    return replace(part, vertices=np.concatenate([part.vertices, rng.normal(0, 1e4, (5, 3))]))


def _jitter(part: Part, rng: Rng) -> Part:
    size = float(np.ptp(part.vertices, axis=0).max()) if len(part.vertices) else 0.0
    return replace(part, vertices=part.vertices + 10.0 ** rng.uniform(-8, -1.5) * size * rng.normal(size=part.vertices.shape))


def _shear(part: Part, rng: Rng) -> Part:
    T = part.T.copy()
    T[:3, :3] = T[:3, :3] @ (np.eye(3) + rng.normal(0, 0.6, (3, 3)))
    return replace(part, T=T)


def _mirror(part: Part, rng: Rng) -> Part:
    return replace(part, T=part.T @ np.diag([*rng.choice([-1.0, 1.0], 3), 1.0]))


def _squash_node(part: Part, rng: Rng) -> Part:
    scale = np.ones(4)
    scale[int(rng.integers(3))] = rng.choice([0.0, 1e-8, 1e5])
    return replace(part, T=part.T @ np.diag(scale))


def _far(part: Part, rng: Rng) -> Part:
    T = part.T.copy()
    T[:3, 3] += rng.normal(size=3) * 10.0 ** rng.uniform(1, 3.5)
    return replace(part, T=T)


def _into_another(part: Part, rng: Rng) -> Part:
    T = part.T.copy()
    T[:3, 3] += rng.normal(0, 0.2, 3)
    return replace(part, T=T)


FAULTS = {
    "flipped faces": _flip_some,
    "duplicate faces": _duplicate_faces,
    "duplicate vertices": _unmerge,
    "zero-area faces": _zero_area,
    "flattened": _flatten,
    "missing faces": _drop_faces,
    "stray vertices": _stray_vertices,
    "jitter": _jitter,
    "sheared node": _shear,
    "mirrored node": _mirror,
    "squashed node": _squash_node,
    "far apart": _far,
    "interpenetrating": _into_another,
}


def scene(seed: int) -> Scene:
    """The scene of a seed, 0 or more."""
    rng = np.random.default_rng([0xA5, seed])
    names = list(ARRANGEMENTS)
    weights = np.array([ARRANGEMENTS[n][0] for n in names], float)
    kind = names[int(rng.choice(len(names), p=weights / weights.sum()))]
    parts = _named(ARRANGEMENTS[kind][1](rng), rng)
    faults: list[str] = []
    if rng.random() < FAULTY:
        faults = [str(f) for f in rng.choice(list(FAULTS), int(rng.integers(1, MOST_FAULTS + 1)), replace=False)]
        struck = [rng.random(len(parts)) < rng.choice([0.2, 1.0]) for _ in faults]
        for fault, where in zip(faults, struck, strict=True):
            parts = [FAULTS[fault](p, rng) if hit else p for p, hit in zip(parts, where, strict=True)]
    far = 10.0 ** rng.uniform(2, 7) * rng.normal(size=3) if rng.random() < EXTREME / 2 else np.zeros(3)
    return Scene(
        f"{seed:05d}",
        str(rng.choice(FORMATS)),
        tuple(parts),
        unit=float(10.0 ** rng.uniform(-6, 6)) if rng.random() < EXTREME else 1.0,
        offset=(float(far[0]), float(far[1]), float(far[2])),
        faults=(kind, *faults),
        looks=str(rng.choice(LOOKS)),
        options=_options(rng),
    )


def fixture(name: str) -> Scene:
    """A scene of a known class of failure."""
    return Scene(name, "glb", tuple(FIXTURES[name]()), faults=(name,))


def _named(parts: list[Part], rng: Rng) -> list[Part]:
    """Names as artists, scanners and other languages give them; most stay."""
    if rng.random() < 0.6:
        return parts
    return [replace(p, name=str(rng.choice(NAMES))) if rng.random() < 0.5 else p for p in parts]


def _options(rng: Rng) -> dict[str, str]:
    return {
        "up": str(rng.choice(["auto", "auto", "x", "y", "z"])),
        "scale": str(rng.choice(["auto", "auto", "auto", "0.5:longest"])),
        "base": str(rng.choice(["fixed", "free"])),
        "drives": str(rng.choice(["passive", "position"])),
    }
