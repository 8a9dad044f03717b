#!/bin/bash
# links.sh ROOT: every relative link of every page leads somewhere, to a heading too, every path of ours that a page names
# exists, and every page of docs/ can be reached from README.md.
set -euo pipefail
cd "$1"
python3 - << 'END'
import glob, os, re, subprocess, sys

pages = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "--", "*.md"],
                       capture_output=True, text=True, check=True).stdout.split("\n")[:-1]
pages = [page for page in pages if os.path.exists(page)]

def words_of(page):
    text = open(page, encoding="utf-8").read()
    text = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)
    return re.sub(r"`[^`\n]*`", "", text)

def anchors_of(page):
    titles = re.findall(r"^#+ +(.*)$", open(page, encoding="utf-8").read(), flags=re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}

wrong, links = [], {}
for page in pages:
    links[page] = set()
    for target in re.findall(r"\]\(([^)\s]+)\)", words_of(page)):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        place = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
        if not os.path.exists(place):
            wrong.append(f"{page} links to {target}, which is not there")
        elif anchor and anchor not in anchors_of(place):
            wrong.append(f"{page} links to {target}, and {place} has no such heading")
        links[page].add(place)
    for code in re.findall(r"`([^`\n]+)`", open(page, encoding="utf-8").read()):
        for path in re.findall(r"(?:^|\s)((?:\./)?(?:sim|assets|renderer|shaders|tools|tests|docs|cmake|examples)/[\w./*-]*)", code):
            if not glob.glob(path.rstrip(".")):
                wrong.append(f"{page} names {path}, which is not there")
reached, due = set(), ["README.md"]
while due:
    page = due.pop()
    if page in reached or page not in links:
        continue
    reached.add(page)
    due += links[page]
wrong += [f"nothing leads from README.md to {page}" for page in pages
          if page.startswith("docs/") and page not in reached]
if len(links["README.md"]) < 10:
    wrong.append("README.md has hardly any links")
print("\n".join("FAILED: " + line for line in wrong))
sys.exit(bool(wrong))
END
