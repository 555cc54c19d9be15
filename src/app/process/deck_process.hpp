// A deck run as a process of its own, for series of runs with overrides.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "framework/base/json.hpp"

namespace sluice {

struct DeckRequest {
  std::filesystem::path executable;  // sluice
  std::string deck;
  std::vector<std::string> overrides;  // PATH=VALUE
  std::vector<std::string> options;    // of `sluice run`, beside
  std::filesystem::path folder;        // emptied first; archive, report and log lie in it
};

// The words of the command line that repeats the run.
std::vector<std::string> run_words(const DeckRequest& request);
// For a person's shell: words with blanks or brackets in quotes, the first is "sluice".
std::string shell_text(const std::vector<std::string>& words);

struct DeckOutcome {
  int exit_status = 0;
  Json report;          // run.json; null where the run wrote none
  std::string message;  // of one that was not "done": the last lines of its log

  std::string status() const;   // as the report says; "failed" without one
  std::string archive() const;  // empty: none was written
};

// What transfer, integration and contact took from solids (or gave) and did not turn into heat,
// over the scale of the total energy: by a run's report. NaN where the report has numbers that are
// not finite; InputError where no solids deform in explicit steps.
double lost_energy(const Json& report);

// Waits for the end of the run. InputError with the deck's faults where the run refuses the deck;
// SystemError where it cannot be started. Safe for several threads with folders of their own.
DeckOutcome run_deck(const DeckRequest& request);

}  // namespace sluice
