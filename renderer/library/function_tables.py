#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tables of functions in docs/c.md, docs/cpp.md and docs/python.md, made of the headers and the Python module:

function_tables.py SOURCES            writes them between the pages' marks
function_tables.py SOURCES --check    exits with 1 if a page has others
"""
import ast
import os
import re
import sys

BEGIN, END = "<!-- made by renderer/library/function_tables.py -->\n", "<!-- end -->\n"


def first_phrase(text):
    """The first sentence of a comment, or what is in front of its first colon outside of parentheses."""
    text = re.sub(r"\s+", " ", text).strip()
    text = re.sub(r"^[a-z ]+ : ", "", text)  # of a property: its type
    text = re.split(r"(?<=[^.\s])[.;](?:\s|$)", text, maxsplit=1)[0]
    colons = [at.start() for at in re.finditer(r":\s", text)]
    outside = (at for at in colons if text.count("(", 0, at) == text.count(")", 0, at))
    before = text[: next(outside, len(text))]
    text = before if len(before.split()) >= 3 else text
    return text.replace("|", "\\|")


class Table:
    """Rows of names and what they are; names without a comment join the row before them."""

    def __init__(self):
        self.parts = []
        self.seen = set()

    def part(self, title):
        self.parts.append((title, []))

    def add(self, name, comment):
        if name in self.seen:
            return
        self.seen.add(name)
        rows = self.parts[-1][1]
        said = first_phrase(comment)
        if not said and rows:
            rows[-1][0].append(name)
        else:
            rows.append(([name], said))

    def text(self, strip=""):
        lines = ["| | |", "|---|---|"]
        for title, rows in self.parts:
            if rows:
                lines.append(f"| **{title}** | |")
            for names, said in rows:
                lines.append(f"| {', '.join(f'`{name.removeprefix(strip)}`' for name in names)} | {said} |")
        return "\n".join(lines) + "\n"


def c_table(folder):
    table = Table()
    table.part("errors")
    for header in "minkray_c.h", "minkray_c_pairs.h":
        with open(os.path.join(folder, header), encoding="utf-8") as file:
            text = file.read()
        declared = re.compile(r"/\* ---- ([^-]+?) -+ \*/"  # a part
                              r"|(?:/\*((?:[^*]|\*(?!/))*)\*/\n)?MINKRAY_API (?!_)[^;(]*?(\w+)\(")  # a function
        for match in declared.finditer(text):
            part, comment, name = match.groups()
            if part:
                table.part(part)
            else:
                table.add(name, re.sub(r"^ \* ", "", comment or "", flags=re.MULTILINE))
    return table.text("minkray_")


def cpp_table(folder):
    table = Table()
    parts = {"minkray.h": "basics", "pairs.h": "pairs", "ray_derivatives.h": "derivatives of rays"}
    for header, part in parts.items():
        with open(os.path.join(folder, header), encoding="utf-8") as file:
            lines = file.read().split("inline namespace v0 {", 1)[1].split("\n")
        scope, is_detail, comment = None, False, []
        table.part(part)
        for line in lines:
            if match := re.match(r"// ---- (.*) ----$", line):
                table.part(match[1])
            if line.startswith("namespace detail {"):
                is_detail = True
            elif line.startswith("}  // namespace detail"):
                is_detail = False
            elif match := re.match(r"\s*///? ?(.*)", line):
                comment.append(match[1])
                continue
            elif line.startswith("template") or line.startswith("requires"):
                continue
            elif not is_detail:
                of_class = re.match(r"(?:class|struct|enum) (\w+)\b.*\{$", line)
                of_function = re.match(r"(?:inline )?(?:[\w:<>*&]+ )+\*?&?(\w+)\(", line)
                of_member = re.match(r"  (?:[\w:<>*&]+ )+\*?&?(\w+)\(.*(?:[{;,]|\} *)$", line)
                if of_class:
                    scope = of_class[1]
                    table.add(scope, " ".join(comment))
                elif line.startswith("}"):
                    scope = None
                elif scope == "Scene" and of_member and "return " not in line and of_member[1] not in ("check",):
                    table.add("Scene::" + of_member[1], " ".join(comment))
                elif of_function and not line.startswith((" ", "static_assert")) and "::" not in line.split("(")[0]:
                    table.add(of_function[1], " ".join(comment))
            comment = []
    return table.text()


def python_declarations(folder):
    """What the module declares: nodes of its stub, and of the modules from which the stub imports."""
    def nodes_of(name):
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            return ast.parse(file.read()).body

    for node in nodes_of("__init__.pyi"):
        if isinstance(node, ast.ImportFrom) and node.level:
            names = {one.name for one in node.names}
            has_stub = os.path.exists(os.path.join(folder, f"{node.module}.pyi"))
            for other in nodes_of(f"{node.module}.pyi" if has_stub else f"{node.module}.py"):
                if isinstance(other, (ast.FunctionDef, ast.ClassDef)):
                    if other.name in names or ("*" in names and other.decorator_list):
                        yield other
        else:
            yield node


def python_table(folder):
    """Declarations of the stubs, with the docs of the modules."""
    docs = {}
    for name in sorted(os.listdir(folder)):
        if not name.endswith(".py"):
            continue
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            tree = ast.parse(file.read())
        for node in tree.body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and not node.name.startswith("_"):
                docs.setdefault(node.name, ast.get_docstring(node) or "")
                for member in node.body if isinstance(node, ast.ClassDef) else ():
                    if isinstance(member, ast.FunctionDef):
                        docs.setdefault(f"{node.name}.{member.name}", ast.get_docstring(member) or "")
                        docs.setdefault(f".{member.name}", ast.get_docstring(member) or "")
    with open(os.path.join(folder, "../bind_shapes.cpp"), encoding="utf-8") as file:
        docs["Shape"] = re.search(r'"Shape",\s*"([^".]*)', file.read())[1]
    nodes = list(python_declarations(folder))
    table = Table()
    table.part("functions")
    for node in nodes:
        if isinstance(node, ast.FunctionDef):
            table.add(node.name, docs[node.name])
    table.part("results and other classes")
    for node in nodes:
        if isinstance(node, ast.ClassDef) and node.name not in ("Scene", "Error"):
            table.add(node.name, docs.get(node.name, ""))
    for node in nodes:
        if isinstance(node, ast.ClassDef) and node.name in ("Scene", "Robot"):
            table.part(node.name)
            for member in node.body:
                if isinstance(member, ast.FunctionDef) and not member.name.startswith("_"):
                    table.add(f"{node.name}.{member.name}", docs.get(f"{node.name}.{member.name}", docs.get(f".{member.name}", "")))
    return table.text()


def main(sources, check):
    headers = os.path.join(sources, "include/minkray")
    module = os.path.join(sources, "renderer/library/python/minkray")
    stale = 0
    for page, table in (("c", c_table(headers)), ("cpp", cpp_table(headers)), ("python", python_table(module))):
        name = os.path.join(sources, f"docs/{page}.md")
        with open(name, encoding="utf-8") as file:
            text = file.read()
        front, rest = text.split(BEGIN)
        made = front + BEGIN + table + END + rest.split(END)[1]
        if made == text:
            continue
        if check:
            print(f"docs/{page}.md: its table is not that of the headers: renderer/library/function_tables.py SOURCES")
            stale = 1
        else:
            with open(name, "w", encoding="utf-8") as file:
                file.write(made)
    return stale


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], "--check" in sys.argv[2:]))
