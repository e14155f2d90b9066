"""asset.json says the same of mechanisms as the description."""

import json
import re

import pytest
from mechanical import doors, jar

from anymesh.checking.engines.robot import read_urdf
from anymesh.checking.schema_ import check_asset_json
from anymesh.export import write_asset


@pytest.mark.parametrize(
    ("make", "change", "words"),
    [
        (doors, lambda joints: joints["third"]["mimic"].update(ratio=-2.0), "'third' follows is 'first' by -1 .*'first' by 1"),
        (jar, lambda joints: joints["thread"].update(pitch=0.03), "pitch of 'thread'"),
    ],
)
def test_an_asset_json_that_couples_otherwise_than_the_description_fails(tmp_path, make, change, words):
    write_asset(make(), tmp_path)
    path, robot = tmp_path / "asset.json", read_urdf(tmp_path / f"{make.__name__}.urdf")
    record = json.loads(path.read_text())
    assert not list(check_asset_json(path, robot))
    change({j["name"]: j for j in record["joints"]})
    path.write_text(json.dumps(record))
    assert [True for f in check_asset_json(path, robot) if re.search(words, f.text)]
