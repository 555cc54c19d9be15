// Sums over planes, and the averages and covariances that they give.
#include "framework/analysis/average.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "framework/analysis/sums.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

bool same(const AnalysedQuantity& a, const AnalysedQuantity& b) {
  return a.label == b.label && a.material == b.material;
}

const char* average_root(const AveragePlan& plan) {
  return plan.velocity ? "planarAveTurbFluxes/AvgQ" : "planeAverage";
}

std::string file_name(const AnalysedQuantity& q, const char* what = "") {
  return fmt::format("{}{}_{}", q.label.name(), what, q.material);
}

}  // namespace

AverageSampler::AverageSampler(const Level& level, AveragePlan plan)
    : LevelSampler({}),
      geometry_(level),
      plan_(std::move(plan)),
      averages_(average_root(plan_), level.index),
      fluxes_("planarAveTurbFluxes/TurbFluxes", level.index) {
  geometry_.boxes.clear();
  if (plan_.weight) weight_ = quantity_number(*plan_.weight);
  std::vector<std::vector<std::size_t>> channels;
  if (plan_.velocity) {
    std::erase_if(plan_.averaged, [&](const AveragedQuantity& q) {
      return same(q.quantity, plan_.velocity->quantity);
    });
    plan_.averaged.insert(plan_.averaged.begin(), *plan_.velocity);
  }
  for (const AveragedQuantity& q : plan_.averaged) {
    channels.push_back(add_channels(q));
    files_.push_back(
        {file_name(q.quantity), columns_of(q.quantity), channels.back(), false, q.weighting});
  }
  if (plan_.velocity) add_fluxes(channels);
}

std::size_t AverageSampler::quantity_number(const AnalysedQuantity& q) {
  const auto found = std::find_if(quantities_.begin(), quantities_.end(),
                                  [&](const AnalysedQuantity& other) { return same(q, other); });
  if (found != quantities_.end()) return found - quantities_.begin();
  quantities_.push_back(q);
  return quantities_.size() - 1;
}

std::vector<std::size_t> AverageSampler::add_channels(const AveragedQuantity& q) {
  const std::size_t number = quantity_number(q.quantity);
  std::vector<std::size_t> added;
  for (int c = 0; c < q.quantity.components; ++c) {
    added.push_back(channels_.size());
    channels_.push_back({number, c, q.weighting});
  }
  return added;
}

// The velocity's channels come first.
void AverageSampler::add_fluxes(const std::vector<std::vector<std::size_t>>& channels) {
  const auto file = [&](std::string name, const char* heads,
                        const std::vector<std::pair<std::size_t, std::size_t>>& pairs) {
    File f{std::move(name), heads, {}, true, Weighting::cells};
    for (const auto& pair : pairs) {
      f.entries.push_back(pairs_.size());
      pairs_.push_back(pair);
    }
    files_.push_back(std::move(f));
  };
  const std::size_t u = channels[0][0], v = channels[0][1], w = channels[0][2];
  const int material = plan_.velocity->quantity.material;
  file(fmt::format("normalTurbStrss_{}", material), " u'u' v'v' w'w'", {{u, u}, {v, v}, {w, w}});
  file(fmt::format("shearTurbStrss_{}", material), " u'v' v'w' w'u'", {{u, v}, {v, w}, {w, u}});
  for (std::size_t n = 1; n < channels.size(); ++n) {
    const std::size_t q = channels[n][0];
    file(file_name(plan_.averaged[n].quantity, "_turbFlux"), " u'Q' v'Q' w'Q'",
         {{q, u}, {q, v}, {q, w}});
  }
}

void AverageSampler::lay_out(const Level& level) {
  planes_.clear();
  cells_.clear();
  std::map<int, std::int64_t> held;
  const int n = plan_.normal;
  for (const GridBox& b : level.boxes)
    for (int i = b.cells.lower[n]; i < b.cells.upper[n]; ++i)
      held[i] += b.cells.volume() / b.cells.size()[n];
  for (const auto& [index, count] : held) {
    planes_.push_back(index);
    cells_.push_back(count);
  }
}

std::size_t AverageSampler::lines() const {
  return planes_.size() * files_.size();
}

// The sum of weights; of each channel its sum and its weighted sum; of each pair its products.
std::size_t AverageSampler::sum_count() const {
  return 1 + 2 * channels_.size() + pairs_.size();
}

void AverageSampler::add_cells(const Warehouse& outputs, const IndexBox& cells, int box,
                               std::vector<ExactSum>& sums) const {
  const auto gather = [&](std::size_t quantity, int component) {
    const AnalysedQuantity& q = quantities_[quantity];
    const ConstRealView v = outputs.view(outputs.find(q.label, q.material), component, box);
    std::vector<double> values;
    values.reserve(cells.volume());
    for_each_cell(cells, [&](IntVec3 c) { values.push_back(v(c)); });
    return values;
  };
  const auto add_products = [](const std::vector<double>& a, const std::vector<double>& b,
                               ExactSum& sum) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Double2 p = product(a[i], b[i]);
      sum.add(p.high);
      sum.add(p.low);
    }
  };
  std::vector<double> weight;
  if (weight_) weight = gather(*weight_, 0);
  sums[0].add(weight.data(), weight.size());
  std::vector<std::vector<double>> values;
  for (std::size_t n = 0; n < channels_.size(); ++n) {
    values.push_back(gather(channels_[n].quantity, channels_[n].component));
    sums[1 + 2 * n].add(values[n].data(), values[n].size());
    if (channels_[n].weighting == Weighting::mass) add_products(weight, values[n], sums[2 + 2 * n]);
  }
  for (std::size_t p = 0; p < pairs_.size(); ++p)
    add_products(values[pairs_[p].first], values[pairs_[p].second],
                 sums[1 + 2 * channels_.size() + p]);
}

void AverageSampler::pack(const Warehouse& outputs, int /*rank*/,
                          std::vector<double>& numbers) const {
  for (const int plane : planes_) {
    std::vector<ExactSum> sums(sum_count());
    for (int b = 0; b < static_cast<int>(outputs.local_boxes().size()); ++b) {
      IndexBox cells = outputs.local_boxes()[b].cells;
      cells.lower[plan_.normal] = std::max(cells.lower[plan_.normal], plane);
      cells.upper[plan_.normal] = std::min(cells.upper[plan_.normal], plane + 1);
      if (!cells.empty()) add_cells(outputs, cells, b, sums);
    }
    for (const ExactSum& s : sums) pack_sum(s, numbers);
  }
}

AverageSampler::Values AverageSampler::values_of(RankNumbers& numbers, std::int64_t cells) const {
  std::vector<ExactSum> sums;
  for (std::size_t s = 0; s < sum_count(); ++s) sums.push_back(take_sum(numbers));
  Values v;
  const auto count = static_cast<double>(cells);
  v.weight = sums[0].value();
  for (std::size_t n = 0; n < channels_.size(); ++n) {
    const double plain = sums[1 + 2 * n].value();
    const Weighting w = channels_[n].weighting;
    v.averages.push_back(w == Weighting::none    ? plain
                         : w == Weighting::cells ? plain / count
                                                 : sums[2 + 2 * n].value() / v.weight);
  }
  // sum of (a - A)(b - B) = sum ab - A sum b - B sum a + n A B
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const auto [a, b] = pairs_[p];
    const auto about = [&](std::size_t n) {  // the plain average stands in for a sum
      const Double2 sum = value2(sums[1 + 2 * n]);
      return channels_[n].weighting == Weighting::none ? sum.high / count : v.averages[n];
    };
    const Double2 A = as_double2(about(a)), B = as_double2(about(b));
    const Double2 moment = value2(sums[1 + 2 * channels_.size() + p]) -
                           A * value2(sums[1 + 2 * b]) - B * value2(sums[1 + 2 * a]) +
                           as_double2(count) * (A * B);
    v.covariances.push_back((moment.high + moment.low) / count);
  }
  return v;
}

std::string AverageSampler::text_of(const File& file, const std::vector<Values>& planes,
                                    double time) const {
  const char* last = file.weighting == Weighting::none    ? ""
                     : file.weighting == Weighting::cells ? " nCells"
                                                          : " weight";
  std::string text = snapshot_head(time) + fmt::format("# X Y Z{}{}\n", file.heads, last);
  const auto put = std::back_inserter(text);
  for (std::size_t n = 0; n < planes.size(); ++n) {
    Vec3 x;
    for (int d = 0; d < 3; ++d)
      x[d] = geometry_.anchor[d] +
             0.5 * geometry_.spacing[d] * (geometry_.domain.lower[d] + geometry_.domain.upper[d]);
    x[plan_.normal] = geometry_.centre(IntVec3::all(planes_[n]))[plan_.normal];
    fmt::format_to(put, "{:.17g} {:.17g} {:.17g}", x.x, x.y, x.z);
    const std::vector<double>& values =
        file.covariances ? planes[n].covariances : planes[n].averages;
    for (const std::size_t e : file.entries) fmt::format_to(put, " {:.17g}", values[e]);
    if (file.weighting == Weighting::cells) fmt::format_to(put, " {}", cells_[n]);
    if (file.weighting == Weighting::mass) fmt::format_to(put, " {:.17g}", planes[n].weight);
    text += '\n';
  }
  return text;
}

void AverageSampler::write(RankNumbers& numbers, int step, double time) {
  std::vector<Values> planes;
  for (const std::int64_t cells : cells_) planes.push_back(values_of(numbers, cells));
  if (planes.empty()) return;
  for (const File& f : files_)
    (f.covariances ? fluxes_ : averages_).add(step, f.name, text_of(f, planes, time));
}

void AverageSampler::flush(const fs::path& folder) {
  averages_.flush(folder);
  fluxes_.flush(folder);
}

void AverageSampler::adopt(const fs::path& earlier, const fs::path& folder, double time) const {
  averages_.adopt(earlier, folder, time);
  if (plan_.velocity) fluxes_.adopt(earlier, folder, time);
}

}  // namespace sluice
