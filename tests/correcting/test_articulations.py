"""Other articulations of a part with their weights, and variants of an asset that are drawn by them."""

import json
from dataclasses import replace

import jsonschema
import numpy as np
import pytest
from assets import box, cabinet, mesh_of
from correctable import write_output
from mechanical import linkage

import anymesh
from anymesh.cli import run
from anymesh.correcting import FlipSign, apply
from anymesh.correcting.articulations import MAX_ARTICULATIONS, MIN_WEIGHT, calibration, same_joint, weights_of
from anymesh.correcting.sampling import Variants, drawn
from anymesh.errors import OptionError
from anymesh.export.asset_json import schema
from anymesh.pipeline.solving import Solver
from anymesh.pipeline.stage_files import JOINTS, read_stage, write_stage
from anymesh.types import Asset, Joint, JointType, Motion

X, Y, Z = np.eye(3)


def two_ways(weight: float = 0.25) -> Asset:
    """Return the cabinet whose drawer and knob may also move otherwise, with this weight and .75 for what was chosen."""
    asset = cabinet()
    slide = next(j for j in asset.joints if j.name == "slide")
    flap = replace(slide, type=JointType.REVOLUTE, axis=X, limits=(0.0, 1.5), confidence=weight, reason="a flap")
    joints = {"slide": replace(slide, confidence=0.75, others=(flap,))}
    return replace(asset, joints=tuple(joints.get(j.name, j) for j in asset.joints))


def test_a_box_with_a_lid_has_a_few_articulations() -> None:
    pieces = [box((0, 0, 0), (1, 0.6, 0.02)), box((0, 0, 0.02), (1, 0.02, 0.5)), box((0, 0.58, 0.02), (1, 0.6, 0.5))]
    pieces += [
        box((0, 0.02, 0.02), (0.02, 0.58, 0.5)),
        box((0.98, 0.02, 0.02), (1, 0.58, 0.5)),
        box((0, 0, 0.505), (1, 0.6, 0.53)),
    ]
    mesh, _ = mesh_of(pieces)
    part = np.repeat(np.arange(6) == 5, 12).astype(np.int64)
    solver = Solver(mesh)
    given = anymesh.Segmentation(part, (anymesh.Part("base", "base"), anymesh.Part("lid", "part")))
    (joint,) = solver.joints(given).joints
    weights = [joint.confidence, *(other.confidence for other in joint.others)]
    assert 2 <= len(weights) <= MAX_ARTICULATIONS
    assert sum(weights) <= 1 + 1e-9
    assert all(w >= MIN_WEIGHT for w in weights)
    assert list(weights[1:]) == sorted(weights[1:], reverse=True)
    same = [(a, b) for a in (joint, *joint.others) for b in joint.others if a is not b and a.type is b.type]
    assert not [1 for a, b in same if a.type is JointType.PRISMATIC and a.axis @ b.axis > 0.99]


def test_a_user_sees_lines_near_each_other_and_one_side_as_one_joint() -> None:
    hinge = Joint("h", JointType.REVOLUTE, "base", "door", np.zeros(3), Z, (0.0, 1.0), 0.5, "by hand")

    def same(kind: JointType, axis: np.ndarray, origin: np.ndarray, *, endless: bool = False) -> bool:
        return same_joint(hinge, Motion(kind, axis, origin, "a line"), endless=endless, size=1.0)

    assert same(JointType.REVOLUTE, Z, 0.05 * X)
    assert not same(JointType.REVOLUTE, Z, 0.5 * X)
    assert not same(JointType.REVOLUTE, -Z, 0 * X)  # it opens to the other side
    assert same(JointType.REVOLUTE, -Z, 0 * X, endless=True)
    assert not same(JointType.PRISMATIC, Z, 0 * X)


def test_the_calibration_is_a_temperature_and_a_share() -> None:
    assert calibration()["temperature"] > 0
    assert 0 <= calibration()["rest"] <= 1


def test_others_are_saved_with_the_stage_and_end_with_a_correction(tmp_path) -> None:
    asset = two_ways()
    folder = write_output(tmp_path / "out", asset=asset)
    (other,) = next(j for j in read_stage(folder, JOINTS, None).joints if j.name == "slide").others
    assert (other.type, other.confidence, other.limits) == (JointType.REVOLUTE, 0.25, (0.0, 1.5))
    write_stage(tmp_path, JOINTS, "k", read_stage(folder, JOINTS, None))
    record = json.loads((folder / "asset.json").read_text())
    jsonschema.validate(record, schema())
    by_name = {j["name"]: j for j in record["joints"]}
    assert [(a["weight"], a["type"]) for a in by_name["slide"]["articulations"]] == [(0.75, "prismatic"), (0.25, "revolute")]
    assert "articulations" not in by_name["hinge"]
    assert next(j for j in apply(asset, FlipSign("drawer")).joints if j.name == "slide").others == ()


def test_variants_are_drawn_by_weight() -> None:
    asset = two_ways()
    often = [drawn(asset, np.random.default_rng((1, k)))["slide"] for k in range(400)]
    assert np.mean(often) == pytest.approx(0.25, abs=0.07)  # three standard deviations
    assert set(drawn(asset, np.random.default_rng(0)).values()) <= {0, 1}
    np.testing.assert_allclose(weights_of(replace(asset.joints[1], confidence=0.0, others=())), [1.0])


def test_parts_alike_take_the_same_one() -> None:
    asset = two_ways()
    slide = asset.joints[1]
    parts = tuple(replace(p, label="drawer") for p in asset.segmentation.parts)
    alike = tuple(replace(slide, name=j.name, child=j.child, parent="base") for j in asset.joints)
    rows = replace(asset, joints=alike, segmentation=replace(asset.segmentation, parts=parts))
    for k in range(20):
        assert len(set(drawn(rows, np.random.default_rng(k)).values())) == 1


def test_joints_on_a_loop_keep_what_closes_it() -> None:
    asset = linkage()
    first = asset.joints[0]
    other = replace(first, axis=np.array([1.0, 0, 0]), confidence=0.5)
    asset = replace(asset, joints=(replace(first, confidence=0.5, others=(other,)), *asset.joints[1:]))
    for loops, numbers in ((asset.loops, {0}), ((), {0, 1})):
        some = replace(asset, loops=loops)
        assert {drawn(some, np.random.default_rng(k))[first.name] for k in range(9)} == numbers


def test_variants_are_whole_assets_and_the_same_for_a_seed(tmp_path) -> None:
    folder = write_output(tmp_path / "out", asset=two_ways(0.75))
    assert run(["export", str(folder), "--formats", "urdf", "--sample", "3", "--seed", "5", "-q"]) == 0
    record = json.loads((folder / "samples" / "samples.json").read_text())
    assert [v["name"] for v in record["variants"]] == ["cabinet_0001", "cabinet_0002", "cabinet_0003"]
    assert (record["seed"], record["weights"]["slide"], record["weights"]["hinge"]) == (5, [0.5, 0.5], [1.0])
    types = []
    for variant in record["variants"]:
        made = json.loads((folder / variant["folder"] / "asset.json").read_text())
        jsonschema.validate(made, schema())
        assert (folder / variant["folder"] / made["files"]["urdf"]).is_file()
        types.append(next(j["type"] for j in made["joints"] if j["name"] == "slide"))
        assert (types[-1] == "revolute") == variant["choices"]["slide"]
    assert len(set(types)) == 2  # with this seed
    assert run(["export", str(folder), "--formats", "urdf", "--sample", "1", "--seed", "5", "-q"]) == 0
    fewer = json.loads((folder / "samples" / "samples.json").read_text())
    assert fewer["variants"] == record["variants"][:1]
    assert not (folder / "samples" / "cabinet_0002").exists()
    assert run(["export", str(folder), "--formats", "urdf", "-q"]) == 0
    assert not (folder / "samples").exists()


def test_a_number_of_variants_has_limits() -> None:
    for count, seed in ((-1, 0), (100_000, 0), (1, -1)):
        with pytest.raises(OptionError, match="--s"):
            Variants(count, seed)
