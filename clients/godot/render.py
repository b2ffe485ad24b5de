"""Renders an exported scene with Godot 3, its shadow code unmodified: a white diffuse scene twice, with shadows and without, by
draw.gd. What is written is the quotient. Started by clients/godot/render."""
import array
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python"))
sys.dont_write_bytecode = True  # the folder stays as it was
from exported_scene import BadInput, ExportedScene  # noqa: E402
from renderer import Parser, run, write_frame  # noqa: E402

FILTERS = {"none": 0, "pcf5": 1, "pcf13": 2}  # rendering/quality/shadows/filter_mode
MODES = {"directional": {"orthogonal": 0, "splits2": 1, "splits4": 2}, "point": {"paraboloid": 0, "cube": 1}}


def read_command_line(words):
    parser = Parser("godot")
    parser.add_argument("--filter", default="pcf5", choices=list(FILTERS), help="of the project's shadows")
    parser.add_argument("--directional", default="splits4", choices=list(MODES["directional"]), help="directional_shadow_mode")
    parser.add_argument("--point", default="cube", choices=list(MODES["point"]), help="omni_shadow_mode")
    parser.add_argument("--map-size", type=int, default=4096, choices=[2 ** k for k in range(8, 15)],
                        help="texels of the directional map, and of the atlas, of which a point light has a sixteenth")
    parser.add_argument("--distance", choices=["scene"], help="directional_shadow_max_distance as far as the scene is; 100 m if not given")
    return parser.parse_args(words)


def described(exported, frame):
    light = frame["light"]
    if light["kind"] == "environment":
        raise BadInput("no shadow map is of an environment light; choose another scene")
    result = {key: frame[key] for key in ("index", "nodes", "camera", "view", "light")}
    vertices = list(exported.vertices(frame))
    result["reach"] = max(math.dist(frame["camera"]["eye"], vertex) for vertex in vertices)
    if light["kind"] != "directional":
        result["range"] = 2 * max(math.dist(light["centre"], vertex) for vertex in vertices)
    return result


def write_project(folder, options):
    shutil.copy(os.path.join(os.path.dirname(os.path.abspath(__file__)), "draw.gd"), folder)
    with open(os.path.join(folder, "project.godot"), "w", encoding="utf-8") as stream:
        stream.write("config_version=4\n[rendering]\n"
                     f"quality/shadows/filter_mode={FILTERS[options.filter]}\n"
                     f"quality/directional_shadow/size={options.map_size}\n")


def write_job(folder, options, exported, frames):
    closed = {mesh["name"]: mesh["closed"] for mesh in json.load(open(os.path.join(options.scene, "scene.json"), encoding="utf-8"))["meshes"]}
    meshes = {name: {"triangles": [x for triangle in triangles for corner in triangle for x in vertices[corner]], "closed": closed[name]}
              for name, (vertices, triangles) in exported.meshes.items()}
    kind = "directional" if frames[0]["light"]["kind"] == "directional" else "point"
    job = {"size": exported.size, "map": options.map_size, "distance": 1 if options.distance else 0, "out": folder,
           "mode": MODES[kind][getattr(options, kind)], "meshes": meshes, "frames": [described(exported, frame) for frame in frames]}
    file = os.path.join(folder, "job.json")
    with open(file, "w", encoding="utf-8") as stream:
        json.dump(job, stream)
    return file


def read_raw(file, size):
    numbers = array.array("f")
    with open(file, "rb") as stream:
        numbers.frombytes(stream.read())
    if len(numbers) != size[0] * size[1]:
        raise BadInput(f"Godot drew {len(numbers)} pixels, not {size[0]} x {size[1]}")
    return numbers


def render(words):
    options = read_command_line(words)
    exported = ExportedScene(options.scene)
    frames = exported.frames_named(options.frames)
    with tempfile.TemporaryDirectory() as folder:
        write_project(folder, options)
        job = write_job(folder, options, exported, frames)
        words = ["godot3-runner", "--path", folder, "--script", "res://draw.gd", "--video-driver", "GLES3", "--audio-driver", "Dummy"]
        environment = {**os.environ, "SHADOWBENCH_JOB": job, "HOME": folder}
        ran = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
        for frame in frames:
            files = [os.path.join(folder, f"{frame['index']}-{which}.raw") for which in ("shadowed", "unshadowed")]
            if not all(map(os.path.exists, files)):
                raise BadInput(f"Godot drew no frame {frame['index']}: {(ran.stderr.strip() or ran.stdout.strip())[-2000:]}")
            shadowed, unshadowed = (read_raw(file, exported.size) for file in files)
            # Where two surfaces have one depth, now this one is drawn and now the other.
            image = array.array("f", (min(1, a / b) if b > 0 else 0 for a, b in zip(shadowed, unshadowed)))
            write_frame(options.out, frame, exported.size, image)
    print(f"godot: {len(frames)} frames into {options.out} with {next((line for line in ran.stdout.splitlines() if line.startswith('Godot')), 'Godot')}")


run("godot", render, sys.argv[1:])
