// Load curves on particles: pressures, torques, forces and heat through surfaces.
//
//   pressure: f = p(t) A/N n      torque: f = T(t)/N d/|d|^2, d = ((x - bottom) x axis)
//   force:    f = F/N             heat:   q = q(t) A/N
//
// N particles were marked when the run began: `marks`, up to three loads of each particle, number
// of the load in the deck plus one, 0 none. Places and widths in m.
#pragma once
#include <array>
#include <vector>

#include "mpm/loads/load_surface.hpp"
#include "mpm/material/base/material.hpp"

namespace sluice::mpm {

constexpr int max_marks = 3;

// Columns of some particles, and those to which forces are added.
struct LoadedParticles {
  std::size_t begin = 0, end = 0;
  std::array<const double*, 3> x{};
  std::array<const double*, max_marks> marks{};
  Nine<const double> F{};
  std::array<const double*, 3> normal{};  // of point files; null: none
  std::array<double, 3> width{};          // of a particle at rest, length
};

class LoadCurves {
 public:
  explicit LoadCurves(const MpmScene& solids);

  std::size_t count() const { return loads_.size(); }
  // Does any act on a material (by force; as heat).
  bool forces(int material) const;
  bool heats(int material) const;
  // Loads of a particle at the start; `named` are the ids of curves that its point file names. More
  // than three: std::length_error.
  std::array<int, max_marks> marks_of(int material, Vec3 x, Vec3 width, bool at_surface,
                                      const std::array<int, max_marks>& named) const;
  // Adds to the force on each particle, N; `time`: s; `counts` by load: marked particles of all
  // ranks.
  void add_forces(double time, const std::vector<double>& counts, const LoadedParticles& p,
                  const std::array<double*, 3>& force) const;
  // Unit vector: where the face of a particle looks on whose corners its loads act.
  Vec3 face_of(const LoadedParticles& p, std::size_t i) const;
  // Heat into each particle, W.
  void add_heat(double time, const std::vector<double>& counts, const LoadedParticles& p,
                double* heat) const;

 private:
  struct Load {
    const LoadCurve* curve;
    LoadSurface surface;
  };
  Vec3 force_of(const Load& load, double value, const LoadedParticles& p, std::size_t i) const;
  bool concerns(const LoadCurve& curve, int material) const;

  const MpmScene* solids_;
  std::vector<Load> loads_;
};

// The rotation of F = R U, without unit, row after row.
std::array<double, 9> rotation_of(const std::array<double, 9>& F);

}  // namespace sluice::mpm
