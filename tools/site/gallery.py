# SPDX-License-Identifier: MIT
"""The gallery: the pictures of images/ as the pages show them, with their captions and commands."""
import posixpath

from markdown_pages import escaped, reader, relative

folder = "images"


def caption_after(tokens, at):
    """HTML of what follows a picture: a block of commands, or a paragraph in italics."""
    if at >= len(tokens):
        return ""
    if tokens[at].type in ("code_block", "fence") and "./run" in tokens[at].content:
        return f"<pre><code>{escaped(tokens[at].content)}</code></pre>\n"
    if tokens[at].type == "paragraph_open" and tokens[at + 1].content.startswith("*"):
        return reader.renderer.render(tokens[at:at + 3], reader.options, {})
    return ""


def pictures(page):
    """File of the site, description, caption and anchor of each picture of a page whose links are rewritten."""
    anchor = ""
    for at, token in enumerate(page.tokens):
        if token.type == "heading_open":
            anchor = token.attrGet("id")
        if token.type != "inline":
            continue
        for child in token.children:
            if child.type != "image":
                continue
            target = posixpath.normpath(posixpath.join(posixpath.dirname(page.output), child.attrGet("src")))
            if target.startswith(folder + "/"):
                yield target, child.content, caption_after(page.tokens, at + 2), anchor


def rebased(caption, page, output):
    """A caption's links seen from the gallery."""
    start = posixpath.dirname(page.output)
    parts = caption.split('href="')
    for i in range(1, len(parts)):
        link, rest = parts[i].split('"', 1)
        if ":" not in link:
            path, mark, fragment = link.partition("#")
            path = relative(posixpath.normpath(posixpath.join(start, path)) if path else page.output, output)
            link = path + mark + fragment
        parts[i] = f'{link}"{rest}'
    return 'href="'.join(parts)


def gallery(root, pages, output):
    """Body of the gallery; each picture once, below the page that shows it first, the front page last."""
    shown, lines = set(), ["<h1>Gallery</h1>"]
    for page in pages:
        figures = []
        for target, description, caption, anchor in pictures(page):
            if target in shown:
                continue
            shown.add(target)
            figures.append(f'<figure>\n<a href="{relative(target, output)}"><img src="{relative(target, output)}" '
                           f'alt="{escaped(description)}" loading="lazy"></a>\n<figcaption>'
                           f'<a href="{relative(page.output, output)}#{anchor}">{escaped(description)}</a>\n'
                           f"{rebased(caption, page, output)}</figcaption>\n</figure>")
        if figures:
            lines.append(f'<h2>{escaped(page.title)}</h2>\n<div class="gallery">')
            lines += figures + ["</div>"]
    for file in sorted((root / folder).rglob("*.png")):
        name = file.relative_to(root).as_posix()
        if name not in shown:
            raise SystemExit(f"{name}: no page shows this picture")
    return "\n".join(lines) + "\n"
