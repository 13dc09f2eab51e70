#!/usr/bin/env python3
"""Gathers the pages of the manual for mkdocs, by their paths in the tree, and has the site built.

  build_site.py              builds build/docs; needs mkdocs, its theme, KaTeX, doxygen, and no network
  build_site.py --into DIR   builds DIR, without the reference of the C++ code, as a package has it

Pages link to files of the tree as one reads it, so the site keeps its paths: what a page links to comes
with it, and a folder without a README gets a page that lists it.
"""

import argparse
import html
import os
import pathlib
import re
import shutil
import subprocess
import sys

TREE = pathlib.Path(__file__).resolve().parents[2]
KATEX = pathlib.Path("/usr/share/javascript/katex")
FIRST = ("README.md", "docs/README.md")
# Where the reference of the C++ code is made; the page that names it leads to it on the site.
CODE = TREE / "build/doxygen"
CODE_NAME = "`build/docs/cpp/index.html`"
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
    def __init__(self, pages, has_code):
        self.pages, self.has_code = pages, has_code
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
                if self.has_code:
                    up = "../" * (len(page.parts) - 1)
                    line = line.replace(CODE_NAME, f"[{CODE_NAME}]({up}cpp/index.html)")
            out.append(line)
        return "\n".join(out)

    def gather(self):
        while self.waiting:
            path = self.waiting.pop()
            goal = self.pages / path
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


def foreign_resources(site):
    """What a page of the site would fetch from elsewhere."""
    found = []
    for page in site.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        for tag in re.findall(r"<(?:script|link|img|iframe|source)\b[^>]*>", text):
            for place in re.findall(r"(?:src|href)=\"?((?:https?:)?//[^\"\s>]+)", tag):
                if "rel=canonical" not in tag and 'rel="canonical"' not in tag:
                    found.append(f"{page.relative_to(site)}: {html.unescape(place)}")
    return sorted(set(found))


def make_code_reference(goal):
    """The reference of the C++ code, among the pages. True where it could be made without a warning."""
    shutil.rmtree(CODE, ignore_errors=True)
    outcome = subprocess.run(["doxygen", "docs/site/Doxyfile"], cwd=TREE, check=False)
    if outcome.returncode == 0:
        shutil.move(CODE, goal)
    return outcome.returncode == 0


def main():
    parser = argparse.ArgumentParser(description="Builds the site of the manual.")
    parser.add_argument("--into", type=pathlib.Path, help="where; without the reference of the C++ code then")
    into = parser.parse_args().into
    site = into.resolve() if into else TREE / "build/docs"
    pages = site.with_name(site.name + "_pages")
    for folder in (pages, site):
        shutil.rmtree(folder, ignore_errors=True)
    gatherer = Gatherer(pages, has_code=into is None)
    config = (TREE / "docs/site/mkdocs.yml").read_text(encoding="utf-8")
    for page in (*FIRST, *re.findall(r"[\w./-]+\.md\b", config.partition("\nnav:")[2])):
        gatherer.add(pathlib.Path(page))
    gatherer.gather()
    if into is None and not make_code_reference(pages / "cpp"):
        print("build_site: expected the comments of the headers to be read, found what stands above", file=sys.stderr)
        return 1
    (pages / "site").mkdir()
    for name in ("site.css", "equations.js"):
        shutil.copyfile(TREE / "docs/site" / name, pages / "site" / name)
    # Every browser takes the smallest form of the fonts.
    shutil.copytree(KATEX, pages / "site/katex", ignore=shutil.ignore_patterns("*.ttf", "*.woff"))
    config = config.replace("docs_dir: docs_pages", f"docs_dir: {pages.name}").replace("site_dir: docs", f"site_dir: {site.name}")
    config_file = site.with_name(site.name + ".yml")
    config_file.write_text(config, encoding="utf-8")
    outcome = subprocess.run(["mkdocs", "build", "--strict", "--quiet", "-f", str(config_file)], check=False)
    if outcome.returncode != 0:
        return outcome.returncode
    # A list of addresses with dates, for a site that has none.
    for name in ("sitemap.xml", "sitemap.xml.gz"):
        (site / name).unlink(missing_ok=True)
    foreign = foreign_resources(site)
    for place in foreign:
        print(f"build_site: expected nothing from elsewhere, found {place}", file=sys.stderr)
    num_pages = sum(1 for page in site.rglob("*.html") if page.relative_to(site).parts[0] != "cpp")
    shown = site.relative_to(TREE) if site.is_relative_to(TREE) else site
    print(f"{num_pages} pages; open {shown}/index.html")
    if into is None:
        print(f"The C++ of core and device: {shown}/cpp/index.html")
    print(f"For the search, serve them: python3 -m http.server --directory {shown}")
    return 1 if foreign else 0


if __name__ == "__main__":
    sys.exit(main())
