"""What to do about files that are not read as they are: one line per case, the same in the error and in the documentation."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from anymesh.errors import pip_install

EXPORT = "export it as GLB (or FBX or OBJ)"
OTHERS = {  # what the format is, and the way to a file that is read
    **dict.fromkeys((".blend", ".blend1"), "Blender's; in Blender, choose File > Export > glTF 2.0 and save a .glb"),
    ".max": f"3ds Max's; in 3ds Max, {EXPORT}: File > Export",
    **dict.fromkeys((".ma", ".mb"), "Maya's; in Maya, choose File > Export All, as FBX or USD"),
    ".c4d": f"Cinema 4D's; in Cinema 4D, {EXPORT}: File > Export",
    ".skp": "SketchUp's; in SketchUp, choose File > Export > 3D Model, as GLB, COLLADA or OBJ",
    **dict.fromkeys((".zpr", ".ztl"), "ZBrush's; in ZBrush, use Zplugin > FBX ExportImport"),
    ".3dm": f"Rhino's; in Rhino, {EXPORT}: File > Export Selected",
    ".hip": "Houdini's; in Houdini, write USD or glTF with a ROP",
    **dict.fromkeys((".lwo", ".lws", ".lxo"), f"LightWave's or Modo's; {EXPORT} there, or in Blender"),
    ".3ds": "the old one of 3D Studio; import it in Blender, and choose File > Export > glTF 2.0",
    **dict.fromkeys((".iges", ".igs"), "CAD surfaces; in a CAD program such as FreeCAD, export it as STEP or GLB"),
    **dict.fromkeys((".sldprt", ".sldasm"), "SolidWorks's; in SolidWorks, save it as STEP"),
    **dict.fromkeys((".ipt", ".iam"), "Inventor's; in Inventor, export it as STEP"),
    **dict.fromkeys((".prt", ".catpart", ".catproduct", ".x_t", ".x_b", ".sat", ".jt"), "one of CAD; there, export it as STEP"),
    ".f3d": "Fusion's; in Fusion, choose File > Export, as STEP or USDZ",
    ".fcstd": "FreeCAD's; in FreeCAD, choose File > Export, as STEP or glTF",
    **dict.fromkeys((".dwg", ".dxf"), "a drawing of AutoCAD; there, export the solids as STEP or FBX"),
    ".scad": "OpenSCAD's; `openscad -o FILE.3mf FILE.scad` makes a 3MF",
    ".ifc": "one of buildings; in Blender with Bonsai, or by IfcConvert, export it as GLB",
    **dict.fromkeys((".x3d", ".x3dv", ".wrl", ".vrml"), "X3D or VRML; import it in Blender, and export glTF 2.0"),
    ".abc": "Alembic, a cache of animation; import it in Blender, and choose File > Export > glTF 2.0",
    **dict.fromkeys((".splat", ".ksplat", ".spz"), "Gaussian splats without a surface; export a mesh where they were made"),
    **dict.fromkeys((".las", ".laz", ".e57", ".pcd", ".xyz", ".pts"), "points without faces; make a mesh of them in MeshLab"),
    ".vox": "voxels; in MagicaVoxel, export it as OBJ",
    ".amf": "one of 3D printing; in a slicer, export it as 3MF",
    **dict.fromkeys((".urdf", ".sdf", ".xacro"), "an articulated model already; `anymesh check` reads it"),
    ".mtl": "the materials of an OBJ; give the .obj beside it",
    ".bin": "the data of a glTF; give the .gltf beside it",
    **dict.fromkeys((".rar", ".7z", ".tar", ".gz", ".tgz"), "an archive; unpack it and give the mesh in it"),
}  # fmt: skip


class Case(NamedTuple):
    """A case that is no question of the format alone.

    have: what a person has; line: what the error says after the file's name: what was found, what is valid or to be done.
    """

    have: str
    line: str


AGAIN = "give it the right extension, or download it again"
CASES = {
    "url": Case("an address (`https://...`)", "it is an address, and nothing is fetched; download the file and give its path"),
    "folder": Case("a folder", "it is a folder; valid is one mesh file of it, or with --batch all of them"),
    "lfs": Case("a Git LFS pointer", "it is a Git LFS pointer, not the file itself; run `git lfs pull` in its folder"),
    "page": Case(
        "a web page under the name of a mesh",
        "it is a web page, not the mesh that its name says; download the file itself, with the button on that page",
    ),
    "text": Case("a failed download", f"found no {{expected}} file inside, but {{text!r}}; {AGAIN}"),
    "renamed": Case("a file with the wrong extension", "found no {expected} file inside, but {kind}; {way}"),
    "unknown": Case("a damaged file", f"found no {{expected}} file inside, nor any that is known; {AGAIN}"),
    "buffer": Case(
        "a `.gltf` without its `.bin`", "refers to {uri!r}, which {reason}; a .gltf needs its .bin, a .glb holds all in one"
    ),
    "zip": Case("a zip of several meshes", "the zip holds {listed}; valid is one; unpack it and give one, or all with --batch"),
    "empty_zip": Case("a zip without a mesh", "the zip holds no mesh; valid is one of {formats}, with what it refers to"),
    "locked_zip": Case("a zip with a password", "the zip is encrypted; unpack it with its password and give the mesh in it"),
    "scene": Case("a scene of several objects", "a scene of {count} objects is taken as one; --scene split articulates each"),
    "draco": Case(
        "a glTF with Draco data, on a Mac with an Intel processor",
        "its Draco data needs DracoPy, which is not installed; `pip install DracoPy`, or save it without",
    ),
}
EXAMPLE = {  # what a file may hold, for the documentation
    "expected": "GLB", "text": "404: Not Found", "kind": "a ZIP archive", "way": "give it the extension .zip", "count": 12,
    "uri": "scene.bin", "reason": "is missing; put 'scene.bin' beside the mesh", "listed": "2 meshes (fridge.glb, oven.glb)",
    "formats": ".glb, .obj, ...",
}  # fmt: skip
RIGHT = {  # extension of a kind of content
    "a GLB": ".glb", "a PLY": ".ply", "a DAE": ".dae", "an OFF": ".off", "JSON, as a .gltf": ".gltf", "a ZIP archive": ".zip",
    "an FBX": ".fbx", "USD": ".usd", "an ASCII STL": ".stl", "an OBJ": ".obj",
}  # fmt: skip
LIBRARIES = {  # extra, and what it reads
    "pxr": ("usd", "USD, USDZ"),
    "ufbx": ("fbx", "FBX"),
    "cascadio": ("step", "STEP"),
}


def advise(case: str, **found: object) -> str:
    """Return the line of a case, with what was found in this file."""
    return CASES[case].line.format(**found)


def advise_on_content(suffix: str, kind: str, begin: bytes) -> str:
    """Return the line of a file whose content is not what its extension says.

    kind: what it seems to be, "" if unknown; begin: its first bytes.
    """
    expected = suffix[1:].upper()
    if not kind:
        text = " ".join(begin.decode("ascii", "replace").split())
        return advise("text" if text.isascii() and text.isprintable() else "unknown", expected=expected, text=text)
    if kind == "a web page":
        return advise("page")
    way = f"give it the extension {RIGHT[kind]}" if kind in RIGHT else "give the mesh"
    if kind == "a Blender file":
        way = OTHERS[".blend"].partition("; ")[2]
    return advise("renamed", expected=expected, kind=kind, way=way)


def needs_extra(library: str) -> str:
    """Return the line of a format whose library is not installed."""
    extra, kind = LIBRARIES[library]
    return f"reading {kind} needs {library}, which is not installed; install it with {pip_install(extra)}"


def remedy(suffix: str) -> str | None:
    """Return what a format is that nothing here reads, and how its file becomes one that is read; None if it is unknown."""
    known = OTHERS.get(suffix)
    return known and f"it is {known}"


def rows() -> Iterator[tuple[str, str]]:
    """Yield what a person may have, and the line that the error says, for a table of the documentation."""
    yield from ((case.have, case.line.format(**EXAMPLE)) for case in CASES.values())
    yield from ((f"{kind}, without its extra", needs_extra(library)) for library, (_, kind) in LIBRARIES.items())
    for line in dict.fromkeys(OTHERS.values()):
        yield ", ".join(suffix for suffix, text in OTHERS.items() if text == line), f"it is {line}"
