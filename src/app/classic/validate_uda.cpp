// validateUda: whether every output and checkpoint that an index names is there and readable.
#include <fmt/format.h>

#include "app/classic/classic_arguments.hpp"
#include "app/classic/classic_tools.hpp"
#include "framework/archive/archive.hpp"

namespace sluice {
namespace {

ClassicSpec validate_spec() {
  return {"validateUda", "<archive> [<archive> ...]", {{"-h -help", "", "this text"}}};
}

template <class Open>
int count_damage(const char* kind, const std::vector<StepEntry>& entries, const Open& open) {
  int damaged = 0;
  for (const StepEntry& e : entries) {
    try {
      std::int64_t good = 0;
      for (const std::string& why : open(e).verify(good)) {
        fmt::print("  {} t{:05}: {}\n", kind, e.step, why);
        ++damaged;
      }
    } catch (const Error& error) {
      fmt::print("  {} t{:05}: {}\n", kind, e.step, error.what());
      ++damaged;
    }
  }
  return damaged;
}

// The number of faults, which are printed.
int validate(const std::string& name) {
  const Archive archive = Archive::open(name);
  fmt::print("Validating {}: {} timesteps, {} checkpoints\n", name, archive.outputs().size(),
             archive.checkpoints().size());
  int damaged = 0;
  for (const std::string& why : archive.damage()) {
    fmt::print("  {}\n", why);
    ++damaged;
  }
  damaged += count_damage("timestep", archive.outputs(),
                          [&](const StepEntry& e) { return archive.read_output(e); });
  damaged += count_damage("checkpoint", archive.checkpoints(),
                          [&](const StepEntry& e) { return archive.read_checkpoint(e); });
  if (damaged == 0)
    fmt::print("  all files are there and readable\n");
  else
    fmt::print("  {} fault{}; a damaged step is repaired by removing it from index.xml\n", damaged,
               damaged == 1 ? "" : "s");
  return damaged;
}

}  // namespace

int run_validate_uda(const ClassicCall& call) {
  const ClassicArguments arguments(validate_spec(), call.words);
  if (arguments.has("-h") || arguments.positional().empty()) {
    fmt::print(stderr, "{}", usage_of(validate_spec()));
    return 1;
  }
  int damaged = 0;
  for (const std::string& name : arguments.positional()) damaged += validate(name);
  return damaged == 0 ? 0 : 1;
}

}  // namespace sluice
