# SPDX-License-Identifier: MIT
"""Checks a folder of HTML files: each link leads to a file of the folder, and to an anchor where it names one."""
import html.parser
import os
import pathlib
import posixpath
import sys
import urllib.parse

from layout import generator


class Links(html.parser.HTMLParser):
    """Links, anchors, and what the page loads. Pages of other programs have no known anchors."""

    def __init__(self, text):
        super().__init__()
        self.links, self.loads, self.anchors, self.of_site = [], [], set(), False
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        named = dict(attrs)
        if "id" in named:
            self.anchors.add(named["id"])
        if tag == "meta" and named.get("content") == generator:
            self.of_site = True
        if tag == "a" and "href" in named:
            self.links.append(named["href"])
        elif "href" in named or "src" in named:
            self.loads.append(named.get("href") or named.get("src"))


def wrong_link(folder, pages, name, link):
    """Reason why a link leads nowhere, or nothing."""
    parts = urllib.parse.urlsplit(link)
    if link.startswith("/"):
        return "absolute paths depend on the web host"
    path = urllib.parse.unquote(parts.path)
    target = posixpath.normpath(posixpath.join(posixpath.dirname(name), path)) if path else name
    if target.startswith("..") or not (folder / target).is_file():
        return "no such file"
    page = pages.get(target)
    if parts.fragment and page and page.of_site and urllib.parse.unquote(parts.fragment) not in page.anchors:
        return "no such anchor"
    return ""


def errors(folder):
    """One line per wrong link, and the number of links that were checked."""
    folder = pathlib.Path(folder)
    names = sorted(os.path.relpath(file, folder) for file in folder.rglob("*.html"))
    pages = {name: Links((folder / name).read_text(encoding="utf-8")) for name in names}
    lines, count = [], 0
    for name, page in pages.items():
        if not page.of_site:
            continue
        for link in page.links + page.loads:
            outside = urllib.parse.urlsplit(link).scheme in ("http", "https", "mailto")
            why = "is loaded from another host" if outside and link in page.loads else ""
            if not outside:
                why = wrong_link(folder, pages, name, link)
            count += 1
            if why:
                lines.append(f"{name}: {link}: {why}")
    return lines, count


if __name__ == "__main__":
    found, checked = errors(sys.argv[1])
    print("\n".join(found + [f"{checked} links checked, {len(found)} wrong"]))
    sys.exit(1 if found else 0)
