// puda -partvar: a line for each particle: time, patch from 1, material, number if saved, values.
#include <fmt/format.h>

#include "app/classic/puda.hpp"
#include "framework/archive/particle_table.hpp"

namespace sluice {
namespace {

constexpr int particle_digits = 8;

}  // namespace

void puda_particle_variable(const Archive& archive, const PudaRequest& request) {
  const VariableEntry& variable = need_variable(archive, request.particle_variable);
  if (variable.centring != Centring::particle)
    throw InputError(fmt::format("-partvar {}: is a variable of the grid ({})", variable.name,
                                 variable.type_name));
  bool any_numbers = false;
  for (const VariableEntry& v : archive.index().variables)
    any_numbers = any_numbers || v.name == particle_id_name;
  if (!any_numbers && variable.type != ValueType::long_integer)
    fmt::print(stderr, "{} is not saved: particles are printed without numbers\n",
               particle_id_name);
  for (std::size_t t = request.outputs.first; t <= request.outputs.last; ++t) {
    const StepEntry& entry = archive.outputs()[t];
    const ArchiveStep step = archive.read_output(entry);
    ParticleLists lists(step);
    for (const PatchParticles& p : particles_by_patch(step, request.material)) {
      if (!lists.has(variable.name, p)) continue;
      const bool integer = variable.type == ValueType::long_integer;
      const bool numbered = !integer && lists.has(particle_id_name, p);
      for (const std::size_t n : p.places) {
        std::string line = fmt::format("{} {} {}", number_text(entry.time, particle_digits),
                                       p.patch + 1, p.material);
        if (numbered) line += fmt::format(" {}", lists.integers(particle_id_name, p)[n]);
        if (integer)
          line += fmt::format(" {}", lists.integers(variable.name, p)[n]);
        else
          for (const std::vector<double>& component : lists.values(variable.name, p))
            line += ' ' + value_text(variable.type, component[n], particle_digits);
        fmt::print("{}\n", line);
      }
    }
  }
}

}  // namespace sluice
