# SPDX-License-Identifier: MIT
"""Markdown to HTML by markdown-it: GitHub's tables and anchors, links to pages rewritten to the site's files."""
import html
import pathlib
import posixpath
import re
import urllib.parse

from markdown_it import MarkdownIt

reader = MarkdownIt("commonmark").enable(["table", "strikethrough"])


def site_name(name):
    """File of the site for a file of the sources: README.md is its folder's index.html."""
    path = pathlib.PurePosixPath(name)
    if path.suffix != ".md":
        return name
    return str(path.with_name("index.html") if path.name == "README.md" else path.with_suffix(".html"))


def relative(target, page):
    """A link from one file of the site to another."""
    return posixpath.relpath(target, posixpath.dirname(page) or ".")


def plain_text(inline):
    """Text of a heading or a link, without its marks."""
    return "".join(plain_text(child) if child.children else child.content for child in inline.children or [])


class Page:
    """One Markdown file: its tokens, its title, and the files of the sources that it links to."""

    def __init__(self, root, name):
        self.root, self.name, self.output = root, name, site_name(name)
        self.tokens = reader.parse((root / name).read_text(encoding="utf-8"))
        self.title = name
        self.linked = []
        self._give_anchors()

    def _give_anchors(self):
        """Names headings as GitHub does: lower case, no punctuation, hyphens, a number if repeated."""
        seen = {}
        for opened, inline in zip(self.tokens, self.tokens[1:]):
            if opened.type != "heading_open":
                continue
            text = plain_text(inline)
            if opened.tag == "h1" and self.title == self.name:
                self.title = text
            slug = re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")
            count = seen.get(slug, 0)
            seen[slug] = count + 1
            opened.attrSet("id", f"{slug}-{count}" if count else slug)

    def inlines(self):
        for token in self.tokens:
            yield from (token.children or []) if token.type == "inline" else []

    def rewrite_links(self, titles):
        """Points links at the site's files and notes their sources. Links named `page.md` get the page's title."""
        all_inlines = list(self.inlines())
        for token, text in zip(all_inlines, all_inlines[1:] + all_inlines[:1]):
            key = {"link_open": "href", "image": "src"}.get(token.type)
            link = token.attrGet(key) if key else None
            if link is None or urllib.parse.urlsplit(link).scheme or link.startswith("#"):
                continue
            path, mark, fragment = link.partition("#")
            source = posixpath.normpath(posixpath.join(posixpath.dirname(self.name), urllib.parse.unquote(path)))
            if source.startswith("..") or not (self.root / source).exists():
                raise SystemExit(f"{self.name}: link to {link}: no such file")
            target = posixpath.join(source, "index.html") if (self.root / source).is_dir() else site_name(source)
            self.linked.append(source)
            if source in titles and posixpath.basename(text.content) == posixpath.basename(source):
                text.content = titles[source]
            token.attrSet(key, urllib.parse.quote(relative(target, self.output)) + mark + fragment)

    def body(self):
        return reader.renderer.render(self.tokens, reader.options, {})


def escaped(text):
    return html.escape(text, quote=True)
