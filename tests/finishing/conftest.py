"""Fixtures of the tests of Meshy: retexturing tasks and generation tasks."""

from meshy_generation import generator, model_server  # noqa: F401, pytest finds fixtures here
from meshy_tasks import meshy, server, waits  # noqa: F401
