"""How each check of the sources ends: its faults, their number, and 1 if there are any.

Faults that are right as they stand are rows of exceptions.tsv: check, file (or a folder, with a
slash at its end), a piece of the fault, reason. A row that nothing needs is a fault itself.
"""
import csv
import pathlib
import sys

PROJECT = pathlib.Path(__file__).resolve().parents[2]
EXCEPTIONS = pathlib.Path(__file__).with_name("exceptions.tsv")
COLUMNS = ["check", "path", "text", "reason"]


def read_exceptions(file=EXCEPTIONS):
    with file.open(encoding="utf-8", newline="") as rows:
        return list(csv.DictReader(rows, delimiter="\t"))


def names(exception, fault):
    """Whether an exception names this fault."""
    path = exception["path"]
    begins = fault.startswith(path if path.endswith("/") else path + ":")
    return begins and exception["text"] in fault


def without_exceptions(check, faults, exceptions):
    mine = [e for e in exceptions if e["check"] == check]
    left = [fault for fault in faults if not any(names(e, fault) for e in mine)]
    unused = [f"exceptions.tsv: {check}, {e['path']}, '{e['text']}': nothing needs it any more"
              for e in mine if not any(names(e, fault) for fault in faults)]
    return left + unused


def main(name, check, folder=""):
    """Checks the folder that the command line names, or this one of the project."""
    if len(sys.argv) > 1:
        faults = check(sys.argv[1])
    else:
        faults = without_exceptions(name, check(PROJECT / folder), read_exceptions())
    for fault in faults:
        print(fault)
    print(f"{name}: {len(faults)} faults")
    sys.exit(1 if faults else 0)
