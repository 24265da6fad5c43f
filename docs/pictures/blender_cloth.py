"""Imports a PLY state into Blender, says what arrived, and renders its faces: blender_cloth.py STATE PICTURE

Runs with the module bpy (pip install bpy), or in Blender: blender --background --python blender_cloth.py -- STATE PICTURE
"""

import math
import sys

import bpy

name, out = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
# As they stand in the file: z is up there, and in Blender.
bpy.ops.wm.ply_import(filepath=name, forward_axis="Y", up_axis="Z", import_attributes=True)
cloth = bpy.context.selected_objects[0]
mesh = cloth.data
attributes = ", ".join(sorted(one.name for one in mesh.attributes if one.domain == "POINT"))
print(f"{len(mesh.vertices)} vertices, {len(mesh.edges)} edges, {len(mesh.polygons)} faces; attributes {attributes}")

for polygon in mesh.polygons:
    polygon.use_smooth = True
material = bpy.data.materials.new("cloth")
material.use_nodes = True
material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.45, 0.03, 0.03, 1)
material.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.8
mesh.materials.clear()
mesh.materials.append(material)

scene = bpy.context.scene
world = bpy.data.worlds.new("world")
world.use_nodes = True
world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.9
scene.world = world
lamp = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
lamp.data.energy = 2
lamp.rotation_euler = (math.radians(50), 0, math.radians(30))
scene.collection.objects.link(lamp)
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location = (0.85, -1.7, 0.9)
scene.collection.objects.link(camera)
target = bpy.data.objects.new("target", None)
target.location = (0, 0, 0.05)
scene.collection.objects.link(target)
track = camera.constraints.new("TRACK_TO")
track.target = target
scene.camera = camera

scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.samples = 48
scene.view_settings.view_transform = "Standard"
scene.render.resolution_x, scene.render.resolution_y = 640, 480
scene.render.filepath = out
bpy.ops.render.render(write_still=True)
