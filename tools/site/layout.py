# SPDX-License-Identifier: MIT
"""The frame around each page: head, navigation, style."""
from markdown_pages import escaped, plain_text, relative

generator = "Minkray site"


def sections(index):
    """Headings of docs/README.md with the links below each: the one list of pages."""
    found, heading = [], False
    for token in index.tokens:
        if token.type == "heading_open" and token.tag == "h2":
            heading = True
        elif token.type == "inline" and heading:
            found.append((plain_text(token), []))
            heading = False
        elif token.type == "inline" and found:
            found[-1][1].extend(child.attrGet("href") for child in token.children if child.type == "link_open")
    return found


class Layout:
    """Groups are (heading, [(file of the site, title), ...])."""

    def __init__(self, groups):
        self.groups = groups

    def _navigation(self, page):
        lines = ['<nav aria-label="Pages">']
        for heading, entries in self.groups:
            lines.append(f"<h2>{escaped(heading)}</h2>\n<ul>" if heading else "<ul>")
            for target, title in entries:
                current = ' aria-current="page"' if target == page else ""
                lines.append(f'<li><a href="{escaped(relative(target, page))}"{current}>{escaped(title)}</a></li>')
            lines.append("</ul>")
        return "\n".join(lines + ["</nav>"])

    def whole(self, page, title, body):
        full_title = title if title == "Minkray" else f"{title} - Minkray"
        return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="{generator}">
<title>{escaped(full_title)}</title>
<link rel="stylesheet" href="{relative('style.css', page)}">
</head>
<body>
{self._navigation(page)}
<main>
{body}</main>
</body>
</html>
"""
