"""The heads of the pages that suite_decks.py writes."""
from suite_limits import (FEW_STEPS, LARGEST_DRIFT, LARGEST_GROWTH, MOST_CELLS,
                          MOST_CELLS_OF_SOLIDS, MOST_COARSE_STEPS, MOST_STEPS, QUICK_STEPS)

AMR_HEAD = f"""# Decks with levels

This page lists the state of every deck of the format's public suite that has `<AMR>` or several
`<Level>`s. It is written by `tools/verify/suite_decks.py amr`, which finds the suite through the
variable `SLUICE_DECKS`; `./dev verify pages` checks it. The decks run unchanged, for at most
{MOST_COARSE_STEPS} coarse steps. For decks that do not run the page gives the first missing
feature, as reported by `sluice check` or at the start of the run.

"""

ICE_HEAD = f"""# Decks of the fluid

This page lists the state of every deck of the folder `inputs/ICE` of the format's public suite.
It is written by `tools/verify/suite_decks.py ice`, which finds the suite through the variable
`SLUICE_DECKS`; `./dev verify pages` checks every row, and the test `tools.ice_decks` runs some
steps of a deck of each kind. Decks are shortened to take seconds: they run at most {MOST_STEPS}
steps, and a grid of one box of more than {MOST_CELLS:,} cells gets a smaller `resolution`; the
last step is saved. A deck counts as running if it ends normally; all totals and all values of its
last output are finite; densities, temperatures and volumes are not negative and volume fractions
at most 1; density, temperature and pressure are at most {LARGEST_GROWTH:g} times their largest
values in the first output; and mass of each material, momentum and total energy are conserved to
{LARGEST_DRIFT:g}, including the fluxes through the boundary. This is no statement about accuracy:
see [theory_ice.md](theory_ice.md). For the other decks the page gives the first missing feature,
as reported by `sluice check` or at the start of the run.

"""


MPM_HEAD = f"""# Decks of solids

This page lists the state of every deck of the folders `inputs/MPM` and `inputs/UintahRelease/MPM`
of the format's public suite. It is written by `tools/verify/suite_decks.py mpm`, which finds the
suite through the variable `SLUICE_DECKS`; `./dev verify pages` checks every row. Decks run for
{FEW_STEPS} steps, and a grid of one box of more than {MOST_CELLS_OF_SOLIDS:,} cells gets a
smaller `resolution`; the last step is saved. A deck counts as running if it ends normally, all
totals and all values of its last output are finite, volumes and masses of particles are positive,
and the mass of each material is conserved to {LARGEST_DRIFT:g}. This is no statement about
accuracy. For the other decks the page gives the first missing feature, as reported by `sluice
check` or at the start of the run.

"""

IMPM_HEAD = f"""# Decks of implicit steps

This page lists the state of every deck of the folders `inputs/IMPM` and
`inputs/UintahRelease/IMPM` of the format's public suite. It is written by
`tools/verify/suite_decks.py impm`, which finds the suite through the variable `SLUICE_DECKS`;
`./dev verify pages` checks every row. Decks run for {FEW_STEPS} steps, and a grid of one box of
more than {MOST_CELLS_OF_SOLIDS:,} cells gets a smaller `resolution`; the last step is saved. A
deck counts as running if it ends normally, all totals and all values of its last output are
finite, volumes and masses of particles are positive, and the mass of each material is conserved
to {LARGEST_DRIFT:g}. This is no statement about accuracy. For the other decks the page gives the
first missing feature, as reported by `sluice check` or at the start of the run.

"""


MPMICE_HEAD = f"""# Decks of fluid and solids

This page lists the state of every deck of the format's public suite whose component is `mpmice`
or a variant of it. It is written by `tools/verify/suite_decks.py mpmice`, which finds the suite
through the variable `SLUICE_DECKS`; `./dev verify pages` checks every row. Decks run for
{FEW_STEPS} steps, and a grid of one box of more than {MOST_CELLS_OF_SOLIDS:,} cells gets a
smaller `resolution`; the last step is saved. A deck counts as running if it ends normally, all
totals and all values of its last output are finite, volumes and masses of particles are positive,
and the mass of each material is conserved to {LARGEST_DRIFT:g}, apart from mass exchange between
materials. This is no statement about accuracy. For the other decks the page gives the first
missing feature, as reported by `sluice check` or at the start of the run.

"""


SUITE_HEAD = f"""# The public suite

This page lists the state of every deck of the format's public suite: whether `sluice check`
accepts it, and how far it runs. It is written by `tools/verify/suite_decks.py suite`, which finds
the suite through the variable `SLUICE_DECKS`; `./dev verify pages` checks every row. For decks
that are on the page of their kind (fluids, solids, both, implicit steps, levels) the state is
that of this page; the others run for {QUICK_STEPS} steps. For decks that are not accepted the
page gives the first fault.

"""

VAANGO_HEAD = f"""# Decks of Vaango's suite

This page lists the state of every deck of Vaango's suite (June 2025) that is not part of the
format's public suite: whether `sluice check` accepts it, and how far it runs. It is written by
`tools/verify/suite_decks.py vaango`, which finds the suite through the variable
`SLUICE_VAANGO_DECKS`; `./dev verify pages` checks every row. Accepted decks run for {QUICK_STEPS}
steps, and a grid of one box of more than {MOST_CELLS_OF_SOLIDS:,} cells gets a smaller
`resolution`. This is no statement about accuracy. For decks that are not accepted the page gives
the first fault; files that are missing in the suite itself are such faults.

"""
