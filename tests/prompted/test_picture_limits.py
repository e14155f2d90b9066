"""Test the limits of a provider on pictures and requests."""

import io
import logging

import numpy as np
import pytest
from dialects import ANTHROPIC, Dialect
from model_wire import ANSWER, Connect, Service, a_request, png
from PIL import Image

from anymesh.errors import ModelError
from anymesh.prompted.models.pydantic_ai_wire_ import LIMITS, RequestLimits, fit
from anymesh.types import Picture


def test_a_large_picture_is_made_smaller(
    dialect: Dialect, service: Service, connected: Connect, caplog: pytest.LogCaptureFixture
) -> None:
    service.says(dialect.reply(ANSWER, "stop"))
    with caplog.at_level(logging.INFO, "anymesh"):
        connected(dialect).ask(a_request(pictures=(Picture(png(4000, 1000), "wide"),)))
    assert "4000x1000 px is sent as" in caplog.text
    sent = dialect.content(service.seen[0])[1]
    assert isinstance(sent, bytes)
    width, height = Picture(sent).size
    assert width in (2000, 2048, 3072)
    assert height == width // 4


def test_too_many_pictures_are_not_sent(dialect: Dialect, service: Service, connected: Connect) -> None:
    with pytest.raises(ModelError, match=r"901 pictures in one request, .* takes at most"):
        connected(dialect).ask(a_request(pictures=(Picture(png()),) * 901))
    assert not service.seen


def test_a_picture_of_too_many_bytes_is_made_smaller(service: Service, connected: Connect) -> None:
    noise = np.random.default_rng(0).integers(0, 256, (1400, 1400, 3), dtype=np.uint8)  # packs to 5.9 MB
    buffer = io.BytesIO()
    Image.fromarray(noise).save(buffer, "PNG", compress_level=1)
    service.says(ANTHROPIC.reply(ANSWER, "stop"))
    connected(ANTHROPIC).ask(a_request(pictures=(Picture(buffer.getvalue(), "noise"),)))
    sent = ANTHROPIC.content(service.seen[0])[1]
    assert isinstance(sent, bytes)
    assert 0.3 * 5e6 < len(sent) * 4 / 3 <= 5e6


def test_a_picture_that_packs_worse_when_smaller_is_made_smaller_still(monkeypatch: pytest.MonkeyPatch) -> None:
    bits = np.random.default_rng(0).integers(0, 2, (300, 300)).astype(bool)  # one bit a pixel, greys once it is shrunk
    buffer = io.BytesIO()
    Image.fromarray(bits).save(buffer, "PNG")
    monkeypatch.setitem(LIMITS, "anthropic", RequestLimits(picture=10_000, side=2000, pictures=9, request=10**6))
    [small] = fit(a_request(pictures=(Picture(buffer.getvalue(), "bits"),)), "anthropic")
    assert len(small.png) * 4 / 3 <= 10_000
    assert small.size[0] == small.size[1] > 20
    assert small.caption == "bits"


def test_a_request_of_too_many_bytes_is_not_sent(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(LIMITS, "google", RequestLimits(picture=10**6, side=3000, pictures=9, request=10_000))
    with pytest.raises(ModelError, match=r"hinge: a request of 0\.\d MB, google takes"):
        fit(a_request(text="x" * 100_000), "google")
