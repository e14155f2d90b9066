"""Objects that the tests of policies share, and the reason for which training is not tested."""

import importlib.util
from pathlib import Path

import pytest
from mjcf_objects import write_objects
from policy_things import BUCKET, DRAWER, LAPTOP

MISSING = [name for name in ("torch", "stable_baselines3") if importlib.util.find_spec(name) is None]
NO_TRAINING = f"the extra `policy` is not installed: {', '.join(MISSING)}"


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    here = Path(__file__).parent
    for item in items:
        if MISSING and here in Path(item.path).parents and item.path.stem == "test_policy_training":
            item.add_marker(pytest.mark.skip(reason=NO_TRAINING))


@pytest.fixture(scope="session")
def objects(tmp_path_factory) -> Path:
    return write_objects(tmp_path_factory.mktemp("policy_objects"), LAPTOP, BUCKET, DRAWER)


@pytest.fixture
def laptop_env(objects):
    from anymesh.applications.policy.env_ import make_env

    return make_env(objects / "laptop.xml", "open")


@pytest.fixture
def bucket_env(objects):
    from anymesh.applications.policy.env_ import make_env

    return make_env(objects / "bucket.xml", "lift")
