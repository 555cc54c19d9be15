// Pairing steps and fields of two archives and comparing value by value.
#include "framework/archive/compare/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "framework/archive/compare/compare_means.hpp"
#include "framework/archive/compare/field_pairs.hpp"
#include "framework/archive/compare/particle_pairs.hpp"
#include "framework/archive/compare/step_log.hpp"
#include "framework/base/error.hpp"
#include "framework/field/component_name.hpp"

namespace sluice {
namespace {

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

std::string grid_mismatch(const Grid& a, const Grid& b, bool same_count) {
  if (same_count && a.levels.size() != b.levels.size())
    return fmt::format("{} and {} levels", a.levels.size(), b.levels.size());
  for (std::size_t l = 0; l < std::min(a.levels.size(), b.levels.size()); ++l)
    if (std::string why = grid_mismatch(a.levels[l], b.levels[l]); !why.empty())
      return fmt::format("level {}: {}", l, why);
  return "";
}

class StepComparison {
 public:
  StepComparison(const ArchiveStep& a, const ArchiveStep& b, const CompareOptions& options,
                 std::map<int, ParticlePairing>& pairings, CompareResult& result)
      : a_(a),
        b_(b),
        options_(options),
        pairings_(pairings),
        result_(result),
        across_(a.storage().format != b.storage().format),
        log_(a.info(), across_, options, result) {}

  void run() {
    if (options_.means && !same_cells()) return run_means();
    if (const std::string why = grid_mismatch(a_.grid(), b_.grid(), !across_); !why.empty())
      return log_.refuse("the grids differ", ": " + why);
    std::set<const FieldInfo*> seen;
    for (const FieldInfo& f : a_.fields()) {
      if (!options_.labels.selects(f.name)) continue;
      const FieldInfo* other = counterpart(f);
      seen.insert(other);
      if (!other)
        log_.only_one("only the first has " + missing_in(b_, f));
      else if (other->type != f.type || other->centring != f.centring)
        log_.only_one(fmt::format("{} has another type or centring in each", describe(f)));
      else
        compare_field(f, *other);
    }
    for (const FieldInfo& f : b_.fields())
      if (options_.labels.selects(f.name) && !seen.contains(&f))
        log_.only_one("only the second has " + missing_in(a_, f));
    compare_particles();
  }

 private:
  bool same_cells() const {
    const Grid &a = a_.grid(), &b = b_.grid();
    return !grids_differ(a, b) && !grids_differ(b, a) && a.levels.size() == b.levels.size();
  }

  void run_means() {
    try {
      compare_means(a_, b_, options_, log_);
    } catch (const InputError& error) {
      log_.refuse("the grids differ", fmt::format(": {}", error.what()));
    }
  }

  // The label alone where the other step does not have it at all.
  std::string missing_in(const ArchiveStep& other, const FieldInfo& f) const {
    for (const std::string& name :
         across_ ? names_elsewhere(f.name, options_.names) : std::vector<std::string>{f.name})
      for (const FieldInfo& o : other.fields())
        if (o.name == name) return describe(f);
    return f.name;
  }

  const FieldInfo* counterpart(const FieldInfo& f) const {
    if (!across_) return b_.find(f.name, f.material, f.level);
    for (const std::string& name : names_elsewhere(f.name, options_.names))
      if (const FieldInfo* other = b_.find(name, f.material, f.level)) return other;
    return nullptr;
  }

  void compare_field(const FieldInfo& fa, const FieldInfo& fb) {
    const DenseField x = a_.read(fa), y = b_.read(fb);
    FieldDifference found;
    Difference where = difference_in(fa);
    std::int64_t only_first = 0, only_second = 0;
    for_each_cell(bounding(x.cells, y.cells), [&](IntVec3 c) {
      if (x.has(c) != y.has(c)) {
        if (only_first + only_second == 0 && !across_)
          log_.refuse(describe(fa) + ": only one archive holds a value",
                      fmt::format(" at [{}, {}, {}], the {}", c.x, c.y, c.z,
                                  x.has(c) ? "first" : "second"));
        ++(x.has(c) ? only_first : only_second);
      } else if (x.has(c)) {
        where.index = c;
        for (where.component = 0; where.component < where.components; ++where.component)
          log_.compare_values(where, x.at(c, where.component), y.at(c, where.component), found);
      }
    });
    if (across_ && only_first + only_second > 0)
      log_.only_one(
          fmt::format("{} at step {}: {} values are only in the first, {} only in the second",
                      describe(fa), a_.info().step, only_first, only_second));
    log_.keep(found);
  }

  void compare_particles() {
    std::vector<int> materials = particle_materials(a_);
    for (const int m : particle_materials(b_))
      if (std::find(materials.begin(), materials.end(), m) == materials.end())
        materials.push_back(m);
    // Labels are chosen below: another name may be selected in the other archive.
    const LabelFilter labels = across_ ? LabelFilter{} : options_.labels;
    for (const int m : materials)
      compare_particles(read_particles(a_, m, labels), read_particles(b_, m, labels));
  }

  void compare_particles(const ParticleTable& x, const ParticleTable& y) {
    const bool by_place = !(x.numbered && y.numbered) && !same_patches();
    const ParticlePairs pairs = across_ || by_place ? pair_across(x, y) : pair_same(x, y);
    if (pairs.places.empty() && x.size() + y.size() > 0) return;
    std::set<const ParticleColumn*> seen;
    for (const ParticleColumn& a : x.columns) {
      if (!options_.labels.selects(a.info.name)) continue;
      const ParticleColumn* b = counterpart(a.info.name, y);
      seen.insert(b);
      if (b == nullptr || b->info.type != a.info.type) {
        log_.only_one(b == nullptr ? "only the first has " + describe(a.info)
                                   : describe(a.info) + " has another type in each");
        continue;
      }
      FieldDifference found;
      Difference where = difference_in(a.info);
      const bool of_second = !x.numbered && y.numbered;
      for (std::size_t c = 0; c < a.components.size(); ++c)
        for (const auto& [n, m] : pairs.places) {
          where.component = static_cast<int>(c);
          where.particle = of_second ? y.ids[m] : x.ids[n];
          log_.compare_values(where, a.components[c][n], b->components[c][m], found);
        }
      log_.keep(found);
    }
    for (const ParticleColumn& b : y.columns)
      if (options_.labels.selects(b.info.name) && !seen.contains(&b))
        log_.only_one(fmt::format("only the second has {}", describe(b.info)));
  }

  const ParticleColumn* counterpart(const std::string& name, const ParticleTable& other) const {
    if (!across_) return other.find(name);
    for (const std::string& n : names_elsewhere(name, options_.names))
      if (const ParticleColumn* column = other.find(n)) return column;
    return nullptr;
  }

  // Particles without numbers come in the order of patches.
  bool same_patches() const {
    const auto& a = a_.grid().levels;
    const auto& b = b_.grid().levels;
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Level& l, const Level& m) {
      return std::equal(l.boxes.begin(), l.boxes.end(), m.boxes.begin(), m.boxes.end(),
                        [](const GridBox& p, const GridBox& q) { return p.cells == q.cells; });
    });
  }

  // Both have the same particles, else they cannot be compared.
  ParticlePairs pair_same(const ParticleTable& x, const ParticleTable& y) {
    ParticlePairs pairs;
    pairs.by_number = true;
    const auto [in_x, in_y] = std::mismatch(x.ids.begin(), x.ids.end(), y.ids.begin(), y.ids.end());
    if (in_x != x.ids.end() || in_y != y.ids.end()) {
      const bool first = in_y == y.ids.end() || (in_x != x.ids.end() && *in_x < *in_y);
      log_.refuse(fmt::format("the particles of material {} are not the same", x.material),
                  fmt::format(": {} and {}; only the {} has particle {}", x.size(), y.size(),
                              first ? "first" : "second", first ? *in_x : *in_y));
      return pairs;
    }
    for (std::size_t n = 0; n < x.size(); ++n) pairs.places.emplace_back(n, n);
    return pairs;
  }

  ParticlePairs pair_across(const ParticleTable& x, const ParticleTable& y) {
    ParticlePairs pairs = pairings_[x.material].pair(x, y);
    const std::string how = pairs.by_number
                                ? "by number"
                                : fmt::format("by place, at most {:.3g} apart", pairs.farthest);
    if (x.size() + y.size() > 0)
      result_.notes.push_back(
          fmt::format("particles of material {} at step {}: {} of {} and {} paired {}", x.material,
                      a_.info().step, pairs.places.size(), x.size(), y.size(), how));
    return pairs;
  }

  const ArchiveStep &a_, &b_;
  const CompareOptions& options_;
  std::map<int, ParticlePairing>& pairings_;  // by material
  CompareResult& result_;
  const bool across_;  // two formats
  StepLog log_;
};

}  // namespace

double Difference::size() const {
  const double d = std::abs(a - b);
  return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
}

double Difference::relative() const {
  const double scale = std::max(std::abs(a), std::abs(b));
  const double r = size() / scale;
  return std::isnan(r) ? std::numeric_limits<double>::infinity() : r;
}

std::string to_string(const RefusedCause& r) {
  const std::string others = r.steps > 1 ? fmt::format(" and {} more", r.steps - 1) : "";
  return fmt::format("step {} at time {:.17g}{}: {}{}", r.step, r.time, others, r.cause, r.detail);
}

std::string to_string(const Difference& d) {
  const char* const component = component_name(d.components, d.component);
  const std::string place = d.particle >= 0 ? fmt::format(", particle {}", d.particle)
                                            : fmt::format(" on level {}{} at [{}, {}, {}]", d.level,
                                                          d.of_second ? " of the second" : "",
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

std::vector<FieldDifference> differences_by_label(const CompareResult& result) {
  std::map<std::tuple<std::string, int, int>, FieldDifference> all;
  for (const FieldDifference& f : result.fields) {
    const Difference& d = f.first;
    const auto [at, is_new] = all.try_emplace({d.label, d.material, f.means ? -1 : d.level}, f);
    if (is_new) continue;
    FieldDifference& row = at->second;
    row.differing += f.differing;
    row.values += f.values;
    if (f.largest.size() > row.largest.size()) row.largest = f.largest;
    if (f.largest_relative.relative() > row.largest_relative.relative())
      row.largest_relative = f.largest_relative;
  }
  std::vector<FieldDifference> rows;
  for (auto& [key, row] : all) rows.push_back(std::move(row));
  return rows;
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
  const bool c = options.checkpoints, across = a.format() != b.format();
  const auto& of_a = c ? a.checkpoints() : a.outputs();
  const auto& of_b = c ? b.checkpoints() : b.outputs();
  result.paired = across || options.time_tolerance
                      ? pair_nearest_steps(of_a, of_b, options.time_tolerance, result.notes)
                      : pair_steps(of_a, of_b, options, result.not_comparable);
  std::map<int, ParticlePairing> pairings;
  for (const auto& [x, y] : result.paired) {
    const ArchiveStep sa = c ? a.read_checkpoint(x) : a.read_output(x);
    const ArchiveStep sb = c ? b.read_checkpoint(y) : b.read_output(y);
    StepComparison(sa, sb, options, pairings, result).run();
  }
  for (const RefusedCause& cause : result.refused)
    result.not_comparable.push_back(to_string(cause));
  if (result.values == 0 && result.not_comparable.empty())
    result.not_comparable.push_back("they have no value in common");
  return result;
}

}  // namespace sluice
