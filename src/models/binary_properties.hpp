// Model "BinaryProperties": an ideal gas whose properties follow from a transported scalar f.
//
//   cv = f cv_B + (1 - f) cv_A,  R = f R_B + (1 - f) R_A,  gamma = 1 + R/cv,  p = (gamma - 1) rho e
// f is the mass fraction of gas B: both gases together have the pressure and the energy that they
// have apart at the same temperature. What the scalar needs beside it is as for "PassiveScalar".
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "framework/deck/schema.hpp"
#include "models/transported_scalar.hpp"

namespace sluice::models {

struct BinaryGas {
  std::string scalar;  // its name
  int material = 0;
  double cv_A = 1, cv_B = 1;  // J/(kg K)
  double R_A = 1, R_B = 1;    // J/(kg K)
  Location where;

  double specific_heat(double f) const { return cv_A + f * (cv_B - cv_A); }
  double gas_constant(double f) const { return R_A + f * (R_B - R_A); }
  double gamma(double f) const { return 1.0 + gas_constant(f) / specific_heat(f); }
  double highest_gamma() const { return std::max(gamma(0), gamma(1)); }
};

TagSpec binary_properties_tag();
void check_binary_properties(const DeckNode& parameters, const std::vector<std::string>& materials,
                             std::vector<Fault>& faults);
BinaryGas read_binary_properties(const DeckNode& parameters,
                                 const std::vector<std::string>& materials);
TransportedScalar read_binary_scalar(const DeckNode& parameters,
                                     const std::vector<std::string>& materials,
                                     const GeometryReader& geometry, std::vector<Fault>& faults);

}  // namespace sluice::models
