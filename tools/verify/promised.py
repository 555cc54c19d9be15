"""The decks of the format's public suite that must run as they stand, from one list."""
import pathlib
import shlex

LIST = pathlib.Path(__file__).resolve().parents[2] / "regression" / "promised_decks.txt"


def promised_decks():
    """deck below the suite's folder inputs/: further options of `sluice run`"""
    lines = (line.split("#")[0] for line in LIST.read_text().splitlines())
    rows = [shlex.split(line) for line in lines if line.strip()]
    return {name: options for name, *options in rows}
