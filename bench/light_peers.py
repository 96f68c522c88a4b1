# SPDX-License-Identifier: MIT
"""The same scene by Minkray, POV-Ray and Blender's Cycles: matt balls and boxes under one light, with
light that is scattered once more, as all of them can. `beside_povray` and `beside_cycles` give rows
(what, asked, measured) of bench/light: the means of both pictures, and the seconds on two
threads for the same error, by the clock and of the processors, each beside its own picture of many samples."""
import array
import json
import math
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

WIDTH, HEIGHT = 240, 160
ALBEDO = {"grey": (0.7, 0.7, 0.7), "red": (0.8, 0.25, 0.2), "blue": (0.2, 0.35, 0.75)}
LIGHT = (-0.5, 0.9, -1.3)  # where it travels
IRRADIANCE = 2.0
EYE, LOOK_AT, FOV_Y = (0.6, -6.5, 3.2), (0, 0, 0.4), 34.0
BOXES = [((0, 0, -0.5), (4, 4, 0.5), "grey"), ((0, 2.2, 1), (4, 0.2, 1.5), "red"),
         ((1.5, 0.4, 0.6), (0.4, 0.5, 0.6), "grey")]
BALLS = [((-1.3, -0.3, 0.7), 0.7, "blue"), ((0.2, 0.6, 0.5), 0.5, "grey"),
         ((0.5, -1.1, 0.35), 0.35, "red")]


def our_scene(file):
    materials = [{"name": name, "type": "lambert", "color": color} for name, color in ALBEDO.items()]
    objects = [{"name": f"box {i}", "shape": {"type": "box", "half_extents": half},
                "material": material, "transform": {"translate": at}}
               for i, (at, half, material) in enumerate(BOXES)]
    objects += [{"name": f"ball {i}", "shape": {"type": "sphere", "radius": radius},
                 "material": material, "transform": {"translate": at}}
                for i, (at, radius, material) in enumerate(BALLS)]
    file.write_text(json.dumps({
        "version": 1, "camera": {"position": EYE, "look_at": LOOK_AT, "fov_y_degrees": FOV_Y},
        "lights": [{"type": "directional", "direction": LIGHT, "color": [IRRADIANCE] * 3}],
        "materials": materials, "objects": objects, "background": [0, 0, 0]}))


def povray_scene(file, radiosity):
    """The same for POV-Ray, in whose left-handed frame y and z change places."""
    def vector(v):
        return f"<{v[0]:.9g},{v[2]:.9g},{v[1]:.9g}>"
    aspect = WIDTH / HEIGHT
    angle = 2 * math.degrees(math.atan(math.tan(math.radians(FOV_Y / 2)) * aspect))
    text = ["#version 3.7;", "global_settings { assumed_gamma 1 ambient_light 0 radiosity {",
            f"  recursion_limit 1 brightness 1 gray_threshold 0 {radiosity} }} }}",
            "background { color rgb 0 }",
            f"camera {{ location {vector(EYE)} sky <0,1,0> right x*{aspect:.9g} angle {angle:.9g} "
            f"look_at {vector(LOOK_AT)} }}",
            # A Lambert surface reflects its colour / pi of the irradiance; POV-Ray leaves pi out.
            f"light_source {{ {vector([-1e4 * x for x in LIGHT])} color rgb {IRRADIANCE / math.pi} "
            "parallel point_at <0,0,0> }"]
    def texture(material):
        return ("texture { pigment { rgb <%g,%g,%g> } finish { ambient 0 emission 0 diffuse 1 } }"
                % ALBEDO[material])
    for at, half, material in BOXES:
        low = [a - h for a, h in zip(at, half)]
        high = [a + h for a, h in zip(at, half)]
        text.append(f"box {{ {vector(low)}, {vector(high)} {texture(material)} }}")
    for at, radius, material in BALLS:
        text.append(f"sphere {{ {vector(at)}, {radius} {texture(material)} }}")
    file.write_text("\n".join(text) + "\n")


def seconds_of(*words):
    """Wall time and processor time of a command; the latter does not depend on other work of the machine."""
    def spent():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return [time.monotonic(), usage.ru_utime + usage.ru_stime]
    begin = spent()
    subprocess.run([str(word) for word in words], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    return [after - before for before, after in zip(begin, spent())]


def render(build, folder, samples, seed=0):
    out = folder / f"ours-{samples}-{seed}.pfm"
    seconds = seconds_of(build / "minkray", "render", folder / "ours.json", "-o", out, "-q",
                    "-r", f"{WIDTH}x{HEIGHT}", "-s", samples, "-t", 2, "--seed", seed,
                    "--integrator", "path", "--max-depth", 2, "--checkpoint", 0)
    return seconds, read_pfm(out)


def povray(folder, name, radiosity, quality):
    scene, out = folder / f"{name}.pov", folder / f"{name}.ppm"
    povray_scene(scene, radiosity)
    seconds = seconds_of("povray", f"+I{scene}", f"+O{out}", "+FP16", f"+W{WIDTH}", f"+H{HEIGHT}", "-D",
                    "-P", "-V", "+WT2", "File_Gamma=1.0", *quality)
    return seconds, read_ppm(out)


def read_pfm(file):
    data = file.read_bytes()
    _, size, _, pixels = data.split(b"\n", 3)
    width, height = map(int, size.split())
    values = array.array("f", pixels)
    rows = [values[3 * width * y:3 * width * (y + 1)] for y in reversed(range(height))]
    return [min(value, 1.0) for row in rows for value in row]


def read_ppm(file):
    """Reads a PPM with 16 bits per number, most significant byte first."""
    data = file.read_bytes()
    words, at = [], 0
    while len(words) < 4:
        end = data.index(b"\n", at)
        words += data[at:end].split(b"#")[0].split()
        at = end + 1
    values = array.array("H", data[at:])
    if sys.byteorder == "little":
        values.byteswap()
    return [value / int(words[3]) for value in values]


def mean(values):
    return math.fsum(values) / len(values)


def error(picture, reference):
    return math.sqrt(mean([(a - b) ** 2 for a, b in zip(picture, reference)]))


def beside_povray(build):
    folder = Path(tempfile.mkdtemp())
    our_scene(folder / "ours.json")
    _, our_reference = render(build, folder, 1024)
    _, their_reference = povray(
        folder, "fine", "count 1600 nearest_count 20 error_bound 0.05 pretrace_end 0.002 "
        "low_error_factor 0.3", ["+A0.01", "+R4", "+AM2"])
    their_seconds, theirs = povray(folder, "usual", "count 100", ["+A0.1", "+R3"])
    return means_beside("POV-Ray", our_reference, their_reference) + seconds_beside(
        build, folder, "POV-Ray", our_reference, their_seconds, error(theirs, their_reference))


def means_beside(name, ours, theirs):
    rows = [(f"mean beside {name}'s, relative difference", "<= 0.01", abs(mean(ours) / mean(theirs) - 1))]
    for channel, colour in enumerate(("red", "green", "blue")):
        rows.append((f"mean of {colour} beside {name}'s", "<= 0.01",
                     abs(mean(ours[channel::3]) / mean(theirs[channel::3]) - 1)))
    return rows


def seconds_beside(build, folder, name, our_reference, their_seconds, their_error):
    """Ours with the fewest samples that it takes, to a sixteenth."""
    def is_enough(samples):
        return error(render(build, folder, samples, seed=1)[1], our_reference) <= their_error
    enough = 1
    while not is_enough(enough):
        enough *= 2
    step = enough // 2
    while step >= max(enough // 16, 1):
        if is_enough(enough - step):
            enough -= step
        step //= 2
    our_seconds, _ = render(build, folder, enough, seed=1)
    return [(f"{kind} for the error of {name} ({their_error:.4f}; {enough} samples) over its {theirs:.2f} s", "<= 1",
             ours / theirs) for kind, ours, theirs in zip(("seconds", "the processors' seconds"), our_seconds,
                                                          their_seconds)]


def beside_cycles(build):
    """Compares with Cycles: seconds of rendering alone for Blender, of the whole program for Minkray."""
    folder = Path(tempfile.mkdtemp())
    our_scene(folder / "ours.json")
    _, our_reference = render(build, folder, 1024)
    scene = folder / "scene.json"
    scene.write_text(json.dumps({
        "size": [WIDTH, HEIGHT], "albedo": ALBEDO, "light": LIGHT, "irradiance": IRRADIANCE, "eye": EYE,
        "look_at": LOOK_AT, "fov_y": FOV_Y, "boxes": BOXES, "balls": BALLS}))
    script = Path(__file__).resolve().with_name("light_cycles.py")

    def cycles(samples, seed):
        out = folder / f"cycles-{samples}-{seed}.pfm"
        done = subprocess.run(["blender", "--background", "--factory-startup", "--threads", "2", "--python-exit-code",
                               "1", "--python", str(script), "--", str(scene), str(out), str(samples), str(seed)],
                              check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        seconds = next([float(word) for word in line.split()[1:]] for line in done.stdout.splitlines()
                       if line.startswith("seconds "))
        return seconds, read_pfm(out)

    _, their_reference = cycles(1024, 0)
    their_seconds, theirs = cycles(64, 1)
    return means_beside("Cycles", our_reference, their_reference) + seconds_beside(
        build, folder, "Cycles with 64 samples", our_reference, their_seconds, error(theirs, their_reference))
