"""Renders an exported scene in Blender: a white diffuse scene twice, with and without the light's shadows, direct light only.
What is written is the quotient: of an area light the share of irradiance that arrives. Started by clients/blender/render."""
import array
import math
import os
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python"))
sys.dont_write_bytecode = True  # the folder stays as it was
from exported_scene import BadInput, ExportedScene  # noqa: E402
from renderer import Parser, run, write_frame  # noqa: E402

try:
    import bpy
    from mathutils import Matrix, Vector
except ImportError:  # --help needs none of it
    bpy = None


def read_command_line(words):
    parser = Parser("blender", " --samples 1024")
    parser.add_argument("--engine", choices=["cycles", "eevee"], default="cycles", help="that renders")
    parser.add_argument("--light", choices=["area", "centre"], default="area",
                        help="an area light as it is, or the point light at its centre")
    parser.add_argument("--samples", type=int, help="of each pixel; 1024 of Cycles, 64 of EEVEE (its default) if not given")
    parser.add_argument("--pixel", choices=["centre", "area"], default="centre",
                        help="samples at the pixel's centre, or all over its square")
    parser.add_argument("--seed", type=int, default=0, help="of Cycles")
    sizes = [str(2 ** k) for k in range(6, 13)]
    parser.add_argument("--cube-size", choices=sizes, default="512", help="EEVEE's shadow_cube_size, of point and area lights")
    parser.add_argument("--cascade-size", choices=sizes, default="1024",
                        help="EEVEE's shadow_cascade_size, of directional lights")
    options = parser.parse_args(words)
    if options.samples is not None and options.samples < 1:
        raise BadInput(f"--samples {options.samples}: give 1 or more")
    return options


def white(kind):
    """A material of one node of that kind."""
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    node = nodes.new(kind)
    node.inputs["Color"].default_value = (1, 1, 1, 1)
    material.node_tree.links.new(node.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def add_meshes(exported):
    material = white("ShaderNodeBsdfDiffuse")
    meshes = {}
    for name, (vertices, triangles) in exported.meshes.items():
        meshes[name] = bpy.data.meshes.new(name)
        meshes[name].from_pydata(vertices, [], triangles)
        meshes[name].materials.append(material)
    return meshes


def matrix_of(numbers):
    return Matrix([numbers[row::4] for row in range(4)])


def add_object(name, data, matrix):
    made = bpy.data.objects.new(name, data)
    made.matrix_world = matrix
    bpy.context.scene.collection.objects.link(made)
    return made


def frame_from(x, z, origin):
    """Local axes: x as given, z as near to the given as a right angle allows."""
    x = x.normalized()
    z = (z - z.dot(x) * x).normalized()
    columns = [x, z.cross(x), z, origin]
    return Matrix([[column[row] for column in columns] for row in range(3)] + [[0, 0, 0, 1]])


def add_sun(light, middle):
    data = bpy.data.lights.new("light", "SUN")
    data.angle = 0
    data.energy = 10
    back = -Vector(light["direction"])
    return add_object("light", data, frame_from(back.orthogonal(), back, middle))


def add_shining_mesh(u, v, centre):
    """Blender's own area lights have right angles; this one may have others. It shines on both sides."""
    if bpy.context.scene.render.engine != "CYCLES":
        raise BadInput("EEVEE has no area light with slanted sides; give --engine cycles, or another scene")
    data = bpy.data.meshes.new("light")
    data.from_pydata([-(u + v) / 2, (u - v) / 2, (u + v) / 2, (v - u) / 2], [], [(0, 1, 2, 3)])
    data.materials.append(white("ShaderNodeEmission"))
    return add_object("light", data, Matrix.Translation(centre))


def add_area(light, middle):
    """An area light of Blender shines along its −z only: it is turned towards the middle of the scene."""
    u, v, centre = Vector(light["u"]), Vector(light["v"]), Vector(light["centre"])
    if abs(u.normalized().dot(v.normalized())) > 1e-6:
        return add_shining_mesh(u, v, centre)
    data = bpy.data.lights.new("light", "AREA")
    data.shape = "ELLIPSE" if light["kind"] == "disk" else "RECTANGLE"
    data.size, data.size_y = u.length, v.length
    normal = u.cross(v)
    if normal.dot(middle - centre) > 0:
        normal = -normal
    return add_object("light", data, frame_from(u, normal, centre))


def add_light(light, middle, radius, area):
    kind = light["kind"]
    if kind == "directional":
        return add_sun(light, middle)
    if kind in ("rectangle", "disk") and area:
        made = add_area(light, middle)
    elif kind == "point" or "centre" in light and not area:
        data = bpy.data.lights.new("light", "POINT")
        data.shadow_soft_size = 0
        made = add_object("light", data, Matrix.Translation(Vector(light["centre"])))
    else:
        raise BadInput(f"a light of kind {kind} is not for this client; choose a scene with another light")
    if made.type == "LIGHT":  # so bright that EEVEE's threshold, below which it leaves a light out, does not matter
        made.data.energy = 1000 * ((middle - Vector(light["centre"])).length + radius) ** 2
    made.visible_camera = False
    return made


def add_camera(frame):
    """Blender derives its projection from an angle and shifts: of a projection matrix only these are used."""
    p = frame["projection"]
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.angle = 2 * math.atan(1 / p[5])
    data.clip_start, data.clip_end = frame["camera"]["near"], frame["camera"]["far"]
    bpy.context.scene.camera = add_object("camera", data, matrix_of(frame["view"]).inverted())


def set_up_output(size):
    render = bpy.context.scene.render
    render.resolution_x, render.resolution_y = size
    render.resolution_percentage = 100
    render.use_persistent_data = True
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGB"
    render.image_settings.color_depth = "32"


def set_up_cycles(options):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.samples = options.samples or 1024
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = 0
    cycles.sample_clamp_direct = cycles.light_sampling_threshold = 0
    cycles.seed = options.seed
    # The narrowest filter that Blender allows keeps all samples within a hundredth of a pixel of the centre.
    cycles.pixel_filter_type = "BOX" if options.pixel == "area" else "GAUSSIAN"
    cycles.filter_width = 0.01


def set_up_eevee(options):
    scene = bpy.context.scene
    scene.render.engine = "BLENDER_EEVEE"
    scene.eevee.taa_render_samples = options.samples or 64
    scene.eevee.shadow_cube_size = options.cube_size
    scene.eevee.shadow_cascade_size = options.cascade_size
    scene.render.filter_size = 0 if options.pixel == "centre" else 1


def cast_shadows(light, occluders, cast):
    if light.type == "LIGHT":
        light.data.use_shadow = cast  # EEVEE
        light.data.cycles.cast_shadow = cast
        light.data.cycles.use_multiple_importance_sampling = False  # every sample goes to the light
    else:  # a mesh that shines has no such switch, and is found by diffuse rays, too
        for occluder in occluders:
            occluder.visible_shadow = occluder.visible_diffuse = cast


def rendered(folder):
    """Red of the render, rows from the bottom."""
    scene = bpy.context.scene
    scene.render.filepath = os.path.join(folder, "render.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    image.colorspace_settings.name = "Non-Color"
    pixels = array.array("f", bytes(4 * image.size[0] * image.size[1] * image.channels))
    image.pixels.foreach_get(pixels)
    red = pixels[::image.channels]
    bpy.data.images.remove(image)
    return red


def render_frame(exported, frame, meshes, options):
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)
    occluders = [add_object(node["name"], meshes[node["mesh"]], matrix_of(node["matrix"])) for node in frame["nodes"]]
    middle, radius = exported.bounds(frame)
    light = add_light(frame["light"], Vector(middle), radius, options.light == "area")
    add_camera(frame)
    with tempfile.TemporaryDirectory() as folder:
        cast_shadows(light, occluders, True)
        lit = rendered(folder)
        cast_shadows(light, occluders, False)
        unshadowed = rendered(folder)
    return array.array("f", (a / b if b > 0 else 0 for a, b in zip(lit, unshadowed)))


def render(words):
    options = read_command_line(words)
    exported = ExportedScene(options.scene)
    frames = exported.frames_named(options.frames)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    meshes = add_meshes(exported)
    set_up_output(exported.size)
    (set_up_cycles if options.engine == "cycles" else set_up_eevee)(options)
    times = []
    for frame in frames:
        before = time.monotonic()
        image = render_frame(exported, frame, meshes, options)
        write_frame(options.out, frame, exported.size, image)
        times.append(f"{1000 * (time.monotonic() - before):.0f}")
    print(f"blender: {len(frames)} frames into {options.out} with {options.engine} of Blender {bpy.app.version_string}; "
          f"ms: {', '.join(times)}", flush=True)


run("blender", render, sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else sys.argv[1:], sys.stdout)
