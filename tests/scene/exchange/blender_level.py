"""Makes blender_level.glb and, of the same scene, what Blender itself says of it, as blender_level.json (metres, +y up):
    blender --background --factory-startup --python tests/scene/exchange/blender_level.py
"""
import json
import math
import os

import bpy
from mathutils import Vector

FOLDER = os.path.dirname(os.path.abspath(__file__))


def material(name, colour):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (*colour, 1)
    return made


def link(name, data, parent=None, location=(0, 0, 0), turn=(0, 0, 0), scale=(1, 1, 1)):
    made = bpy.data.objects.new(name, data)
    made.location, made.scale = location, scale
    made.rotation_euler = [math.radians(angle) for angle in turn]
    made.parent = parent
    bpy.context.scene.collection.objects.link(made)
    return made


def shape(name, add, materials, **sizes):
    """The mesh that the operator `add` makes; its faces take the materials in turn."""
    add(**sizes)
    made = bpy.context.object
    mesh = made.data
    bpy.data.objects.remove(made)
    mesh.name = name
    for one in materials:
        mesh.materials.append(one)
    for number, face in enumerate(mesh.polygons):
        face.material_index = number % len(materials)
    return mesh


def build():
    red, grey, green = material("red", (0.8, 0.1, 0.1)), material("grey", (0.5, 0.5, 0.5)), material("green", (0.1, 0.6, 0.2))
    add = bpy.ops.mesh
    box = shape("Box", add.primitive_cube_add, [red, grey], size=1)
    ball = shape("Ball", add.primitive_uv_sphere_add, [green, grey], segments=12, ring_count=6, radius=0.5)
    cone = shape("Cone", add.primitive_cone_add, [red, green], vertices=5, radius1=0.5, radius2=0.2, depth=1)
    room = link("Room", None, turn=(0, 0, 25), scale=(1, 1.5, 1))
    link("Ground", shape("Ground", add.primitive_plane_add, [grey], size=8))
    table = link("Table", box, room, location=(0.3, 0.2, 1), turn=(0, 0, 15), scale=(2, 1, 0.2))
    link("Leg", box, table, location=(0.3, 0.2, -2.52), scale=(0.1, 0.15, 4.2))
    link("Ball", ball, table, location=(-0.25, 0.1, 2.4), scale=(0.3, 0.5, 3))
    link("Stone", ball, location=(-1.7, -1.1, 0.45))
    link("Mirrored", cone, room, location=(1.9, 0.3, 0.49), turn=(0, 0, 40), scale=(-1, 1, 1))
    camera = bpy.data.cameras.new("Entrance")
    camera.sensor_fit, camera.angle = "VERTICAL", math.radians(40)
    camera.clip_start, camera.clip_end = 0.1, 60
    link("Entrance", camera, location=(4, -7, 4), turn=(64, 0, 30))
    link("Above", bpy.data.cameras.new("Above"), location=(0, 0, 12))
    link("Lamp", bpy.data.lights.new("Lamp", "POINT"), location=(1.2, -1.5, 5))
    link("Sun", bpy.data.lights.new("Sun", "SUN"), turn=(30, 20, 0))
    bpy.context.scene.camera = bpy.data.objects["Entrance"]
    bpy.context.scene.render.resolution_x, bpy.context.scene.render.resolution_y = 480, 320


def y_up(v):
    return [v.x, v.z, -v.y]


def facts():
    """Of each mesh and material the triangles and the corners of the box around them in the world."""
    bpy.context.view_layer.update()
    parts = {}
    for one in bpy.context.scene.objects:
        if one.type != "MESH":
            continue
        one.data.calc_loop_triangles()
        for index, of in enumerate(one.data.materials):
            corners = [y_up(one.matrix_world @ one.data.vertices[v].co)
                       for t in one.data.loop_triangles if t.material_index == index for v in t.vertices]
            parts[f"{one.name}/{of.name}"] = {
                "colour": list(of.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value)[:3],
                "triangles": len(corners) // 3,
                "low": [min(c[k] for c in corners) for k in range(3)],
                "high": [max(c[k] for c in corners) for k in range(3)]}
    camera, sun = bpy.data.objects["Entrance"], bpy.data.objects["Sun"]
    down = Vector((0, 0, -1))
    return {"parts": parts, "eye": y_up(camera.matrix_world.translation),
            "forward": y_up(camera.matrix_world.to_3x3() @ down), "fovy": math.degrees(camera.data.angle_y),
            "lamp": y_up(bpy.data.objects["Lamp"].matrix_world.translation),
            "sun": y_up(sun.matrix_world.to_3x3() @ down)}


bpy.ops.wm.read_factory_settings(use_empty=True)
build()
with open(os.path.join(FOLDER, "blender_level.json"), "w", encoding="utf-8") as stream:
    json.dump(facts(), stream, indent=1)
    stream.write("\n")
bpy.ops.export_scene.gltf(filepath=os.path.join(FOLDER, "blender_level.glb"), export_format="GLB", export_cameras=True,
                          export_lights=True, export_texcoords=False)
