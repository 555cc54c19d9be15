"""What ./dev bench measures: whole runs of decks, with the figure that each may cost at most.

A run case gives nanoseconds per cell and step as `sluice run --json` reports it, all savings off
unless `savings` is true. A ratio case divides two other cases. Limits are for a quiet machine of
the kind named in recorded.json.
"""
import dataclasses


FOREVER = ("Time/maxTime=1e9", "Time/end_at_max_time_exactly=false")  # the step count ends it


@dataclasses.dataclass(frozen=True)
class Run:
    name: str
    deck: str
    steps: int
    resolution: str = ""  # replaces the deck's, "[i,j,k]"
    limit: float | None = None  # nanoseconds per cell and step
    savings: bool = False
    threads: int = 1
    ranks: int = 1
    settings: tuple[str, ...] = FOREVER  # further --set PATH=VALUE
    unit: str = "ns/cell/step"  # or "ms": wall time of the whole process


@dataclasses.dataclass(frozen=True)
class Ratio:
    name: str
    above: str
    below: str
    limit: float | None = None
    at_least: bool = False  # the limit is a lower one

    unit = "ratio"


@dataclasses.dataclass(frozen=True)
class Program:
    """A program of its own that ends its line with "ratio N"."""
    name: str
    program: str
    limit: float | None = None

    unit = "ratio"


TUBE = "inputs/ice/shock_tube.ups"
BLAST_2D = "inputs/ice/blast_2d.ups"
BLAST_3D = "inputs/ice/blast_3d.ups"

CASES = [
    Run("1-D, 4096 cells", TUBE, 4000, "[4096,1,1]", 30),
    Run("1-D, 256 cells", TUBE, 20000, "[256,1,1]", 60),
    Run("2-D, 512^2", BLAST_2D, 60, "[512,512,1]", 110),
    Run("3-D, 96^3", BLAST_3D, 15, "[96,96,96]", 190),
    Run("1-D, 4096 cells, savings on", TUBE, 4000, "[4096,1,1]", savings=True),
    Run("3-D, 96^3, 2 threads", BLAST_3D, 15, "[96,96,96]", threads=2),
    Run("3-D, 96^3, 2 ranks", BLAST_3D, 15, "[96,96,96]", ranks=2),
    Run("start to first step", TUBE, 1, limit=50, savings=True, unit="ms"),
    Ratio("speed-up of 2 threads", "3-D, 96^3", "3-D, 96^3, 2 threads", 1.85, at_least=True),
    Ratio("speed-up of 2 ranks", "3-D, 96^3", "3-D, 96^3, 2 ranks", 1.85, at_least=True),
    Program("1 GiB archive over a plain write", "sluice_archive_bench", 1.3),
    Ratio("share left by the quiet half", "1-D, 4096 cells, savings on", "1-D, 4096 cells"),
]
