// All labels of the examples, for the page of labels.
#pragma once

namespace sluice::examples {

void declare_labels();

}  // namespace sluice::examples
