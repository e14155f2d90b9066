"""STEP: a box with a name, a unit and a place, written by hand."""

import pytest

from anymesh.errors import InputError
from anymesh.loading import load_mesh

pytest.importorskip("cascadio")
CORNERS = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]  # outwards


class StepText:
    """Builder of a STEP file of one solid."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def add(self, text: str) -> str:
        self.lines.append(f"#{len(self.lines) + 1}={text};")
        return f"#{len(self.lines)}"

    def point(self, p, kind: str = "CARTESIAN_POINT") -> str:
        return self.add(f"{kind}('',({','.join(f'{float(v)}' for v in p)}))")

    def face(self, size, face, edges) -> str:
        corners = [[c * s for c, s in zip(CORNERS[k], size, strict=True)] for k in face]
        a, b, c = corners[:3]
        u, v = ([q - p for p, q in zip(a, b, strict=True)], [q - p for p, q in zip(b, c, strict=True)])
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        axes = self.add(
            f"AXIS2_PLACEMENT_3D('',{self.point(a)},{self.point(normal, 'DIRECTION')},{self.point(u, 'DIRECTION')})"
        )
        plane = self.add(f"PLANE('',{axes})")
        used = []
        for start, end in zip(face, (*face[1:], face[0]), strict=True):
            forward = (start, end) in edges
            used.append(
                self.add(
                    f"ORIENTED_EDGE('',*,*,{edges[(start, end) if forward else (end, start)]},{'.T.' if forward else '.F.'})"
                )
            )
        loop = self.add(f"EDGE_LOOP('',({','.join(used)}))")
        return self.add(f"ADVANCED_FACE('',({self.add(f'FACE_OUTER_BOUND({chr(39) * 2},{loop},.T.)')}),{plane},.T.)")

    def box(self, name: str, size, unit: str) -> str:
        points = [self.point([c * s for c, s in zip(corner, size, strict=True)]) for corner in CORNERS]
        vertices = [self.add(f"VERTEX_POINT('',{p})") for p in points]
        edges: dict[tuple[int, int], str] = {}
        for face in FACES:
            for a, b in zip(face, (*face[1:], face[0]), strict=True):
                if (b, a) not in edges:
                    along = [(q - p) * s for p, q, s in zip(CORNERS[a], CORNERS[b], size, strict=True)]
                    vector = self.add(f"VECTOR('',{self.point(along, 'DIRECTION')},1.)")
                    line = self.add(f"LINE('',{points[a]},{vector})")
                    edges[a, b] = self.add(f"EDGE_CURVE('',{vertices[a]},{vertices[b]},{line},.T.)")
        shell = self.add(f"CLOSED_SHELL('',({','.join(self.face(size, face, edges) for face in FACES)}))")
        solid = self.add(f"MANIFOLD_SOLID_BREP('{name}',{shell})")
        length = self.add(f"(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT({unit},.METRE.))")
        angle = self.add("(NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.))")
        solid_angle = self.add("(NAMED_UNIT(*) SI_UNIT($,.STERADIAN.) SOLID_ANGLE_UNIT())")
        units = f"GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid_angle}))"
        context = self.add(f"(GEOMETRIC_REPRESENTATION_CONTEXT(3) {units} REPRESENTATION_CONTEXT('',''))")
        shape = self.add(f"ADVANCED_BREP_SHAPE_REPRESENTATION('{name}',({solid}),{context})")
        application = self.add("APPLICATION_CONTEXT('automotive design')")
        kind = self.add(f"PRODUCT_CONTEXT('',{application},'mechanical')")
        product = self.add(f"PRODUCT('{name}','{name}','',({kind}))")
        formation = self.add(f"PRODUCT_DEFINITION_FORMATION('','',{product})")
        design = self.add(f"PRODUCT_DEFINITION_CONTEXT('part definition',{application},'design')")
        definition = self.add(f"PRODUCT_DEFINITION('design','',{formation},{design})")
        own = self.add(f"PRODUCT_DEFINITION_SHAPE('','',{definition})")
        self.add(f"SHAPE_DEFINITION_REPRESENTATION({own},{shape})")
        body = "\n".join(self.lines)
        head = "FILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));"
        return f"ISO-10303-21;\nHEADER;\n{head}\nENDSEC;\nDATA;\n{body}\nENDSEC;\nEND-ISO-10303-21;\n"


def test_a_solid_is_a_node_with_its_name_in_metres(tmp_path):
    for unit, metres in ((".MILLI.", 0.001), ("$", 1.0)):
        (tmp_path / "a.step").write_text(StepText().box("Door", (3, 4, 5), unit))
        found = load_mesh(tmp_path / "a.step")
        assert (found.unit_in_metres, found.format_up) == (1.0, None)
        assert found.mesh.extents == pytest.approx([3 * metres, 4 * metres, 5 * metres])
        assert [node.name for node in found.mesh.nodes] == ["Door"]
        assert len(found.mesh.faces) == 12


def test_a_broken_step_file_ends_in_one_error(tmp_path):
    (tmp_path / "a.stp").write_text("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=PRODUCT(\n")
    with pytest.raises(InputError, match=r"a\.stp"):
        load_mesh(tmp_path / "a.stp")
