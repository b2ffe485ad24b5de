"""Renders an exported scene with VTK, its shadow code unmodified: a white diffuse scene twice, with vtkShadowMapPass and
without. What is written is the quotient. Started by clients/vtk/render."""
import array
import math
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python"))
sys.dont_write_bytecode = True  # the folder stays as it was
from exported_scene import BadInput, ExportedScene  # noqa: E402
from renderer import Parser, run, write_frame  # noqa: E402

try:
    import vtk
except ImportError:  # --help needs none of it
    vtk = None


def read_command_line(words):
    parser = Parser("vtk")
    parser.add_argument("--map-size", type=int, default=1024, choices=[2 ** k for k in range(6, 14)],
                        help="vtkShadowMapBakerPass's resolution")
    return parser.parse_args(words)


def make_mapper(vertices, triangles):
    points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
    for vertex in vertices:
        points.InsertNextPoint(vertex)
    for triangle in triangles:
        cells.InsertNextCell(3, triangle)
    mesh = vtk.vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(cells)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(mesh)
    return mapper


def matrix_of(numbers):
    matrix = vtk.vtkMatrix4x4()
    matrix.DeepCopy([numbers[4 * column + row] for row in range(4) for column in range(4)])
    return matrix


def add_actors(renderer, frame, mappers):
    for node in frame["nodes"]:
        actor = vtk.vtkActor()
        actor.SetMapper(mappers[node["mesh"]])
        actor.SetUserMatrix(matrix_of(node["matrix"]))
        actor.GetProperty().SetInterpolationToFlat()
        renderer.AddActor(actor)


def make_light(light, exported, frame):
    """A direction, or a spot light that is as wide as the frame is from there: VTK has no shadows of point lights."""
    made = vtk.vtkLight()
    made.SetLightTypeToSceneLight()
    middle, radius = exported.bounds(frame)
    if light["kind"] == "environment":
        raise BadInput("no shadow map is of an environment light; choose another scene")
    made.SetFocalPoint(middle)
    if light["kind"] == "directional":
        made.SetPosition([m - radius * d for m, d in zip(middle, light["direction"])])
        return made
    angle = math.degrees(exported.angle_from(frame, light["centre"]))
    if angle > 85:
        raise BadInput(f"the scene is {2 * angle:.0f} degrees wide, seen from the light: too much for the one map of a spot light")
    made.PositionalOn()
    made.SetPosition(light["centre"])
    made.SetConeAngle(1.01 * angle)
    return made


def set_up_camera(renderer, frame):
    described = frame["camera"]
    camera = renderer.GetActiveCamera()
    camera.SetPosition(described["eye"])
    camera.SetFocalPoint(described["target"])
    camera.SetViewUp(described["up"])
    camera.SetClippingRange(described["near"], described["far"])
    camera.SetExplicitProjectionTransformMatrix(matrix_of(frame["projection"]))
    camera.UseExplicitProjectionTransformMatrixOn()


def shadow_pass(map_size):
    """As the engine's example TestShadowMapPass has it."""
    shadows = vtk.vtkShadowMapPass()
    shadows.GetShadowMapBakerPass().SetResolution(map_size)
    passes = vtk.vtkRenderPassCollection()
    passes.AddItem(shadows.GetShadowMapBakerPass())
    passes.AddItem(shadows)
    sequence = vtk.vtkSequencePass()
    sequence.SetPasses(passes)
    camera = vtk.vtkCameraPass()
    camera.SetDelegatePass(sequence)
    return camera


def drawn(window):
    """Red of the window, rows from the bottom, 0 to 255."""
    window.Render()
    pixels = vtk.vtkUnsignedCharArray()
    width, height = window.GetSize()
    window.GetPixelData(0, 0, width - 1, height - 1, 0, pixels, 0)
    return memoryview(pixels).tobytes()[::3]


def render_frame(window, exported, frame, mappers, map_size):
    renderer = vtk.vtkRenderer()
    renderer.AutomaticLightCreationOff()
    light = make_light(frame["light"], exported, frame)
    renderer.AddLight(light)
    add_actors(renderer, frame, mappers)
    window.AddRenderer(renderer)
    set_up_camera(renderer, frame)
    renderer.SetPass(shadow_pass(map_size))
    lit = drawn(window)
    light.SetShadowAttenuation(0)
    unshadowed = drawn(window)
    renderer.ReleaseGraphicsResources(window)
    window.RemoveRenderer(renderer)
    return array.array("f", (a / b if b > 0 else 0 for a, b in zip(lit, unshadowed)))


def render(words):
    options = read_command_line(words)
    if vtk is None:
        raise BadInput("VTK is missing; run clients/vtk/setup")
    exported = ExportedScene(options.scene)
    frames = exported.frames_named(options.frames)
    mappers = {name: make_mapper(*mesh) for name, mesh in exported.meshes.items()}
    window = vtk.vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetMultiSamples(0)
    window.SetSize(exported.size)
    times = []
    for frame in frames:
        before = time.monotonic()
        image = render_frame(window, exported, frame, mappers, options.map_size)
        write_frame(options.out, frame, exported.size, image)
        times.append(f"{1000 * (time.monotonic() - before):.0f}")
    print(f"vtk: {len(frames)} frames into {options.out} with VTK {vtk.vtkVersion().GetVTKVersion()}; ms: {', '.join(times)}")


run("vtk", render, sys.argv[1:])
