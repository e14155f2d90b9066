#!/usr/bin/env bash
# Guess: damping of a joint takes energy out, so at worst a strongly damped knob turns too slowly.
# Truth: PhysX (viscous friction of an articulation joint) and PyBullet (damping) apply it explicitly. Once damping * step / inertia
#   is well above 1, the knob does not move in PhysX at any torque, while its velocity reads as the joint's limit, and jumps
#   between -100 and 100 rad/s in PyBullet. A drive with the same damping and no stiffness is implicit in PhysX, and right.
# Version: ovphysx 0.7.0 (the PhysX of Isaac Sim, on the CPU), pybullet 3.2.7
# Source: found by running
# Who cares: knobs, buttons and toy wheels, here of 3e-6 kg m2 with 0.1 N m s/rad. Keep damping / 60 / inertia below 1.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check ovphysx==0.7.0.74035321 physx-usd-schemas==25.11.2.72696984 \
  newton-usd-schemas==0.6.0 pybullet==3.2.7
cat > knob.py <<'PY'
import sys

import numpy as np
import ovphysx
import ovstage
from ovphysx.samples.python_samples.schema_support import physx_schema_paths
from ovphysx.types import ObjectScope, SimObjectType

DEGREE = np.pi / 180
JOINT = {"scope": ObjectScope.ALL}
axis, drive = "float physxJointAxis:angular:", "float drive:angular:physics:"
top = f"{axis}maxJointVelocity = {2 / DEGREE}"
api, lines, told = {
    "friction": ("PhysxJointAxisAPI", [f"{axis}viscousFrictionCoefficient = {0.1 * DEGREE}", top], (0, 2)),
    "drive": ("PhysicsDriveAPI", [f"{drive}damping = {0.1 * DEGREE}"], (1, 0.5)),
}[sys.argv[1]]


def prim(kind, name, apis, *lines):
    applied = f" (\nprepend apiSchemas = [{', '.join(apis)}]\n)" if apis else ""
    return "\n".join([f'def {kind} "{name}"{applied}', "{", *lines, "}"])


def body(name, mass, inertia):
    value = f"float3 physics:diagonalInertia = ({inertia}, {inertia}, {inertia})"
    return prim("Xform", name, ['"PhysicsRigidBodyAPI"', '"PhysicsMassAPI"'], f"float physics:mass = {mass}", value)


ends = [f"rel physics:body{k} = </Knob/{name}>" for k, name in enumerate(("base", "knob"))] + ['uniform token physics:axis = "Z"']
parts = [
    body("base", 1, 0.1),
    body("knob", 0.014, 3e-6),
    prim("PhysicsFixedJoint", "weld", [], "rel physics:body1 = </Knob/base>"),
    prim("PhysicsRevoluteJoint", "turn", [f'"{api}:angular"'], *ends, *lines),
]
with open("knob.usda", "w") as file:
    header = '#usda 1.0\n(\nmetersPerUnit = 1\nkilogramsPerUnit = 1\nupAxis = "Z"\n)'
    scene = prim("PhysicsScene", "scene", [], "float physics:gravityMagnitude = 0")
    file.write("\n".join([header, scene, prim("Xform", "Knob", ['"PhysicsArticulationRootAPI"'], *parts)]))
ovphysx.PhysX.set_cpu_mode(True)
physx = ovphysx.PhysX()
ovstage.population.register_usd_schemas([*map(str, physx_schema_paths()), str(ovphysx.newton_schema_root())])
stage = ovstage.Stage("knob")
ovstage.population.open_usd(stage, "knob.usda", ordinal=1, domains=ovstage.PopulationDomain.ALL)
stage.advance_write_floor(ordinal=1).wait()
physx.wait_task(physx.attach_ovstage(stage, read_ordinal=1))
for _ in range(120):
    with physx.write_sync(SimObjectType.ARTICULATION_JOINT, "jointActuationForce", **JOINT) as session:
        for group in session.groups:
            group.tensors[0].assign(np.full(group.tensors[0].shape, 0.05, np.float32))
            session.commit_sync(group)
    physx.step_sync(1 / 60)
found = []
for name in ("jointPosition", "jointVelocity"):
    with physx.read_sync(SimObjectType.ARTICULATION_JOINT, [name], **JOINT) as result:
        found.append(float(result.groups[0].tensors[0].numpy()[0]) * DEGREE)
after = f"after 2 s under 0.05 N m at {found[0]:.3f} rad, {found[1]:.2f} rad/s (right: 1.0, 0.5)"
print("ovphysx", ovphysx.__version__, f"{sys.argv[1]}: {after}")
sys.exit(not np.allclose(found, told, atol=0.01))
PY
for kind in friction drive; do venv/bin/python knob.py "$kind" 2> /dev/null || { echo "changed: see above"; exit 1; }; done
venv/bin/python - <<'PY'
from importlib.metadata import version

import pybullet

with open("knob.urdf", "w") as file:
    inertial = '<inertial><mass value=".014"/><inertia ixx="3e-6" iyy="3e-6" izz="3e-6" ixy="0" ixz="0" iyz="0"/></inertial>'
    file.write(f"""<robot name="r"><link name="base"/><link name="knob">{inertial}</link><joint name="turn" type="continuous">
        <parent link="base"/><child link="knob"/><axis xyz="0 0 1"/><dynamics damping="0.1" friction="0"/></joint></robot>""")
pybullet.connect(pybullet.DIRECT)
robot = pybullet.loadURDF("knob.urdf", useFixedBase=True, flags=pybullet.URDF_USE_INERTIA_FROM_FILE)
pybullet.setJointMotorControl2(robot, 0, pybullet.VELOCITY_CONTROL, force=0)
pybullet.resetJointState(robot, 0, 0.0, 0.01)
speeds = []
for _ in range(240):
    pybullet.stepSimulation()
    speeds.append(round(pybullet.getJointState(robot, 0)[1], 1))
print("pybullet", version("pybullet"), f"left alone at 0.01 rad/s: after 1 s {speeds[-2:]} rad/s (right: 0)")
if sorted(speeds[-2:]) != [-100, 100]:
    raise SystemExit("changed: see above")
PY
