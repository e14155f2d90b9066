"""Mechanisms are proved in MuJoCo: what follows, loops, balls and loose parts, and what is wrong with them is said."""

from pathlib import Path

import pytest

from anymesh.checking import check_asset
from anymesh.checking.engines.mechanisms_ import prove_mechanisms

PARTS = {
    "loop": (
        '<body name="crank"><joint name="c" axis="0 1 0" range="-.5 {reach}"/><geom type="box" size=".01 .01 .1" pos="0 0 .1"/>'
        '<body name="rod" pos="0 0 .3"><joint name="r" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 .45 0 0" size=".01"/>'
        '</body></body><body name="rocker" pos=".4 0 0"><joint name="k" axis="0 1 0"/>'
        '<geom type="capsule" fromto="0 0 0 .05 0 .3" size=".01"/></body>',
        '<connect name="pin" body1="rod" body2="rocker" anchor=".45 0 0"/>',
    ),
    "gears": (
        '<body name="g1" pos="0 1 0"><joint name="lead" axis="0 0 1" range="-2 2"/><geom size=".1"/></body>'
        '<body name="g2" pos="1 1 0"><joint name="led" axis="0 0 1" range="-{reach} {reach}"/><geom size=".1"/></body>',
        '<joint joint1="led" joint2="lead" polycoef="0 -2 0 0 0"/>',
    ),
    "jar": (
        '<body name="lid" pos="3 2 0"><joint name="rise" type="slide" axis="0 0 1"/>'
        '<joint name="turn" axis="0 0 1" range="0 12"/><geom size=".1"/></body>',
        '<joint joint1="rise" joint2="turn" polycoef="0 .003 0 0 0"/>',
    ),
    "stick": (
        '<body name="s" pos="2 1 0"><joint name="ball" type="ball" range="0 .5"/><geom size=".1" pos="0 0 .2"/></body>',
        "",
    ),
    "pot": (
        '<geom name="pot" type="box" size=".2 .2 .1" pos="5 0 -.2"/>'
        '<body name="cover" pos="5 0 0"><freejoint name="lift"/><geom type="box" size=".2 .2 .02"/></body>',
        "",
    ),
}


def written(folder: Path, *names: str, reach: float = 0.8) -> Path:
    bodies, held = ("".join(PARTS[name][k].format(reach=reach) for name in names) for k in (0, 1))
    path = folder / "mechanism.xml"
    head = '<mujoco><compiler angle="radian" autolimits="true"/><worldbody><geom name="base" size=".01" pos="0 0 -1"/>'
    path.write_text(f"{head}{bodies}</worldbody><equality>{held}</equality></mujoco>")
    return path


def test_all_that_is_right_is_proved(tmp_path):
    found = prove_mechanisms(written(tmp_path, *(name for name in PARTS if name != "gears")))
    assert [(m.kind, m.name) for m in found] == [("follower", "rise"), ("loop", "pin"), ("ball", "ball"), ("free", "lift")]
    assert not [m for m in found if m.faults]
    rise, pin, ball, lift = (m.error for m in found)
    assert max(rise, pin) < 1e-3
    assert 0.45 < ball < 0.54
    assert lift > 1


def test_a_light_lever_leads_heavy_doors(tmp_path):
    path = tmp_path / "lever.xml"
    joint = '<joint name="{0}" axis="0 0 1" frictionloss="2"/>'
    door = '<body name="{0}">' + joint + '<geom type="box" size=".25 .01 .2" pos=".25 0 0" mass="2"/></body>'
    lead = '<joint joint1="{0}" joint2="lever" polycoef="0 2 0 0 0"/>'
    path.write_text(
        '<mujoco><compiler angle="radian" autolimits="true"/><worldbody><geom name="base" size=".01" pos="0 0 -3"/>'
        f'<body name="lever"><joint name="lever" axis="0 1 0" range="0 .75"/><geom size=".03" pos=".05 0 0" mass=".2"/></body>'
        f"{door.format('left')}{door.format('right')}</worldbody>"
        f"<equality>{lead.format('left')}{lead.format('right')}</equality></mujoco>"
    )
    assert [(m.kind, m.faults) for m in prove_mechanisms(path)] == [("follower", ())] * 2


def test_a_follower_that_its_limits_hold_back_is_a_fault(tmp_path):
    lead, led = prove_mechanisms(written(tmp_path, "gears", reach=1.0))[-2:]
    assert "not to its limit" in lead.faults[0]
    assert "from where its leader puts it" in led.faults[0]
    (led,) = prove_mechanisms(written(tmp_path, "gears", reach=4.1))
    assert not led.faults
    assert led.error < 0.01


def test_a_loop_that_cannot_close_over_the_range_is_a_fault(tmp_path):
    findings = check_asset(written(tmp_path, "loop", reach=2.5)).findings
    (finding,) = [f for f in findings if f.check == "mechanisms"]
    assert finding.severity == "warning"  # not written by this package
    assert finding.subject == "pin"
    assert "it opens by" in finding.text


@pytest.mark.parametrize("name", ["stick", "pot"])
def test_a_check_says_what_was_proved(tmp_path, name):
    report = check_asset(written(tmp_path, "jar", name))
    (finding,) = [f for f in report.findings if f.check == "mechanisms"]
    assert finding.severity == "ok"
    assert "1 joints follow" in finding.text
    assert not [f for f in report.findings if f.subject in ("ball", "lift")]


def test_a_loop_that_holds_its_joints_fast_is_said(tmp_path):
    path = written(tmp_path, "loop", "gears")
    path.write_text(path.read_text().replace("<connect", "<weld").replace(' anchor=".45 0 0"', ""))
    (loop,) = (m for m in prove_mechanisms(path) if m.kind == "loop")
    assert loop.faults == ("it holds its joints fast: none of them can move",)
