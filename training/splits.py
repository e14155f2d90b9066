"""Which kinds of Articraft objects are for what: trained on, kept for validation, or sealed."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from hashlib import sha256
from typing import Protocol, TypeVar

ARTICRAFT = "articraft"  # name of the source in rows and manifests
ATTRIBUTION = "Articraft-10K (camvsl/Articraft-10K), CC BY 4.0"  # of its objects, and of what is made from them
# random.Random(74).sample(sorted(kinds), 30); nothing is fitted to them, and they are measured after each training
VALIDATION = frozenset(
    """air_pump_with_t_handle branching_tree_with_two_independent_rotary_branches ceiling_light_fixture
    dishwasher_with_dropdown_door_and_sliding_racks display_freezer_with_sliding_glass_lids drawer_cabinet_with_sliding_drawers
    drone floodlight_mast_with_tilt_head food_processor_with_feed_pusher internet_router joystick_mechanism keyboard lazy_susan
    orthogonal_xy_stage overshot_waterwheel pitchroll_module playground_swing portable_speaker_with_articulated_controls
    refrigerator_with_hinged_doors single_revolute_hinge single_roll_axis_module singleleaf_drawbridge
    stick_vacuum_with_folding_joint threejoint_revolute_chain tower_fan_with_rotary_controls tripodmounted_device
    twojoint_prismatic_chain vacuum_cleaner_with_articulated_wand wind_turbine yawpitchroll_wrist""".split()
)
STILL = "still"  # source of models by artists that do not move (`python -m benchmarks.held_out WORK --still` writes them)
SEALED_SHARE = 10  # one kind of so many, by the hash of its name, is sealed


class Use(StrEnum):
    """What a kind is for. SEALED: never trained on, tuned on or looked at; only CI measures it."""

    TRAIN = "train"
    VALIDATION = "validation"
    SEALED = "sealed"


def use_of(kind: str) -> Use:
    """Return what a kind of Articraft is for."""
    if kind in VALIDATION:
        return Use.VALIDATION
    return Use.SEALED if int(sha256(f"sealed {kind}".encode()).hexdigest(), 16) % SEALED_SHARE == 0 else Use.TRAIN


def first_of_kinds(use: Use, names: Sequence[str], count: int) -> list[str]:
    """Return the names of the first objects of each kind of Articraft for a use. names: KIND__NN, sorted."""
    of_kind: dict[str, list[str]] = {}
    for name in names:
        of_kind.setdefault(name.rsplit("__", 1)[0], []).append(name)
    return [name for kind, some in of_kind.items() if use_of(kind) is use for name in some[:count]]


class OfKind(Protocol):
    """Rows of an object."""

    @property
    def source(self) -> str: ...
    @property
    def kind(self) -> str: ...


Rows = TypeVar("Rows", bound=OfKind)


def used_for(use: Use, rows: Sequence[Rows]) -> list[Rows]:
    """Return the rows for a use; of other sources than Articraft, all but the still models are trained on."""
    return [r for r in rows if r.source != STILL and use is (use_of(r.kind) if r.source == ARTICRAFT else Use.TRAIN)]
