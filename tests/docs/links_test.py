#!/usr/bin/python3
"""Checks that targets of links and names in documents exist. Usage: links_test.py SOURCE [PAGE ...]

In README.md, docs/, and the READMEs of formats/, data/, scripts/ and tests/, or in the given PAGEs:
    links        relative links lead to a file or folder, their #anchors to a heading of it
    `paths`      in backticks or in code exist if they begin with a folder of the repository
    `names.hpp`  of sources are names of a file somewhere in the repository
    `names()`    beside a link to a source occur in that source (or in another source linked in the line)
"""
import pathlib
import re
import subprocess
import sys

FOLDERS = "formats|sim|analysis|tests|scripts|docs|data"
PATH = re.compile(rf"^(?:{FOLDERS})/[\w./*+-]*$")
SOURCE = re.compile(r"^[\w-]+\.(?:hpp|cpp|gp|sbatch)$")
CALL = re.compile(r"^[\w:~]+\(\)$")
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^()\s]+)\)")
WORD_ENDS = ",;:.)'\""


def pages_of(root):
    yield root / "README.md"
    yield from sorted((root / "docs").rglob("*.md"))
    for folder in ("formats", "data", "scripts", "tests"):
        yield from sorted((root / folder).rglob("README.md"))


def slug(heading):
    """Anchor that GitHub makes for a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").replace("*", "")
    text = re.sub(r"[^\w\- ]", "", text.strip().lower())
    return text.replace(" ", "-")


def outside_fences(text):
    """Lines, each with True if it is code."""
    fenced = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
            continue
        yield number, line, fenced or line.startswith("    ")


def anchors(path):
    found, text = set(), path.read_text()
    for _, line, code in outside_fences(text):
        match = None if code else re.match(r"#+\s+(.*)", line)
        if match:
            base = name = slug(match.group(1))
            count = 0
            while name in found:
                count += 1
                name = f"{base}-{count}"
            found.add(name)
    return found | set(re.findall(r'<a (?:id|name)="([^"]+)"', text))


def broken_link(page, target):
    """Error in the target of a link, and the file to which the link leads."""
    if re.match(r"[a-z]+:", target):
        return None, None
    name, _, anchor = target.partition("#")
    file = (page.parent / name).resolve() if name else page
    if not file.exists():
        return f"{target}: there is no such file", None
    if anchor and file.suffix == ".md" and anchor not in anchors(file):
        return f"{target}: {file.name} has no such heading", file
    return None, file


def broken_name(root, names, word):
    if PATH.match(word):
        if not any(root.glob(word.rstrip("/").replace("NAME", "*"))):
            return f"{word}: there is no such file or folder"
    elif SOURCE.match(word) and word not in names:
        return f"{word}: no source has this name"
    return None


def check(root, names, page):
    for number, line, code in outside_fences(page.read_text()):
        sources = []
        if not code:
            for target in LINK.findall(re.sub(r"`[^`]*`", "``", line)):
                wrong, file = broken_link(page, target)
                if wrong:
                    yield number, wrong
                elif file and file.suffix in (".hpp", ".cpp"):
                    sources.append(file)
        spans = [line] if code else re.findall(r"`([^`]+)`", line)
        for word in (word.strip(WORD_ENDS) for span in spans for word in span.split()):
            wrong = broken_name(root, names, word)
            if wrong:
                yield number, wrong
        if sources and not code:
            for span in spans:
                if CALL.match(span):
                    yield from missing_call(number, span, sources)


def missing_call(number, span, sources):
    name = span[:-2].split("::")[-1]
    if not any(re.search(rf"\b{re.escape(name)}\b", file.read_text()) for file in sources):
        yield number, f"{span}: not in {', '.join(file.name for file in sources)}"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    listed = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=False)
    files = listed.stdout.split("\n") if listed.returncode == 0 else [str(p) for p in root.rglob("*")]
    names = {pathlib.PurePosixPath(file).name for file in files}
    pages = [pathlib.Path(name).resolve() for name in sys.argv[2:]] or list(pages_of(root))
    wrong = sorted({f"{page.relative_to(root)}:{number}: {words}"
                    for page in pages for number, words in check(root, names, page)})
    print("\n".join(wrong + [f"{len(pages)} pages, {len(wrong)} things that are not there"]))
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
