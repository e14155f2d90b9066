"""Build the export model of an asset: links with mass and collision, ready for every format."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import Int

from anymesh.export.links import Link, split_links, with_legal_names
from anymesh.export.model import Base, Driven, Exclusion, ExportLink, Model
from anymesh.export.settings import ExportConfig
from anymesh.geometry.surface import plain_triangles
from anymesh.physics.collision import Collision, collision_shapes
from anymesh.physics.inertia import Substance, link_inertia, substance_of
from anymesh.runtime import Deadline
from anymesh.types import Asset, Mesh

OVERLAP = "their surfaces overlap at rest"
TIGHT = "their collision shapes touch where the surfaces do not"


@dataclass(frozen=True, eq=False)
class Built:
    """A model, and the collision result of its shapes."""

    model: Model
    collision: Collision


def build_model(
    asset: Asset, *, base: Base, driven: Driven, config: ExportConfig, cache: Path | None, deadline: Deadline | None = None
) -> Built:
    """Build the model of an asset, with legal names and the warnings of its collision shapes.

    cache: folder of decompositions, None for none.
    """
    asset = with_legal_names(asset)
    links = split_links(asset)
    plain = {link.name: plain_triangles(link.triangles, asset.mesh.diagonal) for link in links}
    triangles = {name: surface for name, (surface, _) in plain.items()}
    origins = {link.name: link.origin for link in links}
    collision = collision_shapes(asset, triangles, origins, config.collision, cache, deadline=deadline)
    asset = replace(asset, warnings=tuple(dict.fromkeys((*asset.warnings, *collision.warnings))))
    bodies = tuple(
        ExportLink(
            link,
            link_inertia(triangles[link.name], config, _made_of(asset.mesh, link, plain[link.name][1])),
            collision.shapes[link.name],
        )
        for link in links
    )
    excluded = [Exclusion(a, b, OVERLAP) for a, b in collision.overlapping]
    excluded += [Exclusion(a, b, TIGHT) for a, b in collision.tight]
    return Built(Model(asset, bodies, base, tuple(excluded), driven), collision)


def _made_of(mesh: Mesh, link: Link, kept: Int[np.ndarray, " K"]) -> list[Substance | None]:
    """Return the substance of some triangles of a link, by the names of their materials."""
    named = {p.material: None if p.material < 0 else substance_of(mesh.materials[p.material].name) for p in link.primitives}
    all_ = [named[p.material] for p in link.primitives for _ in range(len(p.triangles))]
    return [all_[k] for k in kept]
