"""Random scenes of gases, liquids, dense matter.

A scene has one to three materials (ideal or stiffened gases at 1e4 to 1e9 Pa and 120 to 1900 K, in
three of ten scenes one under a law of dense matter), each in a box or a cylinder of its own, at up
to 500 m/s; any drag from none to one velocity, any heat exchange, viscosity and conduction or none,
closed, open or periodic sides, one or two dimensions, one to three levels.
Every number follows from the seed alone.
"""
import random

import scene_deck

DRIFT = 1e-13  # of the scale of each conserved quantity
LIQUIDS = [(4.4, 6e8, 4180), (2.35, 1e9, 1816), (6.12, 3.43e8, 4000), (3, 1e6, 1000)]

BODY = """
{levels}
  <CFD><cfl>{cfl}</cfl><ICE><advection type="SecondOrder"/></ICE></CFD>
  <PhysicalConstants>
    <gravity>[0,0,0]</gravity> <reference_pressure>101325</reference_pressure>
  </PhysicalConstants>
  <MaterialProperties>
    <ICE>
{materials}
    </ICE>
{exchange}
  </MaterialProperties>
"""


class Material:
    """A law with its numbers."""

    def __init__(self, draw, liquids):
        self.stiff = liquids and draw.random() < 0.5
        if self.stiff:
            self.gamma, self.pinf, self.heat = draw.choice(LIQUIDS)
        else:
            self.gamma, self.pinf = draw.choice([1.2, 1.4, 1.667, 3.0]), 0
            self.heat = draw.choice([300, 717.5, 3000])

    def state(self, draw):
        """Density and temperature, at a pressure of its range."""
        pressure = 1e5 * 10 ** draw.uniform(-1, draw.choice([1, 3, 4]))
        temperature = 300 * 10 ** draw.uniform(-0.4, 0.8)
        return (pressure + self.pinf) / ((self.gamma - 1) * self.heat * temperature), temperature

    @property
    def name(self):
        return "liquid" if self.stiff else "gas"

    def head(self, viscosity, conductivity):
        law = (f'<EOS type="StiffenedGas"><pinf>{self.pinf}</pinf><q>0</q></EOS>' if self.stiff
               else '<EOS type="ideal_gas"/>')
        return (f"{law}<specific_heat>{self.heat}</specific_heat><gamma>{self.gamma}</gamma>"
                f"<dynamic_viscosity>{viscosity}</dynamic_viscosity>"
                f"<thermal_conductivity>{conductivity}</thermal_conductivity>")


# A law of dense matter: name, numbers, density, the least and the most of it that a scene begins
# with, the least and the most temperature.
DENSE = [
    ("JWL", {"A": 371.2e9, "B": 3.231e9, "R1": 4.15, "R2": 0.95, "om": 0.3, "rho0": 1630},
     1630, (0.01, 1.0), (500, 4000)),
    ("Murnaghan", {"n": 7.4, "K": 39e-11, "rho0": 1160, "P0": 101325}, 1160, (1.0, 1.1),
     (300, 900)),
    ("BirchMurnaghan", {"n": 7.0, "K": 4.5e-10, "rho0": 1000, "P0": 101325}, 1000, (1.0, 1.1),
     (280, 600)),
    ("MieGruneisen", {"C0": 3940, "S": 1.49, "Gamma0": 1.99, "rho0": 8930, "T0": 300}, 8930,
     (1.0, 1.05), (300, 900)),
]


class Dense:
    """Products of a detonation, a solid or water under a law of their own."""

    def __init__(self, draw):
        self.name, self.numbers, self.usual, self.shares, self.temperatures = draw.choice(DENSE)

    def state(self, draw):
        return self.usual * draw.uniform(*self.shares), draw.uniform(*self.temperatures)

    def head(self, viscosity, conductivity):
        numbers = "".join(f"<{name}>{value}</{name}>" for name, value in self.numbers.items())
        return (f'<EOS type="{self.name}">{numbers}</EOS><specific_heat>1000</specific_heat>'
                f"<gamma>1.3</gamma><dynamic_viscosity>{viscosity}</dynamic_viscosity>"
                f"<thermal_conductivity>{conductivity}</thermal_conductivity>")


def filled(draw, material, shape, planar):
    """The geometry object of a material in a shape, at a random state."""
    density, temperature = material.state(draw)
    u, v = (draw.choice([0, 0, draw.uniform(-500, 500)]) for _ in range(2))
    return (f"<geom_object>{shape}<res>[2,2,2]</res>"
            f"<velocity>[{u},{v if planar else 0},0]</velocity>"
            f"<density>{density!r}</density>"
            f"<temperature>{temperature!r}</temperature></geom_object>")


def shapes_of(draw, count, planar):
    """As many shapes beside each other, and what they leave."""
    shapes = []
    for n in range(count):
        middle = (n + 0.5 + draw.uniform(-0.15, 0.15)) / count
        if planar and draw.random() < 0.7:
            height, radius = draw.uniform(0.2, 0.8), draw.uniform(0.08, 0.2)
            shapes.append(f'<cylinder label="s{n}"><bottom>[{middle},{height},-1]</bottom>'
                          f'<top>[{middle},{height},1]</top><radius>{radius}</radius></cylinder>')
        else:
            shapes.append(f'<box label="s{n}"><min>[{middle - 0.12},-9,-9]</min>'
                          f'<max>[{middle + 0.12},9,9]</max></box>')
    names = "".join(f'<{s[1:s.index(" ")]} label="s{n}"/>' for n, s in enumerate(shapes))
    union = f"<union>{names}</union>" if count > 1 else names
    everything = '<box label="all"><min>[-9,-9,-9]</min><max>[9,9,9]</max></box>'
    return shapes, f"<difference>{everything}{union}</difference>"


def side(name, kind):
    if kind == "closed":
        return f'<Face side="{name}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'
    open_side = "".join(
        f'<BCType id="{0 if label == "Pressure" else "all"}" label="{label}" var="Neumann">'
        f"<value>{value}</value></BCType>"
        for label, value in (("Pressure", 0), ("Density", 0), ("Temperature", 0),
                             ("Velocity", "[0,0,0]")))
    return f'<Face side="{name}">{open_side}</Face>'


def levels_of(draw, cells):
    """How many levels, and their tag: refined where pressure or density vary much."""
    levels = draw.choice([1, 1, 2, 2, 3])
    if levels == 1:
        return 1, ""
    planar = cells[1] > 1
    ratio = draw.choice([2, 2, 4]) if levels == 2 else 2
    across = f"{ratio},{ratio},1" if planar else f"{ratio},1,1"
    tile = draw.choice([4, 8])
    tiles = f"{tile},{tile},1" if planar else f"{tile},1,1"
    lists = ["[[" + "],[".join([one] * (levels - 1)) + "]]" for one in (across, tiles)]
    wide = "[1,1,0]" if planar else "[1,0,0]"
    return levels, (
        f"<AMR><useLockStep>{draw.choice(['true', 'false'])}</useLockStep>"
        f"<ICE><orderOfInterpolation>{draw.choice([0, 1, 2])}</orderOfInterpolation>"
        '<Refinement_Criteria_Thresholds><Variable name="press_CC" value="1e6" matl="0"/>'
        '<Variable name="rho_CC" value="20" matl="0"/></Refinement_Criteria_Thresholds></ICE>'
        f'<Regridder type="Tiled"><max_levels>{levels}</max_levels>'
        f"<cell_refinement_ratio>{lists[0]}</cell_refinement_ratio>"
        f"<min_patch_size>{lists[1]}</min_patch_size>"
        f"<max_timestep_interval>{draw.choice([0, 1, 5])}</max_timestep_interval>"
        f"<cell_stability_dilation>{wide}</cell_stability_dilation>"
        f"<cell_regrid_dilation>{wide}</cell_regrid_dilation>"
        "</Regridder></AMR>")


def scene(seed):
    """The deck of a seed, and what it is in words."""
    draw = random.Random(seed)
    count, liquids = draw.choice([1, 2, 2, 3]), draw.random() < 0.6
    materials = [Material(draw, liquids) for _ in range(count)]
    cells = draw.choice([(64, 1), (24, 24), (32, 16)])
    kind, cfl = draw.choice(["closed", "open", "periodic"]), draw.choice([0.2, 0.4, 0.4, 0.8])
    drag, heat = draw.choice([1e15, 1e15, 0, 100, 1e6]), draw.choice([0, 0, 1e3, 1e9, 1e15])
    viscosity, conductivity = draw.choice([0, 0, 1e-3, 1]), draw.choice([0, 0, 0.1, 100])
    planar = cells[1] > 1
    shapes, rest = shapes_of(draw, max(count - 1, 1), planar)
    places = [*shapes, rest]  # two of one material
    owners = materials if count > 1 else materials * 2
    objects = [filled(draw, m, place, planar) for m, place in zip(owners, places)]
    levels, refined = levels_of(draw, cells)
    if draw.random() < 0.3:
        n = draw.randrange(count)
        materials[n] = Dense(draw)
        for k in range(len(objects)) if count == 1 else [n]:
            objects[k] = filled(draw, materials[n], places[k], planar)
    if count == 1:
        objects = ["".join(objects)]
    texts = [f'<material name="m{n}">{m.head(viscosity, conductivity)}{objects[n]}</material>'
             for n, m in enumerate(materials)]
    pairs = count * (count - 1) // 2
    exchange = "<exchange_properties><exchange_coefficients>" \
               f"<momentum>{[drag] * pairs}</momentum><heat>{[heat] * pairs}</heat>" \
               "</exchange_coefficients></exchange_properties>" if pairs else ""
    sides = [] if kind == "periodic" else [side(s, kind) for s in ("x-", "x+", "y-", "y+")]
    sides += [side(s, "closed") for s in ("z-", "z+")]
    body = BODY.format(levels=refined, cfl=cfl, materials="\n".join(texts), exchange=exchange)
    text = scene_deck.deck("ice", seed, body, sides, [*cells, 1], [1, 1, 1], end=1,
                           periodic=[1, 1, 0] if kind == "periodic" else None)
    if count == 1:
        text = text.replace('id="all"', 'id="0"')
    names = "+".join(m.name for m in materials)
    words = (f"{names}, {kind}, {cells[0]} x {cells[1]}, drag {drag:g}, heat {heat:g}, "
             f"mu {viscosity}, k {conductivity}, levels {levels}")
    return text, words
