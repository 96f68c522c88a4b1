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
import numpy
from mathutils import Vector

scene_file, out, samples, seed, width, height = sys.argv[sys.argv.index("--") + 1:]
described = json.loads(Path(scene_file).read_text())
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
SKY_STRENGTH, SUN_STRENGTH = 1.3, 5.0
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
        # Tints each surface, since Cycles has no absorption inside glass.
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


def object_of(name, mesh, material):
    if material:
        mesh.materials.append(material)
    made = bpy.data.objects.new(name, mesh)
    scene.collection.objects.link(made)
    return made


def hull_of(name, points):
    hull = bmesh.new()
    for point in points:
        hull.verts.new(point)
    bmesh.ops.convex_hull(hull, input=hull.verts)
    bmesh.ops.delete(hull, geom=[v for v in hull.verts if not v.link_faces], context="VERTS")
    mesh = bpy.data.meshes.new(name)
    hull.to_mesh(mesh)
    hull.free()
    for polygon in mesh.polygons:
        polygon.use_smooth = True
    mesh.use_auto_smooth, mesh.auto_smooth_angle = True, math.radians(25)
    return mesh


def quads(name, corners):
    """A mesh of squares: (N, 4, 3) corners."""
    mesh, count = bpy.data.meshes.new(name), len(corners)
    mesh.vertices.add(4 * count)
    mesh.vertices.foreach_set("co", corners.ravel())
    mesh.loops.add(4 * count)
    mesh.loops.foreach_set("vertex_index", numpy.arange(4 * count, dtype=numpy.int32))
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", numpy.arange(0, 4 * count, 4, dtype=numpy.int32))
    mesh.polygons.foreach_set("loop_total", numpy.full(count, 4, dtype=numpy.int32))
    mesh.update()
    return mesh


def add_grains(name, about):
    """One instance on each square of a mesh that is not shown: its place, rotation and size."""
    rows = numpy.fromfile(about["file"], dtype=numpy.float32).reshape(-1, 9)
    x, y, z, w = rows[:, 3:7].T
    right = numpy.stack([1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)], 1)
    ahead = numpy.stack([2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)], 1)
    half = rows[:, 7:8] / 2
    corners = numpy.stack([rows[:, :3] + half * (a * right + b * ahead)
                           for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))], 1)
    for number, kind in enumerate(about["materials"]):
        mine = f"{name} {number}"
        places = object_of(mine + " places", quads(mine + " places", corners[rows[:, 8] == number]), None)
        places.instance_type, places.use_instance_faces_scale = "FACES", True
        places.show_instancer_for_render = False
        object_of(mine, hull_of(mine, about["points"]), materials[kind]).parent = places


materials = {about["name"]: material(about) for about in described["materials"]}
for number, thing in enumerate(described["objects"]):
    if "points" in thing:
        mesh = hull_of(str(number), thing["points"])
    else:
        mesh = quads(str(number), numpy.array([[[-50, -50, 0], [50, -50, 0], [50, 50, 0], [-50, 50, 0]]], numpy.float32))
    object_of(str(number), mesh, materials[thing["material"]])
for number, about in enumerate(described.get("particles", [])):
    add_grains(f"grains {number}", about)

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


environment = above = None
for light in described["lights"]:
    if light["type"] == "environment":
        environment = light
        continue
    if light["type"] == "sun_sky":
        above = light
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
if above:  # strengths fitted to Minkray's picture
    air, towards = sky.nodes.new("ShaderNodeTexSky"), Vector(above["sun"]).normalized()
    air.sky_type, air.turbidity, air.sun_direction = "HOSEK_WILKIE", above["turbidity"], towards
    sky.links.new(air.outputs[0], shown)
    sky.nodes["Background"].inputs[1].default_value = SKY_STRENGTH
    lamp = bpy.data.lights.new("sun", "SUN")
    lamp.energy, lamp.angle, lamp.color = SUN_STRENGTH, math.radians(0.53), (1, 0.85, 0.65)
    sun = bpy.data.objects.new("sun", lamp)
    sun.rotation_mode, sun.rotation_quaternion = "QUATERNION", (-towards).to_track_quat("-Z", "Y")
    scene.collection.objects.link(sun)
elif environment:  # cameras see the background instead
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
if about.get("aperture"):
    focus = next(thing for thing in described["objects"] if thing["name"] == about["focus_on"])["transform"]["translate"]
    along = (Vector(about["look_at"]) - Vector(about["position"])).normalized()
    eye.dof.use_dof = True
    eye.dof.focus_distance = along.dot(Vector(focus) - Vector(about["position"]))
    eye.dof.aperture_fstop = eye.lens / 1000 / about["aperture"]

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
