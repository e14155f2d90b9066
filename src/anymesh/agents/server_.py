"""The tools as a server of the Model Context Protocol, over stdio or streamable HTTP."""

from __future__ import annotations

import json
import re
import threading
from collections.abc import Callable, Sequence
from functools import partial
from typing import Annotated, Any, Literal

import anyio
from anyio import from_thread, to_thread
from mcp.server.mcpserver import Context, Image, MCPServer
from mcp.server.mcpserver.exceptions import ToolError
from mcp.server.mcpserver.tools import Tool
from pydantic import ConfigDict, Field

from anymesh import __version__
from anymesh.agents.tools import AgentTools, Places, ToolResult, skill_text
from anymesh.correcting.operations import operations_text
from anymesh.errors import AnymeshError

Content = list[str | Image]
MeshPath = Annotated[str, Field(description="Mesh file: GLB, glTF, OBJ, PLY, STL, OFF or DAE.")]
AssetPath = Annotated[str, Field(description="Folder of an asset that articulate wrote.")]
OutPath = Annotated[str, Field(description="Folder to write the asset to; open questions lie in OUT.questions beside it.")]
Formats = Annotated[str, Field(description="Of urdf, mjcf, usd, sdf, glb, with commas between.")]
Precision = Annotated[
    float,
    Field(description="Write only joints that are right with this probability, such as 0.9; others are proposals.", ge=0, le=1),
]
OPTION = re.compile(r"(?<!\S)--(parts|category|up|scale|mass|precision|at-least|formats|force|time-limit) ")
ANSWERS = (
    "Answers to open questions, recorded first, all or none: objects with `question` (its folder; not needed for the only open "
    "question) and `answer` (an object by the schema, or 'geometry' to leave it to geometry)."
)
CORRECTIONS = (
    "Each is an object with `part` (a part or joint) and operations, as of `anymesh correct`, such as "
    '{"part": "door_1", "motion": 3, "limits": "0,110", "copies": true}; operations, in the order in which they apply:\n'
    f"{operations_text()}\n"
    "Or a motion as `inspect` lists it with motions_of ({correction: choose_motion, ...})."
)


class ToolRunner:
    """Runner of the tools in threads, one at a time, with progress reports."""

    def __init__(self, tools: AgentTools) -> None:
        self.tools, self._lock = tools, threading.Lock()

    async def run(
        self, ctx: Context, tool: Callable[..., ToolResult], *arguments: Any, long: bool = False, **options: Any
    ) -> Content:
        """Run a tool. Raise ToolError for every error of this package."""
        count = 0

        def report_progress(stage: str, item: str, done: int, total: int) -> None:
            nonlocal count
            count += 1
            from_thread.run(partial(ctx.report_progress, count, None, f"{stage} {item} ({done + 1}/{total})"))

        def work() -> ToolResult:
            with self._lock:
                return tool(*arguments, **options, **({"progress": report_progress} if long else {}))

        try:
            shown = await to_thread.run_sync(work)
        except AnymeshError as error:
            raise ToolError(_as_arguments(str(error))) from None
        except Exception as error:
            raise ToolError(f"{type(error).__name__}: {error}; nothing was written. Please report it") from error
        content: Content = [_as_arguments(json.dumps(shown.record, indent=1))]
        for caption, png in shown.pictures:
            content += [caption, Image(data=png, format="png")]
        return content


def _as_arguments(text: str) -> str:
    """Return a text with options of the command line as arguments of tools, where there are such."""
    return OPTION.sub(lambda option: f"{option[1].replace('-', '_')} ", text)


def make_server(folders: Sequence[str]) -> MCPServer[Any]:
    """Create the server. Raise InputError for a folder that does not exist."""
    work = ToolRunner(AgentTools(Places(folders)))
    tools = [Tool.from_function(tool, structured_output=False) for tool in (*_making(work), *_looking(work))]
    for tool in tools:  # reject unknown arguments instead of ignoring them
        model = tool.fn_metadata.arg_model
        model.model_config = ConfigDict(**{**model.model_config, "extra": "forbid"})
        model.model_rebuild(force=True)
        tool.parameters["additionalProperties"] = False
    return MCPServer("anymesh", version=__version__, instructions=skill_text(), log_level="WARNING", tools=tools)


def _making(work: ToolRunner) -> tuple[Callable[..., Any], ...]:
    async def articulate(
        ctx: Context,
        mesh: MeshPath,
        out: OutPath,
        answerer: Annotated[
            Literal["files", "geometry"],
            Field(description="files: you answer from pictures; geometry: no questions."),
        ] = "files",
        parts: Annotated[str, Field(description="auto, nodes (the scene's), or a file of face labels.")] = "auto",
        category: Annotated[str | None, Field(description="What the object is, where that is known.")] = None,
        up: Annotated[
            str,
            Field(
                description="What points up in the file: auto, infer, x, y, z, -x, -y, -z, or a direction such as 0,0.7,0.7."
            ),
        ] = "auto",
        scale: Annotated[str, Field(description="auto, a factor to metres, or METRES:AXIS such as 0.9:z.")] = "auto",
        mass: Annotated[float | None, Field(description="Mass of the whole object in kg; by its materials if none.")] = None,
        precision: Precision | None = None,
        at_least: Annotated[
            int, Field(description="With geometry: least number of parts, however weak the evidence; 1 if it is known to move.")
        ] = 0,
        formats: Formats | None = None,
        force: Annotated[bool, Field(description="Replace an existing output.")] = False,
        time_limit: Annotated[
            float,
            Field(
                description="Seconds of work, without the time of answers; near it, work is left out.",
                gt=0,
            ),
        ] = 600.0,
        answers: Annotated[list[dict[str, Any]] | None, Field(description=ANSWERS)] = None,
    ) -> Content:
        """Turn a rigid mesh into an articulated asset. Stops at each open question: call again as before, with its answer."""
        return await work.run(
            ctx, work.tools.articulate, mesh, out, answerer=answerer, parts=parts, category=category, up=up, scale=scale,
            mass=mass, precision=precision, at_least=at_least, formats=formats, force=force, time_limit=time_limit,
            answers=answers or (), long=True,
        )  # fmt: skip

    async def answer(
        ctx: Context,
        question: Annotated[str, Field(description="The question's folder, as articulate or open_questions gave it.")],
        answer: Annotated[
            dict[str, Any] | str, Field(description="An object by the schema, or 'geometry' to leave it to geometry.")
        ],
    ) -> Content:
        """Answer an open question; an answer that is not valid is refused with the reason."""
        return await work.run(ctx, work.tools.answer, question, answer)

    async def correct(
        ctx: Context, asset: AssetPath, corrections: Annotated[list[dict[str, Any]], Field(description=CORRECTIONS)]
    ) -> Content:
        """Correct parts and joints of an asset, all or none, and write it again."""
        return await work.run(ctx, work.tools.correct, asset, corrections)

    async def export(
        ctx: Context,
        asset: AssetPath,
        formats: Formats | None = None,
        base: Annotated[
            Literal["fixed", "free"] | None, Field(description="The root link: fixed to the world, or free.")
        ] = None,
        drives: Annotated[Literal["passive", "position"] | None, Field(description="Whether drives lead the joints.")] = None,
        package: Annotated[str | None, Field(description="Folder for a ROS 2 package of the URDF.")] = None,
        archive: Annotated[str | None, Field(description="Zip file of the asset.")] = None,
        precision: Precision | None = None,
        sample: Annotated[int, Field(description="Number of variants whose parts move otherwise, by weight.")] = 0,
        seed: Annotated[int, Field(description="Seed of the variants.")] = 0,
    ) -> Content:
        """Write the files of an asset anew, where what is not given stays as it was, as a package or as a zip."""
        return await work.run(
            ctx, work.tools.export, asset, formats=formats, base=base, drives=drives, package=package, archive=archive,
            precision=precision, sample=(sample, seed), long=True,
        )  # fmt: skip

    return articulate, answer, correct, export


def _looking(work: ToolRunner) -> tuple[Callable[..., Any], ...]:
    async def open_questions(
        ctx: Context,
        folder: Annotated[str | None, Field(description="Where to look; everywhere when not given.")] = None,
        pictures: Annotated[Literal["auto", "all", "none"], Field(description="all: each at full size.")] = "auto",
    ) -> Content:
        """List the open questions; the first comes with its text, schema and pictures."""
        return await work.run(ctx, work.tools.open_questions, folder, pictures=pictures)

    async def inspect(
        ctx: Context,
        asset: AssetPath,
        motions_of: Annotated[str | None, Field(description="A part whose free motions are listed, likeliest first.")] = None,
        regions_of: Annotated[str | None, Field(description="A part whose regions are listed, which may be new parts.")] = None,
    ) -> Content:
        """Show parts, joints, confidence and warnings of an asset, and its preview picture."""
        return await work.run(ctx, work.tools.inspect, asset, motions_of=motions_of, regions_of=regions_of)

    async def check(
        ctx: Context,
        asset: AssetPath,
        engines: Annotated[list[str] | None, Field(description="Where each joint is driven; mujoco when not given.")] = None,
    ) -> Content:
        """Check that an asset holds what a simulator needs, and drive every joint."""
        return await work.run(ctx, work.tools.check, asset, engines or ["mujoco"])

    return open_questions, inspect, check


def serve_stdio(folders: Sequence[str]) -> None:
    """Serve until the client closes the connection."""
    anyio.run(make_server(folders).run_stdio_async)


def serve_http(folders: Sequence[str], host: str, port: int) -> None:
    """Serve `http://HOST:PORT/mcp` until interrupted; Host and Origin of requests must be this machine's."""
    anyio.run(partial(make_server(folders).run_streamable_http_async, host=host, port=port))
