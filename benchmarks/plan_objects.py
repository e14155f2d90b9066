"""The true objects of the planning scenarios: the shipped drill and microwave, and a steering wheel, with exact joints.

The steering wheel is built here (it is no example, as sets of examples are trained and reported on): a wheel of three spokes
on a column that leans towards the driver, clamped to a box.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np

from anymesh.evaluation.ground_truth import GroundTruth, read_ground_truth

ROOT = Path(__file__).parents[1]
EXAMPLES = ROOT / "examples"
LEAN = 35.0  # [deg] of the wheel's axis from the horizontal
RADIUS, TUBE, HUB = 0.16, 0.012, np.array([0.0, -0.06, 0.33])  # [m] of the rim; where the hub is


def steering_wheel():
    """The wheel as a `Thing` of examples/objects.py [m, Z up, the driver at -Y]."""
    sys.path.insert(0, str(EXAMPLES))
    try:
        from objects import Thing, spin
        from solids import box, cut, join, moved, ring, rod, turned
    finally:
        sys.path.remove(str(EXAMPLES))
    up, away = np.sin(np.deg2rad(LEAN)), np.cos(np.deg2rad(LEAN))
    axis = np.array([0.0, -away, up])
    t = Thing("steering_wheel", "steering wheel")

    def placed(solid):
        """From the wheel's own frame, its axis along z, to where it is."""
        return moved(turned(solid, (1, 0, 0), 90 - LEAN, (0, 0, 0)), tuple(HUB))

    t.add("base", box((-0.12, 0.12), (0.03, 0.23), (0.0, 0.2)))
    t.add("base", placed(rod("z", 0.018, 0.16, (0, 0, -0.1))), color="dark")
    hub = cut(rod("z", 0.035, 0.03, (0, 0, 0), 40), rod("z", 0.0085, 0.1, (0, 0, 0), 24))
    t.add("base", placed(rod("z", 0.008, 0.06, (0, 0, -0.01), 24)), color="metal")
    spokes = [turned(box((0.03, RADIUS), (-0.011, 0.011), (-0.005, 0.005)), (0, 0, 1), a, (0, 0, 0)) for a in (0, 180, 270)]
    t.add("wheel", placed(join(ring("z", RADIUS, TUBE, (0, 0, 0)), hub, *spokes)), color="dark")
    t.joints["wheel"] = spin(tuple(HUB), tuple(axis), "wheel")
    return t


def true_object(name: str, folder: Path) -> GroundTruth:
    """The mesh file of an object and its truth; the steering wheel is written into a folder."""
    if name != "steering_wheel":
        return read_ground_truth(EXAMPLES / "truth" / f"{name}.json", EXAMPLES / "meshes" / f"{name}.glb")
    sys.path.insert(0, str(EXAMPLES))
    try:
        from build import build, truth
    finally:
        sys.path.remove(str(EXAMPLES))
    thing = steering_wheel()
    data, labels = build(thing)
    folder.mkdir(parents=True, exist_ok=True)
    mesh = folder / f"{name}.glb"
    mesh.write_bytes(data)
    (folder / f"{name}.json").write_text(json.dumps(truth(thing), indent=1), encoding="utf-8")
    np.save(folder / f"{name}.npy", labels)
    return read_ground_truth(folder / f"{name}.json", mesh)
