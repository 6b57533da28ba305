"""Commands for the campaign of scripts/reproduce: its runs, and everything that is made from their tables.

    python3 scripts/reproduce/campaign COMMAND ...

COMMAND --help describes a command. Makefile, run.mk and document.mk call most commands. In all of them "the paper" is Staron
& Phillips (2015), and the words of run names are those of scripts/reproduce/README.md.
"""
import argparse
import importlib
import inspect
import os
import sys

OPTIONS = {
    "tables": {"metavar": "TABLES", "help": "folder of finished runs"},
    "-o": {"dest": "output", "required": True, "metavar": "FILE"},
    "--bin": {"metavar": "FOLDER", "default": os.path.join(os.path.dirname(__file__), *[".."] * 3, "build", "bin"),
              "help": "folder of the programs (build/bin)"},
    "--partition": {"metavar": "RULES"},
    "--flows": {"metavar": "LIST", "help": "flows to use instead of the default, separated by commas"},
    "--heights": {"metavar": "LOW:HIGH", "help": "heights of the layers that are used"},
    "--begin": {"default": "10", "metavar": "T", "help": "use windows from this time on, s (10)"},
    "--end": {"metavar": "T", "help": "use windows up to this time, s"},
}
MADE = ["tables", "-o", "--bin"]
FLUX = [*MADE, "--heights", "--begin", "--end"]
# Module and options of each command, and settings of these options that differ from OPTIONS.
COMMANDS = {
    "fits": ("fits", [*MADE, "--partition"], {}),
    "choices": ("fits", MADE, {}),
    "mixtures": ("fits", [*MADE, "--flows"], {}),
    "flows": ("flows", [*MADE, "fits"], {"fits": {"metavar": "FITS"}}),
    "numbers": ("measures", MADE, {}),
    "document": ("document", ["work", "documents"], {"documents": {"nargs": "+"}}),
    "questions": ("questions", MADE, {"tables": {"nargs": "+"}}),
    "rigid-limit": ("questions", ["questions", "-o", "--flow"], {"--flow": {"default": "phi0.45-s23"}}),
    "closures": ("closures", [*FLUX, "--flows"], {"--heights": {"default": "12dS:56dS"}}),
    "denser": ("closures", [*FLUX, "--flow"], {"--flow": {"default": "phi0.45-s23-mixed"}, "--heights": {"default": "4dS:56dS"}}),
    "stages": ("stages", ["tables", "-o", "--flows", "--window"],
               {"--flows": {"default": "phi0.45-s23-t600,phi0.45-s23-mixed-t600,phi0.45-s23-above-t600"},
                "--window": {"type": float, "default": 10, "metavar": "S", "help": "duration of a point (10)"}}),
    "spheres": ("spheres", MADE, {}),
    "answers": ("answers", ["folder", "documents"], {"documents": {"nargs": "+"}}),
    "combinations": ("combinations", ["source", "-o", "--figure"],
                     {"source": {"metavar": "FOLDER|combinations.tsv"}, "-o": {"required": False}, "--figure": {"metavar": "FILE"}}),
    "keep": ("keep", ["tables", "archive", "--questions", "--spheres"],
             {"--questions": {"action": "store_true"}, "--spheres": {"action": "store_true"}}),
    "unpack": ("keep", ["kept", "folder"], {}),
    "rounding": ("rounding", ["tables", "--heights"], {"tables": {"nargs": "+", "metavar": "STRESS.tsv", "help": None},
                                                        "--heights": {"default": "4dS:56dS"}}),
    "scene": ("run", ["name", "duration", "depth", "length", "accuracy", "frame_interval"], {}),
    "simulate": ("run", ["simulator", "every"], {}),
    "table": ("run", ["file", "made_by"], {"made_by": {"nargs": argparse.REMAINDER, "metavar": "COMMAND"}}),
    "outdated": ("run", ["again", "wanted"], {"wanted": {"nargs": "*", "metavar": "TABLE|TABLE: COMMAND"}}),
    "cost": ("run", [], {}),
    "extract": ("extract", ["what", "run"], {"what": {"choices": ["record", "observables", "snapshots"]}}),
    "relabel": ("extract", ["run", "random"], {}),
}


def main():
    name = sys.argv[1] if len(sys.argv) > 1 else "--help"
    if name not in COMMANDS:
        print(f"{__doc__}\nCommands: {', '.join(COMMANDS)}", file=sys.stdout if name == "--help" else sys.stderr)
        sys.exit(0 if name == "--help" else 2)
    module_name, words, others = COMMANDS[name]
    command = getattr(importlib.import_module(module_name), name.replace("-", "_"))
    parser = argparse.ArgumentParser(prog=f"campaign {name}", description=inspect.getdoc(command),
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    for word in words:
        parser.add_argument(*([word, "--output"] if word == "-o" else [word]), **(OPTIONS.get(word, {}) | others.get(word, {})))
    command(parser.parse_args(sys.argv[2:], argparse.Namespace(command=name)))


if __name__ == "__main__":
    main()
