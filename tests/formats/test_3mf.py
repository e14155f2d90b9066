"""3MF: one small package for each row of its table in docs/formats.md; and what is said of formats that are not read."""

import io
import zipfile

import numpy as np
import pytest
from PIL import Image
from tables import check_table

from anymesh.errors import InputError
from anymesh.formats.advice import OTHERS
from anymesh.formats.threemf import read_3mf
from anymesh.loading import load_mesh
from anymesh.loading.files import FileMesh, Folder
from anymesh.types.mesh import CLAMP, REPEAT, to_linear

CORE = 'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" xmlns:p="urn:production" xmlns:m="urn:material"'
VERTICES = "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)))
TWO = '<triangle v1="0" v2="1" v3="2"/><triangle v1="0" v2="2" v3="3"/>'


def shape(number: int, triangles: str = TWO, more: str = "") -> str:
    mesh = f"<mesh><vertices>{VERTICES}</vertices><triangles>{triangles}</triangles></mesh>"
    return f'<object id="{number}" {more}>{mesh}</object>'


def model(resources: str, items: str = '<item objectid="1"/>', unit: str = "millimeter") -> str:
    return f'<model unit="{unit}" {CORE}><resources>{resources}</resources><build>{items}</build></model>'


def read(folder, text: str, **others) -> tuple[FileMesh, list[str]]:
    with zipfile.ZipFile(folder / "a.3mf", "w") as archive:
        archive.writestr("3D/3dmodel.model", text)
        for name, content in others.items():
            archive.writestr(name.replace("__", "/").replace("_dot_", "."), content)
    found = Folder(folder / "a.3mf")
    work = folder / f"work{len(list(folder.iterdir()))}"
    work.mkdir()
    return read_3mf(found, work.resolve()), found.warnings


def meshes(folder):
    found, warnings = read(folder, model(shape(1, TWO + '<triangle v1="0" v2="1" v3="9"/>')))
    assert (len(found.mesh.faces), warnings) == (2, ["left out: 1 triangles that refer to no vertex"])


def build(folder):
    parts = shape(1, more='name="leaf"') + '<object id="2" name="door"><components><component objectid="1"/>'
    parts += '<component objectid="7" p:path="/3D/other.model" transform="0 1 0 -1 0 0 0 0 1 5 0 0"/></components></object>'
    other = model(shape(7, more='name="knob"'), "")
    items = '<item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 3"/>'
    found, _ = read(folder, model(parts, items), **{"3D__other_dot_model": other})
    assert [(n.name, n.path) for n in found.mesh.nodes] == [("leaf", ("door", "leaf")), ("knob", ("door", "knob"))]
    assert found.mesh.subset(found.mesh.face_node == 1).bounds == pytest.approx(np.array([(4, 0, 3), (5, 1, 3)]))
    loop = '<object id="1"><components><component objectid="1"/></components></object>'
    with pytest.raises(InputError, match="nested too deep"):
        read(folder, model(loop))


def units(folder):
    assert [read(folder, model(shape(1), unit=u))[0].unit for u in ("inch", "meter", "parsec")] == [0.0254, 1.0, 0.001]
    assert read(folder, model(shape(1)))[0].up == "z"


def base_materials(folder):
    bases = '<basematerials id="5"><base name="red" displaycolor="#FF0000"/>'
    bases += '<base name="glass" displaycolor="#80808080"/></basematerials>'
    triangles = '<triangle v1="0" v2="1" v3="2"/><triangle v1="0" v2="2" v3="3" pid="5" p1="1"/>'
    found, _ = read(folder, model(bases + shape(1, triangles, 'pid="5" pindex="0"')))
    red, glass = (found.mesh.materials[k] for k in found.mesh.face_material)
    assert (red.name, red.base_color, red.alpha_mode) == ("red", (1, 0, 0, 1), "OPAQUE")
    assert (glass.base_color[0], glass.alpha_mode) == (pytest.approx(to_linear([128 / 255])[0]), "BLEND")


def color_groups(folder):
    colors = '<m:colorgroup id="5"><m:color color="#FF0000"/><m:color color="#00FF00FF"/></m:colorgroup>'
    triangles = '<triangle v1="0" v2="1" v3="2" pid="5" p1="0" p2="1" p3="0"/>'
    found, _ = read(folder, model(colors + shape(1, triangles)))
    assert found.mesh.corner_color[0].tolist() == [[255, 0, 0, 255], [0, 255, 0, 255], [255, 0, 0, 255]]


def textures(folder):
    image = io.BytesIO()
    Image.new("RGB", (2, 2), (255, 0, 0)).save(image, "PNG")
    group = '<m:texture2d id="4" path="/3D/red.png" tilestyleu="clamp"/><m:texture2dgroup id="5" texid="4">'
    group += '<m:tex2coord u="0" v="0"/><m:tex2coord u="1" v="0.5"/></m:texture2dgroup>'
    triangles = '<triangle v1="0" v2="1" v3="2" pid="5" p1="0" p2="1" p3="1"/>'
    found, _ = read(folder, model(group + shape(1, triangles)), **{"3D__red_dot_png": image.getvalue()})
    assert found.mesh.materials[0].textures["base_color"].wrap == (CLAMP, REPEAT)
    assert found.mesh.corner_uv[0].tolist() == [[0, 0], [1, 0.5], [1, 0.5]]
    assert "not in the archive" in read(folder, model(group + shape(1, triangles)))[1][0]


def supports(folder):
    items = '<item objectid="1"/><item objectid="2"/>'
    found, warnings = read(folder, model(shape(1) + shape(2, more='type="support"'), items))
    assert (len(found.mesh.nodes), warnings) == (1, ["left out: 1 objects of the type support"])


def others(folder):
    text = model('<m:multiproperties id="9" pids="1 2"/>' + shape(1))
    assert read(folder, text)[1] == ["left out: 1 properties in several layers"]


ROWS = {
    "`mesh`": meshes,
    "`build`, `components`, transforms, `p:path`": build,
    "`unit`": units,
    "`basematerials`": base_materials,
    "`colorgroup`": color_groups,
    "`texture2dgroup`": textures,
    "objects of the type support": supports,
    "mixtures of materials, multiproperties, beam lattices, slices, volumes": others,
}


@pytest.mark.parametrize("row", ROWS)
def test_what_is_said_of_3mf(row, tmp_path):
    ROWS[row](tmp_path)


def test_every_row_on_3mf_is_tested():
    check_table("3MF, STEP and what is not read", ROWS)


def test_a_hostile_3mf_ends_in_one_error(tmp_path):
    bomb = "<!DOCTYPE a [<!ENTITY b 'c'>]>" + model(shape(1))
    with pytest.raises(InputError, match="document type"):
        read(tmp_path, bomb)
    with pytest.raises(InputError, match="not in the archive"):
        read(tmp_path, model(shape(1), '<item objectid="1" p:path="/../../secret.model"/>'))
    with pytest.raises(InputError, match="XML is broken"):
        read(tmp_path, "<model")


@pytest.mark.parametrize("suffix", OTHERS)
def test_a_format_that_is_not_read_has_a_way_out(suffix, tmp_path):
    (tmp_path / f"a{suffix}").write_bytes(b"x")
    with pytest.raises(InputError, match=rf"found the format \{suffix}; it is .+; "):
        load_mesh(tmp_path / f"a{suffix}")
