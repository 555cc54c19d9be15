// partvarRange: least and largest value of each variable of particles over all outputs; of vectors
// and tensors of their magnitude.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/classic/classic_archive.hpp"
#include "app/classic/classic_tools.hpp"

namespace sluice {
namespace {

ClassicSpec range_spec() {
  return {"partvarRange",
          "[options] <archive>",
          {{"-h -help", "", "this text"}, {"-mat", "<int>", "the material (0)"}}};
}

struct ValueRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

ValueRange range_of(const Archive& archive, const VariableEntry& variable, int material) {
  ValueRange range;
  for (const StepEntry& entry : archive.outputs()) {
    const ArchiveStep step = archive.read_output(entry);
    for (const FieldInfo& f : step.particle_fields()) {
      if (f.name != variable.name || f.material != material) continue;
      const auto lists = step.read_particles(f);
      for (std::size_t n = 0; n < lists.front().size(); ++n) {
        double square = 0;
        for (const std::vector<double>& component : lists) square += component[n] * component[n];
        range.add(lists.size() == 1 ? lists[0][n] : std::sqrt(square));
      }
    }
  }
  return range;
}

}  // namespace

int run_partvar_range(const ClassicCall& call) {
  const ClassicArguments arguments(range_spec(), call.words);
  if (call.words.empty() || arguments.has("-h")) {
    fmt::print(stderr, "{}", usage_of(range_spec()));
    return 1;
  }
  const Archive archive = Archive::open(arguments.only_positional("archive"));
  const int material = arguments.integer("-mat", 0);
  for (const VariableEntry& v : archive.index().variables) {
    // Positions and numbers have no range that is of use.
    if (v.centring != Centring::particle || !v.readable || v.name == "p.x" ||
        v.type == ValueType::long_integer)
      continue;
    const ValueRange range = range_of(archive, v, material);
    if (range.low > range.high)
      fmt::print(stderr, "{}: material {} has no particles\n", v.name, material);
    else
      fmt::print("{} min = {} max = {}\n", v.name, value_text(v.type, range.low, 8),
                 value_text(v.type, range.high, 8));
  }
  return 0;
}

}  // namespace sluice
