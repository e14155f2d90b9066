#!/usr/bin/env bash
# Guess: a URDF joint of type "floating" starts where its <origin> says, and keeps its name.
# Truth: Drake drops the joint: the link becomes a free body at the world's origin, and its joint has the link's name; a warning
#   says that the type is not supported, not that the origin is lost. Newton keeps the name, but sets the joint's coordinates
#   so that the link begins at the world's origin too.
# Version: drake 1.51.1, newton 1.8.0
# Source: Drake's warning; the rest found by running.
# Who cares: loose lids and other parts that lift off: they lie inside the base when the scene begins.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check drake==1.51.1 newton==1.8.0
cat > pot.urdf <<'XML'
<robot name="pot">
  <link name="base">
    <inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="lid">
    <inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="lift_off" type="floating">
    <origin xyz="0.1 0.2 0.3"/><parent link="base"/><child link="lid"/>
  </joint>
</robot>
XML
venv/bin/python - <<'PY'
from importlib.metadata import version

from pydrake.all import MultibodyPlant, Parser

plant = MultibodyPlant(time_step=0.001)
Parser(plant).AddModels("pot.urdf")
plant.WeldFrames(plant.world_frame(), plant.GetFrameByName("base"))
plant.Finalize()
names = [plant.get_joint(k).name() for k in plant.GetJointIndices()]
place = plant.EvalBodyPoseInWorld(plant.CreateDefaultContext(), plant.GetBodyByName("lid")).translation().tolist()
print("drake", version("drake"), "file: joint lift_off at (0.1, 0.2, 0.3)")
print("  joints:", names, "lid at", place)
if "lift_off" in names or "lid" not in names or any(place):
    raise SystemExit("changed: see above")
PY
venv/bin/python - <<'PY'
import newton
import numpy as np
import warp

warp.config.quiet = True
builder = newton.ModelBuilder()
builder.add_urdf("pot.urdf", floating=False)
model = builder.finalize(device="cpu")
state = model.state()
newton.eval_fk(model, model.joint_q, model.joint_qd, state)
names = [label.rsplit("/", 1)[-1] for label in builder.joint_label]
place = state.body_q.numpy()[[label.endswith("lid") for label in builder.body_label].index(True), :3]
print("newton", newton.__version__)
print("  joints:", names, "lid at", np.round(place, 3).tolist(), "coordinates", np.round(model.joint_q.numpy(), 3).tolist())
if "lift_off" not in names or np.abs(place).max() > 1e-6:
    raise SystemExit("changed: see above")
PY
