"""Tests of what ./dev verify vectors reads from sources and from the compiler's report."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import vectors  # noqa: E402

SOURCE = """void f() {
#pragma GCC ivdep
  // why
  for (int i = 0; i < n; ++i) a[i] = b[i];
  for (int i = 0; i < n; ++i) c[i] = b[i];
}
"""
REPORT = """../../src/f.cpp:4:21: optimized: loop vectorized using 64 byte vectors
../../src/f.cpp:4:21: optimized:  loop vectorized using 16 byte vectors
../../src/f.cpp:4:21: missed: couldn't vectorize loop
../../src/f.cpp:4:21: optimized: loop vectorized using 64 byte vectors
../../src/f.cpp:9:3: optimized: basic block part vectorized using 32 byte vectors
"""


class Vectors(unittest.TestCase):
    def test_finds_the_loop_below_a_mark(self):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder) / "f.cpp"
            source.write_text(SOURCE)
            self.assertEqual(vectors.marked_loops([source]), {(str(source), 4)})

    def test_reads_the_widest_vectors_of_each_instance_of_a_loop(self):
        self.assertEqual(vectors.loops_of(REPORT, "/build/release"),
                         {("/src/f.cpp", 4): [64, 0, 64]})


if __name__ == "__main__":
    unittest.main()
