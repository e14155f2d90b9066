#!/usr/bin/env bash
# Guess: a Drake plant with time_step=0 is the same plant with a more accurate integrator; limits and mimic joints hold.
# Truth: in continuous time a joint runs through its limits, and nothing says so. A mimic joint is accepted by the parser and by
#   Finalize(); the first step then raises. In discrete time both work (mimic with the contact approximations of the SAP solver).
# Version: drake 1.51.1
# Source: github.com/RobotLocomotion/drake/pull/9111 (limits), github.com/RobotLocomotion/drake/issues/24957 (constraints)
# Who cares: everyone who loads an asset with AddMultibodyPlantSceneGraph(builder, time_step=0) and wonders why doors never stop.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check drake==1.51.1
venv/bin/python - <<'PY'
import logging
from importlib.metadata import version

import numpy as np
from pydrake.all import AddMultibodyPlantSceneGraph, DiagramBuilder, Parser, Simulator

INERTIAL = '<inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>'
logged = []
logging.getLogger("drake").addHandler(type("Keep", (logging.Handler,), {"emit": lambda self, r: logged.append(r.getMessage())})())


def turn(name, child, mimic=""):
    limit = '<limit lower="-.5" upper=".5" effort="9" velocity="9"/>'
    ends = f'<parent link="base"/><child link="{child}"/><axis xyz="0 0 1"/>'
    return f'<link name="{child}">{INERTIAL}</link><joint name="{name}" type="revolute">{ends}{limit}{mimic}</joint>'


def simulate(joints, velocities, duration, time_step):
    """Return the joint positions after a duration without forces; or the error of the first step."""
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, time_step=time_step)
    Parser(plant).AddModelsFromString(f'<robot name="r"><link name="base">{INERTIAL}</link>{joints}</robot>', "urdf")
    plant.WeldFrames(plant.world_frame(), plant.GetFrameByName("base"))
    plant.Finalize()
    simulator = Simulator(builder.Build())
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.SetVelocities(context, velocities)
    try:
        simulator.AdvanceTo(duration)
    except RuntimeError as error:
        return str(error).split(". ")[1]
    return np.round(plant.GetPositions(context), 3).tolist()


door = turn("hinge", "door")
pair = turn("left", "a") + turn("right", "b", '<mimic joint="left" multiplier="2" offset="0"/>')
found = {}
for step in (0.0, 0.001):
    found["limit of 0.5 after 3 s at 1 rad/s", step] = simulate(door, [1.0], 3.0, step)
    found["mimic after 1 s at 0.1 and 0.2 rad/s", step] = simulate(pair, [0.1, 0.2], 1.0, step)
print("drake", version("drake"))
for (name, step), result in found.items():
    print(f"  {name}, time_step {step}: {result}")
print("  logged:", logged)
limits, mimics = ([result for (name, _), result in found.items() if name.startswith(word)] for word in ("limit", "mimic"))
as_told = limits[0][0] > 2.9 and abs(limits[1][0] - 0.5) < 0.01 and not logged
if not as_told or "does not support constraints" not in mimics[0] or abs(mimics[1][1] - 0.2) > 0.01:
    raise SystemExit("changed: see above")
PY
