#!/usr/bin/env python3
"""Comments of C++ files that do not name their subject.

    comments.py <folder or file>...

Prints each comment that begins with one of the refused words or asks a question
(file:line: comment), then a line "<number> comments, <words> words each, <share> % begin
with a pronoun" for the // comments of all files. Exit status: 1 if a comment is refused,
0 otherwise.
"""
import argparse
import pathlib
import re
import sys

REFUSED = "of that those these the_same it they as what and but".split()
PRONOUNS = "it its they them their that those these what which who whose".split()
COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"|//[^\n]*|/\*.*?\*/', re.S)
SECTION = re.compile(r"(?:Class|Description|Usage|SourceFiles|Note)\n")


def comments(text):
    """Pairs (line, text) of the comments; successive lines of // are one comment."""
    found, last = [], -1
    for match in COMMENT.finditer(text):
        comment = match.group()
        if comment[0] == '"':
            continue
        line = text.count("\n", 0, match.start()) + 1
        begin = text.rfind("\n", 0, match.start()) + 1
        alone = not text[begin:match.start()].strip()
        if comment.startswith("/*"):
            found += [(line, "/* " + part) for part in sections(comment[2:-2])]
            continue
        words = re.sub(r"^//(-|!<)?", "", comment).strip()
        if alone and line == last + 1 and not comment.startswith("//-"):
            found[-1] = (found[-1][0], found[-1][1] + " " + words)
        else:
            found.append((line, words))
        last = line if alone else -1
    return [(line, " ".join(words.split())) for line, words in found if words.strip(" /*")]


def sections(block):
    """Description of a header, or the block itself if it has no sections."""
    parts = SECTION.split(block)
    if len(parts) == 1:
        return parts
    names = SECTION.findall(block)
    return [part for name, part in zip(names, parts[1:]) if name == "Description\n"]


def first_word(comment):
    words = re.findall(r"[A-Za-z]+", comment.lower())[:2]
    return "the_same" if words == ["the", "same"] else (words + [""])[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("paths", nargs="+")
    options = parser.parse_args()

    number = words = pronouns = refused = 0
    for path in options.paths:
        path = pathlib.Path(path)
        files = [path] if path.is_file() else sorted(path.rglob("*.[CH]"))
        for file in files:
            if "lnInclude" in file.parts:
                continue
            for line, comment in comments(file.read_text()):
                if comment.startswith("This file is part of"):
                    continue
                if not comment.startswith("/*"):
                    number += 1
                    words += len(comment.split())
                    pronouns += first_word(comment) in PRONOUNS
                if first_word(comment) in REFUSED or "?" in comment:
                    refused += 1
                    print(f"{file}:{line}: {comment[:70]}")
    if number == 0:
        sys.exit("comments.py: there are no comments in " + " ".join(options.paths))
    print(f"{number} comments, {words / number:.1f} words each, "
          f"{100 * pronouns / number:.1f} % begin with a pronoun")
    sys.exit(refused > 0)


if __name__ == "__main__":
    main()
