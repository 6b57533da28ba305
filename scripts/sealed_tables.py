"""The line that ends every table of grseg: '# end: 3 rows, xxh3 0123456789abcdef', the number of rows and the
xxh3 (64 bit) of all bytes before it. Scripts that read a table check it, and those that change one write it anew."""
import ctypes
import ctypes.util
import re
import sys

MARK = "# end: "
# Tables of grseg 0.1 and those that name no program have no such line.
WITH_END = re.compile(r"^# program: grseg-\S+ (?!0\.1\.)", re.MULTILINE)


def xxh3(data):
    """16 hexadecimal digits, by the library that grseg is built with."""
    name = ctypes.util.find_library("xxhash")
    if name is None:
        sys.exit("libxxhash is missing; install it (scripts/setup does)")
    digest = ctypes.CDLL(name).XXH3_64bits
    digest.argtypes, digest.restype = (ctypes.c_char_p, ctypes.c_size_t), ctypes.c_uint64
    return f"{digest(data, len(data)):016x}"


def end_line(text):
    lines = text.split("\n")[:-1]
    rows = sum(not line.startswith("#") for line in lines) - 1
    return f"{MARK}{rows} rows, xxh3 {xxh3(text.encode())}\n"


def sealed(text):
    """The table with the line that ends it."""
    return text + end_line(text)


def unsealed(text, name="table"):
    """The table without the line that ends it. Exits where that does not agree with the others, or is missing."""
    at = text.rfind("\n") + 1 if not text.endswith("\n") else text.rfind("\n", 0, -1) + 1
    if not text.startswith(MARK, at):
        if WITH_END.search(text):
            sys.exit(f"{name}: does not end with the line '{MARK}...'; it is truncated or damaged, make it anew")
        return text
    if text[at:] != end_line(text[:at]):
        sys.exit(f"{name}: does not agree with its last line, '{text[at:].strip()}'; it is damaged, make it anew")
    return text[:at]
