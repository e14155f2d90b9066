"""Settings of the pipeline that users may change, with their units and sources, and constants that both stages share."""

from __future__ import annotations

import re
from dataclasses import asdict, dataclass, field

from anymesh.errors import OptionError

# shared by both stages; not settings
ALONG_COSINE = 0.7  # about 45 degrees: minimum cosine between two directions that are along each other, not across
FACING_COSINE = 0.5  # 60 degrees: minimum cosine between a normal or a motion and the side that it faces
LEVEL_COSINE = 0.8  # 37 degrees: minimum cosine between the vertical and the normal of a level face
ACROSS_COSINE = 0.3  # 73 degrees: maximum cosine between two directions that are across each other
SAME_AXIS_COSINE = 0.97  # 14 degrees: minimum cosine between axes that a user sees as one
SAME_SIZE = 0.02  # maximum relative difference of the diagonals, or of the spreads, of copies


@dataclass(frozen=True)
class PatchConfig:
    """Division of the surface into patches. Lengths are relative to the object's diagonal."""

    crease: float = 25.0  # [deg] minimum angle of a concave edge that may bound a part on a fused surface
    fused_size: float = 0.35  # components smaller than this are not cut along their creases
    superpoint_strength: float = 0.05  # of l0 cut pursuit on normals (the paper's implementation)
    superpoint_faces: int = 40_000  # denser components are simplified before they are cut into superpoints
    soft_faces: int = 3000  # components with fewer faces have sharp creases only
    seams: bool = False  # also divide where creases are closed in places; on if pictures are answered (`Solver`)
    reach: float = 0.01  # distance from a soft crease within which the surface defines its angle
    crumb: float = 0.02  # regions smaller than this, left by a cut, join their neighbour
    most_faces: int = 8000  # denser meshes are simplified for questions of shape and motion, never in the output
    least_faces: int = 60  # minimum number of faces kept of a patch
    most_patches: int = 1500  # number of patches above which small ones join their nearest larger one
    most_pairs: int = 20_000  # number of pairs of patches with meeting boxes above which they do so too


@dataclass(frozen=True)
class SegmentationConfig:
    """Stage A (paper, 3.2). Lengths are relative to the object's diagonal."""

    touch: float = 0.0004  # patches closer than this touch; clearances of real fits are wider
    near: float = 0.02  # components closer than this, but not touching, have a clearance
    smallest: float = 0.004  # patches with a smaller diagonal never move on their own
    most_candidates: int = 600  # largest groups of patches that are examined as parts
    at_least: int = 0  # minimum number of parts, even with weak evidence, for objects that are known to move

    def __post_init__(self) -> None:
        if self.at_least < 0:
            raise OptionError(f"--at-least: found {self.at_least}; valid are integers from 0 up")


@dataclass(frozen=True)
class ArticulationConfig:
    """Stage B (paper, 3.3). Lengths are relative to `PartContext.tolerance_length` unless stated otherwise."""

    connecting: float = 0.005  # threshold of the connecting area; 0.01 for a diagonal of 2 (the paper's implementation)
    penetration: float = 0.003  # depth behind a surface at which a path is stopped
    support: float = 0.02  # maximum distance between a hinge line and the parent that supports it
    most_swept: int = 8  # motions of a part that are swept, the likeliest of the part at rest; more choose no better
    late_swept: int = 2  # the same when most of the time limit is spent
    sweep_steps: int = 36  # steps of a sweep in each direction: 5 degrees each over half a turn
    fine_steps: int = 30  # for the limits: three times as many over the range of a hinge, twice as many of a slide
    door_most: float = 110.0  # [deg] upper limit of an unobstructed hinge with an upright axis (common cup hinges)
    flap_most: float = 90.0  # [deg] upper limit of an unobstructed hinge with a horizontal axis
    slide_hidden: float = 0.6  # travel of a panel whose box is hidden, as a share of the parent's depth
    slide_keep: float = 0.1  # share of a drawer's depth that stays inside when it is open


REFERENCE_PX = 640  # [px] height of a picture that sizes in pixels refer to
PAPER_VIEWS = "8@15"
DEFAULT_VIEWS = f"{PAPER_VIEWS},2@50+30,1@-35+30"
MAX_VIEWS = 32
RING = re.compile(r"(?P<count>[1-9]\d?)@(?P<elevation>-?\d{1,2}(\.\d+)?)(\+(?P<azimuth>\d{1,3}(\.\d+)?))?")


@dataclass(frozen=True)
class ViewsConfig:
    """The views that a model is shown. Lengths are relative to the object's diagonal.

    The paper's implementation has `around` = PAPER_VIEWS with the fixed field of view. At 15 degrees elevation the camera is
    below the top of anything taller than about half its diagonal. Therefore more views look down, and one looks up. Each camera
    is rotated and zoomed until the object fills its picture.
    """

    around: str = DEFAULT_VIEWS  # rings of cameras: COUNT@ELEVATION or COUNT@ELEVATION+AZIMUTH [deg], separated by commas
    inside: str = "2@25+45,1@60+30"  # the same for surface that no view shows, drawn with the rest transparent
    distance: float = 1.0  # of the camera from the object's center; 2 for a diagonal of 2 (the paper's implementation)
    fov: float = 60.0  # [deg] vertical, before the camera is zoomed (the paper's implementation)
    air: float = 0.04  # margin around the object on each side, as a share of its box in the picture
    size: int = REFERENCE_PX  # [px] width and height
    zoom_size: int = 4096  # [px] size of the picture that a close-up is cut from
    zoom_below: int = 5000  # [px] a part that covers less of the best view is shown in a close-up
    zoom_margin: float = 0.3  # margin on each side, as a share of the part's box in the picture

    def __post_init__(self) -> None:
        for views in (self.around, self.inside):
            rings = [RING.fullmatch(ring) for ring in views.split(",")]
            count = sum(int(ring["count"]) for ring in rings if ring)
            steep = any(abs(float(ring["elevation"])) > 90 for ring in rings if ring)
            if not all(rings) or not 1 <= count <= MAX_VIEWS or steep:
                raise OptionError(
                    f"--viewpoints: found {views!r}; valid are COUNT@ELEVATION or COUNT@ELEVATION+AZIMUTH [deg] with commas "
                    f"between, such as {DEFAULT_VIEWS} or {PAPER_VIEWS} (the paper's), 1 to {MAX_VIEWS} views in all"
                )

    @property
    def directions(self) -> tuple[tuple[float, float], ...]:
        """Return azimuth and elevation of each camera [deg], ring by ring, evenly spread over each ring."""
        return _directions(self.around)

    @property
    def inside_directions(self) -> tuple[tuple[float, float], ...]:
        """Return the same for the cameras of the inside."""
        return _directions(self.inside)


def _directions(rings: str) -> tuple[tuple[float, float], ...]:
    directions: list[tuple[float, float]] = []
    for text in rings.split(","):
        ring = RING.fullmatch(text)
        assert ring is not None  # checked by ViewsConfig
        count, first = int(ring["count"]), float(ring["azimuth"] or 0)
        directions += [((first + 360 * k / count) % 360, float(ring["elevation"])) for k in range(count)]
    return tuple(directions)


@dataclass(frozen=True)
class GroundingConfig:
    """Stage A by set-of-mark grounding (paper, 3.2; PartSlip++). Lengths are relative to the object's diagonal."""

    points: int = 800_000  # samples of the surface
    neighbours: int = 10
    strength: float = 0.05  # of l0 cut pursuit on [normal, color_weight * colour]
    color_weight: float = 0.3
    least_points: int = 10  # smaller superpoints join a neighbour
    least_mask: int = 200  # [px] of a 640 px view; smaller masks are dropped (1000 in the paper, which loses small parts)
    alpha: float = 0.1  # opacity of the mask colours over the picture
    whole: float = 0.95  # masks that cover a larger share of the object are ignored
    covered: float = 0.5  # minimum share of a superpoint's visible points in a mask for the mask's label
    join_component: float = 0.03  # maximum distance of a component that joins a part
    gap: float = 0.01  # maximum distance between the boxes of neighbouring superpoints (instances)
    alike: float = 0.2  # maximum difference of their coverage in any mask
    box_iou: float = 0.5  # minimum IoU of an instance with a mask in some view
    em_extra: int = 5  # instances in addition to the initial ones
    em_most: int = 28  # instances up to which em_extra are added; initial ones are never dropped
    em_epochs: int = 10
    em_rate: float = 1.0  # learning rate of Adam
    em_connect: float = 0.025  # an instance is split at larger distances between its points


@dataclass(frozen=True)
class PromptConfig:
    """Stage B by visual prompting (paper, 3.3)."""

    label_apart: float = 35.0  # [px] minimum distance between the numbers of candidate points
    most_candidates: int = 20  # maximum number of candidate points, and of k-means clusters
    plane: float = 0.001  # of the diagonal: tolerance of the connecting area's plane; 0.002 for a diagonal of 2
    motions: int = 7  # motions per picture when motions are verified: two rows of four with the pose at rest


VERIFY = ("motion", "free", "off")
PROPOSERS = r"exact|(exact\+)?sam:.+"


@dataclass(frozen=True)
class Config:
    """All settings of a run; its dictionary is part of the key of saved stage results."""

    seed: int = 0  # 0 or more
    category: str | None = None  # of the object, given by a user
    parts_list: tuple[str, ...] = ()  # labels of movable parts, given by a user; a model is then not asked for them
    proposer: str = "exact"  # of masks, see `segmentation.propose`
    verify: str = "motion"  # "free": answers are used, except for slides that are blocked; "off": the paper's method unchanged
    patches: PatchConfig = field(default_factory=PatchConfig)
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
        """Return plain values, for keys and files."""
        return asdict(self)
