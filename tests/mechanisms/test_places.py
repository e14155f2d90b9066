"""Places are free boxes on shelves, in drawers and on top, and formats hold them where they are."""

import json
from dataclasses import replace

import mujoco
import numpy as np
import pytest
from assets import box, joint, mesh_of, source
from models import CONFIG, model_of, with_meshes
from pxr import Usd, UsdGeom
from scipy.spatial.transform import Rotation

from anymesh.export.asset_json import asset_record, json_text, schema
from anymesh.export.formats import write_formats
from anymesh.export.options import Format, TargetProject
from anymesh.mechanisms.places import find_places
from anymesh.types import Asset, Part, Segmentation

CASE = [  # 0.6 wide, 0.4 deep and 0.8 high, of boards of 2 cm, with a shelf
    box((-0.3, -0.2, 0.0), (-0.28, 0.2, 0.8)),
    box((0.28, -0.2, 0.0), (0.3, 0.2, 0.8)),
    box((-0.28, 0.18, 0.02), (0.28, 0.2, 0.78)),
    box((-0.28, -0.2, 0.0), (0.28, 0.2, 0.02)),
    box((-0.28, -0.2, 0.78), (0.28, 0.2, 0.8)),
    box((-0.28, -0.2, 0.4), (0.28, 0.18, 0.42)),
]
STRAIGHT = np.eye(3)
TRAY = [  # a drawer of boards of 1 cm that stands below the shelf
    box((-0.27, -0.2, 0.03), (0.27, 0.17, 0.04)),
    box((-0.27, -0.2, 0.04), (0.27, -0.19, 0.2)),
    box((-0.27, 0.16, 0.04), (0.27, 0.17, 0.2)),
    box((-0.27, -0.19, 0.04), (-0.26, 0.16, 0.2)),
    box((0.26, -0.19, 0.04), (0.27, 0.16, 0.2)),
]
OPEN = {"open": {"slide": 0.3}}


def cupboard(turn: np.ndarray = STRAIGHT, out: float = 0.0) -> Asset:
    """Return a case with a drawer that is pulled out, all turned."""
    mesh, piece = mesh_of([*CASE, *TRAY])
    part = (piece >= len(CASE)).astype(int)
    vertices = mesh.vertices.copy()
    vertices[np.unique(mesh.faces[part == 1])] += (0, -out, 0)
    slide = joint("slide", "prismatic", "case", "tray", turn @ (0, -out, 0), turn @ (0, -1, 0), (-out, 0.3))
    parts = Segmentation(part, (Part("case", "base"), Part("tray", "drawer")))
    return Asset("cupboard", source(), replace(mesh, vertices=vertices @ turn.T), parts, (slide,), "test")


def test_what_nothing_leads_to_is_no_place():
    mesh, _ = mesh_of([*CASE, box((-0.28, -0.22, 0.0), (0.28, -0.2, 0.8))])
    asset = Asset("shut", source(), mesh, Segmentation(np.zeros(len(mesh.faces), int), (Part("base", "base"),)), (), "test")
    assert [p.inside for p in find_places(asset, {})] == [False]


@pytest.mark.parametrize("degrees", [0, 20, 90])
def test_shelf_drawer_and_top_are_places(degrees):
    turn = Rotation.from_euler("z", degrees, degrees=True).as_matrix()
    places = find_places(cupboard(turn), OPEN)
    assert [(p.link, p.inside) for p in places] == [("tray", True), ("case", True), ("case", False)]
    feet = np.array([turn.T @ p.place for p in places])
    assert np.allclose(feet, [[0, -0.015, 0.04], [0, -0.01, 0.42], [0, 0, 0.8]], atol=0.01)
    sizes = np.array([[*sorted(p.size[:2]), p.size[2]] for p in places])
    assert np.allclose(sizes, [[0.35, 0.52, 0.36], [0.38, 0.56, 0.36], [0.4, 0.6, 0.3]], atol=0.02)
    assert (sizes[:2, :2] <= [[0.35, 0.52], [0.38, 0.56]]).all()  # nothing is in it


def test_nothing_is_put_into_a_solid_or_onto_a_bar():
    mesh, _ = mesh_of(
        [box((0, 0, 0), (0.5, 0.5, 0.5)), box((0.1, 0.1, 0.1), (0.4, 0.4, 0.3)), box((0.2, -0.03, 0.6), (0.4, 0.0, 0.63))]
    )
    asset = Asset("block", source(), mesh, Segmentation(np.zeros(len(mesh.faces), int), (Part("base", "base"),)), (), "test")
    (top,) = find_places(asset, {})
    assert top.place[2] == pytest.approx(0.5)


def test_a_drawer_is_measured_closed_and_told_at_rest():
    (closed, *_), (ajar, *_) = (
        find_places(cupboard(), OPEN),
        find_places(cupboard(out=0.1), {"closed": {"slide": -0.1}, "open": {"slide": 0.3}}),
    )
    assert np.allclose(ajar.place, closed.place - 0.1 * STRAIGHT[1], atol=1e-6)
    assert np.allclose(ajar.size, closed.size, atol=1e-6)


def test_formats_hold_places_where_they_are(tmp_path):
    asset = cupboard()
    places = find_places(asset, OPEN)
    model = replace(model_of(asset), places=places)
    model = replace(model, how=replace(model.how, target=TargetProject.ROBOCASA))
    write_formats(model, with_meshes(model, tmp_path), (Format.MJCF, Format.USD, Format.SDF), CONFIG)
    spec = mujoco.MjModel.from_xml_path(str(tmp_path / "cupboard.xml"))
    data, stage = mujoco.MjData(spec), Usd.Stage.Open(str(tmp_path / "cupboard.usdc"))
    mujoco.mj_forward(spec, data)
    for p in places:
        site = spec.site(p.name)
        assert np.allclose(data.site_xpos[site.id], p.place + p.size[2] / 2 * STRAIGHT[2], atol=1e-6)
        assert np.allclose(2 * site.size, p.size, atol=1e-6)
        prim = stage.GetPrimAtPath(f"/cupboard/links/{p.link}/{p.name}")
        T = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(prim)).T
        assert np.allclose(T[:3, 3], p.place, atol=1e-6)
        assert np.allclose(prim.GetAttribute("place:size").Get(), p.size, atol=1e-6)
    regions = mujoco.MjModel.from_xml_path(str(tmp_path / "robocasa/cupboard/model.xml"))
    names = [regions.geom(k).name for k in range(regions.ngeom) if regions.geom(k).name.startswith("reg_")]
    assert sorted(names) == ["reg_bbox", "reg_int", "reg_int_1", "reg_main", "reg_top"]
    largest = max(places[:2], key=lambda p: p.size.prod())
    assert np.allclose(2 * regions.geom("reg_int").size, largest.size, atol=1e-6)
    assert np.allclose(regions.geom("reg_int").pos, largest.place + (largest.size[2] / 2 - 0.4) * STRAIGHT[2], atol=1e-6)


def test_asset_json_has_places_of_its_schema():
    jsonschema = pytest.importorskip("jsonschema")
    asset = cupboard()
    record = json.loads(json_text(asset_record(replace(model_of(asset), places=find_places(asset, OPEN)))))
    assert [p["link"] for p in record["places"]] == ["tray", "case", "case"]
    jsonschema.validate(record["places"], schema()["properties"]["places"] | {"$defs": schema()["$defs"]})
