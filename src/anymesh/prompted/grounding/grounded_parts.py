"""What the ways of grounding share: the sampled object, the views that show it, and the parts that are found."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Int

from anymesh.config import Config
from anymesh.geometry.patches import ObjectShape
from anymesh.prompted.grounding.ask_marks import MarkQuestioner
from anymesh.prompted.grounding.close_ups import close_ups
from anymesh.prompted.grounding.cloud import Cloud, sample_cloud, seen_points
from anymesh.prompted.grounding.hidden import inner_faces, unseen_patches
from anymesh.prompted.grounding.unseen import StaysFree
from anymesh.rendering.render import View
from anymesh.runtime import Progress
from anymesh.types import Mesh

SURE, UNSURE = 0.9, 0.6  # confidence of a part from certain marks, and from uncertain ones
EXACT = "exact"
EXACT_POINTS = 120_000  # exact regions use the cloud for superpoints only, which need fewer points


@dataclass(frozen=True, eq=False)
class SampledObject:
    """A mesh with its patches and the points on its surface."""

    mesh: Mesh
    whole: ObjectShape
    cloud: Cloud


@dataclass(frozen=True, eq=False)
class GroundedParts:
    """Parts of the surface found by grounding.

    face_part: (F,) part index per face, 0 for the base; unseen: (F,) faces of patches that no view shows. The other sequences
    have one entry per part.
    """

    face_part: Int[np.ndarray, " F"]
    unseen: Bool[np.ndarray, " F"]
    labels: tuple[str, ...]
    confidence: tuple[float, ...]
    doubts: tuple[str, ...]
    pointed: frozenset[str]  # labels of the marked parts
    warnings: tuple[str, ...] = ()


Ground = Callable[
    [SampledObject, MarkQuestioner, float | None, Callable[[Sequence[str]], StaysFree], Progress], GroundedParts
]  # `ground_exactly`, or `ground_by_masks` with a segmenter


@dataclass(frozen=True, eq=False)
class ShownViews:
    """The views to choose pictures from, their names, and the patches that no outside view shows."""

    views: list[View]
    names: list[str]
    hidden: Bool[np.ndarray, " P"]


def sample_object(mesh: Mesh, whole: ObjectShape, config: Config) -> SampledObject:
    """Sample the points for finding parts; exact regions need fewer of them than masks."""
    few = min(config.grounding.points, EXACT_POINTS) if config.proposer == EXACT else config.grounding.points
    return SampledObject(mesh, whole, sample_cloud(mesh, whole, replace(config.grounding, points=few), config.seed))


def shown_views(
    sampled: SampledObject, questioner: MarkQuestioner, region: Int[np.ndarray, " F"], front: float | None
) -> ShownViews:
    """Return the views from all sides, close-ups of small regions, and views of the inside if there is one.

    front: azimuth of the front [deg], if known.
    """
    prompts, config, cloud = questioner.visual_prompts, questioner.config, sampled.cloud
    small = close_ups(region, cloud, prompts.views, config.views) if questioner.labels else ()
    seen = [*prompts.views, *(prompts.view(camera) for camera in small)]
    names = prompts.names(len(seen), front)
    shown = seen_points(cloud, seen)
    inside = inner_faces(sampled.mesh, sampled.whole, cloud, shown)
    if questioner.labels and inside.any():
        seen, names = [*seen, *prompts.insides(inside)], [*names, *prompts.inside_names(front)]
    return ShownViews(seen, names, unseen_patches(sampled.whole, cloud, shown))
