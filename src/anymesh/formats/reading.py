"""Reading by outside libraries in a child process with limits on time and memory, and formats that are not read."""

from __future__ import annotations

import atexit
import gc
import tempfile
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

from anymesh.errors import InputError, MissingExtraError, pip_install
from anymesh.isolation import ChildError, ChildLimits, ChildPool, Failure
from anymesh.loading.files import FileMesh, Folder

LIMITS = ChildLimits(seconds=600.0, memory=16 << 30, calls=64)
USD = ("anymesh.formats.usd.stage_", "read_usd", "pxr", "usd")
STEP = ("anymesh.formats.step_", "read_step", "cascadio", "step")
READERS = {  # module, function, the library that it needs, the extra that brings it
    ".usd": USD,
    ".usda": USD,
    ".usdc": USD,
    ".usdz": USD,
    ".3mf": ("anymesh.formats.threemf", "read_3mf", "zipfile", ""),
    ".step": STEP,
    ".stp": STEP,
    ".fbx": ("anymesh.formats.fbx_", "read_fbx", "ufbx", "fbx"),
}


@cache
def _pool() -> ChildPool:
    pool = ChildPool(1, LIMITS)
    atexit.register(pool.close)
    return pool


def read_isolated(data: bytes, folder: Folder) -> FileMesh:
    """Read the mesh file of a folder in a child process.

    Raise InputError if it is not valid, ends the process, or exceeds a limit, MissingExtraError without the library.
    """
    name, suffix = folder.path.name, folder.path.suffix.lower()
    module, function, library, extra = READERS[suffix]
    if find_spec(library) is None:
        raise MissingExtraError(f"reading {suffix} needs an extra; install it with {pip_install(extra)}")
    with tempfile.TemporaryDirectory(prefix="anymesh_") as work:
        arguments = {"module": module, "function": function, "folder": folder, "work": Path(work).resolve()}
        try:
            result, read = _pool().run(__name__, "read_here", arguments)
        except ChildError as error:
            if error.failure is Failure.INVALID:
                raise InputError(error.detail) from None
            if error.failure is Failure.ERROR:
                raise InputError(
                    f"{name} is not a valid {suffix[1:].upper()} file, it is broken ({error.detail[:200]})"
                ) from None
            raise InputError(f"{name} cannot be read: its reader ended ({error})") from None
    folder.take(read)
    return result


def read_here(module: str, function: str, folder: Folder, work: Path) -> tuple[FileMesh, Folder]:
    """Read in this process, and return the folder with its warnings too.

    The process ends without collecting its garbage, since objects of ufbx are freed wrongly then.
    """
    gc.disable()
    return getattr(import_module(module), function)(folder, work), folder


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


def remedy(suffix: str) -> str | None:
    """Return what a format is that nothing here reads, and how its file becomes one that is read; None if it is unknown."""
    known = OTHERS.get(suffix)
    return known and f"it is {known}"
