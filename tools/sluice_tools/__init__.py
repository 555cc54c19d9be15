"""Archives of runs as NumPy arrays, and pictures of them.

    import sluice_tools
    run = sluice_tools.open("shock_tube.uda")
    run["last"].sample("rho_CC", [[0.5, 0, 0]])

docs/python.md shows what there is, sluice_tools/results.py describes it.
"""


def open(path):  # pylint: disable=redefined-builtin
    """The results.Run of an archive."""
    from .results import Run
    return Run(path)
