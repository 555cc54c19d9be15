// An accuracy study: which deck, which error, over which ladders of resolution and settings.
//
// A .study file is JSON with // comments:
//   {
//     "title": "Sod's shock tube",
//     "deck": "../../inputs/ice/riemann_sod.ups",       from the study's folder, else from here
//     "variable": "rho_CC",                             also "vel_CC.x", "p.stress.yy"; a history
//                                                       such as "TotalMomentum.x";
//                                                       "lost energy": of solids,
//                                                       what a run's energy account says is lost,
//                                                       over the scale of its energy
//     "material": 0,                                    number in the archive
//     "reference": {"resolution": [800,1,1], "set": []} a run of the deck in place of the exact
//                                                       solution that it names
//     "exact": "0.05*y",                                a formula of x, y, z at the end in place of
//                                                       that solution (of p.displacement: of where
//                                                       particles began), a number with "reduce"
//     "reduce": "largest",                              one number of the variable: mean, largest,
//                                                       smallest; last, of a history; compared with
//                                                       "exact" or the same of the reference
//     "within": [[0,0,0], [1,1,1]],                     only what lies in this box
//     "offset": 300,                                    relative errors are those of the variable
//                                                       less this: of what varies about it
//     "norm": "l1",                                     l1, l2, linf, relative_l1
//     "set": ["DataArchiver/outputInterval=0.2"],       for every run
//     "resolution": [[100,1,1], [200,1,1]],
//     "ladders": [{"name": "order", "default": "2",
//                  "values": {"1": "CFD/ICE/advection/@type=FirstOrder",
//                             "2": "CFD/ICE/advection/@type=SecondOrder"}}],
//     "targets": [0.01, 0.003, 0.001],                  of the relative L1 error
//     "component": "fluid",                             where the page of all studies counts it
//     "default_is_slower_because": "..."                a sentence of that page
//   }
// Every combination of the ladders' values is a setting; every setting runs at each resolution.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice {

struct Study {
  struct Value {
    std::string name;                    // as shown
    std::vector<std::string> overrides;  // PATH=VALUE
  };
  struct Ladder {
    std::string name;
    std::string default_value;  // name of the value that a deck gets when it says nothing
    std::vector<Value> values;
  };
  struct Reference {
    IntVec3 resolution;
    std::vector<std::string> overrides;  // beside those of every run
  };

  std::string file, title, deck;
  std::string variable = "rho_CC";
  int component = 0, material = 0;
  std::optional<Reference> reference;
  std::optional<std::string> exact;             // formula of x, y, z
  std::string reduce;                           // empty: none
  std::optional<std::pair<Vec3, Vec3>> within;  // lowest and highest corner, m
  double offset = 0;
  std::string part, why_slower;  // "component" and the sentence, for the page
  std::string norm = "l1";
  std::vector<std::string> overrides;
  std::vector<std::string> resolution_paths = {"Grid/Level/Box/resolution"};  // of each level
  std::vector<IntVec3> resolutions;                                           // coarse to fine
  std::vector<Ladder> ladders;
  std::vector<double> targets = {0.01, 0.003, 0.001};  // of the relative error
};

// One run of a study.
struct StudyPoint {
  std::string setting;  // "order 2, CFL 0.4"
  bool is_default = false;
  IntVec3 resolution;
  std::vector<std::string> overrides;

  // The number of cells that names the rung: along the longest direction.
  int cells() const;
};

// InputError with file and place on what is not JSON, unknown, missing or out of range.
Study read_study(const std::string& file);

// The run that stands for the exact solution, of a study that has one; and the same with half of
// the cells along each direction, where that is a whole number: what lies between them tells the
// error of the reference.
StudyPoint reference_point(const Study& study);
std::optional<StudyPoint> coarser_reference_point(const Study& study);

// Is what the energy account of each run says the error.
inline bool is_of_energy(const Study& study) {
  return study.variable == "lost energy";
}

// All runs, setting by setting, coarse to fine.
std::vector<StudyPoint> points_of(const Study& study);

// "order 2, CFL 0.4, N 200" matched by a pattern with * and ?, or containing it.
bool matches(const StudyPoint& point, const std::string& pattern);

}  // namespace sluice
