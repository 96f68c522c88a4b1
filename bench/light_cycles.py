# SPDX-License-Identifier: MIT
"""Run by Blender for bench/light: makes the scene of a JSON file, renders it by Cycles on the CPU, and
writes the picture as PFM; prints the seconds that rendering took, by the clock and of the processors.

  blender --background --factory-startup --python bench/light_cycles.py -- SCENE.json OUT.pfm SAMPLES SEED
"""
import array
import json
import math
import sys
import time
from pathlib import Path

import bpy
from mathutils import Vector

scene_file, out, samples, seed = sys.argv[sys.argv.index("--") + 1:]
described = json.loads(Path(scene_file).read_text())
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene


def material(name):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes = made.node_tree.nodes
    nodes.clear()
    matt, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    matt.inputs["Color"].default_value = [*described["albedo"][name], 1]
    made.node_tree.links.new(matt.outputs["BSDF"], output.inputs["Surface"])
    return made


materials = {name: material(name) for name in described["albedo"]}
for at, half, name in described["boxes"]:
    bpy.ops.mesh.primitive_cube_add(size=2, location=at, scale=half)
    bpy.context.object.data.materials.append(materials[name])
for at, radius, name in described["balls"]:
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=6, radius=radius, location=at)
    bpy.ops.object.shade_smooth()
    bpy.context.object.data.materials.append(materials[name])

sun = bpy.data.lights.new("sun", "SUN")
sun.energy, sun.angle = described["irradiance"], 0
lamp = bpy.data.objects.new("sun", sun)
lamp.rotation_mode = "QUATERNION"
lamp.rotation_quaternion = Vector(described["light"]).to_track_quat("-Z", "Y")
scene.collection.objects.link(lamp)

eye = bpy.data.cameras.new("eye")
eye.sensor_fit, eye.angle_y = "VERTICAL", math.radians(described["fov_y"])
eye.angle = math.radians(described["fov_y"])
camera = bpy.data.objects.new("eye", eye)
camera.location = described["eye"]
camera.rotation_mode = "QUATERNION"
towards = Vector(described["look_at"]) - Vector(described["eye"])
camera.rotation_quaternion = towards.to_track_quat("-Z", "Y")
scene.collection.objects.link(camera)
scene.camera = camera

scene.render.engine = "CYCLES"
scene.render.resolution_x, scene.render.resolution_y = described["size"]
scene.render.resolution_percentage = 100
scene.render.threads_mode, scene.render.threads = "FIXED", 2
scene.cycles.device = "CPU"
scene.cycles.samples, scene.cycles.seed = int(samples), int(seed)
scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
# Light that is scattered once more after the first time.
scene.cycles.max_bounces = scene.cycles.diffuse_bounces = 1
scene.cycles.sample_clamp_indirect = 0
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.filepath = out + ".exr"
begin = time.monotonic(), time.process_time()
bpy.ops.render.render(write_still=True)
print("seconds", time.monotonic() - begin[0], time.process_time() - begin[1])

image = bpy.data.images.load(out + ".exr")
image.colorspace_settings.name = "Non-Color"
numbers = array.array("f", image.pixels[:])
colours = array.array("f", (numbers[i] for i in range(len(numbers)) if i % 4 != 3))
width, height = described["size"]
with open(out, "wb") as file:  # rows from the bottom, as Blender has them
    file.write(f"PF\n{width} {height}\n-1.0\n".encode())
    colours.tofile(file)
