"""Test that what a glTF file says of appearance is read, or named in one warning: each row of the table in docs/formats.md."""

from __future__ import annotations

import base64
import io
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from assets import checker
from mesh_files import UV, Gltf, put
from PIL import Image

from anymesh.loading.load import LoadedMesh, load_mesh
from anymesh.types import Material, Texture
from anymesh.types.mesh import CLAMP, MIRROR, REPEAT

TABLE = Path(__file__).parents[2] / "docs" / "formats.md"
KTX2 = base64.b64decode(  # 8 x 8, ETC1S: red above blue
    "q0tUWCAyMLsNChoKAAAAAAEAAAAIAAAACAAAAAAAAAAAAAAAAQAAAAEAAAABAAAAaAAAACwAAACUAAAAJAAAALgAAAAAAAAAhAAAAAAAAAA8AQAAAAAAAAEAAAAAAAAA"
    "AAAAAAAAAAAsAAAAAAAAAAIAKACjAQIAAwMAAAgAAAAAAAAAAAA/AAAAAAAAAAAA/////x8AAABLVFh3cml0ZXIAQmFzaXMgVW5pdmVyc2FsIDIuMTAAAAIAAQAsAAAA"
    "BQAAACsAAAAAAAAAAAAAAAAAAAABAAAAAAAAAAAAAAAWwEQAAAAAAABiwgQwAwAAAAAAgKTHAEwEAAAAAAAgAQiACQABAAAAACSdAFRVVVUFNMBEAAAAAAAAEkUAmAAQ"
    "AAAAAEAUAiYCAAAAAACQNgLABIAAAAAAACIQAAA="
)
ARRAY = np.arange(64).reshape(8, 8)
PICTURE, SECOND = {"index": 0}, {"index": 1}
Read = Callable[..., LoadedMesh]


def encoded(pixels: np.ndarray | Image.Image, kind: str = "PNG") -> bytes:
    file = io.BytesIO()
    (pixels if isinstance(pixels, Image.Image) else Image.fromarray(pixels)).save(file, kind)
    return file.getvalue()


def flat(*color: int, mode: str = "RGBA") -> bytes:
    return encoded(Image.new(mode, (4, 4), color))


@pytest.fixture
def read(tmp_path: Path) -> Read:
    """Return a reader of a box with two sets of coordinates and one material; pictures: what textures 0, 1 ... show."""

    def make(material: dict, *pictures: bytes, attributes: dict | None = None, textures=None, **document) -> LoadedMesh:
        g = Gltf()
        pictures = pictures or (checker(),)
        more = {key: g.array(values) for key, values in (attributes or {}).items()}
        solid = g.solid(TEXCOORD_0=g.array(UV), TEXCOORD_1=g.array(UV / 2), **more)
        g.doc["images"] = [{"bufferView": g.view(data), "name": f"p{k}"} for k, data in enumerate(pictures)]
        g.doc["textures"] = textures or [{"source": k} for k in range(len(pictures))]
        g.doc |= {"materials": [{"name": "paint", **material}], **document}
        g.node(mesh=g.mesh({**solid, "material": document.get("used", 0)}))
        return load_mesh(put(tmp_path, "box.glb", g.glb()))

    return make


def look(loaded: LoadedMesh) -> Material:
    assert loaded.warnings == ()
    return loaded.mesh.materials[0]


def base(loaded: LoadedMesh) -> Texture:
    return look(loaded).textures["base_color"]


def textured(**more) -> dict:
    return {"pbrMetallicRoughness": {"baseColorTexture": {**PICTURE, **more}, "metallicFactor": 0}}


def extended(**extensions) -> dict:
    return {"extensions": {f"KHR_materials_{name}": value for name, value in extensions.items()}}


def _named(read: Read) -> None:
    assert look(read({})).name == "paint"
    assert look(read({"name": ""})).name == "material_0"


def _factors(read: Read) -> None:
    m = look(
        read({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 2], "metallicFactor": 0.5, "roughnessFactor": 0.75}})
    )
    assert (m.base_color, m.metallic, m.roughness) == ((0.5, 0.25, 1, 1), 0.5, 0.75)


def _pictures(read: Read) -> None:
    pbr = {"baseColorTexture": PICTURE, "metallicRoughnessTexture": SECOND}
    m = look(read({"pbrMetallicRoughness": pbr, "emissiveTexture": PICTURE}, checker(), flat(0, 128, 0, mode="RGB")))
    assert {slot: t.data == checker() for slot, t in m.textures.items()} == {
        "base_color": True, "metallic_roughness": False, "emissive": True,
    }  # fmt: skip


def _strengths(read: Read) -> None:
    m = look(read({"normalTexture": {**PICTURE, "scale": 0.5}, "occlusionTexture": {**PICTURE, "strength": 0.25}}))
    assert {slot: t.strength for slot, t in m.textures.items()} == {"normal": 0.5, "occlusion": 0.25}


def _glow(read: Read) -> None:
    assert look(read({"emissiveFactor": [0, 1, 0.5]})).emissive == (0, 1, 0.5)
    assert look(read({"emissiveFactor": [0, 1, 0.5], **extended(emissive_strength={"emissiveStrength": 4})})).emissive == (
        0,
        4,
        2,
    )


def _alpha(read: Read) -> None:
    faint = {"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]}}
    assert look(read(faint)).opacity == 1
    assert look(read({**faint, "alphaMode": "OPAQUE"})).opacity == 1
    assert look(read({**faint, "alphaMode": "BLEND"})).opacity == 0.25
    unseen = read({**faint, "alphaMode": "MASK"})
    assert unseen.mesh.materials[0].opacity == 0
    assert unseen.warnings == ("invisible by the alpha of its material, as the file states: paint",)
    assert look(read({**faint, "alphaMode": "MASK", "alphaCutoff": 0.2})).opacity == 1


def _sides(read: Read) -> None:
    assert look(read({"doubleSided": True})).double_sided


def _colors(read: Read) -> None:
    color = read({}, attributes={"COLOR_0": np.full((8, 4), 0.25)}).mesh.corner_color
    assert color is not None
    assert set(color.reshape(-1).tolist()) == {137, 64}  # sRGB of .25; alpha is linear


def _more_colors(read: Read) -> None:
    assert "COLOR_1" in read({}, attributes={"COLOR_1": np.ones((8, 3))}).warnings[0]


def _coordinates(read: Read) -> None:
    mesh = read({**textured(texCoord=1), "occlusionTexture": PICTURE, "normalTexture": {**PICTURE, "texCoord": 1}}).mesh
    assert {slot: t.uv_set for slot, t in mesh.materials[0].textures.items()} == {"base_color": 0, "normal": 0, "occlusion": 1}
    assert mesh.corner_uv is not None
    assert mesh.corner_more_uv is not None
    np.testing.assert_allclose(2 * mesh.corner_uv[..., 0], mesh.corner_more_uv[..., 0], atol=1e-6)


def _transforms(read: Read) -> None:
    def moved(**more) -> dict:
        return {"extensions": {"KHR_texture_transform": more}}

    turned = textured(**moved(rotation=np.pi / 2, offset=[0, 1], scale=[2, 2]))
    mesh = read({**turned, "normalTexture": {**PICTURE, **moved(texCoord=1)}, "occlusionTexture": PICTURE}).mesh
    assert {slot: t.uv_set for slot, t in mesh.materials[0].textures.items()} == {"base_color": 0, "normal": 1, "occlusion": 2}
    u, v = mesh.corner_more_uv[..., 2], 1 - mesh.corner_more_uv[..., 3]  # as in the file
    np.testing.assert_allclose(mesh.corner_uv, np.stack([2 * v, 2 * u], -1), atol=1e-6)  # a quarter turn, v upwards
    np.testing.assert_allclose(mesh.corner_more_uv[..., 0], u / 2, atol=1e-6)
    slots = {"normalTexture": 0.1, "occlusionTexture": 0.2, "emissiveTexture": 0.3}
    pbr = {"baseColorTexture": PICTURE, "metallicRoughnessTexture": {**PICTURE, **moved(offset=[0.4, 0])}}
    five = read({"pbrMetallicRoughness": pbr, **{k: {**PICTURE, **moved(offset=[o, 0])} for k, o in slots.items()}})
    assert [w for w in five.warnings if "4 sets" in w and "emissive" in w]
    assert len(five.mesh.materials[0].textures) == 4


def _wraps(read: Read) -> None:
    def wrapped(**sampler) -> tuple[str, str]:
        return base(read(textured(), textures=[{"source": 0, "sampler": 0}], samplers=[sampler])).wrap

    assert wrapped() == (REPEAT, REPEAT)
    assert wrapped(wrapS=33071, wrapT=33648) == (CLAMP, MIRROR)
    assert wrapped(wrapS=10497, wrapT=33071) == (REPEAT, CLAMP)


def _filters(read: Read) -> None:
    for sampler, nearest in (({"magFilter": 9728}, True), ({"magFilter": 9729, "minFilter": 9728}, False), ({}, False)):
        assert base(read(textured(), textures=[{"source": 0, "sampler": 0}], samplers=[sampler])).nearest is nearest


def _content(read: Read) -> None:
    uri = "data:application/octet-stream;base64," + base64.b64encode(checker()).decode()
    assert base(read(textured(), images=[{"uri": uri, "mimeType": "image/jpeg"}])).mime == "image/png"


def _kept(read: Read) -> None:
    grey = Image.fromarray(np.uint8(ARRAY * 4))
    for data in (flat(9, 8, 7, 6), encoded(grey), encoded(grey.convert("P")), encoded(grey, "JPEG")):
        assert base(read(textured(), data)).data == data


def _converted(read: Read) -> None:
    rising = np.repeat(np.uint8(ARRAY * 4)[..., None], 3, -1)
    assert (base(read(textured(), encoded(np.uint16(ARRAY * 4 * 257)))).pixels()[..., :3] == rising).all()
    assert (base(read(textured(), encoded(np.float32(ARRAY * 4 / 255), "TIFF"))).pixels()[..., :3] == rising).all()
    for kind in ("TIFF", "BMP", "TGA", "GIF"):
        made = base(read(textured(), encoded(rising[..., 0], kind)))
        assert (made.mime, (made.pixels()[..., :3] == rising).all()) == ("image/png", True)
    inked = base(read(textured(), encoded(Image.new("CMYK", (8, 8), (0, 200, 200, 0)), "JPEG")))
    assert inked.mime == "image/png"
    assert inked.pixels()[0, 0].tolist() == pytest.approx([255, 55, 55, 255], abs=3)


def _faulty(read: Read) -> None:
    for faulty in (
        {"textures": [{"source": 7}]},
        {"textures": [{}, {}]},
        {"textures": [{"source": 0, "sampler": 3}]},
        {"images": [{}]},
    ):
        loaded = read(textured(), **faulty)
        assert loaded.mesh.materials[0].textures == {}
        assert len(loaded.warnings) == ("textures" not in faulty or faulty["textures"] != [{}, {}])
    assert "left out" in read(textured(), b"no picture").warnings[0]
    assert "texture coordinates of" in read(textured(texCoord=4)).warnings[0]
    assert "1 of 1 primitives refer to a material" in read({}, used=5).warnings[0]


def _extension_pictures(read: Read) -> None:
    for name, kind in (("EXT_texture_webp", "WEBP"), ("EXT_texture_avif", "AVIF"), ("MSFT_texture_dds", "DDS")):
        texture = {"source": 1, "extensions": {name: {"source": 0}}}
        pictures = (encoded(Image.new("RGB", (8, 8), (200, 0, 0)), kind), checker())
        made = base(read(textured(), *pictures, textures=[texture], extensionsUsed=[name], extensionsRequired=[name]))
        assert made.pixels()[0, 0].tolist() == pytest.approx([200, 0, 0, 255], abs=12)
        assert base(read(textured(), checker(), textures=[{"source": 0, "extensions": {name: {}}}])).data == checker()


def _ktx2(read: Read) -> None:
    pytest.importorskip("opengl_basisu")
    texture = {"extensions": {"KHR_texture_basisu": {"source": 0}}}
    made = base(read(textured(), KTX2, textures=[texture], extensionsRequired=["KHR_texture_basisu"]))
    assert made.mime == "image/png"
    red, blue = made.pixels()[[0, -1], 0, :3].astype(int)
    assert red[0] > red[2] + 100
    assert blue[2] > blue[0] + 100
    for data in (KTX2[:200], KTX2[:90] + b"\xff" * 40 + KTX2[130:]):
        assert "left out" in read(textured(), data, textures=[texture]).warnings[0]


def _unlit(read: Read) -> None:
    m = look(read({**textured(), "emissiveFactor": [1, 1, 1], **extended(unlit={})}))
    assert (m.unlit, m.metallic, m.roughness, m.emissive, [*m.textures]) == (True, 0, 1, (0, 0, 0), ["base_color"])


def _transmission(read: Read) -> None:
    glass = extended(transmission={"transmissionFactor": 1.0})
    m = look(read({**textured(), **glass}, flat(9, 8, 7, 0)))  # its alpha does not count, as the mode is OPAQUE
    assert (m.alpha_mode, m.opacity) == ("BLEND", 0.25)
    assert m.textures["base_color"].pixels()[0, 0].tolist() == [9, 8, 7, 255]
    masked = extended(transmission={"transmissionFactor": 1.0, "transmissionTexture": PICTURE})
    assert look(read(masked, flat(0, 0, 0, mode="RGB"))).opacity == 1
    assert look(read(extended(transmission={"transmissionFactor": 0}))).alpha_mode == "OPAQUE"


def _gloss(read: Read) -> None:
    def gloss(*pictures: bytes, **more) -> Material:
        return look(read(extended(pbrSpecularGlossiness=more), *pictures))

    plain = gloss(diffuseFactor=[0.5, 0.25, 0, 0.5], glossinessFactor=0.25)
    assert (plain.base_color, plain.metallic, plain.roughness) == ((0.5, 0.25, 0, 0.5), 0, 0.75)
    assert gloss(diffuseTexture=PICTURE).textures["base_color"].data == checker()
    steel = gloss(diffuseFactor=[0, 0, 0, 1], specularFactor=[0.5, 0.5, 0.5])
    assert (steel.metallic, steel.roughness) == (pytest.approx(1, abs=0.02), 0)
    assert steel.base_color[:3] == pytest.approx([0.5] * 3, abs=0.02)
    halves = np.zeros((4, 4, 4), np.uint8)
    halves[:2] = [188, 188, 188, 128]  # metal above, plastic below
    made = gloss(checker(4), encoded(halves), diffuseTexture=PICTURE, specularGlossinessTexture=SECOND)
    rough = made.textures["metallic_roughness"].pixels()
    assert rough[0, 0, 2] > 150
    assert rough[-1, -1, 1:3].tolist() == [255, 0]
    assert rough[0, 0, 1] == pytest.approx(127, abs=2)
    constant = gloss(encoded(halves), specularGlossinessTexture=PICTURE, diffuseFactor=[0.5, 0, 0, 0.5])
    red = constant.textures["base_color"].pixels()[-1, -1]
    assert red.tolist() == pytest.approx([192, 0, 0, 128], abs=2)
    plastic = gloss(checker(4), diffuseTexture=PICTURE, specularFactor=[0.04, 0.04, 0.04], glossinessFactor=0.5)
    np.testing.assert_allclose(plastic.textures["base_color"].pixels(), Texture(checker(4), "image/png").pixels(), atol=3)


def _left_out(name: str, nothing: dict, something: dict) -> Callable[[Read], None]:
    def check(read: Read) -> None:
        look(read(extended(**{name: nothing})))
        (warning,) = read(extended(**{name: something})).warnings
        assert f"KHR_materials_{name} of 1" in warning

    return check


def _other(read: Read) -> None:
    (warning,) = read({"extensions": {"ADOBE_materials_thin_transparency": {"transmissionFactor": 1}}}).warnings
    assert "ADOBE_materials_thin_transparency" in warning


def _variants(read: Read) -> None:
    names = {"variants": [{"name": "Blue"}, {"name": "Red"}]}
    (warning,) = read({}, extensions={"KHR_materials_variants": names}).warnings
    assert "'Blue', 'Red'" in warning


def _extras(read: Read) -> None:
    assert look(read({"extras": {"shader": "x"}}, extras={"a": 1})).name == "paint"


ROWS: dict[str, Callable[[Read], None]] = {
    "`name`": _named,
    "`baseColorFactor`, `metallicFactor`, `roughnessFactor`": _factors,
    "`baseColorTexture`, `metallicRoughnessTexture`, `emissiveTexture`": _pictures,
    "`normalTexture` with `scale`, `occlusionTexture` with `strength`": _strengths,
    "`emissiveFactor`, `KHR_materials_emissive_strength`": _glow,
    "`alphaMode`, `alphaCutoff`": _alpha,
    "`doubleSided`": _sides,
    "`COLOR_0`": _colors,
    "`COLOR_1` and further": _more_colors,
    "`texCoord`": _coordinates,
    "`KHR_texture_transform`": _transforms,
    "`wrapS`, `wrapT`": _wraps,
    "`magFilter`, `minFilter`": _filters,
    "`image`: `uri`, `bufferView`, `mimeType`": _content,
    "PNG and JPEG: colour, grey, palette": _kept,
    "grey of 16 bits, CMYK, TIFF, BMP, TGA, GIF": _converted,
    "references to nothing, broken pictures": _faulty,
    "`EXT_texture_webp`, `EXT_texture_avif`, `MSFT_texture_dds`": _extension_pictures,
    "`KHR_texture_basisu` (KTX 2)": _ktx2,
    "`KHR_materials_unlit`": _unlit,
    "`KHR_materials_transmission`": _transmission,
    "`KHR_materials_pbrSpecularGlossiness`": _gloss,
    "`KHR_materials_anisotropy`": _left_out("anisotropy", {"anisotropyRotation": 1}, {"anisotropyStrength": 0.5}),
    "`KHR_materials_clearcoat`": _left_out("clearcoat", {"clearcoatRoughnessFactor": 0.1}, {"clearcoatFactor": 1}),
    "`KHR_materials_diffuse_transmission`": _left_out("diffuse_transmission", {}, {"diffuseTransmissionFactor": 0.2}),
    "`KHR_materials_dispersion`": _left_out("dispersion", {}, {"dispersion": 0.1}),
    "`KHR_materials_ior`": _left_out("ior", {"ior": 1.5}, {"ior": 1.33}),
    "`KHR_materials_iridescence`": _left_out("iridescence", {"iridescenceIor": 1.8}, {"iridescenceFactor": 1}),
    "`KHR_materials_sheen`": _left_out("sheen", {"sheenRoughnessFactor": 1}, {"sheenColorFactor": [1, 0, 0]}),
    "`KHR_materials_specular`": _left_out("specular", {"specularColorFactor": [1.0, 1.0, 1.0]}, {"specularTexture": PICTURE}),
    "`KHR_materials_volume`": _left_out("volume", {"attenuationColor": [1, 0, 0]}, {"thicknessFactor": 0.1}),
    "`KHR_materials_variants`": _variants,
    "other extensions of materials": _other,
    "`extras`": _extras,
}


@pytest.mark.parametrize("row", ROWS)
def test_what_a_row_says_holds(row: str, read: Read) -> None:
    ROWS[row](read)


def test_the_table_has_these_rows() -> None:
    section = TABLE.read_text(encoding="utf-8").split("### glTF: appearance\n")[1].split("\n### ")[0]
    rows = [line.split(" | ")[0].removeprefix("| ") for line in section.split("\n") if line.startswith("| ")]
    assert rows[1:] == [*ROWS]


def test_a_missing_decoder_is_named(read: Read, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "opengl_basisu", None)
    (warning,) = read(textured(), KTX2).warnings
    assert ".[ktx2]" in warning
