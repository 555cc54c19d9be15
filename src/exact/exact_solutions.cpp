#include "exact/exact_solutions.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "exact/base/law_text.hpp"
#include "exact/radial/noh.hpp"
#include "exact/radial/radial_reference.hpp"
#include "exact/radial/sedov.hpp"
#include "exact/riemann/material_solutions.hpp"
#include "exact/riemann/riemann.hpp"
#include "exact/smooth/motions.hpp"
#include "exact/smooth/vortices.hpp"
#include "exact/smooth/waves.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

using Made = std::unique_ptr<ExactSolution>;

Vec3 unit(const SolutionParameters& from, const std::string& name, Vec3 fallback) {
  const Vec3 v = from.vector(name, fallback);
  const double size = std::sqrt(dot(v, v));
  if (!(size > 0)) {
    throw InputError(
        fmt::format("exact solution '{}': <{}> is a zero vector; it must name a "
                    "direction",
                    from.type(), name));
  }
  return size == 1 ? v : v * (1 / size);
}

State mean_state(const SolutionParameters& from) {
  State out;
  out.density = from.positive("density", 1);
  out.velocity = from.vector("velocity", {});
  out.pressure = from.positive("pressure", 1);
  out.gamma = from.positive("gamma", 1.4);
  return out;
}

int sense(const SolutionParameters& from) {
  const int s = from.integer("sense", 1, -1, 1);
  if (s == 0) throw InputError("exact solution: <sense> is 0; allowed are 1 and -1");
  return s;
}

double amplitude(const SolutionParameters& from) {
  const double a = from.real("amplitude");
  if (!(std::abs(a) < 1)) {
    throw InputError(
        fmt::format("exact solution '{}': <amplitude> is {}, allowed is -1 to 1 "
                    "without the ends (density stays positive)",
                    from.type(), a));
  }
  return a;
}

Vec3 wave_vector(const SolutionParameters& from) {
  const Vec3 k = from.vector("wave_vector", {1, 0, 0});
  if (!(dot(k, k) > 0)) {
    throw InputError("exact solution: <wave_vector> is zero; give periods per unit length");
  }
  return k;
}

class PlaneRiemann final : public ExactSolution {
 public:
  PlaneRiemann(RiemannSolution solution, double position, Vec3 direction)
      : solution_(solution), position_(position), direction_(direction) {}
  State at(Vec3 x, double t) const override {
    const double s = dot(direction_, x) - position_;
    // At the start only the side counts.
    const GasState gas = solution_.sample(t > 0 ? s / t : s < 0 ? -HUGE_VAL : HUGE_VAL);
    return {gas.density, direction_ * gas.velocity, gas.pressure, gas.gamma};
  }
  bool varies_along(int d) const override { return direction_[d] != 0; }

 private:
  RiemannSolution solution_;
  double position_;
  Vec3 direction_;
};

Made make_riemann(const SolutionParameters& from) {
  const auto left = from.state("left"), right = from.state("right");
  const double gamma = from.positive("gamma", 1.4);
  const GasState l{left[0], left[1], left[2], from.positive("gamma_left", gamma)};
  const GasState r{right[0], right[1], right[2], from.positive("gamma_right", gamma)};
  const double position = from.real("position");
  return std::make_unique<PlaneRiemann>(RiemannSolution(l, r), position,
                                        unit(from, "direction", {1, 0, 0}));
}

Made make_two(const SolutionParameters& from) {
  return make_two_materials(from, unit(from, "direction", {1, 0, 0}));
}
Made make_shock(const SolutionParameters& from) {
  return make_shock_at_interface(from, unit(from, "direction", {1, 0, 0}));
}

Made make_noh(const SolutionParameters& from) {
  Noh::Inflow in;
  in.dimension = from.integer("dimension", 1, 1, 3);
  in.gamma = from.positive("gamma", 5.0 / 3.0);
  in.density = from.positive("density", 1);
  in.speed = from.positive("speed", 1);
  in.pressure = from.real("pressure", 0);
  in.origin = from.vector("origin", {});
  in.axis = unit(from, "axis", in.dimension == 2 ? Vec3{0, 0, 1} : Vec3{1, 0, 0});
  return std::make_unique<Noh>(in);
}

Made make_sedov(const SolutionParameters& from) {
  Sedov::Blast blast;
  blast.dimension = from.integer("dimension", 3, 1, 3);
  blast.gamma = from.positive("gamma", 1.4);
  blast.density = from.positive("density", 1);
  blast.energy = from.positive("energy");
  blast.pressure = from.real("pressure", 0);
  blast.origin = from.vector("origin", {});
  blast.axis = unit(from, "axis", blast.dimension == 2 ? Vec3{0, 0, 1} : Vec3{1, 0, 0});
  return std::make_unique<Sedov>(blast);
}

Made make_isentropic_vortex(const SolutionParameters& from) {
  IsentropicVortex::Stream stream;
  stream.strength = from.positive("strength", 5);
  stream.gamma = from.positive("gamma", 1.4);
  stream.velocity = from.vector("velocity", {});
  stream.centre = from.vector("origin", {});
  stream.period = from.real("period", 0);
  return std::make_unique<IsentropicVortex>(stream);
}

Made make_gresho(const SolutionParameters& from) {
  const double mach = from.positive("mach");
  const double gamma = from.positive("gamma", 1.4);
  return std::make_unique<GreshoVortex>(mach, gamma, from.vector("origin", {}));
}

// states: density, velocity, pressure of each piece, one after the other; edges between them.
Made make_radial(const SolutionParameters& from) {
  RadialProblem problem;
  problem.dimension = from.integer("dimension", 3, 1, 3);
  problem.gamma = from.positive("gamma", 1.4);
  problem.low = from.real("low", 0);
  problem.high = from.real("high");
  problem.cells = from.integer("cells", 2000, 4, 100000);
  problem.cfl = from.positive("cfl", 0.8);
  problem.outflow = from.integer("outflow", 0, 0, 1) == 1;
  problem.deposit.energy = from.real("deposit_energy", 0);
  problem.deposit.radius = from.positive("deposit_radius", 1);
  const auto states = from.reals("states");
  const auto edges = from.has("edges") ? from.reals("edges") : std::vector<double>{};
  if (states.size() != 3 * (edges.size() + 1)) {
    throw InputError(fmt::format(
        "exact solution 'radial': {} numbers in <states> and {} in <edges>; expected three per "
        "state (density, velocity, pressure) and one edge between two states",
        states.size(), edges.size()));
  }
  for (std::size_t k = 0; k <= edges.size(); ++k) {
    const double end = k < edges.size() ? edges[k] : problem.high;
    problem.pieces.push_back({end, states[3 * k], states[3 * k + 1], states[3 * k + 2]});
  }
  const Vec3 origin = from.vector("origin", {});
  const Vec3 axis = unit(from, "axis", problem.dimension == 2 ? Vec3{0, 0, 1} : Vec3{1, 0, 0});
  return std::make_unique<RadialReference>(problem, origin, axis);
}

Made make_uniform(const SolutionParameters& from) {
  return std::make_unique<Uniform>(mean_state(from));
}

template <class Wave>
Made make_wave(const SolutionParameters& from) {
  const State mean = mean_state(from);
  const double a = amplitude(from);
  const Vec3 k = wave_vector(from), origin = from.vector("origin", {});
  if constexpr (std::is_same_v<Wave, AdvectedWave>) {
    return std::make_unique<Wave>(mean, a, k, origin);
  } else {
    return std::make_unique<Wave>(mean, a, k, sense(from), origin);
  }
}

Made make_hydrostatic(const SolutionParameters& from) {
  const State base = mean_state(from);
  const bool isothermal = from.integer("isothermal", 1, 0, 1) == 1;
  return std::make_unique<HydrostaticColumn>(base, from.vector("gravity"), isothermal,
                                             from.vector("origin", {}));
}

Made make_vortex_ring(const SolutionParameters& from) {
  return std::make_unique<VortexRing>(from.real("amplitude", 1));
}

Made make_axis_aligned(const SolutionParameters& from) {
  return std::make_unique<AxisAligned>(from.real("amplitude", 0.05), from.positive("speed"),
                                       from.integer("directions", 3, 1, 3));
}

struct Kind {
  SolutionHelp help;
  std::function<Made(const SolutionParameters&)> make;
};

const ParameterHelp gamma_help{"gamma", "ratio of specific heats (1.4)"};
const ParameterHelp origin_help{"origin", "centre, axis or plane of symmetry ([0,0,0])"};
const ParameterHelp axis_help{"axis",
                              "direction of a plane flow, or the axis of a cylindrical one"};
const ParameterHelp dimension_help{"dimension", "1 plane, 2 cylinder, 3 sphere"};
const ParameterHelp density_help{"density", "density of the mean or undisturbed gas (1)"};
const ParameterHelp velocity_help{"velocity", "velocity of the mean or undisturbed gas ([0,0,0])"};
const ParameterHelp pressure_help{"pressure", "pressure of the mean or undisturbed gas"};
const ParameterHelp amplitude_help{"amplitude", "relative amplitude of the density"};
const ParameterHelp wave_vector_help{"wave_vector", "periods per unit length ([1,0,0])"};
const ParameterHelp sense_help{"sense", "1 along the wave vector, -1 against it (1)"};

// Of the two sides of a flow of two materials.
std::vector<ParameterHelp> sides_help(std::vector<ParameterHelp> more) {
  std::vector<ParameterHelp> all = {
      {"left", "[density, velocity, pressure]"},
      {"right", "[density, velocity, pressure]"},
      {"eos_left",
       "law and parameters, as in ideal_gas gamma=1.4 specific_heat=717.5; laws: " + known_laws()},
      {"eos_right", "law and parameters of the right material"},
      {"temperature_left", "K, for laws whose pressure depends on density only"},
      {"temperature_right", "K, for laws whose pressure depends on density only"},
      {"position", "position of the interface at t = 0"},
      {"direction", "normal of the interface ([1,0,0])"},
      {"materials", "numbers in the deck of the left and the right material ([0, 1])"}};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// Table: a row for each kind of solution.
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {{"riemann",
        "two uniform gases side by side (Toro, ch. 4)",
        {{"left", "[density, velocity, pressure]"},
         {"right", "[density, velocity, pressure]"},
         {"position", "position of the interface at t = 0"},
         {"direction", "normal of the interface ([1,0,0])"},
         gamma_help,
         {"gamma_left", "ratio of specific heats of the left gas (gamma)"},
         {"gamma_right", "ratio of specific heats of the right gas (gamma)"}}},
       make_riemann},
      {{"two_materials", "two uniform materials side by side, each with its equation of state",
        sides_help({})},
       make_two},
      {{"shock_at_interface",
        "a shock in the left material runs to the interface with the right one, at rest relative "
        "to "
        "it and at its pressure, or to a rigid wall when there is no <right>",
        sides_help({{"shock_pressure", "pressure behind the shock"},
                    {"shock_position", "position of the shock at t = 0"}})},
       make_shock},
      {{"noh",
        "cold gas running onto a plane, axis or point",
        {dimension_help,
         {"gamma", "ratio of specific heats (5/3)"},
         density_help,
         {"speed", "speed of the inflow (1)"},
         pressure_help,
         origin_help,
         axis_help}},
       make_noh},
      {{"sedov",
        "point blast in a cold gas",
        {dimension_help,
         gamma_help,
         density_help,
         {"energy", "released: both sides of a plane, per length of an axis, in all"},
         pressure_help,
         origin_help,
         axis_help}},
       make_sedov},
      {{"isentropic_vortex",
        "vortex carried by a uniform stream (Shu)",
        {{"strength", "circulation parameter (5)"},
         gamma_help,
         velocity_help,
         origin_help,
         {"period", "period of the square domain (0: not periodic)"}}},
       make_isentropic_vortex},
      {{"gresho",
        "steady triangular vortex of peak speed 1",
        {{"mach", "Mach number of the peak speed"}, gamma_help, origin_help}},
       make_gresho},
      {{"radial",
        "reference run with plane, cylindrical or spherical symmetry, cells moving with the gas",
        {dimension_help,
         gamma_help,
         {"low", "lower end (0)"},
         {"high", "upper end"},
         {"cells", "number of cells of the reference run (2000)"},
         {"cfl", "CFL number of the reference run (0.8)"},
         {"outflow", "1: open upper end, 0: wall (0)"},
         {"states", "density, velocity, pressure of each piece in turn"},
         {"edges", "positions of the edges between the pieces (none)"},
         {"deposit_energy",
          "internal energy on top, spread as exp(-(r/deposit_radius)^2): both sides of a plane, "
          "per "
          "length of an axis, in all (0)"},
         {"deposit_radius", "radius of the deposit (1)"},
         origin_help,
         axis_help}},
       make_radial},
      {{"uniform", "uniform flow", {density_help, velocity_help, pressure_help, gamma_help}},
       make_uniform},
      {{"advected_wave",
        "density wave at uniform velocity and pressure",
        {density_help, velocity_help, pressure_help, gamma_help, amplitude_help, wave_vector_help,
         origin_help}},
       make_wave<AdvectedWave>},
      {{"sound_wave",
        "linear sound wave",
        {density_help, velocity_help, pressure_help, gamma_help, amplitude_help, wave_vector_help,
         sense_help, origin_help}},
       make_wave<SoundWave>},
      {{"simple_wave",
        "nonlinear sound wave of one family, until it breaks",
        {density_help, velocity_help, pressure_help, gamma_help, amplitude_help, wave_vector_help,
         sense_help, origin_help}},
       make_wave<SimpleWave>},
      {{"vortex_ring",
        "manufactured motion of a ring whose circles turn there and back",
        {{"amplitude", "amplitude of the angle, in radians at the mean radius (1)"}}},
       make_vortex_ring},
      {{"axis_aligned",
        "manufactured vibration of a cube along its axes",
        {{"amplitude", "amplitude of the displacement (0.05)"},
         {"speed", "speed of waves, two over the period"},
         {"directions", "number of directions that move, 1 to 3 (3)"}}},
       make_axis_aligned},
      {{"hydrostatic",
        "gas at rest in gravity, its state given at the origin",
        {density_help,
         velocity_help,
         pressure_help,
         gamma_help,
         {"gravity", "vector"},
         {"isothermal", "1: one temperature, 0: one density (1)"},
         origin_help}},
       make_hydrostatic},
  };
  return all;
}

}  // namespace

const std::vector<SolutionHelp>& exact_solution_help() {
  static const std::vector<SolutionHelp> help = [] {
    std::vector<SolutionHelp> out;
    for (const auto& kind : kinds()) out.push_back(kind.help);
    return out;
  }();
  return help;
}

std::unique_ptr<ExactSolution> make_exact_solution(SolutionParameters parameters) {
  std::string known;
  for (const auto& kind : kinds()) {
    if (kind.help.type == parameters.type()) {
      auto made = kind.make(parameters);
      parameters.refuse_unused();
      return made;
    }
    known += (known.empty() ? "" : ", ") + kind.help.type;
  }
  throw InputError(fmt::format("there is no exact solution of type '{}'; known are: {}",
                               parameters.type(), known));
}

}  // namespace sluice::exact
