// selectpart: the particles in a box.
#include <fmt/format.h>

#include "app/classic/classic_archive.hpp"
#include "app/classic/classic_tools.hpp"
#include "framework/archive/particle_table.hpp"

namespace sluice {
namespace {

ClassicSpec select_spec() {
  return {"selectpart",
          "[options] <archive>",
          {{"-h -help", "", "this text"},
           {"-box", "<xmin> <ymin> <zmin> <xmax> <ymax> <zmax>", "the box (0 0 0 1 1 1)"},
           {"-mat", "<int>", "only this material"},
           {"-timesteplow", "<int>", "from this output on, counted from 0"},
           {"-timestephigh", "<int>", "up to this output"},
           {"-timestepinc", "<int>", "every n-th output"}}};
}

constexpr int selected_digits = 8;

bool holds(Vec3 low, Vec3 high, Vec3 p) {
  for (int d = 0; d < 3; ++d)
    if (!(p[d] >= low[d] && p[d] <= high[d])) return false;
  return true;
}

}  // namespace

int run_select_part(const ClassicCall& call) {
  const ClassicArguments arguments(select_spec(), call.words);
  if (call.words.empty() || arguments.has("-h")) {
    fmt::print(stderr, "{}", usage_of(select_spec()));
    return 1;
  }
  const Archive archive = Archive::open(arguments.only_positional("archive"));
  need_variable(archive, particle_position_name);
  need_variable(archive, particle_id_name);
  const OutputRange range =
      outputs_asked(arguments, archive, {"", "-timesteplow", "-timestephigh", "-timestepinc"});
  const int material = arguments.integer("-mat", -1);
  const Vec3 low = arguments.reals("-box").value_or(Vec3{});
  const Vec3 high = arguments.reals("-box", 3).value_or(Vec3{1, 1, 1});
  fmt::print(stderr, "Selection box = {}..{}\n", point_text(low, selected_digits),
             point_text(high, selected_digits));
  for (std::size_t t = range.first; t <= range.last; t += range.step) {
    const StepEntry& entry = archive.outputs()[t];
    const ArchiveStep step = archive.read_output(entry);
    ParticleLists lists(step);
    for (const PatchParticles& p : particles_by_patch(step, material))
      for (const std::size_t n : p.places) {
        const Vec3 x = lists.position(p, n);
        if (!holds(low, high, x)) continue;
        fmt::print("{} {} {} {} {} {} {}\n", number_text(entry.time, selected_digits), p.patch + 1,
                   p.material, lists.integers(particle_id_name, p)[n],
                   number_text(x.x, selected_digits), number_text(x.y, selected_digits),
                   number_text(x.z, selected_digits));
      }
  }
  return 0;
}

}  // namespace sluice
