#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes right cases wrong in ten ways, 1000 in all, and sees that check_cases.py refuses each:
tamper_cases.py FILE.jsonl..."""
import copy
import json
import random
import sys
from fractions import Fraction as F

import check_cases as checker


def text(x):
    return str(F(x))


def shift(case):
    """More than the tolerance, and than half the digits."""
    e = case['expect']
    value, tolerance = (e['t'], e['t_abs_tol']) if 't' in e else (e['distance'], e['abs_tol'])
    return random.choice((-1, 1)) * random.uniform(10, 1e6) * max(tolerance, 1e-12 * abs(value), 1e-14)


def value_moved(case):
    e = case['expect']
    key = 't' if 't' in e else 'distance' if 'distance' in e else None
    if key is None:
        return False
    e[key] = e[key] + shift(case)
    return True


def value_and_bounds_moved(case):
    if 't' not in case['expect'] and 'distance' not in case['expect']:
        return False
    e, c, by = case['expect'], case['certificate'], shift(case)
    if 't' in e and c['t_hi'] != '0' and not e.get('either'):
        e['t'] += by
        by = F(e['t']) - F(e['t'] - by)
        c['t_lo'], c['t_hi'] = text(F(c['t_lo']) + by), text(F(c['t_hi']) + by)
        return True
    if 'distance' in e and F(c['lower']) != 0:
        e['distance'] += by
        c['lower'], c['upper'] = text(F(c['lower']) + F(by)), text(F(c['upper']) + F(by))
        return True
    return False


def bounds_moved(case):
    if 't' not in case['expect'] and 'distance' not in case['expect']:
        return False
    c, by = case['certificate'], F(shift(case))
    lo, hi = ('t_lo', 't_hi') if 't_lo' in c else ('lower', 'upper')
    if lo not in c or (c[lo] == c[hi] == '0'):
        return False
    c[lo], c[hi] = text(F(c[lo]) + by), text(F(c[hi]) + by)
    return True


def verdict_turned(case):
    e = case['expect']
    if 'hit' not in e or e.get('either'):
        return False
    e['hit'] = not e['hit']
    if e['hit']:
        e.update(t=random.uniform(0, 1), t_abs_tol=1e-9)
        case['certificate'].update(t_lo=str(e['t']), t_hi=str(e['t']), within=1e-12, a=['0', '0', '0'], b=['0', '0', '0'])
    return True


def normal_turned(case):
    c = case['certificate']
    if 'normal' not in c or case['expect'].get('either'):
        return False
    if 't_lo' in c and F(c['t_lo']) <= 0 or 'lower' in c and F(c['lower']) == 0:
        return False
    if 'facets' in c:  # the shapes may be as deep in each other the other way round: it is tilted
        size = max(abs(F(x)) for x in c['normal'])
        c['normal'] = [text(F(x) + size * F(random.uniform(0.1, 0.5))) for x in c['normal']]
    else:
        c['normal'] = [text(-F(x)) for x in c['normal']]
    return True


def path_moved(case):
    """The ray begins further on, or the shape: the answer is another."""
    e = case['expect']
    if e.get('either') or not e.get('hit') or not e['t'] > 0:
        return False
    by = abs(shift(case)) * random.choice((-1, 1)) * 10
    where = case.get('ray')
    if where is None:
        moving = case['moving']
        case['moving'] = {'type': 'transform', 'shape': moving, 'translate': [by * x for x in case['direction']]}
        return any(abs(by * x) > 1e-300 for x in case['direction']) and 'obstacle_direction' not in case
    moved = [o + by * d for o, d in zip(where['origin'], where['direction'])]
    largest = max(abs(x) for x in where['origin'])
    where['origin'] = moved
    speed = max(abs(x) for x in where['direction'])
    return abs(by) * speed > 1e-13 * largest


def shape_moved(case):
    c = case['certificate']
    if 'lower' not in c or 'normal' not in c or F(c['upper']) == 0:
        return False
    n = [float(F(x)) for x in c['normal']]
    size = max(abs(float(x)) for p in extent(case['b']) for x in p)
    by = random.choice((-1, 1)) * random.uniform(10, 1e4) * max(case['expect']['abs_tol'], 1e-13 * size)
    length = sum(x * x for x in n) ** 0.5
    case['b'] = {'type': 'transform', 'shape': case['b'], 'translate': [by * x / length for x in n]}
    return True


def extent(s):
    axes = [[F(i == k) for i in range(3)] for k in range(3)]
    return [[checker.reach(s, n), checker.reach(s, [-x for x in n])] for n in axes]


def witness_moved(case):
    """A common or nearest point is taken out of its shape, along the normal."""
    c = case['certificate']
    if 'a' not in c or 'normal' not in c or not isinstance(c['a'], list) or 't_hi' in c and c['t_hi'] == '0':
        return False
    n = [F(x) for x in c['normal']]
    size = max(abs(x) for p in extent(case.get('a', case.get('obstacle'))) for x in p)
    length = checker.root_above(checker.dot(n, n))
    by = size * F(random.uniform(1e-9, 1e-2)) / length
    c['a'] = [text(F(x) + by * y) for x, y in zip(c['a'], n)]
    return True


def facet_lost(case):
    facets = case['certificate'].get('facets')
    if not facets:
        return False
    facets.pop(random.randrange(len(facets)))
    return True


def facet_turned(case):
    facets = case['certificate'].get('facets')
    if not facets:
        return False
    facets[random.randrange(len(facets))].reverse()
    return True


WAYS = (value_moved, value_and_bounds_moved, bounds_moved, verdict_turned, normal_turned, path_moved, shape_moved,
        witness_moved, facet_lost, facet_turned)


def main(files):
    random.seed(20)
    cases = [json.loads(line) for file in files for line in open(file) if line.strip()]
    wanted, taken, refused = 1000, 0, {way: 0 for way in WAYS}
    for attempt in range(100 * wanted):
        way = WAYS[attempt % len(WAYS)]
        case = copy.deepcopy(random.choice(cases))
        if taken == wanted:
            break
        if not way(case):
            continue
        taken += 1
        if checker.check(case):
            refused[way] += 1
        else:
            print(f"taken for right: {case['name']}, {way.__name__}")
    for way, count in refused.items():
        print(f'{count:5} refused: {way.__name__}')
    print(f'{sum(refused.values())} of {taken} tampered cases are refused')
    return 0 if taken == wanted == sum(refused.values()) and min(refused.values()) > 0 else 1


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
