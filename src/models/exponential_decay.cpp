// The tag <exponentialDecay>.
#include "models/exponential_decay.hpp"

#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::models {

TagSpec exponential_decay_tag() {
  const auto c2 = tag("c2", "second coefficient")
                      .once()
                      .attribute(attribute("type", "the same everywhere")
                                     .once()
                                     .words({"constant"})
                                     .not_built({"variable"}))
                      .with_children({tag("value", "the coefficient")
                                          .once()
                                          .real()
                                          .at_least(0)
                                          .only_for("type", {"constant"})});
  return tag("exponentialDecay", "decay with exp(-(c1 c2 + c3) t)")
      .with_children(
          {tag("c1", "first coefficient").once().real().at_least(0), c2,
           tag("c3", "what is added to their product").real().by_default("0").unit("1/time")});
}

double read_decay(const DeckNode& scalar) {
  const DeckNode* decay = scalar.child("exponentialDecay");
  if (decay == nullptr) return 0;
  return decay->real("c1") * decay->child("c2")->real("value") + real_or(*decay, "c3", 0);
}

}  // namespace sluice::models
