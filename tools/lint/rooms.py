"""The rooms of src/: which may include which, and what each holds.

A room is a folder of sources. ROOMS has an entry for each folder that holds rooms ("" is src/): a
list of floors, the lowest first. A floor maps the names of its rooms to what they hold. A room may
include rooms of lower floors; rooms of one floor do not know each other. "." stands for the files
that lie in the folder itself, where there are any.

check_layers.py holds the order; tools/docs/room_pages.py writes the tables of
docs/developer_guide.md from it.
"""

ROOMS = {
    "": [
        {"framework": "all that is not physics"},
        {"eos": "equations of state: pure functions of a few numbers"},
        {"exact": "exact and reference solutions of test cases",
         "kinetics": "chemistry of gases: species, mechanisms, rates, a reacting cell, molecular "
                     "transport"},
        {"models": "laws of sources, burning and scalars, and how decks name them",
         "solids": "what a fluid sees of solids, whatever method moves them"},
        {"ice": "the fluid",
         "mpm": "the solids",
         "examples": "small components to learn from, see "
                     "[your own component](your_own_component.md)"},
        {"mpmice": "fluid and solids coupled",
         "peridynamics": "solids of points with bonds, which crack"},
        {"app": "the `sluice` command"},
    ],
    "framework": [
        {"base": "errors, exact sums, communicator, console, JSON, small numeric helpers"},
        {"deck": "reading and checking decks, descriptions of tags",
         "geometry": "shapes and their unions",
         "grid": "index boxes, levels, frames of boxes"},
        {"field": "labels, fields, warehouses (all fields of a level)",
         "scene": "a checked deck as plain data"},
        {"task": "the task graph and its sweeps",
         "archive": "archives on disk",
         "particle": "sets of particles",
         "solve": "linear systems on one level or several, and their solvers"},
        {"refine": "refined levels: regrids, coverage, fluxes where levels meet",
         "analysis": "what is sampled during a run"},
        {"run": "the run loop"},
    ],
    "framework/deck": [
        {".": "XML to a tree, spelling, obsolete tags, overrides, the check against a schema"},
        {"format": "the blocks that every component has: schema, rules and completions",
         "help": "the schema in words: tags, laws, the pages of the reference"},
    ],
    "framework/archive": [
        {".": "writing and reading archives: Sluice's own in HDF5, Uintah's raw ones; particles, "
              "samples"},
        {"compare": "two archives, of either format and resolution: differences, norms, orders",
         "extract": "values as rows: of a box, at points, along lines, of particles, over outputs",
         "extremes": "extremes of labels with their places, and sums over materials, of one step",
         "drawing": "for programs that draw: names of arrays, marks of covered cells, files "
                    "written in parts",
         "uda": "export to Uintah's raw layout"},
        {"vtk": "export to the files of ParaView and VisIt",
         "xdmf": "archives opened where they lie by ParaView and VisIt"},
    ],
    "framework/solve": [
        {"block": "matrices of blocks, of several unknowns per node, and their solvers"},
        {".": "systems of one unknown per cell, on one level or several, and their solvers"},
    ],
    "framework/run": [
        {"component": "the interface of a component, and what a run keeps for it: time, events, "
                      "conservation, reports"},
        {"levels": "the hierarchy of levels, the solver of one level, particles on levels, flags, "
                   "balance over ranks"},
        {"analysis": "the modules of `DataAnalysis`"},
        {"simulation": "the loop over steps: outputs, progress, guard of energies, succession of "
                       "components"},
    ],
    "exact": [
        {"base": "the interface of a solution, its parameters and error norms, laws as text"},
        {"radial": "plane, cylindrical and spherical flow: Noh, Sedov, Euler equations in radius",
         "riemann": "Riemann problems, of any equation of state and of elastic-plastic solids",
         "smooth": "smooth flow: waves, vortices, motions of solids"},
        {".": "the registry of all solutions"},
    ],
    "models": [
        {"deck": "parts of tags that several models share"},
        {"sources": "values held or added during a time window"},
        {"burn": "laws of burning and detonation",
         "scalars": "scalars that flow with a material"},
        {"gases": "mixtures of gases: properties, flames, combustion"},
        {".": "the registry of all models"},
    ],
    "ice": [
        {"fluid": "the law of one material and its rows (also of a mixed gas), limiters, labels"},
        {"conditions": "kinds of boundary conditions: one file each, a row of "
                       "`face_conditions.cpp` each"},
        {"deck": "tags, rules, and the plain data read from a deck; no task, no field"},
        {"closure": "the materials in one cell: equal pressure, drag, exchange of heat, contacts, "
                    "traces; no task",
         "boundary": "ghost cells from boundary conditions: rules (what the deck says of a "
                     "region), ghosts (rows that follow a rule), waves of LODI faces, slip of a "
                     "rarefied gas"},
        {"step": "what all sweeps share: options, variables, runs of cells with the same "
                 "materials, end of a step"},
        {"start": "the state at time 0",
         "sources": "what models add to the flow",
         "transport": "viscosity, conductivity, turbulence, wall laws",
         "tracers": "particles that move with the flow"},
        {"one_material": "the default scheme for one material, one step of the theory per file",
         "internal_energy_form": "the classic form (internal energy), one step of the theory per "
                                 "file",
         "parabolas": "the third order: parabolas in cells of one material, traced along "
                      "characteristics"},
        {"mixture": "the default scheme where several materials meet"},
        {"multi_velocity": "the tasks that a step has in addition with one velocity per "
                           "material"},
        {"pressure": "the semi-implicit pressure: faces from a solve, the system, passes, levels",
         "cut_cells": "cells and faces that solids cut: what replaces the rows of cells full of "
                  "fluid there"},
        {"scalars": "what is carried with a material's mass, and the heat of a gas whose "
                    "properties follow from a scalar"},
        {"levels": "what passes between levels",
         "budgets": "exact sums, totals, rates, limits of the time step"},
        {"outputs": "labels that users save, and criteria of refinement; `quantity_list` holds "
                    "cell variables that are functions of a state alone"},
        {".": "`step_tables`: the tasks of each sweep, from `step_parts` and `cut_cell_inputs`; "
              "`fluid_part`: the fluid as a part of a component; `ice`: the component; `effects`"},
    ],
    "mpm": [
        {"material": "constitutive models over batches of particles, damage, erosion, the driver "
                     "of one particle"},
        {"deck": "tags, rules, and the plain data read from a deck (`mpm_scene.hpp`)"},
        {"shape": "weights along an axis",
         "nodes": "sparse blocks of nodes, sums as exact integers, their exchange between ranks"},
        {"boundary": "given velocities, images across sides"},
        {"transfer": "kernels from particles to nodes and back",
         "loads": "loads and motions from outside"},
        {"contact": "rules where materials meet"},
        {"start": "particles of geometry objects"},
        {"step": "the stages of a step on one level, what particles carry, bounds of the sums"},
        {"grains": "clusters of particles that touch, and their materials"},
        {"levels": "one basis over all levels",
         "budgets": "sums over the sides of the domain"},
        {"outputs": "labels that are saved",
         "implicit": "implicit steps: all particles in one order, nodes, tangents, Newton's "
                     "method, heat, budgets"},
        {".": "`mpm`: the component, its step as a table of stages; `solids_beside_fluid`: the "
              "solids of a coupled step; `solid_particles`, `effects`, `histories`"},
    ],
    "mpm/material": [
        {"base": "the interface of a model, tensors, batches, parameters, return mappings"},
        {"elastic": "elastic, viscoelastic and rigid solids",
         "failure": "damage and erosion",
         "geologic": "soil and rock",
         "hydrodynamic": "gases, water and explosives as particles",
         "metal": "elastic-plastic metals: flow stresses, moduli, pressure laws, failure"},
        {".": "the registry of all models, and the driver of one particle"},
    ],
    "peridynamics": [
        {"deck": "tags, rules, and the plain data read from a deck (`peri_scene.hpp`)",
         "peridigm": "decks of Peridigm, read and converted"},
        {"points": "the points of a rank side by side, their images, what they carry"},
        {"bonds": "families in rows of eight, weights, sums over bonds"},
        {"step": "points with their bonds and state; the stages of a step"},
        {"start": "points of geometry objects as particles of the run"},
        {".": "the component, its step as a table, books, effects"},
    ],
    "mpmice": [
        {"geometry": "solids in cells, from the outer faces of particles"},
        {"fields": "the cells near solids, arrays over them, values of other ranks; "
                   "states and amounts of the fluid there; the books of a step"},
        {"surfaces": "solids in a step: their particles and faces, where they lie in cells, means "
                     "over surfaces, particles that separate, "
                     "inputs of the fluid's step"},
        {"walls": "pressure, friction and forces between fluid and solids"},
        {"amounts": "the fluid behind the sweep: small cells share, amounts become a state"},
        {"exchange": "momentum and heat through surfaces",
         "burn": "solids that become fluid: at surfaces, in cells, as explosive"},
        {"step": "the tasks of a coupled step"},
        {".": "the component, its step as a table, and how a deck makes it"},
    ],
    "app": [
        {"loading": "from the file of a deck to a problem with its components",
         "process": "child processes, decks run as such, files that users write, data folders, "
                    "pieces of HTML",
         "tune": "the search for a faster solver of a deck's linear systems"},
        {"command": "what commands share: options, help, endings of a run, pictures",
         "help": "what `sluice help` tells: tags, laws, labels, messages that end a run",
         "regress": "golden results, written and compared",
         "accuracy": "error bars of a deck from its own ladder of resolutions",
         "stability": "hard cases: what must hold, sweeps, maps of where it does",
         "study": "accuracy studies over series of runs",
         "classic": "the tools of the public suite, under their own names"},
        {"plan": "`sluice plan`: tasks, levels, memory and first step of a run, before it runs"},
        {"report": "`sluice report`: one page of a run, its deck, plan, costs, pictures"},
        {"commands": "one file per command, a row of `commands.cpp` each"},
        {".": "`main`, and the fuzz targets of decks and lists"},
    ],
}
# Folders of helpers of tests; they lie in any room.
TEST_SUPPORT = "test_support"


def floor_of(folder, room):
    """The floor of a room of a folder; None where the folder has none of that name."""
    return next((n for n, floor in enumerate(ROOMS[folder]) if room in floor), None)


def path_of(folder, room):
    """The path of a room below src/."""
    return folder if room == "." else f"{folder}/{room}" if folder else room


def all_rooms():
    """(folder, floor, room, what it holds) of every room, each before the rooms inside it."""
    def below(folder):
        for number, floor in enumerate(ROOMS[folder]):
            for room, what in floor.items():
                yield folder, number, room, what
                if room != "." and path_of(folder, room) in ROOMS:
                    yield from below(path_of(folder, room))
    return below("")
