"""Meshes by Meshy, from text (a preview, then its refinement) and from images; a 3D generator of `anymesh generate`."""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from anymesh.applications.generate.protocol import GeneratedMesh, MeshRequest, PaidTask, Step, Unit
from anymesh.errors import InputError, ModelError, OptionError
from anymesh.finishing.meshy import Bought, Order, PaidTasks
from anymesh.finishing.meshy_api import IMAGE, IMAGE_SHAPE, PREVIEW, PRICED, REFINE, RefusedError, Task, TaskKind, read_key
from anymesh.loading import load_mesh
from anymesh.runtime import Progress, write_whole
from anymesh.types import Brief

STATE = "meshy.json"
MODEL = "latest"
TEXTURED, SHAPE = "meshy", "meshy:untextured"
LONGEST_PROMPT = 800  # characters, for shape and texture prompts (meshy-cookbook, recipe 07)
LARGEST_IMAGE = 20 * 1024 * 1024  # [bytes] as in the service's own client
FACES = 100_000  # requested; the service takes 100 to 300,000, and returns about 0.3 to 1 million by default
PICTURES = {b"\x89PNG\r\n\x1a\n": "image/png", b"\xff\xd8\xff": "image/jpeg"}  # magic bytes of each file type
SIZED = {"auto_size": True, "origin_at": "bottom"}  # options of the last task
GONE = (400, 404, 410, 422)  # HTTP statuses by which the refinement of a deleted preview may be refused


@dataclass(frozen=True)
class Generated(Brief):
    """Result of a generation: a GLB, and the paid tasks that it took, including those of earlier runs."""

    glb: bytes
    tasks: tuple[tuple[TaskKind, Bought], ...]


def check_prompt(prompt: str) -> str:
    """Return the prompt without surrounding spaces. Raise OptionError if the service does not accept it."""
    text = prompt.strip()
    if not 0 < len(text) <= LONGEST_PROMPT:
        raise OptionError(f"a prompt for meshy has 1 to {LONGEST_PROMPT} characters, found {len(text)}")
    return text


def data_uri(image: Path) -> str:
    """Return an image as a data URI. Raise InputError for a file that is no PNG or JPEG, or is too large."""
    try:
        data = image.read_bytes()
    except OSError as error:
        raise InputError(f"cannot read the picture {image}: {error.strerror or error}") from None
    mime = next((mime for start, mime in PICTURES.items() if data.startswith(start)), None)
    if mime is None:
        raise InputError(f"{image.name} is neither PNG nor JPEG: it starts with {data[:8]!r}")
    if len(data) > LARGEST_IMAGE:
        raise InputError(f"{image.name} has {len(data)} bytes; meshy takes at most {LARGEST_IMAGE}")
    return f"data:{mime};base64,{base64.b64encode(data).decode('ascii')}"


@dataclass
class Meshy3D(PaidTasks):
    """Client that generates meshes. textured: whether to pay for textures too; faces: requested number.

    The service is requested to estimate the object's size (`auto_size`), so that a unit of the GLB is about a metre.
    """

    textured: bool = True
    faces: int = FACES

    def kinds(self, *, image: bool) -> tuple[TaskKind, ...]:
        """Return the kinds of tasks that a mesh takes."""
        if image:
            return (IMAGE if self.textured else IMAGE_SHAPE,)
        return (PREVIEW, REFINE) if self.textured else (PREVIEW,)

    def from_text(self, prompt: str) -> Generated:
        """Generate a mesh from its description.

        Raise ModelError without a key or a result, BudgetError before a task if those that remain would exceed the limit,
        OptionError for a prompt that is not valid, OutputError if a task's id cannot be stored.
        """
        prompt = check_prompt(prompt)
        read_key()
        first = self._preview(prompt)
        if not self.textured:
            bought = self.run(first)
            return Generated(self.fetch(first, bought.task), ((PREVIEW, bought),))
        held = first.started()
        preview = held.bought if held else None
        second = None if preview is None else self._refinement(preview)
        if second is None or second.started() is None:
            self.check_budget(*((PREVIEW,) if held is None else ()), REFINE)
        if preview is None or second is None:
            preview = self.run(first)
            second = self._refinement(preview)
        refined = self._refined(first, preview, second)
        return Generated(self.fetch(second, refined.task), ((PREVIEW, preview), (REFINE, refined)))

    def from_image(self, image: Path, prompt: str | None = None) -> Generated:
        """Generate a mesh from an image; prompt: for its textures. Raise as `from_text`, and InputError for the image."""
        body: dict[str, Any] = {"image_url": data_uri(image), "ai_model": self.model, "should_texture": self.textured}
        if self.textured:
            body["enable_pbr"] = True
            if prompt is not None:
                body["texture_prompt"] = check_prompt(prompt)
        read_key()
        [kind] = self.kinds(image=True)
        order = Order(kind, _packed({**body, **self._shape(), **SIZED}), self._state("image"))
        bought = self.run(order)
        return Generated(self.fetch(order, bought.task), ((kind, bought),))

    def _preview(self, prompt: str) -> Order:
        body = {"mode": "preview", "prompt": prompt, "ai_model": self.model, **self._shape()}
        return Order(PREVIEW, _packed(body if self.textured else {**body, **SIZED}), self._state("preview"))

    def _refinement(self, preview: Bought) -> Order:
        body = {"mode": "refine", "preview_task_id": preview.task, "enable_pbr": True, "target_formats": ["glb"], **SIZED}
        return Order(REFINE, _packed(body), self._state("refine"))

    def _refined(self, first: Order, preview: Bought, second: Order) -> Bought:
        try:
            return self.run(second)
        except RefusedError as error:
            if error.status in GONE:
                self.look(first, preview.task)  # raises and discards the preview if the service no longer has it
            raise

    def _shape(self) -> dict[str, Any]:
        return {"should_remesh": True, "topology": "triangle", "target_polycount": self.faces, "target_formats": ["glb"]}

    def _state(self, task: str) -> Path:
        return self.state.with_name(f"{self.state.stem}-{task}.json")


def _packed(body: dict[str, Any]) -> bytes:
    return json.dumps(body).encode()


@dataclass(frozen=True)
class MeshyGenerator:
    """Generator that uses Meshy.

    textured: whether to pay for textures too; max_calls: maximum number of paid tasks; timeout: of one call [s].
    """

    textured: bool = True
    max_calls: int | None = None
    timeout: float = 60.0

    def __post_init__(self) -> None:
        if self.max_calls is not None and self.max_calls < 0:
            raise OptionError(f"--max-calls must be 0 or more, found {self.max_calls}")

    @property
    def name(self) -> str:
        """Name of the generator, as in --generator."""
        return TEXTURED if self.textured else SHAPE

    @property
    def unit(self) -> Unit:
        """Meaning of a unit of the meshes; the service is requested to estimate the size."""
        return Unit.ESTIMATED

    def settings(self, request: MeshRequest) -> Mapping[str, object]:
        """Return the parameters of the request; the service takes no seed."""
        return {"name": self.name, "model": MODEL, "faces": FACES}

    def steps(self, request: MeshRequest) -> tuple[Step, ...]:
        """Return the paid tasks and the download."""
        sent = "the prompt" if request.image is None else f"the picture {request.image.name}"
        if request.prompt is not None:
            check_prompt(request.prompt)
        if request.image is not None:
            data_uri(request.image)
        kinds = self._service(Path(), None).kinds(image=request.image is not None)
        tasks = (
            Step(f"pay Meshy for {kind.name} ({kind.path}); {sent} is sent", float(kind.credits), PRICED) for kind in kinds
        )
        return (*tasks, Step("wait for it, and download the GLB"))

    def check(self) -> None:
        """Raise ModelError without a key."""
        read_key()

    def make(self, request: MeshRequest, folder: Path, progress: Progress) -> GeneratedMesh:
        """Return the GLB of the last task. Ids of tasks are stored in `folder`, so that none is paid for twice."""
        service = self._service(folder, progress)
        if request.image is not None:
            generated = service.from_image(request.image, request.prompt)
        else:
            generated = service.from_text(request.prompt or "")
        path = folder / f"{request.name}.glb"
        write_whole(path, generated.glb)
        try:
            load_mesh(path)
        except InputError as error:
            path.unlink()
            raise ModelError(f"meshy's result is not a usable mesh: {error}; a rerun downloads it again at no cost") from None
        return GeneratedMesh(path, _paid(generated), calls=service.calls)

    def _service(self, folder: Path, progress: Progress | None) -> Meshy3D:
        def watch(kind: TaskKind, task: Task) -> None:
            if progress is not None:
                progress("generate", f"{kind.name}: {task.status.lower().replace('_', ' ')} {task.progress} %", 0, 1)

        return Meshy3D(folder / STATE, MODEL, self.max_calls, self.timeout, watch=watch, textured=self.textured)


def _paid(generated: Generated) -> tuple[PaidTask, ...]:
    return tuple(PaidTask(kind.type, bought.task, bought.credits, bought.seed) for kind, bought in generated.tasks)
