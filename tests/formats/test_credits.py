"""Licence and author of a source: read of what stores give, hostile or not, and written to every format."""

import json
import os
from dataclasses import replace
from xml.etree import ElementTree

import jsonschema
import mujoco
import pytest
import trimesh
import yourdfpy
from assets import cabinet
from export.models import CONFIG, model_of, with_meshes
from formats.test_3mf import model, read, shape
from mesh_files import dae, plain_gltf, put
from pxr import Usd

from anymesh.export.asset_json import asset_record, schema
from anymesh.export.formats import write_formats
from anymesh.export.options import Format
from anymesh.formats.credits import MAX_JSON, MAX_VALUE, of_text
from anymesh.formats.packed import write_package
from anymesh.formats.threemf import read_3mf
from anymesh.loading import load_mesh
from anymesh.loading.files import Folder

SKETCHFAB = """Model Information:
* title:\tOld Chair
* source:\thttps://example.com/old-chair
* author:\tJane (https://example.com/jane)

Model License:
* license type:\tCC-BY-4.0 (http://creativecommons.org/licenses/by/4.0/)
* requirements:\tAuthor must be credited. Commercial use is allowed.
"""
CHAIR = {
    "title": "Old Chair",
    "author": "Jane (https://example.com/jane)",
    "license": "CC-BY-4.0 (http://creativecommons.org/licenses/by/4.0/)",
    "source": "https://example.com/old-chair",
}
TEXTS = {
    SKETCHFAB: CHAIR,
    "\r\n\tKit (2.0)\r\n\r\n\tCreated/distributed by Kim (www.x.org)\r\n\r\n\tLicense: (Creative Commons Zero, CC0)\r\n": {
        "author": "Kim (www.x.org)",
        "license": "(Creative Commons Zero, CC0)",
    },
    "A Pack\n\nLicense:\nCC0 1.0 Universal (CC0 1.0)\nPublic Domain Dedication\n": {"license": "CC0 1.0 Universal (CC0 1.0)"},
    "SPDX-FileCopyrightText: 2023 Jane\n\nSPDX-License-Identifier: CC-BY-4.0": {
        "copyright": "2023 Jane",
        "license": "CC-BY-4.0",
    },
    "MIT License\n\nCopyright (c) 2020 Joe\n\nPermission is": {"copyright": "Copyright (c) 2020 Joe", "license": "MIT License"},
    "   Apache License\n  Version 2.0, January 2004\n": {"license": "Apache License, Version 2.0, January 2004"},
    "\ufeffCC-BY-4.0\n": {"license": "CC-BY-4.0"},
    "\0\x01\n\n": {},
}
RECORDS = [
    ({"name": "Chair", "user": {"displayName": "Jo", "profileUrl": "u"}, "license": "by", "viewerUrl": "v"},
     {"title": "Chair", "author": "Jo (u)", "license": "CC-BY-4.0", "source": "v"}),
    ({"box": {"license": {"slug": "by", "label": "CC Attribution", "url": "u"}}}, {"license": "CC Attribution (u)"}),
    ({"names": ["door"], "faces": [0], "name": "labels"}, {}),
    ([], {}),
]  # fmt: skip


def stated(path, **how) -> dict:
    """Return what is stated, without the line for display."""
    return {key: value for key, value in load_mesh(path, **how).credits.items() if key != "credit"}


def credits(folder, **beside) -> dict:
    put(folder, "box.glb", plain_gltf().glb())
    for name, data in beside.items():
        put(folder, name.replace("_dot_", "."), data)
    return stated(folder / "box.glb")


@pytest.mark.parametrize("text", TEXTS)
def test_texts_of_stores(text) -> None:
    assert of_text(text) == TEXTS[text]


@pytest.mark.parametrize(("record", "found"), RECORDS)
def test_records_of_stores(tmp_path, record, found) -> None:
    assert credits(tmp_path, box_dot_json=json.dumps(record).encode()) == found | ({"found": "box.json"} if found else {})


def test_what_the_file_states_counts_first_and_others_that_differ_are_told(tmp_path) -> None:
    g = plain_gltf()
    g.doc["asset"] |= {"copyright": "(c) Jane", "extras": {"license": "CC-BY-4.0", "author": "Jane"}}
    put(tmp_path, "box.glb", g.glb())
    put(tmp_path, "box.glb.license", b"SPDX-License-Identifier: CC0-1.0\n")
    put(tmp_path, "license.txt", SKETCHFAB.encode())
    loaded = load_mesh(tmp_path / "box.glb")
    assert stated(tmp_path / "box.glb") == {
        "title": "Old Chair", "author": "Jane", "license": "CC-BY-4.0", "source": CHAIR["source"], "copyright": "(c) Jane",
        "found": "asset.copyright, asset.extras, license.txt",
    }  # fmt: skip
    assert (
        loaded.warnings[0] == "the licence is 'CC-BY-4.0' in the file, and 'CC0-1.0' in box.glb.license; the first is written"
    )


def test_metadata_of_other_formats(tmp_path) -> None:
    g = plain_gltf()
    packet = {"dc:creator": {"@list": ["A", "B"]}, "dc:rights": {"@type": "rdf:Alt", "rdf:_1": {"@value": "CC0"}}}
    g.doc["extensions"] = {"KHR_xmp_json_ld": {"packets": [packet]}, "VRM": {"meta": {"licenseName": "CC_BY", "title": "T"}}}
    g.doc["asset"]["extensions"] = {"KHR_xmp_json_ld": {"packet": 0}}
    put(tmp_path, "a.glb", g.glb())
    found = {"title": "T", "author": "A, B", "license": "CC0", "found": "KHR_xmp_json_ld, VRM"}
    assert stated(tmp_path / "a.glb") == found
    told = b"<asset><contributor><author>Jo</author><copyright>(c) Jo</copyright></contributor>"
    put(tmp_path, "b.dae", dae().replace(b"<asset>", told))
    assert stated(tmp_path / "b.dae") == {"author": "Jo", "copyright": "(c) Jo", "found": "contributor"}
    metadata = '<metadata name="Designer">Jo</metadata><metadata name="LicenseTerms">CC0</metadata><resources>'
    text = model(shape(1)).replace("<resources>", metadata)
    read(tmp_path, text)
    folder = Folder(tmp_path / "a.3mf")
    (tmp_path / "work").mkdir()
    read_3mf(folder, (tmp_path / "work").resolve())
    assert folder.credits == {"author": "Jo", "license": "CC0", "credit": "Jo, CC0", "found": "metadata"}


@pytest.mark.parametrize(
    "asset",
    [
        {"copyright": ["x" * 9000] * 9, "extras": {"author": "\ud800\x00\x1b[2J\u202eJo\n\nk" + "y" * 10_000}},
        {"copyright": 5, "extras": [1]},
        {"extras": {"license": {"label": {"label": {"label": {"label": {"label": {"label": "deep"}}}}}}, "author": None}},
        {"extensions": {"KHR_xmp_json_ld": {"packet": -9}}},
        {"extensions": 3, "extras": "Jo"},
    ],
)
def test_hostile_documents(tmp_path, asset) -> None:
    g = plain_gltf()
    g.doc["asset"] |= asset
    put(tmp_path, "box.glb", g.glb())
    found = load_mesh(tmp_path / "box.glb").credits
    assert all(v.isprintable() and len(v) <= MAX_VALUE for v in found.values())
    assert "author" not in found or found["author"].startswith("[2J Jo k")


def test_hostile_files_beside(tmp_path) -> None:
    inside = tmp_path / "in"
    inside.mkdir()
    put(tmp_path, "secret", b"secret")
    (inside / "license.txt").symlink_to(tmp_path / "secret")
    (inside / "LICENSE").mkdir()
    os.mkfifo(inside / "LICENSE.md")
    huge = b'{"license": "by", "x": "' + b"x" * MAX_JSON
    assert credits(inside, box_dot_json=b"[" * 100_000, metadata_dot_json=huge) == {}
    assert load_mesh(inside / "box.glb").warnings == ("metadata.json has over 4 MB and is not read for a licence",)
    with (inside / "box.license").open("wb") as file:
        file.write(b"SPDX-License-Identifier: CC0-1.0\n" + b"-" * 100)
        file.truncate(1 << 33)  # a sparse file of 8 GB
    assert stated(inside / "box.glb") == {"license": "CC0-1.0", "found": "box.license"}


def test_a_licence_above_the_mesh_is_read_within_the_root(tmp_path) -> None:
    put(tmp_path, "license.txt", SKETCHFAB.encode())
    (tmp_path / "source").mkdir()
    mesh = put(tmp_path / "source", "box.glb", plain_gltf().glb())
    assert load_mesh(mesh).credits == {}
    assert stated(mesh, root=tmp_path) == {**CHAIR, "found": "license.txt"}


HOSTILE = {"title": 'Old -- "Chair" ]]> <b>', "author": "Jürgen & Söhne \u4e2d", "license": "CC-BY-4.0"}
HOSTILE |= {"credit": ", ".join(HOSTILE.values()), "found": "license.txt"}


def test_every_format_has_the_credits(tmp_path) -> None:
    asset = cabinet()
    asset = replace(asset, source=replace(asset.source, credits=HOSTILE))
    model = model_of(asset)
    formats = (Format.URDF, Format.MJCF, Format.SDF, Format.GLB, Format.USD, Format.USDZ)
    write_formats(model, with_meshes(model, tmp_path), formats, CONFIG)
    record = asset_record(model)
    assert record["source"]["credits"] == HOSTILE
    jsonschema.validate(record["source"], schema()["properties"]["source"])
    assert ElementTree.parse(tmp_path / "cabinet.urdf").find("credits").attrib == HOSTILE
    assert yourdfpy.URDF.load(tmp_path / "cabinet.urdf").num_actuated_joints == 3
    assert mujoco.MjModel.from_xml_path(str(tmp_path / "cabinet.urdf")).njnt == 3
    texts = mujoco.MjSpec.from_file(str(tmp_path / "cabinet.xml")).texts
    assert {t.name.removeprefix("credits_"): t.data for t in texts} == HOSTILE
    own = "{urn:articulate-anymesh}"
    sdf = ElementTree.parse(tmp_path / "model.sdf").find("model")
    assert {e.tag.removeprefix(own): e.text for e in sdf if e.tag.startswith(own)} == HOSTILE
    assert ElementTree.parse(tmp_path / "model.config").findtext("author/name") == HOSTILE["author"]
    for name in ("cabinet.usdc", "cabinet.usdz"):
        stage = Usd.Stage.Open(str(tmp_path / name))
        assert stage.GetRootLayer().customLayerData["credits"] == HOSTILE
    assert trimesh.load(tmp_path / "cabinet.glb").geometry
    again = load_mesh(tmp_path / "cabinet.glb").credits
    assert {key: again[key] for key in ("title", "author", "license")} == {
        key: HOSTILE[key] for key in ("title", "author", "license")
    }
    assert again["credit"] == again["copyright"] == HOSTILE["credit"]  # it does not grow from file to file
    package = write_package(tmp_path, tmp_path / "ros", base=model.how.base)
    assert ElementTree.parse(package / "package.xml").findtext("license") == "CC-BY-4.0"


def test_without_credits_nothing_is_written(tmp_path) -> None:
    model = model_of(cabinet())
    write_formats(model, with_meshes(model, tmp_path), (Format.URDF, Format.MJCF, Format.SDF), CONFIG)
    assert "credits" not in asset_record(model)["source"]
    assert not any(word in p.read_text() for p in tmp_path.glob("*.*") for word in ("credits", "urn:", "<author>", "copyright"))
