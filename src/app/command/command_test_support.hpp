// Running the command as a user does, and what it said.
#pragma once
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "app/process/study_process.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice {

struct Outcome {
  int status = -1;
  std::string text;  // standard output and error together
};

inline Outcome run_in_shell(const std::string& line) {
  Outcome outcome;
  FILE* pipe = popen((line + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer{};
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.text.append(buffer.data(), n);
  const int status = pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return outcome;
}

// What starts a command on so many ranks, before its words. A process that has used MPI alone, as
// solvers do in tests, tells its children that they are alone too; the launcher must not hear that.
inline std::string on_ranks(int ranks) {
  return "env -u OMPI_MCA_ess " SLUICE_MPIEXEC " --allow-run-as-root --oversubscribe -np " +
         std::to_string(ranks) + " ";
}

// Of a file; nothing where there is none.
inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The sluice command with these words, none of which a shell sees.
inline Outcome run_sluice(const std::vector<std::string>& words) {
  const TemporaryFolder folder;
  ProcessRequest request;
  request.words = {SLUICE_COMMAND};
  request.words.insert(request.words.end(), words.begin(), words.end());
  request.output = folder / "said";
  Outcome outcome;
  outcome.status = run_process(request);
  outcome.text = text_of(request.output);
  return outcome;
}

}  // namespace sluice
