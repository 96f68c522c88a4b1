#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Changes digits of a proof of a robot of balls: minkray-check must notice what matters.

    mutate_proof.py MINKRAY_CHECK PROOF.json MUTANTS

As it is, the proof holds. With a digit changed its fingerprint is wrong. With a digit changed and
the fingerprint made anew the checker may only accept what is true all the same: then the balls,
placed by kinematics of this program's own at 600 moments, stay as far apart as is claimed.
"""

import hashlib
import json
import math
import random
import re
import sys
import tempfile
from importlib.machinery import SourceFileLoader

import numpy as np


def signed(text):
    return text + ',"sha256":"' + hashlib.sha256(text.encode()).hexdigest() + '"}\n'


def turn(axis, angle):
    """Rodrigues' formula, by what it does to the axes."""
    columns = []
    for v in np.eye(3):
        columns.append(
            v * math.cos(angle)
            + np.cross(axis, v) * math.sin(angle)
            + axis * (axis @ v) * (1 - math.cos(angle))
        )
    return np.array(columns).T


def hermite(p, q, u, v, s):
    return ((2 * s + 1) * (1 - s) ** 2) * p + s * (1 - s) ** 2 * u + s * s * (3 - 2 * s) * q + s * s * (s - 1) * v


def centres(proof, step, s):
    times = proof["times"]
    h = times[step + 1] - times[step]
    values, joint_at = [], 0
    poses = []
    for link in proof["links"]:
        pose = np.eye(4)
        pose[:3, :3] = np.reshape(link["turn"], (3, 3))
        pose[:3, 3] = link["origin"]
        if link["parent"] >= 0:
            pose = poses[link["parent"]] @ pose
        for joint in link["joints"]:
            p, q = proof["values"][step][joint_at], proof["values"][step + 1][joint_at]
            u, v = (proof["rates"][step + k][joint_at] if proof["rates"] else [] for k in (0, 1))
            joint_at += 1
            if not p:
                continue
            if u and v and h > 0:
                x = hermite(p[0], q[0], h * u[0], h * v[0], s)
            else:
                x = p[0] + s * (q[0] - p[0])
            move = np.eye(4)
            axis = np.array(joint["axis"], dtype=float)
            if joint["kind"] == "hinge":
                move[:3, :3] = turn(axis, x - joint["reference"])
                anchor = np.array(joint["anchor"])
                move[:3, 3] = anchor - move[:3, :3] @ anchor
            else:
                move[:3, 3] = (x - joint["reference"]) * axis
            pose = pose @ move
        poses.append(pose)
    placed = []
    for body in proof["bodies"]:
        middle = np.append(body["middle"], 1)
        placed.append((poses[body["link"]] @ middle if body["link"] >= 0 else middle)[:3])
    return placed


def least(proof):
    found = math.inf
    steps = len(proof["times"]) - 1
    for step in range(steps):
        for k in range(600 // steps + 1):
            at = centres(proof, step, k / (600 // steps))
            for a, b, margin in proof["pairs"]:
                radii = proof["bodies"][a]["radius"] + proof["bodies"][b]["radius"] + margin
                found = min(found, np.linalg.norm(at[a] - at[b]) - radii)
    return found


def main(program, file, count):
    checker = SourceFileLoader("checker", program).load_module()
    text = open(file).read()
    body = text[: text.rindex(',"sha256":"')]
    assert signed(body) == text
    print(checker.check(file))
    proof = json.loads(text)
    assert all(one["core"] == "point" for one in proof["bodies"])
    honest = least(proof)
    assert honest >= proof["lower"] and honest < 1.05 * proof["lower"], (honest, proof["lower"])

    def accepts(mutant):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as stream:
            stream.write(mutant)
            stream.flush()
            try:
                checker.check(stream.name)
                return True
            except (checker.Wrong, KeyError, TypeError, ValueError, IndexError):
                return False

    # The parts that say something of bodies and planes; not the files' names and fingerprints.
    begin = body.index('"links"')
    digits = [m.start() for m in re.finditer(r"[0-9]", body) if m.start() > begin]
    claim = body.index('"lower":') + 8
    claim_digits = [k for k in range(claim, body.index(",", claim)) if body[k].isdigit()]
    chance = random.Random(7)
    refused = accepted = 0
    for k in range(int(count)):
        at = chance.choice(claim_digits if k % 10 == 0 else digits)
        other = chance.choice([d for d in "0123456789" if d != body[at]])
        mutant = body[:at] + other + body[at + 1 :]
        assert not accepts(text[:at] + other + text[at + 1 :]), "the fingerprint was not looked at"
        if not accepts(signed(mutant)):
            refused += 1
            continue
        accepted += 1
        changed = json.loads(signed(mutant))
        found = least(changed)
        assert found >= changed["lower"] - 1e-9, (at, body[at - 40 : at + 20], other, found)
    print(f"{refused} refused, {accepted} accepted, and true")
    # What is claimed beyond what is true is never accepted.
    for wrong in (1.2 * honest, 10 * honest, -1, 0):
        bad = dict(proof, lower=wrong)
        del bad["sha256"]
        assert not accepts(signed(json.dumps(bad, separators=(",", ":"))[:-1])), wrong
    # Nor is a proof that lacks a plane.
    needed = 0
    for k in range(len(proof["planes"])):
        bad = dict(proof, planes=proof["planes"][:k] + proof["planes"][k + 1 :])
        del bad["sha256"]
        needed += 0 if accepts(signed(json.dumps(bad, separators=(",", ":"))[:-1])) else 1
    assert needed > 0.5 * len(proof["planes"]), needed
    assert refused > accepted / 4
    print(f"{needed} of {len(proof['planes'])} planes cannot be left out")


if __name__ == "__main__":
    main(*sys.argv[1:])
