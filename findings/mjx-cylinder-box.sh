#!/usr/bin/env bash
# Guess: MJX (MuJoCo on JAX) takes the same collision shapes as MuJoCo, or leaves out the pairs that it cannot handle.
# Truth: one cylinder and one box (or convex mesh) that could meet make put_model refuse the whole model, wherever they are and
#   whether they touch or not. A cylinder with a cylinder, a plane, a sphere or a capsule is fine, and so is a mesh with a box.
# Version: mujoco-mjx 3.17.0, mujoco 4.0.0
# Source: mujoco.readthedocs.io/en/stable/mjx.html, "Feature parity"
# Who cares: everyone who trains in MJX on assets with cylinders (wheels, knobs) and boxes: write one of them as a hull.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check mujoco-mjx==3.17.0 mujoco==4.0.0 jax==0.10.2
JAX_PLATFORMS=cpu venv/bin/python - 2> /dev/null <<'PY'
from importlib.metadata import version

import mujoco
from mujoco import mjx

SHAPES = {
    "cylinder": 'type="cylinder" size=".1 .1"',
    "box": 'type="box" size=".1 .1 .1"',
    "mesh": 'type="mesh" mesh="hull"',
    "sphere": 'type="sphere" size=".1"',
    "capsule": 'type="capsule" size=".1 .1"',
}
HULL = '<asset><mesh name="hull" vertex="0 0 0 1 0 0 0 1 0 0 0 1 1 1 1"/></asset>'


def accepted(first, second):
    """Return whether MJX takes a model with two shapes that are 9 m apart."""
    bodies = f'<geom {SHAPES[first]}/><body pos="9 0 0"><freejoint/><geom {SHAPES[second]}/></body>'
    model = mujoco.MjModel.from_xml_string(f"<mujoco>{HULL}<worldbody>{bodies}</worldbody></mujoco>")
    try:
        mjx.put_model(model)
    except NotImplementedError:
        return False
    return True


pairs = [("cylinder", name) for name in SHAPES] + [("box", "mesh")]
found = {pair: accepted(*pair) for pair in pairs}
print("mujoco-mjx", version("mujoco-mjx"))
for pair, taken in found.items():
    print("  " + " and ".join(pair) + ": " + ("accepted" if taken else "NotImplementedError"))
if [pair for pair, taken in found.items() if not taken] != [("cylinder", "box"), ("cylinder", "mesh")]:
    print("changed: see above")
    raise SystemExit(1)
PY
