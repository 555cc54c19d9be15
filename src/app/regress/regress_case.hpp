// Regression cases: which decks, how they are run, what must hold. A list of cases, or a folder of
// decks with the gold beside them (regress_folder.hpp).
//
// cases.json, JSON with // comments (all keys: regress_keys.hpp):
//   {"cases": [{"name": "sod", "deck": "../../inputs/ice/riemann_sod.ups",   from the file's folder
//               "set": ["Time/maxTime=0.1"],
//               "variables": ["rho_CC", "p.x"], "tolerance": 1e-9,           against NAME.csv
//               "restart": 10,       stop after this step, restart from it: the same bits
//               "boxes": "3,1,1",    another split: the same bits
//               "ranks": 2}]}        more ranks, on that split: the same bits
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sluice {

struct RegressCase {
  std::string name;
  std::filesystem::path deck, golden;
  std::vector<std::string> overrides, variables;
  double tolerance = 1e-9;     // relative, see golden.hpp
  int restart = 0, ranks = 0;  // 0: not checked
  std::string boxes;           // empty: not checked
  // Of decks with gold archives beside them:
  bool of_folder = false;
  std::filesystem::path gold_archive, gold_histories;  // empty: none
  std::map<std::string, double> tolerances;            // by label, in place of `tolerance`
  double absolute = 0;                                 // in the unit of the label
  std::vector<std::string> exclude;                    // labels
  bool restart_in_the_middle = false;                  // where the deck's file does not say
};

// InputError with file and place on what is not JSON, unknown, missing or out of range.
std::vector<RegressCase> read_regress_cases(const std::filesystem::path& file);

// invalid: nothing can be compared, as the golden result is not of the end of the run.
enum class CaseVerdict { same, different, blessed, skipped, invalid };
const char* to_string(CaseVerdict);

// What is no longer as it was: the largest difference of a label.
struct Moved {
  std::string label, where;  // "press_CC of material 0", "level 0 at [3, 0, 0]"
  double time = 0;           // s
  double before = 0, after = 0;
  double largest = 0;  // the largest magnitude of the label, where it is known
};

struct RegressCheck {
  std::string
      name;  // golden, restart, boxes, ranks, against; outputs, checkpoints, histories, cost
  CaseVerdict verdict = CaseVerdict::skipped;
  std::string message;  // what differs
  std::vector<Moved> moved = {};
};

struct RegressResult {
  std::string name;
  std::vector<RegressCheck> checks;
  double seconds = 0;
  int status() const;  // 0: good, 1: something differs, 2: something is invalid
};

struct RegressRunner {
  std::filesystem::path executable;  // sluice
  std::filesystem::path against;     // another sluice that must give the same bits; empty: none
  std::filesystem::path folder;      // for archives
  std::string mpiexec = "mpiexec";   // a path, or found on the PATH
  bool bless = false;                // writes golden files

  RegressResult run(const RegressCase& c) const;

 private:
  struct Run;
  Run run_deck(const RegressCase& c, const std::string& name,
               const std::vector<std::string>& options, int ranks) const;
  Run run_with(const std::filesystem::path& program, const RegressCase& c, const std::string& name,
               const std::vector<std::string>& options, int ranks) const;
  RegressCheck check_golden(const RegressCase& c, const Run& plain) const;
  RegressCheck check_restart_in_the_middle(const RegressCase& c, const Run& plain) const;
  std::vector<RegressCheck> check_gold(const RegressCase& c, const Run& plain) const;
  RegressCheck check_restart(const RegressCase& c, const Run& plain) const;
  RegressCheck check_split(const RegressCase& c, const Run& plain, int ranks) const;
  RegressCheck check_against(const RegressCase& c, const Run& plain) const;
};

}  // namespace sluice
