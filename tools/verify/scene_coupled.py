"""Random scenes of fluids and solids on one grid.

A scene has one or two gases (1e4 to 1e7 Pa, 250 to 1000 K; the second in a part of the domain, at
another pressure) with friction and conduction or none, and one or two bodies of any law, still or
moving, some so fast that the gas tears them; any drag and heat exchange from none to one velocity,
closed, open or periodic sides, explicit or with a semi-implicit pressure, one or two dimensions.
Every number follows from the seed alone.
"""
import random

import scene_deck
from scene_fluid import side
from scene_solid import LAWS, contact_of, material_of, mirror, shape_of

DRIFT = 1e-12  # of the scale of each conserved quantity

RUBBER = LAWS[0]
IMPLICIT = ("<ImplicitSolver><max_outer_iterations>20</max_outer_iterations>"
            "<outer_iteration_tolerance>1e-6</outer_iteration_tolerance></ImplicitSolver>")

BODY = """
  <CFD>
    <cfl>0.4</cfl>
    <ICE><advection type="SecondOrder"/>{implicit}</ICE>
  </CFD>
  <MPM>
    <interpolator>{basis}</interpolator>
    <DoExplicitHeatConduction>false</DoExplicitHeatConduction>
  </MPM>
  <PhysicalConstants>
    <gravity>[0,0,0]</gravity> <reference_pressure>101325</reference_pressure>
  </PhysicalConstants>
  <MaterialProperties>
    <MPM>
{solids}
{contact}
    </MPM>
    <ICE>
{gases}
    </ICE>
    <exchange_properties><exchange_coefficients>
      <momentum>{drag}</momentum> <heat>{exchange}</heat>
    </exchange_coefficients></exchange_properties>
  </MaterialProperties>
"""


def gas(draw, name, shape, dimensions):
    """A gas in a shape, at a random state."""
    pressure, temperature = 1e5 * 10 ** draw.uniform(-1, 2), draw.uniform(250, 1000)
    gamma, heat = draw.choice([1.2, 1.4, 1.667]), draw.choice([300, 717.5, 3000])
    speed = [draw.choice([0, 0, draw.uniform(-200, 200)]) if d < dimensions else 0
             for d in range(3)]
    return (f'<material name="{name}"><EOS type="ideal_gas"/><specific_heat>{heat}</specific_heat>'
            f"<gamma>{gamma}</gamma><dynamic_viscosity>{draw.choice([0, 0, 1e-3, 1])}"
            "</dynamic_viscosity>"
            f"<thermal_conductivity>{draw.choice([0, 0, 0.1, 100])}</thermal_conductivity>"
            f"<geom_object>{shape}<res>[1,1,1]</res><velocity>{speed}</velocity>"
            f"<density>{pressure / ((gamma - 1) * heat * temperature)!r}</density>"
            f"<temperature>{temperature!r}</temperature></geom_object></material>")


def scene(seed):
    """The deck of a seed, and what it is in words."""
    draw = random.Random(seed)
    dimensions = draw.choice([1, 2, 2])
    count, fluids = draw.choice([1, 1, 2]), draw.choice([1, 1, 2])
    n = {1: 60, 2: 30}[dimensions]
    torn = draw.random() < 0.15
    laws = [RUBBER if torn else draw.choice(LAWS) for _ in range(count)]
    speed = 30 if torn else 0.05  # of sound
    solids = [material_of(draw, f"s{k}", law, shape_of(draw, k, count, dimensions), dimensions,
                          speed)
              for k, law in enumerate(laws)]
    split = draw.uniform(0.3, 0.7) if fluids == 2 else 9
    shapes = [f"<box><min>[-9,-9,-9]</min><max>[{split},9,9]</max></box>",
              f"<box><min>[{split},-9,-9]</min><max>[9,9,9]</max></box>"]
    gases = [gas(draw, f"g{k}", shapes[k], dimensions) for k in range(fluids)]
    pairs = (count + fluids) * (count + fluids - 1) // 2
    drag = draw.choice([0, 0, 100, 1e6, 1e15])
    drags = [drag] * pairs
    if fluids == 2:
        drags[-1] = draw.choice([0, 1e4, 1e8, 1e15])
    exchange = draw.choice([0, 0, 1e3, 1e9, 1e15])
    kind, implicit = draw.choice(["closed", "open", "periodic"]), draw.random() < 0.25
    across = ["x-", "x+", "y-", "y+"][:2 * dimensions]
    sides = [] if kind == "periodic" else [
        mirror(s) if kind == "closed" else side(s, "open") for s in across]
    sides += [mirror(s) for s in ["x-", "x+", "y-", "y+", "z-", "z+"][2 * dimensions:]]
    along = [1 if d < dimensions else 0 for d in range(3)]
    extra = [0 if kind == "periodic" and d < dimensions else 1 for d in range(3)]
    basis = draw.choice(["linear", "gimp", "cpdi"])
    multiplier = draw.choice([0.2, 0.4, 0.4])
    body = BODY.format(implicit=IMPLICIT if implicit else "", basis=basis,
                       solids="\n".join(solids), contact=contact_of(draw, count),
                       gases="\n".join(gases), drag=drags, exchange=[exchange] * pairs)
    text = scene_deck.deck("mpmice", seed, body, sides, [n, n if dimensions > 1 else 1, 1],
                           [1, 1 if dimensions > 1 else 1 / n, 1 / n], extra=extra,
                           periodic=along if kind == "periodic" else None, multiplier=multiplier)
    words = (f"{'+'.join(law[0] for law in laws)}{' torn' if torn else ''}, {fluids} gases, "
             f"{basis}, {kind}, {dimensions}-D, drag {drag:g}, {drags[-1]:g}, heat {exchange:g}"
             f"{', implicit' if implicit else ''}")
    return text, words
