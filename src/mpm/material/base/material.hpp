// A constitutive model: what stress the particles of one material have after a step.
//
// The law works on batches of particles whose columns are contiguous, so that its loops become
// vectors; it knows neither grid nor files. What it remembers of a particle (its history) it
// declares; the run keeps, moves, archives and restores that.
//
// Signs and units: stress positive in tension, Pa; symmetric tensors have six columns
// xx, yy, zz, yz, xz, xy; general tensors nine, row after row (F_xx, F_xy, F_xz, F_yx, ...).
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/field/label.hpp"

namespace sluice::mpm {

template <class T>
using Six = std::array<T*, 6>;
template <class T>
using Nine = std::array<T*, 9>;

// What a material is beside its law.
struct MaterialConstants {
  double density = 0;                                        // rho_0, kg/m^3
  double conductivity = 0;                                   // k, W/m/K
  double specific_heat = 0;                                  // c_v, J/kg/K
  double thermal_expansion = 0;                              // alpha_t, 1/K
  double room_temperature = 294, melt_temperature = 295e10;  // K
  double reference_pressure = 0;                             // p_ref of <PhysicalConstants>, Pa
};

// A number (or several) that a law remembers of each particle.
struct HistoryColumn {
  Label label;  // "p.plasticStrain": saved under this name
  int components = 1;
};

// Some particles of one material in a step from t to t + dt. Old columns are not to be changed;
// every new column must be written for every particle. Old and new never share memory.
struct Batch {
  int count = 0;
  double time = 0, dt = 0;              // s
  Nine<const double> old_F{}, F{};      // deformation gradient at both ends of the step
  Nine<const double> L{};               // velocity gradient of the step, 1/s: F = (I + dt L) old_F
  const double* temperature = nullptr;  // at the start, K
  const double* mass = nullptr;         // kg
  const double* volume_0 = nullptr;     // in the reference state: volume is J volume_0, m^3
  double spacing = 0;                   // least edge of a cell, m; 0: there is no grid
  const std::int64_t* id = nullptr;
  std::array<const double*, 3> position{};  // m, when a law starts; null in a step
  Six<const double> old_stress{};
  Six<double> stress{};  // Cauchy
  // Columns, component after component, in the units of their labels.
  std::span<const double* const> old_history;
  std::span<double* const> history;
  // What deforming the particle has stored and turned into heat until now, J: work of the stress.
  const double* old_energy = nullptr;
  double* energy = nullptr;
  // Heat beside that, which lost energy of motion has become, J; null: none.
  const double* heat = nullptr;
  double* wave_speed =
      nullptr;                // c_p of the new state, longitudinal, with F and stress as they are
  double* heating = nullptr;  // dT/dt by the law itself, K/s; zero when the law is called
  // The part of it that is compression along an isentrope, as dT/T of the step; zero when the law
  // is called; null: nobody asks.
  double* isentropic = nullptr;
};

// A particle that cannot take the step: det F <= 0, out of the law's range, not finite. The step is
// then redone smaller, so a law need not care what else it has written.
struct BatchFault {
  int particle = 0;    // in the batch
  const char* reason;  // "det F <= 0"
  double value = 0;    // of what the reason names, in its unit
};

class Material {
 public:
  virtual ~Material() = default;

  virtual std::span<const HistoryColumn> history() const { return {}; }
  // History, stress, energy and wave speed at the start; F is given, old columns are null.
  virtual void start(const Batch& batch) const = 0;
  virtual std::optional<BatchFault> update(const Batch& batch) const = 0;
  // Which column of the history is not 0 where a particle has failed; -1 where none can.
  virtual int failed_column() const { return -1; }
  // Such a particle keeps its F: the step gives it L = 0. (One whose corners are those of its
  // neighbours is deformed by these.)
  virtual bool failed_keep_their_shape() const { return false; }
  // Whether stress is a function of F (and temperature) alone, whatever the old stress.
  virtual bool stress_of_state() const { return false; }
  // Moves with prescribed velocity, has no stress and no equation of its own.
  virtual bool rigid() const { return false; }
  // Whether its pressure is that of a shock equation of state, which heat changes.
  virtual bool has_shock_equation() const { return false; }
  // Bulk modulus at rest, Pa: for the artificial viscosity, and as the scale of stresses.
  virtual double bulk_modulus() const = 0;
  // Shear modulus at rest, Pa.
  virtual double shear_modulus() const { return 0; }
  // m^2/s^2: mu of the laws whose wave speed is c^2 = a + mu (mean + reach of b), b = F F^T: waves
  // along a stretch gain from it, those across do not. 0: of no such form.
  virtual double wave_stiffening() const { return 0; }
};

}  // namespace sluice::mpm
