"""How each check of the sources ends: its faults, their number, and 1 if there are any."""
import pathlib
import sys


def main(name, check, folder=""):
    """Checks the folder that the command line names, or this one of the project."""
    project = pathlib.Path(__file__).resolve().parents[2]
    faults = check(sys.argv[1] if len(sys.argv) > 1 else project / folder)
    for fault in faults:
        print(fault)
    print(f"{name}: {len(faults)} faults")
    sys.exit(1 if faults else 0)
