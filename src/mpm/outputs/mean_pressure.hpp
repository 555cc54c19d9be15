// p.pressure: what presses on a particle from all sides, p_ref - tr(sigma)/3.
#pragma once
#include "framework/run/component/particle_method.hpp"
#include "mpm/step/columns.hpp"

namespace sluice::mpm {

// `reference`: of <PhysicalConstants>, at which solids are free of stress, Pa.
DerivedAttribute mean_pressure_of(const Columns& columns, double reference);

}  // namespace sluice::mpm
