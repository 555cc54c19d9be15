// partextract: variables, stresses or strains of particles, or of one of them, over the outputs.
#include <fmt/format.h>

#include <cmath>

#include "app/classic/classic_archive.hpp"
#include "app/classic/classic_tools.hpp"
#include "framework/archive/particle_table.hpp"
#include "mpm/material/base/tensor.hpp"

namespace sluice {
namespace {

ClassicSpec part_spec() {
  return {"partextract",
          "[options] <archive>",
          {{"-h -help", "", "this text"},
           {"-mat", "<int>", "only this material"},
           {"-partvar", "<variable>", "print this variable; may be repeated"},
           {"-partid", "<id>", "only the particle of this number"},
           {"-part_stress", "<kind>", "avg, equiv, pressure or all (six components)"},
           {"-part_strain", "<kind>", "avg, true, equiv, all, lagrangian or eulerian"},
           {"-timestep", "<int>", "only this output, counted from 0"},
           {"-timesteplow", "<int>", "from this output on"},
           {"-timestephigh", "<int>", "up to this output"},
           {"-timestepinc", "<int>", "every n-th output"},
           {"-include_position_output -positiononly", "", "the place in front of the values"}}};
}

constexpr int variable_digits = 8, tensor_digits = 6;

struct PartRequest {
  OutputRange outputs;
  int material = -1;
  std::int64_t id = 0;  // 0: all
  bool positions = false;
};

void print_header(const Archive& archive, const PartRequest& r,
                  const std::vector<std::string>& variables) {
  bool numbered = false;
  for (const VariableEntry& v : archive.index().variables)
    numbered = numbered || v.name == particle_id_name;
  std::string head =
      numbered ? "% Time patchIndex material particleID" : "% Time patchIndex material";
  if (r.positions) head += " position";
  for (const std::string& name : variables) head += ' ' + name;
  fmt::print("{}\n", head);
}

std::string position_text(ParticleLists& lists, const PatchParticles& p, std::size_t n,
                          int digits) {
  const Vec3 x = lists.position(p, n);
  return fmt::format(" {} {} {}", number_text(x.x, digits), number_text(x.y, digits),
                     number_text(x.z, digits));
}

void print_variables(const Archive& archive, const PartRequest& r,
                     const std::vector<std::string>& variables) {
  for (const std::string& name : variables)
    if (need_variable(archive, name).centring != Centring::particle)
      throw InputError(name + " is a variable of the grid; lineextract prints those");
  print_header(archive, r, variables);
  for (std::size_t t = r.outputs.first; t <= r.outputs.last; t += r.outputs.step) {
    const StepEntry& entry = archive.outputs()[t];
    const ArchiveStep step = archive.read_output(entry);
    ParticleLists lists(step);
    for (const PatchParticles& p : particles_by_patch(step, r.material)) {
      const bool numbered = lists.has(particle_id_name, p);
      if (r.id != 0 && !numbered)
        throw InputError(fmt::format("-partid: {} is not saved", particle_id_name));
      for (const std::size_t n : p.places) {
        if (r.id != 0 && lists.integers(particle_id_name, p)[n] != r.id) continue;
        std::string line = fmt::format("{} {} {}", number_text(entry.time, variable_digits),
                                       p.patch + 1, p.material);
        if (numbered) line += fmt::format(" {}", lists.integers(particle_id_name, p)[n]);
        if (r.positions) line += position_text(lists, p, n, variable_digits);
        for (const std::string& name : variables) {
          const ValueType type = lists.type(name, p);
          if (type == ValueType::long_integer) {
            line += fmt::format(" {} ", lists.integers(name, p)[n]);
            continue;
          }
          for (const std::vector<double>& component : lists.values(name, p))
            line += ' ' + value_text(type, component[n], variable_digits);
          if (component_count(type) > 1) line += ' ';
        }
        fmt::print("{}\n", line);
      }
    }
  }
}

using Tensor = mpm::Matrix;
using Numbers = std::vector<double>;

// 11 22 33 23 13 12
Numbers six_numbers(const mpm::Symmetric& s) {
  return {s.begin(), s.end()};
}

double equivalent_stress(const mpm::Symmetric& s) {
  const mpm::Symmetric d = mpm::deviator(s);
  return std::sqrt(1.5 * mpm::double_dot(d, d));
}

// (F^T F - 1) / 2
mpm::Symmetric green_lagrange(const Tensor& f) {
  const mpm::Symmetric c = mpm::symmetric(mpm::product(mpm::transposed(f), f));
  return mpm::combined(0.5, c, -0.5, mpm::symmetric(mpm::identity));
}

// (1 - (F F^T)^-1) / 2
mpm::Symmetric green_almansi(const Tensor& f) {
  const Tensor b = mpm::product(f, mpm::transposed(f));
  return mpm::combined(0.5, mpm::symmetric(mpm::identity), -0.5, mpm::symmetric(mpm::inverse(b)));
}

double equivalent_strain(const Tensor& f) {
  const mpm::Symmetric e = green_lagrange(f);
  return std::sqrt(mpm::double_dot(e, e) / 1.5);
}

// Logarithms of the stretches, the largest first.
Numbers true_strains(const Tensor& f) {
  const auto squares = mpm::principal(mpm::symmetric(mpm::product(mpm::transposed(f), f))).values;
  return {0.5 * std::log(squares[2]), 0.5 * std::log(squares[1]), 0.5 * std::log(squares[0])};
}

// F, U and R of F = R U.
Numbers deformation_numbers(const Tensor& f) {
  const mpm::Polar parts = mpm::polar(f);
  const Tensor stretch = mpm::full(parts.U);
  Numbers numbers(f.begin(), f.end());
  numbers.insert(numbers.end(), stretch.begin(), stretch.end());
  numbers.insert(numbers.end(), parts.R.begin(), parts.R.end());
  return numbers;
}

Tensor tensor_of(const std::vector<std::vector<double>>& lists, std::size_t n) {
  Tensor t;
  for (std::size_t c = 0; c < 9; ++c) t[c] = lists[c][n];
  return t;
}

// Means by volume, three rows.
void print_mean(const ArchiveStep& step, const PartRequest& r, const char* variable,
                const std::function<Tensor(const Tensor&)>& of) {
  Tensor sum{};
  double volume = 0;
  ParticleLists lists(step);
  for (const PatchParticles& p : particles_by_patch(step, r.material))
    for (const std::size_t n : p.places) {
      const double v = lists.values("p.volume", p)[0][n];
      const Tensor t = of(tensor_of(lists.values(variable, p), n));
      for (std::size_t c = 0; c < 9; ++c) sum[c] += t[c] * v;
      volume += v;
    }
  for (std::size_t row = 0; row < 3; ++row)
    fmt::print("{}  {}  {}  \n", number_text(sum[3 * row] / volume, variable_digits),
               number_text(sum[3 * row + 1] / volume, variable_digits),
               number_text(sum[3 * row + 2] / volume, variable_digits));
}

using TensorNumbers = std::function<Numbers(const Tensor&)>;

// A line for each particle: time, number, patch, material, [place,] what `numbers` returns.
void print_tensors(const Archive& archive, const PartRequest& r, const char* variable,
                   bool positions, const TensorNumbers& numbers) {
  need_variable(archive, variable);
  need_variable(archive, particle_id_name);
  for (std::size_t t = r.outputs.first; t <= r.outputs.last; ++t) {
    const StepEntry& entry = archive.outputs()[t];
    const ArchiveStep step = archive.read_output(entry);
    ParticleLists lists(step);
    for (const PatchParticles& p : particles_by_patch(step, r.material))
      for (const std::size_t n : p.places) {
        const std::int64_t id = lists.integers(particle_id_name, p)[n];
        if (r.id != 0 && id != r.id) continue;
        std::string line = fmt::format("{} {} {} {}", number_text(entry.time, tensor_digits), id,
                                       p.patch + 1, p.material);
        if (positions) line += position_text(lists, p, n, tensor_digits);
        for (const double x : numbers(tensor_of(lists.values(variable, p), n)))
          line += ' ' + number_text(x, tensor_digits);
        fmt::print("{}\n", line);
      }
  }
}

void print_stress(const Archive& archive, const PartRequest& r, const std::string& kind) {
  const auto by_kind = [&]() -> TensorNumbers {
    if (kind == "equiv")
      return [](const Tensor& s) { return Numbers{equivalent_stress(mpm::symmetric(s))}; };
    if (kind == "pressure")
      return [](const Tensor& s) { return Numbers{-mpm::trace(mpm::symmetric(s)) / 3}; };
    if (kind == "all") return [](const Tensor& s) { return six_numbers(mpm::symmetric(s)); };
    throw InputError(fmt::format("-part_stress {}: avg, equiv, pressure or all is expected", kind));
  };
  if (kind != "avg") return print_tensors(archive, r, "p.stress", r.positions, by_kind());
  need_variable(archive, "p.stress");
  need_variable(archive, "p.volume");
  fmt::print("\t Volume average stress = \n");
  for (std::size_t t = r.outputs.first; t <= r.outputs.last; ++t)
    print_mean(archive.read_output(archive.outputs()[t]), r, "p.stress",
               [](const Tensor& s) { return s; });
}

void print_strain(const Archive& archive, const PartRequest& r, const std::string& kind) {
  const auto by_kind = [&]() -> TensorNumbers {
    if (kind == "equiv") return [](const Tensor& f) { return Numbers{equivalent_strain(f)}; };
    if (kind == "true") return true_strains;
    if (kind == "lagrangian") return [](const Tensor& f) { return six_numbers(green_lagrange(f)); };
    if (kind == "eulerian") return [](const Tensor& f) { return six_numbers(green_almansi(f)); };
    if (kind == "all") return deformation_numbers;
    throw InputError(fmt::format(
        "-part_strain {}: avg, true, equiv, all, lagrangian or eulerian is expected", kind));
  };
  if (kind != "avg") return print_tensors(archive, r, "p.deformationMeasure", false, by_kind());
  need_variable(archive, "p.deformationMeasure");
  need_variable(archive, "p.volume");
  fmt::print("\t Volume average strain = \n");
  for (std::size_t t = r.outputs.first; t <= r.outputs.last; ++t)
    print_mean(archive.read_output(archive.outputs()[t]), r, "p.deformationMeasure",
               [](const Tensor& f) { return mpm::full(mpm::polar(f).U); });
}

}  // namespace

int run_part_extract(const ClassicCall& call) {
  const ClassicArguments arguments(part_spec(), call.words);
  if (call.words.empty() || arguments.has("-h")) {
    fmt::print(stderr, "{}", usage_of(part_spec()));
    return 1;
  }
  const Archive archive = Archive::open(arguments.only_positional("archive"));
  PartRequest r;
  r.outputs = outputs_asked(arguments, archive,
                            {"-timestep", "-timesteplow", "-timestephigh", "-timestepinc"});
  r.material = arguments.integer("-mat", -1);
  r.id = parse_integer(arguments.text("-partid", "0"), "-partid");
  r.positions = arguments.has("-include_position_output");
  if (arguments.has("-part_stress")) print_stress(archive, r, arguments.text("-part_stress"));
  if (arguments.has("-part_strain")) print_strain(archive, r, arguments.text("-part_strain"));
  if (arguments.has("-partvar")) print_variables(archive, r, arguments.all("-partvar"));
  return 0;
}

}  // namespace sluice
