"""The meshes folder: a visual OBJ per link with materials and textures, and an OBJ per convex hull of its collision.

Flat meshes and points, which engines refuse, get a volume. Formats without more get a single colour per primitive.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int

from anymesh.export.links import Link, Primitive
from anymesh.export.model import FOLDER, ExportConfig, ExportLink, Model, faces_path
from anymesh.names import legal_names
from anymesh.types import Hull, Material, Mesh
from anymesh.types.mesh import TEXTURE_SLOTS, to_srgb
from anymesh.types.triangles import CUBE_CORNERS, bounds_of, corners_of, face_cross, lengths

POINT = 1e-4  # [m] side of a link without any extent
SUFFIXES = {"image/png": ".png", "image/jpeg": ".jpg"}
MIN_AREA = 1e-12  # [m^2] minimum area of a visible primitive; MuJoCo refuses smaller meshes
MIN_AREA_SHARE = 1e-9  # of the squared diagonal: the area of thinner needles is lost in float32
SHEET = 1e-5  # of the diagonal: a thinner visual gets a back sheet, since MuJoCo refuses flat meshes
MTL_MAPS = {"base_color": "map_Kd", "emissive": "map_Ke", "normal": "norm"}  # slots with an equivalent in MTL


def write_meshes(model: Model, folder: Path, config: ExportConfig) -> None:
    """Write `meshes/` of an asset folder: <link>.obj, .mtl, .faces.npy, a file per hull, and the textures used."""
    mesh, bodies, files = (
        model.tiled.asset.mesh,
        model.tiled.bodies,
        texture_files(model.tinted.asset.mesh, model.tiled.asset.mesh),
    )
    (folder / FOLDER).mkdir(exist_ok=True)
    write_textures(mesh, folder / FOLDER, MTL_MAPS, files)
    names = material_names(mesh.materials)
    for body in bodies:
        primitives = visible(body.link, config)
        used = sorted({p.material for p in primitives})
        mtl = "".join(_mtl(names[i], mesh.materials[i], files) for i in used)
        (folder / FOLDER / f"{body.name}.mtl").write_text(mtl, encoding="ascii", newline="\n")
        write_obj(folder / body.visual_path(), body.name, f"{body.name}.mtl", primitives, names)
        _write_hulls(body, folder)
    faces = {body.name: body.link.faces for body in bodies} | {p.part.name: p.faces for p in model.asset.proposals}
    faces |= {h.name: h.faces for h in model.handles}
    for name, mine in faces.items():
        np.save(folder / faces_path(name), model.asset.source_faces(mine), allow_pickle=False)


def _write_hulls(body: ExportLink, folder: Path) -> None:
    for shape, path in zip(body.shapes, body.hull_paths(), strict=True):
        if isinstance(shape, Hull) and path is not None:
            lines = _rows("v %.10g %.10g %.10g\n", shape.vertices), _rows("f %d %d %d\n", shape.faces + 1)
            _write_lines(folder / path, (text for part in lines for text in part))


def write_obj(path: Path, name: str, library: str | None, primitives: Sequence[Primitive], materials: Sequence[str]) -> None:
    """Write one OBJ of some primitives. library: the MTL beside it; materials: the names in it, by index."""
    _write_lines(path, _visual_lines(name, library, primitives, materials))


def material_names(materials: Sequence[Material]) -> list[str]:
    """Return unique legal names in the order of the materials, the same in MTL and URDF."""
    return legal_names([m.name for m in materials], fallback="material")


def _mtl(name: str, material: Material, textures: Mapping[bytes, str]) -> str:
    """Return the MTL of one material; Kd is a display value, as OBJ readers expect, Pr and Pm are the common PBR extension."""
    r, g, b = to_srgb(material.base_color[:3])
    lines = [
        f"newmtl {name}",
        f"Kd {r:.6g} {g:.6g} {b:.6g}",
        "Ks 0 0 0",
        "Ke " + " ".join(f"{c:.6g}" for c in to_srgb(np.array(material.emissive) / max(1.0, *material.emissive))),
        f"d {material.opacity:.6g}",
        f"Pr {material.roughness:.6g}",
        f"Pm {material.metallic:.6g}",
    ]
    for slot, key in MTL_MAPS.items():
        texture = material.textures.get(slot)
        if texture is not None and texture.data in textures:
            lines.append(f"{key} {textures[texture.data]}")
    return "\n".join(lines) + "\n\n"


def visible(link: Link, config: ExportConfig) -> tuple[Primitive, ...]:
    """Return the link's primitives that have an area, with a back sheet if they are flat; a small box if there are none."""
    triangles = link.triangles
    size = float(np.linalg.norm(np.ptp(bounds_of(triangles.reshape(-1, 3)), axis=0)))
    least = max(MIN_AREA, MIN_AREA_SHARE * size**2)
    primitives = tuple(p for p in link.primitives if _area(p) > least)
    if not primitives:
        vertices, faces = small_box(triangles, config)
        return (Primitive(link.primitives[0].material, vertices, faces, None, None, None),)
    normal = flat_normal(triangles.reshape(-1, 3), share=SHEET)
    if normal is None:
        return primitives
    shift = normal * max(SHEET * size, 1e-6)
    return tuple(_with_back(p, shift) for p in primitives)


def with_four_corners(primitive: Primitive) -> Primitive:
    """Return a primitive with fewer than four corners with a back sheet, since MuJoCo refuses it alone."""
    corners = primitive.positions[primitive.triangles].reshape(-1, 3)
    normal = flat_normal(corners, share=SHEET) if len(np.unique(corners, axis=0)) < 4 else None
    if normal is None:
        return primitive
    return _with_back(primitive, normal * max(SHEET * float(np.linalg.norm(np.ptp(corners, axis=0))), 1e-6))


def _area(primitive: Primitive) -> float:
    return float(lengths(face_cross(corners_of(primitive.positions, primitive.triangles))).sum() / 2)


def _with_back(primitive: Primitive, shift: np.ndarray) -> Primitive:
    """Return the faces and, `shift` behind each, the same face with the opposite orientation."""
    t = primitive.positions[primitive.triangles]
    facing = face_cross(t) @ shift > 0
    front = np.where(facing[:, None], primitive.triangles, primitive.triangles[:, ::-1])

    def twice(a: np.ndarray | None, sign: int) -> np.ndarray | None:
        return None if a is None else np.concatenate([a, sign * a])

    uv, normals, colors = primitive.uv, primitive.normals, primitive.colors
    if normals is not None:
        outward = np.where((normals @ shift < 0)[:, None], -normals, normals).astype(np.float32)
        normals = twice(outward, -1)
    return replace(
        primitive,
        positions=np.concatenate([primitive.positions, primitive.positions - shift]),
        triangles=np.concatenate([front, front[:, ::-1] + len(primitive.positions)]),
        uv=twice(uv, 1),
        normals=normals,
        colors=twice(colors, 1),
        more_uv=twice(primitive.more_uv, 1),
    )


def _visual_lines(name: str, library: str | None, primitives: Sequence[Primitive], names: Sequence[str]) -> Iterator[str]:
    """Yield the text of a visual OBJ; corner k of a primitive has position, uv and normal k."""
    if library:
        yield f"mtllib {library}\n"
    yield f"o {name}\n"
    colored = any(p.colors is not None for p in primitives)
    for p in primitives:
        if not colored:
            yield from _rows("v %.8g %.8g %.8g\n", p.positions)
            continue
        white = np.full((len(p.positions), 4), 255, np.uint8)
        colors = (white if p.colors is None else p.colors)[:, :3] / 255
        yield from _rows("v %.8g %.8g %.8g %.4g %.4g %.4g\n", np.hstack([p.positions, colors]))
    textured = all(p.uv is not None for p in primitives)
    shaded = all(p.normals is not None for p in primitives)
    for p in primitives:
        if textured and p.uv is not None:
            yield from _rows("vt %.7g %.7g\n", p.uv)
    for p in primitives:
        if shaded and p.normals is not None:
            yield from _rows("vn %.5g %.5g %.5g\n", p.normals)
    corner = {(True, True): "%d/%d/%d", (True, False): "%d/%d", (False, True): "%d//%d", (False, False): "%d"}
    uses = 1 + textured + shaded
    offset = 1
    for p in primitives:
        if library:
            yield f"usemtl {names[p.material]}\n"
        pattern = " ".join(["f", *[corner[textured, shaded]] * 3]) + "\n"
        yield from _rows(pattern, np.repeat(p.triangles + offset, uses, axis=1))
        offset += len(p.positions)


def _rows(pattern: str, rows: np.ndarray) -> Iterator[str]:
    """Yield rows of numbers as text, many at a time (8 times faster than one by one)."""
    for start in range(0, len(rows), 65536):
        chunk = rows[start : start + 65536]
        yield (pattern * len(chunk)) % tuple((chunk + 0).reshape(-1).tolist())


def _write_lines(path: Path, lines: Iterator[str]) -> None:
    with path.open("w", encoding="ascii", newline="\n") as file:
        file.writelines(lines)


def flat_normal(points: Float[np.ndarray, "n 3"], *, share: float) -> Float[np.ndarray, " 3"] | None:
    """Return the unit normal of points within `share` of their diagonal of a plane, None if they are not plane."""
    spread = points - points.mean(0)
    normal = np.linalg.eigh(spread.T @ spread)[1][:, 0]
    if float(np.ptp(spread @ normal)) > share * float(np.linalg.norm(np.ptp(bounds_of(points), axis=0))):
        return None
    return normal if normal[np.abs(normal).argmax()] > 0 else -normal


def small_box(
    triangles: Float[np.ndarray, "n 3 3"], config: ExportConfig
) -> tuple[Float[np.ndarray, "8 3"], Int[np.ndarray, "12 3"]]:
    """Return the bounding box of points without area, with sides of at least the wall thickness and POINT."""
    corners = triangles.reshape(-1, 3)
    side = max(config.wall(float(np.linalg.norm(np.ptp(corners, axis=0)))), POINT)
    center = (corners.min(0) + corners.max(0)) / 2
    half = np.maximum(np.ptp(corners, axis=0), side) / 2
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return center + (2 * CUBE_CORNERS - 1) * half, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def painted(mesh: Mesh, p: Primitive) -> bool:
    """Return whether a primitive is coloured by its corners, which requires that its material has no texture."""
    return p.colors is not None and not mesh.materials[p.material].textures


def display_color(mesh: Mesh, p: Primitive) -> tuple[float, ...]:
    """Return one colour (sRGB and alpha, 0..1) for a primitive; a texture multiplies it."""
    if p.colors is not None and painted(mesh, p):
        return tuple(float(c) for c in p.colors.mean(0) / 255)
    material = mesh.materials[p.material]
    return (*to_srgb(material.base_color[:3]).tolist(), material.opacity)


def widest(link: Link) -> Primitive:
    """Return the primitive that covers most of the link."""
    return max(link.primitives, key=_area)


def texture_files(*meshes: Mesh) -> dict[bytes, str]:
    """Return the file name of each image in use, by its bytes; stems are unique regardless of the suffix."""
    textures = {}
    used = ((mesh, k) for mesh in meshes if mesh.corner_uv is not None for k in sorted(set(mesh.face_material.tolist()) - {-1}))
    for mesh, index in used:
        material = mesh.materials[index]
        for slot in TEXTURE_SLOTS:
            texture = material.textures.get(slot)
            if texture is not None:
                textures.setdefault(texture.data, (texture, Path(texture.name).stem or f"{material.name}_{slot}"))
    names = legal_names([stem for _, stem in textures.values()], fallback="texture")
    return {
        data: name + SUFFIXES.get(texture.mime, ".png")
        for (data, (texture, _)), name in zip(textures.items(), names, strict=True)
    }


def write_textures(mesh: Mesh, folder: Path, slots: Collection[str], files: Mapping[bytes, str]) -> None:
    """Write the images of some slots unchanged. files: their names by their bytes."""
    for index in sorted(set(mesh.face_material.tolist()) - {-1}):
        for slot, texture in mesh.materials[index].textures.items():
            if slot in slots and texture.data in files:
                (folder / files[texture.data]).write_bytes(texture.data)
