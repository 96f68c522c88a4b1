#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Verifies the certificates of the hard cases, exactly: check_cases.py FILE.jsonl...

Numbers of a query mean the doubles nearest to them, strings in a certificate any fraction. Nothing is
rounded but square roots, and those to the side that proves less. README.md says what proves what.
"""
import json
import sys
from fractions import Fraction as F
from math import isqrt


class Wrong(Exception):
    pass


def need(holds, complaint):
    if not holds:
        raise Wrong(complaint)


def num(x):
    return F(x) if isinstance(x, (str, F)) else F(float(x))


def vec(v):
    return [num(x) for x in v]


def dot(u, v):
    return sum(x * y for x, y in zip(u, v))


def mix(u, k, v):
    return [x + k * y for x, y in zip(u, v)]


def cross(u, v):
    return [u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2] for i in range(3)]


def root_above(x):
    """No less than the square root, and it where that is a fraction."""
    n, scale = x.numerator * x.denominator, 1 << max(0, 400 - x.numerator.bit_length())
    r = isqrt(n * scale * scale)
    return F(r if r * r == n * scale * scale else r + 1, x.denominator * scale)


def affine(s):
    """The linear part, in rows, and the translation of a transform."""
    if 'matrix' in s:
        rows = [vec(r) for r in s['matrix']]
        return [r[:3] for r in rows], [r[3] if len(r) == 4 else F(0) for r in rows]
    x, y, z, w = q = vec(s.get('rotate', [0, 0, 0, 1]))
    k = s.get('scale', 1)
    k, qq = vec(k) if isinstance(k, list) else [num(k)] * 3, dot(q, q)
    m = [[w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
         [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
         [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z]]
    return [[e * kk / qq for e, kk in zip(r, k)] for r in m], vec(s.get('translate', [0, 0, 0]))


def solve(columns, p):
    """The numbers that the columns are to be multiplied by so that their sum is p, if there are any."""
    rows, n = [[c[i] for c in columns] + [p[i]] for i in range(len(p))], len(columns)
    for k in range(n):
        pivot = next((i for i in range(k, len(rows)) if rows[i][k]), None)
        need(pivot is not None, 'the vertices are dependent')
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows = [r if i == k else [x - r[k] / rows[k][k] * y for x, y in zip(r, rows[k])] for i, r in enumerate(rows)]
    need(not any(r[n] for r in rows[n:]), 'the point is not of their span')
    return [rows[k][n] / rows[k][k] for k in range(n)]


def vertices(s):
    if s['type'] == 'box':
        return [[h if i >> k & 1 else -h for k, h in enumerate(vec(s['half_extents']))] for i in range(8)]
    return [vec(p) for p in s['points']] if 'points' in s else [vec(s.get('position', [0, 0, 0]))]


def reach(s, n):
    """How far a shape reaches along n, or more."""
    kind, size = s['type'], lambda key: num(s[key])
    if kind in ('point', 'segment', 'triangle', 'hull', 'box'):
        return max(dot(n, p) for p in vertices(s))
    if kind == 'transform':
        m, t = affine(s)
        return reach(s['shape'], [dot(n, column) for column in zip(*m)]) + dot(n, t)
    if kind == 'rounded':
        return reach(s['shape'], n) + size('radius') * root_above(dot(n, n))
    if kind in ('sphere', 'capsule'):
        return size('radius') * root_above(dot(n, n)) + (size('half_height') * abs(n[2]) if kind == 'capsule' else 0)
    if kind == 'ellipsoid':
        return root_above(sum((r * x) ** 2 for r, x in zip(vec(s['radii']), n)))
    side = root_above(dot(n[:2], n[:2]))
    if kind in ('cylinder', 'disk'):
        return size('radius') * side + (size('half_height') * abs(n[2]) if kind == 'cylinder' else 0)
    below, above = vec(s['radii']) if kind == 'frustum' else (size('radius'), 0)
    need(kind in ('cone', 'frustum'), 'no support of ' + kind)
    return max(below * side - size('half_height') * n[2], above * side + size('half_height') * n[2])


def inside(s, p, of=None):
    """True if p is a point of the shape; `of` names vertices that it lies between."""
    kind, size = s['type'], lambda key: num(s[key])
    if kind in ('point', 'segment', 'triangle', 'hull'):
        all_of = vertices(s)
        corners = [all_of[i] + [F(1)] for i in (range(len(all_of)) if of is None else of)]
        return min(solve(corners, p + [F(1)])) >= 0
    if kind == 'transform':
        m, t = affine(s)
        return inside(s['shape'], solve(list(zip(*m)), mix(p, -1, t)), of)
    if kind == 'box':
        return all(abs(x) <= h for x, h in zip(p, vec(s['half_extents'])))
    if kind == 'ellipsoid':
        return sum((x / r) ** 2 for x, r in zip(p, vec(s['radii']))) <= 1
    if kind in ('sphere', 'capsule', 'rounded'):
        nearest, core = [F(0)] * 3, s.get('shape', {})
        if kind == 'capsule':
            nearest[2] = max(-size('half_height'), min(size('half_height'), p[2]))
        elif core.get('type') == 'box':
            nearest = [max(-h, min(h, x)) for x, h in zip(p, vec(core['half_extents']))]
        elif kind == 'rounded':
            a, b = (vertices(core) * 2)[:2]
            need(core['type'] in ('point', 'segment'), 'no nearest point of ' + core['type'])
            ab = mix(b, -1, a)
            nearest = mix(a, max(F(0), min(F(1), dot(mix(p, -1, a), ab) / (dot(ab, ab) or 1))), ab)
        return dot(mix(p, -1, nearest), mix(p, -1, nearest)) <= size('radius') ** 2
    height = size('half_height') if kind != 'disk' else F(0)
    below, above = vec(s['radii']) if kind == 'frustum' else (size('radius'), 0 if kind == 'cone' else size('radius'))
    radius = below + (above - below) * (p[2] + height) / (2 * height or 1)
    return abs(p[2]) <= height and dot(p[:2], p[:2]) <= radius ** 2


def point(s, claim):
    """A point of the shape that a certificate names: by the number of a vertex, or [x, y, z] or {at, of}."""
    if isinstance(claim, int):
        if s['type'] != 'transform':
            return vertices(s)[claim]
        m, t = affine(s)
        return mix(t, 1, [dot(row, point(s['shape'], claim)) for row in m])
    at, of = (claim['at'], claim['of']) if isinstance(claim, dict) else (claim, None)
    need(inside(s, vec(at), of), 'a point is not in its shape')
    return vec(at)


def core(s):
    """A shape without its rounding, and the radius of that."""
    if s['type'] == 'transform' and 'matrix' not in s and s.get('scale', 1) == 1:
        inner, r = core(s['shape'])
        return dict(s, shape=inner), r
    if s['type'] == 'rounded':
        inner, r = core(s['shape'])
        return inner, r + num(s['radius'])
    if s['type'] == 'sphere':
        return {'type': 'point'}, num(s['radius'])
    if s['type'] == 'capsule':
        return {'type': 'segment', 'points': [[0, 0, -s['half_height']], [0, 0, s['half_height']]]}, num(s['radius'])
    return s, F(0)


def close(what, value, lo, hi, within, tolerance):
    value, lo, hi, within = num(value), num(lo), num(hi), num(within)
    need(within <= num(tolerance), 'the certificate is wider than the tolerance')
    need(lo <= hi and hi - within <= value <= lo + within, what + ' is not as certified')


def check_cast(case, c, expect):
    if case['query'] == 'ray':
        s, ray = case['shape'], case['ray']
        o, d = vec(ray['origin']), vec(ray['direction'])
        of_n, contact = (lambda n: reach(s, n) - dot(n, o)), (lambda t: inside(s, mix(o, t, d), c.get('of')))
        t_max = ray.get('t_max')
    else:
        a, b, t_max = case['obstacle'], case['moving'], case.get('t_max')
        d = mix(vec(case['direction']), -1, vec(case.get('obstacle_direction', [0, 0, 0])))
        of_n = lambda n: reach(a, n) + reach(b, [-x for x in n])
        contact = lambda t: mix(point(a, c['a']), -1, point(b, c['b'])) == [t * x for x in d]
    t_max = None if t_max is None else num(t_max)
    n = vec(c['normal']) if 'normal' in c else None
    if not expect['hit'] or expect.get('either'):
        # Beside the plane at both ends of the motion: strictly, or touching it where either is right.
        slack = [-of_n(n), dot(n, d) if t_max is None else t_max * dot(n, d) - of_n(n)]
        if t_max is None:
            need(slack[1] >= 0, 'the plane is met in the end')
        need(min(slack[:1 if t_max is None else 2]) > 0 or (expect.get('either') and min(slack) >= 0), 'the plane does not separate')
    if not expect['hit']:
        return
    t_lo, t_hi = num(c['t_lo']), num(c['t_hi'])
    close('t', expect['t'], t_lo, t_hi, c['within'], expect['t_abs_tol'])
    need(0 <= t_lo and (t_max is None or t_hi <= t_max), 'the hit is not on the ray')
    need(contact(t_hi), 'there is no contact at t_hi')
    if t_lo > 0 and not expect.get('either'):
        need(dot(n, d) < 0 and t_lo * dot(n, d) >= of_n(n), 'the plane does not separate until t_lo')
    if 'normal' in expect:
        m = vec(expect['normal'])
        need(dot(m, n) > 0 and dot(cross(m, n), cross(m, n)) <= F(1, 10 ** 12) * dot(n, n), 'the normal is another')


def check_depth(a, b, c, lower):
    """Facets, seen from the origin all alike, form a closed surface around a ball of that radius."""
    p = [mix(point(a, k), -1, point(b, l)) for k, l in c['points']]
    edges = [(f[i], f[i - 2]) for f in c['facets'] for i in range(3)]
    need(len(set(edges)) == len(edges) and all((j, i) in set(edges) for i, j in edges), 'the surface is not closed')
    for i, j, k in c['facets']:
        n = cross(mix(p[j], -1, p[i]), mix(p[k], -1, p[i]))
        need(dot(n, p[i]) > 0 and dot(n, p[i]) ** 2 >= lower ** 2 * dot(n, n), 'a facet is nearer than the depth')


def check_distance(case, c, expect):
    a, b, radius = case['a'], case['b'], F(0)
    if case['query'] == 'signed_distance':
        (a, r), (b, q) = core(a), core(b)
        radius = r + q
    lower, upper = num(c['lower']), num(c['upper'])
    close('distance', expect['distance'], lower - radius, upper - radius, c['within'], expect['abs_tol'])
    if case['query'] == 'signed_distance' or lower > 0:
        n = vec(c['normal'])
        gap, nn = -reach(b, [-x for x in n]) - reach(a, n), dot(n, n)
        reaches = gap > 0 and gap ** 2 >= lower ** 2 * nn if lower > 0 else gap >= 0 or gap ** 2 <= lower ** 2 * nn
        need(nn > 0 and reaches, 'the plane proves less')
    if upper < 0:
        return check_depth(a, b, c, -upper)
    v = mix(point(b, c['b']), -1, point(a, c['a']))
    need(dot(v, v) <= upper ** 2, 'the points are further apart')


def check(case):
    """The error in a case, or an empty text."""
    try:
        kind = check_cast if case['query'] in ('ray', 'shape') else check_distance
        kind(case, case['certificate'], case['expect'])
        return ''
    except (Wrong, KeyError, IndexError, TypeError, ValueError, ZeroDivisionError) as wrong:
        return str(wrong) or type(wrong).__name__


if __name__ == '__main__':
    cases = [json.loads(line) for file in sys.argv[1:] for line in open(file) if line.strip()]
    wrong = [(case['name'], check(case)) for case in cases]
    for name, complaint in wrong:
        if complaint:
            print(f'{name}: {complaint}')
    right = sum(not complaint for _, complaint in wrong)
    print(f'{right} of {len(cases)} certificates are right')
    sys.exit(right != len(cases))
