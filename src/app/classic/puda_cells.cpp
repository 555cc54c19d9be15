// puda -pic and -pol: the numbers of the particles in a cell, and means over the particles of each
// cell of a line. Both write a file for each output.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "app/classic/puda.hpp"
#include "framework/archive/particle_table.hpp"
#include "mpm/material/base/tensor.hpp"

namespace sluice {
namespace {

std::ofstream open_file(const std::string& name) {
  std::ofstream file(name);
  if (!file) throw SystemError("cannot write " + name);
  return file;
}

// Particles of the levels whose numbering has this cell.
std::vector<std::pair<PatchParticles, std::size_t>> particles_in(const ArchiveStep& step,
                                                                 ParticleLists& lists, int material,
                                                                 IntVec3 cell) {
  std::vector<std::pair<PatchParticles, std::size_t>> found;
  for (const PatchParticles& p : particles_by_patch(step, material))
    for (const std::size_t n : p.places)
      if (cell_of(step.grid().levels[p.level], lists.position(p, n)) == cell)
        found.emplace_back(p, n);
  return found;
}

// Pressure and equivalent stress.
std::vector<double> split_stress(const std::vector<double>& s) {
  mpm::Matrix matrix{};
  std::copy(s.begin(), s.end(), matrix.begin());
  const mpm::Symmetric symmetric = mpm::symmetric(matrix), d = mpm::deviator(symmetric);
  return {-mpm::trace(symmetric) / 3, std::sqrt(1.5 * mpm::double_dot(d, d))};
}

}  // namespace

void puda_particles_in_cell(const Archive& archive, const PudaRequest& request, IntVec3 cell) {
  need_variable(archive, particle_id_name);
  const OutputRange& range = request.outputs;
  for (std::size_t t = range.first; t <= range.last; t += range.step) {
    const StepEntry& entry = archive.outputs()[t];
    fmt::print("time = {}\n", number_text(entry.time, 8));
    const ArchiveStep step = archive.read_output(entry);
    ParticleLists lists(step);
    std::ofstream file = open_file(
        fmt::format("partIds.index.{}.{}.{}.time.{:04}", cell.x, cell.y, cell.z, t / range.step));
    for (const auto& [p, n] : particles_in(step, lists, std::max(request.material, 0), cell))
      file << lists.integers(particle_id_name, p)[n] << '\n';
  }
}

void puda_particles_on_line(const Archive& archive, const PudaRequest& request,
                            const ParticleLine& line) {
  const VariableEntry& variable = need_variable(archive, request.particle_variable);
  if (variable.centring != Centring::particle)
    throw InputError(fmt::format("-pol: {} is a variable of the grid", variable.name));
  if (line.split_stress && component_count(variable.type) != 9)
    throw InputError(fmt::format("-pol: {} is no tensor, and cannot be split", variable.name));
  const OutputRange& range = request.outputs;
  const int d = line.axis, e = d == 0 ? 1 : 0, f = d == 2 ? 1 : 2;
  for (std::size_t t = range.first; t <= range.last; t += range.step) {
    const StepEntry& entry = archive.outputs()[t];
    fmt::print("time = {}\n", number_text(entry.time, 8));
    const ArchiveStep step = archive.read_output(entry);
    ParticleLists lists(step);
    std::ofstream file = open_file(fmt::format(
        "{}axis.{}.at.{}.{}.time.{:04}", line.average ? "particleAverage." : "particleSingle.",
        "xyz"[d], line.first, line.second, t / range.step));
    IntVec3 cell;
    cell[e] = line.first;
    cell[f] = line.second;
    const IndexBox& domain = step.grid().levels.front().domain;
    for (cell[d] = domain.lower[d]; cell[d] < domain.upper[d]; ++cell[d]) {
      auto found = particles_in(step, lists, std::max(request.material, 0), cell);
      if (!line.average && found.size() > 1) found.resize(1);
      std::vector<double> mean(component_count(variable.type), 0.0);
      for (const auto& [p, n] : found)
        for (std::size_t c = 0; c < mean.size(); ++c)
          mean[c] += lists.values(variable.name, p)[c][n] / static_cast<double>(found.size());
      if (line.split_stress) mean = split_stress(mean);
      file << fmt::format("{}\t{}\t{}", cell.x, cell.y, cell.z);
      if (found.empty())
        file << (line.split_stress ? "\t0\t0" : "\t0");
      else if (mean.size() == 3)
        file << fmt::format("\t {:g} {:g} {:g} ", mean[0], mean[1], mean[2]);
      else
        for (std::size_t c = 0; c < mean.size(); ++c)
          file << fmt::format("{}{:g}", c == 0 || line.split_stress ? "\t" : " ", mean[c]);
      file << '\n';
    }
  }
}

}  // namespace sluice
