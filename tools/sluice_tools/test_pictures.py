"""Pictures by their pixels and texts: materials where they are, nothing clipped, faults told."""
import contextlib
import io
import pathlib
import unittest

import numpy as np

from sluice_tools import movie, plot, shots, style
from sluice_tools.archive import ArchiveError
from sluice_tools.test_support import RADIUS, Scenes


class Drawn:
    """The figure of a command, its panels in pixels, and what is wrong with its texts."""

    def __init__(self, *words):
        given = plot.parse([*map(str, words), "-o", "x.png"])
        with style.pyplot() as plt:
            figure = plot.draw(given, plt)
            figure.canvas.draw()
            self.faults = style.misplaced_texts(figure)
            self.texts = [t.get_text() for t in figure.findobj(lambda a: hasattr(a, "get_text"))]
            self.axes = [ax for ax in figure.axes if ax.get_visible()]
            self.whole = np.array(figure.canvas.buffer_rgba())[::-1, :, :3] / 255
            self.boxes = [ax.get_window_extent() for ax in self.axes]
            self.limits = [(ax.get_xlim(), ax.get_ylim()) for ax in self.axes]

    def panel(self, number=0):
        box = self.boxes[number]
        return self.whole[round(box.y0) + 2:round(box.y1) - 1,
                          round(box.x0) + 2:round(box.x1) - 1]

    def share(self, colour, number=0):
        from matplotlib.colors import to_rgb
        return (np.abs(self.panel(number) - to_rgb(colour)).max(axis=2) < 0.06).mean()


class Pixels(Scenes):
    BUBBLE = 0.5 * np.pi * RADIUS ** 2 / 4  # its share of the plane

    def test_an_absent_material_is_white(self):
        self.bubble()
        for material, share in (("helium", 1 - self.BUBBLE), ("air", self.BUBBLE)):
            drawn = Drawn(self.root, "--material", material, "--var", "temp_CC")
            self.assertAlmostEqual(drawn.share("white") / share, 1, delta=0.05)
            self.assertIn(f"temperature, {material}", drawn.texts)

    def test_of_the_whole_nothing_is_white_and_the_bubble_has_a_line(self):
        self.bubble()
        drawn = Drawn(self.root)
        for panel in range(4):
            self.assertLess(drawn.share("white", panel), 0.02)
        line = np.pi * RADIUS / 4 * (0.9 / 72 * 150) / drawn.panel().shape[0] * 2
        self.assertAlmostEqual(drawn.share("black") / line, 1, delta=0.5)
        for text in ("helium", "density", "speed"):
            self.assertIn(text, drawn.texts)

    def test_solids_lie_over_the_fluid_in_their_share(self):
        self.bubble(particles=True)
        x0, x1, y0, y1 = self.SQUARE
        drawn = Drawn(self.root)
        self.assertAlmostEqual(drawn.share(style.solid_colour(0)) / ((x1 - x0) * (y1 - y0) / 4), 1,
                               delta=0.05)
        self.assertIn("steel", drawn.texts)
        self.assertLess(Drawn(self.root, "--particles", "none").share(style.solid_colour(0)), 0.001)

    def test_particles_cover_their_body_without_gaps(self):
        self.bubble(particles=True)
        x0, x1, y0, y1 = self.SQUARE
        drawn = Drawn(self.root, "--var", "p.stress.pressure")
        (left, right), (low, high) = drawn.limits[0]
        share = (x1 - x0) * (y1 - y0) / ((right - left) * (high - low))
        self.assertAlmostEqual((1 - drawn.share("white")) / share, 1, delta=0.05)

    def test_equal_to_round_off_is_one_colour(self):
        self.bubble()
        drawn = Drawn(self.root, "--var", "vel_CC.y", "--var", "press_CC")
        for panel in (0, 1):
            colours = drawn.panel(panel).reshape(-1, 3)
            rare = np.abs(colours - np.median(colours, axis=0)).max(axis=1) > 0.06
            self.assertLess(rare.mean(), 0.04)  # but for the line of the bubble

    def test_a_logarithmic_scale_and_a_range_are_followed(self):
        self.bubble()
        drawn = Drawn(self.root, "--var", "temp_CC", "--range", "temp_CC=300:400", "--cmap", "gray",
                      "--log")
        self.assertAlmostEqual(drawn.share("white"), self.BUBBLE, delta=0.02)
        self.assertAlmostEqual(drawn.share("black"), 1 - self.BUBBLE, delta=0.04)

    def test_schlieren_are_dark_where_the_density_changes(self):
        self.bubble()
        drawn = Drawn(self.root, "--cmap", "schlieren")
        self.assertGreater(drawn.share("white"), 0.85)
        self.assertGreater(1 - drawn.share("white"), 0.5 * np.pi * RADIUS * 2 * 0.05 / 4)


class Several(Scenes):
    def second(self, cells, title):
        self.root = self.root.parent / f"case{cells}.uda.000"
        return self.bubble(cells, title)

    def two(self):
        first = self.root
        self.bubble(40)
        self.second(20, "A coarser bubble")
        return first, self.root

    def test_planes_stand_side_by_side_with_one_scale_and_their_difference(self):
        first, second = self.two()
        drawn = Drawn(first, second, "--names", "fine,coarse", "--var", "temp_CC", "--difference")
        self.assertEqual(len(drawn.axes), 3)
        for text in ("temperature, fine", "temperature, coarse", "coarse - fine"):
            self.assertIn(text, drawn.texts)
        corner = drawn.panel(0)[-3, -3], drawn.panel(1)[-3, -3]
        np.testing.assert_array_equal(*corner)
        self.assertEqual(drawn.faults, [])

    def test_lines_lie_over_each_other(self):
        first, second = self.two()
        drawn = Drawn(first, second, "--line", "1,3,0.05:3,3,0.05", "--var", "rho_CC",
                      "--difference")
        self.assertEqual([len(ax.lines) for ax in drawn.axes], [2, 2])
        x, values = drawn.axes[0].lines[0].get_data()
        np.testing.assert_allclose(values, np.where(x < RADIUS, 0.2, 1.2))

    def test_names_must_fit_the_archives(self):
        first, second = self.two()
        given = plot.parse([str(first), str(second), "--names", "one"])
        with self.assertRaisesRegex(ArchiveError, "1 names for 2 archives"):
            shots.gather(given)
        with self.assertRaisesRegex(ArchiveError, "--difference needs two"):
            shots.gather(plot.parse([str(first), "--difference"]))


class Texts(Scenes):
    """No label is clipped and none lies over another."""
    LONG = "A very long title of a deck that tells all about a bubble of helium in a box of air"

    def test_of_every_kind_of_picture(self):
        self.bubble(title=self.LONG, particles=True)
        for words in ([], ["--material", "helium"], ["--var", "temp_CC"], ["--var", "p.stress"],
                      ["--line", "1,2,0:3,4,0"], ["--radius"], ["--cmap", "schlieren"],
                      ["--contours", "5", "--arrows", "12", "--outline"],
                      ["--var", "p.stress.vonMises", "--var", "p.stress.xy"],
                      ["--var", "rho_CC", "--particles", "p.stress"], ["--size", "5x4"],
                      ["--history", "TotalMass"], ["--log", "--var", "rho_CC"]):
            self.assertEqual(Drawn(self.root, *words).faults, [], words)

    def test_every_axis_has_its_unit(self):
        self.tube()
        drawn = Drawn(self.root, "--var", "rho_CC")
        self.assertEqual(drawn.axes[0].get_xlabel(), "x  (m)")
        self.assertEqual(drawn.axes[0].get_ylabel(), "m/s")  # what this archive says of all labels

    def test_what_is_clipped_is_found(self):
        with style.pyplot() as plt:
            figure, axes = plt.subplots(1, 2, figsize=(4, 2))
            axes[0].set_title("far too long a title for such a narrow panel", loc="left")
            axes[1].set_title("right", loc="left")
            figure.text(0.99, 0.5, "outside")
            figure.canvas.draw()
            faults = style.misplaced_texts(figure)
        self.assertTrue(any("lies over" in fault for fault in faults))
        self.assertTrue(any("'outside' leaves" in fault for fault in faults))


class Faults(Scenes):
    def told(self, *words):
        error = io.StringIO()
        with contextlib.redirect_stderr(error), contextlib.redirect_stdout(io.StringIO()):
            try:
                status = plot.main([str(self.root), *words, "-o",
                                    str(self.root.parent / "x.png")])
            except SystemExit as ended:
                status = ended.code
        self.assertEqual(status, 2, words)
        self.assertEqual(error.getvalue().count("\n"), 1, error.getvalue())
        return error.getvalue()

    def test_each_is_told_in_one_line(self):
        self.bubble()
        for words, text in ((["--material", "heliun"], "did you mean 'helium'"),
                            (["--range", "3:1"], "LOW below HIGH"),
                            (["--range", "0:1", "--log"], "begins above zero"),
                            (["--cmap", "cividi"], "did you mean cividis"),
                            (["--cmap", "schlieren", "--var", "temp_CC"], "gradient of a density"),
                            (["--size", "0x3"], "inches"), (["--dpi", "big"], "20 to 1200"),
                            (["--line", "1,2:3,4"], "two points"),
                            (["--line", "1,2,0:3,4,0", "--radius"], "without"),
                            (["--contours", "many"], "number of lines"),
                            (["--arrows", "0"], "1 to 200"),
                            (["--history", "TotalMas"], "did you mean 'TotalMass'")):
            self.assertIn(text, self.told(*words))


class Movies(Scenes):
    def make(self, name, *words):
        output = self.root.parent / name
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            status = movie.main([str(self.root), "-o", str(output), "--var", "temp_CC", "--dpi",
                                 "50", *words])
        return status, output, said.getvalue()

    def test_a_gif_needs_no_other_program(self):
        from PIL import Image
        self.bubble()
        status, output, said = self.make("x.gif")
        self.assertEqual(status, 0, said)
        self.assertIn("frame 1 of 1", said)
        with Image.open(output) as image:
            self.assertEqual(image.n_frames, 1)

    def test_without_ffmpeg_an_mp4_is_refused_with_what_to_do(self):
        import unittest.mock
        self.bubble()
        with unittest.mock.patch.object(movie.shutil, "which", lambda _: None):
            status, output, said = self.make("x.mp4")
        self.assertEqual(status, 3)
        self.assertIn("apt-get install ffmpeg", said)
        self.assertFalse(output.exists())

    def test_frames_go_to_ffmpeg_through_a_pipe(self):
        """A stand-in for ffmpeg that keeps its words and counts the bytes that it gets."""
        import os
        import unittest.mock
        self.bubble()
        program = self.root.parent / "ffmpeg"
        program.write_text('#!/bin/sh\nfor last; do :; done\necho "$@" > "$last"\nwc -c >> "$last"\n')
        program.chmod(0o755)
        path = f"{program.parent}{os.pathsep}{os.environ['PATH']}"
        with unittest.mock.patch.dict(os.environ, {"PATH": path}):
            status, output, said = self.make("x.mp4", "--fps", "5")
        self.assertEqual(status, 0, said)
        words, count = output.read_text().splitlines()
        width, height = map(int, words.split("-s ")[1].split()[0].split("x"))
        self.assertEqual(int(count), 3 * width * height)
        self.assertIn("-r 5 ", words)
        self.assertEqual(pathlib.Path(words.split()[-1]), output)


if __name__ == "__main__":
    unittest.main()
