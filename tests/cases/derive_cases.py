#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Derives the answers of cases and their certificates: derive_cases.py < CASES.jsonl > FILE.jsonl

It shares no code with Minkray: distances by the search that GJK is, in 70 decimal digits, with all faces
of a simplex tried; casts by a plane after the other from such distances; depths by growing a polytope.
None of it needs to be trusted: what it finds is written down as bounds that check_cases.py proves.
"""
import itertools
import json
import sys
from decimal import Decimal as D, getcontext
from fractions import Fraction as F

import check_cases as checker

getcontext().prec = 70
TINY = D(10) ** -44  # of the sizes of a case: what the search calls zero
STEP = D(10) ** -22  # of the sizes of a case: how far witnesses are moved inwards


def dec(x):
    return D(float(x))


def of(f):
    """A fraction as a decimal."""
    return D(f.numerator) / D(f.denominator)


def dot(u, v):
    return sum(x * y for x, y in zip(u, v))


def mix(u, k, v):
    return [x + k * y for x, y in zip(u, v)]


def cross(u, v):
    return [u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2] for i in range(3)]


class Body:
    """A shape with its map on the outside: support points, and how to name them exactly."""

    def __init__(self, s):
        self.source = s
        m, t = [[F(i == j) for j in range(3)] for i in range(3)], [F(0)] * 3
        while s['type'] == 'transform':
            mi, ti = checker.affine(s)
            t = [sum(m[i][k] * ti[k] for k in range(3)) + t[i] for i in range(3)]
            m = [[sum(m[i][k] * mi[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
            s = s['shape']
        self.s, self.exact = s, (m, t)
        self.m, self.t = [[of(x) for x in r] for r in m], [of(x) for x in t]
        self.kind = s['type']
        self.is_hull = self.kind in ('point', 'segment', 'triangle', 'hull')
        self.corners = [[of(x) for x in v] for v in checker.vertices(s)] if self.is_hull or self.kind == 'box' else None
        points = [self.support([D(x) for x in n])[0] for n in ([1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1], [1, 1, 1], [-1, -1, -1])]
        self.size = max([abs(x) for p in points for x in p] + [D(10) ** -300])
        if self.is_hull:
            k = D(len(self.corners))
            self.centre = self.at([sum(c[i] for c in self.corners) / k for i in range(3)])
        elif self.kind == 'rounded':
            self.centre = Body(s['shape']).centre
            self.centre = self.at(self.centre)
        elif self.kind == 'cone':
            self.centre = self.at([D(0), D(0), -dec(s['half_height']) / 2])
        else:
            self.centre = self.at([D(0)] * 3)

    def at(self, p):
        return [dot(r, p) + t for r, t in zip(self.m, self.t)]

    def support(self, n):
        local = [dot([self.m[i][j] for i in range(3)], n) for j in range(3)]
        p, name = self.local_support(self.s, local)
        return self.at(p), name

    def local_support(self, s, n):
        kind = s['type']
        if kind in ('point', 'segment', 'triangle', 'hull', 'box'):
            corners = self.corners if s is self.s else [[of(x) for x in v] for v in checker.vertices(s)]
            k = max(range(len(corners)), key=lambda i: dot(n, corners[i]))
            return corners[k], k
        if kind == 'rounded':
            core = Body(s['shape'])
            p, _ = core.support(n)
            length = dot(n, n).sqrt()
            return (mix(p, dec(s['radius']) / length, n) if length else p), None
        if kind in ('sphere', 'capsule'):
            length = dot(n, n).sqrt() or D(1)
            p = [dec(s['radius']) * x / length for x in n]
            if kind == 'capsule':
                p[2] += dec(s['half_height']).copy_sign(n[2])
            return p, None
        if kind == 'ellipsoid':
            r = [dec(x) for x in s['radii']]
            length = sum((a * x) ** 2 for a, x in zip(r, n)).sqrt() or D(1)
            return [a * a * x / length for a, x in zip(r, n)], None
        side = dot(n[:2], n[:2]).sqrt()
        u = [x / side for x in n[:2]] if side else [D(0), D(0)]
        below, above = ([dec(x) for x in s['radii']] if kind == 'frustum' else
                        (dec(s['radius']), D(0) if kind == 'cone' else dec(s['radius'])))
        h = dec(s.get('half_height', 0))
        top = above * side + h * n[2] > below * side - h * n[2]
        r = above if top else below
        return [r * u[0], r * u[1], h if top else -h], None


def nearest(simplex):
    """The point of a simplex that is nearest to the origin: weights by row."""
    best = None
    for count in range(1, len(simplex) + 1):
        for rows in itertools.combinations(range(len(simplex)), count):
            weights = affine_nearest([simplex[i][0] for i in rows])
            if weights is None or min(weights) < 0:
                continue
            v = [sum(w * simplex[i][0][k] for w, i in zip(weights, rows)) for k in range(3)]
            if best is None or dot(v, v) < best[0]:
                best = (dot(v, v), v, [(w, simplex[i]) for w, i in zip(weights, rows) if w > 0])
    return best


def affine_nearest(points):
    """Weights of the point of the affine hull nearest to the origin; none if the points are dependent."""
    if len(points) == 1:
        return [D(1)]
    base, edges = points[0], [mix(p, -1, points[0]) for p in points[1:]]
    n = len(edges)
    rows = [[dot(e, f) for f in edges] + [-dot(e, base)] for e in edges]
    largest = max(rows[i][i] for i in range(n))
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        if abs(rows[k][k]) <= largest * D(10) ** -62:
            return None
        for i in range(n):
            if i != k:
                f = rows[i][k] / rows[k][k]
                rows[i] = [x - f * y for x, y in zip(rows[i], rows[k])]
    weights = [rows[k][n] / rows[k][k] for k in range(n)]
    return [1 - sum(weights)] + weights


def distance(a, b, shift, size):
    """Of a and b + shift: the distance, the vector from b to a, and the points that make it."""
    def difference(n):
        p, k = a.support(n)
        q, l = b.support([-x for x in n])
        return [x - y - z for x, y, z in zip(p, q, shift)], (p, k), (q, l)
    v = [x - y - z for x, y, z in zip(a.centre, b.centre, shift)]
    simplex, best = [], None
    for _ in range(4000):
        w = difference([-x for x in v])
        vv = dot(v, v)
        if best is not None:
            if vv.sqrt() <= TINY * size:
                return D(0), v, best[2]
            if vv - dot(v, w[0]) <= vv * D(10) ** -42 or any(w[0] == s[0] for s in simplex):
                return vv.sqrt(), v, best[2]
        found = nearest([s for _, s in best[2]] + [w] if best else [w])
        if best is not None and found[0] >= best[0]:
            return vv.sqrt(), v, best[2]
        best, v = found, found[1]
        simplex = [s for _, s in best[2]]
        if len(simplex) == 4:
            return D(0), v, best[2]
    return dot(v, v).sqrt(), v, best[2]


def text(x, digits=40):
    """A decimal for JSON, as text, rounded to a number of digits."""
    with_digits = getcontext().copy()
    with_digits.prec = digits
    return str(x.normalize(with_digits)) if x else '0'


def exact(f):
    """A fraction as text, decimal if it is one."""
    f = F(f)
    q, twos, fives = f.denominator, 0, 0
    while q % 2 == 0:
        q, twos = q // 2, twos + 1
    while q % 5 == 0:
        q, fives = q // 5, fives + 1
    k = max(twos, fives)
    if q != 1 or k > 400:
        return str(f)
    digits = str(abs(f.numerator) * 10 ** k // f.denominator)
    if k:
        digits = digits.rjust(k + 1, '0')
        digits = (digits[:-k] + '.' + digits[-k:]).rstrip('0').rstrip('.')
    return ('-' if f < 0 else '') + digits


def common_point(body, combination, which, inwards):
    """Of a combination of support points: a claim of the point of one body, and the point, exactly."""
    if body.is_hull:
        total = {}
        for w, s in combination:
            total[s[which][1]] = total.get(s[which][1], F(0)) + F(text(w, 30))
        norm = sum(total.values())
        ids = sorted(total)
        corners = checker.vertices(body.s)
        local = [sum(total[i] / norm * corners[i][k] for i in ids) for k in range(3)]
        m, t = body.exact
        p = [sum(r[k] * local[k] for k in range(3)) + x for r, x in zip(m, t)]
        if len(ids) == 1:
            return ids[0], p
        return {'at': [str(x) for x in p], 'of': ids}, p
    p = [sum(w * s[which][0][k] for w, s in combination) for k in range(3)]
    for step in range(0, 16):
        eps = D(0) if step == 0 else inwards * D(10) ** (step - 1)
        q = [F(text(x, 45)) for x in mix(p, eps, mix(body.centre, -1, p))]
        if is_inside(body, q):
            return [exact(x) for x in q], q
    raise ValueError('no point inside')


def is_inside(body, q, hint=None):
    m, t = body.exact
    try:
        local = checker.solve(list(zip(*m)), [x - y for x, y in zip(q, t)])
        return checker.inside(body.s, local, hint)
    except checker.Wrong:
        return False


def scale_of(case):
    """The largest length of a case."""
    bodies = [Body(case[key]) for key in ('shape', 'a', 'b', 'moving', 'obstacle') if key in case]
    size = max(body.size for body in bodies)
    if 'ray' in case:
        size = max([size] + [abs(dec(x)) for x in case['ray']['origin']])
    return size


class Scaled(Body):
    """A body made smaller around its centre."""

    def __init__(self, body, factor):
        self.body, self.factor, self.centre, self.size, self.is_hull = body, factor, body.centre, body.size, False

    def support(self, n):
        p, k = self.body.support(n)
        return mix(self.centre, self.factor, mix(p, -1, self.centre)), k


def short(n):
    largest = max(abs(x) for x in n)
    return [text(x / largest, 40) for x in n]


def derive_cast(case):
    is_ray = case['query'] == 'ray'
    if is_ray:
        a, b = Body(case['shape']), Body({'type': 'point', 'position': case['ray']['origin']})
        d, t_max = [dec(x) for x in case['ray']['direction']], case['ray'].get('t_max')
    else:
        a, b = Body(case['obstacle']), Body(case['moving'])
        d = mix([dec(x) for x in case['direction']], -1, [dec(x) for x in case.get('obstacle_direction', [0, 0, 0])])
        t_max = case.get('t_max')
    t_max = None if t_max is None else dec(t_max)
    size, t, normal = scale_of(case), D(0), None
    for _ in range(400):
        gap, v, parts = distance(a, b, [t * x for x in d], size)
        if gap <= TINY * size * 1000:
            break
        # From b towards a is v: the plane between them has the outward normal -v of a.
        n = [-x for x in v]
        speed = dot(n, d)
        reach = dot(n, a.support(n)[0]) - dot(n, b.support([-x for x in n])[0])
        if speed >= 0 or t_max is not None and reach / speed > t_max:
            return {'hit': False}, {'normal': miss_plane(a, b, d, t_max, size)}
        normal, until = n, reach / speed
        if until <= t:
            break
        t = until
    if normal is None:  # in each other from the start
        contact = contact_at(a, b, d, D(0), D(0), size, is_ray)
        if contact is None:
            raise ValueError('no contact at the start')
        contact.pop('t_hi', None)
        return {'hit': True, 't': 0.0, 't_abs_tol': 0}, dict({'t_lo': '0', 't_hi': '0', 'within': 0}, **contact)
    for step in range(0, 14):
        eps = STEP * D(10) ** step * size / dot(d, d).sqrt()
        if a.is_hull and is_ray:
            contact = flat_or_hull_hit(a, b, d, t, eps)
        else:
            contact = contact_at(a, b, d, t, eps, size, is_ray)
        if contact is not None:
            break
    else:
        raise ValueError('no contact')
    t_hi = contact.pop('t_hi', None) or F(text(t + eps, 45))
    n = short(normal)
    # As far as the plane holds with its numbers rounded.
    nf = [F(x) for x in n]
    speed = sum(x * F(y) for x, y in zip(nf, d))
    if is_ray:
        reach = checker.reach(case['shape'], nf) - sum(x * F(y) for x, y in zip(nf, checker.vec(case['ray']['origin'])))
    else:
        reach = checker.reach(case['obstacle'], nf) + checker.reach(case['moving'], [-x for x in nf])
    t_lo = reach / speed
    floor = F(text(of(t_lo), 45))
    while floor > t_lo:
        floor -= abs(floor) / 10 ** 43 + F(1, 10 ** 60)
    t_lo = max(F(0), floor)
    value = float(t_lo)
    expect = {'hit': True, 't': value}
    return expect, dict({'t_lo': exact(t_lo), 't_hi': exact(t_hi), 'normal': n}, **contact)


class Swept(Body):
    """All places of a body that moves."""

    def __init__(self, body, motion):
        self.body, self.motion, self.size, self.is_hull = body, motion, body.size, False
        self.centre = mix(body.centre, D('0.5'), motion)

    def support(self, n):
        p, k = self.body.support(n)
        return (mix(p, 1, self.motion) if dot(n, self.motion) > 0 else p), k


def miss_plane(a, b, d, t_max, size):
    """A plane that a motion never meets. If it has no end, it goes far, and the plane is made parallel."""
    t = t_max if t_max is not None else 1000 * size / (dot(d, d).sqrt() or D(1))
    _, v, _ = distance(a, Swept(b, [t * x for x in d]), [D(0)] * 3, size + t * dot(d, d).sqrt())
    n = [-x for x in v]
    if t_max is None and dot(n, d) < D(10) ** -30 * (dot(n, n) * dot(d, d)).sqrt():
        n = mix(n, (D(10) ** -30 * (dot(n, n) * dot(d, d)).sqrt() - dot(n, d)) / dot(d, d), d)
    return short(n)


def flat_or_hull_hit(a, b, d, t, eps):
    """Where a ray meets the hull of points: in a face of it if it is flat, else a little deeper."""
    corners = checker.vertices(a.s)
    m, tr = a.exact
    world = [[sum(r[k] * c[k] for k in range(3)) + x for r, x in zip(m, tr)] for c in corners]
    o, df = [F(x) for x in b.corners[0]], [F(x) for x in d]
    o = [F(x) for x in checker.vec(b.s.get('position', [0, 0, 0]))]
    p = [x + F(text(t + eps, 45)) * y for x, y in zip(o, df)]
    near = sorted(range(len(world)), key=lambda i: sum(float(x - y) ** 2 for x, y in zip(world[i], p)))
    for ids in itertools.islice(itertools.combinations(near, 4), 6000):
        try:
            w = checker.solve([world[i] + [F(1)] for i in ids], p + [F(1)])
        except checker.Wrong:
            continue
        if min(w) >= 0:
            return {'of': list(ids), 't_hi': F(text(t + eps, 45))}
    for count in (3, 2, 1):  # o + t d = sum of weights and vertices
        for ids in itertools.islice(itertools.combinations(near, count), 6000):
            try:
                w = checker.solve([world[i] + [F(1)] for i in ids] + [[-x for x in df] + [F(0)]], o + [F(1)])
            except checker.Wrong:
                continue
            if min(w) >= 0 and abs(of(w[-1]) - t) <= eps + abs(t) * D(10) ** -20:
                return {'of': list(ids), 't_hi': w[-1]}
    return None


def contact_at(a, b, d, t, eps, size, is_ray):
    """Exact points of both that meet when b has moved by a little more than t."""
    if is_ray:
        p = [F(x) + F(text(t + eps, 45)) * F(y) for x, y in zip(checker.vec(b.s.get('position', [0, 0, 0])), d)]
        if not is_inside(a, p):
            if a.is_hull:
                return flat_or_hull_hit(a, b, d, t, eps)
            return None
        return {}
    start = distance(a, b, [t * x for x in d], size)
    for depth in (D('1e-2'), D('1e-4'), D('1e-6'), D('1e-8'), D('1e-10')):
        deep = t + (depth * size / dot(d, d).sqrt() if t or eps else D(0))
        smaller = 1 - depth / 100
        first = a if a.is_hull else Scaled(a, smaller)
        second = b if b.is_hull and not a.is_hull else Scaled(b, smaller)
        gap, _, parts = distance(first, second, [deep * x for x in d], size)
        if gap <= TINY * size * 1000:
            break
        if not (t or eps):
            continue
    else:
        if t == 0 and eps == 0:
            return exact_touch(a, b)
        return None
    if t == 0 and eps == 0:
        share, combined = D(1), parts
        deep = D(0)
    share = min(D(1), eps / (deep - t)) if deep > t else D(1)
    combined = [(w * (1 - share), s) for w, s in start[2]] + [(w * share, s) for w, s in parts] if deep > t else parts
    t_hi = F(text(t + share * (deep - t), 45))
    df = [F(x) for x in d]
    if b.is_hull and not a.is_hull:
        claim_b, q = common_point(b, combined, 2, STEP)
        p = [x + t_hi * y for x, y in zip(q, df)]
        if not is_inside(a, p):
            return None
        return {'a': [exact(x) for x in p], 'b': claim_b, 't_hi': t_hi}
    claim_a, p = common_point(a, combined, 1, STEP)
    q = [x - t_hi * y for x, y in zip(p, df)]
    hint = None
    if b.is_hull:
        hint = hull_hint(b, q)
        if hint is None:
            return None
        return {'a': claim_a, 'b': {'at': [exact(x) for x in q], 'of': hint}, 't_hi': t_hi}
    if not is_inside(b, q):
        return None
    return {'a': claim_a, 'b': [exact(x) for x in q], 't_hi': t_hi}


def exact_touch(a, b):
    """Shapes that only touch at the start, at a corner or in a point that doubles hold."""
    if a.corners and b.corners:
        # The origin in the simplex of differences that the search ended with, exactly.
        _, _, parts = distance(a, b, [D(0)] * 3, max(a.size, b.size))
        ends = [[exact_corner(body, s[which][1]) for _, s in parts] for body, which in ((a, 1), (b, 2))]
        try:
            weights = checker.solve([mix(x, -1, y) + [F(1)] for x, y in zip(*ends)], [F(0)] * 3 + [F(1)])
        except checker.Wrong:
            weights = [-1]
        if min(weights) >= 0:
            p = [sum(w * x[k] for w, x in zip(weights, ends[0])) for k in range(3)]
            ids = [sorted({s[which][1] for _, s in parts}) for which in (1, 2)]
            hints = [hull_hint(x, p, i) if x.is_hull else None for x, i in zip((a, b), ids)]
            claims = [[exact(x) for x in p] if h is None else {'at': [exact(x) for x in p], 'of': h} for h in hints]
            return dict(zip('ab', claims))
    for one, other, names in ((a, b, 'ab'), (b, a, 'ba')):
        candidates = []
        if one.corners:
            m, t = one.exact
            corners = checker.vertices(one.s)
            candidates = [[sum(r[k] * c[k] for k in range(3)) + x for r, x in zip(m, t)] for c in corners]
        gap, v, parts = distance(one, other, [D(0)] * 3, max(a.size, b.size))
        middle = [sum(w * s[1][0][k] for w, s in parts) for k in range(3)]
        candidates.append([F(float(x)) for x in middle])
        for p in candidates:
            hints = [hull_hint(x, p) if x.is_hull else None for x in (one, other)]
            if all(h is not None if x.is_hull else is_inside(x, p) for x, h in zip((one, other), hints)):
                claims = [[exact(x) for x in p] if h is None else {'at': [exact(x) for x in p], 'of': h} for h in hints]
                return dict(zip(names, claims))
    return None


def exact_corner(body, k):
    m, t = body.exact
    c = checker.vertices(body.s)[k]
    return [sum(r[j] * c[j] for j in range(3)) + x for r, x in zip(m, t)]


def hull_hint(body, q, ids=None):
    """Vertices that a point lies between."""
    corners = checker.vertices(body.s)
    m, t = body.exact
    try:
        local = checker.solve(list(zip(*m)), [x - y for x, y in zip(q, t)])
    except checker.Wrong:
        return None
    near = sorted(ids or range(len(corners)), key=lambda i: sum(float(x - y) ** 2 for x, y in zip(corners[i], local)))
    for count in (1, 2, 3, 4):
        for some in itertools.islice(itertools.combinations(near, count), 3000):
            try:
                if min(checker.solve([corners[i] + [F(1)] for i in some], local + [F(1)])) >= 0:
                    return list(some)
            except checker.Wrong:
                continue
    return None


def derive_distance(case):
    a, b, radius = case['a'], case['b'], F(0)
    if case['query'] == 'signed_distance':
        (a, r), (b, q) = checker.core(a), checker.core(b)
        radius = r + q
    shape_a, shape_b = a, b
    a, b, size = Body(a), Body(b), scale_of(case)
    gap, v, parts = distance(a, b, [D(0)] * 3, size)
    deep = gap <= TINY * size * 1000
    if deep and case['query'] == 'signed_distance':
        depth = grow(a, b, size)
        if depth is not None:
            certificate, lower, upper = depth
            if certificate is None:
                touch = exact_touch(a, b)
                if touch is None:
                    raise ValueError('they touch in no point that is known')
                return {'distance': float(-radius)}, dict({'lower': exact(lower), 'upper': '0', 'normal': upper}, **touch)
            return {'distance': float(lower - radius)}, certificate
    if deep:  # in a plane, a shape in which there is no ball, or only the distance is asked
        found = contact_at(a, b, [D(1), D(0), D(0)], D(0), D(0), size, False)
        if not found:
            raise ValueError('no common point')
        found = {k: found[k] for k in 'ab'}
        if case['query'] == 'signed_distance':
            found['normal'] = flat_normal(shape_a, shape_b)
        return {'distance': float(-radius)}, dict({'lower': '0', 'upper': '0'}, **found)
    claim_a, p = common_point(a, parts, 1, STEP)
    claim_b, q = common_point(b, parts, 2, STEP)
    u = [x - y for x, y in zip(p, q)]
    uu = sum(x * x for x in u)
    upper = checker.root_above(uu)
    upper = F(text(of(upper) * (1 + D(10) ** -44), 48)) if upper else F(0)
    n = short([-x for x in v])
    nf = [F(x) for x in n]
    separation = -checker.reach(shape_b, [-x for x in nf]) - checker.reach(shape_a, nf)
    lower = separation / checker.root_above(sum(x * x for x in nf))
    lower = F(text(of(lower) - abs(of(lower)) * D(10) ** -43, 45))
    certificate = {'lower': exact(lower), 'upper': exact(upper), 'normal': n, 'a': claim_a, 'b': claim_b}
    return {'distance': float((lower + upper) / 2 - radius)}, certificate


def flat_normal(a, b):
    """A direction in which neither shape is thick."""
    edges = []
    for s in (a, b):
        v = [checker.point(s, k) for k in range(len(checker.vertices(Body(s).s)))]
        edges += [mix(p, -1, v[0]) for p in v[1:]]
    candidates = [[F(i == j) for j in range(3)] for i in range(3)]
    candidates += [cross(e, f) for e, f in itertools.combinations(edges, 2)]
    for n in candidates:
        if any(n) and -checker.reach(b, [-x for x in n]) - checker.reach(a, n) == 0:
            return [str(x) for x in n]
    raise ValueError('the difference is not flat')


def named_support(body, n):
    """A support point, exactly, and its claim."""
    p, k = body.support(n)
    if body.corners:
        m, t = body.exact
        c = checker.vertices(body.s)[k]
        return k, [sum(r[j] * c[j] for j in range(3)) + x for r, x in zip(m, t)]
    for step in range(0, 16):
        eps = D(10) ** (-30 + step)
        q = [F(text(x, 26)) for x in mix(p, eps, mix(body.centre, -1, p))]
        if is_inside(body, q):
            return [exact(x) for x in q], q
    raise ValueError('no support point inside')


def grow(a, b, size):
    """The depth of two solids: the polytope of their difference's points, grown where it is nearest."""
    tolerance = D(10) ** -11 * size if not (a.corners and b.corners) else D(0)
    points, claims, facets = [], [], []

    def add(n):
        ka, p = named_support(a, n)
        kb, q = named_support(b, [-x for x in n])
        w = [of(x - y) for x, y in zip(p, q)]
        if w not in points:
            points.append(w)
            claims.append([ka, kb])
            return len(points) - 1
        return None

    def plane(f):
        i, j, k = f
        n = cross(mix(points[j], -1, points[i]), mix(points[k], -1, points[i]))
        length = dot(n, n).sqrt()
        return ([x / length for x in n] if length else n), points[i]

    axes = [[D(x) for x in n] for n in itertools.product((-1, 0, 1), repeat=3) if any(n)]
    for n in axes:
        add([x + y * D('0.0137') for x, y in zip(n, (n[1], n[2] + 1, n[0] - 1))])
    flat = TINY * size
    tetra = None
    for ids in itertools.combinations(range(len(points)), 4):
        e = [mix(points[i], -1, points[ids[0]]) for i in ids[1:]]
        volume = dot(cross(e[0], e[1]), e[2])
        if abs(volume) > (size * D('1e-9')) ** 3:
            tetra = ids if volume < 0 else (ids[0], ids[2], ids[1], ids[3])
            break
    if tetra is None:
        return None
    i, j, k, l = tetra
    facets = [(i, j, k), (i, k, l), (i, l, j), (j, l, k)]
    planes = {f: plane(f) for f in facets}

    def insert(p):
        w = points[p]
        height = {f: dot(planes[f][0], mix(w, -1, planes[f][1])) for f in facets}
        if max(height.values()) <= flat:
            return False
        gone = [f for f in facets if height[f] >= -flat]
        edges = {(f[x], f[x - 2]) for f in gone for x in range(3)}
        for f in gone:
            facets.remove(f)
            del planes[f]
        for x, y in edges:
            if (y, x) not in edges:
                f = (x, y, p)
                facets.append(f)
                planes[f] = plane(f)
        return True

    for p in range(len(points)):
        if p not in tetra:
            insert(p)
    for _ in range(500):
        f = min(facets, key=lambda g: dot(planes[g][0], planes[g][1]))
        n, q = planes[f]
        offset = dot(n, q)
        h = dot(n, a.support(n)[0]) - dot(n, b.support([-x for x in n])[0])
        if offset > 0 and h - offset <= max(tolerance, size * D(10) ** -40):
            break
        p = add(n)
        if p is None or not insert(p):
            break
    ns = short(n)
    nf = [F(x) for x in ns]
    separation = -checker.reach(b.source, [-x for x in nf]) - checker.reach(a.source, nf)
    if offset <= size * D(10) ** -40:
        lower = F(0) if separation >= 0 else F(text(of(separation) * 2, 10))
        return (None, lower, ns) if h <= size * D(10) ** -40 else None
    used = sorted({i for f in facets for i in f})
    number = {i: k for k, i in enumerate(used)}
    lower = separation / F(str(sum(D(x) ** 2 for x in ns).sqrt()))
    lower = F(text(of(lower) - size * D(10) ** -40, 45))
    upper = -F(text(offset - size * D(10) ** -40, 45))
    certificate = {'lower': exact(lower), 'upper': exact(upper), 'normal': ns, 'points': [claims[i] for i in used],
                   'facets': [[number[i] for i in f] for f in facets]}
    return certificate, lower, upper


def derive(case):
    kind = derive_cast if case['query'] in ('ray', 'shape') else derive_distance
    old = case.get('expect', {})
    expect, certificate = kind(case)
    size = scale_of(case)
    tolerance = float('%.0e' % float(size * D('1e-12')))
    keep_known(old, expect, certificate, case)
    if 't' in expect and 't_abs_tol' not in expect:
        speed = float(sum(dec(x) ** 2 for x in (case['ray']['direction'] if 'ray' in case else case['direction'])).sqrt())
        lo, hi, value = F(certificate['t_lo']), F(certificate['t_hi']), F(expect['t'])
        certificate['within'] = within(lo, hi, value)
        n = [D(x) for x in certificate['normal']]
        d = [dec(x) for x in (case['ray']['direction'] if 'ray' in case else case['direction'])]
        cosine = abs(dot(n, d)) / (dot(n, n) * dot(d, d)).sqrt()
        allowed = max(float('%.0e' % (tolerance / speed / max(1e-7, float(cosine)))), 4 * certificate['within'])
        expect['t_abs_tol'] = max(old.get('t_abs_tol', 0), allowed)
    if 'distance' in expect:
        radius = F(0)
        if case['query'] == 'signed_distance':
            radius = checker.core(case['a'])[1] + checker.core(case['b'])[1]
        lo, hi = F(certificate['lower']) - radius, F(certificate['upper']) - radius
        certificate['within'] = within(lo, hi, F(expect['distance']))
        expect['abs_tol'] = max(old.get('abs_tol', 0), tolerance, 4 * certificate['within'])
    if 'normal' in old and expect.get('hit'):
        expect['normal'] = old['normal']
    return dict({k: v for k, v in case.items() if k not in ('expect', 'certificate')}, expect=expect, certificate=certificate)


def keep_known(old, expect, certificate, case):
    """A value that a case had stays if it lies between the bounds: it may be a rounder number."""
    if 't' in old and expect.get('t') and F(certificate['t_lo']) <= F(float(old['t'])) <= F(certificate['t_hi']):
        expect['t'] = old['t']
    if 'distance' in old:
        radius = F(0)
        if case['query'] == 'signed_distance':
            radius = checker.core(case['a'])[1] + checker.core(case['b'])[1]
        if F(certificate['lower']) - radius <= F(float(old['distance'])) <= F(certificate['upper']) - radius:
            expect['distance'] = old['distance']


def within(lo, hi, value):
    """A double that is no less than how far the value is from either bound."""
    w = max(abs(value - lo), abs(hi - value))
    return float('%.1e' % (float(w) * 1.1)) if w else 0.0


def main():
    for line in sys.stdin:
        case = json.loads(line)
        try:
            done = derive(case)
            complaint = checker.check(done)
        except Exception as wrong:  # a case that needs another idea
            done, complaint = case, repr(wrong)
        if complaint:
            print(f"{case['name']}: {complaint}", file=sys.stderr)
            continue
        print(json.dumps(done))
        sys.stdout.flush()


if __name__ == '__main__':
    main()
