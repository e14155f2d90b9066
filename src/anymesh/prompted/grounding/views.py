"""The views that marks are chosen from: all sides, close-ups of regions that are too small there, and the inside."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.config import REFERENCE_PX, Config
from anymesh.geometry.surface import ObjectShape
from anymesh.prompted.grounding.alike import region_sizes, small_regions, wires
from anymesh.prompted.grounding.cloud import Cloud, sample_cloud, seen_points
from anymesh.prompted.grounding.faces import MIN_SEEN_SHARE, patch_sizes
from anymesh.prompted.grounding.mark_questions import MarkQuestioner
from anymesh.prompted.grounding.regions import face_regions, join_doubled, join_wires
from anymesh.rendering.render import View
from anymesh.rendering.viewpoints import framed
from anymesh.types import Brief, Mesh
from anymesh.types.camera import Camera

MAX_SEEN_SHARE = 0.25  # patches up to this visible share of the surface count as mostly hidden
MIN_INNER_PATCH_RATIO = 0.05  # of the object's diagonal: hidden patches with a smaller diagonal are not shown
# of the object's diagonal: minimum size of a hidden patch for the inside to be shown when the object is recognized
MIN_RECOGNITION_PATCH_RATIO = 0.1
MAX_CLOSE_UPS, MAX_MACHINE_CLOSE_UPS = 8, 16  # close-ups per object, and per machine; each adds a picture to a question
REGIONS = 4  # of a machine, whose close-ups are asked about on their own
MAX_DETAIL_RATIO = 0.25  # of the object's diagonal: larger surfaces are in no region; an estimate
MIN_AREA_PX, MIN_WIDTH_PX = 250.0, 4.0  # [px, px across] in a 640 px view: regions below either are too small to judge
LEGIBLE_AREA_PX, LEGIBLE_WIDTH_PX = 1500.0, 12.0  # [px, px across] size that a close-up should give such regions
MIN_ZOOM, MAX_ZOOM = 2.0, 6.4  # magnification of a close-up
MIN_CLOSE_UP_SHARE = 0.1  # share of a region's surface that views must see; less is a glimpse through a gap
REGION_AIR = 0.06  # margin around a region in its close-up, as a share of its box on each side
WINDOW = 0.8  # share of the close-up's side that holds the centers of its regions
EXACT = "exact"
MASK_POINTS = 800_000  # samples of the surface
EXACT_POINTS = 120_000  # exact regions use the cloud for superpoints only, which need fewer points


def unseen_patches(
    whole: ObjectShape, cloud: Cloud, shown: Bool[np.ndarray, " n"], share: float = MIN_SEEN_SHARE
) -> Bool[np.ndarray, " P"]:
    """Return the patches whose visible share of the surface is at most `share`."""
    patch = whole.mesh_patch[cloud.faces]
    total = np.bincount(patch, minlength=int(whole.mesh_patch.max()) + 1)
    return np.bincount(patch, shown, len(total)) <= share * total


def inner_faces(
    mesh: Mesh, whole: ObjectShape, cloud: Cloud, shown: Bool[np.ndarray, " n"], min_size: float = MIN_INNER_PATCH_RATIO
) -> Bool[np.ndarray, " F"]:
    """Return the faces of mostly hidden patches that are large enough to be shown and asked about.

    Return no faces if no hidden patch has a diagonal of at least `min_size`, a share of the object's.
    """
    hidden, size = unseen_patches(whole, cloud, shown, MAX_SEEN_SHARE), patch_sizes(mesh, whole) / whole.diagonal
    if not (hidden & (size >= min_size)).any():
        return np.zeros(len(whole.mesh_patch), bool)
    return (hidden & (size >= MIN_INNER_PATCH_RATIO))[whole.mesh_patch]


def close_ups(
    region: Int[np.ndarray, " F"], cloud: Cloud, views: Sequence[View], most: int = MAX_CLOSE_UPS
) -> tuple[Camera, ...]:
    """Return at most `most` cameras for regions that are too small in every view.

    The smallest regions come first. Each camera stands where one of the views does and covers as many small regions as fit.

    region: index of each face, -1 for none.
    """
    size, across, middle = _shown(region, views)
    scale = views[0].camera.height / REFERENCE_PX
    zoom = np.sqrt(LEGIBLE_AREA_PX * scale**2 / np.maximum(size, 1))
    zoom = np.maximum(zoom, np.where(across < MIN_WIDTH_PX * scale, LEGIBLE_WIDTH_PX * scale / np.maximum(across, 0.1), 0))
    zoom = np.clip(zoom, MIN_ZOOM, MAX_ZOOM)
    little = (size < MIN_AREA_PX * scale**2).all(0) | (across < MIN_WIDTH_PX * scale).all(0)
    open_to = little & (size > 0).any(0) & _open(region, cloud, views)
    cameras: list[Camera] = []
    while open_to.any() and len(cameras) < most:
        first = int(np.where(open_to, size.max(0), np.inf).argmin())
        v = int(size[:, first].argmax())
        wanted = float(zoom[v, first])
        reach = WINDOW * views[v].camera.height / wanted / 2
        near = open_to & (size[v] > 0) & (np.abs(middle[v] - middle[v, first]) <= reach).all(1)
        near &= size[v] * wanted**2 >= 0.5 * size.max(0)  # leave out regions that another view shows better
        low, high = middle[v, near].min(0), middle[v, near].max(0)
        cameras.append(_camera(views[v], (low + high) / 2, wanted))
        open_to[near] = False
    return tuple(cameras)


def _shown(
    region: np.ndarray, views: Sequence[View]
) -> tuple[Int[np.ndarray, "V R"], Float[np.ndarray, "V R"], Float[np.ndarray, "V R 2"]]:
    """Return the pixels, the width [px] and the center (column, row) of every region in every view."""
    count = int(region.max()) + 1
    sizes, widths, middles = [], [], []
    for view in views:
        label = np.where(view.face >= 0, region[np.maximum(view.face, 0)], -1)
        row, column = np.nonzero(label >= 0)
        own = label[row, column]
        size = np.bincount(own, minlength=count)
        rim = np.zeros(count)
        for one, two in ((label[:, 1:], label[:, :-1]), (label[1:], label[:-1])):
            for side, differs in ((one, one != two), (two, one != two)):
                at = side[differs]
                rim += np.bincount(at[at >= 0], minlength=count)
        at = [np.bincount(own, x + 0.5, count) / np.maximum(size, 1) for x in (column, row)]
        sizes.append(size)
        widths.append(2 * size / np.maximum(rim, 1))
        middles.append(np.stack(at, 1))
    return np.stack(sizes), np.stack(widths), np.stack(middles)


def _open(region: np.ndarray, cloud: Cloud, views: Sequence[View]) -> Bool[np.ndarray, " R"]:
    """Return the regions of which the views see at least MIN_CLOSE_UP_SHARE of the surface."""
    seen = seen_points(cloud, views)
    own = region[cloud.faces]
    count = int(region.max()) + 1
    return np.bincount(own[seen & (own >= 0)], minlength=count) >= MIN_CLOSE_UP_SHARE * np.maximum(
        np.bincount(own[own >= 0], minlength=count), 1
    )


def _camera(view: View, pixel: np.ndarray, zoom: float) -> Camera:
    """Return a camera at the same place that looks at a pixel of the view with `zoom` times its magnification."""
    camera = view.camera
    local = np.r_[(pixel - np.array([camera.width, camera.height]) / 2) / camera.focal, 1.0]
    eye = camera.T_world_camera[:3, 3]
    fov = 2 * float(np.arctan(np.tan(camera.fov / 2) / zoom))
    return Camera.looking_at(eye, eye + camera.T_world_camera[:3, :3] @ local, fov, camera.width, camera.height)


@dataclass(frozen=True, eq=False)
class SampledObject:
    """A mesh with its patches and the points on its surface."""

    mesh: Mesh
    whole: ObjectShape
    cloud: Cloud

    @cached_property
    def regions(self) -> Int[np.ndarray, " F"]:
        """Region of each face; a surface that is there twice is one region."""
        return join_doubled(face_regions(self.whole, self.cloud), self.mesh, self.cloud)


@dataclass(frozen=True, eq=False)
class ShownViews(Brief):
    """The views to choose pictures from, their names, the patches that no outside view shows, and the region of each face.

    small: number of regions that are too small to be asked about.
    """

    views: list[View]
    names: list[str]
    hidden: Bool[np.ndarray, " P"]
    region: Int[np.ndarray, " F"]
    small: int = 0


def region_cameras(sampled: SampledObject, views: Sequence[View]) -> list[tuple[int, int, Camera]]:
    """Return close-ups of the regions of a machine: the region, from 1, the index of the view that shows it, and the camera.

    Each is shown in the view whose close-up shows most of its surfaces legibly, and in the one that shows most of the rest.
    """
    cloud, own = sampled.cloud, sampled.regions[sampled.cloud.faces]
    seen, (size, _, _) = np.array([seen_points(cloud, [view]) for view in views]), _shown(sampled.regions, views)
    cameras = []
    for number, cell in enumerate(_cells(sampled, np.flatnonzero(seen.any(0))), start=1):
        near = [framed(view.camera, cloud.points[cell], REGION_AIR, view.camera.height) for view in views]
        gain = [(np.tan(v.camera.fov / 2) / np.tan(c.fov / 2)) ** 2 for v, c in zip(views, near, strict=True)]
        surfaces, of, count = np.unique(own[cell], return_inverse=True, return_counts=True)
        legible = LEGIBLE_AREA_PX * (views[0].camera.height / REFERENCE_PX) ** 2
        clear = np.minimum(size[:, surfaces] * np.array(gain)[:, None] / legible, 1.0) / count
        value = seen[:, cell] * clear[:, of]
        first = int(value.sum(1).argmax())
        second = int((value * ~seen[first, cell]).sum(1).argmax())
        cameras += [(number, v, near[v]) for v in dict.fromkeys((first, second))]
    return cameras


def _cells(sampled: SampledObject, seen: Int[np.ndarray, " n"]) -> list[Int[np.ndarray, " c"]]:
    """Return the points of each region of an object: clusters of surfaces whose middles are near each other (Ward).

    Each surface has one weight, so there are as many regions in a gondola or a tail as it has surfaces, and none on a plain
    hull: surfaces of more than a quarter of the object are left out. Where few are left, as of a fused object, regions are
    halves of halves of the box, across its longest side.

    seen: indices of the points that a view shows.
    """
    from scipy.cluster.hierarchy import fcluster, linkage  # import on use, as in `lines.cluster_points`

    own, points = sampled.regions[sampled.cloud.faces[seen]], sampled.cloud.points[seen]
    small = np.flatnonzero(region_sizes(sampled.regions, sampled.mesh) < MAX_DETAIL_RATIO * sampled.whole.diagonal)
    surfaces, of, count = np.unique(np.where(np.isin(own, small), own, -1), return_inverse=True, return_counts=True)
    if (surfaces >= 0).sum() > REGIONS:
        middle = np.stack([np.bincount(of, x) for x in points.T], 1) / count[:, None]
        cluster = np.zeros(len(surfaces), int)
        cluster[surfaces >= 0] = fcluster(linkage(middle[surfaces >= 0], "ward"), REGIONS, "maxclust")
        return [seen[cluster[of] == number] for number in np.unique(cluster[surfaces >= 0])]
    cells = [seen]
    for _ in range(2):
        cells = [half for cell in cells for half in _halved(sampled.cloud.points, cell)]
    return [cell for cell in cells if len(cell)]


def _halved(points: Float[np.ndarray, "n 3"], cell: Int[np.ndarray, " c"]) -> list[Int[np.ndarray, " h"]]:
    """Return the two halves of some points, cut across the longest side of their box."""
    if not len(cell):
        return [cell]
    low, high = points[cell].min(0), points[cell].max(0)
    axis = int((high - low).argmax())
    upper = points[cell, axis] > (low[axis] + high[axis]) / 2
    return [cell[~upper], cell[upper]]


def sample_object(mesh: Mesh, whole: ObjectShape, config: Config) -> SampledObject:
    """Sample the points for finding parts; exact regions need fewer of them than masks."""
    count = EXACT_POINTS if config.proposer == EXACT else MASK_POINTS
    return SampledObject(mesh, whole, sample_cloud(mesh, whole, count, config.seed))


def shown_views(sampled: SampledObject, questioner: MarkQuestioner, front: float | None) -> ShownViews:
    """Return the views from all sides, close-ups of small regions, and views of the inside if there is one.

    front: azimuth of the front [deg], if known.
    """
    prompts, cloud = questioner.visual_prompts, sampled.cloud
    regions, small = sampled.regions, set[int]()
    if questioner.config.detail == "low":
        small = small_regions(regions, sampled.mesh, sampled.whole.diagonal)
        regions = np.where(np.isin(regions, list(small)), -1, regions)
    size, across, _ = _shown(regions, prompts.views)
    narrow = across < MIN_WIDTH_PX * prompts.views[0].camera.height / REFERENCE_PX
    thin = np.logical_and((size > 0).any(0), narrow.all(0)) & wires(regions, sampled.mesh)
    region, racks = join_wires(regions, thin, prompts.views, sampled.whole.diagonal)
    most = MAX_MACHINE_CLOSE_UPS if questioner.machine else MAX_CLOSE_UPS
    near = close_ups(np.where(np.isin(region, racks), -1, region), cloud, prompts.views, most) if questioner.labels else ()
    seen = [*prompts.views, *(prompts.view(camera) for camera in near)]
    names = prompts.names(len(seen), front)
    shown = seen_points(cloud, seen)
    inside = inner_faces(sampled.mesh, sampled.whole, cloud, shown)
    if questioner.labels and inside.any():
        seen, names = [*seen, *prompts.insides(inside)], [*names, *prompts.inside_names(front)]
    return ShownViews(seen, names, unseen_patches(sampled.whole, cloud, shown), region, len(small))
