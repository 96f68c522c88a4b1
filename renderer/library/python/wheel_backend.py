# SPDX-License-Identifier: MIT
"""Makes a wheel of the Python module with CMake: a build backend as PEP 517 wants it.

The setting ``build-dir`` names a folder that CMake has configured already; else build/wheel is. The shared
library goes into the wheel, what that needs (oneTBB, OpenEXR, Qhull, tinyxml2) does not.
"""
import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

SOURCES = os.path.abspath(os.path.join(os.path.dirname(__file__), "../../.."))
SUMMARY = "Rays, proofs and distances of exact convex shapes"
EPOCH = (1980, 1, 1, 0, 0, 0)  # the same files make the same wheel


def _version():
    with open(os.path.join(SOURCES, "CMakeLists.txt")) as file:
        return re.search(r"project\(minkray VERSION ([0-9.]+)", file.read()).group(1)


def _metadata():
    with open(os.path.join(SOURCES, "docs/library.md"), encoding="utf-8") as file:
        description = file.read()
    return (f"Metadata-Version: 2.1\nName: minkray\nVersion: {_version()}\nSummary: {SUMMARY}\nLicense: MIT\n"
            f"Requires-Python: >=3.9\nRequires-Dist: numpy\nDescription-Content-Type: text/markdown\n\n{description}")


def _built(config_settings):
    """The folder of a build that has the module."""
    folder = os.path.abspath((config_settings or {}).get("build-dir") or os.path.join(SOURCES, "build/wheel"))
    if not os.path.exists(os.path.join(folder, "CMakeCache.txt")):
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        subprocess.run(["cmake", "-S", SOURCES, "-B", folder, *generator, "-DCMAKE_BUILD_TYPE=Release",
                        "-DMINKRAY_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}", "-DMINKRAY_TESTS=OFF",
                        "-DMINKRAY_BENCH=OFF", "-DMINKRAY_MPI=OFF"], check=True, stdout=sys.stderr)
    subprocess.run(["cmake", "--build", folder, "--target", "minkray_python"], check=True, stdout=sys.stderr)
    return folder


def _files(folder):
    """Names within the wheel, and what they are."""
    module = os.path.join(folder, "python/minkray")
    files = {f"minkray/{name}": os.path.join(module, name) for name in os.listdir(module)
             if name.endswith((".py", ".pyi", "py.typed", sysconfig.get_config_var("EXT_SUFFIX")))}
    major = _version().split(".")[0]
    files[f"minkray/libminkray.so.{major}"] = os.path.join(folder, f"libminkray.so.{major}")
    return files


def _stripped(file):
    with tempfile.TemporaryDirectory() as folder:
        copy = shutil.copyfile(os.path.realpath(file), os.path.join(folder, "copy"))
        if ".so" in os.path.basename(file) and shutil.which("strip"):
            subprocess.run(["strip", "--strip-unneeded", copy], check=True)
        with open(copy, "rb") as data:
            contents = data.read()
    # In the build it is looked for elsewhere, too; an empty place would be the working folder.
    return re.sub(rb"\$ORIGIN:[$A-Z/.:]*", lambda path: b"$ORIGIN".ljust(len(path.group()), b"\0"), contents)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    folder = _built(config_settings)
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-" + re.sub("[-.]", "_", sysconfig.get_platform())
    info = f"minkray-{_version()}.dist-info"
    name = f"minkray-{_version()}-{tag}.whl"
    contents = {at: _stripped(file) for at, file in sorted(_files(folder).items())}
    contents[f"{info}/METADATA"] = _metadata().encode()
    contents[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: minkray {_version()}\n"
                                 f"Root-Is-Purelib: false\nTag: {tag}\n").encode()
    with open(os.path.join(SOURCES, "LICENSE"), "rb") as file:
        contents[f"{info}/LICENSE"] = file.read()
    record = ""
    for at, data in contents.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{at},sha256={digest},{len(data)}\n"
    contents[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    with zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for at, data in contents.items():
            entry = zipfile.ZipInfo(at, EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if ".so" in at else 0o644) << 16
            wheel.writestr(entry, data)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """What git has of the sources."""
    name = f"minkray-{_version()}"
    with tempfile.TemporaryDirectory() as folder:
        info = os.path.join(folder, "PKG-INFO")
        with open(info, "w", encoding="utf-8") as file:
            file.write(_metadata())
        subprocess.run(["git", "-C", SOURCES, "archive", f"--prefix={name}/", f"--add-file={info}", "HEAD",
                        "-o", os.path.abspath(os.path.join(sdist_directory, name + ".tar.gz"))], check=True)
    return name + ".tar.gz"
