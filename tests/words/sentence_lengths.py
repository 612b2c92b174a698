#!/usr/bin/env python3
"""Prints the number of words and the lengths of the sentences of every page, and of comments.

    sentence_lengths.py ROOT [--long]    # --long: also each sentence above 25 words, by file

A report, not a gate. Words are counted as by `wc -w`. Sentences are those of running text: code,
tables, headings, pictures and bold words that open a paragraph are left out. Comments are those of
the C++ sources below meniscus/, by room.
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
COMMENT = re.compile(r"^\s*//(?!/<)/? ?(.*)")  # a line of its own
TRAILING = re.compile(r"\S\s*//(?:/<)? (.*)|^\s*///< (.*)")
LONGEST = 25


def pages(root):
    """The Markdown pages below ROOT, in a fixed order."""
    for folder in FOLDERS:
        search = (root / folder).glob if folder == "." else (root / folder).rglob
        yield from sorted(search("*.md"))


def rooms(root):
    """The folders of C++ sources below ROOT/meniscus, with their files, in a fixed order."""
    files = sorted(f for ending in ("*.hpp", "*.cpp") for f in (root / "meniscus").rglob(ending))
    for folder in sorted({f.parent for f in files}):
        yield folder, [f for f in files if f.parent == folder]


def comments(source):
    """The comments of a C++ source as running text. Indented lines are formulas, but below a list item."""
    lines, is_trailing, is_item = [], False, False
    for line in source.splitlines():
        own, trailing = COMMENT.match(line), TRAILING.search(line)
        if own:
            is_indented = own[1].startswith("  ")
            is_item = bool(LIST_ITEM.match(own[1])) or (is_item and is_indented)
            lines += ["", own[1]] if is_trailing else [""] if is_indented and not is_item else [own[1]]
        elif trailing and not line.lstrip().startswith("///<"):
            lines += ["", trailing[1]]
        else:
            lines.append(trailing[2] if trailing else "")
        is_trailing = bool(trailing) and not own
    return "\n".join(lines)


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


def table(title, texts):
    """Lines of a table: one for each (name, text), and their sum."""
    yield (f"{title:44}{'words':>8}{'sentences':>11}{'median':>8}{'90 %':>6}{'longest':>9}"
           f"{f'over {LONGEST}':>10}")
    all_words, all_lengths = 0, []
    for name, text in texts:
        lengths = sentence_lengths(text)
        yield row(name, len(text.split()), lengths)
        all_words += len(text.split())
        all_lengths += lengths
    yield row("all", all_words, sorted(all_lengths))


def read(file):
    return file.read_text(encoding="utf-8")


def report(root):
    """The table of pages, and that of comments by room."""
    yield from table("page", ((p.relative_to(root).as_posix(), read(p)) for p in pages(root)))
    yield ""
    yield from table("comments", ((folder.relative_to(root).as_posix(), "\n\n".join(comments(read(f)) for f in files))
                                  for folder, files in rooms(root)))


def long_sentences(root):
    """A line for each sentence above the longest: its file, number of words, and itself."""
    texts = [(page, read(page)) for page in pages(root)]
    texts += [(file, comments(read(file))) for _, files in rooms(root) for file in files]
    for file, text in texts:
        for sentence in (s for block in blocks(text) for s in sentences(block)):
            if num_words(sentence) > LONGEST:
                yield f"{file.relative_to(root)}: {num_words(sentence)}: {sentence}"


if __name__ == "__main__":
    print("\n".join(report(Path(sys.argv[1]))))
    if "--long" in sys.argv[2:]:
        print("\n" + "\n".join(long_sentences(Path(sys.argv[1]))))
