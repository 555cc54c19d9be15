// Pairing steps and fields of two archives and comparing value by value.
#include "framework/archive/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/archive/particle_table.hpp"
#include "framework/field/component_name.hpp"

namespace sluice {
namespace {

using StepPair = std::pair<StepEntry, StepEntry>;

bool same_length(double a, double b) {
  return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b));
}

// A list of times, paired: one by one, or only those that both have.
std::vector<StepPair> pair_steps(const std::vector<StepEntry>& a, const std::vector<StepEntry>& b,
                                 const CompareOptions& o, std::vector<std::string>& problems) {
  auto differ = [&](const StepEntry& x, const StepEntry& y) {
    return numbers_differ(x.time, y.time, o.absolute, o.relative);
  };
  std::vector<StepPair> pairs;
  if (o.common_times) {
    for (const StepEntry& x : a)
      for (const StepEntry& y : b)
        if (!differ(x, y)) pairs.emplace_back(x, y);
  } else {
    if (a.size() != b.size())
      problems.push_back(fmt::format("the first has {} steps, the second {}", a.size(), b.size()));
    for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n) {
      if (differ(a[n], b[n])) {
        problems.push_back(
            fmt::format("the times of #{} differ: {:.17g} (step {}) and {:.17g} (step "
                        "{})",
                        n, a[n].time, a[n].step, b[n].time, b[n].step));
        break;
      }
      pairs.emplace_back(a[n], b[n]);
    }
  }
  if (pairs.empty() && problems.empty())
    problems.push_back(
        a.empty() && b.empty()
            ? fmt::format("neither has {}", o.checkpoints ? "a checkpoint" : "an output")
            : "they have no time in common");
  return pairs;
}

std::string grid_mismatch(const Grid& a, const Grid& b) {
  if (a.levels.size() != b.levels.size())
    return fmt::format("{} and {} levels", a.levels.size(), b.levels.size());
  for (std::size_t l = 0; l < a.levels.size(); ++l)
    if (std::string why = grid_mismatch(a.levels[l], b.levels[l]); !why.empty())
      return fmt::format("level {}: {}", l, why);
  return "";
}

class StepComparison {
 public:
  StepComparison(const ArchiveStep& a, const ArchiveStep& b, const CompareOptions& options,
                 CompareResult& result)
      : a_(a), b_(b), options_(options), result_(result) {}

  void run() {
    if (const std::string why = grid_mismatch(a_.grid(), b_.grid()); !why.empty())
      return refuse("the grids differ: " + why);
    for (const FieldInfo& f : b_.fields())
      if (options_.labels.selects(f.name) && !a_.find(f.name, f.material, f.level))
        refuse(fmt::format("only the second has {}", describe(f)));
    for (const FieldInfo& f : a_.fields()) {
      if (!options_.labels.selects(f.name)) continue;
      const FieldInfo* other = b_.find(f.name, f.material, f.level);
      if (!other)
        refuse(fmt::format("only the first has {}", describe(f)));
      else if (other->type != f.type || other->centring != f.centring)
        refuse(fmt::format("{} has another type or centring in each", describe(f)));
      else
        compare_field(f, *other);
    }
    compare_particles();
  }

 private:
  static std::string describe(const FieldInfo& f) {
    return fmt::format("{} of material {} on level {}", f.name, f.material, f.level);
  }
  void refuse(const std::string& why) {
    result_.not_comparable.push_back(
        fmt::format("step {} at time {:.17g}: {}", a_.info().step, a_.info().time, why));
  }

  void compare_field(const FieldInfo& fa, const FieldInfo& fb) {
    const DenseField x = a_.read(fa), y = b_.read(fb);
    FieldDifference found;
    bool same_cells = true;
    for_each_cell(bounding(x.cells, y.cells), [&](IntVec3 c) {
      if (x.has(c) != y.has(c)) {
        if (same_cells)
          refuse(fmt::format("{}: only the {} holds a value at [{}, {}, {}]", describe(fa),
                             x.has(c) ? "first" : "second", c.x, c.y, c.z));
        same_cells = false;
      } else if (x.has(c)) {
        for (int m = 0; m < fa.components(); ++m)
          compare_values(fa, c, m, x.at(c, m), y.at(c, m), found);
      }
    });
    keep(found);
  }

  void compare_particles() {
    std::vector<int> materials = particle_materials(a_);
    for (const int m : particle_materials(b_))
      if (std::find(materials.begin(), materials.end(), m) == materials.end())
        materials.push_back(m);
    for (const int m : materials)
      compare_particles(read_particles(a_, m, options_.labels),
                        read_particles(b_, m, options_.labels));
  }

  void compare_particles(const ParticleTable& x, const ParticleTable& y) {
    const auto [in_x, in_y] = std::mismatch(x.ids.begin(), x.ids.end(), y.ids.begin(), y.ids.end());
    if (in_x != x.ids.end() || in_y != y.ids.end()) {
      const bool first = in_y == y.ids.end() || (in_x != x.ids.end() && *in_x < *in_y);
      return refuse(fmt::format("{} and {} particles of material {}: only the {} has particle {}",
                                x.size(), y.size(), x.material, first ? "first" : "second",
                                first ? *in_x : *in_y));
    }
    for (const ParticleColumn& b : y.columns)
      if (options_.labels.selects(b.info.name) && x.find(b.info.name) == nullptr)
        refuse(fmt::format("only the second has {}", describe(b.info)));
    for (const ParticleColumn& a : x.columns) {
      if (!options_.labels.selects(a.info.name)) continue;
      const ParticleColumn* b = y.find(a.info.name);
      if (b == nullptr || b->info.type != a.info.type) {
        refuse(b == nullptr ? "only the first has " + describe(a.info)
                            : describe(a.info) + " has another type in each");
        continue;
      }
      FieldDifference found;
      for (std::size_t c = 0; c < a.components.size(); ++c)
        for (std::size_t n = 0; n < x.size(); ++n)
          compare_values(a.info, {}, static_cast<int>(c), a.components[c][n], b->components[c][n],
                         found, x.ids[n]);
      keep(found);
    }
  }

  void keep(const FieldDifference& found) {
    result_.values += found.values;
    result_.differing += found.differing;
    if (found.differing > 0) result_.fields.push_back(found);
  }

  void compare_values(const FieldInfo& f, IntVec3 c, int m, double a, double b,
                      FieldDifference& found, std::int64_t particle = -1) {
    ++found.values;
    if (!numbers_differ(a, b, options_.absolute, options_.relative)) return;
    const Difference d{
        a_.info().step, a_.info().time, f.name, f.level, f.material, m, f.components(), c, a, b,
        particle};
    if (found.differing++ == 0) found.first = found.largest = d;
    if (d.size() > found.largest.size()) found.largest = d;
  }

  const ArchiveStep &a_, &b_;
  const CompareOptions& options_;
  CompareResult& result_;
};

}  // namespace

double Difference::size() const {
  const double d = std::abs(a - b);
  return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
}

std::string to_string(const Difference& d) {
  const char* const component = component_name(d.components, d.component);
  const std::string place = d.particle >= 0 ? fmt::format(", particle {}", d.particle)
                                            : fmt::format(" on level {} at [{}, {}, {}]", d.level,
                                                          d.index.x, d.index.y, d.index.z);
  return fmt::format(
      "{}{}{} of material {}{}, step {}, time {:.17g}: {:.17g} and {:.17g}, {:.3g} apart", d.label,
      d.components > 1 ? " " : "", component, d.material, place, d.step, d.time, d.a, d.b,
      d.size());
}

std::optional<Difference> CompareResult::first() const {
  if (fields.empty()) return std::nullopt;
  return fields.front().first;
}

std::optional<Difference> CompareResult::largest() const {
  if (fields.empty()) return std::nullopt;
  return std::max_element(fields.begin(), fields.end(),
                          [](const FieldDifference& a, const FieldDifference& b) {
                            return a.largest.size() < b.largest.size();
                          })
      ->largest;
}

bool numbers_differ(double a, double b, double absolute, double relative) {
  if (a == b) return false;
  if (std::isnan(a) || std::isnan(b) || std::isinf(a) || std::isinf(b)) return true;
  const double d = std::abs(a - b);
  return d > absolute && d > relative * std::max(std::abs(a), std::abs(b));
}

std::string grid_mismatch(const Level& a, const Level& b) {
  for (int d = 0; d < 3; ++d) {
    if (!same_length(a.spacing[d], b.spacing[d]))
      return fmt::format("spacing {} and {}", triple_text(a.spacing), triple_text(b.spacing));
    // The anchors are compared in units of a cell: 0 and 1e-17 are the same place.
    if (std::abs(a.anchor[d] - b.anchor[d]) > 1e-12 * std::max(a.spacing[d], std::abs(a.anchor[d])))
      return fmt::format("anchor {} and {}", triple_text(a.anchor), triple_text(b.anchor));
    if (a.periodic[d] != b.periodic[d]) return "periodic in different directions";
  }
  if (a.domain != b.domain)
    return fmt::format("cells {} to {} and {} to {}", triple_text(a.domain.lower),
                       triple_text(a.domain.upper), triple_text(b.domain.lower),
                       triple_text(b.domain.upper));
  return "";
}

CompareResult compare(const Archive& a, const Archive& b, const CompareOptions& options) {
  CompareResult result;
  const bool c = options.checkpoints;
  for (const auto& [x, y] :
       pair_steps(c ? a.checkpoints() : a.outputs(), c ? b.checkpoints() : b.outputs(), options,
                  result.not_comparable)) {
    const ArchiveStep sa = c ? a.read_checkpoint(x) : a.read_output(x);
    const ArchiveStep sb = c ? b.read_checkpoint(y) : b.read_output(y);
    StepComparison(sa, sb, options, result).run();
    ++result.steps;
  }
  if (result.values == 0 && result.not_comparable.empty())
    result.not_comparable.push_back("they have no value in common");
  return result;
}

}  // namespace sluice
