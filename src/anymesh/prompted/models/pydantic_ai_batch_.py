"""Jobs of a provider's batch API: many questions at about half the price, answered within a day."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

from anymesh.errors import ModelError
from anymesh.prompted.models.address import Address
from anymesh.prompted.models.limits import fit
from anymesh.prompted.models.pydantic_ai_ import Client, in_thread, without_keys
from anymesh.prompted.models.pydantic_ai_wire_ import the_message, the_model, the_parameters, the_settings, the_text
from anymesh.prompted.models.vision import Request
from anymesh.runtime import CALL_SECONDS

if TYPE_CHECKING:
    from pydantic_ai.models import Model
    from pydantic_ai.models.batch import Batch, BatchRequest

T = TypeVar("T")


@dataclass(frozen=True)
class BatchAnswer:
    """One answer of a job. text: None if the provider gave none, with the reason in `note`."""

    text: str | None
    note: str = ""


def submit_batch(client: Client, requests: Mapping[str, Request]) -> list[dict[str, Any]]:
    """Send requests as jobs, each under its name; return the handles of the jobs as plain values.

    Raise ModelError if this fails or the provider has no batch API. A job that cannot be created is not sent again.
    """

    async def work(model: Model) -> list[dict[str, Any]]:
        if model.batch_max_requests is None:
            raise ModelError(f"{client.name} has no batch API; valid are openai:, openai-responses:, anthropic:, google:")
        groups: dict[str, list[Any]] = {}
        for name, request in requests.items():
            encoded = await model.batch_encode(_encoded(client.address, model, name, request))
            groups.setdefault(encoded.group, []).append(encoded)
        return [_plain(await model.batch_create(group)) for group in groups.values()]

    return _run(client, work)


def collect_batch(
    client: Client, handles: list[dict[str, Any]], requests: Mapping[str, Request]
) -> dict[str, BatchAnswer] | None:
    """Fetch the answers of jobs by the names of their requests; None while a job is unfinished. Raise ModelError on failure."""

    async def work(model: Model) -> dict[str, BatchAnswer] | None:
        from pydantic_ai.exceptions import ModelAPIError

        batches = [await model.batch_status(_batch(handle)) for handle in handles]
        if any(batch.status != "ended" for batch in batches):
            return None
        answers = {name: BatchAnswer(None, "the job holds no answer to it") for name in requests}
        for result in [r for batch in batches for r in await model.batch_results(batch) if r.custom_id in requests]:
            name = result.custom_id
            try:
                response = model.batch_decode(result, _encoded(client.address, model, name, requests[name]))
                answers[name] = BatchAnswer(without_keys(the_text(response)))
            except ModelAPIError:
                answers[name] = BatchAnswer(None, f"the provider gave no answer ({result.status})")
        return answers

    return _run(client, work)


def _encoded(address: Address, model: Model, name: str, request: Request) -> BatchRequest:
    from pydantic_ai.models.batch import BatchRequest

    whole = the_settings(address, model, request.max_tokens, CALL_SECONDS)
    settings: Any = {
        key: value for key, value in whole.items() if key in ("max_tokens", "temperature")
    }  # a job has no time-out
    return BatchRequest(
        custom_id=name,
        messages=[the_message(address, request, fit(request, address.provider), schema=True)],
        model_settings=settings,
        model_request_parameters=the_parameters(address, model, request, schema=True),
    )


def _run(client: Client, work: Callable[[Model], Coroutine[Any, Any, T]]) -> T:
    """Run the work with the provider's client; its errors, which may hold headers, do not leave the thread."""

    async def attempt() -> T | ModelError:
        import httpx2

        try:
            async with httpx2.AsyncClient(timeout=client.timeout) as http:
                return await work(the_model(client.address, http))
        except Exception as error:
            return client.failure_of(error)

    outcome = in_thread(attempt)
    if isinstance(outcome, ModelError):
        raise outcome
    return outcome


def _plain(batch: Batch) -> dict[str, Any]:
    from pydantic import TypeAdapter
    from pydantic_ai.models.batch import Batch

    return TypeAdapter(Batch).dump_python(batch, mode="json")


def _batch(handle: dict[str, Any]) -> Batch:
    from pydantic import TypeAdapter, ValidationError
    from pydantic_ai.models.batch import Batch

    try:
        return TypeAdapter(Batch).validate_python(handle)
    except ValidationError:
        raise ModelError("the note of a submitted job cannot be read; it was written by another version") from None
