#!/usr/bin/env python3
"""Take something away from a run in its middle: power, its folder, memory.

power   Every flush of a run is noted, and with it what is on disk then. At a random moment the run
        is killed, and the folder gets what a disk without the writes since the last flush may hold:
        nothing of them; or all names, but of each file that was not flushed only its beginning,
        or zeros in place of its end. Every indexed step must read back, and the run that goes on
        from the last checkpoint must end with the bits of one that was never interrupted.
folder  The archive is removed. The run must end within 60 s with 3 and the archive's name.
memory  The run gets no more memory. It must end within 60 s with 3 and say so (or finish); every
        indexed step must read back, and the run must go on from its last checkpoint as above.

Every draw follows from the seed.
"""
import argparse
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time

ENDS = 60  # seconds that a run has to end
SETTINGS = ["DataArchiver/outputInterval=", "DataArchiver/outputTimestepInterval=5",
            "DataArchiver/checkpoint/@cycle=2", "DataArchiver/checkpoint/@timestepInterval=7"]


class Fault(Exception):
    pass


class Hazards:
    def __init__(self, given):
        self.given = given
        self.folder = given.folder
        self.draw = random.Random(given.seed)
        self.reference = self.run_to_the_end("reference", self.command("reference"))

    def command(self, name, restart=None):
        words = [self.given.sluice, "run", "-o", str(self.folder / name), "--progress", "none"]
        if restart:
            return words + ["--restart", str(restart)]
        settings = SETTINGS + [f"Time/max_Timesteps={self.given.steps}"] + self.given.set
        return words + [w for s in settings for w in ("--set", s)] + [self.given.deck]

    def start(self, name, words, **more):
        with open(self.folder / f"{name}.log", "wb") as log:
            return subprocess.Popen(words, stdout=log, stderr=log, **more)

    def told(self, name):
        return (self.folder / f"{name}.log").read_text(errors="replace")

    def run_to_the_end(self, name, words):
        begin = time.monotonic()
        if self.start(name, words).wait() != 0:
            raise Fault(f"{name} failed: {self.told(name)[-300:]}")
        self.wall = time.monotonic() - begin
        return self.archive(name)

    def archive(self, name):
        found = sorted((self.folder / name).glob("*.uda.[0-9][0-9][0-9]"))
        return found[-1] if found else None

    def ask(self, *words):
        done = subprocess.run([self.given.sluice, *map(str, words)], capture_output=True, text=True,
                              check=False)
        return done.returncode, done.stdout + done.stderr

    def check_archive(self, archive, what):
        """Every indexed step reads back; True where there is a checkpoint to go on from."""
        if not (archive / "index.xml").exists():
            return False
        status, told = self.ask("info", archive, "--verify")
        if status != 0:
            raise Fault(f"{what}: {archive} is damaged: {told[-300:]}")
        checkpoints = archive / "checkpoints/index.xml"
        return checkpoints.exists() and "<timestep " in checkpoints.read_text()

    def go_on(self, archive, name):
        """From the last checkpoint to the end: the bits of the reference."""
        end = self.run_to_the_end(name, self.command(name, archive))
        status, told = self.ask("compare", self.reference, end)
        if status != 0:
            raise Fault(f"{name}: another end than the uninterrupted run: {told[-300:]}")

    # Power.

    def power(self, number):
        name = f"power{number}"
        (self.folder / name).mkdir()
        disk = Disk(self.folder / name)
        run = self.start(name, self.command(name), env=disk.environment(self.given.shim))
        disk.listen()
        try:
            # Flushes that are noted take longer: somewhere in three times the plain run.
            run.wait(timeout=self.draw.uniform(0.05, 3 * self.wall))
        except subprocess.TimeoutExpired:
            run.send_signal(signal.SIGKILL)
            run.wait()
        disk.stop()
        checked = 0
        for kind in ("nothing", "beginnings", "zeros", "mixed"):
            left = self.folder / f"{name}_{kind}"
            disk.leave(left, kind, self.draw)
            for archive in sorted(left.glob("*.uda.[0-9][0-9][0-9]")):
                good = self.check_archive(archive, name)
                checked += 1
                if good and kind == "mixed":
                    self.go_on(archive, f"{name}_on")
            shutil.rmtree(left)
        shutil.rmtree(self.folder / name)
        shutil.rmtree(self.folder / f"{name}_on", ignore_errors=True)
        return checked

    # The folder, and memory.

    def until_checkpoint(self, run, name):
        """The archive once it has a checkpoint; None where the run ended before."""
        while run.poll() is None:
            archive = self.archive(name)
            if archive and (archive / "checkpoints/index.xml").exists():
                time.sleep(self.draw.uniform(0, 0.5 * self.wall))
                return archive if run.poll() is None else None
            time.sleep(0.005)
        return None

    def end_of(self, run, what):
        try:
            return run.wait(timeout=ENDS)
        except subprocess.TimeoutExpired as late:
            run.kill()
            raise Fault(f"{what}: still runs after {ENDS} s") from late

    def vanished_folder(self, number):
        name = f"folder{number}"
        run = self.start(name, self.command(name))
        archive = self.until_checkpoint(run, name)
        if archive is None:
            return 0
        aside = archive.with_name("aside")
        archive.rename(aside)
        status = self.end_of(run, name)
        told = self.told(name)
        if status != 3 or archive.name not in told:
            raise Fault(f"{name}: exit {status}, said: {told[-300:]}")
        shutil.rmtree(self.folder / name)
        return 1

    def refused_memory(self, number):
        name = f"memory{number}"
        run = self.start(name, self.command(name))
        archive = self.until_checkpoint(run, name)
        if archive is None:
            return 0
        pages = int(pathlib.Path(f"/proc/{run.pid}/statm").read_text().split()[0])
        limit = pages * os.sysconf("SC_PAGE_SIZE")
        try:
            resource.prlimit(run.pid, resource.RLIMIT_AS, (limit, limit))
        except ProcessLookupError:
            return 0
        status = self.end_of(run, name)
        told = self.told(name)
        if status not in (0, 3) or (status == 3 and "memory" not in told):
            raise Fault(f"{name}: exit {status}, said: {told[-300:]}")
        if self.check_archive(archive, name) and status == 3:
            self.go_on(archive, f"{name}_on")
            shutil.rmtree(self.folder / f"{name}_on")
        shutil.rmtree(self.folder / name)
        return 1 if status == 3 else 0


class Disk:
    """What has been flushed of a folder, as the preloaded library tells."""

    def __init__(self, root):
        self.root = root
        self.flushed = {}  # by path from the root
        self.pipes = [root.with_name(root.name + end) for end in (".told", ".heard")]
        for pipe in self.pipes:
            os.mkfifo(pipe)
        self.thread = threading.Thread(target=self._hear, daemon=True)

    def environment(self, shim):
        return dict(os.environ, LD_PRELOAD=str(shim), SYNC_TOLD=str(self.pipes[0]),
                    SYNC_HEARD=str(self.pipes[1]))

    def listen(self):
        self.thread.start()

    def stop(self):
        # Where the run never flushed, nobody has opened the pipes yet.
        for pipe, mode in zip(self.pipes, (os.O_WRONLY, os.O_RDONLY)):
            try:
                os.close(os.open(pipe, mode | os.O_NONBLOCK))
            except OSError:
                pass
        self.thread.join(timeout=10)
        for pipe in self.pipes:
            pipe.unlink()

    def _hear(self):
        with open(self.pipes[0], encoding="utf-8") as told:
            with open(self.pipes[1], "wb", buffering=0) as heard:
                for line in told:
                    words = line.split()
                    if words[0] == "all":
                        self.flushed = self.files()
                    elif len(words) == 2 and pathlib.Path(words[1]).is_file():
                        path = pathlib.Path(words[1])
                        self.flushed[str(path.relative_to(self.root))] = path.read_bytes()
                    try:
                        heard.write(b".")
                    except BrokenPipeError:
                        return

    def files(self):
        found = {}
        for path in self.root.rglob("*"):
            try:
                if path.is_file() and not path.is_symlink():
                    found[str(path.relative_to(self.root))] = path.read_bytes()
            except OSError:
                pass  # gone meanwhile
        return found

    def leave(self, folder, kind, draw):
        """Writes what the disk may hold after the loss."""
        there = self.flushed if kind == "nothing" else self.files()
        safe = set(self.flushed.values())  # also under a name that it has got since
        for name, data in there.items():
            if data not in safe:
                before = self.flushed.get(name, b"")
                kept = len(before) if data.startswith(before) else 0
                end = draw.randint(kept, len(data))
                how = draw.choice(["beginnings", "zeros", "all"]) if kind == "mixed" else kind
                if how == "beginnings":
                    data = data[:end]
                elif how == "zeros":
                    data = data[:end] + bytes(len(data) - end)
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--deck", required=True)
    parser.add_argument("--folder", required=True, type=pathlib.Path)
    parser.add_argument("--shim", required=True, type=pathlib.Path, help="sync_shim.c, compiled")
    parser.add_argument("--steps", type=int, default=60)
    parser.add_argument("--power", type=int, default=30)
    parser.add_argument("--vanish", type=int, default=5)
    parser.add_argument("--memory", type=int, default=20)
    parser.add_argument("--set", action="append", default=[], help="PATH=VALUE, as of sluice run")
    parser.add_argument("--seed", type=int, default=int(time.time()))
    given = parser.parse_args()
    given.folder.mkdir(parents=True)
    print(f"seed {given.seed}", flush=True)
    try:
        hazards = Hazards(given)
        disks = sum(hazards.power(n) for n in range(given.power))
        folders = sum(hazards.vanished_folder(n) for n in range(given.vanish))
        refused = sum(hazards.refused_memory(n) for n in range(given.memory))
    except Fault as fault:
        print(f"RESULT: {pathlib.Path(given.deck).stem}, seed {given.seed}: {fault}")
        return 1
    print(f"RESULT: {pathlib.Path(given.deck).stem}: {given.power} losses of power ({disks} disks),"
          f" {folders} vanished folders, {refused} refusals of memory: every indexed step reads "
          "back, every end equal to the bit")
    return 0


if __name__ == "__main__":
    sys.exit(main())
