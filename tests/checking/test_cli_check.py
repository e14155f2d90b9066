"""`anymesh check` on the command line."""

import json

import typer
from drawn import chest
from typer.testing import CliRunner

from anymesh.checking.command_line import NOT_IN_ORDER, check

app = typer.Typer()
app.command()(check)


def run(*arguments):
    return CliRunner().invoke(app, [str(a) for a in arguments])


def test_a_good_asset_is_told_in_lines_with_exit_code_0(tmp_path):
    done = run(chest(tmp_path))
    assert done.exit_code == 0
    assert done.output.splitlines()[-1].endswith("passed, 0 failures, 0 warnings")


def test_a_bad_one_ends_with_its_own_exit_code_and_json_alone(tmp_path):
    path = chest(tmp_path, ('axis xyz="0 -1 0"', 'axis xyz="0 0 0"'))
    done = run(path, "--json", "--engine", "mujoco")
    assert done.exit_code == NOT_IN_ORDER == 8
    record = json.loads(done.output)
    assert not record["ok"]
    assert [f["subject"] for f in record["findings"] if f["severity"] == "failure"] == ["slide"]


def test_quiet_says_nothing_and_names_cannot_steer_the_terminal(tmp_path):
    path = chest(tmp_path, ('"drawer"', '"dra\u0085\u202ewer"'))
    assert run(path, "--quiet").output == ""
    told = run(path).output
    assert "dra??wer" in told
    assert "\u202e" not in told
