#!/usr/bin/env python3
"""Write inputs that a fuzz target begins with: fuzz_seeds.py TARGET ROOT FOLDER.

The first byte of an input chooses what the rest is; each target's source tells.
"""
import gzip
import pathlib
import struct
import sys


def deck_inputs(root):
    for folder in ("src/framework/deck/bad_decks", "inputs/ice"):
        for deck in sorted((root / folder).glob("*.ups")):
            yield deck.read_bytes()
    good = (root / "inputs/ice/shock_tube.ups").read_bytes()
    for setting in ("CFD/cfl=0.2", "DataArchiver/save[2]/@label=press_CC", "Time/maxTime=",
                    "DataArchiver/save[@label=rho_CC]/@label=vel_CC",
                    "Grid/Level/Box/resolution=[10,1,1]", "CFD/ICE/advection/@type=FirstOrder"):
        yield good + b"\0" + setting.encode()


def geometry_inputs(_root):
    yield b"\0# points\n0 0 0\n1 0.5 1e-3\n"
    yield b"\x010 0 0  1e-3  1 2 3  1 0 0\n1 1 1  1.5d-3  1 2 3  1 0 0\n"
    yield b"\x02" + struct.pack(">8d", 0, 0, 0, 300, 1, 1, 1, 310)
    corners, faces = b"0 0 0\n1 0 0\n0 1 0\n0 0 1\n", b"0 1 2\n0 1 3\n0 2 3\n1 2 3\n"
    yield b"\x03" + corners + b"\0" + faces
    yield b"\x04" + bytes(range(0, 256, 16))
    yield b"\x04" + gzip.compress(bytes(range(0, 256, 16)))
    yield b"\x050 0\n1 0\n1 1\n0 1\n"


def list_inputs(root):
    def files(folder, pattern, most):
        return sorted((root / folder).rglob(pattern))[:most]
    for kind, folder, pattern in ((0, "regression", "*.study"), (1, "regression", "*.stability"),
                                  (2, "regression", "cases.json"), (5, "regression", "*.csv")):
        for file in files(folder, pattern, 12):
            yield bytes([kind]) + file.read_bytes()[:16000]
    yield (b'\x03{"variables": ["rho_CC"], "tolerance": 1e-9, "ranks": 2, "boxes": "2,1,1",'
           b' "exclude": ["vel_CC"], "tolerances": {"rho_CC": 1e-3}}')
    yield (b'\x04LIST = [("sod", "deck.ups", 1, "Linux", ["no_restart", "abs_tolerance=1e-5"]),\n'
           b'  ("all", "deck.ups", 8, "All", ["exactComparison"])]\n')


def archive_inputs(_root):
    for first in range(0, 256, 7):
        yield bytes([first, 0, 40, 60])


INPUTS = {"deck_fuzz": deck_inputs, "geometry_fuzz": geometry_inputs, "lists_fuzz": list_inputs}


def main(target, root, folder):
    make = INPUTS.get(target, archive_inputs)
    for number, data in enumerate(make(pathlib.Path(root))):
        (pathlib.Path(folder) / f"seed{number}").write_bytes(data)


if __name__ == "__main__":
    main(*sys.argv[1:])
