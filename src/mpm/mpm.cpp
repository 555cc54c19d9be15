#include "mpm/mpm.hpp"

#include <stdexcept>

#include "framework/deck/faults.hpp"
#include "mpm/contact/contact.hpp"
#include "mpm/effects.hpp"
#include "mpm/histories.hpp"
#include "mpm/levels/solid_levels.hpp"
#include "mpm/step/step_sums.hpp"

namespace sluice::mpm {

Mpm::Mpm(const Scene& scene, MpmScene solids, std::shared_ptr<ReductionLayout> reductions)
    : scene_(scene),
      solids_(std::move(solids)),
      particles_(scene_, solids_),
      effects_(effects_of(scene_, solids_)),
      history_sums_(solids_),
      reductions_(std::move(reductions)),
      sums_(reductions_->add_sums_of_stages(
          static_cast<int>(StepSums::all(solids_.materials.size())))),
      // Behind the rates: on how many particles each load acts.
      maxima_(reductions_->add_maxima(
          static_cast<int>(rate_count(solids_.materials.size()) + solids_.loads.size()))) {
  if (sums_.first() != 0 || maxima_.first() != 0)
    throw std::logic_error("the sums of solids must be the first of a component");
  declare_histories();
  need_sums(scene_, history_sums_);
  for (const ContactRule& rule : solids_.contacts) friction_of(rule, solids_);  // or InputError
  if (solids_.implicit) {
    step_ = std::make_unique<ImplicitMpmStep>(*this);
    budgets_ = std::make_unique<ImplicitMpmBudgets>(*this);
  } else {
    step_ = std::make_unique<MpmStep>(*this);
    budgets_ = std::make_unique<MpmBudgets>(*this);
  }
}

void Mpm::warn_of_absent_labels(std::vector<Fault>& faults) const {
  for (const SaveRequest& save : scene_.output.saves)
    if (particles_.is_absent(save.label))
      add_warning(faults, save.where,
                  "<save label=\"" + save.label +
                      "\">: no material of this deck has it; nothing "
                      "is saved of it");
}

std::shared_ptr<SolidLevels> Mpm::make_step() const {
  return std::make_shared<SolidLevels>(scene_, solids_, particles_.carried(), particles_.kinds());
}

bool Mpm::has_history(Label label) const {
  return is_history(label);
}

}  // namespace sluice::mpm
