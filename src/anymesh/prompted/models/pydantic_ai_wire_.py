"""Conversion of requests to pydantic-ai, with pictures that fit the service's limits, and of its responses to text."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from anymesh.prompted.models.servers import Address
from anymesh.prompted.models.vision import Request
from anymesh.types.exchange import Picture

if TYPE_CHECKING:
    from httpx2 import AsyncClient
    from pydantic_ai.messages import ModelRequest, ModelResponse, UserContent
    from pydantic_ai.models import Model, ModelRequestParameters
    from pydantic_ai.settings import ModelSettings
import base64
import io
import logging
from dataclasses import dataclass

from PIL import Image

from anymesh.errors import ModelError

IN_WORDS = "{system}\n\nAnswer with one JSON object alone, no other words, that satisfies this JSON schema:\n{schema}"
MEGABYTE = 1_000_000


def the_model(address: Address, http: AsyncClient) -> Model:
    base, key = address.url(), address.key()
    match address.provider:
        case "openai-responses":
            from pydantic_ai.models.openai import OpenAIResponsesModel
            from pydantic_ai.providers.openai import OpenAIProvider

            return OpenAIResponsesModel(address.model, provider=OpenAIProvider(base_url=base, api_key=key, http_client=http))
        case "openai":
            from pydantic_ai.models.openai import OpenAIChatModel
            from pydantic_ai.providers.openai import OpenAIProvider

            return OpenAIChatModel(address.model, provider=OpenAIProvider(base_url=base, api_key=key, http_client=http))
        case "anthropic":
            from pydantic_ai.models.anthropic import AnthropicModel
            from pydantic_ai.providers.anthropic import AnthropicProvider

            return AnthropicModel(address.model, provider=AnthropicProvider(base_url=base, api_key=key, http_client=http))
        case "google":
            from pydantic_ai.models.google import GoogleModel
            from pydantic_ai.providers.google import GoogleProvider

            return GoogleModel(address.model, provider=GoogleProvider(base_url=base, api_key=key, http_client=http))
        case _:
            return _compatible(address.model, base or "", key, http)


def _compatible(model: str, base: str, key: str, http: AsyncClient) -> Model:
    from pydantic_ai.models.openai import OpenAIChatModel
    from pydantic_ai.profiles.openai import OpenAIModelProfile
    from pydantic_ai.providers.openai_compatible import OpenAICompatibleProvider

    profile = OpenAIModelProfile(
        supports_json_schema_output=True,
        # Azure accepts only the new name of the limit, many small servers only the old one.
        openai_chat_supports_max_completion_tokens=(urlsplit(base).hostname or "").endswith(".azure.com"),
    )
    provider = OpenAICompatibleProvider("openai-compatible", base_url=base, api_key=key, http_client=http, profile=profile)
    # The client has read OpenAI's account from the environment, and each copy, such as one with other retries, reads it again.
    provider.client.organization = provider.client.project = None
    provider.client.max_retries = 0
    return OpenAIChatModel(model, provider=provider)


def the_message(address: Address, request: Request, pictures: tuple[Picture, ...], *, schema: bool) -> ModelRequest:
    from pydantic_ai.messages import BinaryContent, ModelRequest, UserPromptPart

    # OpenAI may use a thumbnail unless the detail is set. Google's client refuses the setting.
    detail = {"detail": "high"} if address.provider.startswith("openai") else None
    content: list[UserContent] = []
    for picture in pictures:
        content += [picture.caption] if picture.caption else []
        content.append(BinaryContent(picture.png, media_type="image/png", vendor_metadata=detail))
    content.append(request.text)
    system = request.system if schema else IN_WORDS.format(system=request.system, schema=json.dumps(request.schema))
    return ModelRequest(parts=[UserPromptPart(content)], instructions=system or None)


def the_settings(address: Address, model: Model, max_tokens: int, timeout: float) -> ModelSettings:
    from pydantic_ai.settings import ModelSettings

    settings = ModelSettings(max_tokens=max_tokens, timeout=timeout, request_timeout=timeout)
    if address.provider != "openai-compatible":
        settings["max_retries"] = 0
    if _takes_temperature(address, model):
        settings["temperature"] = 0.0
    return settings


def _takes_temperature(address: Address, model: Model) -> bool:
    """Return whether the model accepts a temperature.

    Reasoning models of OpenAI and the latest of Anthropic refuse one; Google advises against it from Gemini 3 on.
    """
    profile: Any = model.profile
    match address.provider:
        case "anthropic":
            return not profile.get("anthropic_disallows_sampling_settings", False)
        case "google":
            return re.match(r"gemini-(1|2)\b", address.model) is not None
        case _:
            return not (profile.get("thinking_enabled_by_default", False) or profile.get("thinking_always_enabled", False))


def the_parameters(address: Address, model: Model, request: Request, *, schema: bool) -> ModelRequestParameters:
    """Request the schema by the provider's native output where supported, else by a single tool that the model must call."""
    from pydantic_ai.models import ModelRequestParameters
    from pydantic_ai.output import OutputObjectDefinition
    from pydantic_ai.tools import ToolDefinition

    if not schema:
        return ModelRequestParameters()
    asked = dict(request.schema)
    if model.profile.get("supports_json_schema_output", False):
        strict = False if address.provider == "openai-compatible" else None
        return ModelRequestParameters(
            output_mode="native", output_object=OutputObjectDefinition(asked, name="answer", strict=strict)
        )
    tool = ToolDefinition(name="answer", parameters_json_schema=asked, description="Gives the answer.", kind="output")
    return ModelRequestParameters(output_mode="tool", output_tools=[tool], allow_text_output=False)


def the_text(response: ModelResponse) -> str:
    """Return the answer's text or the tool call's arguments; the refusal's words if there is nothing else."""
    from pydantic_ai.messages import TextPart, ToolCallPart

    calls = [part.args_as_json_str() for part in response.parts if isinstance(part, ToolCallPart)]
    texts = [part.content for part in response.parts if isinstance(part, TextPart)]
    refusal = (response.provider_details or {}).get("refusal")
    return calls[0] if calls else "".join(texts) or (refusal if isinstance(refusal, str) else "")


def unfenced(text: str) -> str:
    """Remove the code fence that models often put around JSON when asked for it in words."""
    match = re.fullmatch(r"\s*```(?:json)?\s*\n(.*?)\n?\s*```\s*", text, re.DOTALL)
    return match[1] if match else text


log = logging.getLogger("anymesh")


@dataclass(frozen=True)
class RequestLimits:
    """picture [bytes], side [px], pictures [count], request [bytes, with pictures in base64]."""

    picture: int
    side: int
    pictures: int
    request: int


# Checked on 2026-11-21 against the services' pages on image input. If the models of a service differ, the row holds the lowest
# limit. If a service downscales pictures itself, the row holds the resulting side, since larger pictures only cost traffic.
LIMITS = {
    "openai": RequestLimits(20 * MEGABYTE, 2048, 500, 50 * MEGABYTE),
    "openai-responses": RequestLimits(20 * MEGABYTE, 2048, 500, 50 * MEGABYTE),
    "anthropic": RequestLimits(5 * MEGABYTE, 2000, 100, 32 * MEGABYTE),  # 8000 px, but 2000 px from 21 pictures on
    "google": RequestLimits(7 * MEGABYTE, 3072, 900, 20 * MEGABYTE),
    # an assumption: every server has its own limits
    "openai-compatible": RequestLimits(20 * MEGABYTE, 2048, 100, 50 * MEGABYTE),
}


def fit(request: Request, provider: str) -> tuple[Picture, ...]:
    """Return the request's pictures, downscaled where needed. Raise ModelError if they are too many or too large in total."""
    limits = LIMITS[provider]
    if len(request.pictures) > limits.pictures:
        raise ModelError(
            f"{request.kind}: {len(request.pictures)} pictures in one request, {provider} takes at most {limits.pictures}"
        )
    pictures = tuple(_shrunk(picture, limits) for picture in request.pictures)
    words = len(request.system) + len(request.text) + sum(len(p.caption) for p in pictures)
    size = 4 * words + sum(4 * (len(p.png) + 2) // 3 for p in pictures)  # a character may take four bytes
    if size > limits.request:
        raise ModelError(
            f"{request.kind}: a request of {size / MEGABYTE:.1f} MB, {provider} takes {limits.request / MEGABYTE:.0f} MB"
        )
    return pictures


def _shrunk(picture: Picture, limits: RequestLimits) -> Picture:
    width, height = picture.size
    # Sizes are compared in base64: services differ in what they count, and this is the stricter choice.
    scale = min(1.0, limits.side / max(width, height), (limits.picture / _encoded(picture.png)) ** 0.5)
    small = picture
    while scale < 1:
        small = _resized(picture, max(1, int(width * scale)), max(1, int(height * scale)))
        if _encoded(small.png) <= limits.picture:
            log.info("a picture of %dx%d px is sent as %dx%d px", width, height, *small.size)
            break
        scale *= 0.8  # the size of a PNG is only known after compression
    return small


def _resized(picture: Picture, width: int, height: int) -> Picture:
    buffer = io.BytesIO()
    with Image.open(io.BytesIO(picture.png)) as image:
        colours = image if image.mode in ("L", "RGB", "RGBA") else image.convert("RGBA")
        colours.resize((width, height), Image.Resampling.LANCZOS).save(buffer, "PNG", optimize=True)
    return Picture(buffer.getvalue(), picture.caption)


def _encoded(png: bytes) -> int:
    return len(base64.b64encode(png))
