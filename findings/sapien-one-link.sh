#!/usr/bin/env bash
# Guess: a URDF of one link, such as a bookcase without doors, is loaded by SAPIEN's URDF loader as an articulation without joints.
# Truth: `load` raises "URDF contains multiple objects, call load_multiple instead", as for several robots in one file. What
#   `load_multiple` returns is no articulation but an actor: a free body, whatever `fix_root_link` says.
# Version: sapien 3.0.3
# Source: found by running; sapien/wrapper/urdf_loader.py, load: it refuses every file with an actor.
# Who cares: users of SAPIEN and ManiSkill who load a mixed set of assets in a loop. Use load_multiple, and make the actor kinematic.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check sapien==3.0.3
cat > bookcase.urdf <<'XML'
<robot name="bookcase">
  <link name="base">
    <inertial><mass value="9"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="1 .3 2"/></geometry></collision>
  </link>
</robot>
XML
venv/bin/python -W ignore - <<'PY'
import sapien

scene = sapien.Scene([sapien.physx.PhysxCpuSystem()])
loader = scene.create_urdf_loader()
loader.fix_root_link = True
print("sapien", sapien.__version__)
try:
    loader.load("bookcase.urdf")
    refused = False
except Exception as error:
    refused = "multiple objects" in str(error)
    print("  load raises:", error)
articulations, (bookcase,) = loader.load_multiple("bookcase.urdf")
for _ in range(100):
    scene.step()
height = float(bookcase.pose.p[2])
print(f"  load_multiple: {len(articulations)} articulations, one actor, which fell to {height:.1f} m in a second with fix_root_link")
if not refused or articulations or height > -1:
    raise SystemExit("changed: see above")
PY
