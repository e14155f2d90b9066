"""One stage divided into layers by what they say: hierarchy, geometry, materials, physics, and physics of one engine only.

<name>.usda               what others refer to: metadata, a payload, and a variant set for each engine, at first disabled
payloads/base.usda        links and their frames; its sublayers are physics.usda and geometries.usdc
payloads/instances.usda   one shared instance per link: its geometry with its materials
runnables/physics/        attributes of PhysX, Newton and MuJoCo
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from anymesh.names import legal_names

ENGINES = {"physx": "PhysX", "newton": "Newton", "mujoco": "MuJoCo"}  # file -> name of the variant set
PREFIXES = {"physx": "physx", "newton": "newton", "mjc": "mujoco", "physics": "physics", "drive": "physics"}
SUFFIXES = {"geometries": "usdc"}
PAYLOADS, RUNNABLES, TEXTURES = "payloads", "runnables/physics", "textures"


def layer_of(name: str, home: str) -> str:
    """Return the layer of a schema or a property by its name, else `home`."""
    lower = name.lower().removeprefix("material:binding:")
    return next((layer for prefix, layer in PREFIXES.items() if lower.startswith(prefix)), home)


@dataclass
class LayeredAsset:
    """The layers of an asset, written as files below `folder`. flat: the layer of a stage as `writer_` makes it."""

    pxr: Any
    flat: Any
    name: str
    folder: Path
    layers: dict[str, Any] = field(default_factory=dict)

    def write(self, links: Mapping[str, str], interface: Mapping[str, Any]) -> Path:
        """Write all layers. links: visual mesh of each link; interface: metadata of the file that others refer to.

        Return the path of that file.
        """
        for name in ("base", "physics", "geometries", "instances", "materials", *ENGINES):
            self.layers[name] = self._new(f"{RUNNABLES if name in ENGINES else PAYLOADS}/{name}.{SUFFIXES.get(name, 'usda')}")
        skipped = [f"/{self.name}/links/{link}/{mesh}" for link, mesh in links.items()]
        for path in self._prims():
            if not any(str(path) == s or str(path).startswith(f"{s}/") for s in skipped) and not self._is_look(path):
                self._divide(path)
        self.pxr.Sdf.CopySpec(self.flat, f"/{self.name}/materials", self.layers["materials"], "/materials")
        self.layers["materials"].defaultPrim = "materials"
        shared = legal_names([self.name, "visuals"])[-1]
        for link, mesh in links.items():
            self._add_instance(link, mesh, shared)
        self.layers["base"].subLayerPaths[:] = ["./physics.usda", "./geometries.usdc"]
        for name in ("base", *ENGINES):
            self.pxr.Sdf.CreatePrimInLayer(self.layers[name], f"/{self.name}")  # also where an engine has nothing of its own
            self.layers[name].defaultPrim = self.name
        top = self._add_interface(interface)
        for layer in (top, *self.layers.values()):
            layer.Save()
        return self.folder / f"{self.name}.usda"

    def _new(self, path: str) -> Any:
        file = self.folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        layer = self.pxr.Sdf.Layer.CreateNew(str(file))
        for key in ("upAxis", "metersPerUnit", "kilogramsPerUnit"):
            layer.pseudoRoot.SetInfo(key, self.flat.pseudoRoot.GetInfo(key))
        return layer

    def _prims(self) -> Iterator[Any]:
        """Yield the paths of the prims of the asset, parents first."""
        waiting = [self.flat.GetPrimAtPath(f"/{self.name}")]
        while waiting:
            spec = waiting.pop()
            yield spec.path
            waiting += reversed(list(spec.nameChildren))

    def _is_look(self, path: Any) -> bool:
        """Return whether a prim is part of a visual material, or their scope."""
        if not str(path).startswith(f"/{self.name}/materials"):
            return False
        material = next((p for p in path.GetPrefixes() if p.pathElementCount == 3), None)
        return material is None or "PhysicsMaterialAPI" not in self._schemas(self.flat.GetPrimAtPath(material))

    @staticmethod
    def _schemas(spec: Any) -> list[str]:
        return list(spec.GetInfo("apiSchemas").GetAddedOrExplicitItems()) if spec.HasInfo("apiSchemas") else []

    def _divide(self, path: Any) -> None:
        """Copy one prim without its children: each schema and property into the layer of its kind."""
        spec, sdf = self.flat.GetPrimAtPath(path), self.pxr.Sdf
        schemas = self._schemas(spec)
        home = "geometries" if "PhysicsCollisionAPI" in schemas else layer_of(spec.typeName, "base")
        home = "physics" if "PhysicsMaterialAPI" in schemas else home
        own = sdf.CreatePrimInLayer(self.layers[home], path)
        own.specifier, own.typeName = spec.specifier, spec.typeName
        if spec.HasInfo("kind"):
            own.SetInfo("kind", spec.GetInfo("kind"))
        divided: dict[str, list[str]] = {}
        for schema in schemas:
            divided.setdefault(layer_of(schema, "physics" if schema == "MaterialBindingAPI" else home), []).append(schema)
        for name, some in divided.items():
            listed = sdf.TokenListOp()
            listed.prependedItems = some
            sdf.CreatePrimInLayer(self.layers[name], path).SetInfo("apiSchemas", listed)
        for attribute in spec.properties:
            layer = self.layers[layer_of(attribute.name, home)]
            sdf.CreatePrimInLayer(layer, path)
            sdf.CopySpec(self.flat, attribute.path, layer, attribute.path)

    def _add_instance(self, link: str, mesh: str, shared: str) -> None:
        """Add the visual mesh of a link, an instance of it with its materials, and the reference to that."""
        sdf = self.pxr.Sdf
        source = f"/{self.name}/links/{link}/{mesh}"
        geometry = sdf.CreatePrimInLayer(self.layers["geometries"], f"/{shared}/{link}")
        geometry.specifier, geometry.typeName = sdf.SpecifierDef, "Xform"
        geometry.nameParent.specifier, geometry.nameParent.typeName = sdf.SpecifierDef, "Scope"
        sdf.CopySpec(self.flat, source, self.layers["geometries"], f"{geometry.path}/{mesh}")
        instance = sdf.CreatePrimInLayer(self.layers["instances"], f"/instances/{link}")
        instance.specifier, instance.nameParent.specifier = sdf.SpecifierDef, sdf.SpecifierDef
        instance.nameParent.typeName = "Scope"
        instance.referenceList.Prepend(sdf.Reference("./geometries.usdc", geometry.path))
        bound = self.layers["geometries"].GetPrimAtPath(f"{geometry.path}/{mesh}")
        for spec in (bound, *bound.nameChildren):
            if "material:binding" not in spec.relationships:
                continue
            (target,) = spec.relationships["material:binding"].targetPathList.GetAddedOrExplicitItems()
            material = sdf.CreatePrimInLayer(self.layers["instances"], f"{instance.path}/materials/{target.name}")
            material.specifier, material.typeName = sdf.SpecifierDef, "Material"
            material.nameParent.specifier, material.nameParent.typeName = sdf.SpecifierDef, "Scope"
            if not material.hasReferences:
                material.referenceList.Prepend(sdf.Reference("./materials.usda", f"/materials/{target.name}"))
            over = sdf.CreatePrimInLayer(
                self.layers["instances"], str(spec.path).replace(str(geometry.path), str(instance.path), 1)
            )
            listed = sdf.TokenListOp()
            listed.prependedItems = ["MaterialBindingAPI"]
            over.SetInfo("apiSchemas", listed)
            sdf.RelationshipSpec(over, "material:binding", custom=False).targetPathList.explicitItems = [material.path]
            spec.RemoveProperty(spec.relationships["material:binding"])
            spec.ClearInfo("apiSchemas")
        visuals = sdf.CreatePrimInLayer(self.layers["base"], f"/{self.name}/links/{link}/visuals")
        visuals.specifier, visuals.typeName, visuals.instanceable = sdf.SpecifierDef, "Xform", True
        visuals.referenceList.Prepend(sdf.Reference("./instances.usda", instance.path))

    def _add_interface(self, metadata: Mapping[str, Any]) -> Any:
        """Return the layer that others refer to: the payload, and a variant set per engine."""
        sdf, layer = self.pxr.Sdf, self._new(f"{self.name}.usda")
        layer.defaultPrim = self.name
        root = sdf.CreatePrimInLayer(layer, f"/{self.name}")
        root.specifier, root.typeName = sdf.SpecifierDef, "Xform"
        root.SetInfo("kind", "component")
        root.payloadList.Prepend(sdf.Payload(f"./{PAYLOADS}/base.usda"))
        for file, engine in ENGINES.items():
            variants = sdf.VariantSetSpec(root, engine)
            sdf.VariantSpec(variants, "Disabled")
            enabled = sdf.VariantSpec(variants, "Enabled")
            enabled.primSpec.payloadList.Prepend(sdf.Payload(f"./{RUNNABLES}/{file}.usda"))
            root.variantSetNameList.Prepend(engine)
            root.variantSelections[engine] = "Disabled"
        for spec in self.flat.rootPrims:
            if spec.path != root.path:  # the physics scene
                sdf.CopySpec(self.flat, spec.path, layer, spec.path)
        layer.customLayerData = dict(metadata)
        return layer
