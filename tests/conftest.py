"""Being here puts this folder on the path, so that every test can import `assets` and `contract`."""

import gc

import pytest
import type_checks
from hypothesis import HealthCheck, settings
from loopback import guard

type_checks.install()
gc.disable()  # until the tests are imported, which leaves no garbage

settings.register_profile("repeatable", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("repeatable")  # the same examples each time, however slow the machine


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Start with the longest file, so that no worker is left alone with it at the end."""
    items.sort(key=lambda item: item.path.name != "test_fuzz.py")


def pytest_collection_finish() -> None:
    """Evaluate annotations before a test replaces names, and exclude what is imported from searches for cycles."""
    type_checks.evaluate()
    gc.freeze()
    gc.enable()


@pytest.fixture
def loopback_only(monkeypatch: pytest.MonkeyPatch) -> None:
    guard(monkeypatch)
