"""Training: a few steps, resumed and repeated, and an evaluation. Skipped where the extra `policy` is missing."""

import json
from dataclasses import replace

import numpy as np
import pytest

from anymesh.applications.policy.training_ import SETTINGS
from anymesh.errors import OutputError

SMOKE = SETTINGS["smoke"]


def test_a_training_is_saved_with_its_curve_and_never_repeated(objects, tmp_path):
    from anymesh.applications.policy.training_ import read_curve, train

    out = tmp_path / "laptop"
    path = train([objects / "laptop.xml"], "open", out, steps=256, settings=SMOKE)
    written = path.stat().st_mtime_ns
    curve = read_curve(out)
    assert [row["steps"] for row in curve] == sorted({row["steps"] for row in curve})
    assert curve[-1]["steps"] == 256
    assert train([objects / "laptop.xml"], "open", out, steps=256, settings=SMOKE).stat().st_mtime_ns == written
    with pytest.raises(OutputError, match="other settings"):
        train([objects / "laptop.xml"], "open", out, steps=512, settings=SMOKE)


def test_a_stopped_training_goes_on_from_its_checkpoint(objects, tmp_path):
    from anymesh.applications.policy.training_ import CHECKPOINT, read_curve, train

    def stop(_stage, _name, done, _total):
        if done >= 192:
            raise KeyboardInterrupt

    assets, out = [objects / "laptop.xml"], tmp_path / "laptop"
    with pytest.raises(KeyboardInterrupt):
        train(assets, "open", out, steps=320, settings=SMOKE, progress=stop)
    assert (out / CHECKPOINT).is_file()
    at = json.loads((out / "checkpoint.json").read_text())["steps"]
    assert 0 < at < 192
    seen = []
    train(assets, "open", out, steps=320, settings=SMOKE, progress=lambda _s, _n, done, _t: seen.append(done))
    assert min(seen) > at
    assert max(seen) == 320
    assert read_curve(out)[-1]["steps"] == 320
    assert not (out / CHECKPOINT).exists()


def test_policies_are_evaluated_on_the_same_starts(objects, tmp_path):
    from anymesh.applications.policy.training_ import evaluate_policy, train

    assets = [objects / "laptop.xml", objects / "drawer.xml"]
    first = train(assets, "open", tmp_path / "a", steps=64, settings=SMOKE)
    second = train(assets, "open", tmp_path / "b", steps=64, seed=1, start=first, settings=SMOKE)
    one, again, other = (evaluate_policy(p, assets, "open", episodes=3, settings=SMOKE) for p in (first, first, second))
    assert one == again
    assert [(e.asset, e.number) for e in one] == [(e.asset, e.number) for e in other]
    assert {e.asset for e in one} == {"laptop", "drawer"}
    assert len(one) == 6


def test_the_extractor_reads_clouds(objects, tmp_path):
    from anymesh.applications.policy.training_ import evaluate_policy, train

    settings = replace(SMOKE, observation="points")
    path = train([objects / "laptop.xml"], "open", tmp_path / "points", steps=64, settings=settings)
    assert len(evaluate_policy(path, [objects / "laptop.xml"], "open", episodes=1, settings=settings)) == 1


@pytest.mark.slow
def test_a_minute_of_training_opens_a_laptop(objects, tmp_path):
    from anymesh.applications.policy.training_ import evaluate_policy, train

    path = train([objects / "laptop.xml"], "open", tmp_path / "laptop", steps=60_000, settings=SETTINGS["cpu"])
    found = evaluate_policy(path, [objects / "laptop.xml"], "open", episodes=50)
    assert np.mean([e.success for e in found]) > 0.5
