#!/usr/bin/env python3
"""Run the commands of the pages, and compare how each ends with what is recorded.

A block without a language, or of `sh`, whose first word is a program of Sluice or one that reads
its files holds commands, one per line; three blanks part a command from what a page says of it.
The commands of a page run in one shell, in a folder of their own where the entries of the checkout
are linked; what they need is made before (PREPARED; a complete deck on the page is saved under the
name that the page gives). regression/command_lines/pages.txt has their
exit status and, of those that fail, the last line that they say; --record writes it again. Lines
that build, debug or install (OTHERS) are counted, not run: other parts of ./dev verify do that.
"""
import argparse
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

LIST = "regression/command_lines/pages.txt"
# adding.md is followed by the part `adding`, python.md by a test.
LEFT_OUT = {"docs/adding.md", "docs/python.md"}
PROGRAMS = {"sluice", "mpiexec", "mpirun", "sus", "puda", "lineextract", "timeextract",
            "partextract", "compare_uda", "compute_Lnorm_udas", "selectpart", "partvarRange",
            "restart_merger", "validateUda", "grep", "ls", "head", "tail", "cat", "h5dump", "h5ls",
            "for", "cp", "sed", "diff", "cd"}
OTHERS = {"./dev", "ninja", "cmake", "ctest", "gdb", "perf", "git", "apt", "apt-get", "sudo", "pip",
          "export", "valgrind", "scp", "ssh", "sbatch", "qsub", "module", "python3", "xdg-open"}
LIMIT = 300  # seconds of a command
PREPARED = {  # archives that a page talks of, from the decks of inputs/
    "docs/user_guide.md": {
        "shock_tube": "ice/shock_tube.ups", "blast_2d": "ice/blast_2d.ups",
        "blast_3d": "ice/blast_3d.ups --set DataArchiver/checkpoint/@interval=0.05",
        "water_air": "ice/water_air.ups", "explosion": "ice/amr_explosion.ups",
        "tracers": "ice/amr_tracers.ups", "colliding_disks": "mpm/colliding_disks.ups",
        "coarse": "ice/shock_tube.ups --set Grid/Level/Box/resolution=[100,1,1]",
        "fine": "ice/shock_tube.ups --set Grid/Level/Box/resolution=[400,1,1]"},
}
# Archives of the public suite stand for those of a user; without them the page waits.
PEERS = {"docs/coming_from_uintah.md": {
    "theirs.uda.000": "disks.uda.000", "theirs.uda.001": "disks.uda.000",
    "disks.uda.000": "disks.uda.000", "shock.uda.000": "shock.uda.000"}}
FENCE = re.compile(r"^```(\w*)\s*$")


def blocks_of(text):
    """The lines of each block without a language, or of sh."""
    inside, language, lines = False, "", []
    for line in text.splitlines():
        fence = FENCE.match(line)
        if fence and not inside:
            inside, language, lines = True, fence.group(1), []
        elif fence:
            inside = False
            if language in ("", "sh", "bash"):
                yield lines
        elif inside:
            lines.append(line)


def first_word(line):
    try:
        words = shlex.split(line, comments=True)
    except ValueError:
        words = line.split()
    while words and re.fullmatch(r"\w+=\S*", words[0]):
        words = words[1:]
    return words[0] if words else ""


def joined(lines):
    """Lines that end with a backslash go on."""
    whole = ""
    for line in lines:
        if line.endswith("\\"):
            whole += line[:-1].rstrip() + " "
            continue
        yield (whole + line.strip() if whole else line.rstrip())
        whole = ""


def commands_of(text):
    """(the commands, how many lines are left to other checks)"""
    found, left = [], 0
    for block in blocks_of(text):
        lines = [re.split(r"\s{3,}", line)[0] for line in joined(block)
                 if line.strip() and line[0] not in "# "]
        if not lines or first_word(lines[0]) not in PROGRAMS | OTHERS | {""}:
            continue
        for line in lines:
            runs = first_word(line) in PROGRAMS or re.match(r"[A-Z_]+=", line)
            if runs and not re.search(r"<[A-Z]|\b(DECK|UDA|FILE|NAME|DIR)\b|\.\.\.", line):
                found.append(line)
            else:
                left += 1
    return found, left


def prepare(page, root, folder, shell):
    """False where something is missing that the page needs."""
    for entry in root.iterdir():
        if not entry.name.startswith("."):
            (folder / entry.name).symlink_to(entry)
    peers = pathlib.Path(os.environ.get("SLUICE_PEER_ARCHIVES", "/nonexistent"))
    for name, source in PEERS.get(page, {}).items():
        if not (peers / source).exists():
            return False
        (folder / name).symlink_to(peers / source)
    for name, deck in PREPARED.get(page, {}).items():
        shell.run(f"sluice run inputs/{deck} --progress none "
                  f"--set DataArchiver/filebase={name}.uda")
    text = (root / page).read_text()
    for deck in re.findall(r"```xml\n(<Uintah_specification>.*?)```", text, re.DOTALL):
        name = re.search(r"complete deck as `([\w.]+)`", text).group(1)
        (folder / name).write_text(deck)
    return True


class Shell:
    """A shell that goes on from command to command."""

    def __init__(self, sluice, folder):
        self.folder = folder
        path = f"{pathlib.Path(sluice).resolve().parent}:{os.environ['PATH']}"
        self.environment = dict(os.environ, PATH=path, COLUMNS="100", MPLBACKEND="Agg")

    def run(self, command):
        """(exit status, the last line said where it is not 0)"""
        kept = self.folder / ".state"
        script = (f"[[ -f {kept} ]] && source {kept}\n{command}\nstatus=$?\n"
                  f"declare -p $(compgen -A variable | grep -E '^[A-Z]$|^PLATE$') > {kept} "
                  "2>/dev/null\nexit $status\n")
        try:
            done = subprocess.run(["bash", "-c", script], cwd=self.folder, env=self.environment,
                                  capture_output=True, text=True, timeout=LIMIT, errors="replace",
                                  check=False)
        except subprocess.TimeoutExpired:
            return f"none after {LIMIT} s", ""
        said = (done.stderr.strip() or done.stdout.strip()).splitlines()
        last = said[-1].replace(str(self.folder), "{}") if said and done.returncode != 0 else ""
        return done.returncode, last


def entry_of(command, status, last):
    return f"$ {command}\n= {status}\n" + (f"| {last}\n" if last else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--root", required=True, type=pathlib.Path)
    parser.add_argument("--folder", required=True, type=pathlib.Path)
    parser.add_argument("--record", action="store_true")
    parser.add_argument("pages", nargs="*")
    given = parser.parse_args()
    root = given.root.resolve()
    pages = given.pages or ["README.md", *(str(p.relative_to(root)) for p in
                                           sorted((root / "docs").glob("*.md")))]
    told, count, left, wrong, waiting = [], 0, 0, 0, []
    recorded = (root / LIST).read_text() if (root / LIST).exists() else ""
    for page in pages:
        commands, others = commands_of((root / page).read_text())
        left += others
        if page in LEFT_OUT or not commands:
            continue
        section = recorded.split(f"\n## {page}\n", 1)[-1].split("\n## ")[0]
        folder = given.folder / page.replace("/", "_")
        folder.mkdir(parents=True)
        shell = Shell(given.sluice, folder)
        if not prepare(page, root, folder, shell):
            waiting.append(page)
            told.append(f"\n## {page}\n{section}")
            continue
        told.append(f"\n## {page}\n")
        for command in commands:
            entry = entry_of(command, *shell.run(command))
            count += 1
            told.append(entry)
            if entry not in section and not given.record:
                wrong += 1
                print(f"   {page}: not as recorded:\n{entry}", flush=True)
        shutil.rmtree(folder)
    if given.record and not given.pages:
        head = "The commands of the pages and how they end; tools/verify/commands.py runs them.\n"
        (root / LIST).write_text(head + "".join(told))
    skipped = f"; SLUICE_PEER_ARCHIVES is not set: {', '.join(waiting)} skipped" if waiting else ""
    print(f"RESULT: {count} commands of the pages, {wrong} not as recorded; {left} lines that "
          f"build, debug or install were not run{skipped}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
