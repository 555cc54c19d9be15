#include "peridynamics/points/ghosts.hpp"

#include <algorithm>
#include <bit>

namespace sluice::peridynamics {
namespace {

constexpr int count_tag = 71, point_tag = 72, value_tag = 73;
constexpr int numbers_of_point = 7;  // place, volume, id, material, image

struct Region {
  Vec3 lower, upper;
  bool holds(Vec3 p, const std::array<bool, 3>& active) const {
    for (int d = 0; d < 3; ++d)
      if (active[d] && (p[d] < lower[d] || p[d] > upper[d])) return false;
    return true;
  }
};

Region region_of(const Level& level, const IndexBox& cells, double reach) {
  return {level.anchor + to_real(cells.lower) * level.spacing - Vec3::all(reach),
          level.anchor + to_real(cells.upper) * level.spacing + Vec3::all(reach)};
}

}  // namespace

// Along each direction: the point itself, moved by the length of a periodic domain, mirrored.
void Ghosts::list_images(const Level& level, const std::vector<Side>& mirrors) {
  images_ = {Image{}};
  for (int d = 0; d < 3; ++d) {
    if (!level.active[d]) continue;
    std::vector<std::pair<double, double>> along;  // scale, offset
    const double length = level.domain.size()[d] * level.spacing[d];
    if (level.periodic[d]) along = {{1, length}, {1, -length}};
    for (const Side side : mirrors) {
      if (direction_of(side) != d) continue;
      const int at = is_plus(side) ? level.domain.upper[d] : level.domain.lower[d];
      along.emplace_back(-1, 2 * (level.anchor[d] + at * level.spacing[d]));
    }
    const std::size_t before = images_.size();
    for (const auto& [scale, offset] : along)
      for (std::size_t n = 0; n < before; ++n) {
        Image image = images_[n];
        image.scale[d] = scale;
        image.offset[d] = offset;
        images_.push_back(image);
      }
  }
}

// Own points whose images are near boxes of a rank.
void Ghosts::choose(const Level& level, double reach, const std::vector<OwnPoint>& own, int rank) {
  Partner partner;
  partner.rank = rank;
  for (std::size_t k = rank == rank_ ? 1 : 0; k < images_.size(); ++k) {
    const Image& image = images_[k];
    std::vector<Region> regions;
    for (const GridBox& box : level.boxes)
      if (box.owner == rank) regions.push_back(region_of(level, box.cells, reach));
    for (std::size_t n = 0; n < own.size(); ++n) {
      const Vec3 p = image.scale * own[n].place + image.offset;
      const bool near = std::any_of(regions.begin(), regions.end(), [&](const Region& region) {
        return region.holds(p, level.active);
      });
      if (!near) continue;
      partner.own.push_back(static_cast<int>(n));
      partner.image.push_back(static_cast<int>(k));
    }
  }
  partners_.push_back(std::move(partner));
}

void Ghosts::swap(int numbers) {
  Messages messages;
  for (Partner& p : partners_) {
    p.in.resize(p.image_here.size() * numbers);
    if (p.rank == rank_)
      std::copy(p.out.begin(), p.out.end(), p.in.begin());
    else if (!p.in.empty())
      messages.post_receive(p.in.data(), p.in.size(), p.rank, value_tag);
  }
  for (Partner& p : partners_)
    if (p.rank != rank_ && !p.out.empty())
      messages.post_send(p.out.data(), p.out.size(), p.rank, value_tag);
  messages.wait_all();
}

std::vector<Ghosts::Arrived> Ghosts::find(const Level& level, const std::vector<Side>& mirrors,
                                          double reach, const std::vector<OwnPoint>& own,
                                          Communicator& ranks) {
  rank_ = ranks.rank();
  partners_.clear();
  arrived_.clear();
  list_images(level, mirrors);
  for (int r = 0; r < ranks.size(); ++r) choose(level, reach, own, r);
  std::vector<double> to_send(partners_.size()), to_come(partners_.size());
  Messages messages;
  for (std::size_t n = 0; n < partners_.size(); ++n) {
    to_send[n] = static_cast<double>(partners_[n].own.size());
    if (partners_[n].rank == rank_)
      to_come[n] = to_send[n];
    else
      messages.post_receive(&to_come[n], 1, partners_[n].rank, count_tag);
  }
  for (std::size_t n = 0; n < partners_.size(); ++n)
    if (partners_[n].rank != rank_)
      messages.post_send(&to_send[n], 1, partners_[n].rank, count_tag);
  messages.wait_all();
  sends_ = false;
  for (std::size_t n = 0; n < partners_.size(); ++n) {
    Partner& p = partners_[n];
    p.image_here.resize(static_cast<std::size_t>(to_come[n]));
    sends_ = sends_ || !p.own.empty();
    p.out.clear();
    for (std::size_t k = 0; k < p.own.size(); ++k) {
      const OwnPoint& point = own[static_cast<std::size_t>(p.own[k])];
      p.out.insert(p.out.end(),
                   {point.place.x, point.place.y, point.place.z, point.volume,
                    std::bit_cast<double>(point.id), static_cast<double>(point.material),
                    static_cast<double>(p.image[k])});
    }
  }
  swap(numbers_of_point);
  for (Partner& p : partners_)
    for (std::size_t k = 0; k < p.image_here.size(); ++k) {
      const double* in = p.in.data() + k * numbers_of_point;
      const int image = static_cast<int>(in[6]);
      p.image_here[k] = image;
      const Image& how = images_[static_cast<std::size_t>(image)];
      arrived_.push_back({{how.scale * Vec3{in[0], in[1], in[2]} + how.offset, in[3],
                           std::bit_cast<std::int64_t>(in[4]), static_cast<int>(in[5])},
                          image});
    }
  std::erase_if(partners_, [](const Partner& p) { return p.own.empty() && p.image_here.empty(); });
  return arrived_;
}

void Ghosts::place(const std::vector<int>& entry_of_own, const std::vector<int>& entry_of_arrived) {
  std::size_t at = 0;
  for (Partner& p : partners_) {
    for (int& n : p.own) n = entry_of_own[static_cast<std::size_t>(n)];
    p.entry.clear();
    for (std::size_t k = 0; k < p.image_here.size(); ++k) p.entry.push_back(entry_of_arrived[at++]);
  }
}

void Ghosts::fill(std::span<double* const> columns) {
  const std::size_t count = columns.size();
  for (Partner& p : partners_) {
    p.out.resize(p.own.size() * count);
    double* to = p.out.data();
    for (const int n : p.own)
      for (double* const column : columns) *to++ = column[n];
  }
  swap(static_cast<int>(count));
  for (const Partner& p : partners_) {
    const double* from = p.in.data();
    for (const int n : p.entry)
      for (double* const column : columns) column[n] = *from++;
  }
}

void Ghosts::fill_vector(const std::array<double*, 3>& vector) {
  fill(vector);
  if (images_.size() == 1) return;
  for (const Partner& p : partners_)
    for (std::size_t k = 0; k < p.entry.size(); ++k) {
      const Vec3 scale = images_[static_cast<std::size_t>(p.image_here[k])].scale;
      for (int d = 0; d < 3; ++d) vector[static_cast<std::size_t>(d)][p.entry[k]] *= scale[d];
    }
}

}  // namespace sluice::peridynamics
