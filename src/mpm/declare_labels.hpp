// All labels of solids, for the page of labels and the words of <save>.
#pragma once

namespace sluice::mpm {

void declare_labels();

}  // namespace sluice::mpm
