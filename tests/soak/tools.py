# SPDX-License-Identifier: MIT
"""Common code of the parts of ./run soak: a folder that is removed afterwards, programs with their
time and peak memory, and pictures as numbers."""
import array
import filecmp
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

source = pathlib.Path(__file__).resolve().parent.parent.parent
minkray = os.environ.get("MINKRAY", str(source / "build/release/minkray"))
cores = len(os.sched_getaffinity(0))


class Failure(Exception):
    """A condition of the soak test does not hold."""


def expect(holds, text):
    if not holds:
        raise Failure(text)


def say(text):
    print(text, flush=True)


started = []


def start(words, **options):
    """A program, in a group of its own, that is killed at the end if it still runs by then."""
    started.append(subprocess.Popen([str(word) for word in words], start_new_session=True, **options))
    return started[-1]


def end_all():
    for process in started:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def main(part, work):
    """Calls work(folder); the exit code is 0 if all held and 1 if not, and either way nothing stays."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    try:
        with tempfile.TemporaryDirectory(prefix="minkray-soak-") as name:
            try:
                work(pathlib.Path(name))
            finally:
                end_all()
    except Failure as failure:
        say(f"soak {part}: FAILED: {failure}")
        sys.exit(1)


def run(*words, expected=0, **options):
    """Runs a program; answers its seconds and its peak of resident memory in MiB."""
    begin = time.monotonic()
    process = start(words, **options)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    expect(process.returncode == expected,
           f"exit code {process.returncode}: {' '.join(map(str, words))}")
    return time.monotonic() - begin, used.ru_maxrss / 1024


def expect_same_bits(a, b):
    expect(filecmp.cmp(a, b, shallow=False), f"{a.name} and {b.name} have other bits")


def numbers_of(picture):
    """All numbers of a PFM file, as floats."""
    with open(picture, "rb") as file:
        kind, size, scale = file.readline(), file.readline(), file.readline()
        expect(kind == b"PF\n" and float(scale) < 0, f"{picture.name} is no PFM of this machine's order")
        width, height = map(int, size.split())
        numbers = array.array("f")
        numbers.fromfile(file, 3 * width * height)
    return numbers


def processes_about(folder):
    """Processes that have the folder's name among their words."""
    found = []
    for words in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if str(folder).encode() in words.read_bytes():
                found.append(int(words.parent.name))
        except OSError:
            pass  # it has ended
    return found
