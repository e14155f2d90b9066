"""Weights from a Hugging Face hub, by huggingface_hub; a commit in its cache needs no network."""

from __future__ import annotations

import importlib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from anymesh.errors import MissingExtraError, ModelError


@dataclass(frozen=True)
class Hub:
    """A Hugging Face hub. endpoint, cache: None for huggingface_hub's own (HF_ENDPOINT, HF_HOME)."""

    endpoint: str | None = None
    cache: Path | None = None

    def fetch(self, hub_id: str, commit: str, names: Iterable[str]) -> list[Path]:
        """Return local paths of files of a repository at a commit. Raise ModelError if one cannot be fetched."""
        hub = _library()
        try:
            return [
                Path(hub.hf_hub_download(hub_id, name, revision=commit, endpoint=self.endpoint, cache_dir=self.cache))
                for name in names
            ]
        except Exception as error:  # errors of the library, of HTTP and of the disk are reported alike
            raise ModelError(_error_message(hub_id, commit, error)) from None

    def names(self, hub_id: str, commit: str) -> list[str]:
        """List all file names of a repository at a commit. Raise ModelError if the hub cannot be reached."""
        hub = _library()
        try:
            return hub.HfApi(endpoint=self.endpoint).list_repo_files(hub_id, revision=commit)
        except Exception as error:
            raise ModelError(_error_message(hub_id, commit, error)) from None


def _library() -> ModuleType:
    try:  # imported by name, because type checks also run without the library
        return importlib.import_module("huggingface_hub")
    except ImportError as error:
        raise MissingExtraError(
            "huggingface_hub is not installed; install it with `pip install articulate-anymesh[sam]`; "
            "or give a folder that holds the weights: sam:FOLDER"
        ) from error


def _error_message(hub_id: str, commit: str, error: Exception) -> str:
    reason = " ".join(str(error).split())[:200]
    return f"{hub_id}@{commit}: the weights cannot be fetched ({type(error).__name__}: {reason})"
