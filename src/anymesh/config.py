"""Settings of a run that users may change, and constants that both stages share."""

from __future__ import annotations

import re
from dataclasses import dataclass

from anymesh.errors import OptionError

# shared by both stages; not settings
ALONG_COSINE = 0.7  # about 45 degrees: minimum cosine between two directions that are along each other, not across
FACING_COSINE = 0.5  # 60 degrees: minimum cosine between a normal or a motion and the side that it faces
LEVEL_COSINE = 0.8  # 37 degrees: minimum cosine between the vertical and the normal of a level face
ACROSS_COSINE = 0.3  # 73 degrees: maximum cosine between two directions that are across each other
SAME_AXIS_COSINE = 0.97  # 14 degrees: minimum cosine between axes that a user sees as one
SAME_SIZE = 0.02  # maximum relative difference of the diagonals, or of the spreads, of copies
REFERENCE_PX = 640  # [px] height of a picture that sizes in pixels refer to
PAPER_VIEWS = "8@15"
# At 15 degrees elevation the camera is below the top of anything taller than about half its diagonal. Therefore more views look
# down, and one looks up.
DEFAULT_VIEWS = f"{PAPER_VIEWS},2@50+30,1@-35+30"
MAX_VIEWS = 32
RING = re.compile(r"(?P<count>[1-9]\d?)@(?P<elevation>-?\d{1,2}(\.\d+)?)(\+(?P<azimuth>\d{1,3}(\.\d+)?))?")
VALID = {"verify": ("motion", "free", "off"), "ask": ("unsure", "all"), "pictures": ("many", "few"), "detail": ("high", "low")}
PROPOSERS = r"exact|(exact\+)?sam:.+"


@dataclass(frozen=True)
class Config:
    """All settings of a run; its dictionary is part of the key of saved stage results."""

    seed: int = 0  # 0 or more
    category: str | None = None  # of the object, given by a user
    parts_list: tuple[str, ...] = ()  # labels of movable parts, given by a user; a model is then not asked for them
    proposer: str = "exact"  # of masks, see `segmentation.propose`
    verify: str = "motion"  # "free": answers are used, except for slides that are blocked; "off": the paper's method unchanged
    ask: str = "unsure"  # a model about joints that geometry and recognition do not agree on, or about "all"
    pictures: str = "many"  # at most 8 in each question of a model, or "few": one
    probed: tuple[tuple[str, int, int, float], ...] = ()  # of the model: question, right, asked, chance to guess it right
    detail: str = "high"  # "low": a model is not asked about small regions
    at_least: int = 0  # minimum number of parts, even with weak evidence, for objects that are known to move
    viewpoints: str = DEFAULT_VIEWS  # shown to a model: COUNT@ELEVATION or COUNT@ELEVATION+AZIMUTH [deg], separated by commas

    def __post_init__(self) -> None:
        for option, number in (("seed", self.seed), ("at-least", self.at_least)):
            if number < 0:
                raise OptionError(f"--{option}: found {number}; valid are integers from 0 up")
        for (option, valid), word in zip(VALID.items(), (self.verify, self.ask, self.pictures, self.detail), strict=True):
            if word not in valid:
                raise OptionError(f"--{option}: found {word!r}; valid are {', '.join(valid)}")
        if not re.fullmatch(PROPOSERS, self.proposer):
            raise OptionError(f"--proposer: found {self.proposer!r}; valid are exact, sam:WEIGHTS and exact+sam:WEIGHTS")
        rings = [RING.fullmatch(ring) for ring in self.viewpoints.split(",")]
        steep = any(abs(float(ring["elevation"])) > 90 for ring in rings if ring)
        if not all(rings) or steep or not 1 <= len(self.directions) <= MAX_VIEWS:
            raise OptionError(
                f"--viewpoints: found {self.viewpoints!r}; valid are COUNT@ELEVATION or COUNT@ELEVATION+AZIMUTH [deg] with "
                f"commas between, such as {DEFAULT_VIEWS} or {PAPER_VIEWS} (the paper's), 1 to {MAX_VIEWS} views in all"
            )

    @property
    def directions(self) -> tuple[tuple[float, float], ...]:
        """Return azimuth and elevation of each camera [deg], ring by ring, evenly spread over each ring."""
        directions: list[tuple[float, float]] = []
        for ring in map(RING.fullmatch, self.viewpoints.split(",")):
            assert ring is not None  # checked in __post_init__
            count, first = int(ring["count"]), float(ring["azimuth"] or 0)
            directions += [((first + 360 * k / count) % 360, float(ring["elevation"])) for k in range(count)]
        return tuple(directions)
