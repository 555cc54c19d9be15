"""python3 -m sluice_tools TOOL ..., as sluice calls it; the tools are those of TOOLS.

Exit status: 0 good, 2 bad input, 3 a Python package is missing (the message says how to get it).
"""
import importlib
import sys

PACKAGES = {"numpy": "python3-numpy", "h5py": "python3-h5py", "matplotlib": "python3-matplotlib"}
TOOLS = ("plot", "movie", "workprecision", "residuals", "materialpath", "stability")


def main():
    if len(sys.argv) < 2 or sys.argv[1] not in TOOLS:
        print(f"usage: python3 -m sluice_tools {'|'.join(TOOLS)} ...", file=sys.stderr)
        return 2
    try:
        for module in PACKAGES:
            importlib.import_module(module)
    except ImportError as error:
        package = PACKAGES.get(error.name, " ".join(PACKAGES.values()))
        print(f"sluice: pictures need the Python package '{error.name}', which {sys.executable} "
              f"does not have; on Debian: apt-get install {package}", file=sys.stderr)
        return 3
    tool = importlib.import_module("sluice_tools." + sys.argv[1])
    return tool.main(sys.argv[2:])


if __name__ == "__main__":
    sys.exit(main())
