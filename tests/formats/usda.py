"""Small USD stages as text."""

import io
from pathlib import Path

from PIL import Image

from anymesh.formats.usd.stage_ import read_usd
from anymesh.loading.files import FileMesh, Folder

QUAD = """int[] faceVertexCounts = [4]
int[] faceVertexIndices = [0, 1, 2, 3]
point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
uniform token subdivisionScheme = "none"
"""
TWO = """int[] faceVertexCounts = [3, 3]
int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]
point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
uniform token subdivisionScheme = "none"
"""
UV = 'texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")\n'


def mesh(name: str = "door", body: str = QUAD, more: str = "", head: str = "") -> str:
    return f'def Mesh "{name}" {head}\n{{\n{body}{more}}}\n'


def xform(name: str, body: str, more: str = "", head: str = "") -> str:
    return f'def Xform "{name}" {head}\n{{\n{more}\n{body}}}\n'


def read(folder: Path, text: str, head: str = "metersPerUnit = 1", name: str = "a.usda") -> tuple[FileMesh, list[str]]:
    (folder / name).write_text(f"#usda 1.0\n(\n{head}\n)\n{text}")
    found = Folder(folder / name)
    work = folder / "work"
    work.mkdir(exist_ok=True)
    return read_usd(found, work), found.warnings


def material(surface: str, nodes: str = "", kind: str = 'uniform token info:id = "UsdPreviewSurface"') -> str:
    return f"""def Material "paint" {{
token outputs:surface.connect = </paint/surface.outputs:surface>
def Shader "surface" {{
{kind}
{surface}
token outputs:surface
}}
{nodes}
}}
"""


def texture(name: str, file: str, more: str = "", st: str = "") -> str:
    return f"""def Shader "{name}" {{
uniform token info:id = "UsdUVTexture"
asset inputs:file = @{file}@
{more}
{st}
float3 outputs:rgb
float outputs:r
float outputs:a
}}
"""


def reader(name: str, primvar: str) -> str:
    return f"""def Shader "{name}" {{
uniform token info:id = "UsdPrimvarReader_float2"
string inputs:varname = "{primvar}"
float2 outputs:result
}}
"""


BOUND = mesh(more=UV + "rel material:binding = </paint>\n", head='(prepend apiSchemas = ["MaterialBindingAPI"])')


def picture(folder: Path, name: str, color: tuple[int, ...]) -> None:
    Image.new("RGBA" if len(color) == 4 else "RGB", (2, 2), color).save(folder / name)


def pixel(image: bytes) -> tuple[int, ...]:
    return Image.open(io.BytesIO(image)).getpixel((0, 0))
