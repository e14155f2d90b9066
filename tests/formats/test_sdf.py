"""Test what is specific to SDFormat; poses and limits are compared in test_formats_agree.py."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from assets import cabinet
from models import CONFIG, desk, model_of, with_meshes

from anymesh.export.model import Exclusion
from anymesh.export.options import Base
from anymesh.formats.robot.sdf import joint_names, sdf_text, write_sdf


def parsed(model) -> ElementTree.Element:
    found = ElementTree.fromstring(sdf_text(model)).find("model")
    assert found is not None
    return found


def test_gazebo_finds_the_model_and_its_meshes(tmp_path):
    model = model_of(cabinet())
    write_sdf(model, with_meshes(model, tmp_path), CONFIG)
    config = ElementTree.parse(tmp_path / "model.config").getroot()
    assert config.findtext("name") == "cabinet"
    file = ElementTree.parse(tmp_path / str(config.findtext("sdf"))).getroot()
    assert config.find("sdf").get("version") == file.get("version")
    uris = [str(u.text) for u in file.iter("uri")]
    assert len(uris) == len(set(uris)) == 9
    assert all((tmp_path / uri).is_file() for uri in uris)


def test_names_are_unique_among_links_and_joints_together():
    model = model_of(desk())  # its joints lid and tray have the names of links
    root = parsed(model)
    names = [e.get("name") for e in [*root.findall("link"), *root.findall("joint")]]
    assert len(names) == len(set(names))
    assert dict(joint_names(model)) == {
        "lid": "lid_2",
        "tray": "tray_2",
        "turn": "turn",
        "stop_joint": "stop_joint",
        "push": "push",
    }


@pytest.mark.parametrize("base", Base)
def test_no_model_is_static(base):
    root = parsed(model_of(cabinet(), base=base))
    assert root.find("static") is None  # it would also fix the joints
    assert len(root.findall("joint")) == 3 + (base is Base.FIXED)


@pytest.mark.parametrize(
    ("pairs", "collides"),
    [((), "true"), ((("base", "door"),), "true"), ((("base", "door"), ("door", "drawer")), "false")],
)
def test_links_that_no_joint_connects_collide_unless_such_a_pair_is_excluded(pairs, collides):
    exclusions = tuple(Exclusion(a, b, "close") for a, b in pairs)
    assert parsed(model_of(cabinet(), exclusions=exclusions)).findtext("self_collide") == collides


def test_colours_are_written_where_those_of_corners_vary():
    asset = cabinet()
    knob = asset.segmentation.face_part == [p.name for p in asset.segmentation.parts].index("knob")
    color = asset.mesh.corner_color.copy()
    color[np.flatnonzero(knob)[::2], :, 0] += 2
    mesh = replace(asset.mesh, corner_color=color, face_material=np.where(knob, -1, asset.mesh.face_material))
    root = parsed(model_of(replace(asset, mesh=mesh)))
    colored = {str(link.get("name")): link.findtext("visual/material/diffuse") for link in root.findall("link")}
    assert colored == {"base": None, "door": None, "drawer": None, "knob": "0.0431373 0.784314 0.352941 1"}
