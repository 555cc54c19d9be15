// puda -varsummary: least and largest values of every variable, by patch, and by level at the end.
//
// Of vectors the magnitudes of least and largest components are printed, of tensors the norms.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/classic/puda.hpp"

namespace sluice {
namespace {

constexpr int summary_digits = 16;

using Values = std::vector<double>;  // components of one value

double norm_of(const Values& v) {
  double sum = 0;
  for (const double c : v) sum += c * c;
  return std::sqrt(sum);
}

// Component by component; a tensor as a whole, by its norm.
struct Extremes {
  Values least, largest;
  IntVec3 place_least{}, place_largest{};
  std::int64_t times_least = 0, times_largest = 0;
  bool any = false;

  void add(const Values& v, IntVec3 at = {}) {
    if (!any) {
      *this = {v, v, at, at, 1, 1, true};
      return;
    }
    if (v == least) ++times_least;
    if (v == largest) ++times_largest;
    if (v.size() == 9) {
      if (norm_of(v) < norm_of(least)) least = v;
      if (norm_of(v) > norm_of(largest)) largest = v;
      return;
    }
    if (less(v, least)) {
      place_least = at;
      times_least = 1;
    }
    if (less(largest, v)) {
      place_largest = at;
      times_largest = 1;
    }
    for (std::size_t c = 0; c < v.size(); ++c) {
      least[c] = std::min(least[c], v[c]);
      largest[c] = std::max(largest[c], v[c]);
    }
  }
  void merge(const Extremes& other) {
    if (!other.any) return;
    add(other.least);
    add(other.largest);
  }

 private:
  static bool less(const Values& a, const Values& b) {
    return a.size() == 1 ? a[0] < b[0] : norm_of(a) < norm_of(b);
  }
};

class SummaryPrinter {
 public:
  SummaryPrinter(const Archive& archive, const PudaRequest& request)
      : archive_(archive), request_(request) {}

  void print_output(std::size_t t) {
    const StepEntry& entry = archive_.outputs()[t];
    fmt::print("----------------------------------------------------------------------\n");
    fmt::print("Time = {}\n\n", number_text(entry.time, summary_digits));
    const ArchiveStep step = archive_.read_output(entry);
    all_.clear();
    for (const VariableEntry& v : archive_.index().variables)
      if (v.readable) print_variable(step, v);
    fmt::print("Global Min/Max are:\n\n");
    for (const auto& [name, levels] : all_) {
      fmt::print("{}: {}", name, levels.begin()->second.least.size() == 9 ? "" : "\n");
      for (const auto& [level, extremes] : levels) print_level(level, extremes);
    }
    fmt::print("\n");
  }

 private:
  template <class... Args>
  void say(fmt::format_string<Args...> format, Args&&... args) const {
    if (!request_.brief) fmt::print(format, std::forward<Args>(args)...);
  }

  void print_variable(const ArchiveStep& step, const VariableEntry& v) {
    type_ = v.type;
    say("\tVariable: {}, type {}\n", v.name, v.type_name);
    const bool particles = v.centring == Centring::particle;
    const auto of_particles =
        particles ? particles_by_patch(step, -1) : std::vector<PatchParticles>();
    ParticleLists lists(step);
    for (const Level& level : step.grid().levels) {
      say("\t    Level: {}, id {}\n", level.index, step.level_id(level.index));
      for (std::size_t p = 0; p < level.boxes.size(); ++p) {
        say("\t\tPatch: {}\n", step.patches().at(level.index)[p].id);
        for (const FieldInfo& f : particles ? step.particle_fields() : step.fields()) {
          if (f.name != v.name || f.level != level.index) continue;
          if (request_.material >= 0 && f.material != request_.material) continue;
          say("\t\t\tMaterial: {}\n", f.material);
          if (particles)
            print_particles(v, f, static_cast<int>(p), of_particles, lists);
          else
            print_cells(step, v, f, p);
        }
      }
    }
  }

  void print_cells(const ArchiveStep& step, const VariableEntry& v, const FieldInfo& f,
                   std::size_t p) {
    const PatchRecord& patch = step.patches().at(f.level)[p];
    const bool extra = request_.extra_cells && v.centring == Centring::cell;
    IndexBox box = extra ? patch.outer : patch.interior;
    const IndexBox range = step.range(f, extra ? Layers::extra : Layers::interior);
    const IntVec3 closing = closing_layers(v.centring);
    for (int d = 0; d < 3; ++d)
      if (closing[d] > 0 && box.upper[d] == range.upper[d] - 1) ++box.upper[d];
    say("\t\t\t\t{} over {} (inclusive) to {} (exclusive)\n", v.type_name, index_text(box.lower),
        index_text(box.upper));
    const DenseField field = step.read(f, box, extra ? Layers::extra : Layers::interior);
    Extremes found;
    Values value(field.components.size());
    for_each_cell(box, [&](IntVec3 c) {
      if (!field.has(c)) return;
      for (std::size_t m = 0; m < value.size(); ++m) value[m] = field.at(c, static_cast<int>(m));
      found.add(value, c);
    });
    print_found(v, f, found, true);
  }

  void print_particles(const VariableEntry& v, const FieldInfo& f, int patch,
                       const std::vector<PatchParticles>& of_particles, ParticleLists& lists) {
    Extremes found;
    std::size_t count = 0;
    for (const PatchParticles& p : of_particles) {
      if (p.level != f.level || p.patch != patch || p.material != f.material) continue;
      count = p.places.size();
      const auto& lists_of = lists.values(v.name, p);
      Values value(lists_of.size());
      for (const std::size_t n : p.places) {
        for (std::size_t m = 0; m < value.size(); ++m) value[m] = lists_of[m][n];
        found.add(value);
      }
    }
    say("\t\t\t\t{} over {} particles\n", v.type_name, count);
    print_found(v, f, found, false);
  }

  void print_found(const VariableEntry& v, const FieldInfo& f, Extremes found, bool placed) {
    if (!found.any) return;
    all_[fmt::format("{} (matl: {})", v.name, f.material)][f.level].merge(found);
    const auto text = [&](const Values& x) { return value_text(type_, x, summary_digits); };
    if (found.least.size() == 9) {
      say("\t\t\t\tMin Norm: {}\n\t\t\t\tMax Norm: {}\n",
          number_text(norm_of(found.least), summary_digits),
          number_text(norm_of(found.largest), summary_digits));
      return;
    }
    if (v.type == ValueType::vector) {
      double low = norm_of(found.least), high = norm_of(found.largest);
      if (low > high) {
        std::swap(low, high);
        std::swap(found.place_least, found.place_largest);
        std::swap(found.times_least, found.times_largest);
      }
      say("\t\t\t\tmin magnitude: {}\n\t\t\t\tmax magnitude: {}\n",
          number_text(low, summary_digits), number_text(high, summary_digits));
    } else {
      say("\t\t\t\tmin value: {}\n\t\t\t\tmax value: {}\n", text(found.least), text(found.largest));
    }
    if (!placed) return;
    say("\t\t\t\tmin location: {} (Occurrences: ~{})\n", index_text(found.place_least),
        found.times_least);
    say("\t\t\t\tmax location: {} (Occurrences: ~{})\n", index_text(found.place_largest),
        found.times_largest);
  }

  void print_level(int level, const Extremes& e) const {
    if (e.least.size() == 9)
      return fmt::print("Level {}: Min/Max: {}, {}\n", level,
                        number_text(norm_of(e.least), summary_digits),
                        number_text(norm_of(e.largest), summary_digits));
    // Of whole numbers too: the table does not keep types.
    const auto text = [&](const Values& x) {
      if (x.size() == 3) return vector_text({x[0], x[1], x[2]}, summary_digits);
      return number_text(x[0], summary_digits);
    };
    fmt::print("   Level {}: Min/Max: {}, {}\n", level, text(e.least), text(e.largest));
  }

  const Archive& archive_;
  const PudaRequest& request_;
  ValueType type_ = ValueType::real;
  std::map<std::string, std::map<int, Extremes>> all_;  // by variable and material, by level
};

}  // namespace

void puda_summary(const Archive& archive, const PudaRequest& request) {
  fmt::print("There are {} variables:\n", archive.index().variables.size());
  for (const VariableEntry& v : archive.index().variables)
    fmt::print("  {}: {}\n", v.name, v.type_name);
  fmt::print("\nThere are {} timesteps:\n", archive.outputs().size());
  for (const StepEntry& s : archive.outputs())
    fmt::print("  {}: {}\n", s.step, number_text(s.time, summary_digits));
  fmt::print("\n");
  SummaryPrinter printer(archive, request);
  for (std::size_t t = request.outputs.first; t <= request.outputs.last; ++t)
    printer.print_output(t);
}

}  // namespace sluice
