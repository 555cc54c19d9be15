"""The heads of the pages that suite_decks.py writes."""
from suite_limits import (FEW_STEPS, LARGEST_DRIFT, LARGEST_GROWTH, MOST_CELLS,
                          MOST_CELLS_OF_SOLIDS, MOST_COARSE_STEPS, MOST_STEPS, QUICK_STEPS)

AMR_HEAD = f"""# Decks with levels

Every deck of the format's public suite that has `<AMR>` or several `<Level>`s, and its state. This
page is written by `tools/verify/suite_decks.py amr`, which finds the suite through the variable
`SLUICE_DECKS`; `./dev verify pages` checks that it holds. The decks are taken as they stand, for at
most {MOST_COARSE_STEPS} coarse steps. Of those that do not run the first thing that is missing is
told, as `sluice check` or the start of the run says it.

"""

ICE_HEAD = f"""# Decks of the fluid

Every deck of the folder `inputs/ICE` of the format's public suite, and its state. This page is
written by `tools/verify/suite_decks.py ice`, which finds the suite through the variable
`SLUICE_DECKS`; `./dev verify pages` checks every row, the test `tools.ice_decks` runs some steps of
a deck of each kind. Decks run coarsened to seconds: at most {MOST_STEPS} steps, and a grid of one
box of more than {MOST_CELLS:,} cells by a smaller `resolution`; the last step is saved. A deck runs
when it ends in good order; all totals and all values of its last output are finite, densities,
temperatures and volumes not negative, volume fractions at most 1; density, temperature and pressure
are at most {LARGEST_GROWTH:g} times their largest in the first output; mass of each material,
momentum and total energy are conserved to {LARGEST_DRIFT:g}, what passed the boundary counted. That
says nothing of accuracy: see [theory_ice.md](theory_ice.md). Of the others the first thing that is
missing is told, as `sluice check` or the start of the run says it.

"""


MPM_HEAD = f"""# Decks of solids

Every deck of the folders `inputs/MPM` and `inputs/UintahRelease/MPM` of the format's public suite,
and its state. This page is written by `tools/verify/suite_decks.py mpm`, which finds the suite
through the variable `SLUICE_DECKS`; `./dev verify pages` checks every row. Decks run for
{FEW_STEPS} steps, a grid of one box of more than {MOST_CELLS_OF_SOLIDS:,} cells by a smaller
`resolution`; the last step is saved. A deck runs when it ends in good order, all totals and all
values of its last output are finite, volumes and masses of particles are positive, and the mass of
each material is conserved to {LARGEST_DRIFT:g}. That says nothing of accuracy. Of the others the
first thing that is missing is told, as `sluice check` or the start of the run says it.

"""

IMPM_HEAD = f"""# Decks of implicit steps

Every deck of the folders `inputs/IMPM` and `inputs/UintahRelease/IMPM` of the format's public
suite, and its state. This page is written by `tools/verify/suite_decks.py impm`, which finds the
suite through the variable `SLUICE_DECKS`; `./dev verify pages` checks every row. Decks run for
{FEW_STEPS} steps, a grid of one box of more than {MOST_CELLS_OF_SOLIDS:,} cells by a smaller
`resolution`; the last step is saved. A deck runs when it ends in good order, all totals and all
values of its last output are finite, volumes and masses of particles are positive, and the mass of
each material is conserved to {LARGEST_DRIFT:g}. That says nothing of accuracy. Of the others the
first thing that is missing is told, as `sluice check` or the start of the run says it.

"""


MPMICE_HEAD = f"""# Decks of fluid and solids

Every deck of the format's public suite whose component is `mpmice` or one of its kin, and its
state. This page is written by `tools/verify/suite_decks.py mpmice`, which finds the suite through
the variable `SLUICE_DECKS`; `./dev verify pages` checks every row. Decks run for {FEW_STEPS} steps,
a grid of one box of more than {MOST_CELLS_OF_SOLIDS:,} cells by a smaller `resolution`; the last
step is saved. A deck runs when it ends in good order, all totals and all values of its last output
are finite, volumes and masses of particles are positive, and the mass of each material is conserved
to {LARGEST_DRIFT:g}, what passed from one to another aside. That says nothing of accuracy. Of the
others the first thing that is missing is told, as `sluice check` or the start of the run says it.

"""


SUITE_HEAD = f"""# The public suite

Every deck of the format's public suite, and its state: accepted by `sluice check` or not, and how
far it runs. This page is written by `tools/verify/suite_decks.py suite`, which finds the suite
through the variable `SLUICE_DECKS`; `./dev verify pages` checks every row. Decks that stand on
the page of a kind (fluids, solids, both, implicit steps, levels) have the state told there; the
others run for {QUICK_STEPS} steps. Of those that are not accepted the first fault is told.

"""

VAANGO_HEAD = f"""# Decks of Vaango's suite

Every deck of Vaango's suite (June 2025) that is not among those of the format's public suite, and
its state: accepted by `sluice check` or not, and how far it runs. This page is written by
`tools/verify/suite_decks.py vaango`, which finds the suite through the variable
`SLUICE_VAANGO_DECKS`; `./dev verify pages` checks every row. Accepted decks run for {QUICK_STEPS}
steps, a grid of one box of more than {MOST_CELLS_OF_SOLIDS:,} cells by a smaller `resolution`. That
says nothing of accuracy. Of those that are not accepted the first fault is told; files that the
suite itself lacks are such faults.

"""
