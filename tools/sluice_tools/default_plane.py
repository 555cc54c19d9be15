"""The plane that shows most of a run in three dimensions.

Across each direction it is the layer of cells with most materials, then most particles, then
nearest the middle. Of the three directions it is that whose layer has most materials, then the one
whose planes have most cells, at last z before y before x."""
import numpy as np

from . import quantities


def _layer_counts(step):
    """For each direction: (materials, particles) in each layer of the coarsest cells."""
    level = step.levels[0]
    counts = [level.upper[d] - level.lower[d] for d in range(3)]
    materials = [np.zeros(n, dtype=int) for n in counts]
    particles = [np.zeros(n, dtype=int) for n in counts]
    for material in step.particle_materials():
        places = step.particles(material, {"p.x"})["p.x"]
        for d in range(3):
            cells = np.floor((places[:, d] - level.anchor[d]) / level.spacing[d]) - level.lower[d]
            inside = cells[(cells >= 0) & (cells < counts[d])].astype(int)
            here = np.bincount(inside, minlength=counts[d])
            particles[d] += here
            materials[d] += here > 0
    fluids = quantities.fluids(step)
    for material in fluids if len(fluids) > 1 else ():
        share = quantities.share(step, material)
        if share is None:
            continue
        for d in range(3):
            others = tuple({0, 1, 2} - {d})
            materials[d] += (share.values > 0).any(axis=others)
    return materials, particles


def best(step):
    """(normal, position) of that plane, m; the position is the middle of a layer of cells."""
    materials, particles = _layer_counts(step)
    level = step.levels[0]
    ranked = []
    for d in range(3):
        count = len(materials[d])
        cells = np.prod([len(materials[other]) for other in range(3) if other != d])
        best_layer = max(range(count), key=lambda n, d=d, middle=0.5 * count: (
            materials[d][n], particles[d][n], -abs(n + 0.5 - middle), n))
        ranked.append((materials[d][best_layer], cells, d, best_layer))
    _, _, normal, layer = max(ranked)
    middle = level.lower[normal] + layer + 0.5
    return normal, level.anchor[normal] + middle * level.spacing[normal]
