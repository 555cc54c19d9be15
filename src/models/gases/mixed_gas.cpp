// Looking nodes up, and what is largest among them.
#include "models/gases/mixed_gas.hpp"

#include <stdexcept>
#include <utility>

namespace sluice::models {

void MixedGas::set_nodes(std::vector<Node> nodes) {
  if (nodes.size() < 2) throw std::logic_error("a mixed gas needs two nodes");
  nodes_ = std::move(nodes);
  inverse_width_.clear();
  for (std::size_t n = 0; n + 1 < nodes_.size(); ++n)
    inverse_width_.push_back(1.0 / (nodes_[n + 1].f - nodes_[n].f));
  const std::size_t parts = 4 * nodes_.size();
  const double low = nodes_.front().f, range = nodes_.back().f - low;
  parts_per_f_ = static_cast<double>(parts) / range;
  first_.assign(parts, 0);
  for (std::size_t part = 0, n = 0; part < parts; ++part) {
    // A part earlier, so that rounding never starts beyond the node.
    const double from = low + (static_cast<double>(part) - 1.0) / parts_per_f_;
    while (n + 2 < nodes_.size() && nodes_[n + 1].f <= from) ++n;
    first_[part] = n;
  }
}

std::size_t MixedGas::interval(double f) const {
  const double x = (f - nodes_.front().f) * parts_per_f_;
  const double last = static_cast<double>(first_.size() - 1);
  std::size_t n = first_[static_cast<std::size_t>(std::min(std::max(x, 0.0), last))];
  while (n + 2 < nodes_.size() && nodes_[n + 1].f <= f) ++n;
  return n;
}

// Of a ratio of linear functions an end is the largest.
double MixedGas::highest_gamma() const {
  if (species) return species->gas->highest_gamma();
  double most = 0;
  for (const Node& node : nodes_) most = std::max(most, 1.0 + node.R / node.cv);
  return most;
}

double MixedGas::lowest_specific_heat() const {
  if (species) return species->gas->lowest_specific_heat();
  double least = nodes_.front().cv;
  for (const Node& node : nodes_) least = std::min(least, node.cv);
  return least;
}

double MixedGas::most(double Node::*property) const {
  double most = nodes_.front().*property;
  for (const Node& node : nodes_) most = std::max(most, node.*property);
  return most;
}

double MixedGas::density_at_start(double f) const {
  const auto [rho_A, rho_B] = *start_density;
  return 1.0 / (f / rho_B + (1.0 - f) / rho_A);
}

}  // namespace sluice::models
