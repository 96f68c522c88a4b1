# SPDX-License-Identifier: MIT
"""Types and docs of the Python module are true: python_docs_test.py SOURCES (PYTHONPATH: the module's folder)."""
import ast
import doctest
import enum
import importlib
import importlib.util
import inspect
import os
import pkgutil
import re
import subprocess
import sys
import tempfile
import unittest

import minkray as mk

SOURCES = sys.argv.pop(1)
# Fields that are there with jac=True or jac_error=True.
OF_JAC = {"jac", "jac_ray", "jac_body", "is_ridge", "jac_error_a", "jac_error_b", "jac_error",
          "jac_error_ray", "jac_error_body"}
FOLDER = os.path.join(SOURCES, "renderer/library/python/minkray")


def public(names):
    return {name for name in names if not name.startswith("_")}


def parameters(function):
    """Names, kinds and defaults, as both inspect and ast can tell them."""
    if isinstance(function, ast.FunctionDef):
        given = function.args
        plain = [argument.arg for argument in given.posonlyargs + given.args]
        defaults = [None] * (len(plain) - len(given.defaults)) + [ast.unparse(node) for node in given.defaults]
        found = [("", *pair) for pair in zip(plain, defaults)]
        if given.vararg:
            found.append(("*", given.vararg.arg, None))
        found += [("key", argument.arg, ast.unparse(default) if default else None)
                  for argument, default in zip(given.kwonlyargs, given.kw_defaults)]
        if given.kwarg:
            found.append(("**", given.kwarg.arg, None))
        return found
    kinds = {inspect.Parameter.VAR_POSITIONAL: "*", inspect.Parameter.VAR_KEYWORD: "**",
             inspect.Parameter.KEYWORD_ONLY: "key"}
    return [(kinds.get(one.kind, ""), one.name,
             None if one.default is inspect.Parameter.empty else repr(one.default))
            for one in inspect.signature(function).parameters.values()]


def is_plain_function(thing):
    return inspect.isfunction(thing)


class Stubs(unittest.TestCase):
    def setUp(self):
        nodes = []
        for name in "__init__.pyi", "_minkray.pyi", "shapes.py":
            with open(os.path.join(FOLDER, name)) as file:
                body = ast.parse(file.read()).body
            nodes += [node for node in body if name != "shapes.py" or getattr(node, "name", "") in mk.shapes.__all__]
        self.stub = {node.name: node for node in nodes
                     if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and node.name != "__getattr__"}
        self.values = {node.target.id for node in nodes if isinstance(node, ast.AnnAssign)}

    def test_have_what_is_public_and_nothing_else(self):
        modules = {name for name in vars(mk) if inspect.ismodule(getattr(mk, name))}
        self.assertEqual(public(vars(mk)) - modules, public(self.stub) | public(self.values))
        self.assertEqual(set(mk.__all__) - modules, public(self.stub) | public(self.values))

    def test_of_functions_have_their_parameters(self):
        checked = 0
        for name, node in self.stub.items():
            if isinstance(node, ast.FunctionDef):
                self.assertEqual(parameters(node), parameters(getattr(mk, name)), name)
                checked += 1
        self.assertGreater(checked, 25)

    def test_of_classes_have_their_members(self):
        for name, node in self.stub.items():
            if not isinstance(node, ast.ClassDef) or name == "Error":
                continue
            kind = getattr(mk, name)
            if issubclass(kind, enum.Enum):
                members = {one.targets[0].id: one.value.value for one in node.body}
                self.assertEqual(members, {one.name: one.value for one in kind}, name)
                continue
            methods = {one.name: one for one in node.body if isinstance(one, ast.FunctionDef)}
            fields = {one.target.id for one in node.body if isinstance(one, ast.AnnAssign)}
            there = {member for member in public(dir(kind))}
            self.assertEqual(there, public(methods), name)
            for member, stub in methods.items():
                if is_plain_function(getattr(kind, member)):
                    self.assertEqual(parameters(stub), parameters(getattr(kind, member)), f"{name}.{member}")
            for field in fields:  # those of the answers are told in the docs
                self.assertIn(field, inspect.getdoc(kind), f"{name}.{field}")

    def test_of_answers_have_the_fields_that_there_are(self):
        scene = mk.Scene()
        scene.add(mk.sphere(1))
        ray = [[-3, 0, 0, 1, 0, 0]]
        arm = mk.Scene()
        robot = arm.add_urdf(os.path.join(SOURCES, "examples/arm.urdf"))
        for answer in (scene.cast_rays(ray), scene.certify(ray), arm.clearance(robot, [[0, 0]]),
                       mk.signed_distance(mk.sphere(1), None, mk.sphere(1), None),
                       mk.time_of_impact(mk.sphere(1), None, None, mk.sphere(1), None, None)):
            node = self.stub[type(answer).__name__]
            fields = {one.target.id for one in node.body if isinstance(one, ast.AnnAssign)}
            self.assertEqual(fields - OF_JAC, set(vars(answer)), type(answer).__name__)
        pairs = (mk.sphere(1), None, mk.sphere(1), None)
        for answer in (scene.cast_rays(ray, jac=True, jac_error=True),
                       arm.clearance(robot, [[0, 0]], jac=True, jac_error=True),
                       mk.signed_distances(*pairs, jac=True, jac_error=True), mk.manifolds(*pairs),
                       mk.times_of_impact(*pairs[:2], None, *pairs[2:], None, jac=True, jac_error=True),
                       scene.distances(within=1, jac=True, jac_error=True), scene.nearest([0, 0, 0], jac=True, jac_error=True),
                       scene.time_of_impact(mk.sphere(1), None, [0] * 6, jac=True, jac_error=True)):
            node = self.stub[type(answer).__name__]
            fields = {one.target.id for one in node.body if isinstance(one, ast.AnnAssign)}
            self.assertEqual(fields, set(vars(answer)), type(answer).__name__)

    def test_are_what_mypy_takes_the_examples_for(self):
        try:
            from mypy import api
        except ImportError:
            self.skipTest("needs mypy")
        examples = os.path.join(SOURCES, "examples")
        files = [os.path.join(examples, name) for name in os.listdir(examples) if name.endswith(".py")]
        self.assertGreaterEqual(len(files), 3)
        os.environ["MYPYPATH"] = os.path.dirname(FOLDER)
        said, complaint, code = api.run(["--cache-dir", os.devnull, "--check-untyped-defs",
                                         "--disallow-any-unimported", *files])
        self.assertEqual(code, 0, said + complaint)
        with tempfile.NamedTemporaryFile("w", suffix=".py") as file:
            file.write("import minkray as mk\n" + "".join(f"reveal_type(mk.{name})\n" for name in mk.shapes.__all__))
            file.flush()
            said, complaint, code = api.run(["--cache-dir", os.devnull, file.name])
        self.assertEqual(code, 0, said + complaint)
        shown = re.findall(r'note: Revealed type is "def \((.*)\) -> minkray._minkray.Shape"', said)
        self.assertEqual(len(shown), len(mk.shapes.__all__), said)
        for name, arguments in zip(mk.shapes.__all__, shown):
            self.assertEqual(re.findall(r"(\w+): ", arguments), list(inspect.signature(getattr(mk, name)).parameters))


class Docs(unittest.TestCase):
    def things(self):
        for name in mk.__all__:
            thing = getattr(mk, name)
            if inspect.isclass(thing):
                yield name, thing
                for member in public(vars(thing)):
                    if callable(getattr(thing, member)) or isinstance(vars(thing)[member], property):
                        yield f"{name}.{member}", getattr(thing, member)
            elif callable(thing):
                yield name, thing

    def test_are_there(self):
        for name, thing in self.things():
            if name != "Error":
                self.assertTrue(inspect.getdoc(thing), f"{name} has no docs")

    def test_tell_what_every_parameter_is(self):
        for name, thing in self.things():
            if not is_plain_function(thing):
                continue
            docs = inspect.getdoc(thing)
            for kind, parameter, _ in parameters(thing):
                if parameter == "self":
                    continue
                self.assertIn(parameter, docs, f"{name} does not tell of {parameter}")

    def test_have_examples_that_run(self):
        attempted = 0
        for module in [mk] + [importlib.import_module("minkray." + found.name)
                              for found in pkgutil.iter_modules(mk.__path__)]:
            result = doctest.testmod(module)
            self.assertEqual(result.failed, 0, module.__name__)
            attempted += result.attempted
        self.assertGreater(attempted, 15)


class Pages(unittest.TestCase):
    def test_readme_shows_what_was_run(self):
        with open(os.path.join(SOURCES, "README.md")) as file:
            blocks = re.findall("```python\n(.*?)```", file.read(), re.DOTALL)
        self.assertEqual(len(blocks), 1)
        ran = subprocess.run([sys.executable, "-W", "error", "-c", blocks[0]], capture_output=True, text=True)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertIn("bumper", ran.stdout)

    def test_page_shows_what_is_answered(self):
        """What stands behind a print is what it prints, but for blanks."""
        with open(os.path.join(SOURCES, "docs/python.md")) as file:
            blocks = re.findall("```python\n(.*?)```", file.read(), re.DOTALL)
        self.assertEqual(len(blocks), 5)
        program = "".join(blocks)
        expected = re.findall(r"^print\(.*\)\s+# (.*)$", program, re.MULTILINE)
        self.assertEqual(len(expected), program.count("print("))
        environment = dict(os.environ)
        if importlib.util.find_spec("torch") is None:
            stand_in = os.path.join(SOURCES, "tests/renderer/library/without_torch")
            environment["PYTHONPATH"] = os.pathsep.join([stand_in, os.environ["PYTHONPATH"]])
        program = program.replace("print(", "print('>', ")
        with tempfile.TemporaryDirectory() as folder:  # the page writes there
            os.symlink(os.path.join(SOURCES, "examples"), os.path.join(folder, "examples"))
            ran = subprocess.run([sys.executable, "-c", program], cwd=folder, capture_output=True, text=True,
                                 env=environment)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        found = [re.sub(r"\s", "", text) for text in ran.stdout.split(">")[1:]]
        self.assertEqual(found, [re.sub(r"\s", "", text) for text in expected])


if __name__ == "__main__":
    unittest.main()
