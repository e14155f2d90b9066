"""Objects of many kinds with known joints, made to vary: furniture, doors, appliances, vehicles, machines, tools, robots.

python benchmarks/kinds.py FOLDER [--seed 0] [--count 2] [--test | --reserved] [KIND ...]
writes FOLDER/KIND-NN/KIND-NN.urdf with meshes
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from zlib import crc32

import numpy as np
from kinds_model import Model, left_by_an_artist, write_urdf

FAMILIES = {
    "aircraft": "light_aircraft jet glider",
    "flying": "wing_panel moving_fins helicopter",
    "doors": "hinged_door double_door arched_door stable_door patio_door bifold_door garage_door gate cat_flap revolving_door",
    "windows": "casement awning hopper double_casement hung_window sliding_window shutters roof_window louvres",
    "cabinets": "wardrobe sideboard secretary drawer_unit",
    "furniture": "chest piano office_chair leaf_table bed",
    "things": "washer toilet trash_can laptop mailbox safe",
    "tools": "desk_lamp scissors stapler suitcase tool_box folding_chair",
    "air_appliances": "range_hood vacuum_cleaner",
    "appliances": "oven range_cooker microwave",
    "bath": "mirror_cabinet vanity_unit",
    "bath_static": "sink bathtub kitchen_stool",
    "consoles": "game_controller telephone radio",
    "containers": "flip_bottle spray_bottle pen_case binoculars",
    "controls": "keyboard switch_panel",
    "cookware": "waffle_iron rice_cooker",
    "countertop": "toaster toaster_oven espresso_machine",
    "crane": "crane",
    "cupboards": "lockers kitchen_dresser display_cabinet",
    "decor": "music_box grandfather_clock globe_stand",
    "desks": "tambour_desk writing_desk sewing_table",
    "electronics": "turntable camera monitor",
    "entrances": "front_door fanlight_doors",
    "fans": "table_fan ceiling_fan",
    "fieldwork": "rover tractor",
    "fixtures": "bookcase garden_bench staircase",
    "glazing": "french_window thick_casement sash_row",
    "grinders": "coffee_grinder pepper_mill",
    "handheld": "pliers hole_punch power_drill lever_clamp",
    "hatches": "tilt_window roof_hatch framed_shutters",
    "interiors": "dining_set sofa four_poster",
    "kettles": "kettle pressure_cooker",
    "kitchen": "wall_unit corner_cabinet tall_pantry kitchen_run",
    "kitchen_static": "pot_rack plate_stack tiled_counter jar_shelf",
    "kitchen_storage": "waste_sorter bread_box spice_drawers",
    "machines": "forklift excavator",
    "mixers": "stand_mixer blender",
    "office": "printer copier",
    "passages": "barn_door pocket_door saloon_doors elevator garden_gate",
    "pocket": "pocket_knife padlock flashlight",
    "robots": "robot_arm gripper quadruped",
    "rolling": "bicycle scooter wheelbarrow shopping_trolley",
    "rooms": "picture_wall fireplace wall_panelling",
    "seating": "bench_chest ottoman baby_cot",
    "static": "statue rock_pile brick_wall potted_plant",
    "static_parts": "pipe_assembly engine_block tyre_stack street_lamp",
    "storage": "tv_stand vanity curved_chest nightstand filing_cabinet apothecary",
    "street": "parking_barrier traffic_light valve",
    "swivel": "recliner bar_stool swivel_armchair",
    "tables": "wall_table lift_table corner_bar",
    "taps": "soap_dispenser tap shower_mixer",
    "transport": "boat train_wagon",
    "trucks": "dump_truck bus",
    "vehicles": "car pickup_truck",
    "vending": "vending_machine mailbox_post",
    "white_goods": "fridge dishwasher top_loader tumble_dryer",
    "windmill": "windmill",
    "beds": "trundle_bed wall_bed folding_screen",
    "binders": "ring_binder powder_compact",
    "biplanes": "biplane",
    "caravans": "caravan",
    "cartons": "shipping_carton pizza_box",
    "cases": "steamer_trunk",
    "coolers": "cool_box",
    "counter_appliances": "air_fryer",
    "crates": "crate_with_lid",
    "dispensers": "water_dispenser",
    "dough_appliances": "bread_maker hand_mixer",
    "drawers": "shoe_cabinet plan_chest record_cabinet",
    "drones": "drone",
    "fire_engines": "fire_engine",
    "fitness": "exercise_bike treadmill",
    "flight": "flight_case",
    "garden": "garden_shed",
    "gifts": "gift_box matchbox",
    "golf_carts": "golf_cart",
    "hand_tools": "secateurs adjustable_spanner",
    "hand_trucks": "hand_truck",
    "ice_cream": "ice_cream_maker",
    "juicers": "juicer",
    "leisure": "telescope",
    "lorries": "truck_with_trailer",
    "motorcycles": "motorcycle",
    "outdoor_tools": "lawn_mower",
    "parasol": "garden_parasol",
    "playground": "seesaw merry_go_round",
    "pocket_instruments": "metronome balance_scale",
    "pocket_small": "glasses sand_timer",
    "pocket_things": "flip_phone zippo_lighter",
    "popcorn": "popcorn_machine",
    "pot_appliances": "slow_cooker deep_fryer",
    "public_arms": "operating_lamp tv_wall_arm",
    "public_care": "hospital_bed",
    "public_devices": "fuse_box server_rack",
    "public_games": "arcade_cabinet parking_meter",
    "public_service": "jukebox fuel_pump",
    "sailboats": "sailboat",
    "satellites": "satellite",
    "stands": "camera_tripod music_stand",
    "table_appliances": "food_processor salad_spinner",
    "table_gadgets": "can_opener_electric egg_cooker",
    "table_saw": "table_saw",
    "tall_cabinets": "sliding_wardrobe bar_cabinet bathroom_tower",
    "tracked": "tank bulldozer",
    "trolleys": "tool_trolley serving_cart",
    "vans": "van",
    "well": "well_winch",
    "wheelchair": "wheelchair",
    "workshop": "mitre_saw",
    "worktops": "kitchen_island school_desk workbench_drawers",
    "paper_machines": "document_scanner paper_shredder",
    "boombox": "boombox",
    "tapes": "tape_deck film_projector",
    "flight_sticks": "flight_joystick",
    "racing_wheels": "racing_wheel",
    "disc_consoles": "disc_console",
    "sewing_machines": "sewing_machine",
    "spinning_wheels": "spinning_wheel",
    "drafting_tables": "drafting_table",
    "surveying": "theodolite",
    "easels": "easel",
    "pinball": "pinball_machine",
    "play_machines": "foosball_table gumball_machine",
    "small_machines": "label_printer walkie_talkie",
    "lying_doors": "cellar_door trapdoor",
    "ship_openings": "ship_hatch porthole_wall",
    "bank_vaults": "bank_vault_door",
    "prisons": "prison_door",
    "airlocks": "airlock_door",
    "drawbridges": "drawbridge",
    "crossings": "lock_gate level_crossing",
    "parcel_lockers": "parcel_locker",
    "street_boxes": "bike_locker street_cabinet",
    "ticket_machines": "ticket_machine",
    "street_machines": "cash_machine newspaper_box",
    "hutches": "rabbit_hutch",
    "beehives": "beehive",
    "coops": "chicken_coop",
    "greenhouses": "greenhouse",
    "beach_huts": "beach_hut",
    "shop_fronts": "roller_shutter_shop",
    "yard_gates": "sliding_yard_gate",
    "theatre": "theatre_seats",
    "cooling": "fridge_freezer_styles",
    "blanket_boxes": "blanket_box",
    "corner_wardrobe": "corner_wardrobe",
    "dressing": "dressing_table_triple_mirror",
    "eastern": "chinese_cabinet",
    "fitted_kitchen": "kitchen_base_run",
    "low_tables": "coffee_table_storage",
    "toy_storage": "kids_toy_storage",
    "wall_units": "wall_units_lift",
    "hall": "shoe_bench hall_stand storage_ottoman_set",
    "lounge": "media_console vinyl_cabinet hi_fi_rack",
    "nursery": "changing_table bunk_bed_drawers",
    "study": "murphy_desk_cabinet file_pedestal",
    "towers": "washer_tower oven_tower",
    "building_machines": "concrete_mixer",
    "compactors": "road_roller",
    "loaders": "skid_steer",
    "lifts": "boom_lift",
    "gantries": "gantry_crane",
    "small_wheels": "skateboard tricycle",
    "prams": "pram",
    "carriages": "horse_carriage",
    "rails": "mine_cart",
    "locomotives": "steam_locomotive",
    "sieges": "catapult",
    "snowmobiles": "snowmobile",
    "jet_skis": "jet_ski",
    "hulls": "submarine",
    "airships": "airship",
    "refuse": "garbage_truck",
    "box_trailers": "hang_trailer",
    "metal_lathes": "lathe",
    "band_saws": "band_saw",
    "rowing_machines": "rowing_machine",
    "incubators": "infant_incubator",
    "coffins": "coffin",
    "ship_helms": "ship_helm",
    "conveyors": "conveyor",
    "pump_jacks": "oil_pump_jack",
    "cable_machines": "cable_machine",
    "weight_benches": "weight_bench",
    "massage_tables": "massage_table",
    "barber_chairs": "barber_chair",
    "drug_trolleys": "drug_trolley",
    "autoclaves": "autoclave",
    "glove_boxes": "glove_box",
    "fume_hoods": "fume_hood",
    "printers": "printer_3d",
    "chain_saws": "chain_saw",
    "power_tools": "circular_saw angle_grinder",
    "locksets": "door_lever_set wall_socket",
    "pressurized": "fire_extinguisher gas_cylinder fire_hydrant",
    "reeled": "hose_reel",
    "angling": "fishing_reel",
    "slim_things": "umbrella syringe",
    "gauges": "caliper",
    "sundries": "mouse_trap",
    "paint_cans": "paint_can",
    "sharpeners": "pencil_sharpener",
    "brass": "trumpet",
    "buckets": "bucket",
    "pots": "cooking_pot",
    "mice": "computer_mouse",
    "remotes": "remote_control",
    "sticks": "usb_stick",
    "pens": "ball_pen",
    "clocks": "wall_clock",
    "jars": "screw_jar",
    "side_tables": "drawer_table",
    "carts": "utility_cart",
    "sidearms": "pistol revolver",
    "long_arms": "bolt_rifle",
    "crossbows": "crossbow",
    "ordnance": "field_cannon",
    "turrets": "gun_turret",
    "castles": "portcullis_gate",
    "fairgrounds": "ferris_wheel",
    "water_mills": "water_mill",
    "turbines": "wind_turbine",
    "radars": "radar_dish",
    "robot_figures": "robot_figure",
    "still_buildings": "castle_tower temple bridge_model fence_run well_head",
    "still_creatures": "four_legged_animal bird_figure fish_figure human_figure stuffed_toy insect_figure",
    "still_food": "cake_stand_cake fruit_bowl burger_plate bottle_group tea_set",
    "still_gear": "sword_rack helmet trophy dumbbell_set candle_holder",
    "still_models": "rocket_model ship_hull_model cannon_monument crate_stack lantern_stand",
    "still_plants": "broadleaf_tree conifer palm_tree cactus_group mushroom_group hedge_row",
    "still_seats": "side_chair park_seat stool_set chaise pew_row side_table",
    "still_street": "road_sign monument_cross bollard_row statue_fountain market_stall tent",
}
TEST_FAMILIES = {  # what classifiers reach on them is measured after each training; nothing was tuned on them
    "chillers": "chest_freezer wine_cooler",
    "larders": "pull_out_larder dish_rack_cabinet",
    "pasta_machines": "pasta_machine",
    "corkscrews": "corkscrew",
    "pressing": "sandwich_press",
    "pod_machines": "pod_coffee_machine",
    "ironing": "ironing_board",
    "hampers": "laundry_hamper",
    "sewing_baskets": "sewing_basket",
    "airing": "airing_rack",
    "lidded": "butter_dish_set",
    "caddies": "kitchen_caddy",
    "wall_desks": "fold_down_desk",
    "medicine": "medicine_cabinet",
}
RESERVED_FAMILIES = {  # nothing is ever trained or tuned on them
    "reserved_rooms": "cash_register jewellery_box bird_cage pet_carrier aquarium hose_cabinet wine_rack phone_booth "
    "typewriter gun_cabinet",
    "reserved_work": "bench_vice drill_press microscope stepladder paper_cutter step_bin lab_centrifuge",
    "reserved_outdoors": "barbecue turnstile sunlounger hand_pump dumpster swing_seat weather_vane picnic_table barrel",
}
Kinds = dict[str, Callable[[Model], None]]


def _named(families: Mapping[str, str]) -> Kinds:
    """Return the functions that build the kinds of each family, from the module kinds_FAMILY."""
    return {
        name: getattr(import_module(f"kinds_{family}"), name) for family, names in families.items() for name in names.split()
    }


KINDS, TEST, RESERVED = _named(FAMILIES), _named(TEST_FAMILIES), _named(RESERVED_FAMILIES)
ALL = KINDS | TEST | RESERVED


def build(kind: str, seed: int, number: int) -> Model:
    """Object `number` of a kind; the same for the same seed."""
    model = Model(np.random.default_rng([seed, crc32(kind.encode()), number]))
    ALL[kind](model)
    return left_by_an_artist(model)


def write(kind: str, seed: int, number: int, folder: Path) -> Path:
    """Builds one object and writes it; returns its URDF."""
    name = f"{kind}-{number:02d}"
    return write_urdf(build(kind, seed, number), name, folder / name, ("obj", "stl")[number % 2])


def main() -> None:
    parser = argparse.ArgumentParser(description="Objects of many kinds with known joints.")
    parser.add_argument("folder", type=Path, help="where they go")
    parser.add_argument("kinds", nargs="*", help="kinds; those for training when none is named")
    parser.add_argument("--seed", type=int, default=0, help="of everything that varies")
    parser.add_argument("--count", type=int, default=2, help="objects of each kind")
    parser.add_argument("--test", action="store_true", help="the kinds that are measured after each training")
    parser.add_argument("--reserved", action="store_true", help="the reserved kinds, which nothing is trained or tuned on")
    options = parser.parse_intermixed_args()
    if unknown := sorted(set(options.kinds) - set(ALL)):
        parser.error(f"kinds: found {', '.join(unknown)}; valid are {', '.join(sorted(ALL))}")
    for kind in options.kinds or (RESERVED if options.reserved else TEST if options.test else KINDS):
        for number in range(options.count):
            print(write(kind, options.seed, number, options.folder))


if __name__ == "__main__":
    main()
