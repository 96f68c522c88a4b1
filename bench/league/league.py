#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The league of solvers on the hard cases: minkray league (docs/benchmarks.md)."""
import argparse
import json
import os
import platform
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import families  # noqa: E402
import judge  # noqa: E402
import report  # noqa: E402
from solver_process import Solver  # noqa: E402

# Adapters in C++, in the order of the table: the program, and the solvers that it has.
ADAPTERS = (('minkray', ('minkray',)), ('bullet', ('bullet', 'bullet-gjk')),
            ('fcl', ('fcl-libccd', 'fcl-indep')), ('libccd', ('libccd-gjk', 'libccd-mpr')), ('ode', ('ode',)),
            ('mujoco', ('mujoco',)))
NPM = ('mujoco-js', 'rapier', 'jolt')


def arguments():
    parser = argparse.ArgumentParser(prog='minkray league', description='Compare Minkray with other solvers on hard cases')
    parser.add_argument('--cases', nargs='+', metavar='FILE', help='files of cases (default: all of tests/cases)')
    parser.add_argument('--only', metavar='TEXT', help='only cases whose names contain this')
    parser.add_argument('--solvers', metavar='NAMES', help='solvers to run, comma-separated (default: all available)')
    parser.add_argument('--npm', action='store_true', help='also ' + ', '.join(NPM) + ', in Node')
    parser.add_argument('--exec', action='append', default=[], metavar='CMD', dest='commands',
                        help='add a solver: a command that works like `minkray cast -`; repeatable')
    parser.add_argument('--random', type=int, default=0, metavar='N',
                        help='random rays per kind of ray and shape, in addition to the cases')
    parser.add_argument('--seed', type=int, default=1, help='random seed of --random')
    parser.add_argument('--limit', type=float, default=5, metavar='SECONDS', help='for an answer; 5 by default')
    parser.add_argument('-o', '--html', metavar='FILE', help='a report: case by solver')
    parser.add_argument('--json', metavar='FILE', help='all answers and verdicts')
    parser.add_argument('-q', '--quiet', action='store_true', help='no progress')
    parser.add_argument('--programs', default=HERE, help=argparse.SUPPRESS)
    return parser.parse_args()


def give_up(code, why):
    print('minkray league: ' + why, file=sys.stderr)
    sys.exit(code)


def solvers(options):
    """Those that are there. A peer that is not installed is no error."""
    wanted = options.solvers.split(',') if options.solvers else None
    found, missing = [], []
    for program, names in ADAPTERS:
        path = os.path.join(options.programs, 'league-' + program)
        for name in names:
            if wanted and name not in wanted:
                continue
            if os.path.exists(path):
                found.append(Solver(name, [path, name], options.limit))
            else:
                missing.append(name)
    for name in NPM if options.npm else ():
        if not wanted or name in wanted:
            found.append(Solver(name, ['node', os.path.join(HERE, 'npm', name + '.mjs')], max(20, options.limit)))
    for command in options.commands:
        found.append(Solver(command, command, options.limit))
    for name in wanted or ():
        if name not in missing and not any(s.name == name for s in found):
            give_up(2, f'--solvers: no solver {name} here')
    if missing:
        print('not installed: ' + ', '.join(missing), file=sys.stderr)
    return found


def read_cases(options):
    folder = os.path.join(HERE, '..', '..', 'tests', 'cases')
    files = options.cases or sorted(os.path.join(folder, f) for f in os.listdir(folder) if f.endswith('.jsonl'))
    try:
        cases = [json.loads(line) for file in files for line in open(file) if line.strip()]
    except (OSError, ValueError) as wrong:
        give_up(3, str(wrong))
    return [case for case in cases if not options.only or options.only in case['name']]


def ask_all(solver, cases, quiet):
    """One record a case: verdict, error in units, nanoseconds, the answer."""
    records = []
    for i, case in enumerate(cases):
        answer = solver.ask(judge.question(case))
        verdict, error = judge.judge(case, answer)
        records.append({'verdict': verdict, 'error': error, 'ns': answer.get('ns'), 'answer': answer})
        if not quiet and sys.stderr.isatty():
            print(f'\r{solver.name}: {i + 1} of {len(cases)}  ', end='', file=sys.stderr)
    solver.stop()
    if not quiet and sys.stderr.isatty():
        print(file=sys.stderr)
    return records


def summary(records):
    """Counts by verdict, the worst error of an answer that was given, the median time."""
    line = {verdict: sum(r['verdict'] == verdict for r in records) for verdict in judge.VERDICTS}
    line['asked'] = len(records) - line['not asked'] - line['convention']
    line['worst'] = max((r['error'] for r in records if r['error'] is not None), default=None)
    times = [r['ns'] for r in records if r['ns']]
    line['ns'] = statistics.median(times) if times else None
    return line


def words():
    """The command line, without what the build adds to it."""
    given = sys.argv[1:]
    return [w for i, w in enumerate(given) if w != '--programs' and (i == 0 or given[i - 1] != '--programs')]


def machine():
    try:
        with open('/proc/cpuinfo') as file:
            model = next(line.split(':', 1)[1].strip() for line in file if line.startswith('model name'))
    except (OSError, StopIteration):
        model = platform.processor()
    try:
        commit = subprocess.run(['git', '-C', HERE, 'rev-parse', '--short', 'HEAD'], capture_output=True, text=True).stdout.strip()
    except FileNotFoundError:  # a machine without git
        commit = 'unknown'
    return model, commit


def main():
    options = arguments()
    cases = read_cases(options)
    if not cases:
        give_up(2, 'no such cases')
    table = [(solver, ask_all(solver, cases, options.quiet)) for solver in solvers(options)]
    rays = families.random_cases(options.random, options.seed) if options.random else []
    random_table = [(solver, ask_all(solver, rays, options.quiet)) for solver, _ in table] if rays else []
    model, commit = machine()
    facts = {'cases': len(cases), 'machine': model, 'commit': commit, 'command': ' '.join(['minkray league'] + words()),
             'limit': options.limit, 'random': options.random, 'seed': options.seed}
    print(report.text(facts, cases, table, rays, random_table, summary))
    if options.html:
        with open(options.html, 'w') as file:
            file.write(report.html(facts, cases, table, rays, random_table, summary))
    if options.json:
        with open(options.json, 'w') as file:
            json.dump({'facts': facts, 'solvers': [dict(s.about, cases={c['name']: r for c, r in zip(cases, records)})
                                                   for s, records in table]}, file, indent=1)


if __name__ == '__main__':
    main()
