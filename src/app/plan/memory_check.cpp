// Peaks of the plan against what the machines have.
#include "app/plan/memory_check.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <map>
#include <sstream>

#include "app/plan/planned_memory.hpp"
#include "app/plan/planned_particles.hpp"
#include "framework/base/communicator.hpp"
#include "framework/base/console.hpp"
#include "framework/base/memory.hpp"

namespace sluice {
namespace {

std::string host_name() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "localhost";
}

struct Machine {
  int ranks = 0;
  double bytes = 0;  // the least that one of its ranks found available; 0: not known
  std::string limit;
};

std::map<std::string, Machine> machines(Communicator& ranks) {
  const AvailableMemory own = available_memory();
  std::map<std::string, Machine> all;
  for (const std::string& said :
       ranks.gather_to_all(fmt::format("{} {} {}", host_name(), own.bytes, own.limit))) {
    std::istringstream words(said);
    std::string host;
    double bytes = 0;
    words >> host >> bytes;
    Machine& machine = all[host];
    if (machine.ranks++ == 0 || bytes < machine.bytes) {
      machine.bytes = bytes;
      std::getline(words >> std::ws, machine.limit);
    }
  }
  return all;
}

// Of the run, on all ranks: what its fields and particles take at the least.
double bytes_of_all(const LoadedScene& loaded, const PlannedParticles& particles, int ranks,
                    int threads, IntVec3 block) {
  // Levels that a regridder would make are not found.
  const PlannedHierarchy hierarchy = plan_hierarchy(loaded, ranks, threads, 0);
  const PlannedMemory memory = plan_memory({.scene = loaded.scene,
                                            .component = *loaded.component,
                                            .hierarchy = hierarchy,
                                            .ranks = ranks,
                                            .threads = threads,
                                            .block = block,
                                            .stored = {},
                                            .computed = {},
                                            .materials = {}})
                                   .first;
  return memory.all_ranks + particles.bytes();
}

std::string particle_memory(const PlannedParticles& particles) {
  std::int64_t count = 0;
  for (const PlannedKind& k : particles.kinds) count += k.count;
  if (count == 0) return "";
  return fmt::format(" ({} of it for {} particles)", human_bytes(particles.bytes()),
                     human_count(count));
}

}  // namespace

void require_memory(const LoadedScene& loaded, Communicator& ranks, int threads, IntVec3 block) {
  const PlannedParticles particles = count_particles(loaded);
  const double all = bytes_of_all(loaded, particles, ranks.size(), threads, block);
  for (const auto& [host, machine] : machines(ranks)) {
    const double here = all * machine.ranks / ranks.size();
    if (machine.bytes == 0 || here <= machine.bytes) continue;
    throw InputError(fmt::format(
        "the run needs {} of memory at its peak{}, but {} are {}{}\n  use larger cells, fewer "
        "particles per cell (res), or more machines; --any-memory starts it nevertheless",
        human_bytes(all), particle_memory(particles), human_bytes(machine.bytes), machine.limit,
        machine.ranks < ranks.size()
            ? fmt::format(", of {} for the {} ranks on {}", human_bytes(here), machine.ranks, host)
            : ""));
  }
}

}  // namespace sluice
