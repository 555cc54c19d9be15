#include "models/gases/combustion.hpp"

namespace sluice::models {

ReactionLabels reaction_labels() {
  return {declare_label({"HeatReleaseRate", ValueType::real, Centring::cell, "W/m^3",
                         "Heat released by reactions of species, per time."}),
          declare_label({"dt_chemistry", ValueType::real, Centring::cell, "s",
                         "Last step of the integration of reactions in the cell."}),
          declare_label({"dt_chemistry_limiter", ValueType::real, Centring::cell, "1",
                         "Index, from 1, of the species whose mass fraction changes most by "
                         "reactions relative to its tolerance in the step; 0: none changes."})};
}

}  // namespace sluice::models
