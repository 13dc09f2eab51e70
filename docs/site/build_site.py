#!/usr/bin/env python3
"""Gathers the pages of the manual for mkdocs, by their paths in the tree, and has the site built.

  build_site.py     builds build/docs; needs mkdocs, its theme, KaTeX, and no network

Pages link to files of the tree as one reads it, so the site keeps its paths: what a page links to comes
with it, and a folder without a README gets a page that lists it.
"""

import html
import os
import pathlib
import re
import shutil
import subprocess
import sys

TREE = pathlib.Path(__file__).resolve().parents[2]
PAGES = TREE / "build/docs_pages"
SITE = TREE / "build/docs"
KATEX = pathlib.Path("/usr/share/javascript/katex")
FIRST = ("README.md", "docs/README.md")
LINK = re.compile(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\]\()([^()\s#]+)((?:#[^()\s]*)?\))")


def target_of(page, link):
    """The path in the tree that a relative link of a page leads to, or None."""
    if re.match(r"^[a-z][a-z0-9+.-]*:", link):
        return None
    path = pathlib.Path(os.path.normpath(page.parent / link))
    return path if (TREE / path).exists() else None


def listing(folder):
    """A page for a folder that has none."""
    names = sorted(child.name for child in (TREE / folder).iterdir() if not child.name.startswith("."))
    lines = [f"# {folder}", ""] + [f"- [{name}]({name})" for name in names if (TREE / folder / name).is_file()]
    return "\n".join(lines) + "\n"


class Gatherer:
    def __init__(self):
        self.waiting, self.known = [], set()

    def add(self, path):
        if path not in self.known:
            self.known.add(path)
            self.waiting.append(path)

    def link(self, page, match):
        before, link, after = match.groups()
        path = target_of(page, link)
        if path is None:
            return match.group(0)
        if (TREE / path).is_dir():
            name = "README.md" if (TREE / path / "README.md").exists() else "index.md"
            path, link = path / name, link.rstrip("/") + "/" + name
        self.add(path)
        return before + link + after

    def text(self, page):
        """A page for mkdocs: what stands behind a fence's language is for tests, and folders are pages."""
        out, is_fenced = [], None
        for line in (TREE / page).read_text(encoding="utf-8").split("\n"):
            fence = re.match(r"^(\s*)(`{3,})\s*(\S*)", line)
            if fence and is_fenced is None:
                is_fenced = fence.group(2)
                line = fence.group(1) + fence.group(2) + fence.group(3)
            elif fence and fence.group(2) == is_fenced and not fence.group(3):
                is_fenced = None
            elif is_fenced is None:
                # mkdocs takes what belongs to an entry of a list only where it is indented by four.
                line = re.sub(r"^ {2,3}(?=\S)", "    ", line)
                line = LINK.sub(lambda match: self.link(page, match), line)
            out.append(line)
        return "\n".join(out)

    def gather(self):
        while self.waiting:
            path = self.waiting.pop()
            goal = PAGES / path
            goal.parent.mkdir(parents=True, exist_ok=True)
            if path.suffix == ".md" and (TREE / path).exists():
                goal.write_text(self.text(path), encoding="utf-8")
            elif path.name == "index.md" and not (TREE / path).exists():
                for child in (TREE / path.parent).iterdir():
                    if child.is_file():
                        self.add(path.parent / child.name)
                goal.write_text(listing(path.parent), encoding="utf-8")
            else:
                shutil.copyfile(TREE / path, goal)


def foreign_resources():
    """What a page of the site would fetch from elsewhere."""
    found = []
    for page in SITE.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        for tag in re.findall(r"<(?:script|link|img|iframe|source)\b[^>]*>", text):
            for place in re.findall(r"(?:src|href)=\"?((?:https?:)?//[^\"\s>]+)", tag):
                if "rel=canonical" not in tag and 'rel="canonical"' not in tag:
                    found.append(f"{page.relative_to(SITE)}: {html.unescape(place)}")
    return sorted(set(found))


def main():
    for folder in (PAGES, SITE):
        shutil.rmtree(folder, ignore_errors=True)
    gatherer = Gatherer()
    config = (TREE / "docs/site/mkdocs.yml").read_text(encoding="utf-8")
    for page in (*FIRST, *re.findall(r"[\w./-]+\.md\b", config.partition("\nnav:")[2])):
        gatherer.add(pathlib.Path(page))
    gatherer.gather()
    (PAGES / "site").mkdir()
    for name in ("site.css", "equations.js"):
        shutil.copyfile(TREE / "docs/site" / name, PAGES / "site" / name)
    shutil.copytree(KATEX, PAGES / "site/katex")
    (TREE / "build/mkdocs.yml").write_text(config, encoding="utf-8")
    outcome = subprocess.run(["mkdocs", "build", "--strict", "--quiet", "-f", str(TREE / "build/mkdocs.yml")], check=False)
    if outcome.returncode != 0:
        return outcome.returncode
    foreign = foreign_resources()
    for place in foreign:
        print(f"build_site: expected nothing from elsewhere, found {place}", file=sys.stderr)
    print(f"{len(list(SITE.rglob('*.html')))} pages; open {SITE.relative_to(TREE)}/index.html")
    print(f"For the search, serve them: python3 -m http.server --directory {SITE.relative_to(TREE)}")
    return 1 if foreign else 0


if __name__ == "__main__":
    sys.exit(main())
