"""Every number that steers the pipeline, once, with its unit and where it comes from."""

from __future__ import annotations

import re
from dataclasses import asdict, dataclass, field

from anymesh.errors import OptionError


@dataclass(frozen=True)
class PiecesConfig:
    """The smallest units that parts are made of. Lengths are shares of the object's diagonal."""

    crease: float = 25.0  # [deg] a concave edge sharper than this may bound a part on a fused surface
    fused_size: float = 0.35  # components smaller than this are not cut along their creases
    superpoint_strength: float = 0.05  # of l0 cut pursuit on normals (the paper's implementation)
    superpoint_faces: int = 40_000  # a denser component is simplified before it is cut into superpoints
    soft_faces: int = 3000  # components with fewer faces have sharp creases only
    reach: float = 0.01  # how far from a soft crease the surface tells its angle
    crumb: float = 0.03  # regions smaller than this, left by a cut, join their neighbour
    most_faces: int = 8000  # a denser mesh is simplified for questions of shape and motion, never in the output
    least_faces: int = 60  # that a piece keeps of those it has
    most_pieces: int = 1500  # above it, small pieces join their nearest larger one


@dataclass(frozen=True)
class SegmentationConfig:
    """Stage A (paper, 3.2). Lengths are shares of the object's diagonal."""

    touch: float = 0.0004  # pieces nearer than this touch; clearances of real fits are wider
    near: float = 0.02  # bodies nearer than this, but not touching, have a clearance between them
    smallest: float = 0.004  # pieces with a smaller diagonal never move on their own
    most_candidates: int = 150  # largest groups of patches that are examined as parts
    at_least: int = 0  # parts that are taken however thin the evidence is: for objects that are known to move

    def __post_init__(self) -> None:
        if self.at_least < 0:
            raise OptionError(f"--at-least: found {self.at_least}; valid are integers from 0 up")


@dataclass(frozen=True)
class ArticulationConfig:
    """Stage B (paper, 3.3). Lengths are shares of the object's diagonal unless said."""

    connecting: float = 0.005  # threshold of the connecting area; .01 where the diagonal is 2 (the paper's implementation)
    penetration: float = 0.003  # a path that goes this far behind a surface is stopped
    support: float = 0.02  # a hinge line has the parent near when it is within this
    sweep_steps: int = 36  # of a sweep each way: 5 degrees over half a turn
    fine_steps: int = 30  # of the last coarse step, for the limits
    door_most: float = 110.0  # [deg] upper limit of a hinge that nothing stops, axis upright (common cup hinges)
    flap_most: float = 90.0  # [deg] upper limit of a hinge that nothing stops, axis level
    slide_hidden: float = 0.6  # travel of a front whose box is hidden, as a share of the parent's depth
    slide_keep: float = 0.1  # share of a drawer's depth that stays in when it is out


PAPER_VIEWS = "8@15"
DEFAULT_VIEWS = f"{PAPER_VIEWS},2@50+30,1@-35+30"
MAX_VIEWS = 32
RING = re.compile(r"(?P<count>[1-9]\d?)@(?P<elevation>-?\d{1,2}(\.\d+)?)(\+(?P<azimuth>\d{1,3}(\.\d+)?))?")


@dataclass(frozen=True)
class ViewsConfig:
    """The views that a model is shown. Lengths are shares of the object's diagonal.

    The paper's implementation has `around` = PAPER_VIEWS with the fixed field of view. From 15 degrees up the eye is below
    the top of anything taller than about half its diagonal, so more views look down, and one looks up; and each camera is
    turned and zoomed until the object fills its picture.
    """

    around: str = DEFAULT_VIEWS  # rings of cameras: COUNT@ELEVATION or COUNT@ELEVATION+AZIMUTH [deg], with commas between
    inside: str = "2@25+45,1@60+30"  # the same for what no view shows, drawn with the rest as a ghost
    distance: float = 1.0  # of the camera from the object's middle; 2 where the diagonal is 2 (the paper's implementation)
    fov: float = 60.0  # [deg] vertical, before the camera is zoomed (the paper's implementation)
    air: float = 0.04  # round the object, a share of its box in the picture, on each side
    size: int = 640  # [px] both ways
    zoom_size: int = 4096  # [px] that a close-up is cut from
    zoom_below: int = 5000  # [px] a part that covers less of the best view is shown in a close-up
    zoom_margin: float = 0.3  # of the part's box in the picture, added on each side

    def __post_init__(self) -> None:
        for told in (self.around, self.inside):
            rings = [RING.fullmatch(ring) for ring in told.split(",")]
            count = sum(int(ring["count"]) for ring in rings if ring)
            steep = any(abs(float(ring["elevation"])) > 90 for ring in rings if ring)
            if not all(rings) or not 1 <= count <= MAX_VIEWS or steep:
                raise OptionError(
                    f"--viewpoints: found {told!r}; valid are COUNT@ELEVATION or COUNT@ELEVATION+AZIMUTH [deg] with commas "
                    f"between, such as {DEFAULT_VIEWS} or {PAPER_VIEWS} (the paper's), 1 to {MAX_VIEWS} views in all"
                )

    @property
    def directions(self) -> tuple[tuple[float, float], ...]:
        """Azimuth and elevation of each camera [deg], ring by ring, evenly spread over each ring."""
        return _directions(self.around)

    @property
    def inside_directions(self) -> tuple[tuple[float, float], ...]:
        """The same of the cameras for what no view shows."""
        return _directions(self.inside)


def _directions(rings: str) -> tuple[tuple[float, float], ...]:
    found: list[tuple[float, float]] = []
    for text in rings.split(","):
        ring = RING.fullmatch(text)
        assert ring is not None  # see ViewsConfig
        count, first = int(ring["count"]), float(ring["azimuth"] or 0)
        found += [((first + 360 * k / count) % 360, float(ring["elevation"])) for k in range(count)]
    return tuple(found)


@dataclass(frozen=True)
class GroundingConfig:
    """Stage A by set-of-mark grounding (paper, 3.2; PartSlip++). Lengths are shares of the object's diagonal."""

    points: int = 800_000  # samples of the surface
    neighbours: int = 10
    strength: float = 0.05  # of l0 cut pursuit on [normal, color_weight * colour]
    color_weight: float = 0.3
    least_points: int = 10  # smaller superpoints join a neighbour
    least_mask: int = 200  # [px] of a 640 px view; smaller masks are dropped (1000 in the paper: small parts are lost)
    alpha: float = 0.1  # of the mask colours over the picture
    whole: float = 0.95  # masks that cover more of the object are ignored
    covered: float = 0.5  # share of a superpoint's visible points in a mask that gives it the label
    join_component: float = 0.03  # how near a part a component is to join it
    gap: float = 0.01  # superpoints whose boxes are this near are neighbours (instances)
    alike: float = 0.2  # largest difference of their coverage in any mask
    box_iou: float = 0.5  # of an instance with a mask in some view, to be kept
    em_extra: int = 5  # instances beyond those it starts from
    em_most: int = 28
    em_epochs: int = 10
    em_rate: float = 1.0  # of Adam
    em_connect: float = 0.025  # an instance is split where its points are further apart


@dataclass(frozen=True)
class PromptConfig:
    """Stage B by visual prompting (paper, 3.3)."""

    label_apart: float = 35.0  # [px] between the numbers of candidate points
    most_candidates: int = 20  # of k-means
    plane: float = 0.001  # of the connecting area's plane, a share of the diagonal; .002 where the diagonal is 2
    motions: int = 7  # shown in a picture when motion is verified: two rows of four with the pose at rest


VERIFY = ("motion", "free", "off")
PROPOSERS = r"exact|(exact\+)?sam:.+"


@dataclass(frozen=True)
class Config:
    """All settings of a run; its dictionary is part of the key of saved stage results."""

    seed: int = 0  # 0 or more
    category: str | None = None  # what the object is, in a user's words
    parts_list: tuple[str, ...] = ()  # labels of what moves, in a user's words; a model is not asked for them then
    proposer: str = "exact"  # of masks, see `segmentation.propose`
    verify: str = "motion"  # "free": answers are taken, but what cannot slide; "off": the paper's method as it is
    pieces: PiecesConfig = field(default_factory=PiecesConfig)
    segmentation: SegmentationConfig = field(default_factory=SegmentationConfig)
    articulation: ArticulationConfig = field(default_factory=ArticulationConfig)
    views: ViewsConfig = field(default_factory=ViewsConfig)
    grounding: GroundingConfig = field(default_factory=GroundingConfig)
    prompts: PromptConfig = field(default_factory=PromptConfig)

    def __post_init__(self) -> None:
        if self.seed < 0:
            raise OptionError(f"--seed: found {self.seed}; valid are integers from 0 up")
        if self.verify not in VERIFY:
            raise OptionError(f"--verify: found {self.verify!r}; valid are {', '.join(VERIFY)}")
        if not re.fullmatch(PROPOSERS, self.proposer):
            raise OptionError(f"--proposer: found {self.proposer!r}; valid are exact, sam:WEIGHTS and exact+sam:WEIGHTS")

    def as_dict(self) -> dict[str, object]:
        """Plain values, for keys and files."""
        return asdict(self)
