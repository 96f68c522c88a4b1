# SPDX-License-Identifier: MIT
"""Makes a wheel of the Python module with CMake: a build backend as PEP 517 wants it.

The wheel has all that the module needs but the C and C++ run-time libraries: the shared libraries are in it under
names of their own, and are found there. It also has the command line, which ``python -m minkray`` runs.

Settings: ``build-dir`` names a folder that CMake has configured already, else build/wheel is. ``programs=no`` leaves
the command line out, for folders whose programs are linked with MPI.
"""
import base64
import hashlib
import os
import platform
import re
import shutil
import stat
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

from elf_file import ElfFile

SOURCES = os.path.abspath(os.path.join(os.path.dirname(__file__), "../../.."))
SUMMARY = "Rays, proofs and distances of exact convex shapes"
EPOCH = (1980, 1, 1, 0, 0, 0)  # the same files make the same wheel
PROGRAMS = ["minkray", "minkray-tools", "minkray-inspect"]
# What every system with a C++ program has (PEP 600): these stay outside.
OF_SYSTEM = re.compile(r"(ld-linux-|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+|z)\.so)")


def _version():
    with open(os.path.join(SOURCES, "CMakeLists.txt")) as file:
        return re.search(r"project\(minkray VERSION ([0-9.]+)", file.read()).group(1)


def _metadata():
    with open(os.path.join(SOURCES, "docs/python.md"), encoding="utf-8") as file:
        description = file.read()
    return (f"Metadata-Version: 2.1\nName: minkray\nVersion: {_version()}\nSummary: {SUMMARY}\nLicense: MIT\n"
            f"Requires-Python: >=3.9\nRequires-Dist: numpy\nDescription-Content-Type: text/markdown\n\n{description}")


def _built(config_settings, targets):
    """The folder of a build that has the module."""
    folder = os.path.abspath(config_settings.get("build-dir") or os.path.join(SOURCES, "build/wheel"))
    if not os.path.exists(os.path.join(folder, "CMakeCache.txt")):
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        subprocess.run(["cmake", "-S", SOURCES, "-B", folder, *generator, "-DCMAKE_BUILD_TYPE=Release",
                        "-DMINKRAY_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}", "-DMINKRAY_TESTS=OFF",
                        "-DMINKRAY_BENCH=OFF", "-DMINKRAY_MPI=OFF", "-DCMAKE_BUILD_RPATH=$ORIGIN/../lib"],
                       check=True, stdout=sys.stderr)
    subprocess.run(["cmake", "--build", folder, "--target", *targets], check=True, stdout=sys.stderr)
    return folder


def _scenes():
    """The scenes that come with Minkray, as an installation has them."""
    folder = os.path.join(SOURCES, "scenes")
    return {f"minkray/share/minkray/scenes/{name}": os.path.join(folder, name)
            for part in ("", "parts/") for name in (part + of_part for of_part in os.listdir(os.path.join(folder, part)))
            if name.endswith((".json", ".csv"))}


def _files(folder, programs):
    """Names within the wheel, and what they are."""
    module = os.path.join(folder, "python/minkray")
    files = {f"minkray/{name}": os.path.join(module, name) for name in os.listdir(module)
             if name.endswith((".py", ".pyi", "py.typed", sysconfig.get_config_var("EXT_SUFFIX")))}
    major = _version().split(".")[0]
    files[f"minkray/lib/libminkray.so.{major}"] = os.path.join(folder, f"libminkray.so.{major}")
    if programs:
        files.update({f"minkray/bin/{name}": os.path.join(folder, name) for name in programs}, **_scenes())
    return files


def _stripped(file):
    """Content of a file; programs and libraries are stripped of unused symbol names."""
    with open(file, "rb") as data:
        contents = data.read()
    if contents[:4] != b"\x7fELF" or not shutil.which("strip"):
        return contents
    with tempfile.TemporaryDirectory() as folder:
        copy = shutil.copyfile(os.path.realpath(file), os.path.join(folder, "copy"))
        subprocess.run(["strip", "--strip-unneeded", copy], check=True)
        with open(copy, "rb") as data:
            return data.read()


def _places(file):
    """Where the libraries are that a file and its libraries need, by name."""
    lines = subprocess.run(["ldd", file], check=True, capture_output=True, text=True).stdout
    return dict(re.findall(r"^\s*(\S+) => (/\S+)", lines, re.MULTILINE))


def _licence_of(library):
    """The terms of a library that comes from a Debian package, and the name of that; else nothing."""
    for file in {library, os.path.realpath(library), os.path.realpath(library).replace("/usr/", "/", 1)}:
        found = subprocess.run(["dpkg-query", "-S", file], capture_output=True, text=True) if shutil.which(
            "dpkg-query") else None
        if found and found.returncode == 0:
            package = found.stdout.split(":")[0]
            terms = f"/usr/share/doc/{package}/copyright"
            if os.path.exists(terms):
                return package, terms
    return None


def _standing_alone(files, info):
    """The contents of the files with all libraries that they need, which get names that no other library has."""
    contents = {at: _stripped(file) for at, file in sorted(files.items())}
    own = {os.path.basename(at) for at in files}
    open_files = [file for at, file in files.items() if contents[at][:4] == b"\x7fELF"]
    names, libraries = {}, {}
    for file in open_files:
        for name, place in _places(file).items():
            if name not in own and not OF_SYSTEM.match(name):
                names[name] = "mk_" + name[3:]
                libraries[f"minkray/lib/{names[name]}"] = place
    for at, place in sorted(libraries.items()):
        contents[at] = _stripped(place)
        if licence := _licence_of(place):
            contents[f"{info}/licenses/{licence[0]}"] = _stripped(licence[1])
    versions = []
    for at, data in contents.items():
        if data[:4] != b"\x7fELF":
            continue
        elf = ElfFile(data)
        elf.rename(names)
        folder = os.path.dirname(at)
        path = os.path.relpath("minkray/lib", folder)
        if elf.has_path():
            elf.set_path("$ORIGIN" if path == "." else f"$ORIGIN/{path}")
        elif folder == "minkray/bin":
            raise ValueError(f"{at}: must look for libraries in $ORIGIN/../lib: configure with "
                             "-DCMAKE_BUILD_RPATH='$ORIGIN/../lib' (got no such place)")
        contents[at] = bytes(elf.data)
        versions += elf.versions("GLIBC")
    return contents, max(versions)[:2]


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    settings = config_settings or {}
    programs = [] if settings.get("programs") == "no" else PROGRAMS
    folder = _built(settings, ["minkray_python", *programs])
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    info = f"minkray-{_version()}.dist-info"
    contents, (major, minor) = _standing_alone(_files(folder, programs), info)
    # Systems whose C library is as new as the newest function that is used.
    tag = f"{python}-{python}-manylinux_{major}_{minor}_" + re.sub("[-.]", "_", platform.machine())
    name = f"minkray-{_version()}-{tag}.whl"
    contents[f"{info}/METADATA"] = _metadata().encode()
    contents[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: minkray {_version()}\n"
                                 f"Root-Is-Purelib: false\nTag: {tag}\n").encode()
    if programs:
        contents[f"{info}/entry_points.txt"] = b"[console_scripts]\nminkray = minkray.__main__:main\n"
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
            entry.external_attr = (stat.S_IFREG | (0o755 if data[:4] == b"\x7fELF" else 0o644)) << 16
            wheel.writestr(entry, data)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """Sources in git."""
    name = f"minkray-{_version()}"
    with tempfile.TemporaryDirectory() as folder:
        info = os.path.join(folder, "PKG-INFO")
        with open(info, "w", encoding="utf-8") as file:
            file.write(_metadata())
        subprocess.run(["git", "-C", SOURCES, "archive", f"--prefix={name}/", f"--add-file={info}", "HEAD",
                        "-o", os.path.abspath(os.path.join(sdist_directory, name + ".tar.gz"))], check=True)
    return name + ".tar.gz"
