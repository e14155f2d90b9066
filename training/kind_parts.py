"""Write the table of the moving parts of kinds of objects, `src/anymesh/kinds/moving_parts.json`.

python -m training.kind_parts FOLDER

FOLDER: objects as `labelled:FOLDER` of `anymesh eval` reads them, named KIND__NUMBER, with names of links, Z up.
"""

from __future__ import annotations

import argparse
import json
import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.evaluation.datasets.labelled import LABELS, MESH, RECORD
from anymesh.evaluation.datasets.meshes_ import read_visual
from anymesh.kinds.moving_parts import move_of
from anymesh.types import JointType
from anymesh.vocabulary import words_of

WRITTEN = Path(__file__).parents[1] / "src" / "anymesh" / "kinds" / "moving_parts.json"
MECHANISMS = re.compile(  # bare mechanisms, by which no user names an object, and a kind named by its whole description
    r"chain|module|tripodmounted|car_axles|stack|carriage|gripper|wrist|elbow|orthogonal|branching|gantry|single_|slider|slide\b|slide_with|telescoping_boom"
    r"|telescoping_mast|_axis|xyz_cartesian|rotary_base|rotary_table|vane_array|arm\b|create-a"
)
ABOUT = re.compile(r"_(?:with|on|and|to)_")  # what follows says what a kind has
PLACES = frozenset(
    "a b c d x y z i ii iii left right front rear back upper lower top bottom inner outer middle center main first "
    "second".split()
)
ALSO = {  # what else people call these kinds
    "articulated_task_lamp": "task_lamp desk_lamp",
    "benchtop_monocular_laboratory_microscope": "microscope",
    "box_fan": "fan",
    "tilting_fan": "fan",
    "bicycle_crankset": "crankset",
    "bicycle_dropper_seatpost_assembly": "seatpost",
    "candy_vending_machine": "vending_machine gumball_machine",
    "car_sunroof_cassette": "sunroof",
    "casino_machine": "slot_machine",
    "cctv_mast": "cctv cctv_camera",
    "ceiling_light_fixture": "ceiling_light",
    "centrifugal_juicer": "juicer",
    "crane_tower": "tower_crane",
    "desktop_pc_tower": "pc_tower desktop_pc computer_tower",
    "desktop_pencil_sharpener": "pencil_sharpener",
    "dj_equipment": "dj_controller dj_mixer",
    "drawer_cabinet": "cabinet",
    "drillpress_tilt_table": "drill_press",
    "drone": "quadcopter quadrotor",
    "electrical_cabinet_door": "electrical_cabinet",
    "fidget_toy": "fidget_spinner",
    "flatbed_scanner": "scanner",
    "floodlight_mast": "floodlight",
    "gear_assemblies": "gear_assembly gear_train gearbox",
    "graphics_card": "gpu",
    "hinged_window_or_hatch": "hatch",
    "hingeddoor_cabinet": "cabinet",
    "internet_router": "router wifi_router",
    "joystick_mechanism": "joystick",
    "louvered_shutter_assembly": "louvered_shutter shutter",
    "observation_wheel": "ferris_wheel",
    "orchestra_style_music_stand": "music_stand",
    "overear_headphones": "headphones",
    "overshot_waterwheel": "waterwheel water_wheel",
    "parabolic_dish": "satellite_dish",
    "pedal_trash_bin": "pedal_bin trash_bin trash_can",
    "playground_swing": "swing_set",
    "portable_speaker": "bluetooth_speaker",
    "range_hood": "cooker_hood extractor_hood",
    "remote": "remote_control",
    "retractable_utility_knife": "utility_knife box_cutter",
    "robotic_arms": "robotic_arm robot_arm",
    "robotic_leg": "robot_leg",
    "rolling_toolbox": "toolbox",
    "screwcap_bottle": "bottle",
    "screwin_light_bulb": "light_bulb",
    "searchlight_tower": "searchlight",
    "service_access_panel": "access_panel",
    "simple_aframe_step_ladder": "step_ladder",
    "simple_drying_rack": "drying_rack",
    "singleleaf_drawbridge": "drawbridge",
    "sliding_security_gate": "sliding_gate",
    "stationary_exercise_bike": "exercise_bike",
    "stick_vacuum": "stick_vacuum_cleaner",
    "stove_top": "cooktop hob",
    "studio_spotlight": "spotlight",
    "traditional_windmill": "windmill",
    "turntable": "record_player",
    "undershot_waterwheel": "waterwheel water_wheel",
    "wall_thermostat": "thermostat",
}
LEAST = 2  # objects of a kind that have a part with a name; other parts are "part"
QUANTILES = (0.1, 0.5, 0.9)


@dataclass(frozen=True)
class MovingPart:
    """A part. size: its diagonal over the object's; move: as in the table; range: [deg, or shares of the object's diagonal]."""

    name: str
    size: float
    move: str
    range: float | None


@dataclass(frozen=True)
class MovingObject:
    """An object. longest: its longest side [m]."""

    kind: str
    longest: float
    parts: tuple[MovingPart, ...]


def read_object(folder: Path) -> MovingObject:
    """Read one object."""
    record = json.loads((folder / RECORD).read_bytes())
    mesh, labels = read_visual(folder / MESH, folder), np.load(folder / LABELS, allow_pickle=False)
    joints = [j for j in record["joints"] if (labels == j["part"]).any()]
    parts = [_part(j, mesh.subset(labels == j["part"]).diagonal / mesh.diagonal, mesh.diagonal) for j in joints]
    return MovingObject(folder.name.split("__")[0], float(max(mesh.extents)), tuple(parts))


def _part(joint: dict[str, Any], size: float, unit: float) -> MovingPart:
    slides, limits = joint["type"] == JointType.PRISMATIC, joint["limits"]
    endless = joint["type"] == JointType.CONTINUOUS or limits is None
    range_ = None if endless else (limits[1] - limits[0]) / unit if slides else float(np.rad2deg(limits[1] - limits[0]))
    words = words_of(joint.get("name", ""))
    name = next((w for w in reversed(words) if w not in PLACES), "part")
    return MovingPart(name, size, move_of(np.array(joint["axis"]), slides=slides), range_)


def row_of(objects: Sequence[MovingObject]) -> dict[str, Any]:
    """Return the row of the table of objects of one kind."""
    having = Counter(name for o in objects for name in {p.name for p in o.parts})
    groups: dict[str, list[MovingPart]] = {}
    for part in (p for o in objects for p in o.parts):
        groups.setdefault(part.name if having[part.name] >= LEAST else "part", []).append(part)
    name = ABOUT.split(objects[0].kind)[0]
    order = sorted(groups, key=lambda name: (name == "part", -having[name], name))
    return {
        "words": f"{name} {ALSO.get(name, '')}".strip(),
        "objects": len(objects),
        "longest": _quantiles([o.longest for o in objects]),
        "moving": [len(o.parts) for o in objects],
        "parts": [_row_of_part(name, groups[name]) for name in order],
    }


def _row_of_part(name: str, parts: Sequence[MovingPart]) -> dict[str, Any]:
    row: dict[str, Any] = {"name": name, "count": len(parts), "size": _quantiles([p.size for p in parts])}
    row["moves"] = dict(sorted(Counter(p.move for p in parts).items(), key=lambda item: (-item[1], item[0])))
    most = next(iter(row["moves"]))
    ranges = [p.range for p in parts if p.range is not None and p.move == most]
    return row | ({"range": _quantiles(ranges)} if ranges else {})


def _quantiles(values: Sequence[float]) -> list[float]:
    return [float(f"{v:.2g}") for v in np.quantile(values, QUANTILES)]


def table(objects: Iterable[MovingObject]) -> list[dict[str, Any]]:
    """Return the rows of all kinds that are no bare mechanisms."""
    kinds: dict[str, list[MovingObject]] = {}
    for o in objects:
        if not MECHANISMS.search(o.kind):
            kinds.setdefault(o.kind, []).append(o)
    return [row_of(kinds[kind]) for kind in sorted(kinds)]


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description="Write the table of the moving parts of kinds of objects.")
    parser.add_argument("folder", type=Path)
    folder = parser.parse_args(argv).folder
    rows = table(read_object(path.parent) for path in sorted(folder.glob(f"*/{RECORD}")))
    told = json.loads(WRITTEN.read_text(encoding="utf-8"))
    head = json.dumps({key: value for key, value in told.items() if key != "kinds"}, indent=1)[:-2]
    lines = ",\n".join(f"  {json.dumps(row)}" for row in rows)
    WRITTEN.write_text(f'{head},\n "kinds": [\n{lines}\n ]\n}}\n', encoding="utf-8")


if __name__ == "__main__":
    main()
