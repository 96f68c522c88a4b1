# SPDX-License-Identifier: MIT
"""Pages of the inspector, made by `minkray inspect`, and the page that lists them."""
import json
import shutil
import subprocess

from markdown_pages import escaped

folder = "inspector"
scenes = ["shape-zoo", "figure-1", "penetration"]
options = ["-r", "480x270", "-s", "16"]


def make(root, program, site):
    """Writes the pages into the site's folder; returns the body of the list."""
    (site / folder).mkdir()
    lines = ["<h1>Inspector</h1>",
             "<p>Each page replays the solver at each pixel, step by step; it works offline.</p>", "<ul>"]
    for name in scenes:
        scene, page = root / "scenes" / f"{name}.json", site / folder / f"{name}.html"
        command = [str(shutil.which(program) or program), "inspect", str(scene), *options, "-q", "-o", str(page)]
        if subprocess.run(command).returncode != 0:
            raise SystemExit(f"{scene}: {' '.join(command)}: failed")
        description = json.loads(scene.read_text(encoding="utf-8")).get("description", "")
        lines.append(f'<li><a href="{name}.html">{name}</a> ({page.stat().st_size / 1e6:.1f} MB): '
                     f"{escaped(description)}\n<pre><code>./run inspect {name} {' '.join(options)} -o {name}.html"
                     "</code></pre></li>")
    return "\n".join(lines + ["</ul>"]) + "\n"
