"""Small FBX 7.4 files as text."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

QUAD = ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)])


def listed(values) -> str:
    numbers = ",".join(f"{v:.9g}" for v in np.reshape(values, -1))
    return f"*{np.size(values)} {{\n a: {numbers}\n}}"


def prop(name: str, *values, kind: str = "") -> str:
    texts = ",".join(f'"{v}"' if isinstance(v, str) else f"{v:.9g}" for v in values)
    return f'P: "{name}", "{kind}", "", "A",{texts}\n'


class FbxText:
    """Builder of a document: each added object has an id, and is connected to others."""

    def __init__(self, up: int = 1, unit: float = 100.0) -> None:
        self.up, self.unit = up, unit
        self.objects, self.connections, self.count = "", "", 100

    def add(self, kind: str, name: str, subtype: str, body: str, parent: int | None = 0, how: str = "") -> int:
        self.count += 1
        label = {"NodeAttribute": "NodeAttribute", "AnimationStack": "AnimStack", "AnimationLayer": "AnimLayer"}
        label |= {"AnimationCurveNode": "AnimCurveNode", "AnimationCurve": "AnimCurve"}
        self.objects += f'{kind}: {self.count}, "{label.get(kind, kind)}::{name}", "{subtype}" {{\n{body}}}\n'
        if parent is not None:
            self.connect(self.count, parent, how)
        return self.count

    def connect(self, child: int, parent: int, how: str = "") -> None:
        self.connections += f'C: "{"OP" if how else "OO"}",{child},{parent}' + (f', "{how}"' if how else "") + "\n"

    def node(self, name: str, *props: str, parent: int = 0, kind: str = "Mesh") -> int:
        return self.add("Model", name, kind, f"Version: 232\nProperties70: {{\n{''.join(props)}}}\n", parent)

    def mesh(self, node: int, points, faces: Sequence[Sequence[int]], more: str = "", name: str = "shape") -> int:
        index = [v if k + 1 < len(face) else -1 - v for face in faces for k, v in enumerate(face)]
        body = f"Vertices: {listed(points)}\nPolygonVertexIndex: {listed(index)}\nGeometryVersion: 124\n{more}"
        return self.add("Geometry", name, "Mesh", body, node)

    def material(self, node: int, name: str, *props: str, model: str = "phong") -> int:
        return self.add("Material", name, "", f'ShadingModel: "{model}"\nProperties70: {{\n{"".join(props)}}}\n', node)

    def texture(self, material: int, slot: str, path: str, more: str = "") -> int:
        body = f'Type: "TextureVideoClip"\nFileName: "{path}"\nRelativeFilename: "{path}"\n{more}'
        return self.add("Texture", "picture", "", body, material, slot)

    def animation(
        self, node: int, channel: str, prop_name: str, keys: Sequence[tuple[float, float]], name: str = "Open"
    ) -> None:
        stack = self.add("AnimationStack", name, "", "", None)
        layer = self.add("AnimationLayer", "Base", "", "", stack)
        curves = self.add("AnimationCurveNode", channel[-1], "", f"Properties70: {{\n{prop('d|Z', 0.0)}}}\n", layer)
        self.connect(curves, node, prop_name)
        times = ",".join(str(int(t * 46186158000)) for t, _ in keys)
        body = f"KeyVer: 4008\nKeyTime: *{len(keys)} {{\n a: {times}\n}}\nKeyValueFloat: {listed([v for _, v in keys])}\n"
        body += f"KeyAttrFlags: {listed([4])}\nKeyAttrDataFloat: {listed([0] * 4)}\nKeyAttrRefCount: {listed([len(keys)])}\n"
        self.add("AnimationCurve", "", "", body, curves, "d|Z")

    def text(self) -> str:
        axes = "".join(prop(f"{n}Axis", v) + prop(f"{n}AxisSign", s) for n, v, s in self._axes())
        return (
            "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n FBXHeaderVersion: 1003\n FBXVersion: 7400\n}\n"
            f"GlobalSettings:  {{\n Version: 1000\nProperties70: {{\n{axes}{prop('UnitScaleFactor', self.unit)}}}\n}}\n"
            f"Objects:  {{\n{self.objects}}}\nConnections:  {{\n{self.connections}}}\n"
        )

    def _axes(self):
        return (
            (("Up", 1, 1), ("Front", 2, 1), ("Coord", 0, 1))
            if self.up == 1
            else (("Up", 2, 1), ("Front", 1, -1), ("Coord", 0, 1))
        )


def layer(kind: str, data: str, mapping: str, reference: str = "Direct") -> str:
    return f'{kind}: 0 {{\nMappingInformationType: "{mapping}"\nReferenceInformationType: "{reference}"\n{data}}}\n'
