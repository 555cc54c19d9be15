"""Commands are found on pages, run in one shell, and compared with what is recorded."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import commands  # noqa: E402

PAGE = """# A page
```
sluice run a.ups      what it does
                      in two lines
./dev build
M=a/b
ls \\
  -l $M
```
```xml
<sluice/>
```
```sh
sluice export UDA
```
```
a table of numbers
```
"""


class Commands(unittest.TestCase):
    def test_lines_of_programs_are_taken_and_others_counted(self):
        found, left = commands.commands_of(PAGE)
        self.assertEqual(found[:3], ["sluice run a.ups", "M=a/b", "ls -l $M"])
        self.assertEqual(left, 2)  # ./dev, and a line that names no archive

    def test_one_shell_goes_on(self):
        with tempfile.TemporaryDirectory() as folder:
            shell = commands.Shell("/bin/true", pathlib.Path(folder))
            self.assertEqual(shell.run("M=some/where"), (0, ""))
            self.assertEqual(shell.run('[[ $M == some/where ]]'), (0, ""))
            self.assertEqual(shell.run(f"echo {folder}/x; exit 3"), (3, "{}/x"))

    def test_what_is_recorded_is_one_entry(self):
        self.assertEqual(commands.entry_of("ls", 2, "no such"), "$ ls\n= 2\n| no such\n")
        self.assertEqual(commands.entry_of("ls", 0, ""), "$ ls\n= 0\n")


if __name__ == "__main__":
    unittest.main()
