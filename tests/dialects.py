"""The wire format of each provider: its replies, and where a request holds what is sent."""

import base64
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from model_wire import Seen


@dataclass(frozen=True)
class Dialect:
    """How one provider's model is named, what it says, and where in a request its parts stand."""

    name: str  # URL stands for the server's address
    key: str  # environment variable
    base: str | None  # environment variable that redirects it
    path: str
    reply: Callable[[str, str], dict[str, Any]]  # of a text and how it ended: "stop", "length" or "refused"
    model: Callable[[Seen], str]
    system: Callable[[Seen], str]
    content: Callable[[Seen], list[str | bytes]]  # words and pictures in their order
    schema: Callable[[Seen], Any]
    max_tokens: Callable[[Seen], int]
    temperature: Callable[[Seen], float | None]


def _openai(text: str, ended: str) -> dict[str, Any]:
    refused = ended == "refused"
    message = {"role": "assistant", "content": None if refused else text, "refusal": text if refused else None}
    choice = {"index": 0, "message": message, "finish_reason": "stop" if refused else ended}
    usage = {"prompt_tokens": 700, "completion_tokens": 30, "total_tokens": 730}
    return {"id": "c1", "object": "chat.completion", "created": 1, "model": "m", "choices": [choice], "usage": usage}


def _responses(text: str, ended: str) -> dict[str, Any]:
    said = (
        {"type": "refusal", "refusal": text} if ended == "refused" else {"type": "output_text", "text": text, "annotations": []}
    )
    message = {"type": "message", "id": "m1", "role": "assistant", "status": "completed", "content": [said]}
    details = {"input_tokens_details": {"cached_tokens": 0}, "output_tokens_details": {"reasoning_tokens": 0}}
    return {
        "id": "r1", "object": "response", "created_at": 1, "model": "m", "output": [message], "parallel_tool_calls": True,
        "status": "incomplete" if ended == "length" else "completed", "tool_choice": "auto", "tools": [],
        "incomplete_details": {"reason": "max_output_tokens"} if ended == "length" else None,
        "usage": {"input_tokens": 700, "output_tokens": 30, "total_tokens": 730, **details},
    }  # fmt: skip


def _anthropic(text: str, ended: str) -> dict[str, Any]:
    stop = {"stop": "end_turn", "length": "max_tokens", "refused": "refusal"}[ended]
    content = [{"type": "text", "text": text}] if text else []
    usage = {"input_tokens": 700, "output_tokens": 30}
    head = {"id": "m1", "type": "message", "role": "assistant", "model": "m"}
    return {**head, "content": content, "stop_reason": stop, "stop_sequence": None, "usage": usage}


def _google(text: str, ended: str) -> dict[str, Any]:
    usage = {"promptTokenCount": 700, "candidatesTokenCount": 20, "thoughtsTokenCount": 10, "totalTokenCount": 730}
    if ended == "refused":
        return {"promptFeedback": {"blockReason": "SAFETY"}, "usageMetadata": usage, "modelVersion": "m"}
    parts = [{"text": text}] if text else []
    reason = {"stop": "STOP", "length": "MAX_TOKENS"}[ended]
    candidate = {"content": {"role": "model", "parts": parts}, "finishReason": reason, "index": 0}
    return {"candidates": [candidate], "usageMetadata": usage, "modelVersion": "m"}


def _openai_content(seen: Seen) -> list[str | bytes]:
    [user] = [message for message in seen.body["messages"] if message["role"] == "user"]
    return [p["text"] if p["type"] == "text" else _data(p["image_url"]["url"]) for p in user["content"]]


def _responses_content(seen: Seen) -> list[str | bytes]:
    [user] = [item for item in seen.body["input"] if item["role"] == "user"]
    return [p["text"] if p["type"] == "input_text" else _data(p["image_url"]) for p in user["content"]]


def _data(url: str) -> bytes:
    head, _, data = url.partition(",")
    assert head == "data:image/png;base64"
    return base64.b64decode(data, validate=True)


def _anthropic_content(seen: Seen) -> list[str | bytes]:
    [user] = seen.body["messages"]
    return [p["text"] if p["type"] == "text" else base64.b64decode(p["source"]["data"]) for p in user["content"]]


def _google_content(seen: Seen) -> list[str | bytes]:
    [user] = seen.body["contents"]
    return [p["text"] if "text" in p else base64.urlsafe_b64decode(p["inlineData"]["data"]) for p in user["parts"]]


def _openai_like(name: str, key: str, base: str | None, most: str) -> Dialect:
    return Dialect(
        name,
        key,
        base,
        "/v1/chat/completions",
        _openai,
        lambda seen: seen.body["model"],
        lambda seen: seen.body["messages"][0]["content"],
        _openai_content,
        lambda seen: seen.body["response_format"]["json_schema"]["schema"],
        lambda seen: seen.body[most],
        lambda seen: seen.body.get("temperature"),
    )


OPENAI = _openai_like("openai:gpt-4o", "OPENAI_API_KEY", "OPENAI_BASE_URL", "max_completion_tokens")
RESPONSES = Dialect(
    "openai-responses:gpt-4o",
    "OPENAI_API_KEY",
    "OPENAI_BASE_URL",
    "/v1/responses",
    _responses,
    lambda seen: seen.body["model"],
    lambda seen: seen.body["instructions"],
    _responses_content,
    lambda seen: seen.body["text"]["format"]["schema"],
    lambda seen: seen.body["max_output_tokens"],
    lambda seen: seen.body.get("temperature"),
)
COMPATIBLE = _openai_like("openai-compatible:URL/v1#qwen2.5-vl", "ANYMESH_API_KEY", None, "max_tokens")
ANTHROPIC = Dialect(
    "anthropic:claude-sonnet-4-5",
    "ANTHROPIC_API_KEY",
    "ANTHROPIC_BASE_URL",
    "/v1/messages",
    _anthropic,
    lambda seen: seen.body["model"],
    lambda seen: seen.body["system"][0]["text"],
    _anthropic_content,
    lambda seen: seen.body["output_config"]["format"]["schema"],
    lambda seen: seen.body["max_tokens"],
    lambda seen: seen.body.get("temperature"),
)
GOOGLE = Dialect(
    "google:gemini-2.5-flash",
    "GOOGLE_API_KEY",
    "GOOGLE_GEMINI_BASE_URL",
    "/v1beta/models/gemini-2.5-flash:generateContent",
    _google,
    lambda seen: seen.path.split("/")[-1].partition(":")[0],
    lambda seen: seen.body["systemInstruction"]["parts"][0]["text"],
    _google_content,
    lambda seen: {k: v for k, v in seen.body["generationConfig"]["responseJsonSchema"].items() if k != "title"},
    lambda seen: seen.body["generationConfig"]["maxOutputTokens"],
    lambda seen: seen.body["generationConfig"].get("temperature"),
)
DIALECTS = {
    "openai": OPENAI,
    "openai-responses": RESPONSES,
    "anthropic": ANTHROPIC,
    "google": GOOGLE,
    "openai-compatible": COMPATIBLE,
}
