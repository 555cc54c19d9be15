// The table of the tools.
#include "app/classic/classic_tools.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "framework/base/error.hpp"

namespace sluice {

int run_compare_uda(const ClassicCall&);
int run_compute_lnorm(const ClassicCall&);
int run_line_extract(const ClassicCall&);
int run_part_extract(const ClassicCall&);
int run_partvar_range(const ClassicCall&);
int run_puda(const ClassicCall&);
int run_restart_merger(const ClassicCall&);
int run_select_part(const ClassicCall&);
int run_sus(const ClassicCall&);
int run_time_extract(const ClassicCall&);
int run_validate_uda(const ClassicCall&);

namespace {

constexpr ClassicTool tools[] = {
    {"sus", "Run a deck, or go on with a run", run_sus, 2},
    {"puda", "Describe an archive, print its grid, ranges and particles", run_puda},
    {"lineextract", "Print values along a line or over a block of cells", run_line_extract},
    {"timeextract", "Print the value of a cell over time", run_time_extract},
    {"partextract", "Print variables of particles", run_part_extract},
    {"compare_uda", "Compare two archives within tolerances", run_compare_uda},
    {"compute_Lnorm_udas", "Print and write norms of differences", run_compute_lnorm},
    {"selectpart", "Print the particles in a box", run_select_part},
    {"partvarRange", "Print the range of each variable of particles", run_partvar_range},
    {"restart_merger", "Join the archives of a run and of its restarts", run_restart_merger},
    {"validateUda", "Look for missing and damaged files", run_validate_uda},
};

}  // namespace

std::span<const ClassicTool> classic_tools() {
  return tools;
}

const ClassicTool* find_classic_tool(const std::string& program) {
  const std::string name = std::filesystem::path(program).filename().string();
  for (const ClassicTool& tool : tools)
    if (name == tool.name) return &tool;
  return nullptr;
}

int run_classic_tool(const ClassicTool& tool, const ClassicCall& call) {
  try {
    return tool.run(call);
  } catch (const InputError& e) {
    fmt::print(stderr, "{}: error: {}\n", tool.name, e.what());
    return tool.bad_input;
  } catch (const Error& e) {
    fmt::print(stderr, "{}: error: {}\n", tool.name, e.what());
    return static_cast<int>(e.status());
  }
}

}  // namespace sluice
