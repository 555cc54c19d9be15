#include "framework/run/component/level_facet.hpp"

#include "framework/run/component/no_transfer.hpp"

namespace sluice {

const TransferOperators& LevelFacet::transfer() const {
  static const NoTransfer none;
  return none;
}

Label LevelFacet::refine_flag() const {
  return declare_label({"refineFlag", ValueType::integer, Centring::cell, "1",
                        "1 where a finer level is needed, 0 elsewhere"});
}

}  // namespace sluice
