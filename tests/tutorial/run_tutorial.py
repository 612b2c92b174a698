#!/usr/bin/env python3
"""Runs pages as a reader does: their ```sh blocks in order, each page in an empty folder.

    run_tutorial.py WORK --programs PROGRAM... --pages PAGE... [--python PYTHON]

The programs are on the path there, and PYTHON as python3. Every block must succeed, and print what the ```text block after it
quotes. In a quotation "…" stands for anything: in a line for a part of it, alone in a line for any number of lines. Numbers may
differ by 2 %, or by one in the last of several digits quoted. A comment before a block of commands changes that:

    <!-- test: within 10 % -->            numbers of its quotation may differ by so much
    <!-- test: run --set time.end=1 -->   every `meniscus run` of the block gets these options; its quotation is held to its
                                          words, not to its numbers

Pictures of a page must be in their place, and smaller than 100 kB.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

NUMBER = r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$|^<!-- test: (.*?) -->$", re.MULTILINE | re.DOTALL)
PICTURE = re.compile(r"!\[[^\]]*\]\(([^)\s]+)\)")
LARGEST_PICTURE = 100_000  # bytes
USUAL_TOLERANCE = 0.02


class Fault(Exception):
    pass


@dataclass
class Block:
    commands: str
    line: int
    quoted: str = ""
    tolerance: float = USUAL_TOLERANCE
    options: str = ""


def blocks(text):
    """The blocks of commands of a page, each with its quotation and what the comment before it says."""
    found, comments = [], []
    for match in FENCE.finditer(text):
        kind, body, comment = match.groups()
        if comment is not None:
            comments.append(comment)
        elif kind == "sh":
            found.append(Block(body, text.count("\n", 0, match.start()) + 2))
            for said in comments:
                apply(found[-1], said)
            comments = []
        elif kind == "text" and found:
            found[-1].quoted += body
    return found


def apply(block, comment):
    if within := re.fullmatch(r"within (\d+(?:\.\d+)?) %", comment):
        block.tolerance = float(within[1]) / 100
    elif comment.startswith("run "):
        block.options = comment.removeprefix("run ")
    else:
        raise Fault(f"line {block.line}: no such instruction: {comment}")


def as_run(block):
    """The commands with the options that the test gives them."""
    if not block.options:
        return block.commands
    return re.sub(r"^(\s*meniscus run \S+)", rf"\1 {block.options}", block.commands, flags=re.MULTILINE)


def pattern(line):
    """A quoted line as a regular expression whose groups are its numbers."""
    parts = re.split(rf"(…|\s+|{NUMBER})", line.strip())
    made = [r".*?" if p == "…" else r"\s+" if p.isspace() else f"({NUMBER})" if re.fullmatch(NUMBER, p) else re.escape(p)
            for p in parts if p]
    return "".join(made)


def one_in_last_digit(number):
    """One in the last of several digits; 0 for a lone digit, which counts or names something."""
    mantissa, _, exponent = number.lower().partition("e")
    if len(re.findall(r"\d", mantissa)) < 2:
        return 0.0
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def agree(quoted, printed, tolerance):
    a, b = float(quoted), float(printed)
    return abs(a - b) <= max(tolerance * abs(a), 1.000001 * one_in_last_digit(quoted))


def line_agrees(quoted, printed, tolerance):
    found = re.fullmatch(pattern(quoted), printed.strip())
    if not found:
        return False
    numbers = [n for n in re.split(rf"(…|\s+|{NUMBER})", quoted.strip()) if n and re.fullmatch(NUMBER, n)]
    return tolerance is None or all(agree(a, b, tolerance) for a, b in zip(numbers, found.groups()))


def first_disagreement(quoted, printed, tolerance):
    """The first quoted line that was not printed; None where all agree. Numbers are free where tolerance is None."""
    lines, may_skip = printed.rstrip().splitlines(), False
    for line in quoted.rstrip().splitlines():
        if line.strip() == "…":
            may_skip = True
            continue
        while may_skip and lines and not line_agrees(line, lines[0], tolerance):
            lines.pop(0)
        if not lines or not line_agrees(line, lines[0], tolerance):
            return line
        lines.pop(0)
        may_skip = False
    return None if may_skip or not lines else f"(end of the quotation; more was printed: {lines[0]})"


def run_block(block, folder, environment):
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", as_run(block)], cwd=folder, env=environment,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        raise Fault(f"line {block.line}: status {done.returncode}\n{block.commands}{done.stdout}")
    missed = block.quoted and first_disagreement(block.quoted, done.stdout, None if block.options else block.tolerance)
    if missed:
        raise Fault(f"line {block.line}: quoted but not printed: {missed}\nprinted:\n{done.stdout}")


def check_pictures(page, text):
    for picture in [page.parent / name for name in PICTURE.findall(text)]:
        if not picture.is_file():
            raise Fault(f"no picture {picture}")
        if picture.stat().st_size > LARGEST_PICTURE:
            raise Fault(f"{picture} has {picture.stat().st_size} bytes")


def run_page(page, folder, environment):
    text = page.read_text(encoding="utf-8")
    check_pictures(page, text)
    found = blocks(text)
    if not found:
        raise Fault("no commands")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for block in found:
        run_block(block, folder, environment)


def parse_arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("work", type=Path)
    parser.add_argument("--programs", nargs="+", type=Path, required=True)
    parser.add_argument("--pages", nargs="+", type=Path, required=True)
    parser.add_argument("--python", type=Path)
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    work = arguments.work.resolve()
    tools = work / "bin"
    shutil.rmtree(tools, ignore_errors=True)
    tools.mkdir(parents=True)
    named = {program.name: program for program in arguments.programs}
    if arguments.python:
        named["python3"] = arguments.python
    for name, program in named.items():
        (tools / name).symlink_to(program.resolve(strict=True))
    environment = dict(os.environ, PATH=f"{tools}{os.pathsep}{os.environ['PATH']}", LC_ALL="C.UTF-8")
    for page in arguments.pages:
        start = time.monotonic()
        try:
            run_page(page, work / page.stem, environment)
        except Fault as fault:
            sys.exit(f"{page}: {fault}")
        print(f"{page.name}: {time.monotonic() - start:.1f} s", flush=True)


if __name__ == "__main__":
    main()
