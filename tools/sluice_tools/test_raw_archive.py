"""Raw archives written here by the format's rules, and those of the public suite where they are.

SLUICE_PEER_ARCHIVES names the folder of shock.uda.000, disks.uda.000 and amr.uda.000.
"""
import os
import pathlib
import re
import tempfile
import unittest
import zlib

import numpy as np

from sluice_tools.archive import Archive, ArchiveError

CODES = {"double": "f8", "float": "f4", "long64": "i8", "Vector": "f8", "Point": "f8"}


def value_at(index, component):
    return index[0] + 64. * index[1] + 4096. * index[2] + 0.25 * component


def triple(values):
    return "[" + ", ".join(str(v) for v in values) + "]"


class Writer:
    """An archive of one step of 4 by 3 by 1 cells in two patches along x, with extra cells."""

    PATCHES = [((0, 0, 0), (2, 3, 1), (-1, -1, -1), (2, 4, 2)),
               ((2, 0, 0), (4, 3, 1), (2, -1, -1), (5, 4, 2))]

    def __init__(self, root, order="<", gzip=False):
        self.root, self.order, self.gzip = pathlib.Path(root), order, gzip
        (self.root / "t00001/l0").mkdir(parents=True)
        self.data, self.blocks, self.variables = b"", "", ""

    def block(self, kind, value, name, patch, numbers, more=""):
        numbers = np.array(numbers, dtype=self.order + CODES[value]).tobytes()
        if self.gzip:
            size = np.array(len(numbers), dtype=self.order + "u8").tobytes()
            numbers = size + zlib.compress(numbers)
            more += "<compression>gzip</compression>"
        self.data += b"\0" * (-len(self.data) % 1024)
        start = len(self.data)
        self.data += numbers
        self.blocks += (f'<Variable type="{kind}&lt;{value}&gt;"><variable>{name}</variable>'
                        f"<index>0</index><patch>{patch + 7}</patch>{more}<start>{start}</start>"
                        f"<end>{len(self.data)}</end><filename>p00000.data</filename></Variable>\n")

    def name(self, kind, value, name):
        self.variables += f'<variable type="{kind}&lt;{value}&gt;" name="{name}"/>'

    def add(self, kind, value, name, components=1):
        self.name(kind, value, name)
        for n, (_, _, low, high) in enumerate(self.PATCHES):
            # Faces along x close the second patch, which no other follows.
            high = (high[0] + (kind == "SFCXVariable" and n == 1), *high[1:])
            numbers = [value_at((i, j, k), c) for k in range(low[2], high[2])
                       for j in range(low[1], high[1]) for i in range(low[0], high[0])
                       for c in range(components)]
            self.block(kind, value, name, n, numbers)

    def add_particles(self, ids=True):
        self.name("ParticleVariable", "Point", "p.x")
        for n in range(2):
            self.block("ParticleVariable", "Point", "p.x", n,
                       [[2. * n + 0.5 * i, 1, 0] for i in range(n + 1)],
                       f"<numParticles>{n + 1}</numParticles>")
        if ids:
            self.name("ParticleVariable", "long64", "p.particleID")
            for n in range(2):
                self.block("ParticleVariable", "long64", "p.particleID", n,
                           [(40 << 48) + 3 - n - i for i in range(n + 1)],
                           f"<numParticles>{n + 1}</numParticles>")

    def close(self):
        patches = "".join(
            f"<Patch><id>{n + 7}</id><proc>0</proc><lowIndex>{triple(low)}</lowIndex><highIndex>"
            f"{triple(high)}</highIndex><interiorLowIndex>{triple(a)}</interiorLowIndex>"
            f"<interiorHighIndex>{triple(b)}</interiorHighIndex></Patch>"
            for n, (a, b, low, high) in enumerate(self.PATCHES))
        order = "little_endian" if self.order == "<" else "big_endian"
        (self.root / "t00001/timestep.xml").write_text(
            f"<Uintah_timestep><Meta><endianness>{order}</endianness></Meta><Grid><Level>"
            "<anchor>[1, 2, 0]</anchor><cellspacing>[0.25, 0.5, 1]</cellspacing>"
            f"{patches}</Level></Grid><Data><Datafile href='l0/p00000.xml'/></Data>"
            "</Uintah_timestep>")
        (self.root / "t00001/l0/p00000.xml").write_text(
            f"<Uintah_Output>{self.blocks}</Uintah_Output>")
        (self.root / "t00001/l0/p00000.data").write_bytes(self.data)
        (self.root / "index.xml").write_text(
            f"<Uintah_DataArchive><variables>{self.variables}</variables><timesteps>"
            '<timestep href="t00001/timestep.xml" time="0.5">1</timestep></timesteps>'
            "</Uintah_DataArchive>")


class OnDisk(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name) / "case.uda.000"


class Reading(OnDisk):
    def test_values_lie_where_their_indices_say(self):
        for order in "<>":
            for gzip in (False, True):
                with self.subTest(order=order, gzip=gzip):
                    writer = Writer(self.root / f"{ord(order)}{gzip}", order, gzip)
                    writer.add("CCVariable", "double", "press_CC")
                    writer.add("CCVariable", "float", "rho_CC")
                    writer.add("CCVariable", "Vector", "vel_CC", 3)
                    writer.add("SFCXVariable", "double", "uvel_FC")
                    writer.close()
                    self.check(Archive(writer.root).step())

    def check(self, step):
        i, j, k = np.meshgrid(range(4), range(3), range(1), indexing="ij")
        for name in ("press_CC", "rho_CC"):
            field = step.field(name)
            self.assertEqual(field.lower, (0, 0, 0))
            np.testing.assert_array_equal(field.values, value_at((i, j, k), 0))
        velocity = step.field("vel_CC").values
        for c in range(3):
            np.testing.assert_array_equal(velocity[c], value_at((i, j, k), c))
        faces = step.field("uvel_FC")
        i, j, k = np.meshgrid(range(5), range(3), range(1), indexing="ij")
        np.testing.assert_array_equal(faces.values, value_at((i, j, k), 0))
        np.testing.assert_allclose(faces.coordinates(0), 1 + 0.25 * np.arange(5))
        self.assertEqual(step.levels[0].active, (1, 1, 0))

    def test_particles_come_by_number_or_in_the_order_of_patches(self):
        for ids in (True, False):
            writer = Writer(self.root / str(ids))
            writer.add_particles(ids)
            writer.close()
            table = Archive(writer.root).step().particles()
            expected = [2.5, 2, 0] if ids else [0, 2, 2.5]
            np.testing.assert_array_equal(table["p.x"][:, 0], expected)
            if ids:  # beyond the whole numbers of a double
                self.assertEqual([int(n) - (40 << 48) for n in table["p.particleID"]], [1, 2, 3])

    def test_damage_is_named(self):
        writer = Writer(self.root, gzip=True)
        writer.add("CCVariable", "double", "press_CC")
        writer.close()
        data = self.root / "t00001/l0/p00000.data"
        bytes_there = data.read_bytes()
        data.write_bytes(bytes_there[:-9])
        with self.assertRaisesRegex(ArchiveError, "p00000.data"):
            Archive(self.root).step().field("press_CC")
        data.write_bytes(bytes_there[:12] + b"!!!!" + bytes_there[16:])
        with self.assertRaisesRegex(ArchiveError, "p00000.data"):
            Archive(self.root).step().field("press_CC")
        data.unlink()
        with self.assertRaisesRegex(ArchiveError, "p00000.data"):
            Archive(self.root).step().field("press_CC")


PEER = os.environ.get("SLUICE_PEER_ARCHIVES", "")


@unittest.skipUnless(PEER, "SLUICE_PEER_ARCHIVES is not set: the suite's archives are not read")
class OfTheSuite(unittest.TestCase):
    """Against what the suite's own tools have printed."""

    def test_a_line_of_the_shock_tube(self):
        rows = [line.split() for line in pathlib.Path(PEER, "shock_lineextract.txt").read_text()
                .splitlines() if re.match(r"\d+ 0 0 ", line)]
        values = Archive(f"{PEER}/shock.uda.000").step("#2").field("rho_CC").values[:, 0, 0]
        self.assertEqual([f"{v:.16e}" for v in values], [row[3] for row in rows])

    def test_stresses_of_the_disks(self):
        rows = [line.split() for line in pathlib.Path(PEER, "disks_puda.txt").read_text()
                .splitlines() if line.startswith("5.01038208e-02 ")]
        self.assertGreater(len(rows), 30)
        stress = Archive(f"{PEER}/disks.uda.000").step("#2").particles()["p.stress"]
        for row, tensor in zip(rows, stress):
            self.assertEqual([f"{v:.8e}" for v in tensor], row[3:])


if __name__ == "__main__":
    unittest.main()
