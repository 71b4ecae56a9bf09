#!/usr/bin/env python3
"""Cycles of includes among the folders of a directory.

    includeCycles.py <directory>

A folder includes another one if one of its files, at any depth, includes a header of the
other. Prints one line for each group of folders that include each other, directly or by
way of others, then a line "<number> folders, <number> includes among them". Exit status:
1 if there is such a group, 0 otherwise.
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^#include "(?:[^"]*/)?([^"/]+)"', re.M)


def sources(folder):
    return [f for f in sorted(folder.rglob("*.[CH]")) if "lnInclude" not in f.parts]


def includes(directory):
    """Folder -> {included folder: an example "file includes header"}."""
    folders = [f for f in sorted(directory.iterdir()) if f.is_dir() and sources(f)]
    owner = {file.name: folder.name for folder in folders for file in sources(folder)}
    found = {folder.name: {} for folder in folders}
    for folder in folders:
        for file in sources(folder):
            for header in INCLUDE.findall(file.read_text()):
                other = owner.get(header, folder.name)
                if other != folder.name:
                    found[folder.name].setdefault(other, f"{file.name} includes {header}")
    return found


def reachable(found, start):
    seen, todo = set(), list(found[start])
    while todo:
        folder = todo.pop()
        if folder not in seen:
            seen.add(folder)
            todo += found[folder]
    return seen


def main():
    if len(sys.argv) != 2 or not pathlib.Path(sys.argv[1]).is_dir():
        sys.exit("usage: includeCycles.py <directory>")
    found = includes(pathlib.Path(sys.argv[1]))
    if not found:
        sys.exit("includeCycles.py: no sources in " + sys.argv[1])
    below = {folder: reachable(found, folder) for folder in found}
    groups = {frozenset(g for g in below[f] if f in below[g]) for f in found if f in below[f]}
    for group in sorted(groups, key=sorted):
        examples = [example for f in sorted(group) for g, example in sorted(found[f].items())
                    if g in group]
        print(" <-> ".join(sorted(group)) + ": " + ", ".join(examples))
    print(f"{len(found)} folders, {sum(map(len, found.values()))} includes among them")
    sys.exit(bool(groups))


if __name__ == "__main__":
    main()
