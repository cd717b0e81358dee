#!/usr/bin/env python3
"""Writes scenes of 10^5 objects into a folder, one for each format that has a way of its own to be
large: large_scenes.py FOLDER. docs/performance.md says how long they take to load."""

import base64
import json
import struct
import sys
from pathlib import Path

SIDE = 316  # things along a side of the grid
PLACES = [(i % SIDE, i // SIDE) for i in range(100_000)]


def ball(rings, sectors):
    """Points and triangles of a ball of radius 0.4 about (0, 0, 0.5)."""
    from math import cos, pi, sin

    points = [(0, 0, 0.1)]
    for i in range(1, rings):
        for k in range(sectors):
            polar, turn = pi * i / rings, 2 * pi * k / sectors
            across = 0.4 * sin(polar)
            points.append((across * cos(turn), across * sin(turn), 0.5 - 0.4 * cos(polar)))
    points.append((0, 0, 0.9))
    last = len(points) - 1
    triangles = []
    for k in range(sectors):
        after = (k + 1) % sectors
        triangles.append((0, 1 + after, 1 + k))
        triangles.append((last, last - sectors + k, last - sectors + after))
        for i in range(rings - 2):
            a, b = 1 + i * sectors + k, 1 + i * sectors + after
            triangles += [(a, b, b + sectors), (a, b + sectors, a + sectors)]
    return points, triangles


def native():
    """Spheres and boxes in turn."""
    yield "isolux: 1\nmaterials:\n  grey: {reflectance: 0.5}\n  lamp: {reflectance: 0}\nobjects:\n"
    for i, (x, y) in enumerate(PLACES):
        shape = (
            f"sphere: {{center: [{x + 0.5}, {y + 0.5}, 0.5], radius: 0.4}}"
            if i % 2
            else f"box: {{lower: [{x + 0.1}, {y + 0.1}, 0.1], upper: [{x + 0.9}, {y + 0.9}, 0.9]}}"
        )
        yield f"  - name: thing {i}\n    shape: {{{shape}}}\n    material: grey\n"
    yield (
        "  - name: sky\n    shape: {disk: {center: [158, 158, 300], normal: -z, radius: 50}}\n"
        "    material: lamp\n    sides: front\n    emission: {flux: 1e6}\n"
    )


def obj():
    """A sheet of a million triangles."""
    side = 708
    for y in range(side):
        for x in range(side):
            yield f"v {x * 0.0141} {y * 0.0141} {(x * 37 + y * 91) % 101 * 1e-4}\n"
    for y in range(side - 1):
        for x in range(side - 1):
            a = y * side + x + 1
            yield f"f {a} {a + 1} {a + side + 1}\nf {a} {a + side + 1} {a + side}\n"


def gltf():
    """One mesh of 960 triangles, many nodes."""
    points, triangles = ball(16, 32)
    data = b"".join(struct.pack("<3f", *p) for p in points)
    indices = b"".join(struct.pack("<3H", *t) for t in triangles)
    lower, upper = [min(c) for c in zip(*points)], [max(c) for c in zip(*points)]
    buffer = base64.b64encode(data + indices).decode()
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(PLACES)))}],
        "nodes": [
            {"mesh": 0, "translation": [x, 0, y], "scale": [1, 1 + i % 7 / 10, 1]}
            for i, (x, y) in enumerate(PLACES)
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3",
             "min": lower, "max": upper},
            {"bufferView": 1, "componentType": 5123, "count": 3 * len(triangles), "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(data)},
            {"buffer": 0, "byteOffset": len(data), "byteLength": len(indices)},
        ],
        "buffers": [{"uri": "data:application/octet-stream;base64," + buffer,
                     "byteLength": len(data) + len(indices)}],
    }
    yield json.dumps(document)


def radiance():
    """Polygons."""
    yield "void plastic grey 0 0 5 0.5 0.5 0.5 0 0\n"
    for i, (x, y) in enumerate(PLACES):
        yield (
            f"grey polygon p{i} 0 0 12 {x} {y} 0 {x + 0.9} {y} 0 {x + 0.9} {y + 0.9} 0.1 "
            f"{x} {y + 0.9} 0.1\n"
        )


def mgf():
    """A ball and four faces in arrays of arrays."""
    yield "m grey =\n\tsides 1\n\trd 0.5\nm grey\n"
    for i, p in enumerate([(0, 0, 0), (0.8, 0, 0), (0.8, 0.8, 0), (0, 0.8, 0), (0.4, 0.4, 0.7)]):
        yield f"v v{i} =\n\tp {p[0]} {p[1]} {p[2]}\n"
    yield "xf -t 1 0 0 -a 10 -t 1 0 0\nxf -a 10 -t 0 1 0\nxf -a 10 -t 10 0 0 -a 20 -t 0 10 0\n"
    yield "f v0 v1 v4\nf v1 v2 v4\nf v2 v3 v4\nf v3 v0 v4\nsph v4 0.1\nxf\nxf\nxf\n"


def pbrt():
    """One mesh as an object, many instances."""
    points, triangles = ball(16, 32)
    corners = " ".join(f"{x:.9g} {y:.9g} {z:.9g}" for x, y, z in points)
    indices = " ".join(f"{a} {b} {c}" for a, b, c in triangles)
    yield "LookAt 0 -300 200  158 158 0  0 0 1\nCamera \"perspective\"\nWorldBegin\n"
    yield "ObjectBegin \"ball\"\nMaterial \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\n"
    yield f"Shape \"trianglemesh\" \"point3 P\" [{corners}] \"integer indices\" [{indices}]\n"
    yield "ObjectEnd\n"
    for x, y in PLACES:
        yield f"AttributeBegin\nTranslate {x} {y} 0\nObjectInstance \"ball\"\nAttributeEnd\n"


def rayshade():
    """A solid made of solids, by name."""
    yield "surface grey diffuse 0.5 0.5 0.5\neyep 0 -300 200\nlookp 158 158 0\n"
    yield "light 1 point 158 158 300\n"
    yield (
        "name die\nintersect\n  box 0.1 0.1 0.1 0.9 0.9 0.9\n"
        "  sphere 0.5 0.5 0.5 0.5\nend\n"
    )
    for x, y in PLACES:
        yield f"object grey die translate {x} {y} 0\n"


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    scenes = {"native.yaml": native, "sheet.obj": obj, "instances.gltf": gltf,
              "polygons.rad": radiance, "arrays.mgf": mgf, "instances.pbrt": pbrt,
              "dice.ray": rayshade}
    for name, write in scenes.items():
        with open(folder / name, "w", encoding="utf-8") as file:
            file.writelines(write())


if __name__ == "__main__":
    main()
