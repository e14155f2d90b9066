"""USD: one small stage for each row on geometry and appearance in docs/formats.md."""

import numpy as np
import pytest
from tables import check_table

pytest.importorskip("pxr")
from usda import BOUND, QUAD, TWO, material, mesh, picture, pixel, read, reader, texture, xform

from anymesh.types.mesh import CLAMP, MIRROR, REPEAT
from anymesh.types.triangles import face_cross


def concave_faces(folder):
    """A C-shaped face is not covered across its gap."""
    body = """int[] faceVertexCounts = [8]
int[] faceVertexIndices = [0, 1, 2, 3, 4, 5, 6, 7]
point3f[] points = [(0,0,0),(3,0,0),(3,1,0),(1,1,0),(1,2,0),(3,2,0),(3,3,0),(0,3,0)]
uniform token subdivisionScheme = "none"
"""
    found, warnings = read(folder, mesh(body=body))
    assert found.mesh.face_areas.sum() == pytest.approx(7)
    assert not warnings


def missing_points(folder):
    found, warnings = read(folder, mesh(body=TWO.replace("0, 2, 3]", "0, 2, 9]")))
    assert len(found.mesh.faces) == 1
    assert "1 faces of 'door' left out: their points are missing" in warnings


def holes(folder):
    found, _ = read(folder, mesh(body=TWO, more="int[] holeIndices = [1]\n"))
    assert len(found.mesh.faces) == 1


def left_handed(folder):
    found, _ = read(folder, mesh(more='uniform token orientation = "leftHanded"\n'))
    assert (found.mesh.face_normals[:, 2] < 0).all()


def subdivision(folder):
    found, warnings = read(folder, mesh(body=QUAD.replace('"none"', '"catmullClark"')))
    assert found.mesh.face_areas.sum() == pytest.approx(1)
    assert warnings == ["left out: 1 subdivisions (the control cages are read as they are)"]


def primitives(folder):
    size = {
        'def Cube "c" { double size = 3 }': ((3, 3, 3), 27),
        'def Sphere "s" { double radius = 2 }': ((4, 4, 4), 4 / 3 * np.pi * 8),
        'def Cylinder "y" { double radius = 1\ndouble height = 5\nuniform token axis = "X" }': ((5, 2, 2), 5 * np.pi),
        'def Cone "k" { double radius = 1\ndouble height = 3\nuniform token axis = "Y" }': ((2, 3, 2), np.pi),
        'def Capsule "p" { double radius = 1\ndouble height = 2 }': ((2, 2, 4), 2 * np.pi + 4 / 3 * np.pi),
    }
    for text, (extents, volume) in size.items():
        found, _ = read(folder, text.replace("{ ", "{\n").replace(" }", "\n}") + "\n")
        assert found.mesh.extents == pytest.approx(extents)
        enclosed = np.einsum("ij,ij->i", found.mesh.triangles[:, 0], face_cross(found.mesh.triangles)).sum() / 6
        assert enclosed == pytest.approx(volume, rel=0.03)
    plane, _ = read(folder, 'def Plane "p"\n{\ndouble width = 4\ndouble length = 2\nuniform token axis = "Y"\n}\n')
    assert plane.mesh.extents == pytest.approx((4, 0, 2))
    assert (plane.mesh.face_normals[:, 1] > 0).all()


def not_surfaces(folder):
    _, warnings = read(folder, mesh() + 'def BasisCurves "hair"\n{\n}\ndef Points "dust"\n{\n}\ndef Points "sand"\n{\n}\n')
    assert warnings == ["left out: 1 curves", "left out: 2 points"]


def normals(folder):
    up = 'normal3f[] normals = [(0,0,1),(0,0,1),(0,0,1),(0,1,0)] (interpolation = "faceVarying")\n'
    found, _ = read(folder, mesh(more=up))
    assert {tuple(n) for n in found.mesh.corner_normal.reshape(-1, 3)} == {(0, 0, 1), (0, 1, 0)}
    wrong, warnings = read(folder, mesh(more=up.replace(",(0,1,0)]", "]")))
    assert wrong.mesh.corner_normal is None
    assert "normals of 'door' left out" in warnings[0]


def display_color(folder):
    """A constant colour is a material, others are colours of corners; they are linear."""
    for interpolation, values in {
        "uniform": "(1,0,0), (0,1,0)", "vertex": "(1,0,0), (0,1,0), (0,0,1), (0,0,0)",
        "varying": "(1,0,0), (0,1,0), (0,0,1), (0,0,0)", "faceVarying": "(1,0,0)" + ", (0,1,0)" * 5,
    }.items():  # fmt: skip
        text = f'color3f[] primvars:displayColor = [{values}] (interpolation = "{interpolation}")\n'
        found, _ = read(folder, mesh(body=TWO, more=text))
        assert found.mesh.corner_color[0, 0].tolist() == [255, 0, 0, 255], interpolation
    half = (
        'color3f[] primvars:displayColor = [(0.2,0,0)] (interpolation = "constant")\nfloat[] primvars:displayOpacity = [0.5]\n'
    )
    found, _ = read(folder, xform("top", mesh(), more=half))  # also from above
    assert found.mesh.corner_color is None
    assert found.mesh.materials[0].base_color == pytest.approx((0.2, 0, 0, 0.5))
    assert found.mesh.materials[0].alpha_mode == "BLEND"
    indexed = 'color3f[] primvars:displayColor = [(1,1,1), (0,0,0)] (interpolation = "uniform")\n'
    found, _ = read(folder, mesh(body=TWO, more=indexed + "int[] primvars:displayColor:indices = [1, 0]\n"))
    assert found.mesh.corner_color[:, 0, 0].tolist() == [0, 255]


def factors(folder):
    surface = """color3f inputs:diffuseColor = (0.1, 0.2, 0.3)
float inputs:metallic = 0.4
float inputs:roughness = 0.6
color3f inputs:emissiveColor = (2, 0, 0)"""
    found, warnings = read(folder, BOUND + material(surface))
    look = found.mesh.materials[0]
    assert look.base_color == pytest.approx((0.1, 0.2, 0.3, 1))
    assert (look.name, look.metallic, look.roughness) == ("paint", pytest.approx(0.4), pytest.approx(0.6))
    assert (look.emissive, look.alpha_mode, look.double_sided, warnings) == ((2, 0, 0), "OPAQUE", False, [])
    sided, _ = read(folder, BOUND.replace("rel material", "uniform bool doubleSided = 1\nrel material") + material(surface))
    assert sided.mesh.materials[0].double_sided
    old, _ = read(folder, BOUND.replace('(prepend apiSchemas = ["MaterialBindingAPI"])', "") + material(surface))
    assert old.mesh.materials[0].name == "paint"  # as old writers bind


def opacity(folder):
    for text, mode, alpha in (
        ("float inputs:opacity = 0.3", "BLEND", 0.3),
        ("float inputs:opacity = 0.3\nfloat inputs:opacityThreshold = 0.2", "MASK", 0.3),
        ("float inputs:opacityThreshold = 0.2", "OPAQUE", 1),
    ):
        look = read(folder, BOUND + material(text))[0].mesh.materials[0]
        assert (look.alpha_mode, look.base_color[3]) == (mode, pytest.approx(alpha))
        assert look.alpha_cutoff == pytest.approx(0.2 if mode == "MASK" else look.alpha_cutoff)
    picture(folder, "red.png", (255, 0, 0))
    picture(folder, "hole.png", (7, 7, 7))
    surface = (
        "color3f inputs:diffuseColor.connect = </paint/a.outputs:rgb>\nfloat inputs:opacity.connect = </paint/b.outputs:r>"
    )
    found, _ = read(folder, BOUND + material(surface, texture("a", "red.png") + texture("b", "./hole.png")))
    assert pixel(found.mesh.materials[0].textures["base_color"].data) == (255, 0, 0, 7)


def pictures(folder):
    """Pictures by any coordinates, wrapped as stated; scale is the factor, and what is missing is its fallback."""
    picture(folder, "red.png", (255, 0, 0))
    surface = (
        "color3f inputs:diffuseColor.connect = </paint/a.outputs:rgb>\nnormal3f inputs:normal.connect = </paint/n.outputs:rgb>"
    )
    wrap = 'token inputs:wrapS = "clamp"\ntoken inputs:wrapT = "mirror"\nfloat4 inputs:scale = (0.5, 1, 1, 1)'
    first = texture("a", "red.png", wrap, "float2 inputs:st.connect = </paint/uv.outputs:result>") + reader("uv", "st")
    bumps = "float4 inputs:scale = (1, 1, 2, 1)\nfloat4 inputs:bias = (-1, -1, -1, 0)"
    second = texture("n", "red.png", bumps, "float2 inputs:st.connect = </paint/uv2.outputs:result>") + reader("uv2", "st1")
    st1 = 'texCoord2f[] primvars:st1 = [(0.5, 0.5)] (interpolation = "constant")\n'
    found, warnings = read(folder, BOUND.replace("rel material", st1 + "rel material") + material(surface, first + second))
    look = found.mesh.materials[0]
    base, normal = look.textures["base_color"], look.textures["normal"]
    assert look.base_color == pytest.approx((0.5, 1, 1, 1))
    assert (base.wrap, base.uv_set, normal.wrap, normal.uv_set) == ((CLAMP, MIRROR), 0, (REPEAT, REPEAT), 1)
    assert (normal.strength, warnings) == (0.5, [])
    assert found.mesh.corner_uv.max() == 1
    assert (found.mesh.corner_more_uv == 0.5).all()
    gone = texture("a", "gone.png", "float4 inputs:fallback = (0, 1, 0, 1)")
    found, warnings = read(folder, BOUND + material(surface.split("\n")[0], gone))
    assert found.mesh.materials[0].base_color == (0, 1, 0, 1)
    assert "texture 'gone.png' left out: it is missing" in warnings[0]


def transform_2d(folder):
    picture(folder, "red.png", (255, 0, 0))
    moved = """def Shader "move" {
uniform token info:id = "UsdTransform2d"
float inputs:rotation = 90
float2 inputs:scale = (2, 3)
float2 inputs:translation = (0.5, 0)
float2 inputs:in.connect = </paint/uv.outputs:result>
float2 outputs:result
}
"""
    nodes = texture("a", "red.png", "", "float2 inputs:st.connect = </paint/move.outputs:result>") + moved + reader("uv", "st")
    found, _ = read(folder, BOUND + material("color3f inputs:diffuseColor.connect = </paint/a.outputs:rgb>", nodes))
    corner = np.flatnonzero((found.mesh.vertices[found.mesh.faces] == (1, 1, 0)).all(2).reshape(-1))[0]
    assert found.mesh.corner_uv.reshape(-1, 2)[corner] == pytest.approx((0.5 - 3, 2))


def several_tiles(folder):
    picture(folder, "red.1001.png", (255, 0, 0))
    nodes = texture("a", "red.<UDIM>.png")
    found, warnings = read(folder, BOUND + material("color3f inputs:diffuseColor.connect = </paint/a.outputs:rgb>", nodes))
    assert "base_color" in found.mesh.materials[0].textures
    assert "several tiles" in warnings[0]


def joined_pictures(folder):
    picture(folder, "rough.png", (10, 0, 0))
    picture(folder, "metal.png", (20, 0, 0))
    surface = "float inputs:roughness.connect = </paint/a.outputs:r>\nfloat inputs:metallic.connect = </paint/b.outputs:r>"
    found, _ = read(folder, BOUND + material(surface, texture("a", "rough.png") + texture("b", "metal.png")))
    look = found.mesh.materials[0]
    assert pixel(look.textures["metallic_roughness"].data)[1:3] == (10, 20)
    assert (look.roughness, look.metallic) == (1, 1)


def omni_pbr(folder):
    """The materials of Omniverse and Isaac Sim: switches say what counts."""
    picture(folder, "red.png", (255, 0, 0))
    kind = """uniform token info:implementationSource = "sourceAsset"
uniform asset info:mdl:sourceAsset = @OmniPBR.mdl@
uniform token info:mdl:sourceAsset:subIdentifier = "OmniPBR\""""
    surface = """asset inputs:diffuse_texture = @./red.png@
color3f inputs:diffuse_tint = (0.5, 1, 1)
float inputs:metallic_constant = 0.25
float inputs:reflection_roughness_constant = 0.75
float inputs:opacity_constant = 0.1
color3f inputs:emissive_color = (1, 0, 0)"""
    text = material(surface, kind=kind).replace("token outputs:surface.connect", "token outputs:mdl:surface.connect", 1)
    look = read(folder, BOUND + text)[0].mesh.materials[0]
    assert (look.metallic, look.roughness, look.alpha_mode, look.emissive) == (0.25, 0.75, "OPAQUE", (0, 0, 0))
    assert look.base_color == (0.5, 1, 1, 1)
    assert pixel(look.textures["base_color"].data) == (255, 0, 0)


def material_x(folder):
    for kind, names in {
        "ND_standard_surface_surfaceshader": ("base_color", "metalness", "specular_roughness"),
        "ND_open_pbr_surface_surfaceshader": ("base_color", "base_metalness", "specular_roughness"),
    }.items():
        surface = "color3f inputs:{} = (0.1, 0.2, 0.3)\nfloat inputs:{} = 1\nfloat inputs:{} = 0.25".format(*names)
        text = material(surface, kind=f'uniform token info:id = "{kind}"')
        look = read(folder, BOUND + text.replace("token outputs:surface.connect", "token outputs:mtlx:surface.connect", 1))
        look = look[0].mesh.materials[0]
        assert look.base_color == pytest.approx((0.1, 0.2, 0.3, 1))
        assert (look.metallic, look.roughness) == (1, 0.25)


def other_shaders(folder):
    found, warnings = read(folder, BOUND + material("", kind='uniform token info:id = "PxrSurface"'))
    assert not found.mesh.materials
    assert warnings == ["material 'paint' uses the shader 'PxrSurface', which is not read; it is drawn grey"]


def unread_inputs(folder):
    _, warnings = read(folder, BOUND + material("float inputs:clearcoat = 1\nint inputs:useSpecularWorkflow = 1"))
    assert warnings == ["clearcoat of materials is left out", "useSpecularWorkflow of materials is left out"]


def color_reader(folder):
    """A material whose colour is a primvar shows that; without it, displayColor does not count beside a material."""
    nodes = """def Shader "c" {
uniform token info:id = "UsdPrimvarReader_float3"
string inputs:varname = "Col"
float3 outputs:result
}
"""
    painted = BOUND.replace("rel material", 'color3f[] primvars:Col = [(1,0,0)] (interpolation = "constant")\nrel material')
    found, _ = read(folder, painted + material("color3f inputs:diffuseColor.connect = </paint/c.outputs:result>", nodes))
    assert found.mesh.corner_color[0, 0].tolist() == [255, 0, 0, 255]
    assert found.mesh.materials[0].base_color == (1, 1, 1, 1)
    plain, _ = read(folder, painted.replace("Col", "displayColor") + material(""))
    assert plain.mesh.corner_color is None


def subsets(folder):
    part = """def GeomSubset "red" (prepend apiSchemas = ["MaterialBindingAPI"])
{
uniform token elementType = "face"
uniform token familyName = "materialBind"
int[] indices = [1]
rel material:binding = </paint>
}
"""
    found, _ = read(folder, mesh(body=TWO, more=part) + material("color3f inputs:diffuseColor = (1, 0, 0)"))
    assert found.mesh.face_material.tolist() == [-1, 0]
    assert len(found.mesh.nodes) == 1


ROWS = {
    "`Mesh`: points, faces, also concave": concave_faces,
    "faces whose points are missing or not finite": missing_points,
    "`holeIndices`": holes,
    "`orientation` leftHanded": left_handed,
    "`subdivisionScheme`": subdivision,
    "`Cube`, `Sphere`, `Cylinder`, `Cone`, `Capsule`, `Plane`": primitives,
    "curves, points, NURBS patches, tetrahedra, volumes": not_surfaces,
    "`normals`": normals,
    "`displayColor`, `displayOpacity`": display_color,
    "`GeomSubset`": subsets,
    "UsdPreviewSurface: colour, metallic, roughness, emission": factors,
    "opacity, opacityThreshold": opacity,
    "`UsdUVTexture`": pictures,
    "`UsdTransform2d`": transform_2d,
    "pictures of several tiles (UDIM)": several_tiles,
    "metallic and roughness of separate pictures": joined_pictures,
    "a primvar as colour (`UsdPrimvarReader`)": color_reader,
    "OmniPBR (MDL)": omni_pbr,
    "MaterialX: standard_surface, open_pbr_surface": material_x,
    "other shaders": other_shaders,
    "clearcoat, displacement, specular workflow": unread_inputs,
}


@pytest.mark.parametrize("row", ROWS)
def test_what_is_said_of_usd(row, tmp_path):
    ROWS[row](tmp_path)


def test_every_row_is_tested():
    check_table("USD", ROWS)
