"""Meshy as a 3D generator: text to 3D (preview, refinement) and image to 3D."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from anymesh.applications.generate.meshy_generate import FACES, Generated, Meshy3D, check_prompt, data_uri
from anymesh.applications.generate.protocol import GeneratedMesh, MeshRequest, PaidTask, Step, Unit
from anymesh.errors import InputError, ModelError, OptionError
from anymesh.finishing.meshy_api import PRICED, Task, TaskKind, read_key
from anymesh.loading import load_mesh
from anymesh.runtime import Progress, write_whole

STATE = "meshy.json"
MODEL = "latest"
TEXTURED, SHAPE = "meshy", "meshy:untextured"


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
