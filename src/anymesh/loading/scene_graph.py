"""The objects of a scene, for all formats: coarser levels of detail and helpers are left out, and each object has its own name.

Exporters write one object as several nodes, one per material, and name them `Object_4` or `Door_Oak_0`: the name is then that
of a node above.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from anymesh.loading.files import Folder
from anymesh.loading.join import unique_names
from anymesh.names import listed
from anymesh.types import Mesh, Node
from anymesh.vocabulary import is_fixed_name, named_plurals, recognize, words_of

SKETCHFAB = "Sketchfab_model"  # root of its files, in which a number is added to each name
SHOWN = 5  # names in a warning
LONGEST = 200  # characters of a name that are looked at
# Names that exporters and modelling programs give by themselves. With a file's suffix: the name of a converted file.
GENERIC = re.compile(
    r"""(?ix) (?: (?:
      object | obj | mesh(?:es)? | nodes? | geometry | geom | geo | geode | prim(?:itive)?s? |
      group | grp | g | id | model | part | shape | surface | solid | compound | component | instance | entity | nauo |
      unnamed | untitled | none | null | empty | (?:matrix)?transform | default(?:_?material)? | material | mat | sub_?mesh |
      element | locator | dummy | armature | skeleton | bone | joint | b?rep | poly_?surface | editable_?(?:mesh|poly) |
      p?(?:cube|cylinder|sphere|plane|torus|cone|pipe|prism|disc) | circle | (?:ico|geo)sphere | suzanne | tube |
      (?:chamfer)?box | chamfer_?cyl(?:inder)? | line | curve | nurbs(?:path|curve)? | bezier(?:curve|circle)? | text |
      rectangle | loft | extrude | root | root_?node | scene(?:[ _]root)? | gltf_sceneroot_?node | world | auxscene |
      sketchfab_?(?:model|scene)? | osg_?scene | collada[ ]?visual[ ]?scene(?:[ ]group)? | visual_?scene(?:node)? | collection |
      (?-i:Body(?=\d)) | open[ ]cascade[ ]step[ ]translator
    ) (?:_?shape)? [\W_\d]* | [\W_\d]* | [0-9a-f-]{16,}[\W_\d]* |
    .*\.(?:fbx|obj|dae|blend|3ds|max|gltf|glb|stl|ply|skp|c4d|ma|mb|stp|step)\b.* )"""
)
NUMBERED = re.compile(r"(?i)[\W_]*(?:mesh_?part|primitive|sub_?mesh|part|mesh|material|mat)?[\W_]*\d+")
SHAPE = re.compile(  # or a material without a name of its own
    r"(?i)[\W_]*(?:shape|mesh|geo(?:metry)?|(?:default_?)?mat(?:erial)?|lambert|phong|blinn|initial_?shading_?group)[\W_\d]*"
)
NUMBER = re.compile(r"_\d+$")
SEVERAL = frozenset("unit set group assembly kit collection all part object thing".split())
DETAIL = re.compile(r"(?:(?<![A-Za-z])(?i:LOD)|(?<=[a-z0-9])LOD)[\W_]?(\d{1,2})(?!\d)")
COLLIDES = re.compile(r"(?:UCX|UBX|USP|UCP|MCDCX)_|.*-(?:conv)?colonly\b")
COLLISION_WORDS = frozenset("collision collider hitbox".split())
FORM_WORDS = frozenset("mesh hull box shape geometry geo proxy object".split())  # may follow these words
BESIDE_VISUAL = re.compile(
    r"(?i)(?:(?:conv)?col[-_])?(.+?)(?:[-_](?:conv)?col(?:[-_.]?\d+)?)?"
)  # Godot: such a mesh may be seen
HELPER = re.compile(
    r"(?i)(?:.*\.target|(?:camera|(?:spot|point|directional|hemisphere|rect_?area)_?light|grid|axes)_?helper)[\W_\d]*"
)


def scene_of_objects(mesh: Mesh, folder: Folder) -> Mesh:
    """Return the mesh of what a scene shows, one node per named object; a warning names each kind that is left out."""
    mesh = _without(mesh, folder, _coarse, "coarser level{} of detail {} left out, the finest is kept")
    mesh = _without(mesh, folder, _collides, "collision shape{} {} left out, the visual meshes are kept")
    mesh = _without(mesh, folder, _helps, "helper{} of cameras and lights {} left out")
    return _named(mesh)


def is_generic(name: str) -> bool:
    """Return whether programs give such a name by themselves, so that it names no object."""
    return GENERIC.fullmatch(name[:LONGEST]) is not None and recognize(name) is None and not is_fixed_name(name)


def leave_out_warning(names: Sequence[str], text: str) -> str:
    """Return "2 TEXT: a, b" with {} in the text replaced by the plural ending and the verb."""
    count = len(names)
    return f"{count} {text.format(*(('', 'is') if count == 1 else ('s', 'are')))}: {listed(list(names), SHOWN)}"


def _without(mesh: Mesh, folder: Folder, which: Callable[[tuple[Node, ...]], set[int]], text: str) -> Mesh:
    """Return the mesh without some of its nodes, unless nothing else has faces."""
    left_out = which(mesh.nodes) & {int(k) for k in np.unique(mesh.face_node)}
    keep = ~np.isin(mesh.face_node, list(left_out))
    if keep.all() or not keep.any():
        return mesh
    folder.warn(leave_out_warning([mesh.nodes[k].name for k in sorted(left_out)], text))
    return mesh.subset(keep)


def _chain(node: Node) -> tuple[str, ...]:
    return node.path or (node.name,)


def _coarse(nodes: tuple[Node, ...]) -> set[int]:
    """Return the nodes of which a finer level of detail is there."""
    levels: dict[tuple[str, ...], dict[int, int]] = defaultdict(dict)
    plain: dict[tuple[str, ...], int] = {}  # nodes without a mark, which may be the finest level
    for k, node in enumerate(nodes):
        chain = (*_chain(node)[:-1], node.name)
        depth, mark = next(((d, m) for d, name in enumerate(chain) if (m := DETAIL.search(name))), (len(chain) - 1, None))
        key = (*chain[:depth], re.sub(r"[\W_]+", "_", DETAIL.sub("", chain[depth])).strip("_").lower())
        if mark is None:
            plain[key] = k
        else:
            levels[key][k] = int(mark[1])
    for key, k in plain.items():
        if key in levels:
            levels[key][k] = -1
    return {k for level in levels.values() for k in level if level[k] > min(level.values())}


def _collides(nodes: tuple[Node, ...]) -> set[int]:
    visible = {re.sub(r"[\W_]+", "_", node.name).lower() for node in nodes}

    def named(name: str) -> bool:
        words = words_of(name)
        while len(words) > 1 and words[-1] in FORM_WORDS:
            words.pop()
        base = BESIDE_VISUAL.fullmatch(name[:LONGEST])
        beside = base is not None and base[1] != name and re.sub(r"[\W_]+", "_", base[1]).lower() in visible
        return beside or COLLIDES.match(name) is not None or bool(COLLISION_WORDS & {*words[:1], *words[-1:]})

    return {k for k, node in enumerate(nodes) if any(named(name) for name in {*_chain(node), node.name})}


def _helps(nodes: tuple[Node, ...]) -> set[int]:
    return {k for k, node in enumerate(nodes) if any(HELPER.fullmatch(name[:LONGEST]) for name in _chain(node))}


def materials_of_nodes(mesh: Mesh) -> list[list[int]]:
    """Return the materials of each node that has faces, -1 for none, in the order of the nodes."""
    pair = np.unique(mesh.face_node * (len(mesh.materials) + 1) + mesh.face_material + 1)
    node, material = np.divmod(pair, len(mesh.materials) + 1)
    return [(mine - 1).tolist() for mine in np.split(material, np.flatnonzero(np.diff(node)) + 1)]


Chain = tuple[str, ...]  # names from the scene's root down to a node


def _named(mesh: Mesh) -> Mesh:
    """Return the mesh with nodes that are parts of one object joined, and named after it."""
    present = np.unique(mesh.face_node)
    nodes, number = [mesh.nodes[k] for k in present], np.searchsorted(present, mesh.face_node)
    objects = _objects(nodes, [[mesh.materials[m].name for m in mine if m >= 0] for mine in materials_of_nodes(mesh)])
    groups: dict[tuple[Chain, int], list[int]] = defaultdict(list)
    for k, (chain, _) in enumerate(objects):
        groups[chain, nodes[k].joint].append(k)
    first, new = np.arange(len(nodes)), list(nodes)
    for (chain, _), members in groups.items():
        by_material = all(objects[k][1] for k in members)
        if 1 < len(members) == len(nodes) and not by_material:
            continue  # the name of the whole says nothing of its parts
        joins = len(members) > 1 and (by_material or not (named_plurals(chain[-1]) or SEVERAL & set(words_of(chain[-1]))))
        first[members] = members[0] if joins else members
        for k in members:
            if chain != _chain(nodes[k]):
                pivot = nodes[k].pivot if not joins or len({nodes[m].pivot for m in members}) == 1 else None
                new[k] = replace(nodes[k], name=chain[-1], path=chain if joins else nodes[k].path, pivot=pivot)
            elif is_generic(nodes[k].name) and not is_generic(nodes[k].geometry):
                new[k] = replace(nodes[k], name=nodes[k].geometry)
    kept, face_node = np.unique(first[number], return_inverse=True)
    if len(kept) == len(mesh.nodes) and new == nodes:
        return mesh
    return replace(mesh, face_node=face_node.reshape(-1), nodes=_clean([new[k] for k in kept]))


def _objects(nodes: Sequence[Node], materials: Sequence[Sequence[str]]) -> list[tuple[Chain, bool]]:
    """Return the chain of the object that each node is a part of, and whether it is the part of one material."""
    chains = [_chain(node) for node in nodes]
    meshes, family = set(chains), defaultdict(list)
    for chain, mine in zip(chains, materials, strict=True):
        for key in {chain, chain[:-1]}:
            family[key] += mine
    objects = []
    for node, chain, mine in zip(nodes, chains, materials, strict=True):
        siblings = family[chain[:-1]]
        apart = 1 < len(siblings) == len(set(siblings))
        split = len(chain) > 1 and any(_is_split(name, chain[-2], mine, apart) for name in (node.name, node.geometry))
        start = chain[:-1] if split else chain
        told = not split and (recognize(node.geometry) is not None or is_fixed_name(node.geometry))
        if told or not is_generic(start[-1] if split else node.name):
            objects.append((start, split))
            continue
        above = [chain[:n] for n in range(len(start) - 1, 0, -1) if not is_generic(chain[n - 1])]
        objects.append((above[0] if above and above[0] not in meshes else start, split))
    return objects


def _is_split(name: str, parent: str, materials: Sequence[str], apart: bool) -> bool:
    """Return whether a name is that of the node above with a number or a material; apart: each has a material of its own."""
    for stem in {parent, NUMBER.sub("", parent)}:
        if stem and name.startswith(stem):
            rest = name[len(stem) :][:LONGEST]
            if SHAPE.fullmatch(rest) or (apart and NUMBERED.fullmatch(rest)):
                return True
            if any({_plain(rest), _plain(NUMBER.sub("", rest))} & {_plain(m)} - {""} for m in materials):
                return True
    return False


def _plain(name: str) -> str:
    return re.sub(r"[\W_]+", "", name).lower()


def _clean(nodes: list[Node]) -> tuple[Node, ...]:
    """Return the nodes with unique names, without marks of a level of detail, and without the numbers that Sketchfab adds."""
    plain = [NUMBER.sub("", n.name) if n.path and n.path[0].startswith(SKETCHFAB) else n.name for n in nodes]
    short = [DETAIL.sub("", name).strip("_-. ") for name in plain]
    count = Counter(short)
    names = unique_names(s if count[s] == 1 and s else n.name for s, n in zip(short, nodes, strict=True))
    return tuple(replace(node, name=name) for node, name in zip(nodes, names, strict=True))
