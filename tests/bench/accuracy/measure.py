"""Numbers of one trajectory for the accuracy-cost study, from the analysis tools."""
import json
import math
import os
import subprocess
import sys

import h5py
import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../scripts"))
import shared  # noqa: E402


def tool(folder, name, *arguments):
    done = subprocess.run([f"{folder}/{name}", *arguments], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{name} {' '.join(arguments)}: {done.stderr}")
    return done.stdout


def version(folder):
    return tool(folder, "grseg-sim", "--version").split("\n")[0]


def processor():
    for line in open("/proc/cpuinfo"):
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return "unknown processor"


def of_simulator(trajectory, begin):
    """Means of observables over all steps since `begin`, lengths in d_S."""
    with h5py.File(trajectory, "r") as file:
        d = float(numpy.ravel(file["parameters/small_diameter"][()])[0])
        mobile = file["particles/grains/species"][:] != 2
        time = file["particles/grains/velocity/time"][:]
        late = time >= begin
        velocity = file["particles/grains/velocity/value"][late, :, 0][:, mobile]
        height = file["particles/grains/position/value"][late, :, 1][:, mobile]
        observables = {name: item["value"][:][late] if isinstance(item, h5py.Group) else item[:][late]
                for name, item in file["observables"].items()}
    steps = observables["steps"]

    def per_step(name):
        return float((observables[name] * steps).sum() / steps.sum())

    numbers = {
        "mean_velocity": float(velocity.mean()),
        "shear_rate": float(numpy.mean([numpy.polyfit(y, u, 1)[0]
                                        for u, y in zip(velocity, height)])),
        "mean_overlap": per_step("mean_overlap") / d,
        "mean_gap": per_step("mean_gap") / d,
        "largest_overlap": float(observables["largest_overlap"].max()) / d,
        "sweeps": per_step("sweeps"),
        "contacts": per_step("contacts"),
        "missed_share": float(observables["missed_steps"].sum() / steps.sum()),
        "momentum_defect": float(observables["momentum_defect"].max()),
    }
    if "energy_defect" in observables:
        numbers["energy_defect"] = float(numpy.abs(observables["energy_defect"]).max())
    return numbers


def of_fit(folder, table, **options):
    arguments = [x for key, value in options.items() for x in (f"--{key}", value)]
    fit = json.loads(tool(folder, "grseg-fit", table, "--json", *arguments))
    return [row["value"] for row in fit["numbers"] if row["quantity"] == "B"]


def of_micro(table):
    """Means over the whole bed: coordination, force per contact end, their product, mixed share."""
    bed = [row for row in table if math.isnan(row["y0"])]
    mean = lambda key: sum(r[key] * r["frames"] for r in bed) / sum(r["frames"] for r in bed)
    small, large = mean("z_S"), mean("z_L")
    return {"z_S": small, "z_L": large,
            "zf_S": mean("z_S") * mean("f_S"), "zf_L": mean("z_L") * mean("f_L"),
            "mixed_share": mean("mixed_share")}


def everything(folder, trajectory, begin):
    numbers = of_simulator(trajectory, begin)
    stress, kinetic, micro = (f"{trajectory}.{name}.tsv" for name in ("stress", "kinetic", "micro"))
    tool(folder, "grseg-stress", trajectory, "--begin", str(begin), "--overwrite", "-o", stress)
    tool(folder, "grseg-kinetic", trajectory, "--begin", str(begin), "--overwrite", "-o", kinetic)
    heights = {"heights": "4dS:56dS"}
    numbers["B_size"], numbers["B_half"] = of_fit(folder, stress, partition="size,half", **heights)
    (numbers["B_kappa"],) = of_fit(folder, kinetic, quantity="kinetic", **heights)
    tool(folder, "grseg-micro", trajectory, "--begin", str(begin), "--overwrite", "-o", micro)
    numbers.update(of_micro(shared.parse(tool(folder, "grseg-derive", micro))[1]))
    for path in (stress, kinetic, micro):
        os.remove(path)
    return numbers
