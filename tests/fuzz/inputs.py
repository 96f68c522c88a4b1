#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Keeps the inputs of each fuzz target in one file, tests/fuzz/inputs/TARGET.json:

  inputs.py add TARGET FILE NAME       a finding, to be replayed by the suite from now on
  inputs.py add --corpus TARGET FILE NAME    an input for fuzzing to begin with
  inputs.py unpack FOLDER [TARGET...]  each input as a file FOLDER/KIND/TARGET/NAME

The file has an object for each kind, corpus and findings, with an input per name: a text as the list of
its lines, anything else as a string of base64.
"""
import argparse
import base64
import json
import os
import pathlib
import re
import shutil
import sys

PACKED = pathlib.Path(__file__).resolve().parent / "inputs"
KINDS = ("corpus", "findings")


def is_readable(text):
    """Text may begin with a byte that selects a format, so a few control characters are no harm."""
    controls = sum(1 for c in text if ord(c) < 32 and c not in "\t\r\n" or ord(c) == 127)
    return 20 * controls <= len(text)


def packed(content):
    try:
        text = content.decode()
    except UnicodeDecodeError:
        text = None
    if text is not None and is_readable(text):
        return text.split("\n")
    return base64.b64encode(content).decode()


def unpacked(item):
    return "\n".join(item).encode() if isinstance(item, list) else base64.b64decode(item, validate=True)


def file_of(target):
    return PACKED / f"{target}.json"


def read(target):
    try:
        inputs = json.loads(file_of(target).read_text(encoding="utf-8"))
    except FileNotFoundError:
        targets = ", ".join(sorted(path.stem for path in PACKED.glob("*.json")))
        sys.exit(f"inputs.py: target: must be one of {targets} (got {target})")
    return {kind: {name: unpacked(item) for name, item in inputs[kind].items()} for kind in KINDS}


def write(target, inputs):
    content = {kind: {name: packed(inputs[kind][name]) for name in sorted(inputs[kind])} for kind in KINDS}
    temporary = file_of(target).with_suffix(".part")
    temporary.write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    os.replace(temporary, file_of(target))


def add(target, file, name, kind):
    inputs = read(target)
    try:
        content = pathlib.Path(file).read_bytes()
    except OSError as error:
        sys.exit(f"inputs.py: {file}: {error.strerror}")
    if not re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9_.-]*", name):
        sys.exit(f"inputs.py: name: must be of letters, digits, _, . and - (got {name!r})")
    for known in KINDS:
        if name in inputs[known]:
            sys.exit(f"inputs.py: {target} has an input {known}/{name} already")
        for other, there in inputs[known].items():
            if there == content:
                sys.exit(f"inputs.py: {target} has these bytes already: {known}/{other}")
    inputs[kind][name] = content
    write(target, inputs)


def unpack(folder, targets):
    for target in targets or sorted(path.stem for path in PACKED.glob("*.json")):
        for kind, inputs in read(target).items():
            place = pathlib.Path(folder) / kind / target
            shutil.rmtree(place, ignore_errors=True)
            place.mkdir(parents=True)
            for name, content in inputs.items():
                (place / name).write_bytes(content)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    adding = commands.add_parser("add", help="add an input")
    adding.add_argument("--corpus", action="store_true", help="an input to begin with, not a finding")
    for argument in ("target", "file", "name"):
        adding.add_argument(argument)
    unpacking = commands.add_parser("unpack", help="write each input to a file of its own")
    unpacking.add_argument("folder")
    unpacking.add_argument("targets", nargs="*", metavar="target")
    given = parser.parse_args()
    if given.command == "add":
        add(given.target, given.file, given.name, KINDS[0] if given.corpus else KINDS[1])
    else:
        unpack(given.folder, given.targets)


if __name__ == "__main__":
    main()
