"""Pictures for questions: an object with its parts, seen from the paper's views, from inside and in close-up."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8
from PIL import Image, ImageDraw

from anymesh.config import REFERENCE_PX, Config
from anymesh.geometry.raycast_ import RayScene
from anymesh.prompted.pictures.drawing import HIGHLIGHT, clearest_view, draw_arrows, draw_points, highlight
from anymesh.prompted.pictures.sides import ANYWHERE, SeenFrom
from anymesh.prompted.pictures.strips import motion_strip, silhouette
from anymesh.prompted.pictures.views import (
    best_view,
    cameras,
    caption,
    close_up,
    hidden_points,
    is_beside,
    part_pixels,
    shown,
    views,
    visible_pixels,
)
from anymesh.rendering.drawing import smoothed
from anymesh.rendering.marks import font, lighten
from anymesh.rendering.render import View, encode, face_colors
from anymesh.types import Brief, Mesh, Motion, Picture
from anymesh.types.camera import Camera

TITLE = 22  # [px] font size in a picture of 640 px
BAR = 34  # [px] height of the title bar
MIN_CARD_SHARE = 0.5  # minimum share of the part's pixels in its best view, for a view to be considered
CONTACT_POINTS = 300  # maximum number of contact points checked in each view
CONTACT_UNDER = 0.02  # share of the contact's extent: points deeper than this below a surface count as hidden
GHOST = 0.75  # share by which the colours of the rest are moved towards white
# azimuth and elevation [deg] of cameras that are shown surface that no view shows, with the rest as a ghost
INSIDE_DIRECTIONS = ((45.0, 25.0), (225.0, 25.0), (30.0, 60.0))
GLASS = 0.6  # share of what lies under a part in a picture in which the part looks as if it were glass
SEEN = 0.9  # share of the points of a hinge above which one view is enough; an estimate
DEPTH_WEIGHT = 0.3  # weight of the angle to the first view for the second one; an estimate
ARROW = 0.35  # length of an arrow, as a share of the part's size
Facing = tuple[tuple[int, ...], np.ndarray]  # parts that are drawn from one side, and the direction in which they open
UNDER = 0.003  # share of the diagonal: points deeper than this below a surface count as hidden


def part_card(
    mesh: Mesh,
    view: View,
    face_part: Int[np.ndarray, " F"],
    part: int,
    title: str,
    scene: RayScene,
) -> UInt8[np.ndarray, "H W 3"]:
    """Draw the part in a view of this mesh, the close-up (if any) beside it, and the title above.

    scene: the mesh's rays. A hidden part is drawn through what covers it, and the title says so.
    """
    mask = part_pixels(view, face_part, part)
    if not mask.any():
        mask = silhouette(mesh.triangles[face_part == part], view.camera)
        return titled(highlight(view.color, mask), f"{title} (hidden inside)")
    near = close_up(mesh, view, face_part, part, scene)
    whole = highlight(view.color, mask)
    if near is None:
        return titled(whole, title)
    close = highlight(near.color, part_pixels(near, face_part, part), alpha=0.2)
    return titled(np.concatenate([_framed(whole, view, near), _edged(close)], 1), title)


def card_view(
    views: Sequence[View],
    face_part: Int[np.ndarray, " F"],
    part: int,
    scene: RayScene,
    contact: Float[np.ndarray, "c 3"] | None = None,
) -> View:
    """Return the view that shows most of the contact, among those that show the part well.

    contact: points where the part meets the rest [m]; without them, the view that shows most of the part is used.
    """
    if contact is None or len(contact) == 0:
        return views[best_view(views, face_part, part)]
    few = contact[:: max(1, len(contact) // CONTACT_POINTS)]
    pixels = np.array([visible_pixels(v, face_part, part) for v in views])
    depth = CONTACT_UNDER * float(np.linalg.norm(np.ptp(contact, axis=0)))
    seen = np.array([(~hidden_points(scene, v.camera, few, depth)).mean() for v in views])
    return views[int(np.where(pixels >= MIN_CARD_SHARE * pixels.max(), pixels / max(pixels.max(), 1) + seen, -1.0).argmax())]


def _framed(image: UInt8[np.ndarray, "H W 3"], view: View, near: View) -> UInt8[np.ndarray, "H W 3"]:
    """Draw a frame in the picture of the whole object around the region of the close-up."""
    size = near.camera.width
    corners = np.array([[0, 0], [size, 0], [size, size], [0, size]]) - size / 2
    T = near.camera.T_world_camera
    rays = np.concatenate([corners / near.camera.focal, np.ones((4, 1))], 1) @ T[:3, :3].T
    pixels = view.camera.project(T[:3, 3] + rays)[0]
    drawn = Image.fromarray(image)
    outline = [tuple(p) for p in (*pixels, pixels[0])]
    draw = ImageDraw.Draw(drawn)
    draw.line(outline, fill=(255, 255, 255), width=5)
    draw.line(outline, fill=(20, 20, 20), width=2)
    return np.asarray(drawn)


def _edged(image: UInt8[np.ndarray, "H W 3"]) -> UInt8[np.ndarray, "H W 3"]:
    drawn = Image.fromarray(image)
    ImageDraw.Draw(drawn).rectangle([0, 0, image.shape[1] - 1, image.shape[0] - 1], outline=(20, 20, 20), width=2)
    return np.asarray(drawn)


def titled(image: UInt8[np.ndarray, "H W 3"], title: str) -> UInt8[np.ndarray, "h W 3"]:
    """Put a bar with a title above the picture; characters that the font lacks become question marks."""
    scale = max(1.0, image.shape[0] / REFERENCE_PX)
    bar = Image.new("RGB", (image.shape[1], round(BAR * scale)), (255, 255, 255))
    text = title.encode("ascii", "replace").decode()
    draw = ImageDraw.Draw(bar)
    draw.rectangle([0, 0, round(10 * scale), bar.height], fill=HIGHLIGHT)
    draw.text((20 * scale, bar.height / 2), text, fill=(20, 20, 20), font=font(round(TITLE * scale)), anchor="lm")
    return np.concatenate([np.asarray(bar), image])


def inside_views(mesh: Mesh, inside: Bool[np.ndarray, " F"], cameras: Sequence[Camera], scene: RayScene) -> list[View]:
    """Render only the faces `inside` from each camera. scene: of the whole mesh, which is drawn as a ghost."""
    own = np.flatnonzero(inside)
    part = mesh.subset(inside)
    rays = RayScene(part.vertices, part.faces)
    views = []
    for camera in cameras:
        near, whole = shown(part, camera, rays), shown(mesh, camera, scene)
        face = np.where(near.face >= 0, own[np.maximum(near.face, 0)], -1)
        views.append(replace(near, face=face, paint=partial(_over_ghost, near, whole)))
    return views


def _over_ghost(near: View, whole: View) -> UInt8[np.ndarray, "H W 3"]:
    """Return the picture of some faces over the lightened picture of all."""
    return np.where((near.face >= 0)[..., None], near.color, lighten(whole.color, GHOST))


@dataclass(frozen=True, eq=False)
class Shot(Brief):
    """A part in one or two views, in close-up where it is small.

    masks: (H, W) pixels of the part in each view; through: draws a view without the part; hidden_in: which points [m] lie
    below a surface in a view.
    """

    views: tuple[View, ...]
    masks: tuple[np.ndarray, ...]
    through: Callable[[View], np.ndarray]
    hidden_in: Callable[[View, np.ndarray], np.ndarray]

    def project(self, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n k"]:
        """Project points [m] to pixels of the pictures, without the title bar: x and y of each view."""
        return np.concatenate([view.camera.project(points)[0] for view in self.views], 1)

    def _drawn(self, points: Float[np.ndarray, "n 3"]) -> Bool[np.ndarray, "v n"]:
        """Return which points [m] lie inside each picture, so that they can be drawn."""
        sizes = np.array([[view.camera.width, view.camera.height] for view in self.views])
        pixels = self.project(points).reshape(len(points), len(self.views), 2)
        return np.all((pixels >= 0) & (pixels < sizes), axis=2).T

    def is_inside(self, points: Float[np.ndarray, "n 3"]) -> Bool[np.ndarray, " n"]:
        """Return which points [m] lie inside a picture."""
        return np.any(self._drawn(points), axis=0)

    def inside(self, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "k 3"]:
        """Return the points [m] inside a picture; if there are none, the one nearest to the centre of the first."""
        if len(points) == 0 or (kept := self.is_inside(points)).any():
            return points[kept] if len(points) else points
        middle = np.array([self.views[0].camera.width, self.views[0].camera.height]) / 2
        return points[np.linalg.norm(self.project(points)[:, :2] - middle, axis=1).argmin()][None]

    def hidden(self, points: Float[np.ndarray, "k 3"]) -> Bool[np.ndarray, " k"]:
        """Return which points [m] no view shows, as they lie below a surface."""
        return np.all([self.hidden_in(view, points) for view in self.views], axis=0)

    def with_points(self, points: Float[np.ndarray, "k 3"], title: str) -> Picture:
        """Draw the views side by side with points numbered 1, 2, ..., each where it is seen.

        Those that no view shows are hollow, in every view that they lie in, and the part is drawn as if it were glass.
        """
        hidden, panels = np.array([self.hidden_in(view, points) for view in self.views]), []
        inside = self._drawn(points)
        drawn = inside & (~hidden | (hidden | ~inside).all(0))
        for view, mask, here, under in zip(self.views, self.masks, drawn, hidden, strict=True):
            k = np.flatnonzero(here)
            image = np.where((mask & under[k].any())[..., None], self._glass(view), view.color) if len(k) else view.color
            tinted = highlight(image.astype(np.uint8), mask, alpha=0.15 if under[k].any() else 0.3)
            panels.append(draw_points(tinted, view.camera.project(points[k])[0], (k + 1).tolist(), under[k]))
        return encode(titled(np.concatenate([panels[0], *map(_edged, panels[1:])], 1), title))

    def _glass(self, view: View) -> UInt8[np.ndarray, "H W 3"]:
        return np.round(GLASS * self.through(view) + (1 - GLASS) * view.color).astype(np.uint8)


class VisualPrompts:
    """Draws the pictures of one object, and of its parts (face_part: (F,) part index per face)."""

    def __init__(self, mesh: Mesh, config: Config) -> None:
        self.mesh, self._config = smoothed(mesh), config
        self._pixels: tuple[bytes, np.ndarray] | None = None  # the last parts, and the pixels of each in each view
        self._inside: tuple[bytes, list[View]] | None = None  # the last faces that were shown alone, and their views

    @cached_property
    def scene(self) -> RayScene:
        """Ray scene of the mesh."""
        return RayScene(self.mesh.vertices, self.mesh.faces)

    @cached_property
    def views(self) -> list[View]:
        """Views of the object from all sides."""
        return views(self.mesh, self._config.directions, scene=self.scene)

    @cached_property
    def face_colors(self) -> Float[np.ndarray, "F 3"]:
        """sRGB colour of each face, 0..1."""
        return face_colors(self.mesh) / 255.0

    def view(self, camera: Camera) -> View:
        """Render the view of another camera."""
        return shown(self.mesh, camera, self.scene)

    def near(self, view: View, camera: Camera) -> View:
        """Render a close-up of a view: what it shows of the inside alone, if it is one of `insides`."""
        if self._inside is not None and any(view is other for other in self._inside[1]):
            return inside_views(self.mesh, np.frombuffer(self._inside[0], bool), [camera], self.scene)[0]
        return self.view(camera)

    def insides(self, inside: Bool[np.ndarray, " F"]) -> list[View]:
        """Render some faces alone, with the rest as a ghost, from INSIDE_DIRECTIONS."""
        key = inside.tobytes()
        if self._inside is None or self._inside[0] != key:
            self._inside = key, inside_views(self.mesh, inside, cameras(self.mesh, INSIDE_DIRECTIONS), self.scene)
        return self._inside[1]

    def clearest_inside_views(self, inside: Bool[np.ndarray, " F"], most: int) -> list[int]:
        """Return the indices, in ascending order, of at most `most` views of `insides` with most pixels of the faces."""
        pixels = [int((view.face >= 0).sum()) for view in self.insides(inside)]
        return sorted(sorted(range(len(pixels)), key=lambda k: -pixels[k])[:most])

    def inside_names(self, front: float | None = None) -> list[str]:
        """Return the captions of the views of `insides`."""
        return [f"inside the object, {caption(*way, front)}; the rest is shown as a ghost" for way in INSIDE_DIRECTIONS]

    def pictures(
        self, images: Sequence[UInt8[np.ndarray, "H W 3"]], names: Sequence[str], note: str = ""
    ) -> tuple[Picture, ...]:
        """Encode images with captions that number them from 1, as answers refer to them."""
        return tuple(
            encode(im, f"picture {k}: {name}{note}") for k, (im, name) in enumerate(zip(images, names, strict=True), 1)
        )

    def names(self, count: int, front: float | None = None) -> list[str]:
        """Return `count` captions: of the views from all sides, then of close-ups. front: see `caption`."""
        captions = [caption(*way, front) for way in self._config.directions]
        return (captions + ["a close-up"] * (count - len(captions)))[:count]

    def facing(self, face_part: Int[np.ndarray, " F"], alike: Facing | None) -> Float[np.ndarray, " 3"] | None:
        """Return the direction to the side from which more of some parts is seen, None for no parts: any side."""
        if alike is None:
            return None
        key = face_part.tobytes()
        if self._pixels is None or self._pixels[0] != key:
            count = int(face_part.max()) + 1
            seen = np.stack([np.bincount(face_part[v.face[v.face >= 0]], minlength=count) for v in self.views])
            self._pixels = key, seen
        parts, way = alike
        pixels = self._pixels[1][:, list(parts)].sum(1)
        ahead, back = (pixels[self._seen_from(s * way)].sum() for s in (1.0, -1.0))
        return way if ahead >= back else -way

    def _seen_from(self, facing: Float[np.ndarray, " 3"]) -> list[int]:
        """Return the indices of the views from a side, of all views if there are none."""
        eyes = [v.camera.T_world_camera[:3, 3] - self.mesh.bounds.mean(0) for v in self.views]
        return [k for k, eye in enumerate(eyes) if is_beside(eye, facing)] or list(range(len(eyes)))

    def _from(self, face_part: Int[np.ndarray, " F"], alike: Facing | None) -> list[View]:
        """Return the views that these parts are drawn in."""
        facing = self.facing(face_part, alike)
        return self.views if facing is None else [self.views[k] for k in self._seen_from(facing)]

    def card(
        self,
        face_part: Int[np.ndarray, " F"],
        part: int,
        title: str,
        contact: Float[np.ndarray, "c 3"] | None = None,
        alike: Facing | None = None,
    ) -> Picture:
        """Draw the highlighted part, and a close-up if it is small.

        contact: points [m] that should be visible; alike: parts that are drawn from the same side.
        """
        view = card_view(self._from(face_part, alike), face_part, part, self.scene, contact)
        return encode(part_card(self.mesh, view, face_part, part, title, self.scene))

    def shot(
        self,
        face_part: Int[np.ndarray, " F"],
        part: int,
        alike: Facing | None = None,
        candidates: Float[np.ndarray, "k 3"] | None = None,
    ) -> Shot:
        """Return the part in the view that shows it best, or in the two that together show most of some points [m].

        alike: as in `card`.
        """
        views = self._from(face_part, alike)
        best = [views[best_view(views, face_part, part)]]
        two = best if candidates is None else self._two(views, face_part, part, candidates)
        near = tuple(self._near(view, face_part, part) for view in two)
        rest = self.mesh.subset(face_part != part)

        def through(view: View) -> UInt8[np.ndarray, "H W 3"]:
            return shown(rest, view.camera, RayScene(rest.vertices, rest.faces)).color

        return Shot(near, tuple(self._mask(view, face_part, part) for view in near), through, self._hidden)

    def _two(self, views: list[View], face_part: np.ndarray, part: int, points: np.ndarray) -> list[View]:
        """Return the view that shows most of the part, and one that shows most of the points that it hides, or in depth.

        One view is enough where it shows nearly all points.
        """
        pixels = np.array([visible_pixels(view, face_part, part) for view in views]) + 1e-9
        seen = np.array([~self._hidden(view, points) for view in views])
        first = int(pixels.argmax())
        if seen[first].mean() > SEEN:
            return [views[first]]
        eyes = np.array([view.camera.T_world_camera[:3, 2] for view in views])
        across = np.linalg.norm(np.cross(eyes, eyes[first]), axis=1)
        more = (seen & ~seen[first]).mean(1) + DEPTH_WEIGHT * across * (seen.mean(1) + np.minimum(pixels / pixels.max(), 0.5))
        more[first] = -1.0
        return [views[k] for k in dict.fromkeys((first, int(more.argmax())))]

    def _hidden(self, view: View, points: Float[np.ndarray, "k 3"]) -> Bool[np.ndarray, " k"]:
        """Return which points [m] lie below a surface, as seen in a view."""
        return hidden_points(self.scene, view.camera, points, UNDER * self.mesh.diagonal)

    def arrows(
        self,
        face_part: Int[np.ndarray, " F"],
        part: int,
        title: str,
        center: Float[np.ndarray, " 3"],
        directions: Float[np.ndarray, "k 3"],
        alike: Facing | None = None,
    ) -> Picture:
        """Draw the part with numbered arrows, in the view where they are most distinct. alike: as in `card`."""
        views = self._from(face_part, alike)
        view = self._near(views[clearest_view(views, center, directions, face_part, part)], face_part, part)
        length = ARROW * float(np.linalg.norm(np.ptp(self.mesh.triangles[face_part == part].reshape(-1, 3), axis=0)))
        image = highlight(view.color, self._mask(view, face_part, part))
        drawn = draw_arrows(image, view.camera, center, directions, range(1, len(directions) + 1), length)
        return encode(titled(drawn, title))

    def strip(
        self,
        moving: Bool[np.ndarray, " F"],
        title: str,
        motions: Sequence[Motion],
        amounts: Sequence[float],
        words: Sequence[str] = (),
        seen_from: SeenFrom = ANYWHERE,
    ) -> Picture:
        """Draw a part and what it carries, at rest and moved by each amount [rad or m]. words: as in `motion_strip`."""
        shown = list(zip(motions, amounts, strict=True))
        strip = motion_strip(self.mesh, moving, shown, words=words, scene=self.scene, seen_from=seen_from)
        return encode(titled(strip, title))

    def _near(self, view: View, face_part: np.ndarray, part: int) -> View:
        """Return a close-up if the part is small in the view, else the view."""
        return close_up(self.mesh, view, face_part, part, self.scene) or view

    def _mask(self, view: View, face_part: np.ndarray, part: int) -> np.ndarray:
        """Return the pixels of the part, or its full silhouette if nothing of it is visible."""
        mask = part_pixels(view, face_part, part)
        return mask if mask.any() else silhouette(self.mesh.triangles[face_part == part], view.camera)
