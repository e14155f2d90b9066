"""Conversion of requests to pydantic-ai, and of its responses to text."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from anymesh.prompted.models.address import Address
from anymesh.prompted.models.vision import Request
from anymesh.types.exchange import Picture

if TYPE_CHECKING:
    from httpx2 import AsyncClient
    from pydantic_ai.messages import ModelRequest, ModelResponse, UserContent
    from pydantic_ai.models import Model, ModelRequestParameters
    from pydantic_ai.settings import ModelSettings

IN_WORDS = "{system}\n\nAnswer with one JSON object alone, no other words, that satisfies this JSON schema:\n{schema}"


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
