// A deck for one particle: a material and the path that its deformation takes.
//
//   <MaterialDriver>
//     <material> density, specific_heat, ..., constitutive_model, damage_model, erosion </material>
//     <temperature>300</temperature>
//     <piece> <duration>1e-3</duration> <steps>100</steps>
//             <velocity_gradient>[0,1e3,0, 0,0,0, 0,0,0]</velocity_gradient> </piece>
//     <piece> ... <deformation>[1.1,0,0, 0,1,0, 0,0,1]</deformation> </piece>
//     <piece> ... <rotation>[0,0,1]</rotation> <angle>90</angle> </piece>
//   </MaterialDriver>
//
// Pieces follow each other: a velocity gradient holds for the piece, F goes on a straight line to a
// deformation, or the body turns as a whole; a piece with a rotation beside one of the others does
// both at once.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/deck/schema.hpp"
#include "mpm/material/single_particle.hpp"

namespace sluice::mpm {

struct PathPiece {
  double duration = 0;  // s
  int steps = 100;
  std::optional<Matrix> velocity_gradient;  // 1/s
  std::optional<Matrix> deformation;        // F at the end, before the rotation
  std::array<double, 3> axis{0, 0, 1};
  double angle = 0;  // rad, over the piece
};

struct DriverDeck {
  std::string title;
  std::string law;  // <constitutive_model type=>
  MaterialConstants constants;
  std::shared_ptr<const Material> material;
  double temperature = 300;  // K, at the start
  bool isothermal = false;
  std::vector<PathPiece> path;
};

Schema driver_schema();
// The deck with its values changed by overrides ("PATH=VALUE"); nothing where `faults` holds an
// error then.
std::optional<DriverDeck> read_driver_deck(const std::string& file,
                                           const std::vector<std::string>& overrides,
                                           std::vector<Fault>& faults);

// What is known of the particle after each step, a row each; the first is the start.
struct DriverTable {
  std::vector<std::string> columns;  // "time", "F_xx", ..., "stress_xx", ...: SI units
  std::vector<std::vector<double>> rows;
};
// PhysicsError where the law refuses a step.
DriverTable drive(const DriverDeck& deck);

}  // namespace sluice::mpm
