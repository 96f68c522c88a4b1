# SPDX-License-Identifier: MIT
"""The command line: python -m minkray render robot.urdf -o robot.png"""
import os
import shutil
import sys


def main():
    """Becomes the program that the wheel has, or the installed one."""
    program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bin", "minkray")
    if not os.path.exists(program):
        installed = shutil.which("minkray")
        if installed is None:
            sys.exit("minkray: the program must be in the wheel or in PATH, and is in neither")
        program = installed
    os.execv(program, ["minkray", *sys.argv[1:]])


if __name__ == "__main__":
    main()
