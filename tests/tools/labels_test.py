#!/usr/bin/python3
"""B of labels that say nothing is 0 in layers of any thickness.

Columns of equal grains at rest on a base, each column shifted by another part of a diameter. A label large or small depends on
nothing but the height: phi_L falls linearly, and sigma as the weight above. So the means of layers of thickness h have psi_L - phi_L
= phi_L' sigma' (h^2/12 + v)/sigma, and grseg-fit takes out h^2/12 of it. v is left by the places of a grain's stress: a point of a
contact has its stress f and the mean label of its two grains, phi_L at the contact, so v = 0 by `contact-point`. By `branch` the half
of a contact that is s < d/2 below its contact point belongs to the grain d/2 below: v = (2/d) times the integral of s (s - d/2) from 0
to d/2, which is -d^2/24.

Usage: labels_test.py BIN DIMENSION
"""
import os
import subprocess
import sys
import tempfile

BIN, DIMENSION = os.path.abspath(sys.argv[1]), int(sys.argv[2])
D, ROWS, COLUMNS, G = 1.0, 48, 2000, 1.0
LOW, HIGH = 16, 32  # heights of the layers of the fit, d; neither they nor the layers next to them reach base or surface
BOUND = 2e-4  # chosen after the values, which differ by up to 1e-4 because 2,000 labels a row fill heights unevenly


def composition(y):
    return 0.85 - 0.7 * y / ROWS


def write_columns():
    """Grains and contacts of one frame, in the columns that grseg-import --format csv reads."""
    with open("grains.csv", "w") as grains, open("contacts.csv", "w") as contacts:
        grains.write("time,id,type,x,y,z,vx,vy,vz,radius,mass\n")
        contacts.write("time,i,j,fx,fy,fz\n")
        name = 0
        for column in range(COLUMNS):
            x = 1.01 * D * (column + 0.5)
            offset = D * (column + 0.5) / COLUMNS
            for row in range(-1, ROWS):
                y = offset + row * D
                # Of the grains near any height, a share phi_L(y) is large: golden and silver means fill [0, 1) evenly.
                large = (0.6180339887 * column + 0.7320508076 * row) % 1 < composition(y)
                kind = 3 if row < 0 else 2 if large else 1
                name += 1
                # The uppermost grain's mass makes the weight above a contact at the height c equal to ROWS - c.
                mass = 1.5 - offset if row == ROWS - 1 else 1
                grains.write(f"0,{name},{kind},{x!r},{y!r},0,0,0,0,{D / 2},{mass!r}\n")
                if row >= 0:
                    contacts.write(f"0,{name},{name - 1},0,{(ROWS - (y - D / 2)) * G!r},0\n")


def tool(name, *words):
    done = subprocess.run([f"{BIN}/grseg-{name}", *words], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"grseg-{name}: {done.stderr}")
    return done.stdout


def b_of(table, thickness):
    rows = tool("fit", table, "--heights", f"{LOW}dS:{HIGH}dS", "--thickness", thickness, "--quiet").splitlines()
    return next(float(row.split("\t")[6]) for row in rows if row.split("\t")[4:5] == ["B"])


def closed_form(h, moment):
    """Sum of phi_L' sigma' moment/sigma over layers, over that of phi_L phi_S."""
    layers = [LOW + h * (k + 0.5) for k in range(round((HIGH - LOW) / h))]
    excess = sum(0.7 / ROWS * moment / (ROWS - y) for y in layers)
    return excess / sum(composition(y) * (1 - composition(y)) for y in layers)


def main():
    write_columns()
    cell = ["--cell", f"x:0:{1.01 * D * COLUMNS}:periodic"] + (["--cell", "z:-0.5:0.5:periodic"] if DIMENSION == 3 else [])
    tool("import", "--format", "csv", "--grains", "grains.csv", "--contacts", "contacts.csv", "--units", "si", "--step", "1", "--gravity",
         f"0,{-G},0", "--grains-are", "discs" if DIMENSION == 2 else "spheres", "--dimension", str(DIMENSION), "--small", "1", "--large", "2",
         "--boundary", "3", "--origin", "0", *cell, "--accept-residual", "sizes=0", "--quiet", "-o", "run.h5")
    for assign, moment in (("branch", -D * D / 24), ("contact-point", 0)):
        for h in (8, 4, 2, 1):
            tool("stress", "run.h5", "--assign", assign, "--layer", f"{h}dS", "--quiet", "--overwrite", "-o", "stress.tsv")
            for thickness, of_layer in (("kept", h * h / 12), ("removed", 0)):
                found, expected = b_of("stress.tsv", thickness), closed_form(h, moment + of_layer)
                print(f"{assign}, layers of {h} d, {thickness}: B = {found:.6f}, {expected:.6f} by the closed form")
                assert abs(found - expected) < BOUND


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        main()
