#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Gathers what the site is made of: the documents as they are in the repository, the files that they link to, and a
gallery of the scenarios. usage: gather.py ROOT PROGRAM INTO"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT, PROGRAM, INTO = Path(sys.argv[1]).resolve(), sys.argv[2], Path(sys.argv[3]).resolve()
FIGURES = tomllib.loads((ROOT / "docs/site/figures.toml").read_text())
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)#\s:]+)(#[^)\s]*)?\)")
AS_THEY_ARE = {".svg", ".png", ".gif", ".pdf", ".md"}  # all others become pages that show their text
LANGUAGES = {".cpp": "cpp", ".hpp": "cpp", ".toml": "toml", ".csv": "text", ".py": "python", ".cff": "yaml"}
LARGEST_TEXT = 200_000  # bytes: nobody reads more on a page
gathered = set()


def place_of(path):
    """Where a file or folder of the repository is on the site, from its root."""
    if path == Path("README.md"):
        return Path("index.md")
    if (ROOT / path).is_dir():
        return path / "index.md"
    return path if path.suffix in AS_THEY_ARE else path.with_name(path.name + ".md")


def write(path, text):
    (INTO / path).parent.mkdir(parents=True, exist_ok=True)
    (INTO / path).write_text(text)


def gather(path):
    """Brings a file or folder of the repository onto the site, with all that it links to."""
    if path in gathered:
        return
    gathered.add(path)
    source = ROOT / path
    if source.is_dir():
        gather_folder(path)
    elif path.suffix == ".md":
        write(place_of(path), with_links(path, source.read_text()))
    elif path.suffix in AS_THEY_ARE:
        (INTO / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, INTO / path)
    else:
        text = source.read_text(errors="replace")[:LARGEST_TEXT]
        language = LANGUAGES.get(path.suffix, "text")
        write(place_of(path), f"# {path}\n\n````{language}\n{text.rstrip()}\n````\n")


def gather_folder(path):
    lines = [f"# {path}/\n"]
    for entry in sorted((ROOT / path).iterdir()):
        below = path / entry.name
        shown = entry.is_dir() or entry.suffix in AS_THEY_ARE | set(LANGUAGES)
        if not shown or entry.name.startswith("."):
            lines.append(f"- `{entry.name}`")
            continue
        gather(below)
        lines.append(f"- [{entry.name}{'/' if entry.is_dir() else ''}]({os.path.relpath(place_of(below), path)})")
    write(place_of(path), "\n".join(lines) + "\n")


def with_links(page, text):
    """The text of a document with its links as the site has them, and below each figure what made it."""
    def link(match):
        mark, words, target, anchor = match.groups()
        path = Path(os.path.normpath(page.parent / target))
        if not (ROOT / path).exists():
            sys.exit(f"{page}: there is no {target}")
        if path.parts[0] == "notebook":  # which is for those who have the repository
            return words
        gather(path)
        to = os.path.relpath(place_of(path), place_of(page).parent)
        shown = f"{mark}[{words}]({to}{anchor or ''})"
        if not mark:
            return shown
        if str(path) not in FIGURES:
            sys.exit(f"{page}: docs/site/figures.toml does not say what makes {path}")
        at = os.path.relpath("figures.md", place_of(page).parent)
        return f"[{shown}]({at}#{anchor_of(path)})"

    parts = re.split(r"(^```.*?^```)", text, flags=re.M | re.S)  # not in blocks of code
    return "".join(part if k % 2 else LINK.sub(link, part) for k, part in enumerate(parts))


def anchor_of(path):
    return re.sub(r"[^a-z0-9]+", "-", Path(path).stem.lower()).strip("-")


def figures_page():
    lines = ["# Figures\n", "What makes each figure of these pages.\n"]
    for path, command in FIGURES.items():
        if not (ROOT / path).exists():
            sys.exit(f"docs/site/figures.toml: there is no {path}")
        lines.append(f"## {Path(path).stem} {{#{anchor_of(path)}}}\n\n```text\n{command}\n```\n\n![{Path(path).stem}]({path})\n")
        gather(Path(path))
    write("figures.md", "\n".join(lines))


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], check=True, capture_output=True, text=True)


def picture(scenario, into, work):
    """Draws a moment of a scenario; False: it is too large, since whoever builds the site waits for it."""
    robots = tomllib.loads(scenario.read_text()).get("swarm", {}).get("robots", 0)
    if robots > 1000:
        return False
    out, moment = work / scenario.stem, 3 if robots >= 500 else 9
    run("run", scenario, "--out", out, "--quiet", "--set", f"mission.time_limit_s={moment}", "--set", "output.messages=false",
        "--set", "mission.stop_when_complete=false")
    svg = run("draw", out / "run.mcap", "--at", moment).stdout
    (INTO / into).parent.mkdir(parents=True, exist_ok=True)
    (INTO / into).write_text(svg)
    return True


def gallery():
    cards = {True: [], False: []}  # with a picture, without
    with tempfile.TemporaryDirectory() as folder:
        for scenario in sorted((ROOT / "scenarios").glob("*.toml")):
            about = tomllib.loads(scenario.read_text()).get("description", "")
            image = f"gallery/{scenario.stem}.svg"
            shown = picture(scenario, image, Path(folder))
            picture_html = f'<img src="{image}" alt="" loading="lazy">' if shown else '<span class="no-picture">large</span>'
            gather(Path("scenarios") / scenario.name)
            cards[shown].append(
                f'<li><a href="page/index.html#{scenario.stem}">{picture_html}<strong>{scenario.stem}</strong></a>'
                f'<p>{about}</p><p><a href="scenarios/{scenario.name}.html">its file</a></p></li>')
    write("gallery.md", "# Gallery\n\nEach of these plays in your browser, computed there, when you click it. "
          "Drag a target, kill a robot, go back and try something else.\n\n"
          f'<ul class="gallery">\n{chr(10).join(cards[True] + cards[False])}\n</ul>\n')


gather(Path("README.md"))
gather(Path("CONTRIBUTING.md"))
for document in sorted((ROOT / "docs").glob("*.md")):
    gather(Path("docs") / document.name)
figures_page()
gallery()
