#!/usr/bin/env bash
# Guess: a drive of UsdPhysics whose target lies beyond a limit presses the joint against that limit, as in PhysX: a spring with preload.
# Truth: Newton replaces such a target by the middle of the range without a word, so a button is pressed halfway and a door half open.
#   `mjc:springref` with `mjc:stiffness` is kept as it is.
# Version: newton 1.8.0
# Source: JointDofConfig in newton/_src/sim/builder.py, and by running
# Who cares: everyone who writes a preloaded spring as a drive: buttons, self-closing doors, grippers that squeeze.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check "newton[sim]==1.8.0" usd-core==26.11
cat > door.usda <<'USD'
#usda 1.0
(defaultPrim = "door"
metersPerUnit = 1
kilogramsPerUnit = 1
upAxis = "Z")
def PhysicsScene "scene" {}
def Xform "door" (prepend apiSchemas = ["PhysicsArticulationRootAPI"])
{
    def Xform "frame" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 1
        float3 physics:diagonalInertia = (1, 1, 1)
    }
    def Xform "leaf" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 1
        float3 physics:diagonalInertia = (1, 1, 1)
    }
    def PhysicsFixedJoint "weld"
    {
        rel physics:body1 = </door/frame>
    }
    def PhysicsRevoluteJoint "hinge" (prepend apiSchemas = ["PhysicsDriveAPI:angular", "MjcJointAPI"])
    {
        rel physics:body0 = </door/frame>
        rel physics:body1 = </door/leaf>
        uniform token physics:axis = "Z"
        float physics:lowerLimit = 0
        float physics:upperLimit = 100
        float drive:angular:physics:stiffness = 1
        float drive:angular:physics:targetPosition = -20
        double mjc:stiffness = 2
        double mjc:springref = -20
    }
}
USD
venv/bin/python - <<'PY' 2> /dev/null
import newton
import numpy as np
import warp as wp

wp.config.quiet = True
builder = newton.ModelBuilder()
newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
builder.add_usd("door.usda")
model = builder.finalize(device="cpu")
target, rest = (float(np.rad2deg(v.numpy()[-1])) for v in (model.joint_target_q, model.joint_rest_q))
print("newton", newton.__version__, f"target of the drive {target:.0f} degrees (stated -20), rest of the spring {rest:.0f}")
raise SystemExit(not (abs(target - 50) < 1 and abs(rest + 20) < 1))
PY
