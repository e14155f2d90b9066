"""Check "meshes": visual and collision meshes are usable surfaces."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from anymesh.checking.content import Content, Solid
from anymesh.checking.engines.locate import find_file
from anymesh.checking.report import Finding, failure, warning
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.topology import components
from anymesh.types.triangles import normals_and_areas, unshared

MESHES, HANDLES = "meshes", "handles"
SHIFT, OFF = 0.01, 1e-6  # of the diagonal: where the ray to a handle begins, and of that: tolerance; of unit vectors
NOTHING = 1e-12  # share of a mesh's squared diagonal, below which a face has no area
MANY = 0.05  # share of a mesh's faces without area above which a warning is given
CLOSED = 0.5  # share of a link's surface that must belong to closed bodies for volume and inertia to be computable
TINY, HUGE = 1e-4, 1e2  # [m] plausible diagonals of a link
APART = 0.25  # share of the link's diagonal by which collision may extend outside the visual
UNITS = 10.0  # ratio of sizes that indicates different units
MARKER = 0.01  # [m] a box, ball or cylinder up to this diagonal stands for no shape, as in links with collision of their own
LARGE = 200_000  # maximum number of faces of a mesh; engines are slow with more, and hulls need few
SCALE = "scale"
MIN_DIAGONAL, MAX_DIAGONAL = 0.01, 20.0  # [m] diagonal of articulated objects, from a clasp to a gate
BEYOND = 10.0  # factor beyond these that indicates other units
TEXTURE = "texture"
MESH_FOLDER = "meshes"  # mesh folder of an asset of this project
PICTURES = (".png", ".jpg", ".jpeg")


def check_meshes(content: Content) -> Iterator[Finding]:
    """Check that meshes are readable, not empty or degenerate, closed, of plausible size, and that collision fits visuals."""
    for link, text in content.unread:
        yield failure(MESHES, link, text)
    for link in content.robot.links:
        for solid in (*content.visuals[link.name], *content.collisions[link.name]):
            yield from _faces(link.name, solid)
        yield from _closed(content, link.name)
        yield from _size(content, link.name)
        yield from _agreement(content, link.name)


def check_handles(content: Content, record: Mapping[str, Any]) -> Iterator[Finding]:
    """Check that the frames of handles in asset.json lie on the surface of their links, seen from where a hand comes."""
    for joint in record.get("joints", ()):
        handle = joint.get("handle")
        if handle is None:
            continue
        place, approach, closing = (np.array(handle[key], float) for key in ("place", "approach", "closing"))
        if handle["link"] not in content.visuals:
            yield failure(HANDLES, handle["name"], f"its link is {handle['link']!r}, which is not there")
            continue
        lengths = np.array([np.linalg.norm(approach), np.linalg.norm(closing), 1 + abs(approach @ closing)])
        if np.abs(lengths - 1).max() > OFF:
            yield failure(HANDLES, handle["name"], "approach and closing are no unit vectors at right angles")
            continue
        surface = content.at_rest(frozenset((handle["link"],)))
        off = SHIFT * content.diagonal
        hit = RayScene(*unshared(surface)).first_hit((place - off * approach)[None], approach[None]).distance[0]
        if not abs(hit - off) < SHIFT * off:
            where = f"{1000 * (hit - off):.3g} mm off" if np.isfinite(hit) else "beside it"
            yield failure(HANDLES, handle["name"], f"its frame does not lie on the surface of {handle['link']!r}: {where}")


def _faces(link: str, solid: Solid) -> Iterator[Finding]:
    if not np.isfinite(solid.triangles).all():
        yield failure(MESHES, link, f"{solid.shown} has corners that are not finite")
        return
    areas = normals_and_areas(solid.triangles)[1]
    diagonal = float(np.linalg.norm(np.ptp(solid.bounds, axis=0)))
    flat = float((areas <= NOTHING * diagonal**2).mean())
    if not areas.any():
        yield failure(MESHES, link, f"{solid.shown} has no face with an area")
    elif flat > MANY:
        yield warning(MESHES, link, f"{flat:.0%} of the faces of {solid.shown} have no area; valid is at most {MANY:.0%}")
    if len(areas) > LARGE:
        yield warning(MESHES, link, f"{solid.shown} has {len(areas)} faces; at most {LARGE} load in reasonable time")


def closed_share(solid: Solid) -> float:
    """Compute the share of a surface that belongs to closed, consistently wound bodies."""
    triangles = solid.triangles
    if solid.mesh is None or not np.isfinite(triangles).all():
        return 1.0
    areas = normals_and_areas(triangles)[1]
    surface_components = components(solid.mesh.vertices, solid.mesh.faces)
    closed = (surface_components.solid & surface_components.agree)[surface_components.label]
    return float(areas[closed].sum() / max(areas.sum(), 1e-300))


def _closed(content: Content, link: str) -> Iterator[Finding]:
    solids = content.visuals[link]
    if not solids:
        return
    area = np.array([normals_and_areas(s.triangles)[1].sum() for s in solids])
    share = float((area * [closed_share(s) for s in solids]).sum() / max(area.sum(), 1e-300))
    if share < CLOSED:
        problem = f"{share:.0%} of its surface belongs to closed bodies"
        yield warning(MESHES, link, f"{problem}; below {CLOSED:.0%} volume and inertia cannot be computed from it")


def _size(content: Content, link: str) -> Iterator[Finding]:
    points = content.shown(link).reshape(-1, 3)
    if not len(points) or not np.isfinite(points).all():
        return
    diagonal = float(np.linalg.norm(np.ptp(points, axis=0)))
    if not TINY <= diagonal <= HUGE:
        yield warning(MESHES, link, f"its diagonal is {diagonal:.3g} m; valid is {TINY:g} to {HUGE:g} m")


def _agreement(content: Content, link: str) -> Iterator[Finding]:
    seen, met = ([s.triangles for s in some[link]] for some in (content.visuals, content.collisions))
    if not seen or not met:
        return
    (low, high), (a, b) = (_bounds(seen), _bounds(met))
    diagonal, other = float(np.linalg.norm(high - low)), float(np.linalg.norm(b - a))
    if not np.isfinite([diagonal, other]).all() or diagonal <= 0 or other <= 0:
        return
    if not 1 / UNITS < other / diagonal < UNITS:
        smaller = content.visuals[link] if diagonal < other else content.collisions[link]
        marker = min(diagonal, other) <= MARKER and all(s.mesh is None for s in smaller)
        problem = f"its collision is {other / diagonal:.3g} times as large as its visual; are the units right?"
        yield (warning if marker else failure)(MESHES, link, problem)
        return
    outside = max(float((low - a).max()), float((b - high).max())) / diagonal
    if outside > APART:
        problem = f"its collision extends beyond the visible surface by {outside:.0%} of its diagonal"
        yield warning(MESHES, link, f"{problem}; at most {APART:.0%} is valid")


def _bounds(shapes: list[np.ndarray]) -> np.ndarray:
    points = np.concatenate(shapes).reshape(-1, 3)
    return np.array([points.min(0), points.max(0)])


def check_scale(content: Content) -> Iterator[Finding]:
    """Check that the diagonal at rest is plausible in metres."""
    diagonal = content.diagonal
    if diagonal == 0:
        yield failure(SCALE, "", "the object has no shape; links need visual or collision shapes")
    elif not MIN_DIAGONAL <= diagonal <= MAX_DIAGONAL:
        far = not MIN_DIAGONAL / BEYOND <= diagonal <= MAX_DIAGONAL * BEYOND
        problem = f"the object's diagonal is {diagonal:.4g} m; plausible is {MIN_DIAGONAL:g} to {MAX_DIAGONAL:g} m"
        yield failure(SCALE, "", f"{problem}; are the units metres?") if far else warning(SCALE, "", problem)


def check_texture(content: Content, *, ours: bool) -> Iterator[Finding]:
    """Check that material files and textures exist and can be read. ours: made by anymesh; then unused textures are reported.

    Missing materials in mesh files of other sources are a warning, since such meshes are shown in one colour.
    """
    for link in content.robot.links:
        warnings = [text for solid in content.visuals[link.name] for text in solid.warnings]
        for text in dict.fromkeys(warnings):
            yield failure(TEXTURE, link.name, text) if ours else warning(TEXTURE, link.name, text)
    folder = content.robot.path.parent
    for reference in content.robot.pictures:
        picture = find_file(reference, folder)
        if picture is None:
            yield failure(TEXTURE, "", f"the picture {reference} is not there")
        elif (broken := _broken(picture)) is not None:
            yield failure(TEXTURE, "", f"the picture {reference} cannot be read: {broken}")
    if ours:
        yield from _unused(folder / MESH_FOLDER)


def _broken(path: Path) -> str | None:
    try:
        with Image.open(path) as picture:
            picture.load()
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        return " ".join(str(error).split())
    return None


def _unused(folder: Path) -> Iterator[Finding]:
    """Report pictures that neither a material library nor a description (MJCF needs PNG) names."""
    naming = sorted([*folder.glob("*.mtl"), *(p for kind in ("xml", "urdf", "sdf") for p in folder.parent.glob(f"*.{kind}"))])
    text = html.unescape("\n".join(p.read_text(encoding="utf-8", errors="replace") for p in naming))
    for path in sorted(folder.iterdir()) if folder.is_dir() else ():
        if path.suffix.lower() in PICTURES and not re.search(rf"(?<![\w.-]){re.escape(path.name)}(?![\w.-])", text):
            yield warning(TEXTURE, path.name, "no material uses this picture")
