"""Picture of a joint with errors: predicted and true, at rest and half open."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, UInt8
from PIL import Image, ImageDraw

from anymesh.evaluation.ground_truth import EvalSample, TrueJoint
from anymesh.evaluation.record import what_is_off
from anymesh.evaluation.score import JointScore, part_ious
from anymesh.geometry.kinematics import joint_motion
from anymesh.geometry.raycast_ import RayScene
from anymesh.prompted.pictures.strips import motion_axis, moved, silhouette, strip_camera
from anymesh.rendering.marks import Color, blend, draw_arrow, font, lighten, rim
from anymesh.rendering.render import lit, render
from anymesh.rendering.viewpoints import framed
from anymesh.types import Brief, Joint, JointType, Mesh, Motion, Segmentation
from anymesh.types.camera import Camera

PANEL = 420  # [px] size of each of the two panels
TEXT, LINE = 17, 24  # [px] font size and line height of the caption
CAPTION = 2 * LINE + 10  # [px] height of the caption
# green and vermilion, distinguishable with colour vision deficiencies (Okabe and Ito)
TRUE_COLOR, FOUND_COLOR = (0, 150, 110), (213, 94, 0)
GREY = np.array([185, 185, 185], np.uint8)
PALE = 0.45  # share by which the colours of static parts are moved towards white
GHOST = 0.25  # opacity of a part where it is hidden
AIR = 0.06  # margin around the object, as a share of the picture
LEGIBLE, RING = 0.4, 0.1  # as in motion strips: minimum size of an axis (share of the picture), and size of its ring
RIM = 5  # [px] width of outlines, in pictures of twice the size
AXES = (4.2, 2.0)  # line widths of the true and the found axis
DENSE = 20_000  # number of faces above which a mesh is thinned to choose the camera
HALF_WAY = 0.5  # share of the range
TURNED, TRAVEL = np.pi / 4, 0.5  # [rad] and share of the part's size, for joints whose range is endless or unknown


@dataclass(frozen=True, eq=False)
class _Move(Brief):
    """Faces, and their motion by the true or the found joint. `motion` is None if they are static."""

    faces: Bool[np.ndarray, " F"]
    motion: Motion | None
    amount: float
    color: Color

    def pose(self, mesh: Mesh) -> Mesh:
        return mesh if self.motion is None else moved(mesh, self.faces, self.motion.transform(self.amount))


def draw_joint(
    sample: EvalSample, segmentation: Segmentation, true: TrueJoint, predicted: Joint | None, score: JointScore
) -> UInt8[np.ndarray, "H W 3"]:
    """Draw the whole object at rest on the left, and the part half open on the right; true in green, found in vermilion.

    true: in the sample's coordinates; predicted: the joint of the matched part, None if there is none.
    """
    mesh = sample.mesh
    numbers = {p.name: k for k, p in enumerate(sample.truth.parts)}
    mine = sample.labels == numbers[true.child]
    size = float(np.linalg.norm(np.ptp(mesh.triangles[mine].reshape(-1, 3), axis=0)))
    carried = np.isin(sample.labels, [numbers[name] for name in _carried(sample, true.child)])
    theirs = _found_faces(sample, segmentation, predicted, numbers[true.child])
    right = _Move(mine | carried, *_motion(true, size), TRUE_COLOR)
    ours = _Move(
        theirs | (carried if predicted else False), *(_motion(predicted, size) if predicted else (None, 0.0)), FOUND_COLOR
    )
    moves = [m for m in (right, ours) if m.motion is not None]
    near = strip_camera(*_sketch(mesh, right.faces), [(m.motion, m.amount) for m in moves if m.motion], 2 * PANEL)
    panels = [_at_rest(mesh, mine, theirs, moves, _whole(near, mesh, mine, right)), _opened(mesh, right, ours, moves, near)]
    drawn = np.concatenate([_half(p) for p in panels], 1)
    return captioned(drawn, f"{sample.truth.name} / {true.child}", what_is_off(score))


def captioned(image: UInt8[np.ndarray, "h W 3"], title: str, subtitle: str) -> UInt8[np.ndarray, "H W 3"]:
    """Put the picture above a caption of two lines; characters that the font lacks become question marks."""
    bar = Image.new("RGB", (image.shape[1], CAPTION), (255, 255, 255))
    draw = ImageDraw.Draw(bar)
    for k, (text, color) in enumerate(((title, (20, 20, 20)), (subtitle, (90, 90, 90)))):
        plain = text.encode("ascii", "replace").decode()
        draw.text((8, 4 + (k + 0.5) * LINE), plain, fill=color, font=font(TEXT), anchor="lm")
    for word, color, right in (("found", FOUND_COLOR, 8), ("true", TRUE_COLOR, 62)):
        draw.text((bar.width - right, 4 + 0.5 * LINE), word, fill=color, font=font(TEXT), anchor="rm")
    return np.concatenate([image, np.asarray(bar)])


def without_caption(image: UInt8[np.ndarray, "H W 3"]) -> UInt8[np.ndarray, "h W 3"]:
    """Remove the caption added by `captioned`."""
    return image[:-CAPTION]


def contact_sheet(pictures: Sequence[UInt8[np.ndarray, "h w 3"]], columns: int, width: int) -> UInt8[np.ndarray, "H W 3"]:
    """Arrange pictures in rows, each resized to one width [px]."""
    small = [
        Image.fromarray(p).resize((width, round(p.shape[0] * width / p.shape[1])), Image.Resampling.LANCZOS) for p in pictures
    ]
    height = max(s.height for s in small)
    sheet = Image.new("RGB", (width * min(columns, len(small)), height * -(-len(small) // columns)), (255, 255, 255))
    for k, picture in enumerate(small):
        sheet.paste(picture, (width * (k % columns), height * (k // columns)))
    return np.asarray(sheet)


def _motion(joint: TrueJoint | Joint, size: float) -> tuple[Motion | None, float]:
    """Return a joint's motion and the amount of half its range; size: of its part [m]."""
    if joint.type is JointType.FIXED:
        return None, 0.0
    slides = joint.type is JointType.PRISMATIC
    motion = joint_motion(joint)
    if joint.limits is None or (isinstance(joint, TrueJoint) and not joint.range_known):
        return motion, TRAVEL * size if slides else TURNED
    return motion, HALF_WAY * max(joint.limits, key=abs)


def _carried(sample: EvalSample, name: str) -> list[str]:
    """Return the descendants of a part."""
    direct = [j.child for j in sample.truth.joints if j.parent == name]
    return [*direct, *(part for child in direct for part in _carried(sample, child))]


def _found_faces(sample: EvalSample, segmentation: Segmentation, predicted: Joint | None, true: int) -> Bool[np.ndarray, " F"]:
    """Return the faces of the found part; without a joint, of the found part with the largest IoU."""
    names = [p.name for p in segmentation.parts]
    if predicted is not None:
        return segmentation.face_part == names.index(predicted.child)
    ious = part_ious(segmentation.face_part, sample.labels, sample.mesh.face_areas)
    return segmentation.face_part == int(ious[:, true].argmax())


def _sketch(mesh: Mesh, faces: Bool[np.ndarray, " F"]) -> tuple[Mesh, Bool[np.ndarray, " n"]]:
    """Thin a dense mesh to every n-th face, enlarged to cover the same area, to choose a camera quickly."""
    step = -(-len(mesh.faces) // DENSE)
    if step == 1 or not faces[::step].any():
        return mesh, faces
    corners = mesh.triangles[::step]
    middle = corners.mean(1, keepdims=True)
    sparse = mesh.subset(np.arange(0, len(mesh.faces), step))
    corners = (middle + np.sqrt(step) * (corners - middle)).reshape(-1, 3)
    return replace(sparse, vertices=corners, faces=np.arange(len(corners)).reshape(-1, 3)), faces[::step]


def _whole(near: Camera, mesh: Mesh, mine: Bool[np.ndarray, " F"], right: _Move) -> Camera:
    """Return a camera at the same place that frames the whole object and the true axis."""
    camera = framed(near, mesh.vertices, AIR, near.height)
    corners = mesh.triangles[mine].reshape(-1, 3)
    ends = [motion_axis(corners, right.motion, right.amount, camera, LEGIBLE)[0]] if right.motion else []
    return framed(near, np.concatenate([mesh.vertices, *ends]), AIR, near.height)


def _at_rest(
    mesh: Mesh, mine: Bool[np.ndarray, " F"], theirs: Bool[np.ndarray, " F"], moves: Sequence[_Move], camera: Camera
) -> UInt8[np.ndarray, "H W 3"]:
    """Draw the true part tinted, and the outline of the found one."""
    picture = _painted(mesh, camera, TRUE_COLOR, mine)
    picture = blend(picture, rim(silhouette(mesh.triangles[theirs], camera), RIM), FOUND_COLOR, 1.0)
    return _with_axes(picture, mesh, mine, moves, camera)


def _opened(mesh: Mesh, right: _Move, ours: _Move, moves: Sequence[_Move], camera: Camera) -> UInt8[np.ndarray, "H W 3"]:
    """Draw the part as moved by the found joint, and the outline of its true position."""
    pose = ours.pose(mesh)
    picture = _painted(pose, camera, FOUND_COLOR, ours.faces & (ours.motion is not None))
    should = silhouette(right.pose(mesh).triangles[right.faces], camera)
    picture = blend(picture, rim(should, RIM), TRUE_COLOR, 1.0)
    return _with_axes(picture, mesh, right.faces, moves, camera)


def _painted(mesh: Mesh, camera: Camera, color: Color, faces: Bool[np.ndarray, " F"]) -> UInt8[np.ndarray, "H W 3"]:
    """Draw the object light grey, with some faces in colour, blended over what hides them."""
    scene = RayScene(mesh.vertices, mesh.faces)
    view = render(mesh, camera, face_color=np.tile(GREY, (len(mesh.faces), 1)), scene=scene)
    picture = lighten(view.color, PALE)
    if not faces.any():
        return picture
    seen = (view.face >= 0) & faces[view.face]
    picture[seen] = lit(np.tile(np.array(color, float), (int(seen.sum()), 1)), view.normal[seen])
    return blend(picture, silhouette(mesh.triangles[faces], camera) & ~seen, color, GHOST)


def _with_axes(
    picture: UInt8[np.ndarray, "H W 3"], mesh: Mesh, faces: Bool[np.ndarray, " F"], moves: Sequence[_Move], camera: Camera
) -> UInt8[np.ndarray, "H W 3"]:
    """Draw the true axis thick and the found one thinner on top, so that both are visible where they agree."""
    drawn = Image.fromarray(picture)
    draw = ImageDraw.Draw(drawn)
    corners = mesh.triangles[faces].reshape(-1, 3)
    for move, scale in zip(moves, AXES, strict=False):
        assert move.motion is not None
        radius = RING * (1 + scale / AXES[0])  # the rings of both axes differ, so that both are visible
        ends, circle = motion_axis(corners, move.motion, move.amount, camera, LEGIBLE, radius)
        draw_arrow(draw, camera.project(ends)[0], move.color, scale)
        if circle is not None:
            pixels = camera.project(circle)[0]
            draw.line([tuple(p) for p in pixels], fill=move.color, width=round(2 * scale), joint="curve")
            draw_arrow(draw, pixels[[-4, -1]], move.color, scale)
    return np.asarray(drawn)


def _half(picture: UInt8[np.ndarray, "H W 3"]) -> UInt8[np.ndarray, "h w 3"]:
    drawn = Image.fromarray(picture).resize((picture.shape[1] // 2, picture.shape[0] // 2), Image.Resampling.BOX)
    ImageDraw.Draw(drawn).rectangle([0, 0, drawn.width - 1, drawn.height - 1], outline=(200, 200, 200))
    return np.asarray(drawn)
