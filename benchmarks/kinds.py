"""Objects of many kinds with known joints, made to vary: furniture, doors, appliances, vehicles, machines, tools, robots.

python benchmarks/kinds.py FOLDER [--seed 0] [--count 2] [--reserved] [KIND ...]  writes FOLDER/KIND-NN/KIND-NN.urdf with meshes
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from pathlib import Path
from types import ModuleType
from zlib import crc32

import kinds_air_appliances
import kinds_aircraft
import kinds_appliances
import kinds_bath
import kinds_bath_static
import kinds_cabinets
import kinds_consoles
import kinds_containers
import kinds_controls
import kinds_cookware
import kinds_countertop
import kinds_crane
import kinds_cupboards
import kinds_decor
import kinds_desks
import kinds_doors
import kinds_electronics
import kinds_entrances
import kinds_fans
import kinds_fieldwork
import kinds_fixtures
import kinds_flying
import kinds_furniture
import kinds_glazing
import kinds_grinders
import kinds_handheld
import kinds_hatches
import kinds_interiors
import kinds_kettles
import kinds_kitchen
import kinds_kitchen_static
import kinds_kitchen_storage
import kinds_machines
import kinds_mixers
import kinds_office
import kinds_passages
import kinds_pocket
import kinds_reserved_outdoors
import kinds_reserved_rooms
import kinds_reserved_work
import kinds_robots
import kinds_rolling
import kinds_rooms
import kinds_seating
import kinds_static
import kinds_static_parts
import kinds_storage
import kinds_street
import kinds_swivel
import kinds_tables
import kinds_taps
import kinds_things
import kinds_tools
import kinds_transport
import kinds_trucks
import kinds_vehicles
import kinds_vending
import kinds_white_goods
import kinds_windmill
import kinds_windows
import numpy as np
from kinds_model import Model, left_by_an_artist, write_urdf

FAMILIES = {
    kinds_aircraft: "light_aircraft jet glider",
    kinds_flying: "wing_panel moving_fins helicopter",
    kinds_doors: "hinged_door double_door arched_door stable_door patio_door bifold_door garage_door gate cat_flap "
    "revolving_door",
    kinds_windows: "casement awning hopper double_casement hung_window sliding_window shutters roof_window louvres",
    kinds_cabinets: "wardrobe sideboard secretary drawer_unit",
    kinds_furniture: "chest piano office_chair leaf_table bed",
    kinds_things: "washer toilet trash_can laptop mailbox safe",
    kinds_tools: "desk_lamp scissors stapler suitcase tool_box folding_chair",
    kinds_air_appliances: "range_hood vacuum_cleaner",
    kinds_appliances: "oven range_cooker microwave",
    kinds_bath: "mirror_cabinet vanity_unit",
    kinds_bath_static: "sink bathtub kitchen_stool",
    kinds_consoles: "game_controller telephone radio",
    kinds_containers: "flip_bottle spray_bottle pen_case binoculars",
    kinds_controls: "keyboard switch_panel",
    kinds_cookware: "waffle_iron rice_cooker",
    kinds_countertop: "toaster toaster_oven espresso_machine",
    kinds_crane: "crane",
    kinds_cupboards: "lockers kitchen_dresser display_cabinet",
    kinds_decor: "music_box grandfather_clock globe_stand",
    kinds_desks: "tambour_desk writing_desk sewing_table",
    kinds_electronics: "turntable camera monitor",
    kinds_entrances: "front_door fanlight_doors",
    kinds_fans: "table_fan ceiling_fan",
    kinds_fieldwork: "rover tractor",
    kinds_fixtures: "bookcase garden_bench staircase",
    kinds_glazing: "french_window thick_casement sash_row",
    kinds_grinders: "coffee_grinder pepper_mill",
    kinds_handheld: "pliers hole_punch power_drill lever_clamp",
    kinds_hatches: "tilt_window roof_hatch framed_shutters",
    kinds_interiors: "dining_set sofa four_poster",
    kinds_kettles: "kettle pressure_cooker",
    kinds_kitchen: "wall_unit corner_cabinet tall_pantry kitchen_run",
    kinds_kitchen_static: "pot_rack plate_stack tiled_counter jar_shelf",
    kinds_kitchen_storage: "waste_sorter bread_box spice_drawers",
    kinds_machines: "forklift excavator",
    kinds_mixers: "stand_mixer blender",
    kinds_office: "printer copier",
    kinds_passages: "barn_door pocket_door saloon_doors elevator garden_gate",
    kinds_pocket: "pocket_knife padlock flashlight",
    kinds_robots: "robot_arm gripper quadruped",
    kinds_rolling: "bicycle scooter wheelbarrow shopping_trolley",
    kinds_rooms: "picture_wall fireplace wall_panelling",
    kinds_seating: "bench_chest ottoman baby_cot",
    kinds_static: "statue rock_pile brick_wall potted_plant",
    kinds_static_parts: "pipe_assembly engine_block tyre_stack street_lamp",
    kinds_storage: "tv_stand vanity curved_chest nightstand filing_cabinet apothecary",
    kinds_street: "parking_barrier traffic_light valve",
    kinds_swivel: "recliner bar_stool swivel_armchair",
    kinds_tables: "wall_table lift_table corner_bar",
    kinds_taps: "soap_dispenser tap shower_mixer",
    kinds_transport: "boat train_wagon",
    kinds_trucks: "dump_truck bus",
    kinds_vehicles: "car pickup_truck",
    kinds_vending: "vending_machine mailbox_post",
    kinds_white_goods: "fridge dishwasher top_loader tumble_dryer",
    kinds_windmill: "windmill",
}
RESERVED_FAMILIES = {  # written after the shipped classifiers were trained; nothing is ever trained or tuned on them
    kinds_reserved_rooms: "cash_register jewellery_box bird_cage pet_carrier aquarium hose_cabinet wine_rack phone_booth "
    "typewriter gun_cabinet",
    kinds_reserved_work: "bench_vice drill_press microscope stepladder paper_cutter step_bin lab_centrifuge",
    kinds_reserved_outdoors: "barbecue turnstile sunlounger hand_pump dumpster swing_seat weather_vane picnic_table barrel",
}
Kinds = dict[str, Callable[[Model], None]]


def _named(families: Mapping[ModuleType, str]) -> Kinds:
    return {name: getattr(family, name) for family, names in families.items() for name in names.split()}


KINDS, RESERVED = _named(FAMILIES), _named(RESERVED_FAMILIES)


def build(kind: str, seed: int, number: int) -> Model:
    """Object `number` of a kind; the same for the same seed."""
    model = Model(np.random.default_rng([seed, crc32(kind.encode()), number]))
    (KINDS | RESERVED)[kind](model)
    return left_by_an_artist(model)


def write(kind: str, seed: int, number: int, folder: Path) -> Path:
    """Builds one object and writes it; returns its URDF."""
    name = f"{kind}-{number:02d}"
    return write_urdf(build(kind, seed, number), name, folder / name, ("obj", "stl")[number % 2])


def main() -> None:
    parser = argparse.ArgumentParser(description="Objects of many kinds with known joints.")
    parser.add_argument("folder", type=Path, help="where they go")
    parser.add_argument("kinds", nargs="*", help="kinds; all but the reserved ones when none is named")
    parser.add_argument("--seed", type=int, default=0, help="of everything that varies")
    parser.add_argument("--count", type=int, default=2, help="objects of each kind")
    parser.add_argument("--reserved", action="store_true", help="the reserved kinds, which nothing is trained on")
    options = parser.parse_args()
    if unknown := sorted(set(options.kinds) - set(KINDS | RESERVED)):
        parser.error(f"kinds: found {', '.join(unknown)}; valid are {', '.join(sorted(KINDS | RESERVED))}")
    for kind in options.kinds or (RESERVED if options.reserved else KINDS):
        for number in range(options.count):
            print(write(kind, options.seed, number, options.folder))


if __name__ == "__main__":
    main()
