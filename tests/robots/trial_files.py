#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Loads every robot's file under a folder and prints what came of it: ./run trial-files DIR."""
import argparse
import collections
import concurrent.futures
import os
import re
import subprocess
import sys

ENDINGS = ('.urdf', '.sdf', '.world', '.model', '.xml', '.mjcf', '.gltf', '.glb', '.xacro')
ROOTS = {'robot': 'URDF', 'sdf': 'SDF', 'gazebo': 'SDF', 'mujoco': 'MJCF', 'mujocoinclude': 'MJCF'}
OUTCOMES = ('loads', 'without meshes', 'macros', 'refused', 'crashed', 'too slow')
SECONDS = 120


def format_of(file):
    """None for XML that is no robot's, and for what cannot be read."""
    try:
        with open(file, 'rb') as stream:
            begin = stream.read(65536)
    except OSError:
        return None
    if begin.startswith(b'glTF') or file.lower().endswith(('.gltf', '.glb')):
        return 'glTF'
    text = re.sub(r'<!--.*?-->|<\?.*?\?>|<!.*?>', '', begin.decode('utf-8', 'replace'), flags=re.S)
    root = re.search(r'<\s*([A-Za-z_][\w.:-]*)', text)
    return ROOTS.get(root.group(1)) if root else None


def files_under(folder):
    for parent, folders, names in os.walk(folder):
        folders.sort()
        for name in sorted(names):
            if name.lower().endswith(ENDINGS):
                yield os.path.join(parent, name)


def info(program, file, options):
    """Exit code (None: too slow) and what was said."""
    try:
        run = subprocess.run([program, 'info', file, *options], capture_output=True, text=True, errors='replace',
                             timeout=SECONDS)
        return run.returncode, run.stderr
    except subprocess.TimeoutExpired:
        return None, ''


def trial(program, file, options):
    """The outcome, and the first complaint."""
    code, told = info(program, file, options)
    if code == 3 and 'missing meshes:' in told:
        code, told_without = info(program, file, [*options, '--skip-missing-meshes'])
        if code == 0:
            return 'without meshes', ''
        told = told_without
    first = told.strip().split('\n')[0]
    if code == 0:
        return 'loads', ''
    if code is None:
        return 'too slow', ''
    if code == 3 and 'is a macro: expand the file first' in told:
        return 'macros', ''
    return ('refused' if code in (2, 3) else 'crashed'), first


def kind_of(complaint, file):
    """The complaint without what is of one file: its name, lines, names in quotes, numbers."""
    text = complaint.replace(file + ': ', '')
    text = re.sub(r'in [^,]+, (?=line \d)', '', text)
    text = re.sub(r'"[^"]*"', '"..."', text)
    text = re.sub(r'\(looked for .*', '(...)', text)
    return re.sub(r'[-+]?\d+(\.\d+)?(e[-+]?\d+)?', 'N', text)[:160]


def main():
    parser = argparse.ArgumentParser(prog='./run trial-files', description=__doc__)
    parser.add_argument('folder')
    parser.add_argument('--list', action='store_true', help='each file that does not load, with its complaint')
    parser.add_argument('--program', required=True, help=argparse.SUPPRESS)
    options, more = parser.parse_known_args()
    if not os.path.isdir(options.folder):
        print(f'trial-files: {options.folder}: must be a folder', file=sys.stderr)
        sys.exit(2)
    files = [(file, kind) for file in files_under(options.folder) if (kind := format_of(file))]
    if not files:
        print(f'trial-files: {options.folder}: has no robots\' files', file=sys.stderr)
        sys.exit(3)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        outcomes = list(pool.map(lambda one: trial(options.program, one[0], more), files))
    table = collections.defaultdict(collections.Counter)
    kinds, example = collections.Counter(), {}
    for (file, kind), (outcome, complaint) in zip(files, outcomes):
        table[kind][outcome] += 1
        table['all'][outcome] += 1
        if outcome in ('loads', 'without meshes'):
            continue
        if options.list:
            print(f'{outcome}: {file}: {complaint.replace(file + ": ", "")}')
        if outcome not in ('macros',):
            what = kind_of(complaint, file) if complaint else outcome
            kinds[what] += 1
            example.setdefault(what, file)
    print(f'{"format":8}{"files":>8}' + ''.join(f'{outcome:>16}' for outcome in OUTCOMES))
    for kind in sorted(table, key=lambda kind: (kind == 'all', kind)):
        row = table[kind]
        print(f'{kind:8}{sum(row.values()):>8}' + ''.join(f'{row[outcome]:>16}' for outcome in OUTCOMES))
    every = table['all']
    whole = sum(every.values()) - every['macros']
    good = every['loads'] + every['without meshes']
    print(f'{good} of {whole} load ({100 * good / max(whole, 1):.1f} %), macros not counted')
    for what, count in kinds.most_common():
        print(f'{count:>6}  {what}  ({example[what]})')
    sys.exit(1 if every['crashed'] or every['too slow'] else 0)


if __name__ == '__main__':
    main()
