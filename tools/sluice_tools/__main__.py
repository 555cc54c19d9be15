"""python3 -m sluice_tools TOOL ..., as sluice calls it; the tools are those of TOOLS.

Exit status: 0 good, 2 bad input, 3 a Python package is missing (the message says how to get it).
"""
import importlib
import os
import sys

PACKAGES = {"numpy": "python3-numpy", "h5py": "python3-h5py", "matplotlib": "python3-matplotlib"}
TOOLS = ("plot", "movie", "workprecision", "residuals", "materialpath", "stability")


DEBIAN = "/usr/bin/python3"  # to which the packages of Debian belong


def hand_on():
    """Goes on as Debian's interpreter where this one, found by chance on the PATH, lacks a package;
    one that SLUICE_PYTHON names is taken as it is."""
    if os.environ.get("SLUICE_PYTHON") or not os.access(DEBIAN, os.X_OK):
        return
    if os.path.realpath(sys.executable) != os.path.realpath(DEBIAN):
        os.execv(DEBIAN, [DEBIAN, "-B", "-m", "sluice_tools", *sys.argv[1:]])


def main():
    if len(sys.argv) < 2 or sys.argv[1] not in TOOLS:
        print(f"usage: python3 -m sluice_tools {'|'.join(TOOLS)} ...", file=sys.stderr)
        return 2
    try:
        for module in PACKAGES:
            importlib.import_module(module)
    except ImportError as error:
        hand_on()
        package = PACKAGES.get(error.name, " ".join(PACKAGES.values()))
        print(f"sluice: pictures need the Python package '{error.name}', which {sys.executable} "
              f"does not have; on Debian: apt-get install {package}", file=sys.stderr)
        return 3
    tool = importlib.import_module("sluice_tools." + sys.argv[1])
    return tool.main(sys.argv[2:])


if __name__ == "__main__":
    sys.exit(main())
