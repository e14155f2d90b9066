#!/usr/bin/env bash
# Guess: loadURDF reads the file, so an asset that was written again under the same name is loaded anew, at the latest after
#   resetSimulation().
# Truth: files are cached by name for as long as the connection lasts, the URDF as well as its meshes; resetSimulation() keeps them.
#   setPhysicsEngineParameter(enableFileCaching=0), or another connection, reads them again.
# Version: pybullet 3.2.7
# Source: found by running; github.com/cram2/pycram/pull/34 turns the cache off for the same reason
# Who cares: everyone who exports, looks, corrects and exports again in one notebook: the correction seems to do nothing.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check pybullet==3.2.7 numpy==2.4.6
venv/bin/python - <<'PY'
from importlib.metadata import version

import pybullet


def write(mass):
    inertia = '<inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/>'
    with open("block.urdf", "w") as file:
        file.write(f'<robot name="r"><link name="a"><inertial><mass value="{mass}"/>{inertia}</inertial></link></robot>')


def mass():
    return pybullet.getDynamicsInfo(pybullet.loadURDF("block.urdf"), -1)[0]


pybullet.connect(pybullet.DIRECT)
write(1)
found = {"mass 1 written": mass()}
write(2)
found["mass 2 written"] = mass()
pybullet.resetSimulation()
found["mass 2, after resetSimulation()"] = mass()
pybullet.setPhysicsEngineParameter(enableFileCaching=0)
found["mass 2, with enableFileCaching=0"] = mass()
print("pybullet", version("pybullet"))
for name, value in found.items():
    print(f"  {name}: read {value:g}")
if list(found.values()) != [1, 1, 1, 2]:
    raise SystemExit("changed: see above")
PY
