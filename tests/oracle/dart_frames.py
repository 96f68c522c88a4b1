# SPDX-License-Identifier: MIT
"""Where DART (python3-dartpy) puts the links of a URDF, for random values of its joints.

dart_frames.py FILE STATES SEED OUT: writes JSON to OUT, a list of states, each with the joints' values and
the links' frames (three rows of four numbers). Exit code 77: dartpy is not installed.
"""
import json
import random
import sys
import xml.etree.ElementTree

try:
    import dartpy as dart
except ImportError:
    sys.exit(77)


def main():
    file, states, seed, out = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
    # DART refuses a robot of which a mesh is missing; frames need none.
    tree = xml.etree.ElementTree.parse(file)
    for link in tree.getroot().iter("link"):
        for shape in link.findall("visual") + link.findall("collision"):
            link.remove(shape)
    tree.write(out + ".urdf")
    skeleton = dart.utils.DartLoader().parseSkeleton(out + ".urdf")
    if skeleton is None:
        sys.exit(78)
    rng = random.Random(seed)
    result = []
    for _ in range(states):
        values = {}
        for i in range(skeleton.getNumJoints()):
            joint = skeleton.getJoint(i)
            if joint.getNumDofs() == 1:
                values[joint.getName()] = rng.uniform(-3, 3)
                joint.setPosition(0, values[joint.getName()])
        frames = {}
        for i in range(skeleton.getNumBodyNodes()):
            body = skeleton.getBodyNode(i)
            matrix = body.getWorldTransform().matrix()
            frames[body.getName()] = [[float(matrix[r][c]) for c in range(4)] for r in range(3)]
        result.append({"values": values, "frames": frames})
    with open(out, "w") as stream:
        json.dump(result, stream)


main()
