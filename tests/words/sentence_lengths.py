#!/usr/bin/env python3
"""Prints the number of words and the lengths of the sentences of every page.

    sentence_lengths.py ROOT

A report, not a gate. Words are counted as by `wc -w`. Sentences are those of running text: code,
tables, headings, pictures and bold words that open a paragraph are left out.
"""
import re
import sys
from pathlib import Path

FOLDERS = (".", "docs", "cases")
FENCE = re.compile(r"^\s*(```|~~~)")
LIST_ITEM = re.compile(r"^\s*([-*+]|\d+\.)\s+")
SKIPPED = re.compile(r"^\s*(\||#|!\[|>|<|-{3,}$)")
RUN_IN_HEAD = re.compile(r"^\*\*[^*]+[.:]?\*\*[.:]?\s")
LINK = re.compile(r"\[([^\]]*)\]\([^)]*\)")
ABBREVIATION = re.compile(r"(^|[\s(])(e\.g|i\.e|cf|eq|eqs|fig|figs|sec|no|vs|al|[A-Z])\.$")
END = re.compile(r"[.?!][)\"'*_`]*(?=\s)|[.?!][)\"'*_`]*$")
LONGEST = 25


def pages(root):
    """The Markdown pages below ROOT, in a fixed order."""
    for folder in FOLDERS:
        search = (root / folder).glob if folder == "." else (root / folder).rglob
        yield from sorted(search("*.md"))


def blocks(text):
    """Paragraphs and list items of running text, each as one line."""
    block, is_fenced, is_code, after_blank = [], False, False, True
    for line in text.splitlines():
        if FENCE.match(line):
            is_fenced = not is_fenced
        is_code = line.startswith("    ") and (after_blank or is_code) and not LIST_ITEM.match(line)
        is_text = line.strip() and not (is_fenced or is_code or FENCE.match(line) or SKIPPED.match(line))
        if block and (not is_text or LIST_ITEM.match(line)):
            yield " ".join(block)
            block = []
        if is_text:
            block.append(LIST_ITEM.sub("", line).strip())
        after_blank = not line.strip()
    if block:
        yield " ".join(block)


def sentences(block):
    """The sentences of one paragraph."""
    block = RUN_IN_HEAD.sub("", LINK.sub(r"\1", block))
    start = 0
    for end in END.finditer(block):
        if ABBREVIATION.search(block[start:end.start() + 1]):
            continue
        yield block[start:end.end()].strip()
        start = end.end()
    if block[start:].strip():
        yield block[start:].strip()


def num_words(sentence):
    """Words that hold a letter or a digit: signs between them do not count."""
    return sum(any(c.isalnum() for c in word) for word in sentence.split())


def sentence_lengths(text):
    """The numbers of words of all sentences of a page, in rising order."""
    lengths = (num_words(s) for block in blocks(text) for s in sentences(block))
    return sorted(n for n in lengths if n > 0)


def quantile(values, share):
    """The least of sorted values that SHARE of them do not exceed; 0 without values."""
    return values[max(0, -int(-len(values) * share // 1) - 1)] if values else 0


def row(name, words, lengths):
    long_ones = sum(n > LONGEST for n in lengths)
    return (f"{name:44}{words:8}{len(lengths):11}{quantile(lengths, 0.5):8}{quantile(lengths, 0.9):6}"
            f"{lengths[-1] if lengths else 0:9}{long_ones:10}")


def report(root):
    """Lines of the table: one for each page, and their sum."""
    yield (f"{'page':44}{'words':>8}{'sentences':>11}{'median':>8}{'90 %':>6}{'longest':>9}"
           f"{f'over {LONGEST}':>10}")
    all_words, all_lengths = 0, []
    for page in pages(root):
        text = page.read_text(encoding="utf-8")
        lengths = sentence_lengths(text)
        yield row(page.relative_to(root).as_posix(), len(text.split()), lengths)
        all_words += len(text.split())
        all_lengths += lengths
    yield row("all", all_words, sorted(all_lengths))


if __name__ == "__main__":
    print("\n".join(report(Path(sys.argv[1]))))
