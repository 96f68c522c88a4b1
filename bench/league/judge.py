# SPDX-License-Identifier: MIT
"""Judges a result by the certificate of its case: no solver is the reference."""
import os
import sys
from fractions import Fraction as F

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'tests', 'cases'))
import check_cases as checker  # noqa: E402

# Lengths are in units of the smaller shape's bounding radius.
RIGHT, CLOSE = 1e-6, 1e-3
VERDICTS = ('right', 'yes or no', 'close', 'wrong', 'said so', 'crashed', 'hung', 'convention', 'not asked')


def radius(s):
    """Half the diagonal of a shape's bounding box."""
    sides = []
    for k in range(3):
        n = [F(i == k) for i in range(3)]
        sides.append(float(checker.reach(s, n) + checker.reach(s, [-x for x in n])) / 2)
    return sum(x * x for x in sides) ** 0.5


def unit(case):
    shapes = [case[key] for key in ('shape', 'a', 'b', 'moving', 'obstacle') if key in case]
    return min([r for r in map(radius, shapes) if r > 0], default=1.0)


def miss_margin(case):
    """How far a missing path passes by at least, in units."""
    c = case['certificate']
    n = checker.vec(c['normal'])
    if case['query'] == 'ray':
        ray = case['ray']
        o, d, t_max = checker.vec(ray['origin']), checker.vec(ray['direction']), ray.get('t_max')
        reach = checker.reach(case['shape'], n) - checker.dot(n, o)
    else:
        d, t_max = checker.vec(case['direction']), case.get('t_max')
        reach = checker.reach(case['obstacle'], n) + checker.reach(case['moving'], [-x for x in n])
    ends = [-reach] + ([checker.num(t_max) * checker.dot(n, d) - reach] if t_max is not None else [])
    return float(min(ends) / checker.root_above(checker.dot(n, n))) / unit(case)


def begins_inside(case):
    """Some engines say of a cast that begins in the shape that it misses, or tell where it leaves."""
    return case['expect'].get('t') == 0 and F(case['certificate']['t_hi']) == 0 and 'normal' not in case['certificate']


def speed(case):
    d = case['ray']['direction'] if 'ray' in case else case['direction']
    e = case.get('obstacle_direction', [0, 0, 0])
    return sum((x - y) ** 2 for x, y in zip(d, e)) ** 0.5


def grade(error):
    """By its size; NaN is wrong."""
    return 'right' if error <= RIGHT else 'close' if error <= CLOSE else 'wrong'


def judge(case, answer):
    """A verdict, and how far off in units where that is a number."""
    status, expect = str(answer.get('status', 'failed')), case['expect']
    if status in ('crashed', 'hung'):
        return status, None
    if status == 'unsupported':
        return 'not asked', None
    if status in ('failed', 'exhausted', 'undecided'):
        return 'said so', None
    if case['query'] in ('ray', 'shape'):
        if status not in ('hit', 'inside', 'miss'):
            return 'wrong', None
        met = status != 'miss'
        if begins_inside(case) and not (met and answer.get('t') == 0):
            return 'convention', None
        if met != expect['hit']:
            if expect.get('either'):
                return 'right', 0.0
            return ('close' if not expect['hit'] and miss_margin(case) <= RIGHT else 'wrong'), None
        if not met:
            return 'right', 0.0
        try:
            error = abs(float(answer['t']) - expect['t']) * speed(case) / unit(case)
        except (KeyError, TypeError, ValueError):
            return 'wrong', None
        return grade(error), error
    value = answer.get('value', answer.get('distance'))
    if value is None:  # the verdict alone
        if status not in ('separated', 'touching', 'overlapping'):
            return 'wrong', None
        apart = expect['distance'] / unit(case)
        right = apart >= -RIGHT if status != 'overlapping' else apart <= RIGHT
        return ('yes or no' if right else 'wrong'), None
    error = abs(float(value) - expect['distance']) / unit(case)
    return grade(error), error


def question(case):
    """The part of a case that is sent to a solver."""
    return {k: v for k, v in case.items() if k not in ('name', 'family', 'source', 'numbers', 'was', 'expect', 'certificate')}
