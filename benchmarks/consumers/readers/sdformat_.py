"""libsdformat, the parser of Gazebo, by a small C++ program, since its Python bindings are in no package of pip that works.

Needs g++, pkg-config and libsdformat-dev, or SDFORMAT with the name of the library for pkg-config.
"""

from __future__ import annotations

import os
import subprocess
import tempfile
from functools import cache
from pathlib import Path

import numpy as np
from common import Asset, finite, frame, placed, serve, turn_of

KINDS = {"1": "ball", "2": "continuous", "3": "fixed", "5": "prismatic", "6": "revolute"}  # sdf::JointType
FOLDER = tempfile.TemporaryDirectory()


@cache
def program() -> str:
    """Build the program."""
    name = os.environ.get("SDFORMAT", "sdformat12")
    asked = subprocess.run(["pkg-config", "--cflags", "--libs", name], capture_output=True, text=True, check=True)
    built, source = str(Path(FOLDER.name) / "sdformat"), str(Path(__file__).with_suffix(".cpp"))
    subprocess.run(["g++", "-std=c++17", "-o", built, source, *asked.stdout.split()], check=True)
    return built


def pose(values: list[float]) -> np.ndarray:
    return frame(values[:3], turn_of(*values[3:7]))


def read(asset: Asset, variant: str) -> dict:
    done = subprocess.run([program(), str(asset.file("sdf"))], capture_output=True, text=True, check=False)
    links, joints, version = {}, {}, ""
    for kind, name, *rest in (line.split() for line in done.stdout.splitlines()):
        if kind == "version":
            version = name
        elif kind == "link":
            v = [float(x) for x in rest]
            mass, xx, yy, zz, xy, xz, yz = v[14:]
            at, tensor = pose(v[7:14]), np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            links[name] = placed(pose(v[:7]), mass, at[:3, 3], tensor, at[:3, :3])
        elif rest[1] != "world":
            v = [float(x) for x in rest[3:]]
            record = joints[name] = {"type": KINDS.get(rest[0], rest[0]), "parent": rest[1], "child": rest[2]}
            if record["type"] == "fixed":
                continue
            record |= {"origin": v[:3], "axis": v[7:10], "limits": finite(v[10], v[11])}
            if record["type"] == "revolute" and record["limits"] is None:
                record["type"] = "continuous"
            record |= dict(zip(("effort", "velocity", "damping", "friction", "stiffness", "reference"), v[12:18], strict=True))
    said = done.stderr.splitlines()
    return {"version": f"libsdformat {version}", "said": said, "joints": joints, "links": links}


serve(read)
