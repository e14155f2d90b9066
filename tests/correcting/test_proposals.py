"""`--precision`: unsure joints are not written but proposed, in all formats, until they are accepted."""

import json
import xml.etree.ElementTree as ET
from dataclasses import replace

import jsonschema
import mujoco
import numpy as np
import pytest
from assets import cabinet
from correctable import write_output
from mechanical import doors, linkage

import anymesh
from anymesh.cli import run
from anymesh.correcting import CorrectionError
from anymesh.correcting.proposals import probability, with_proposals
from anymesh.errors import OptionError
from anymesh.export import ExportOptions, write_asset
from anymesh.export.asset_json import schema
from anymesh.types import Asset, Joint
from anymesh.viewer.report_asset import read_asset
from anymesh.viewer.report_html import proposal_table


def unsure(**confidence: float) -> Asset:
    """Return the cabinet with these confidences of joints; all of its parts have .8."""
    asset = cabinet(warnings=("joint slide: low confidence (0.20), please check", "another warning"))
    return replace(asset, joints=tuple(replace(j, confidence=confidence.get(j.name, 0.9)) for j in asset.joints))


def names(asset: Asset) -> list[str]:
    return [p.name for p in asset.segmentation.parts]


def test_part_and_joint_must_both_be_right() -> None:
    asset = unsure(slide=0.5, turn=1.0)
    known = {j.name: probability(asset.segmentation.parts, j) for j in asset.joints}
    assert known == pytest.approx({"hinge": 0.72, "slide": 0.4, "turn": 1.0})  # a stated or corrected joint is certain


def test_faces_of_a_proposal_stay_with_the_part_that_carries_it() -> None:
    asset = unsure(slide=0.5)
    written = with_proposals(asset, 0.7)
    assert names(written) == ["base", "door", "knob"]
    assert {j.name: j.parent for j in written.joints} == {"hinge": "base", "turn": "base"}  # the drawer carried the knob
    (proposal,) = written.proposals
    assert (proposal.part.name, proposal.joint.name, proposal.probability) == ("drawer", "slide", pytest.approx(0.4))
    np.testing.assert_array_equal(proposal.faces, asset.segmentation.faces(2))
    assert (written.segmentation.face_part[proposal.faces] == 0).all()
    assert written.warnings == ("another warning",)  # that on the proposal would name no joint of the files
    assert with_proposals(written, 0.7) is written
    assert with_proposals(asset, 0.0) is asset


def test_what_a_proposal_carries_may_be_a_proposal_too() -> None:
    written = with_proposals(unsure(slide=0.5, turn=0.5), 0.7)
    assert names(written) == ["base", "door"]
    assert [p.joint.parent for p in written.proposals] == ["base", "drawer"]
    nothing = with_proposals(unsure(), 0.95)
    assert (names(nothing), nothing.joints, len(nothing.proposals)) == (["base"], (), 3)


def test_all_formats_have_the_written_joints_alone(tmp_path) -> None:
    write_asset(unsure(slide=0.5), tmp_path, ExportOptions(precision=0.7))
    joints = {j.get("name") for j in ET.parse(tmp_path / "cabinet.urdf").getroot().iter("joint")}
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "cabinet.xml"))
    assert joints == {model.joint(k).name for k in range(model.njnt)} == {"hinge", "turn"}
    record = json.loads((tmp_path / "asset.json").read_text())
    jsonschema.validate(record, schema())
    (proposal,) = record["proposals"]
    assert (record["precision"], proposal["child"], proposal["type"], proposal["label"]) == (
        0.7,
        "drawer",
        "prismatic",
        "drawer",
    )
    assert (proposal["probability"], proposal["confidence"], proposal["part_confidence"]) == (0.4, 0.5, 0.8)
    assert proposal["motion"] == "slides out, to the front"
    faces = np.load(tmp_path / proposal["faces"])
    assert len(faces) == proposal["face_count"] > 0
    base = set(np.load(tmp_path / record["parts"][0]["faces"]).tolist())
    assert set(faces.tolist()) < base


def test_the_report_lists_proposals(tmp_path) -> None:
    write_asset(unsure(slide=0.5), tmp_path, ExportOptions(precision=0.7))
    shown = read_asset(tmp_path)
    assert [p.part.name for p in shown.proposals] == ["drawer"]
    table = proposal_table(shown)
    assert all(words in table for words in ("slides out, to the front", "0.40 guess", "anymesh correct DIR drawer --accept"))
    assert proposal_table(cabinet()) == ""


def test_a_proposal_is_accepted_by_one_operation(tmp_path, capsys) -> None:
    folder = write_output(tmp_path / "out", asset=unsure(slide=0.5, turn=0.5))
    assert run(["export", str(folder), "--precision", "0.7", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert [j["name"] for j in told["joints"]] == ["hinge"]
    assert [p["part"] for p in told["proposals"]] == ["drawer", "knob"]
    assert told["summary"].endswith("2 proposed")
    assert run(["correct", str(folder)]) == 0
    listed = capsys.readouterr().out.splitlines()
    assert [line.split().count("proposed") for line in listed] == [0, 0, 1, 1]

    asset = anymesh.load(folder, author="Ada")
    assert [j.part for j in asset.proposals] == ["drawer", "knob"]
    asset.joint("drawer").accept()
    asset.save()
    record = json.loads((folder / "asset.json").read_text())
    assert record["precision"] == 0.7  # corrections keep it
    assert [j["name"] for j in record["joints"]] == ["hinge", "slide"]
    assert [p["child"] for p in record["proposals"]] == ["knob"]
    with pytest.raises(CorrectionError, match="'drawer' is no proposal"):
        asset.joint("drawer").accept()
    assert run(["correct", str(folder), "knob", "--accept", "-q"]) == 0
    assert json.loads((folder / "asset.json").read_text())["proposals"] == []
    assert run(["export", str(folder), "--precision", "0", "-q"]) == 0
    assert "proposals" not in json.loads((folder / "asset.json").read_text())


def test_a_precision_is_a_probability() -> None:
    for wrong in (1.5, -0.1, "high", True):
        with pytest.raises(OptionError, match=r"--precision: found .* valid are 0 to 1"):
            ExportOptions.parse({"precision": wrong})
    assert ExportOptions.parse({"precision": 0.9}).record()["precision"] == 0.9
    old = {"name": "an asset without the key", "base": "fixed"}
    assert ExportOptions.parse({}, before=old).precision == 0.0  # all joints of it were written


def test_joints_of_old_assets_have_no_others(tmp_path) -> None:
    written = read_asset(write_output(tmp_path / "out"))
    assert all(isinstance(j, Joint) and j.others == () for j in written.joints)
    assert written.proposals == ()


def test_followers_and_loops_go_with_what_leads_and_joins_them() -> None:
    def doubted(asset, name):
        joints = (replace(j, confidence=0.1 if j.name == name else 1.0) for j in asset.joints)
        return with_proposals(replace(asset, joints=tuple(joints)), 0.9)

    written = doubted(doors(), "hinge")
    assert [p.joint.name for p in written.proposals] == ["hinge", "twin"]
    assert [j.mimic and j.mimic.joint for j in doubted(doors(), "second").joints] == [None, "hinge", None, "first"]
    assert not doubted(linkage(), "coupler_joint").loops
