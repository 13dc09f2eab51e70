#!/usr/bin/env python3
"""Holds the documentation to the program: links, commands, names, and pages that are generated.

  check_docs.py PROGRAM                all checks; exit 1 where something is wrong
  check_docs.py PROGRAM --only links   one of: links, commands, names, generated
  check_docs.py PROGRAM --page docs/how-to/x.md ...   the commands of these pages alone
  check_docs.py PROGRAM --show ...     also prints what every command printed
  check_docs.py PROGRAM --renew        writes the generated pages anew

Rules for pages, which README.md beside this file explains:

- In Tutorials and How-to every block marked `sh` or `console` is run, in the order of the page, in a
  new folder. In `console` the commands stand behind `$ `, and what they print below is compared.
- A block that must not run says so, ```sh not-run, and is listed in not_run.txt with the reason.
- A block whose last command ends with another exit code than 0 says so, ```console exits=1.
- A block of another kind below a paragraph that says "save ... as `NAME`" is a file, which is written then.
"""

import argparse
import concurrent.futures
import contextlib
import csv
import json
import os
import pathlib
import re
import shlex
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import unicodedata

TREE = pathlib.Path(__file__).resolve().parents[2]
RUN_PAGES = ("docs/tutorials/*.md", "docs/how-to/*.md", "docs/from_my_csv_to_a_figure.md")
SKIPPED_FOLDERS = {"build", ".git", "node_modules"}
TIMEOUT_S = 300


def markdown_files():
    """Every Markdown file of the tree, by paths from its root."""
    found = []
    for folder, folders, files in os.walk(TREE):
        folders[:] = [name for name in folders if name not in SKIPPED_FOLDERS]
        found += [pathlib.Path(folder, name).relative_to(TREE) for name in files if name.endswith(".md")]
    return sorted(found)


# --- Markdown ---------------------------------------------------------------------------------

FENCE = re.compile(r"^(\s*)(`{3,}|~{3,})\s*(.*?)\s*$")


class Block:
    """A fenced block: where it begins, its info string in words, its lines, and the paragraph above it."""

    def __init__(self, line, info, before):
        self.line, self.info, self.before, self.lines = line, info.split(), before, []

    @property
    def kind(self):
        return self.info[0] if self.info else ""

    @property
    def text(self):
        return "".join(line + "\n" for line in self.lines)

    @property
    def file_name(self):
        match = re.search(r"\b[Ss]ave\b[^.]*?\bas\s+`([\w.-]+)`", self.before)
        return match.group(1) if match and self.kind not in ("sh", "console") else None

    @property
    def exit_code(self):
        codes = [word[len("exits="):] for word in self.info if word.startswith("exits=")]
        return int(codes[0]) if codes else 0


def split_blocks(text):
    """(text outside of fences, with empty lines in their place; the blocks)."""
    outside, blocks, open_fence, before, was_empty = [], [], None, "", True
    for number, line in enumerate(text.split("\n"), start=1):
        match = FENCE.match(line)
        if open_fence is None and match:
            open_fence = (len(match.group(1)), match.group(2))
            blocks.append(Block(number, match.group(3), before))
            before, was_empty = "", True
            outside.append("")
        elif open_fence is not None:
            indent, fence = open_fence
            if match and match.group(2).startswith(fence) and not match.group(3):
                open_fence = None
            else:
                blocks[-1].lines.append(line[indent:] if line[:indent].isspace() else line)
            outside.append("")
        else:
            outside.append(line)
            if line.strip():
                before = line.strip() if was_empty else before + " " + line.strip()
            was_empty = not line.strip()
    return "\n".join(outside), blocks


def slug(heading):
    """The anchor that GitHub gives a heading; the site is built with the same rule."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    text = re.sub(r"[`*]", "", text).strip().lower()
    text = "".join(c for c in text if c in " -_" or unicodedata.category(c)[0] in "LN")
    return text.replace(" ", "-")


def anchors(path, known={}):
    """All anchors of a page."""
    if path not in known:
        outside, _ = split_blocks((TREE / path).read_text(encoding="utf-8"))
        found = set(re.findall(r'<a (?:id|name)="([^"]+)"', outside))
        counts = {}
        for line in outside.split("\n"):
            match = re.match(r"^#{1,6}\s+(.*?)\s*#*$", line)
            if match:
                name = slug(match.group(1))
                found.add(name if counts.get(name, 0) == 0 else f"{name}-{counts[name]}")
                counts[name] = counts.get(name, 0) + 1
        known[path] = found
    return known[path]


LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(\s*<?([^()\s>]+(?:\([^()]*\))?)>?(?:\s+\"[^\"]*\")?\s*\)")
REFERENCE = re.compile(r"^\s{0,3}\[[^\]]+\]:\s+(\S+)", re.M)
HTML = re.compile(r"<(?:a|img)\b[^>]*?\b(?:href|src)=\"([^\"]+)\"")


def check_links():
    problems = []
    for path in markdown_files():
        outside, _ = split_blocks((TREE / path).read_text(encoding="utf-8"))
        for number, line in enumerate(outside.split("\n"), start=1):
            line = re.sub(r"(`+)(?:(?!\1).)+?\1", lambda m: "x" * len(m.group(0)), line)
            for target in LINK.findall(line) + REFERENCE.findall(line) + HTML.findall(line):
                if re.match(r"^[a-z][a-z0-9+.-]*:", target):
                    continue
                file, _, anchor = target.partition("#")
                goal = (path.parent / file) if file else path
                goal = pathlib.Path(os.path.normpath(goal))
                if not (TREE / goal).exists():
                    problems.append(f"{path}:{number}: expected a file or folder, found nothing at {target}")
                    continue
                if (TREE / goal).is_dir() and (TREE / goal / "README.md").exists():
                    goal = goal / "README.md"
                if anchor and goal.suffix == ".md" and anchor not in anchors(goal):
                    problems.append(f"{path}:{number}: expected a heading #{anchor} in {goal}, found none")
    return problems


# --- Commands ---------------------------------------------------------------------------------

def pages_to_run():
    return sorted(path.relative_to(TREE) for pattern in RUN_PAGES for path in TREE.glob(pattern))


def listed_not_run():
    """{page: (number of blocks, reason)} of not_run.txt."""
    listed = {}
    for line in (TREE / "tests/docs/not_run.txt").read_text(encoding="utf-8").split("\n"):
        if line.strip() and not line.startswith("#"):
            page, number, reason = line.split(None, 2)
            listed[page] = (int(number), reason)
    return listed


def commands_of(block):
    """[(command, the lines below it)]; in a block `sh` no output stands below."""
    commands = []
    if block.kind == "sh":
        joined = ""
        here = None
        for line in block.lines:
            if here is not None:
                joined += "\n" + line
                if line != here:
                    continue
                here = None
            else:
                match = re.search(r"<<'?(\w+)'?", line)
                here = match.group(1) if match else None
                joined = joined + "\n" + line if joined else line
                if here is not None or line.endswith("\\"):
                    continue
            if joined.strip() and not joined.lstrip().startswith("#"):
                commands.append([joined, None])
            joined = ""
        return commands
    for line in block.lines:
        if line.startswith("$ "):
            commands.append([line[2:], []])
        elif line.startswith("> ") and commands and not commands[-1][1]:
            commands[-1][0] += "\n" + line[2:]
        elif commands:
            commands[-1][1].append(line)
    return commands


def plain(line):
    """A line as it is compared: no two machines print the same numbers, dates and hashes."""
    line = re.sub(r"\b[0-9a-f]{12,}\b", "#", line)
    line = re.sub(r"(?<![A-Za-z_])[-+]?\d+(?:[.:]\d+)*(?:e[-+]?\d+)?", "#", line)
    return re.sub(r"\s+", " ", line).strip()


def line_matches(shown, printed):
    parts = [re.escape(part.strip()) for part in plain(shown).split("...")]
    return re.fullmatch(r"\s*.*?\s*".join(parts), plain(printed)) is not None


def first_difference(shown, printed):
    """None where what is shown is what was printed, `...` standing for any lines; else a sentence."""
    shown = [line for line in shown if line.strip()]
    printed = [line for line in printed if line.strip()]
    at, free = 0, False
    for line in shown:
        if line.strip() == "...":
            free = True
            continue
        while free and at < len(printed) and not line_matches(line, printed[at]):
            at += 1
        if at >= len(printed) or not line_matches(line, printed[at]):
            found = printed[at].rstrip() if at < len(printed) else "the end"
            return f"shows\n      {line.rstrip()}\n    where the program printed\n      {found}"
        at, free = at + 1, False
    if at < len(printed) and not free and shown:
        return f"ends where the program went on with\n      {printed[at].rstrip()}"
    return None


def make_place(folder, program):
    """A folder that looks like a clone that is built, and has a home of its own."""
    work, programs, home = folder / "work", folder / "bin", folder / "home"
    for made in (work, programs, home):
        made.mkdir()
    (programs / "jnd").symlink_to(program)
    for name in ("data", "device", "protocols"):
        (work / name).symlink_to(TREE / name)
    (work / "build").mkdir()
    (work / "build/jnd").symlink_to(program)
    environment = {**os.environ, "HOME": str(home), "PATH": f"{programs}:{os.environ['PATH']}",
                   "LANG": "C.UTF-8", "LC_ALL": "C.UTF-8", "PYTHONUNBUFFERED": "1"}
    for name in [name for name in environment if name.startswith(("XDG_", "JND_"))]:
        del environment[name]
    environment.pop("DISPLAY", None)
    environment["XDG_RUNTIME_DIR"] = str(home)
    return work, environment


def run_page(page, program, is_shown):
    """Problems of a page, how many commands it ran, and its blocks that do not run."""
    problems, num_commands, num_not_run, told, groups = [], 0, 0, [], []
    _, blocks = split_blocks((TREE / page).read_text(encoding="utf-8"))
    with tempfile.TemporaryDirectory(prefix="check_docs_") as temporary:
        work, environment = make_place(pathlib.Path(temporary), program)
        for block in blocks:
            if "not-run" in block.info:
                num_not_run += 1
                continue
            if block.file_name:
                (work / block.file_name).write_text(block.text, encoding="utf-8")
                continue
            if block.kind not in ("sh", "console"):
                continue
            commands = commands_of(block)
            for index, (command, shown) in enumerate(commands):
                expected = block.exit_code if index + 1 == len(commands) else 0
                place = f"{page}:{block.line}: `{command}`"
                with subprocess.Popen(["bash", "-c", command], cwd=work, env=environment, text=True,
                                      stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                      stderr=subprocess.STDOUT, start_new_session=True,
                                      errors="replace") as process:
                    try:
                        printed, _ = process.communicate(timeout=TIMEOUT_S)
                    except subprocess.TimeoutExpired:
                        os.killpg(process.pid, signal.SIGKILL)
                        printed, _ = process.communicate()
                        problems.append(f"{place}\n    expected an end within {TIMEOUT_S} s, found none")
                        continue
                # What goes on in the background, such as a served device, ends with the page.
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(process.pid, 0)
                    groups.append(process.pid)
                num_commands += 1
                if is_shown:
                    told.append(f"$ {command}\n{printed}")
                found = process.returncode if process.returncode >= 0 else 128 - process.returncode
                if found != expected:
                    problems.append(f"{place}\n    expected exit code {expected}, found {found}:\n"
                                    + "".join(f"      {line}\n" for line in printed.split("\n")[-12:]))
                elif shown:
                    difference = first_difference(shown, printed.split("\n"))
                    if difference:
                        problems.append(f"{place}\n    {difference}")
        for group in groups:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(group, signal.SIGKILL)
    return problems, num_commands, num_not_run, told


def check_commands(program, pages, is_shown):
    problems, listed = [], listed_not_run()
    every = pages_to_run()
    chosen = [pathlib.Path(page) for page in pages] if pages else every
    num_commands, again = 0, []
    with concurrent.futures.ThreadPoolExecutor(max_workers=max(2, os.cpu_count() or 2)) as pool:
        for page, outcome in zip(chosen, pool.map(lambda page: run_page(page, program, is_shown), chosen)):
            found, ran, not_run, told = outcome
            if found:
                again.append(page)
            num_commands += ran
            expected = listed.get(str(page), (0, ""))[0]
            if not_run != expected:
                problems.append(f"{page}: expected {expected} blocks marked not-run, as tests/docs/not_run.txt "
                                f"lists them, found {not_run}")
            for text in told:
                print(text)
    # What a busy machine does to a loop in real time is no mistake of a page: once more, one by one.
    for page in again:
        problems += run_page(page, program, False)[0]
    for page in listed:
        if pathlib.Path(page) not in every:
            problems.append(f"tests/docs/not_run.txt: expected pages of Tutorials and How-to, found {page}")
    print(f"{num_commands} commands of {len(chosen)} pages ran; not run:")
    for page, (number, reason) in listed.items():
        print(f"  {page}: {number}, {reason}")
    return problems


# --- Names ------------------------------------------------------------------------------------

def help_of(program, *words):
    return subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=True,
                          env={**os.environ, "LC_ALL": "C.UTF-8"}).stdout


def subcommands_in(text):
    """Names below "Subcommands:" of a help."""
    _, _, below = text.partition("Subcommands:\n")
    return re.findall(r"^  ([a-z][a-z0-9-]*)", below, re.M)


def every_help(program):
    """{words of a subcommand: its help}, in the order of the program; the first is that of the program."""
    helps = {(): help_of(program)}
    for name in subcommands_in(helps[()]):
        helps[(name,)] = help_of(program, name)
        for inner in subcommands_in(helps[(name,)]):
            helps[(name, inner)] = help_of(program, name, inner)
    return helps


def keys_of_schema(schema, found):
    if isinstance(schema, dict):
        for key, value in schema.items():
            if key == "properties" and isinstance(value, dict):
                found |= set(value)
            keys_of_schema(value, found)
    elif isinstance(schema, list):
        for value in schema:
            keys_of_schema(value, found)
    return found


def documented_pages():
    return [path for path in markdown_files()
            if path.parts[0] in ("docs", "protocols") or str(path) in ("README.md", "SAFETY.md", "CONTRIBUTING.md")]


COMMAND = re.compile(r"(?:^|[\s(|;&$=/\"'])jnd[ \t]+((?:[^\n`|;&#]|\\\n)*)")


def check_names(program):
    problems = []
    helps = every_help(program)
    first = {words[0] for words in helps if words}
    options = {words: set(re.findall(r"(?<![\w-])(--?[a-z][a-z0-9-]*)", text)) for words, text in helps.items()}
    study_keys = keys_of_schema(json.loads((TREE / "protocols/study.schema.json").read_text()), set())
    keys = study_keys | keys_of_schema(
        json.loads((TREE / "protocols/device_profile.schema.json").read_text()), set())
    named = set()
    for path in documented_pages():
        text = (TREE / path).read_text(encoding="utf-8")
        outside, blocks = split_blocks(text)
        spans = re.findall(r"`([^`]+)`", outside)
        fenced = [block.text for block in blocks
                  if block.kind in ("", "sh", "console", "python", "r", "bash") and block.file_name is None
                  or block.kind in ("python", "r", "bash")]
        for piece in spans + fenced:
            for rest in COMMAND.findall(piece.replace("\\\n", " ")):
                try:
                    words = shlex.split(rest, comments=False)
                except ValueError:
                    words = rest.split()
                if not words or not re.fullmatch(r"[a-z][a-z0-9-]+", words[0]):
                    continue
                if words[0] not in first:
                    # Output and prose say "jnd" as well; a command is what stands in a span, or first in its line.
                    if piece in spans and piece.startswith("jnd "):
                        problems.append(f"{path}: expected a subcommand, found `jnd {words[0]}`")
                    elif piece not in spans and re.search(rf"^(?:\$ )?(?:build/)?jnd {words[0]}\b", piece, re.M):
                        problems.append(f"{path}: expected a subcommand, found `jnd {words[0]}`")
                    continue
                command = (words[0],)
                if len(words) > 1 and (words[0], words[1]) in helps:
                    command = (words[0], words[1])
                if path.parts[:2] != ("docs", "reference"):
                    named |= {command, command[:1]}
                for word in words[1:]:
                    option = word.split("=")[0]
                    if re.fullmatch(r"--[a-z][a-z0-9-]*", option) and option not in options[command]:
                        problems.append(f"{path}: expected an option of `jnd {' '.join(command)}`, found {option}")
        for key in re.findall(r"\bkeys? `([a-z][a-z0-9_]*)`", re.sub(r"\s+", " ", outside)):
            if path.parts[:2] in (("docs", "how-to"), ("docs", "tutorials")) and key not in keys:
                problems.append(f"{path}: expected a key of study files or device profiles, found `{key}`")
        for block in blocks:
            if block.kind != "json" or path.parts[0] != "docs" or block.file_name == "laboratory.json":
                continue
            # Factors, levels and arms have names of the author's own.
            of_the_author = r'"(?:of|levels|only_for)":\s*\{(?:[^{}]|\{[^{}]*\})*\}'
            for key in re.findall(r'"([^"]+)"\s*:', re.sub(of_the_author, "", block.text)):
                if key not in keys and not re.fullmatch(r"[a-z]{2}", key):
                    problems.append(f"{path}:{block.line}: expected a key of study files or device profiles, "
                                    f"found `{key}`")
    for words in helps:
        if words and words not in named:
            problems.append(f"docs: expected `jnd {' '.join(words)}` to be named on some page, found it on none")
    print(f"{len(helps) - 1} subcommands, {len(keys)} keys; all named subcommands, options and keys looked up")
    return problems


# --- Generated pages --------------------------------------------------------------------------

def commands_page(program):
    """docs/reference/commands.md: every help, as the program prints it."""
    lines = ["# Commands", "",
             "This page is made by `tests/docs/check_docs.py build/jnd --renew` from the help of every subcommand. Do not edit it.",
             "",
             "`jnd` alone opens the window. Every command takes `--help`. The commands that print results take `--json`.", "",
             "| exit code | meaning |", "| --- | --- |", "| 0 | The command did what you asked. |",
             "| 1 | What you asked about has problems. |", "| 2 | The command was used wrongly. |",
             "| 3 | Something is missing around the program: a device, a right, or somebody who reads the output. |",
             "| 4 | The program made a mistake. |", ""]
    for words, text in every_help(program).items():
        text = re.sub(r"(--jobs INT:1 to \d+)=\d+", r"\1=PROCESSORS", text)
        depth = "###" if len(words) == 2 else "##"
        lines += [f"{depth} {' '.join(('jnd',) + words)}", "", "```text", text.rstrip("\n"), "```", ""]
    return "\n".join(lines).rstrip("\n") + "\n"


def run(program, work, environment, *words):
    outcome = subprocess.run([program, *words], cwd=work, env=environment, capture_output=True, text=True)
    if outcome.returncode not in (0, 1):
        raise RuntimeError(f"jnd {' '.join(words)}: {outcome.stderr}")
    return outcome.stdout


def tables_page(program):
    """docs/reference/tables.md: the columns of exported tables, from the codebook of an export, and of the database."""
    with tempfile.TemporaryDirectory(prefix="check_docs_") as temporary:
        work, environment = make_place(pathlib.Path(temporary), program)
        run(program, work, environment, "simulate", "viscosity_rating_with_confidence", "--participants", "1",
            "--study", "s.study", "--fast", "--laboratory", "thesis_questions")
        run(program, work, environment, "export", "csv", "s.study", "--out", "tables")
        with open(work / "tables/codebook.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        database = sqlite3.connect(work / "s.study/study.sqlite")
        layout = database.execute("SELECT MAX(version) FROM study_format").fetchone()[0]
        columns = {name: database.execute(f"PRAGMA table_info({name})").fetchall()
                   for (name,) in database.execute("SELECT name FROM sqlite_master WHERE type = 'table' AND "
                                                   "name NOT LIKE 'sqlite_%' ORDER BY name")}
        database.close()
    since = {}
    steps = sorted((TREE / "data/database").glob("*.sql"), key=lambda step: int(step.name.split("_")[0]))
    for step in steps:
        for name in re.findall(r"CREATE TABLE (\w+)", step.read_text(encoding="utf-8")):
            since.setdefault(name, step.name)
    lines = ["# Tables and database", "",
             "This page is made by `tests/docs/check_docs.py build/jnd --renew` from the codebook of an export and from the database of "
             "a study. Do not", "edit it.", "",
             "[What stays stable](what_stays_stable.md) says how these tables may change.", "",
             "## Exported tables", "",
             "`jnd export csv` writes these files. BIDS and HDF5 have the same columns. An empty cell means that the value does not apply or "
             "was not", "measured.", ""]
    files = dict.fromkeys(row["file"] for row in rows if row["file"] != "*.csv")
    for file in files:
        lines += [f"### {file}", "", "| column | unit | meaning |", "| --- | --- | --- |"]
        lines += [f"| `{row['column']}` | {row['unit']} | {row['meaning'].replace('|', chr(92) + '|')} |"
                  for row in rows if row["file"] == file]
        lines.append("")
    lines += ["## The database", "",
              f"`study.sqlite` of a study is of layout {layout}. Each layout is a file of [data/database](../../data/database), whose comments "
              "say what the", "columns mean. Any program that reads SQLite may read it; nothing but jnd may write to it.", "",
              "| table | since | columns |", "| --- | --- | --- |"]
    for name, its in columns.items():
        step = since.get(name, steps[0].name)
        lines.append(f"| `{name}` | [layout {step.split('_')[0]}](../../data/database/{step}) | "
                     + ", ".join(f"`{column[1]}`" for column in its) + " |")
    return "\n".join(lines) + "\n"


def json_keys(values, depth, lines):
    """A line for each key that any of these objects has, with the kinds of its values."""
    keys = dict.fromkeys(key for value in values for key in value)
    for key in keys:
        held = [value[key] for value in values if key in value]
        inner = [item for value in held for item in (value if isinstance(value, list) else [value])]
        kinds = []
        for value in held:
            kind = {dict: "object", str: "words", bool: "true or false", type(None): "null"}.get(type(value), "number")
            if isinstance(value, list):
                items = {dict: "objects", str: "words", list: "lists"}.get(type(value[0]) if value else None, "numbers")
                kind = f"list of {items}" if value else "list"
            kinds.append(kind)
        found = sorted(set(kinds), key=lambda kind: (kind == "null", kind))
        if "list" in found and any(kind.startswith("list of") for kind in found):
            found.remove("list")
        lines.append("    " * depth + f"- `{key}`: " + " or ".join(found))
        objects = [item for item in inner if isinstance(item, dict)]
        if objects and any(not re.fullmatch(r"[a-z_][a-z0-9_]*", name) for item in objects for name in item):
            continue
        json_keys(objects, depth + 1, lines)


JSON_COMMANDS = (
    ("validate", "viscosity_priming"), ("plan", "viscosity_priming", "--participants", "2"),
    ("power", "viscosity_priming", "--participants", "6", "--runs", "4"),
    ("simulate", "viscosity_priming", "--participants", "2", "--study", "t.study", "--fast"),
    ("verify", "s.study"), ("results", "s.study"), ("fit", "psychometric", "--csv", "answers.csv"),
    ("fit", "weber", "--csv", "answers.csv", "--reference", "10"), ("fit", "power", "--csv", "magnitudes.csv"),
    ("fit", "power", "--csv", "people.csv", "--participant", "participant"),
    ("compare", "--csv", "pairs.csv", "--test", "paired"), ("force", "water"))


def json_page(program):
    """docs/reference/json.md: the keys that commands print with --json, from what they print of an example."""
    lines = ["# JSON of the commands", "",
             "This page is made by `tests/docs/check_docs.py build/jnd --renew` from what the commands print. Do not edit it.", "",
             "Commands that print results take `--json`, and then print one document on stdout. If a command fails, the document is "
             "`{\"error\": \"...\"}`,", "and the exit code says what kind of failure it is. Numbers are in SI units, and the ends of their "
             "names say which.", "",
             "- A value that is missing is `null`, and `reason` beside it says why.",
             "- `ci95` is a list of two numbers, the ends of the 95 % interval. An end that is not bounded by the data is `null`.",
             "- `cautions` and `warnings` are sentences. Read them before you use the number.",
             "- `primary` marks the values that answer what the block asked.", "",
             "The lists below show the keys of an example of each command. `or null` means that the example has a value in some places and "
             "`null` in others.", "[What stays stable](what_stays_stable.md) says how these keys may change.", ""]
    with tempfile.TemporaryDirectory(prefix="check_docs_") as temporary:
        work, environment = make_place(pathlib.Path(temporary), program)
        (work / "answers.csv").write_text("intensity,num_yes,num_trials\n5,1,40\n6.5,4,40\n8.5,13,40\n11.5,28,40\n15,36,40\n")
        (work / "magnitudes.csv").write_text("intensity,magnitude\n1,12\n2,30\n4,52\n8,90\n16,150\n")
        (work / "people.csv").write_text("participant,intensity,magnitude\n" + "".join(
            f"{name},{2 ** i},{magnitude}\n" for name, magnitudes in
            (("Ada", (10, 14, 23, 30)), ("Ben", (8, 15, 26, 52)), ("Eva", (30, 41, 55, 83)), ("Ida", (12, 24, 45, 80)))
            for i, magnitude in enumerate(magnitudes)))
        (work / "pairs.csv").write_text("a,b\n1.2,1.0\n1.4,1.1\n0.9,1.0\n1.6,1.2\n")
        run(program, work, environment, "simulate", "viscosity_priming", "--participants", "4", "--study", "s.study", "--fast")
        for words in JSON_COMMANDS:
            document = json.loads(run(program, work, environment, *words, "--json"))
            lines += [f"## jnd {words[0]}" + (f" {words[1]}" if words[0] == "fit" else "") +
                      (" of a group of people" if "--participant" in words else ""), "", f"`jnd {' '.join(words)} --json`", ""]
            json_keys([document], 0, lines)
            lines.append("")
    return "\n".join(lines).rstrip("\n") + "\n"


GENERATED = {"docs/reference/commands.md": commands_page, "docs/reference/tables.md": tables_page,
             "docs/reference/json.md": json_page}


def check_generated(program):
    problems = []
    for path, write in GENERATED.items():
        file = TREE / path
        if not file.exists() or file.read_text(encoding="utf-8") != write(program):
            problems.append(f"{path}: expected what the program says today; renew it: "
                            "tests/docs/check_docs.py build/jnd --renew")
    return problems


# --- Navigation -------------------------------------------------------------------------------

def check_navigation():
    """Every page of docs/ stands in the site's navigation."""
    navigation = (TREE / "docs/site/mkdocs.yml").read_text(encoding="utf-8")
    named = set(re.findall(r"[\w./-]+\.md\b", navigation))
    problems = [f"docs/site/mkdocs.yml: expected {path} in the navigation, found it nowhere"
                for path in markdown_files() if path.parts[0] == "docs" and str(path) not in named]
    problems += [f"docs/site/mkdocs.yml: expected a page, found nothing at {path}"
                 for path in sorted(named) if not (TREE / path).exists()]
    return problems


def check_doxyfile():
    """What the reference of the C++ code is made of is there."""
    text = (TREE / "docs/site/Doxyfile").read_text(encoding="utf-8")
    places = re.search(r"^INPUT\s*=\s*(.+)$", text, re.M)
    if places is None:
        return ["docs/site/Doxyfile: expected a line INPUT, found none"]
    return [f"docs/site/Doxyfile: expected a folder or file, found nothing at {place}"
            for place in places.group(1).split() if not (TREE / place).exists()]


def main():
    parser = argparse.ArgumentParser(description="Holds the documentation to the program.")
    parser.add_argument("program", help="jnd, as it was built")
    parser.add_argument("--only", choices=["links", "commands", "names", "generated"])
    parser.add_argument("--page", nargs="+", default=[])
    parser.add_argument("--show", action="store_true")
    parser.add_argument("--renew", action="store_true")
    arguments = parser.parse_args()
    program = str(pathlib.Path(shutil.which(arguments.program) or arguments.program).resolve())
    if arguments.renew:
        for path, write in GENERATED.items():
            (TREE / path).parent.mkdir(parents=True, exist_ok=True)
            (TREE / path).write_text(write(program), encoding="utf-8")
        return 0
    only = "commands" if arguments.page else arguments.only
    problems = []
    if only in (None, "links"):
        problems += check_links() + check_navigation() + check_doxyfile()
    if only in (None, "names"):
        problems += check_names(program)
    if only in (None, "generated"):
        problems += check_generated(program)
    if only in (None, "commands"):
        problems += check_commands(program, arguments.page, arguments.show)
    for problem in problems:
        print(problem)
    print(f"{len(problems)} problems" if problems else "no problem")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
