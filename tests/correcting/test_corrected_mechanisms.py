"""A linkage that is corrected to close, twin doors and a drawer's stages that are coupled, a screw: proved in MuJoCo."""

from dataclasses import replace

import pytest
from correctable import write_output
from mechanical import doors, jar, linkage

from anymesh.checking import check_asset
from anymesh.correcting import load
from anymesh.types import JointType

STEPS = {
    linkage: [("coupler", {"loop": "rocker,0.5,0,28cm"})],
    doors: [("right", {"mimic": "left,-1"}), ("middle", {"mimic": "outer,0.5"}), ("inner", {"mimic": "middle,2"})],
    jar: [("lid", {"screw": "20mm"})],
}


def plain(asset):
    """The asset without its mechanisms."""
    joints = (replace(j, mimic=None, pitch=0.0, type=JointType.REVOLUTE if j.pitch else j.type) for j in asset.joints)
    return replace(asset, joints=tuple(joints), loops=())


@pytest.mark.parametrize("make", [pytest.param(linkage, marks=pytest.mark.slow), doors, jar])
def test_corrected_mechanisms_work(tmp_path, make):
    wanted = make()
    folder = write_output(tmp_path / "out", asset=plain(wanted))
    asset = load(folder)
    for part, operations in STEPS[make]:
        asset.correct(part, **operations)
    asset.save()
    again = load(folder).asset
    assert [(j.mimic, j.pitch, j.limits) for j in again.joints] == [(j.mimic, j.pitch, j.limits) for j in wanted.joints]
    assert [(loop.first, loop.second) for loop in again.loops] == [(loop.first, loop.second) for loop in wanted.loops]
    report = check_asset(folder)
    assert report.ok, "\n".join(report.lines())
    proved = report.sweeps[0].mechanisms
    assert proved
    assert max(m.error for m in proved) < 1e-6
    for _ in STEPS[make]:
        asset.undo()
    assert not asset.asset.loops
    assert not any(j.mimic or j.pitch for j in asset.asset.joints)
