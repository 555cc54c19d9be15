"""How long and how large the decks of the suites are when they run, and what they may lose."""
MOST_CELLS = 20000  # of a coarsened deck
MOST_STEPS = 200
STEPS_OF_DETONATIONS = 20  # whose products fill their levels
QUICK_STEPS = 20  # of the decks that --test runs
MOST_COARSE_STEPS = 30  # of a deck with levels
FEW_STEPS = 10  # of solids
SOLIDS_LIMIT = 150  # seconds a deck of solids
MOST_CELLS_OF_SOLIDS = 200_000
LARGEST_DRIFT = 1e-14  # of a total
LARGEST_GROWTH = 10.0  # of density, temperature and pressure
LIMIT = 300  # seconds a deck
