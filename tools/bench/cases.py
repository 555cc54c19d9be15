"""What ./dev bench measures: whole runs of decks, with the figure that each may cost at most.

A run case gives nanoseconds per cell and step as `sluice run --json` reports it; no block sleeps
unless `savings` is true. A ratio case divides two other cases. Limits are for a quiet machine of
the kind named in recorded.json.
Decks of the format's public suite are measured
where SLUICE_DECKS names its folder.
"""
import dataclasses
import os


FOREVER = ("Time/maxTime=1e9", "Time/end_at_max_time_exactly=false")  # the step count ends it


@dataclasses.dataclass(frozen=True)
class Run:
    name: str
    deck: str
    steps: int  # 0: to the end of the deck
    resolution: str = ""  # replaces the deck's, "[i,j,k]"
    limit: float | None = None  # nanoseconds per cell and step
    savings: bool = False
    threads: int = 1
    ranks: int = 1
    settings: tuple[str, ...] = FOREVER  # further --set PATH=VALUE
    unit: str = "ns/cell/step"  # or "ms": wall time of the whole process; shares: see measure.py
    long: bool = False  # takes minutes: only with --long, and once
    by_name: bool = False  # what cannot be run yet: only where a pattern of the command asks for it


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
    """A program of its own that ends its line with "UNIT N"."""
    name: str
    program: str
    limit: float | None = None
    unit: str = "ratio"
    arguments: tuple[str, ...] = ()
    ranks: int = 1


TUBE = "inputs/ice/shock_tube.ups"
BLAST_2D = "inputs/ice/blast_2d.ups"
BLAST_3D = "inputs/ice/blast_3d.ups"
MIXED_GASES = "inputs/ice/mixed_gases.ups"
BUBBLE = "inputs/ice/bubble_among_waves.ups"
MIXED_BALL = "inputs/ice/mixed_ball_among_waves.ups"
PIECES = "MaterialProperties/ICE/material[{}]/geom_object[{}]/{}/radius=1e-9"
# The same flows of one gas: a bubble and a ball so small that no cell meets them.
NO_BUBBLE = FOREVER + tuple(
    PIECES.format(m, g, f"{of}{hole}sphere") for m, hole in ((1, "difference/"), (2, ""))
    for g, of in ((1, "difference/"), (2, "intersection/")))
NO_BALL = FOREVER + tuple(
    PIECES.format(m, g + n, f"{of}{hole}sphere")
    for m, n, hole in ((1, 0, "difference/"), (1, 2, ""), (2, 0, ""))
    for g, of in ((1, "difference/"), (2, "intersection/")))
# Three materials of which two are outside of the tube, and the third in a deck of its own; what
# accelerates them keeps blocks awake.
THREE = "inputs/ice/three_in_a_row.ups"
EVERYWHERE = FOREVER + (
    "PhysicalConstants/gravity=[1e-3,0,0]", "CFD/ICE/applyHydrostaticPressure=false",
    "MaterialProperties/ICE/material[3]/geom_object[2]/box/min=[-9,-9,-9]",
    "MaterialProperties/ICE/material[3]/geom_object[2]/box/max=[9,9,9]",
    "MaterialProperties/ICE/material[3]/geom_object[3]=",
    "MaterialProperties/ICE/material[3]/geom_object[1]=")
TWO_ABSENT = EVERYWHERE + tuple(
    f"MaterialProperties/ICE/material[{m}]/geom_object/box/{corner}" for m in (1, 2)
    for corner in ("min=[20,20,20]", "max=[21,21,21]"))
ALONE = EVERYWHERE + ("MaterialProperties/ICE/material[2]=", "MaterialProperties/ICE/material[1]=",
                      "MaterialProperties/exchange_properties=")

# All sides of a cube open (LODI), and the same cube between planes of symmetry.
OPEN_CUBE = "inputs/ice/pulse_leaving_cube.ups"
CLOSED = FOREVER + tuple(
    f"Grid/BoundaryConditions/Face[{n}]/BCType[{of}" for n in range(1, 7)
    for of in ("4]=", "3]=", "2]=", "1]/@id=all", "1]/@label=Symmetric", "1]/@var=symmetry"))

# On levels a cell and step is a cell update: regrids, ghost cells and matching are all in it.
LEVELS_TUBE = "inputs/ice/amr_shock_tube.ups"
LEVELS_EXPLOSION = "inputs/ice/amr_explosion.ups"
LEVELS_SQUARE = "inputs/ice/amr_riemann_2d.ups"
# The ratios, tiles and thresholds of a widespread deck: all that is disturbed is refined.
WIDE = ("Grid/Level/Box/resolution=[32,32,1]", "AMR/Regridder/cell_refinement_ratio=[[4,4,1]]",
        "AMR/ICE/Refinement_Criteria_Thresholds/Variable[1]/@value=0.01",
        "AMR/ICE/Refinement_Criteria_Thresholds/Variable[2]/@value=0.01")
UNIFORM = ("AMR/Regridder/max_levels=1",)
# A quarter of an explosion (with the bits of the whole) by the estimated error. As many cells as
# give the L1 error of the density of the uniform grid beside it (docs/theory/measured_levels.md).
ERROR_EXPLOSION = "inputs/ice/amr_explosion_quarter.ups"
FINER = ("AMR/ErrorEstimate/@tolerance=0.012",)

# Vortices at Mach 0.01 with and without a pressure solve, which takes steps 40 times as long.
VORTICES = "inputs/ice/taylor_green.ups"
VORTICES_3D = "inputs/ice/taylor_green_3d.ups"
SLOW = FOREVER + ("MaterialProperties/ICE/material/dynamic_viscosity=0",)
SLOW_3D = SLOW + ("PhysicalConstants/reference_pressure=7142.857142857143",
                  "MaterialProperties/ICE/material/geom_object/pressure=7142.857142857143",
                  "MaterialProperties/ICE/material/geom_object/temperature=17857.142857142855",
                  "CFD/ICE/customInitialization/formula/pressure="
                  "7142.857142857143 + (cos(2*x)+cos(2*y))*(cos(2*z)+2)/16")
SOLVED = ("CFD/ICE/TimeStepControl/knob_for_speedSound=0",
          "CFD/ICE/ImplicitSolver/max_outer_iterations=1",
          "CFD/ICE/ImplicitSolver/outer_iteration_tolerance=1e-6",
          "CFD/ICE/ImplicitSolver/Parameters/tolerance=1e-2")

CASES = [
    Run("1-D, 4096 cells", TUBE, 4000, "[4096,1,1]", 30),
    Run("1-D, 256 cells", TUBE, 20000, "[256,1,1]", 60),
    Run("2-D, 512^2", BLAST_2D, 60, "[512,512,1]", 110),
    Run("3-D, 96^3", BLAST_3D, 15, "[96,96,96]", 190),
    Run("3-D, 64^3, open all around", OPEN_CUBE, 20, "[64,64,64]"),
    Run("3-D, 64^3, closed all around", OPEN_CUBE, 20, "[64,64,64]", settings=CLOSED),
    Ratio("open cube over closed cube", "3-D, 64^3, open all around",
          "3-D, 64^3, closed all around", 1.4),
    Run("1-D, 4096 cells, savings on", TUBE, 4000, "[4096,1,1]", savings=True),
    Run("3-D, 96^3, 2 threads", BLAST_3D, 15, "[96,96,96]", threads=2),
    Run("3-D, 96^3, 2 ranks", BLAST_3D, 15, "[96,96,96]", ranks=2),
    Run("start to first step", TUBE, 1, limit=50, savings=True, unit="ms"),
    Ratio("speed-up of 2 threads", "3-D, 96^3", "3-D, 96^3, 2 threads", 1.85, at_least=True),
    Ratio("speed-up of 2 ranks", "3-D, 96^3", "3-D, 96^3, 2 ranks", 1.85, at_least=True),
    Run("2-D, 512^2, two gases in every cell", MIXED_GASES, 20, "[512,512,1]"),
    Ratio("two gases over one", "2-D, 512^2, two gases in every cell", "2-D, 512^2", 2.5),
    Run("2-D, 512^2, two gases in 5 % of the cells", MIXED_BALL, 60, "[512,512,1]", savings=True),
    Run("2-D, 512^2, two gases in no cell", MIXED_BALL, 60, "[512,512,1]", savings=True,
        settings=NO_BALL),
    Ratio("two gases in 5 % of the cells over one", "2-D, 512^2, two gases in 5 % of the cells",
          "2-D, 512^2, two gases in no cell", 1.3),
    Run("1-D, 16384 cells, two of three absent", THREE, 800, "[16384,1,1]", savings=True,
        settings=TWO_ABSENT),
    Run("1-D, 16384 cells, the third alone", THREE, 800, "[16384,1,1]", savings=True,
        settings=ALONE),
    Ratio("two of three absent over the third alone", "1-D, 16384 cells, two of three absent",
          "1-D, 16384 cells, the third alone", 1.05),
    # Of the cells .5 to 1.6 % hold both gases, but three rows of five cross the edge twice.
    Run("2-D, 256^2, a bubble", BUBBLE, 150, "[256,256,1]", savings=True),
    Run("2-D, 256^2, no bubble", BUBBLE, 150, "[256,256,1]", savings=True, settings=NO_BUBBLE),
    Ratio("two gases at an interface over one", "2-D, 256^2, a bubble", "2-D, 256^2, no bubble",
          1.3),
    Run("levels: shock tube, 50 to 800", LEVELS_TUBE, 0, limit=200, savings=True, settings=()),
    Run("levels: explosion, 64^2 to 256^2", LEVELS_EXPLOSION, 0, limit=200, savings=True,
        settings=()),
    Run("levels: explosion, 32^2 to 512^2", LEVELS_EXPLOSION, 0, limit=200, savings=True,
        settings=WIDE),
    Run("explosion, 512^2 uniform", LEVELS_EXPLOSION, 0, "[512,512,1]", savings=True,
        settings=UNIFORM),
    # What sleeps on the uniform grid costs it nothing, the more the finer it is: an update of a
    # cell is compared with an update, and beside it with all cells of the uniform grid.
    Run("explosion, 512^2 uniform, cells updated", LEVELS_EXPLOSION, 0, "[512,512,1]",
        savings=True, unit="ns/cell updated", settings=UNIFORM),
    Ratio("levels over uniform, per cell updated", "levels: explosion, 32^2 to 512^2",
          "explosion, 512^2 uniform, cells updated", 1.25),
    Ratio("levels over uniform, asleep or not", "levels: explosion, 32^2 to 512^2",
          "explosion, 512^2 uniform"),
    Run("a quarter of 1024^2 by error", ERROR_EXPLOSION, 0, "[124,124,1]", savings=True, unit="ms",
        settings=()),
    Run("a quarter of 1024^2 uniform", ERROR_EXPLOSION, 0, "[512,512,1]", savings=True, unit="ms",
        settings=UNIFORM),
    Ratio("by error over uniform, equal error, 1024^2", "a quarter of 1024^2 by error",
          "a quarter of 1024^2 uniform", 0.15),
    # Bands are as many cells wide on every grid: levels gain more where grids are finer.
    Run("a quarter of 4096^2 by error", ERROR_EXPLOSION, 0, "[464,464,1]", savings=True, unit="ms",
        settings=FINER, long=True),
    Run("a quarter of 4096^2 uniform", ERROR_EXPLOSION, 0, "[2048,2048,1]", savings=True, unit="ms",
        settings=UNIFORM, long=True),
    Ratio("by error over uniform, equal error, 4096^2", "a quarter of 4096^2 by error",
          "a quarter of 4096^2 uniform", 0.15),
    Run("levels: 2-D Riemann problem, 64^2 to 256^2", LEVELS_SQUARE, 0, limit=200, savings=True,
        settings=()),
    Run("levels: share of regrids", LEVELS_EXPLOSION, 0, limit=0.03, savings=True, settings=WIDE,
        unit="share of regrids"),
    Run("levels: share of regrids, 2-D Riemann problem", LEVELS_SQUARE, 0, limit=0.03, savings=True,
        settings=(), unit="share of regrids"),
    Run("levels: coarse steps that a regrid costs", LEVELS_SQUARE, 0, limit=1, savings=True,
        settings=(), unit="steps a regrid"),
    Run("levels: share of load balance, 2 ranks", LEVELS_SQUARE, 0, limit=0.1, savings=True,
        settings=(), ranks=2, unit="share of balance"),
    Run("levels: explosion, 2 ranks", LEVELS_EXPLOSION, 0, savings=True, settings=WIDE, ranks=2),
    Ratio("levels: speed-up of 2 ranks", "levels: explosion, 32^2 to 512^2",
          "levels: explosion, 2 ranks", 1.8, at_least=True),
    Program("1 GiB archive over a plain write", "sluice_archive_bench", 1.3),
    # A mixed cell each.
    Program("one pressure, two ideal gases", "sluice_equilibration_bench", 90, "ns", ("gases",)),
    Program("one pressure, liquid and gas", "sluice_equilibration_bench", 90, "ns", ("liquid",)),
    Program("one pressure, JWL and gas", "sluice_equilibration_bench", 400, "ns", ("jwl",)),
    # An unknown each, to 1e-8, set-up included; hypre's choices beside ours.
    Program("solve, 128^3", "sluice_solve_bench", 1250, "ns", ("CGSolver", "128")),
    Program("solve, 128^3, 40 balls 1:1e4", "sluice_solve_bench", 1250, "ns",
            ("CGSolver", "128", "40")),
    Program("solve, 64^3, aspect 100, 40 balls", "sluice_solve_bench", None, "ns",
            ("CGSolver", "64", "40", "100")),
    Program("solve, 128^3, hypre CG+PFMG", "sluice_solve_bench", None, "ns", ("cg+pfmg", "128")),
    Program("solve, 64^3, hypre CG+SMG", "sluice_solve_bench", None, "ns", ("cg+smg", "64")),
    Program("solve, 64^3, hypre AMG", "sluice_solve_bench", None, "ns", ("amg", "64")),
    Program("solve, 64^3", "sluice_solve_bench", None, "ns", ("CGSolver", "64")),
    Program("solve, 128 x 64 x 64, 2 ranks", "sluice_solve_bench", None, "ns",
            ("CGSolver", "128x64x64"), ranks=2),
    Ratio("solve: unknowns a second of 2 ranks over one", "solve, 64^3",
          "solve, 128 x 64 x 64, 2 ranks", 1.6, at_least=True),
    Run("2-D, 256^2, explicit step at Mach 0.01", VORTICES, 60, "[256,256,1]", settings=SLOW),
    Run("2-D, 256^2, pressure solve at Mach 0.01", VORTICES, 30, "[256,256,1]",
        settings=SLOW + SOLVED),
    Ratio("pressure solve over explicit step, 256^2", "2-D, 256^2, pressure solve at Mach 0.01",
          "2-D, 256^2, explicit step at Mach 0.01", 5),
    Run("3-D, 64^3, explicit step at Mach 0.01", VORTICES_3D, 20, "[64,64,64]", settings=SLOW_3D),
    Run("3-D, 64^3, pressure solve at Mach 0.01", VORTICES_3D, 10, "[64,64,64]",
        settings=SLOW_3D + SOLVED),
    Ratio("pressure solve over explicit step, 64^3", "3-D, 64^3, pressure solve at Mach 0.01",
          "3-D, 64^3, explicit step at Mach 0.01", 5),
    # A particle each, to the grid and back, without law and output.
    Program("transfers of solids, 3-D, linear", "sluice_transfer_bench", None, "ns", ("linear",)),
    Program("transfers of solids, 3-D, GIMP", "sluice_transfer_bench", None, "ns", ("gimp",)),
    Program("transfers of solids, 3-D, GIMP of own widths", "sluice_transfer_bench", None, "ns",
            ("gimp_own",)),
    Program("transfers of solids, 3-D, cubic", "sluice_transfer_bench", None, "ns", ("cubic",)),
    Program("transfers of solids, 3-D, CPDI", "sluice_transfer_bench", None, "ns", ("cpdi",)),
    Program("transfers of solids, 3-D, quadratic, APIC", "sluice_transfer_bench", None, "ns",
            ("quadratic", "3", "apic")),
    Program("transfers of solids, 2-D, GIMP", "sluice_transfer_bench", None, "ns", ("gimp", "2")),
    Ratio("share left by the quiet half", "1-D, 4096 cells, savings on", "1-D, 4096 cells"),
]

# Solids and fluid with solids (inputs/bench): a particle and step, or a cell and step.
FOAM_BALL = "inputs/bench/foam_ball.ups"
FOAM_DISK = "inputs/mpmice/shock_over_foam.ups"
TWO_BALLS = "inputs/bench/two_balls.ups"
TWO_DISKS = "inputs/bench/two_disks.ups"
SOLID_BLOCK = "inputs/bench/solid_block.ups"
CORNER = "inputs/bench/block_in_corner.ups"
IMPLICIT = "inputs/bench/implicit_cube.ups"
SECOND = "MaterialProperties/MPM/material/geom_object[2]/"
FAR_BALLS = (SECOND + "sphere/origin=[0.875,0.875,0.875]",)
FAR_DISKS = (SECOND + "cylinder/bottom=[0.8984375,0.8984375,-1]",
             SECOND + "cylinder/top=[0.8984375,0.8984375,1]")
PARTICLE, MEMORY = "ns/particle/step", "MiB"
COLLECTIVES, BYTES, SENT = "collectives/step", "kB of collectives/step", "kB sent/step"


def apart(name, deck, steps, settings):
    """Two bodies side by side and in opposite corners: time, memory and their ratios."""
    near, far = f"{name} side by side", f"{name} in opposite corners"
    cases = []
    for unit, what in (("ns/cell/step", ""), (MEMORY, ", memory")):
        cases += [Run(near + what, deck, steps, settings=(), unit=unit),
                  Run(far + what, deck, steps, settings=settings, unit=unit),
                  Ratio(f"{name}: corners over side by side{what}", far + what, near + what)]
    return cases


def counted(name, deck, steps, resolution=""):
    """What two ranks call and send in a step."""
    return [Run(f"{name}, 2 ranks: {unit}", deck, steps, resolution, savings=True, settings=(),
                ranks=2, unit=unit) for unit in (COLLECTIVES, BYTES, SENT)]


CASES += [
    Run("foam ball, 64^3", FOAM_BALL, 10, settings=()),
    Run("foam ball, 64^3, 2 ranks", FOAM_BALL, 10, settings=(), ranks=2),
    Run("foam ball, 64^3, 2 threads", FOAM_BALL, 10, settings=(), threads=2),
    Ratio("foam ball: one core over 2 ranks", "foam ball, 64^3", "foam ball, 64^3, 2 ranks"),
    Ratio("foam ball: one core over 2 threads", "foam ball, 64^3", "foam ball, 64^3, 2 threads"),
    Run("foam disk, 320^2", FOAM_DISK, 40, "[320,320,1]", settings=()),
    *counted("foam ball, 64^3", FOAM_BALL, 5),
    *counted("foam disk, 320^2", FOAM_DISK, 10, "[320,320,1]"),
    *apart("two balls in 96^3", TWO_BALLS, 10, FAR_BALLS),
    *apart("two disks in 512^2", TWO_DISKS, 20, FAR_DISKS),
    Run("block of particles, GIMP", SOLID_BLOCK, 40, settings=(), unit=PARTICLE),
    Run("block of particles, linear", SOLID_BLOCK, 40, settings=("MPM/interpolator=linear",),
        unit=PARTICLE),
    Run("block of particles, CPDI", SOLID_BLOCK, 20, settings=("MPM/interpolator=cpdi",),
        unit=PARTICLE),
    Run("block in a corner of 64 boxes", CORNER, 100, settings=(), unit=PARTICLE),
    Run("block in a corner of 64 boxes, 2 ranks", CORNER, 100, settings=(), ranks=2,
        unit=PARTICLE),
    Ratio("block in a corner: one rank over 2", "block in a corner of 64 boxes",
          "block in a corner of 64 boxes, 2 ranks"),
    *counted("block in a corner of 64 boxes", CORNER, 50),
    Run("implicit cube, 8,000 particles", IMPLICIT, 2, settings=(), unit=PARTICLE),
    Run("implicit cube, 8,000 particles, static", IMPLICIT, 1, settings=("MPM/dynamic=false",),
        unit=PARTICLE),
    Run("implicit cube, 32,768 particles, linear", IMPLICIT, 2, "[32,32,32]",
        settings=("MPM/interpolator=linear",), unit=PARTICLE),
    Run("implicit cube, 97,336 particles", IMPLICIT, 2, "[46,46,46]", settings=(), unit=PARTICLE),
    Run("implicit cube, 97,336 particles, static", IMPLICIT, 1, "[46,46,46]",
        settings=("MPM/dynamic=false",), unit=PARTICLE),
]

SUITE = os.environ.get("SLUICE_DECKS")
if SUITE:
    COUPLED = f"{SUITE}/inputs/UintahRelease/MPMICE"
    CASES += [
        Run("impHotBlob, 400 steps", f"{SUITE}/inputs/ICE/impHotBlob.ups", 400, limit=2600,
            savings=True, unit="ms"),
        Run("CouettePoiseuille/XY", f"{SUITE}/inputs/ICE/CouettePoiseuille/XY.ups", 400,
            limit=1000),
        Run("cavityFlow_dx", f"{SUITE}/inputs/ICE/cavityFlow_dx.ups", 400, limit=1000),
        # Fluid and solids; limits: shares of what the format's reference code takes.
        Run("Mach2wedge", f"{COUPLED}/Mach2wedge.ups", 100, limit=309, savings=True, settings=()),
        Run("guni2dRT, 204^2", f"{COUPLED}/guni2dRT.ups", 20, "[204,204,1]", limit=2067,
            savings=True, settings=()),
        Run("cylinderCrossFlow", f"{COUPLED}/cylinderCrossFlow.ups", 20, limit=1094, savings=True,
            settings=()),
        Run("advect, solid and gases", f"{SUITE}/inputs/MPMICE/advect.ups", 100, limit=196,
            savings=True, settings=()),
        Run("advect without tracers", f"{SUITE}/inputs/MPMICE/advect.ups", 40, savings=True,
            settings=("Models/Model[3]=",)),
        Run("explode2D_amr", f"{SUITE}/inputs/MPMICE/explode2D_amr.ups", 10, limit=5890,
            savings=True, settings=()),
        Run("taylorImpact", f"{SUITE}/inputs/UintahRelease/MPM/taylorImpact.ups", 100, limit=900,
            savings=True, settings=(), unit="ns/particle/step"),
    ]
