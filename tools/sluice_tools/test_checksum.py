"""Tests of the checksum: RFC 3720's examples, lengths beside powers of 2, rows, speed."""
import unittest

import numpy as np

from sluice_tools.checksum import crc32c, crc32c_rows


def by_bits(data):
    """The definition, bit by bit."""
    value = 0xFFFFFFFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ (0x82F63B78 if value & 1 else 0)
    return value ^ 0xFFFFFFFF


class Checksum(unittest.TestCase):
    def test_examples_of_the_standard(self):
        # RFC 3720, section B.4.
        for data, expected in ((bytes(32), 0x8A9136AA), (b"\xff" * 32, 0x62A8AB43),
                               (bytes(range(32)), 0x46DD794E),
                               (bytes(range(31, -1, -1)), 0x113FDB5C),
                               (b"123456789", 0xE3069283), (b"", 0)):
            self.assertEqual(crc32c(data), expected)

    def test_every_length(self):
        data = np.random.default_rng(3).integers(0, 256, 5000, dtype=np.uint8)
        for size in (*range(1, 20), 63, 64, 65, 127, 128, 129, 255, 257, 1023, 4097, 5000):
            self.assertEqual(crc32c(data[:size]), by_bits(data[:size].tolist()), size)

    def test_rows_are_as_each_alone(self):
        rows = np.random.default_rng(4).integers(0, 256, (7, 333), dtype=np.uint8)
        self.assertEqual([int(s) for s in crc32c_rows(rows)], [crc32c(row) for row in rows])

    def test_one_bit_changes_it(self):
        data = bytearray(1000)
        before = crc32c(bytes(data))
        data[777] ^= 16
        self.assertNotEqual(crc32c(bytes(data)), before)


if __name__ == "__main__":
    unittest.main()
