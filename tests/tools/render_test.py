#!/usr/bin/python3
"""Files of pictures and films: pixels at positions computed by hand have the colours of their grains, vector
files have one circle for each image of a grain, the same command gives the same bytes, wrong input is refused
with one sentence, and a film that fails leaves no file.
Usage: render_test.py GRSEG-RENDER THREE-GRAINS.h5 RUN.h5
"""
import os
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib

render, three, run = (os.path.abspath(word) for word in sys.argv[1:])
folder = tempfile.TemporaryDirectory()  # removed at the end of the script
os.chdir(folder.name)
SMALL, LARGE, BOUNDARY, WHITE = (0x56, 0xB4, 0xE9), (0xD5, 0x5E, 0x00), (0xA8, 0xA8, 0xA8), (255, 255, 255)
BLUE = (0x00, 0x72, 0xB2)
BARE = ["--no-time", "--no-scale", "--no-bar"]


def call(*words, path=None):
    environment = dict(os.environ, PATH=path) if path is not None else None
    return subprocess.run([render, *words], capture_output=True, text=True, env=environment)


def made(name, *words, of=three, path=None):
    done = call(of, *words, "-o", name, path=path)
    assert done.returncode == 0 and not done.stderr and not done.stdout, done
    return name


def refused(code, sentence, *words, path=None):
    before = sorted(os.listdir())
    done = call(*words, path=path)
    assert done.returncode == code and done.stdout == "", (words, done)
    assert done.stderr == f"grseg-render: {sentence}\n", (words, done.stderr)
    assert sorted(os.listdir()) == before, os.listdir()


def chunks_of(png):
    """Type and data of each chunk of a PNG whose checksums agree."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, chunks = 8, []
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        data = png[at + 8:at + 8 + length]
        assert struct.unpack(">I", png[at + 8 + length:at + 12 + length])[0] == zlib.crc32(kind + data)
        chunks.append((kind, data))
        at += 12 + length
    return chunks


class Picture:
    """The pixels of a PNG of 8 bits and three colours."""

    def __init__(self, name):
        chunks = chunks_of(open(name, "rb").read())
        self.width, self.height, *kind = struct.unpack(">IIBBBBB", dict(chunks)[b"IHDR"])
        assert kind == [8, 2, 0, 0, 0], kind
        self.text = dict(chunks).get(b"iTXt", b"").decode()
        data = zlib.decompress(b"".join(part for name, part in chunks if name == b"IDAT"))
        stride, before, self.rows = 3 * self.width, bytearray(3 * self.width), []
        for y in range(self.height):
            how, row = data[y * (stride + 1)], bytearray(data[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
            for x in range(stride):
                a, b, c = (row[x - 3] if x > 2 else 0), before[x], (before[x - 3] if x > 2 else 0)
                nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
                row[x] = row[x] + [0, a, b, (a + b) // 2, nearest][how] & 255
            self.rows.append(row)
            before = row

    def at(self, x, y):
        x, y = int(x), int(y)
        return tuple(self.rows[y][3 * x:3 * x + 3])


# A picture 500 pixels wide has letters of 11 pixels, so the margin is 0.8 x 11 = 8.8, where the panel begins. The panel
# shows x from 0 to 0.05 m and y from -0.01 to 0.02 m in 500 - 2 x 8.8 = 482.4 pixels.
SCALE, EDGE, TOP = 482.4 / 0.05, 8.8, 0.02


def place(x, y):
    return EDGE + SCALE * x, EDGE + SCALE * (TOP - y)


def near(colour, expected, most=1):
    return all(abs(a - b) <= most for a, b in zip(colour, expected))


def check_pixels():
    """The last frame: the large grain is at (0.053, 0.005) mm, here 3 mm from the left edge; the small grain is on it
    at y = 12.5 mm, the boundary grain below it at y = -5 mm."""
    view = ["--region", "0.05m:0.1m,-0.01m:0.02m", "--width", "500", *BARE]
    picture = Picture(made("three.png", *view))
    # 482.4 x 3/5 + 2 x 8.8 = 307.04, rounded up
    assert (picture.width, picture.height) == (500, 308), (picture.width, picture.height)
    assert near(picture.at(*place(0.003, 0.005)), LARGE)
    assert near(picture.at(*place(0.003 + 0.0045, 0.005)), LARGE)
    assert near(picture.at(*place(0.003, 0.0125)), SMALL)
    assert near(picture.at(*place(0.003, -0.005)), BOUNDARY)
    for x, y in (0.003 + 0.0053, 0.005), (0.003 + 0.0028, 0.0125), (0.003, 0.0153):
        assert near(picture.at(*place(x, y)), WHITE), (x, y)
    assert "history: three grains by hand\n" in picture.text, picture.text
    assert "--region 0.05m:0.1m,-0.01m:0.02m" in picture.text, picture.text
    dark = Picture(made("dark.png", *view, "--theme", "dark"))
    assert dark.at(2, 2) == (0x14, 0x17, 0x1C) and near(dark.at(*place(0.003, 0.0125)), SMALL)


def check_split():
    """The branch runs from y = 5 to 12.5 mm: under size it is split at 10 mm, under half at 8.75 mm."""
    view = ["--region", "0.05m:0.1m,-0.01m:0.02m", "--width", "500", *BARE, "--forces", "--force-width", "5mm"]
    # The line of the stronger contact, 1e-3 N, is 5 mm wide; the line of this contact, 2e-4 N, is 1 mm wide.
    for rule, split in ("size", 10), ("half", 8.75), ("uniform:0.8", 11), ("contact-point", 10):
        picture = Picture(made(f"{rule}.png", *view, "--partition", rule))
        for x in 0.0026, 0.0034:
            assert near(picture.at(*place(x, (split - 0.3) / 1000)), LARGE), rule
            assert near(picture.at(*place(x, (split + 0.3) / 1000)), BLUE), rule
        pale = picture.at(*place(0.003 + 0.0007, 0.0125))
        assert not near(pale, BLUE, 40) and not near(pale, WHITE, 40), pale
    plain = Picture(made("plain.png", *view))
    assert near(plain.at(*place(0.003, 0.01)), (0x1A, 0x1A, 0x1A))


def circles(svg, colour):
    """Number of times that an SVG fills with this colour; versions of cairo write it in percent or in parts of 255."""
    fills = [[float(part[:-1]) * 2.55 if part.endswith("%") else float(part) for part in fill.split(",")]
             for fill in re.findall(r"fill(?::|=\")rgb\(([^)]*)\)", svg)]
    return sum(near(fill, colour, 1e-3) for fill in fills)


def check_vectors():
    """The large grain in frame 0 is at x = 0.05: a region from 0.051 on cuts it, and a region from -0.35 on shows it twice."""
    svg = open(made("once.svg", *BARE)).read()
    assert [circles(svg, c) for c in (SMALL, LARGE, BOUNDARY)] == [1, 1, 1]
    twice = open(made("twice.svg", *BARE, "--region", "-0.35m:0.35m,:")).read()
    assert [circles(twice, c) for c in (SMALL, LARGE, BOUNDARY)] == [2, 2, 2]
    cut = open(made("cut.svg", *BARE, "--region", "0.055m:0.4m,:")).read()
    # The small grain, radius 2.5 mm, ends at 0.0555; all three grains are repeated 0.35 m further on, at 0.403.
    assert [circles(cut, c) for c in (SMALL, LARGE, BOUNDARY)] == [1, 2, 2]
    assert "<desc>program: grseg-render" in svg
    pdf = open(made("three.pdf"), "rb").read()
    assert pdf.startswith(b"%PDF-1.") and pdf.rstrip().endswith(b"%%EOF")
    table = int(re.search(rb"startxref\s+(\d+)", pdf).group(1))
    assert pdf[table:table + 4] == b"xref" or b"/XRef" in pdf[table:table + 300]
    assert b"CreationDate" not in pdf


def check_bytes():
    """The same command gives the same bytes, also a second later."""
    words = ["--forces", "--partition", "size", "--at", "start,end"]
    first = {}
    for kind in "png", "svg", "pdf":
        first[kind] = open(made(f"again.{kind}", *words, of=run), "rb").read()
    time.sleep(1.1)
    for kind, bytes_before in first.items():
        os.remove(f"again.{kind}")
        assert open(made(f"again.{kind}", *words, of=run), "rb").read() == bytes_before, kind
    done = call(run, *words, "-o", "again.png")
    assert done.returncode == 2 and "already exists" in done.stderr
    for color in "speed", "pressure", "composition", "displacement:5", "rise:5", "velocity:y", "spin", "contacts", \
            "radius", "species":
        made("field.svg", "--color", color, "--overwrite", of=run)


def check_refusals():
    takes = fake("takes", 'cat > "$file"')
    output = ["-o", "new.png"]
    refused(2, "name what to write: -o NAME.png", three)
    refused(2, "-o 'new.jpg': name a picture that ends in .png, .svg or .pdf, or a film that ends in .mp4 or .webm",
            three, "-o", "new.jpg")
    refused(2, "nowhere.h5: no such file", "nowhere.h5", *output)
    refused(2, "2 runs given; render one at a time", three, three, *output)
    refused(2, f"--at 7: {three} goes from 5e-05 s to 0.15005 s", three, "--at", "7", *output)
    refused(2, "--at 'last': write a time in s, start or end", three, "--at", "last", *output)
    refused(2, "--fps is for films; name a film, as in -o film.mp4, or use --at for a picture", three, "--fps", "3", *output)
    refused(2, "--at is for pictures; for a film use --begin and --end", three, "--at", "0", "-o", "new.mp4")
    refused(2, "--fps must be positive, and at most 240", three, "--fps", "0", "-o", "new.mp4")
    refused(2, "--every must be positive", three, "--every", "-1", "-o", "new.mp4")
    refused(2, "--range: species have no range; choose a field with --color", three, "--range", "0:1", *output)
    refused(2, "--range '1:0': write the values of the first and the last colour, as in 0:0.5", three, "--range", "1:0",
            "--color", "speed", *output)
    refused(2, "--partition needs --forces, whose lines it splits, or --color pressure", three, "--partition", "half",
            *output)
    refused(2, "--plane, --slice and --project are for runs in three dimensions", three, "--project", *output)
    refused(2, "unknown --theme 'drak'; choose light or dark", three, "--theme", "drak", *output)
    refused(2, "--force-width must be positive", three, "--forces", "--force-width", "0", *output)
    # 64 - 2 x 8.8 = 46.4 pixels for 0.01 mm, plus the two margins.
    refused(2, "the picture would be 64 x 4640018 pixels; choose a smaller --width or another --region", three,
            "--width", "64", "--region", "0:1e-5m,0:1m", *BARE, *output)
    refused(2, "the picture is too narrow for its height; choose another --width or --region", three, "--region",
            "0:1e-5m,0:1m", *output)
    nowhere = ["--region", "0.05m:0.1m,0.1m:0.12m"]
    for words in ["--at", "start,end", *output], ["-o", "new.mp4"]:
        refused(2, "no grain is in --region '0.05m:0.1m,0.1m:0.12m': the grains lie at x = 4.5 to 5.8 cm, y = -1 to 1.5 cm", three,
                *nowhere, *words, path=takes)
    said = call(three, "--at", "0.01,0.05", "-o", "nearest.png")
    assert said.returncode == 0 and said.stderr == "grseg-render: shows the nearest frames: 5e-05 s for --at 0.01\n", said.stderr
    open("text.h5", "w").write("no run")
    refused(3, "text.h5: is not an HDF5 file, or is truncated or damaged", "text.h5", *output)


def fake(name, text):
    """A folder with a program ffmpeg that runs these commands; its last argument is file:NAME."""
    os.mkdir(name)
    with open(f"{name}/ffmpeg", "w") as program:
        program.write(f"#!/bin/sh\nfor last; do :; done\nfile=${{last#file:}}\n{text}\n")
    os.chmod(f"{name}/ffmpeg", 0o755)
    return os.path.abspath(name) + ":/bin:/usr/bin"


def check_film_frames():
    """Input of ffmpeg: four frames of three.h5, whose grains move by a millimetre per frame."""
    keeps = fake("keeps", 'cat > "$file"; printf "%s\\n" "$@" > arguments')
    view = ["--region", "0.05m:0.1m,-0.01m:0.02m", "--width", "500", *BARE]
    raw = open(made("film.mp4", *view, path=keeps), "rb").read()
    arguments = open("arguments").read().split("\n")
    assert arguments[arguments.index("-s") + 1] == "500x308", arguments
    assert arguments[arguments.index("-r") + 1] == "25"
    size = 4 * 500 * 308
    assert len(raw) == 4 * size, len(raw) / size
    for k in range(4):
        x, y = place(0.001 * k, 0.0125)
        at = k * size + 4 * (int(y) * 500 + int(x))
        if k > 0:  # half of the first grain is visible
            assert near(tuple(raw[at + 2 - c] for c in range(3)), SMALL), k
    assert open(made("film.mp4", *view, "--overwrite", "--threads", "3", path=keeps), "rb").read() == raw
    every = open(made("every.mp4", *view, "--every", "0.1", path=keeps), "rb").read()
    assert every == raw[:size] + raw[2 * size:3 * size]
    sparse = call(three, *view, "--every", "0.04", "--overwrite", "-o", "every.mp4", path=keeps)
    assert open("every.mp4", "rb").read() == raw
    assert sparse.returncode == 0 and sparse.stderr == (
        "grseg-render: the frames are 0.05 s apart, so --every 0.04 shows all of them and the film is 1.25 times as "
        "fast as asked; to keep the speed use --fps 20\n"), sparse
    stride = open(made("stride.mp4", *view, "--stride", "3", "--begin", "0", path=keeps), "rb").read()
    assert stride == raw[:size] + raw[3 * size:]


def has_content(name):
    try:
        return os.path.getsize(name) > 0
    except FileNotFoundError:
        return False


def check_film_failures():
    os.mkdir("empty")
    nothing = os.path.abspath("empty")
    refused(1, "ffmpeg, which makes films, is not in PATH: install it (Debian: apt-get install ffmpeg), or make "
            "pictures (-o NAME.png)", three, "-o", "new.mp4", path=nothing)
    fails = fake("fails", 'echo half > "$file"; echo "no\tsuch encoder" >&2; exit 3')
    refused(1, r"ffmpeg failed with exit code 3: no\x09such encoder", run, "-o", "new.mp4", path=fails)
    silent = fake("silent", 'cat > "$file"; exit 4')
    refused(1, "ffmpeg failed with exit code 4: it printed no message", three, "-o", "new.webm", path=silent)

    slow = fake("slow", 'echo half > "$file"; sleep 60')
    before = sorted(os.listdir())
    for number in signal.SIGINT, signal.SIGTERM:
        program = subprocess.Popen([render, run, "-o", "new.mp4"], stderr=subprocess.PIPE, text=True,
                                   env=dict(os.environ, PATH=slow))
        # Files are also made for a moment at the start, to try whether that is possible; they stay empty.
        while program.poll() is None and not any(has_content(name) for name in set(os.listdir()) - set(before)):
            time.sleep(0.001)
        # The program reads nothing, so the pipe is soon full; the signal comes before or during this.
        program.send_signal(number)
        said = program.communicate(timeout=30)[1]
        assert program.returncode == 128 + number, (program.returncode, said)
        assert said == "grseg-render: interrupted; nothing is written\n", said
        assert sorted(os.listdir()) == before, os.listdir()


def check_true_films():
    if shutil.which("ffmpeg") is None:
        return print("ffmpeg is not installed: no true film was made")
    words = ["--width", "200", "--end", "1"]
    for kind in "mp4", "webm":
        first = open(made(f"true.{kind}", *words, of=run), "rb").read()
        assert b"grseg-render" in first and len(first) > 2000
        os.remove(f"true.{kind}")
        assert open(made(f"true.{kind}", *words, "--threads", "2", of=run), "rb").read() == first, kind
        os.remove(f"true.{kind}")
        assert open(made(f"true.{kind}", *words, of=run), "rb").read() == first, kind


check_pixels()
check_split()
check_vectors()
check_bytes()
check_refusals()
check_film_frames()
check_film_failures()
check_true_films()
