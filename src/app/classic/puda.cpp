// puda: outputs, variables, grids, ranges and particles of an archive.
#include "app/classic/puda.hpp"

#include <fmt/format.h>

#include "app/classic/classic_tools.hpp"

namespace sluice {
namespace {

ClassicSpec puda_spec() {
  return {"puda",
          "[options] <archive>",
          {{"-h -help", "", "this text"},
           {"-timesteps", "", "list the outputs and their times"},
           {"-listvariables", "", "list the variables and their types"},
           {"-gridstats", "", "print levels and patches of each output"},
           {"-varsummary", "", "print least and largest values, by patch"},
           {"-brief", "", "with -varsummary: by level only"},
           {"-partvar", "<variable>", "print a variable of all particles"},
           {"-mat -matl -material", "<int>", "only this material"},
           {"-timesteplow", "<int>", "from this output on, counted from 0"},
           {"-timestephigh", "<int>", "up to this output"},
           {"-timestepinc", "<int>", "every n-th output, for -gridstats"},
           {"-no_extra_cells", "", "with -varsummary: without the cells around the domain"},
           {"-verbose", "", "accepted, without effect"}}};
}

void print_timesteps(const Archive& archive) {
  fmt::print("There are {} timesteps:\n", archive.outputs().size());
  for (const StepEntry& s : archive.outputs())
    fmt::print("{}: {}\n", s.step, number_text(s.time, 16));
}

void print_variables(const Archive& archive) {
  fmt::print("There are {} variables:\n", archive.index().variables.size());
  for (const VariableEntry& v : archive.index().variables)
    fmt::print("{}: {}\n", v.name, v.type_name);
}

}  // namespace

int run_puda(const ClassicCall& call) {
  const ClassicArguments arguments(puda_spec(), call.words);
  if (call.words.empty() || arguments.has("-h")) {
    fmt::print(stderr, "{}", usage_of(puda_spec()));
    return 1;
  }
  const Archive archive = Archive::open(arguments.only_positional("archive"));
  if (arguments.has("-timesteps")) print_timesteps(archive);
  if (arguments.has("-listvariables")) print_variables(archive);
  const bool reads =
      arguments.has("-gridstats") || arguments.has("-partvar") || arguments.has("-varsummary");
  if (!reads) return 0;
  PudaRequest request;
  request.outputs =
      outputs_asked(arguments, archive, {"", "-timesteplow", "-timestephigh", "-timestepinc"});
  request.material = arguments.integer("-mat", -1);
  request.brief = arguments.has("-brief");
  request.extra_cells = !arguments.has("-no_extra_cells");
  request.particle_variable = arguments.text("-partvar");
  if (arguments.has("-gridstats")) puda_grid_stats(archive, request);
  if (arguments.has("-partvar")) puda_particle_variable(archive, request);
  if (arguments.has("-varsummary")) puda_summary(archive, request);
  return 0;
}

}  // namespace sluice
