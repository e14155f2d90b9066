"""Previews take most of the time of an export: they are left out here."""

import pytest


@pytest.fixture(autouse=True)
def _no_preview(monkeypatch):
    for user in ("anymesh.correcting.history", "anymesh.pipeline.stages"):
        monkeypatch.setattr(f"{user}.write_preview", lambda asset, path: path.write_bytes(b"preview"))
