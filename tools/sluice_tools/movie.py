"""Draw archives over time: the picture of `sluice plot` for each output, with one scale for all.

    python3 -m sluice_tools.movie ARCHIVE... -o x.gif|x.mp4 [options]     `sluice movie` calls this

A GIF needs nothing but Python; an MP4 is made by ffmpeg, which gets the frames through a pipe.
"""
import pathlib
import shutil
import subprocess
import sys

import numpy as np

from . import options, plot, scales, shots as all_shots, style
from .archive import ArchiveError

DPI = 100  # frames are many, and shown smaller than pictures


class MissingProgram(Exception):
    """Something that makes the movie is not installed; the message says what to do."""


class GifFile:
    """Frames as they come, each with its own palette of 256 colours."""

    def __init__(self, path, fps):
        self.path, self.fps, self.frames = path, fps, []

    def add(self, pixels):
        from PIL import Image
        self.frames.append(Image.fromarray(pixels).quantize(256, dither=0))

    def close(self):
        first, *others = self.frames
        first.save(self.path, format="GIF", save_all=True, append_images=others, loop=0,
                   duration=max(10, round(1000 / self.fps)))

    def abandon(self):
        self.frames = []


class Mp4File:
    """Frames through a pipe to ffmpeg."""

    def __init__(self, path, fps):
        self.path, self.fps, self.process = path, fps, None
        self.program = shutil.which("ffmpeg")
        if self.program is None:
            raise MissingProgram(f"{path}: an MP4 is made by ffmpeg, which is not on PATH; on "
                                 "Debian: apt-get install ffmpeg. A .gif needs no other program")

    def add(self, pixels):
        pixels = pixels[:pixels.shape[0] // 2 * 2, :pixels.shape[1] // 2 * 2]  # even, for yuv420p
        if self.process is None:
            height, width = pixels.shape[:2]
            self.process = subprocess.Popen(
                [self.program, "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24",
                 "-s", f"{width}x{height}", "-r", f"{self.fps:g}", "-i", "-", "-an", "-pix_fmt",
                 "yuv420p", str(self.path)], stdin=subprocess.PIPE)
        try:
            self.process.stdin.write(np.ascontiguousarray(pixels).tobytes())
        except BrokenPipeError:
            self._end()

    def _end(self):
        try:
            self.process.stdin.close()
        except BrokenPipeError:
            pass
        if self.process.wait() != 0:
            raise MissingProgram(f"{self.path}: ffmpeg ended with status "
                                 f"{self.process.returncode}, see its message above")

    def close(self):
        self._end()

    def abandon(self):
        if self.process is not None:
            self.process.kill()
            self.process.wait()


def outputs_of(archive, given):
    """Numbers of the outputs that become frames, in the order of their times."""
    def position(text):
        step = archive.step(text)
        return [number for number, _, _ in archive.steps].index(step.number)
    first, last = position(given.first), position(given.last)
    if last < first:
        raise ArchiveError(f"--from {given.first} --to {given.last}: there is no output between")
    return list(range(first, last + 1, given.every))


def frames_of(given):
    """A function of the number of a frame that returns its shots, and the count of frames. Other
    archives show their output nearest in time."""
    archives = all_shots.open_archives(given)
    numbers = outputs_of(archives[0][0], given)

    def shots(at):
        step = archives[0][0].step(f"#{numbers[at]}")
        found = [(archives[0][0], archives[0][1], step)]
        for archive, name in archives[1:]:
            times = np.array([time for _, time, _ in archive.steps])
            if not len(times):
                raise ArchiveError(f"{archive.path}: the archive holds no output yet")
            found.append((archive, name, archive.step(f"#{abs(times - step.time).argmin()}")))
        return all_shots.of_outputs(found, given)
    return shots, len(numbers)


class Extent:
    """What the values of one label reach over all frames."""

    def __init__(self):
        self.ends, self.size = [], 0.0

    def add(self, numbers, size):
        numbers = numbers[np.isfinite(numbers)]
        if len(numbers):
            self.ends += [numbers.min(), numbers.max()]
            above = numbers[numbers > 0]
            self.ends += [above.min()] if len(above) else []
        self.ends = [min(self.ends), max(self.ends),
                     *sorted(n for n in self.ends if n > 0)[:1]] if self.ends else []
        self.size = max(self.size, size)


def survey(shots_of, count, given):
    """({label: Scale}, window): one scale of each label, and one window, for all frames. In three
    dimensions the plane is that of the last frame."""
    last = shots_of(count - 1)
    given.normal, given.position = last[0].normal, last[0].position
    names = plot.drawn_variables(last[0], given)
    extents, window = {name: Extent() for name in names}, None
    for at in range(count):
        shots = shots_of(at)
        plot.check(shots, names, given)
        for name in names:
            for shot in shots:
                extents[name].add(shot.numbers(name), scales.natural_size(shot.step, name))
                if not shot.is_line and shot.is_of_particles(name):
                    window = joined(window, all_shots.window_of(shot, name))
    known = {}
    for name, extent in extents.items():
        known[name] = scales.of_numbers(np.array(extent.ends), extent.size, name, given)
        known[name].fixed = True
    return known, window


def joined(window, other):
    if window is None or other is None:
        return other if window is None else window
    return [(min(a[0], b[0]), max(a[1], b[1])) for a, b in zip(window, other)]


def pixels_of(figure, dpi):
    figure.set_dpi(dpi)
    figure.canvas.draw()
    return np.array(figure.canvas.buffer_rgba())[..., :3]


def fitted(pixels, shape):
    """All frames of a movie have the size of the first."""
    if shape is None or pixels.shape == shape:
        return pixels
    whole = np.full(shape, 255, dtype=np.uint8)
    rows, columns = min(shape[0], pixels.shape[0]), min(shape[1], pixels.shape[1])
    whole[:rows, :columns] = pixels[:rows, :columns]
    return whole


def make(given, plt, tell):
    shots_of, count = frames_of(given)
    file = (GifFile if pathlib.Path(given.output).suffix == ".gif" else Mp4File)(
        given.output, given.fps)
    known, window = survey(shots_of, count, given)
    shape = None
    try:
        for at in range(count):
            shots = shots_of(at)
            for shot in shots:
                shot.window = window
            figure = plot.draw_shots(shots, given, plt, known)
            pixels = fitted(pixels_of(figure, given.dpi or DPI), shape)
            shape = pixels.shape
            plt.close(figure)
            file.add(pixels)
            tell(at + 1, count, shots[0].step.time)
        file.close()
    except BaseException:
        file.abandon()
        raise
    return count


def tell_progress(done, count, time):
    """A line that is replaced on a terminal; in a file one in ten."""
    text = f"frame {done} of {count}, t = {time:.6g} s"
    if sys.stderr.isatty():
        print(f"\r{text}   ", end="" if done < count else "\n", file=sys.stderr, flush=True)
    elif done in (1, count) or done % max(1, count // 10) == 0:
        print(text, file=sys.stderr, flush=True)


def main(arguments=None):
    given = options.parse("movie", arguments)
    given.exact = None
    plot.settle(given)
    try:
        with style.pyplot() as plt:
            count = make(given, plt, tell_progress)
    except ArchiveError as error:
        print(f"sluice movie: {error}", file=sys.stderr)
        return 2
    except (OSError, MissingProgram) as error:
        print(f"sluice movie: {error}", file=sys.stderr)
        return 3
    print(f"movie: {given.output}, {count} frame{'s' if count != 1 else ''}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
