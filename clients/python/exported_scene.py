"""Reads the folder that `shadowbench export` writes (docs/exchange.md)."""
import array
import json
import math
import os
import sys


class BadInput(Exception):
    """An error with a sentence for the user."""


INDEX_CODES = {5121: "B", 5123: "H", 5125: "I"}


def read_json(file):
    try:
        with open(file, encoding="utf-8") as stream:
            return json.load(stream)
    except (OSError, ValueError) as error:
        raise BadInput(f"cannot read {file}: {error}; `shadowbench export` writes it") from error


def read_accessor(gltf, data, number):
    accessor = gltf["accessors"][number]
    view = gltf["bufferViews"][accessor["bufferView"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    is_vector = accessor["type"] == "VEC3"
    numbers = array.array("f" if is_vector else INDEX_CODES[accessor["componentType"]])
    count = accessor["count"] * (3 if is_vector else 1)
    numbers.frombytes(data[start:start + count * numbers.itemsize])
    if sys.byteorder == "big":
        numbers.byteswap()
    return numbers


def threes(numbers):
    return [tuple(numbers[i:i + 3]) for i in range(0, len(numbers), 3)]


class ExportedScene:
    """`frames` as in scene.json; `meshes` by name, each (vertices, triangles)."""

    def __init__(self, folder):
        scene = read_json(os.path.join(folder, "scene.json"))
        if (scene.get("format"), scene.get("version")) != ("shadowbench-scene", 1):
            raise BadInput(f"{folder}/scene.json is not a shadowbench-scene of version 1")
        self.size = scene["size"]
        self.frames = {frame["index"]: frame for frame in scene["frames"]}
        gltf = read_json(os.path.join(folder, scene.get("gltf", "scene.gltf")))
        try:
            with open(os.path.join(folder, gltf["buffers"][0]["uri"]), "rb") as stream:
                data = stream.read()
        except OSError as error:
            raise BadInput(f"cannot read the meshes: {error}; export the scene again") from error
        self.meshes = {}
        for mesh in gltf["meshes"]:
            primitive = mesh["primitives"][0]
            self.meshes[mesh["name"]] = (threes(read_accessor(gltf, data, primitive["attributes"]["POSITION"])),
                                         threes(read_accessor(gltf, data, primitive["indices"])))

    def frames_named(self, text):
        """The frames of a list with commas; all of them for None."""
        if text is None:
            return list(self.frames.values())
        try:
            return [self.frames[int(number)] for number in text.split(",")]
        except (ValueError, KeyError) as error:
            raise BadInput(f"--frames: the scene has no frame {error}; it has {', '.join(map(str, self.frames))}") from error

    def vertices(self, frame):
        """Those of a frame, in the world."""
        for node in frame["nodes"]:
            m = node["matrix"]
            for x, y, z in self.meshes[node["mesh"]][0]:
                yield [m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k] for k in range(3)]

    def bounds(self, frame):
        """Middle of the box around a frame's vertices, and half of its diagonal."""
        least, most = [math.inf] * 3, [-math.inf] * 3
        for vertex in self.vertices(frame):
            for k, along in enumerate(vertex):
                least[k], most[k] = min(least[k], along), max(most[k], along)
        return [(a + b) / 2 for a, b in zip(least, most)], math.dist(least, most) / 2

    def angle_from(self, frame, eye):
        """The largest between the direction from a point to the middle of a frame and that to one of its vertices, in radians."""
        axis = [a - b for a, b in zip(self.bounds(frame)[0], eye)]

        def angle(vertex):
            to = [a - b for a, b in zip(vertex, eye)]
            cosine = sum(a * b for a, b in zip(axis, to)) / (math.hypot(*axis) * math.hypot(*to))
            return math.acos(max(-1, min(1, cosine)))

        return max(map(angle, self.vertices(frame)))
