#!/usr/bin/env python3
"""batches.py ROOT SOURCE...: which sources may be compiled as one, a line of names for each such batch.

Most of a source's compile time goes into the headers that it shares with its neighbours. Sources of one batch must not take
each other's names: what is of one file alone (in an unnamed namespace, static, an alias, a macro) may be declared, called
or brought by a header in none of the others. Sources that compile themselves once for each instruction set, replace
operator new or hold a library of one header stay alone.
"""

import functools
import os
import re
import sys

MOST = 8  # sources of a batch, so that there are enough batches for all cores
MOST_LINES = 2500
UNNAMED_ENDS = "} of namespace"
COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)
INCLUDE = re.compile(r'^#include "([^"]+)"', re.M)
ENUM = re.compile(r"^enum (?!class)[^{;]*\{([^}]*)\}", re.M)
TYPE = re.compile(r"\b(?:struct|class|enum|union|using|concept|namespace)\s+(?:class\s+)?(\w+)")
FUNCTION = re.compile(r"(\w+|operator\S+)\s*\(")
VARIABLE = re.compile(r"\b([A-Za-z_]\w*)\s*(?=[=;,{\[]|$)")
CALL = re.compile(r"(?<![\w.:>])(\w+)\s*[({<]")


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def bare_text_of(path):
    """Without comments and what stands in quotes."""
    return COMMENT.sub("", re.sub(r"^\}  // namespace$", UNNAMED_ENDS, text_of(path), flags=re.M))


def declared(statement):
    """The names that a statement at the left edge declares, and whether they are of a function."""
    if re.match(r"(TEST|INSTANTIATE|static_assert)[A-Z_]*\(", statement):
        return set(), True
    types = TYPE.findall(statement)
    if types:
        return set(types), False
    head = re.split(r"[={]", statement, maxsplit=1)[0]
    function = FUNCTION.search(head)
    return ({function.group(1)}, True) if function else (set(VARIABLE.findall(statement)), False)


def statements(text):
    """What begins at the left edge, whole to its first line that ends in one of ; { }, and whether it is of the file alone."""
    unnamed, begun = False, None
    for line in text.split("\n"):
        if begun is None:
            if line.startswith("namespace {"):
                unnamed = True
            elif line.startswith(UNNAMED_ENDS):
                unnamed = False
            if not line or not (line[0].isalpha() or line[0] == "_") or line.startswith("namespace"):
                continue
            begun = ""
        begun += line + "\n"
        if re.search(r"[;{}]\s*$", line):
            yield begun, unnamed or begun.startswith(("static", "using"))
            begun = None


@functools.cache
def of_header(path):
    """The names of namespaces that a header brings, and the headers that it includes."""
    text = bare_text_of(path)
    names = set(re.findall(r"[A-Za-z_]\w*", " ".join(ENUM.findall(text))))
    for statement, _ in statements(text):
        names |= declared(statement)[0]
    return frozenset(names | set(re.findall(r"^#define (\w+)", text, re.M))), frozenset(INCLUDE.findall(text_of(path)))


def headers_of(text, root):
    found, ahead = set(), INCLUDE.findall(text)
    while ahead:
        name = ahead.pop()
        path = os.path.join(root, name)
        if name not in found and os.path.exists(path):
            found.add(name)
            ahead += of_header(path)[1]
    return found


class Source:
    def __init__(self, path, root):
        text = text_of(path)
        bare = bare_text_of(path)
        self.path, self.lines = path, text.count("\n")
        self.alone = any(sign in text for sign in ("foreach_target", "operator new", "_IMPLEMENTATION"))
        self.own, self.functions = set(re.findall(r"^#define (\w+)", text, re.M)), set()
        for statement, own in statements(bare):
            if own:
                names, are_functions = declared(statement)
                self.own |= names
                if are_functions:
                    self.functions |= names
        self.root, self.headers = root, headers_of(text, root)
        self.calls = set(CALL.findall(bare))
        self.brought = self.names_of(self.headers)

    def names_of(self, headers):
        return set().union(*(of_header(os.path.join(self.root, header))[0] for header in headers))

    def is_disturbed_by(self, other):
        """Functions of its own may share a name with those of headers, if it compiles with both."""
        brought = other.brought & (self.own - self.functions)
        return brought or self.own & (other.own | other.calls | other.names_of(other.headers - self.headers))


def clash(a, b):
    return a.is_disturbed_by(b) or b.is_disturbed_by(a)


def main():
    root = sys.argv[1]
    batches = []
    for source in (Source(path, root) for path in sys.argv[2:]):
        if source.alone:
            continue
        for batch in batches:
            if (
                len(batch) < MOST
                and sum(s.lines for s in batch) + source.lines <= MOST_LINES
                and not any(clash(source, other) for other in batch)
            ):
                batch.append(source)
                break
        else:
            batches.append([source])
    for batch in batches:
        if len(batch) > 1:
            print(" ".join(s.path for s in batch))


main()
