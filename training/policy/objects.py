"""Laptops and buckets for the policy experiment, with exact joints: plain ones, and designs that vary more.

The plain laptops are those of `training/kinds`. The designs stand for meshes of artists: they are written as one mesh without
names, which `anymesh annotate` turns into assets. `python -m training.policy.objects FOLDER` writes all of them.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from zlib import crc32

import numpy as np
import trimesh
from trimesh import Trimesh

from anymesh.evaluation.ground_truth import GroundTruth, read_ground_truth
from training.kinds.household.things import laptop as plain_laptop
from training.kinds.model import BASE, Model, left_by_an_artist
from training.kinds.solids import box, cut, loft, prism, rod, rounded, together, tube, turned

TO_Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
SEED = 19


def designed_laptop(m: Model) -> None:
    """A laptop: thin or thick, a wedge or a slab, its hinge at the back or before it, open, ajar or shut."""
    wide = m.number(0.2, 0.44)
    deep, thick, lid = wide * m.number(0.6, 0.78), m.number(0.008, 0.036), m.number(0.005, 0.02)
    back = m.pick(0.0, 0.0, 0.1, 0.16) * deep  # of the base behind the hinge
    radius = m.pick(0.004, 0.012, 0.02)
    if m.chance(0.35):
        m.add(BASE, prism([(0, 0.35 * thick), (deep + back, 0), (deep + back, thick), (0, thick)], "x", (0, wide)))
    else:
        m.add(BASE, prism(rounded((0, wide), (0, deep + back), radius), "z", (0, thick)))
    _keys(m, wide, deep, thick)
    if m.chance(0.5):
        at = [(x, y) for x in (0.08 * wide, 0.92 * wide) for y in (0.1 * deep, 0.9 * deep)]
        m.add(BASE, *(rod((x, y, -0.004), (x, y, 0.0), 0.008, 10) for x, y in at))
    opened, gap = m.pick(0.0, 60.0, 90.0, 105.0, 120.0), m.pick(0.001, 0.0015, 0.003)
    about, z = (wide / 2, deep, thick + gap), thick + gap
    solids = [prism(rounded((0, wide), (0, deep - 0.002), radius), "z", (z, z + lid))]
    if m.chance(0.7):
        frame = (0.03 * wide, 0.97 * wide), (0.05 * deep, 0.92 * deep)
        solids.append(box(*frame, (z - 0.0006, z + 0.001)))
    if m.chance(0.4):
        solids.append(rod((wide / 2, deep / 2, z + lid), (wide / 2, deep / 2, z + lid + 0.001), 0.07 * deep, 16))
    ends = m.pick(((0.1, 0.2), (0.8, 0.9)), ((0.15, 0.85),), ((0.05, 0.3), (0.7, 0.95)))
    barrels = [rod((a * wide, deep, z), (b * wide, deep, z), m.number(0.003, 0.006), 12) for a, b in ends]
    owner = m.pick(BASE, "lid")
    m.add(owner, *barrels)
    m.add("lid", *(turned(s, (-1, 0, 0), opened, about) for s in solids))
    m.hinge("lid", about, (-1, 0, 0), (-opened, m.pick(125.0, 140.0) - opened))


def _keys(m: Model, wide: float, deep: float, thick: float) -> None:
    """A keyboard of single keys or one plate, and a touchpad."""
    x, y = (0.08 * wide, 0.92 * wide), (0.42 * deep, 0.86 * deep)
    if m.chance(0.5):
        columns, rows = m.pick(6, 10), m.pick(3, 4)
        w, d = (x[1] - x[0]) / columns, (y[1] - y[0]) / rows
        for i in range(columns):
            for j in range(rows):
                a, b = x[0] + i * w, y[0] + j * d
                m.add(BASE, box((a + 0.1 * w, a + 0.9 * w), (b + 0.1 * d, b + 0.9 * d), (thick - 0.001, thick + 0.0006)))
    else:
        m.add(BASE, box(x, y, (thick - 0.001, thick + 0.0006)))
    if m.chance(0.7):
        m.add(BASE, box((0.36 * wide, 0.64 * wide), (0.06 * deep, 0.32 * deep), (thick - 0.001, thick + 0.0005)))


def plain_bucket(m: Model) -> None:
    """A round pail with lugs and a bow of round wire, upright or fallen to a side."""
    n = 24
    low, high, tall = m.number(0.095, 0.12), m.number(0.12, 0.145), m.number(0.2, 0.28)
    _vessel(m, np.c_[np.cos(_turn(n)), np.sin(_turn(n))], (low, high), tall, 0.004)
    z, x = 0.9 * tall, low + 0.9 * (high - low) + 0.008
    m.add(BASE, *(rod((s * (x - 0.012), 0, z), (s * (x + 0.006), 0, z), 0.005, 12) for s in (-1, 1)))
    a = np.linspace(0, np.pi, 25)
    path = np.c_[(x + 0.004) * np.cos(a), 0 * a, z + m.number(1.0, 1.15) * x * np.sin(a)]
    grasp = [rod((-0.045, 0, path[12, 2]), (0.045, 0, path[12, 2]), 0.009, 12)]
    _bow(m, [tube(path, 0.0035), *grasp], z, m.pick(0.0, 0.0, 50.0, -50.0))


def designed_bucket(m: Model) -> None:
    """A pail, a tub of staves, a tin, a trug or a basket; its bow is round, square or high, thin or thick."""
    style = m.pick("pail", "tub", "tin", "trug", "basket")
    wall, n = m.number(0.003, 0.008), {"tub": 10, "tin": 20, "pail": 28, "trug": 16, "basket": 4}[style]
    outline = np.c_[np.cos(_turn(n)), np.sin(_turn(n))]
    if style == "basket":
        outline = np.array([[1.0, -0.7], [1.0, 0.7], [-1.0, 0.7], [-1.0, -0.7]])
    if style == "trug":
        outline = outline * [1.0, 0.62]
    high = m.number(0.075, 0.19)
    low, tall = high * m.number(0.65, 1.0), high * {"tin": 2.2, "trug": 0.9}.get(style, m.number(1.2, 2.0))
    _vessel(m, outline, (low, high), tall, wall)
    if style == "tub":
        for z in (0.25 * tall, 0.75 * tall):
            r = low + (high - low) * z / tall
            hoop = [np.c_[(r + e) * outline, np.full(n, z + h)] for h, e in ((-0.012, -0.002), (-0.012, 0.003), (0.012, 0.003))]
            m.add(BASE, loft(np.array([*hoop, np.c_[(r - 0.002) * outline, np.full(n, z + 0.012)]])))
    z = m.pick(0.85, 0.92) * tall
    x = low + (high - low) * z / tall + 0.005
    m.add(BASE, *(rod((s * (x - 0.012), 0, z), (s * (x + 0.004), 0, z), m.number(0.004, 0.007), 12) for s in (-1, 1)))
    rise, thick = x * m.number(0.7, 1.6), m.number(0.0035, 0.009)
    x += thick
    if m.chance(0.35):
        path = np.array([(x, 0, z), (x, 0, z + 0.8 * rise), (0.7 * x, 0, z + rise), (-0.7 * x, 0, z + rise),
                         (-x, 0, z + 0.8 * rise), (-x, 0, z)])  # fmt: skip
    else:
        a = np.linspace(0, np.pi, 21)
        path = np.c_[x * np.cos(a), 0 * a, z + rise * np.sin(a)]
    solids = [tube(path, thick, 8)]
    if m.chance(0.5):
        half = m.number(0.25, 0.4) * x
        solids.append(rod((-half, 0, z + rise), (half, 0, z + rise), thick + m.number(0.003, 0.007), 12))
    _bow(m, solids, z, m.pick(0.0, 0.0, 45.0, -60.0))


def _turn(n: int) -> np.ndarray:
    return np.linspace(0, 2 * np.pi, n, endpoint=False)


def _vessel(m: Model, outline: np.ndarray, radii: tuple[float, float], tall: float, wall: float) -> None:
    """A hollow body that widens from radii[0] to radii[1]."""
    n = len(outline)
    outer = loft(np.array([np.c_[r * outline, np.full(n, z)] for r, z in zip(radii, (0.0, tall), strict=True)]))
    inner = loft(
        np.array([np.c_[(r - wall) * outline, np.full(n, z)] for r, z in zip(radii, (wall, tall + wall), strict=True)])
    )
    m.add(BASE, cut(outer, inner))


def _bow(m: Model, solids: list[Trimesh], z: float, leaning: float) -> None:
    """The handle on two pivots at the height z, leaning by an angle [deg]; it falls to both sides."""
    m.add("handle", *(turned(s, (1, 0, 0), leaning, (0, 0, z)) for s in solids))
    m.hinge("handle", (0, 0, z), (1, 0, 0), (-90.0 - leaning, 90.0 - leaning))


BUILDERS = {
    ("laptop", "plain"): plain_laptop,
    ("laptop", "designed"): designed_laptop,
    ("bucket", "plain"): plain_bucket,
    ("bucket", "designed"): designed_bucket,
}


def write_object(thing: str, style: str, number: int, folder: Path, seed: int = SEED) -> GroundTruth:
    """Write FOLDER/NAME.glb, one mesh without names, with its truth beside it in FOLDER/truth; return the truth."""
    name = f"{thing}_{style}_{number:02d}"
    mesh, record = folder / f"{name}.glb", folder / "truth" / f"{name}.json"
    if not record.exists():
        model = Model(np.random.default_rng([seed, crc32(f"{thing} {style}".encode()), number]))
        BUILDERS[thing, style](model)
        model = left_by_an_artist(model) if style == "designed" else model
        record.parent.mkdir(parents=True, exist_ok=True)
        numbers = {BASE: 0, **{part: k + 1 for k, part in enumerate(model.joints)}}
        whole = together([s for _, s in model.pieces]).apply_transform(TO_Y_UP)
        whole.visual = trimesh.visual.TextureVisuals(material=trimesh.visual.material.PBRMaterial(name="material_0"))
        np.save(record.with_suffix(".npy"), np.concatenate([np.full(len(s.faces), numbers[p]) for p, s in model.pieces]))
        trimesh.Scene({"mesh_0": whole}).export(mesh)
        record.write_text(json.dumps(_truth(model, name)), encoding="utf-8")
    return read_ground_truth(record, mesh)


def _truth(model: Model, name: str) -> dict[str, object]:
    """Return parts and joints in the coordinates of the file."""
    R = TO_Y_UP[:3, :3]
    joints = [
        {
            "child": part,
            "parent": j.parent,
            "type": j.type,
            "origin": (R @ j.origin).tolist(),
            "axis": (R @ j.axis).tolist(),
            "limits": j.limits,
        }
        for part, j in model.joints.items()
    ]
    parts = [{"name": BASE, "label": "base"}, *({"name": part, "label": part} for part in model.joints)]
    return {"name": name, "parts": parts, "joints": joints}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--count", type=int, default=16, help="objects of each thing and style")
    options = parser.parse_args()
    for thing, style in BUILDERS:
        for number in range(options.count):
            write_object(thing, style, number, options.folder / f"{thing}_{style}")


if __name__ == "__main__":
    main()
