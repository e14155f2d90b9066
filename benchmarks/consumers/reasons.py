"""Why a consumer does not hold a value as written: (consumer and format, or consumer; property) -> one line for the page."""

from __future__ import annotations

_NO_PHYSICS = "viewers pass over the physics of glTF: types are in `extras`, axes and limits in the animation too"
_NO_VELOCITY = "MuJoCo and its MJCF have no limit of velocity; Newton then holds 1e6"
_NO_JOINTS = "three.js and Blender read neither joints nor masses of USD"
_SAPIEN = "SAPIEN [does not read it](../findings/sapien-friction-effort.sh): friction .05, velocity 100, effort without limit"
_DRAKE_ACTUATOR = "Drake has effort and armature of actuators alone, and the URDF of passive joints has no actuator"
_URDF_VIEWER = "urdf-loader reads types, axes, limits, effort and velocity alone"
_NO_ARMATURE = "URDF and SDFormat have no armature"
_NUMBERS = ("friction", "damping", "effort", "velocity", "armature")
_WITHOUT_ARMATURE = ("MuJoCo, URDF", "Newton, URDF", "SAPIEN", "PyBullet", "Drake, SDF", "Pinocchio", "Genesis", "libsdformat")
_NO_SPRINGS = "neither URDF, glTF nor UsdPhysics has springs, and Drake reads none of SDFormat"
_WITHOUT_SPRINGS = (
    "MuJoCo, URDF", "Newton, URDF", "SAPIEN", "ManiSkill", "PyBullet",
    "Drake", "Pinocchio", "Genesis", "OpenUSD", "Blender", "three.js",
)  # fmt: skip
_SCHEMAS = "UsdPhysics has none; the value is in the schemas of PhysX and Newton, which OpenUSD keeps as plain attributes"
REASONS = {
    ("MuJoCo", "velocity"): _NO_VELOCITY,
    ("Newton, MJCF", "velocity"): _NO_VELOCITY,
    ("robosuite", "velocity"): _NO_VELOCITY,
    ("RoboCasa", "velocity"): _NO_VELOCITY,
    **{(consumer, name): _SAPIEN for consumer in ("SAPIEN", "ManiSkill") for name in ("friction", "effort", "velocity")},
    ("PyBullet", "masses"): "PyBullet gives a fixed base no mass",
    ("PyBullet", "inertia"): "PyBullet gives a fixed base no mass",
    ("Drake", "friction"): "Drake has no friction of joints; of URDF it warns",
    ("Drake, URDF", "effort"): _DRAKE_ACTUATOR,
    ("Drake, URDF", "armature"): _DRAKE_ACTUATOR,
    ("Genesis", "velocity"): "Genesis has no limit of velocity",
    ("OpenUSD", "friction"): _SCHEMAS,
    ("OpenUSD", "damping"): _SCHEMAS,
    ("OpenUSD", "velocity"): _SCHEMAS,
    ("OpenUSD", "armature"): _SCHEMAS,
    ("Blender, USD", "types"): _NO_JOINTS,
    ("Blender, USD", "masses"): _NO_JOINTS,
    ("three.js, USD", "types"): _NO_JOINTS,
    **{("three.js, URDF", name): _URDF_VIEWER for name in ("friction", "damping", "armature")},
    **{(consumer, name): _NO_PHYSICS for consumer in ("Blender, GLB", "three.js, GLB") for name in _NUMBERS},
    **{(consumer, "springs"): _NO_SPRINGS for consumer in _WITHOUT_SPRINGS},
    **{(consumer, "armature"): _NO_ARMATURE for consumer in _WITHOUT_ARMATURE},
}
_VARIANT = "with the variant of this engine enabled, which SimReady wants disabled at first; without it, the joints have none"
_NOT_APPLIED = "held, but [not applied](../findings/resistance-read-not-applied.sh)"
_EXPLICIT = "applied [explicitly](../findings/light-link-damping.sh): the joint must not be light"
NOTES = {
    **{(f"{c}, SimReady", n): _VARIANT for c in ("Newton", "PhysX") for n in ("friction", "velocity")},
    ("three.js, USD", "drawn"): "besides, it [draws the hulls](../findings/three-usd-hidden.sh)",
    ("PyBullet", "friction"): _NOT_APPLIED,
    ("PyBullet", "damping"): _EXPLICIT,
    ("PhysX", "damping"): _EXPLICIT,
    ("Pinocchio", "friction"): _NOT_APPLIED,
    ("Pinocchio", "damping"): _NOT_APPLIED,
}
