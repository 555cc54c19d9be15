"""Random scenes of solids.

A scene has one to three bodies, boxes or cylinders, each of a law of its own (rubber, metal, foam,
rock, explosive, liquids of particles), at up to a twentieth of its sound speed, one to three
particles per cell and direction; any basis, any contact or none, with or without heat and
artificial viscosity, closed or periodic sides, one to three dimensions.
Every number follows from the seed alone.
"""
import random

import scene_deck

DRIFT = 1e-12  # of the scale of each conserved quantity

# Law: density, speed of sound, and its parameters.
LAWS = [
    ("comp_neo_hook", 1000, 31,
     "<bulk_modulus>6e5</bulk_modulus><shear_modulus>3e5</shear_modulus>"),
    ("comp_neo_hook", 7800, 5900,
     "<bulk_modulus>1.6e11</bulk_modulus><shear_modulus>8e10</shear_modulus>"),
    ("UCNH", 1000, 31, "<bulk_modulus>6e5</bulk_modulus><shear_modulus>3e5</shear_modulus>"),
    ("comp_neo_hook_plastic", 2000, 700,
     "<bulk_modulus>6e8</bulk_modulus><shear_modulus>3e8</shear_modulus>"
     "<yield_stress>2e6</yield_stress><hardening_modulus>5e6</hardening_modulus>"),
    ("comp_mooney_rivlin", 1030, 110,
     "<he_constant_1>1e5</he_constant_1><he_constant_2>2e4</he_constant_2><he_PR>.49</he_PR>"),
    ("hypo_elastic", 2700, 5000, "<G>2.6e10</G><K>7e10</K>"),
    ("elastic_plastic", 7830, 6000,
     "<bulk_modulus>173.33e9</bulk_modulus><shear_modulus>80e9</shear_modulus>"
     "<flow_model type='johnson_cook'><A>792e6</A><B>510e6</B><C>.014</C><n>.26</n><m>1.03</m>"
     "</flow_model>"),
    ("elastic_plastic", 8930, 4700,
     "<bulk_modulus>138e9</bulk_modulus><shear_modulus>46e9</shear_modulus>"
     "<equation_of_state type='mie_gruneisen'><C_0>3933</C_0><Gamma_0>1.99</Gamma_0>"
     "<S_alpha>1.5</S_alpha></equation_of_state>"
     "<flow_model type='isotropic_hardening'><sigma_0>9e7</sigma_0><K>3e8</K></flow_model>"),
    ("water", 1000, 320, "<bulk_modulus>1.5e7</bulk_modulus><viscosity>0</viscosity>"
                         "<gamma>7</gamma>"),
    ("murnaghanMPM", 1000, 250, "<K>1.5e7</K><gamma>4</gamma>"),
    (
        "Arenisca3",
        2000,
        1600,
        "<B0>3e9</B0><G0>1.6e9</G0><PEAKI1>2e7</PEAKI1><FSLOPE>.4</FSLOPE><CR>.5</CR>"
        "<p0_crush_curve>-3e7</p0_crush_curve><p1_crush_curve>5e-9</p1_crush_curve>"
        "<p3_crush_curve>.2</p3_crush_curve>",
    ),
    ("MohrCoulomb", 1800, 120, "<K>1.3e7</K><G>1e7</G><c>2e5</c><Phi>30</Phi><Psi>10</Psi>"),
    ("trans_iso_hyper", 1000, 11,
     "<bulk_modulus>1e5</bulk_modulus><c1>2e3</c1><c2>1e3</c2><c3>1e3</c3><c4>10</c4><c5>4e4</c5>"
     "<fiber_stretch>1.05</fiber_stretch><direction_of_symm>[0,0,1]</direction_of_symm>"),
]

LIQUIDS = ("water", "murnaghanMPM")

CONTACTS = [
    "", '<contact><type>null</type><materials>{all}</materials></contact>',
    '<contact><type>single_velocity</type><materials>{all}</materials></contact>',
    '<contact><type>friction</type><mu>{mu}</mu><materials>{all}</materials></contact>',
]

BODY = """
  <PhysicalConstants><gravity>[0,0,0]</gravity></PhysicalConstants>
  <MPM>
    <interpolator>{basis}</interpolator>
    <artificial_viscosity>{viscosity}</artificial_viscosity>
    <DoExplicitHeatConduction>{heat}</DoExplicitHeatConduction>
  </MPM>
  <MaterialProperties>
    <MPM>
{materials}
{contact}
    </MPM>
  </MaterialProperties>
"""


def shape_of(draw, n, count, dimensions):
    """One of as many bodies beside each other along x, with room between them."""
    middle = (n + 0.5 + draw.uniform(-0.1, 0.1)) / count
    half = draw.uniform(0.2, 0.35) / count
    y, z = (draw.uniform(0.35, 0.65) for _ in range(2))
    if dimensions == 1:
        return f"<box><min>[{middle - half},-9,-9]</min><max>[{middle + half},9,9]</max></box>"
    if dimensions == 2 and draw.random() < 0.5:
        return (f"<cylinder><bottom>[{middle},{y},-9]</bottom><top>[{middle},{y},9]</top>"
                f"<radius>{half}</radius></cylinder>")
    if dimensions == 3 and draw.random() < 0.5:
        return f"<sphere><origin>[{middle},{y},{z}]</origin><radius>{half}</radius></sphere>"
    low, high = (-9, 9) if dimensions == 2 else (z - half, z + half)
    return (f"<box><min>[{middle - half},{y - half},{low}]</min>"
            f"<max>[{middle + half},{y + half},{high}]</max></box>")


def material_of(draw, name, law, shape, dimensions, most_speed=0.05):
    """A solid material of one body; its velocity is up to a share of its speed of sound."""
    model, density, sound, numbers = law
    speed = [draw.choice([0, draw.uniform(-1, 1)]) * most_speed * sound if d < dimensions else 0
             for d in range(3)]
    per_cell = draw.choice([1, 2, 2, 3])
    res = [per_cell if d < dimensions else 1 for d in range(3)]
    return (f'<material name="{name}"><density>{density}</density>'
            f"<thermal_conductivity>{draw.choice([0, 10, 400])}</thermal_conductivity>"
            "<specific_heat>500</specific_heat><melt_temp>3000</melt_temp>"
            f'<constitutive_model type="{model}">{numbers}</constitutive_model>'
            f"<geom_object>{shape}<res>{res}</res><velocity>{speed}</velocity>"
            f"<temperature>{draw.uniform(250, 600)}</temperature></geom_object></material>")


def contact_of(draw, count):
    """A rule between all of as many solids."""
    return draw.choice(CONTACTS).format(all=list(range(count)), mu=draw.choice([0, 0.3, 2]))


def mirror(name):
    return f'<Face side="{name}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'


def scene(seed):
    """The deck of a seed, and what it is in words."""
    draw = random.Random(seed)
    dimensions, count = draw.choice([1, 2, 2, 3]), draw.choice([1, 2, 2, 3])
    n = {1: 60, 2: 30, 3: 18}[dimensions]
    cells = [n if d < dimensions else 1 for d in range(3)]
    upper = [1 if d < dimensions else 1 / n for d in range(3)]
    laws = [draw.choice(LAWS) for _ in range(count)]
    # Liquids that splash gain energy on wider bases: their domains are drawn out without limit.
    basis = "linear" if any(law[0] in LIQUIDS for law in laws) else draw.choice(
        ["linear", "gimp", "cpgimp", "cpdi", "quadraticBS", "cubicBS"])
    kind = draw.choice(["closed", "periodic"])
    extra = [1 if kind == "closed" or d >= dimensions else 0 for d in range(3)]
    materials = [material_of(draw, f"m{k}", law, shape_of(draw, k, count, dimensions), dimensions)
                 for k, law in enumerate(laws)]
    names = ["x-", "x+", "y-", "y+", "z-", "z+"]
    sides = [mirror(side) for k, side in enumerate(names)
             if kind == "closed" or k // 2 >= dimensions]
    along = [1 if d < dimensions else 0 for d in range(3)]
    contact = contact_of(draw, count)
    multiplier = draw.choice([0.2, 0.4, 0.4, 0.5])
    body = BODY.format(basis=basis, viscosity=draw.choice(["true", "false"]),
                       heat=draw.choice(["true", "false"]), materials="\n".join(materials),
                       contact=contact)
    text = scene_deck.deck("mpm", seed, body, sides, cells, upper, extra=extra,
                           periodic=along if kind == "periodic" else None, multiplier=multiplier)
    words = (f"{'+'.join(law[0] for law in laws)}, {basis}, {kind}, {dimensions}-D, "
             f"contact {contact[15:contact.find('</type>')] or 'none'}")
    return text, words
