# SPDX-License-Identifier: MIT
"""Run by Blender for bench/light_scenes: renders a scene of points' hulls by Cycles on the CPU, writes the picture as
PFM, and prints the processors' seconds that rendering took.

  blender --background --factory-startup --python bench/light_scenes_cycles.py -- SCENE.json OUT.pfm SAMPLES SEED W H
"""
import array
import json
import math
import sys
import time
from pathlib import Path

import bmesh
import bpy
from mathutils import Vector

scene_file, out, samples, seed, width, height = sys.argv[sys.argv.index("--") + 1:]
described = json.loads(Path(scene_file).read_text())
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
METALS = {"copper": (0.955, 0.638, 0.538), "gold": (1.0, 0.766, 0.336), "chromium": (0.55, 0.556, 0.554)}


def reflected_by_base(albedo, ior):
    """Light that comes back through a coat: its mean reflectance from outside, and from inside (Egan and Hilgeman)."""
    outside = {1.5: 0.092, 1.7: 0.122}.get(ior, 0.092)
    inside = 1 - (1 - outside) / ior ** 2
    return albedo * (1 - inside) * (1 - outside) / (1 - albedo * inside)


def material(about):
    made = bpy.data.materials.new(about["name"])
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()

    def node(kind, color=None, **inputs):
        new = tree.nodes.new(kind)
        if hasattr(new, "distribution"):
            new.distribution = "GGX"
        if color is not None:
            new.inputs["Color"].default_value = [*color, 1]
        for name, value in inputs.items():
            new.inputs[name].default_value = value
        return new
    kind, roughness = about["type"], about.get("roughness", 0.1)
    color = about.get("color", [0.7] * 3)
    color = color if isinstance(color, list) else [0.5] * 3  # of a texture
    if kind == "lambert":
        surface = node("ShaderNodeBsdfDiffuse", color)
    elif kind == "glossy":
        ior = about.get("index_of_refraction", 1.5)
        surface = node("ShaderNodeMixShader")
        parts = (node("ShaderNodeFresnel", IOR=ior),
                 node("ShaderNodeBsdfDiffuse", [reflected_by_base(x, ior) for x in color]),
                 node("ShaderNodeBsdfGlossy", (1, 1, 1), Roughness=roughness))
        for place, part in enumerate(parts):
            tree.links.new(part.outputs[0], surface.inputs[place])
    elif kind == "emissive":
        brightest = max(about["radiance"])
        surface = node("ShaderNodeEmission", [x / brightest for x in about["radiance"]], Strength=brightest)
    elif kind == "dielectric":
        # A tint at each surface in place of absorption within.
        tint = [math.exp(-0.15 * x) for x in about.get("absorption", (0, 0, 0))]
        surface = node("ShaderNodeBsdfGlass", tint, IOR=about.get("index_of_refraction", 1.5),
                       Roughness=about.get("roughness", 0))
    elif kind == "conductor":
        surface = node("ShaderNodeBsdfGlossy", METALS.get(about.get("metal"), color), Roughness=roughness)
    else:
        surface = tree.nodes.new("ShaderNodeBsdfPrincipled")
        surface.inputs["Base Color"].default_value = [*color, 1]
        surface.inputs["Roughness"].default_value = about.get("roughness", 0.5)
        surface.inputs["Metallic"].default_value = about.get("metallic", 0)
    tree.links.new(surface.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return made


materials = {about["name"]: material(about) for about in described["materials"]}
for number, thing in enumerate(described["objects"]):
    hull = bmesh.new()
    for point in thing["points"]:
        hull.verts.new(point)
    bmesh.ops.convex_hull(hull, input=hull.verts)
    bmesh.ops.delete(hull, geom=[v for v in hull.verts if not v.link_faces], context="VERTS")
    mesh = bpy.data.meshes.new(str(number))
    hull.to_mesh(mesh)
    hull.free()
    for polygon in mesh.polygons:
        polygon.use_smooth = True
    mesh.use_auto_smooth, mesh.auto_smooth_angle = True, math.radians(25)
    mesh.materials.append(materials[thing["material"]])
    scene.collection.objects.link(bpy.data.objects.new(str(number), mesh))

scene.world = bpy.data.worlds.new("world")
scene.world.use_nodes = True
sky = scene.world.node_tree


def gradient(zenith, nadir):
    place, parts = sky.nodes.new("ShaderNodeTexCoord"), sky.nodes.new("ShaderNodeSeparateXYZ")
    up, mixed = sky.nodes.new("ShaderNodeMath"), sky.nodes.new("ShaderNodeMixRGB")
    up.operation = "MULTIPLY_ADD"
    up.inputs[1].default_value = up.inputs[2].default_value = 0.5
    mixed.inputs[1].default_value, mixed.inputs[2].default_value = [*nadir, 1], [*zenith, 1]
    sky.links.new(place.outputs["Generated"], parts.inputs[0])
    sky.links.new(parts.outputs[2], up.inputs[0])
    sky.links.new(up.outputs[0], mixed.inputs[0])
    return mixed.outputs[0]


environment = None
for light in described["lights"]:
    if light["type"] == "environment":
        environment = light
        continue
    lamp = bpy.data.lights.new("sun", "SUN")
    lamp.energy, lamp.angle, lamp.color = light.get("intensity", 1), 0, light["color"]
    sun = bpy.data.objects.new("sun", lamp)
    sun.rotation_mode = "QUATERNION"
    sun.rotation_quaternion = Vector(light["direction"]).to_track_quat("-Z", "Y")
    scene.collection.objects.link(sun)
behind = described.get("background", [0, 0, 0])
behind = (behind["zenith"], behind["nadir"]) if isinstance(behind, dict) else (behind, behind)
shown = sky.nodes["Background"].inputs[0]
if environment:  # cameras see the background instead
    path, either = sky.nodes.new("ShaderNodeLightPath"), sky.nodes.new("ShaderNodeMixRGB")
    sky.links.new(path.outputs["Is Camera Ray"], either.inputs[0])
    sky.links.new(gradient(environment["zenith"], environment["nadir"]), either.inputs[1])
    sky.links.new(gradient(*behind), either.inputs[2])
    sky.links.new(either.outputs[0], shown)
else:
    shown.default_value = [*behind[0], 1]

about = described["camera"]
eye = bpy.data.cameras.new("eye")
eye.sensor_fit, eye.angle = "VERTICAL", math.radians(about["fov_y_degrees"])
camera = bpy.data.objects.new("eye", eye)
camera.location, camera.rotation_mode = about["position"], "QUATERNION"
camera.rotation_quaternion = (Vector(about["look_at"]) - Vector(about["position"])).to_track_quat("-Z", "Y")
scene.collection.objects.link(camera)
scene.camera = camera

scene.render.engine = "CYCLES"
scene.render.resolution_x, scene.render.resolution_y = int(width), int(height)
scene.render.resolution_percentage = 100
scene.render.threads_mode, scene.render.threads = "FIXED", 2
cycles = scene.cycles
cycles.device = "CPU"
cycles.samples, cycles.seed = int(samples), int(seed)
cycles.use_adaptive_sampling = cycles.use_denoising = False
cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 16
cycles.sample_clamp_indirect = cycles.blur_glossy = 0
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.filepath = out + ".exr"
begin = time.process_time()
bpy.ops.render.render(write_still=True)
print("seconds", time.process_time() - begin)

image = bpy.data.images.load(out + ".exr")
image.colorspace_settings.name = "Non-Color"
numbers = array.array("f", image.pixels[:])
with open(out, "wb") as file:  # rows from the bottom, as Blender has them
    file.write(f"PF\n{width} {height}\n-1.0\n".encode())
    array.array("f", (numbers[i] for i in range(len(numbers)) if i % 4 != 3)).tofile(file)
