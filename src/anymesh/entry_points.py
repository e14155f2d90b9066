"""What is found by name: the core (see docs/architecture.md) imports nothing of the packages around it.

A place is MODULE:NAME, relative to this package.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

# What readers of meshes need.
DRACO = "formats.gltf.compressed_:draco_attributes"
MESHOPT = "formats.gltf.compressed_:meshopt"
GLTF_JOINTS = "formats.gltf.joints:stated_joints"

# What the pipeline needs of the packages around it.
OPEN_ANSWERER = "prompted.answerers.answering:open_answerer"
STATED_PARTS = "stated.stages:parts_with_stated"
SEALED = "sunken.drawing:sealed"
DRAWN_OUT = "sunken.drawing:drawn_out"
TELLING_PIVOTS = "stated.pivots:with_telling_pivots"
STATED_JOINTS = "stated.stages:joints_with_stated"
PROMPTED_STAGES = "prompted.stages:PromptedStages"
WRITE_TRANSCRIPT = "prompted.answerers.recordings:write_transcript"
REMOVE_TRANSCRIPT = "prompted.answerers.recordings:remove_transcript"

# Readers of formats by suffix, and what is said of formats that nothing reads.
READERS = {
    **dict.fromkeys((".glb", ".gltf"), "formats.gltf.scene:read_gltf"),
    ".obj": "formats.obj:read_obj",
    ".ply": "formats.ply:read_ply",
    ".stl": "formats.off_stl:read_stl",
    ".off": "formats.off_stl:read_off",
    ".dae": "formats.dae.document:read_dae",
    **dict.fromkeys((".usd", ".usda", ".usdc", ".usdz", ".fbx", ".3mf", ".step", ".stp"), "formats.reading:read_isolated"),
}
CREDITS = "formats.credits:credits_of"
DAE_FRAME = "formats.dae.document:dae_frame"
LOAD_ZIPPED = "formats.zipped:load_zipped"
REMEDY = "formats.advice:remedy"
ADVISE = "formats.advice:advise"
ADVISE_ON_CONTENT = "formats.advice:advise_on_content"

# The writers of URDF, MJCF, USD and SDF, the visuals of DAE, and the physics of glTF.
WRITE_URDF = "formats.robot.urdf:write_urdf"
WRITE_MJCF = "formats.robot.mjcf_:write_mjcf"
WRITE_USD = "openusd.writer_:write_usd"
WRITE_USDZ = "openusd.writer_:write_usdz"
WRITE_SIMREADY = "openusd.simready_:write_simready"
LOAD_USD = "openusd.writer_:load_usd"
WRITE_SDF = "formats.robot.sdf:write_sdf"
WRITE_DAE = "formats.dae.writing:write_dae"
GLTF_PHYSICS = "formats.gltf.physics:add_physics"

# An asset as a project's loader wants it, as a ROS 2 package and as a zip.
WRITE_TARGET = "formats.targets.writing:write_target"
WRITE_PACKAGE = "formats.packed:write_package"
CHECK_ZIP = "formats.packed:check_zip"
WRITE_ZIP = "formats.packed:write_zip"

# What is usual for a kind of object: its bodies, with doubts about size and mass, its size, and its moving parts.
USUAL_BODIES = "kinds.bodies:usual_bodies"
USUAL_SIZE = "kinds.usual:usual_size"
USUAL_PARTS = "kinds.moving_parts:usual_parts"
DESCRIBED = "kinds.pieces:described"

# Resistance, springs, catches, detents, closed loops, handles and states of joints.
CHOOSE_MECHANISMS = "mechanisms.choosing:choose_mechanisms"
RESISTANCES = "mechanisms.resisting:resistances"
CLOSED = "mechanisms.closing:closed_over"
LED_TRACKS = "mechanisms.closing:led_tracks"
HANDLE_FRAMES = "mechanisms.handles:handle_frames"
TOGETHER = "mechanisms.following:together"
WITH_GEARS = "mechanisms.meshing:with_gears"
PARSE_MECHANISMS = "mechanisms.choosing:parse_mechanisms"
NAMED_STATES = "mechanisms.states:named_states"
PLACES = "mechanisms.places:find_places"

# Scenes of several objects.
SCENE_WARNING = "applications.scenes.objects:scene_warning"
ARTICULATE_SCENE = "applications.scenes.command_line:articulate_scene"

# How a part moves, in words, and how else it may move; joints that are too unsure to be written.
MOTION_WORDS = "correcting.motions:motion_words"
WITH_OTHERS = "correcting.articulations:with_others"
SAMPLES = "correcting.sampling:Variants"
WITH_PROPOSALS = "correcting.proposals:with_proposals"
PROBABILITY = "correcting.proposals:probability"

# What an asset shows of itself in a notebook.
ASSET_HTML = "viewer.report:asset_html"
REGISTER_IN_IPYTHON = "viewer.report:register"

# `anymesh eval --protocol interaction` is one of the applications.
EVALUATE_INTERACTION = "applications.policy.interaction_:evaluate_interaction"
INTERACTION_SUMMARY = "applications.policy.interaction_:summary"

# The names of `import anymesh`.
API = {
    **dict.fromkeys(("articulate", "segment", "joints", "export_asset"), "pipeline.api"),
    **dict.fromkeys(("Asset", "Joint", "JointType", "Mesh", "Part", "Segmentation"), "types"),
    "finish": "finishing.finishing",
    "check_asset": "checking",
    "generate": "applications.generate",
    "make_env": "applications.policy.env_",
    "plan": "applications.plan",
    "scan": "applications.scan",
    "articulate_scene": "applications.scenes",
    "show": "viewer.report",
    "load": "correcting.editable",
}

# The commands, in the order of `anymesh --help`.
COMMANDS = {
    "articulate": "cli.commands:articulate",
    "generate": "applications.generate.command_line:generate",
    "annotate": "applications.annotate.command_line:annotate",
    "segment": "cli.commands:segment",
    "joints": "cli.commands:joints",
    "export": "cli.commands:export",
    "answer": "prompted.command_line:answer",
    "models": "prompted.command_line:models",
    "mcp": "agents.command_line:mcp",
    "skill": "agents.command_line:skill",
    "correct": "correcting.command_line:correct",
    "finish": "finishing.command_line:finish",
    "scan": "applications.scan.command_line:scan",
    "report": "viewer.command_line:report",
    "picture": "viewer.command_line:picture",
    "view": "viewer.command_line:view",
    "plan": "applications.plan.command_line:plan",
    "grasps": "applications.grasps.command_line:grasps",
    "train": "applications.policy.command_line:train",
    "check": "checking.command_line:check",
    "diff": "checking.command_line:diff",
    "eval": "evaluation.command_line:evaluate",
}


RESUMED = ("annotate", "generate", "eval")  # these keep what is done when they are interrupted


def resolve(place: str) -> Any:
    """Import what stands at a place."""
    module, _, name = place.partition(":")
    return getattr(import_module(f"anymesh.{module}"), name)


def on_first_use(package: str, homes: dict[str, str]) -> Callable[[str], Any]:
    """Return the `__getattr__` of a package, which imports the module that holds a name when the name is first used.

    homes: name -> module within the package. So the command line can read a package's options without its libraries.
    """

    def find(name: str) -> Any:
        if name in homes:
            return getattr(import_module(f"{package}.{homes[name]}"), name)
        raise AttributeError(f"module {package!r} has no attribute {name!r}")

    return find
