// What particles have lost becomes fluid in their cells, where their volume opens.
//
// Redistribution joins what little cells hold with their neighbours at once: products alone in a
// crack would tear the body.
#pragma once
#include "mpmice/burn/burned_particles.hpp"
#include "mpmice/burn/burning_step.hpp"

namespace sluice::mpmice {

template <int D>
class BurnProducts {
 public:
  void begin(const CellAmounts<D>& amounts, std::size_t cells) {
    made_.assign(amounts.mass.size(), Column(cells, 0.0));
  }
  // Cells get what particles have given: each cell of a particle as many parts as lie in it, by
  // `in_cells` where that is not empty. False: no rank has anything. Collective.
  bool give(const BurningStep<D>& step, int product, const std::vector<GivenByParticle>& given,
            const Column& in_cells);
  // Mass per cell volume that burning has made, by fluid, kg/m^3; of all.
  const std::vector<Column>& made() const { return made_; }
  Column all() const;
  // The products fill what has opened of the cells since their amounts were found.
  void fill_opened(const BurningStep<D>& step) const;

 private:
  struct Scales {
    double mass = 1e-300, energy = 1e-300, kinetic = 1e-300, speed = 1e-300;
    double room = 1;  // parts of particles in a cell
  };
  // False: no rank has anything.
  static bool find_scales(const BurningStep<D>& step, const std::vector<GivenByParticle>& given,
                          Scales& most);
  static double most_parts_given(const BurningStep<D>& step,
                                 const std::vector<GivenByParticle>& given);
  static void add_parts(const BurningStep<D>& step, const GivenByParticle& g,
                        const Column& in_cells, const Scales& most, CellSums<D>& sums);
  void add(CellAmounts<D>& amounts, std::size_t i, int product, double mass, double energy,
           double kinetic, const std::array<double, 3>& momentum);

  std::vector<Column> made_;
};

}  // namespace sluice::mpmice
