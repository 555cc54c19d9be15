#!/usr/bin/env python3
"""Write the result of one part of ./dev verify into the table of docs/verification.md."""
import argparse
import datetime
import pathlib

HEAD = """# What `./dev verify` found

This page is written by `./dev verify`. It has one row per part, with its last result, the commit
and the day. `./dev verify --list` describes the parts.

| part | outcome | commit | day | minutes | result |
| --- | --- | --- | --- | --- | --- |
"""


def rows_of(text):
    """The table's rows by part name, in order."""
    rows = {}
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("| ") and len(cells) == 6 and cells[0] not in ("part", "---"):
            rows[cells[0]] = cells
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page", type=pathlib.Path)
    for name in ("part", "commit", "outcome", "result"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--seconds", type=float, required=True)
    given = parser.parse_args()

    rows = rows_of(given.page.read_text()) if given.page.exists() else {}
    day = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d")
    rows[given.part] = [given.part, given.outcome, given.commit, day,
                        f"{given.seconds / 60:.1f}", given.result.replace("|", "/")]
    lines = ["| " + " | ".join(cells) + " |\n" for _, cells in sorted(rows.items())]
    given.page.write_text(HEAD + "".join(lines))


if __name__ == "__main__":
    main()
