"""Cameras for what is too small to be marked in any view: a button on a machine is two pixels of a picture of all of it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.config import GroundingConfig, ViewsConfig
from anymesh.geometry.pieces import ObjectShape
from anymesh.rendering.render import View
from anymesh.segmentation.cloud import Cloud, sight
from anymesh.segmentation.propose import LEAST_EXACT, face_regions, least_pixels
from anymesh.types.camera import Camera

MOST = 4  # close-ups; each is one more picture in a question
OPEN = 0.25  # share of a region's surface that views see; less is seen through a gap
WINDOW = 0.8  # of the close-up's side in which the regions' middles lie


def close_ups(
    whole: ObjectShape, cloud: Cloud, views: Sequence[View], grounding: GroundingConfig | None = None,
    pictures: ViewsConfig | None = None,
) -> tuple[Camera, ...]:  # fmt: skip
    """At most MOST cameras, none where nothing is too small: each from the place of a view, on as many of the small regions
    as a crop from a picture of `zoom_size` holds."""
    grounding, pictures = grounding or GroundingConfig(), pictures or ViewsConfig()
    region = face_regions(whole, cloud)
    size, middle = _shown(region, views)
    zoom = pictures.zoom_size / pictures.size
    least = np.array([LEAST_EXACT * least_pixels(v, grounding) for v in views])[:, None]
    open_to = ((size < least).all(0) & (size * zoom**2 >= least).any(0)) & _open(region, cloud, views)
    found = []
    while open_to.any() and len(found) < MOST:
        at, group = 0, np.zeros(0, np.int64)
        for v, view in enumerate(views):
            there = np.flatnonzero(open_to & (size[v] * zoom**2 >= least[v]))
            reach = WINDOW * view.camera.height / zoom / 2
            apart = middle[v, there][:, None] - middle[v, there][None]
            held = (np.abs(apart) <= reach).all(2)
            if len(there) and held.sum(1).max() > len(group):
                at, group = v, there[held[held.sum(1).argmax()]]
        found.append(_camera(views[at], middle[at, group].mean(0), zoom))
        open_to[group] = False
    return tuple(found)


def _shown(region: np.ndarray, views: Sequence[View]) -> tuple[Int[np.ndarray, "V R"], Float[np.ndarray, "V R 2"]]:
    """Pixels of every region in every view, and the middle of these (column, row)."""
    count = int(region.max()) + 1
    sizes, middles = [], []
    for view in views:
        row, column = np.nonzero(view.face >= 0)
        label = region[view.face[row, column]]
        size = np.bincount(label, minlength=count)
        at = [np.bincount(label, x + 0.5, count) / np.maximum(size, 1) for x in (column, row)]
        sizes.append(size)
        middles.append(np.stack(at, 1))
    return np.stack(sizes), np.stack(middles)


def _open(region: np.ndarray, cloud: Cloud, views: Sequence[View]) -> Bool[np.ndarray, " R"]:
    """Regions of which views see a good share."""
    seen = np.zeros(len(cloud), bool)
    for view in views:
        seen[sight(cloud, view).points] = True
    own = region[cloud.faces]
    return np.bincount(own[seen], minlength=int(region.max()) + 1) >= OPEN * np.maximum(np.bincount(own), 1)


def _camera(view: View, pixel: np.ndarray, zoom: float) -> Camera:
    """From the same place, `zoom` times nearer, at what lies under a pixel."""
    camera = view.camera
    local = np.r_[(pixel - np.array([camera.width, camera.height]) / 2) / camera.focal, 1.0]
    eye = camera.T_world_camera[:3, 3]
    fov = 2 * float(np.arctan(np.tan(camera.fov / 2) / zoom))
    return Camera.looking_at(eye, eye + camera.T_world_camera[:3, :3] @ local, fov, camera.width, camera.height)
