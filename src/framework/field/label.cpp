// The table of all labels of this process.
#include "framework/field/label.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace sluice {
namespace {

struct Registry {
  std::mutex mutex;
  std::deque<LabelInfo> infos;
  std::map<std::string, int, std::less<>> by_name;

  const LabelInfo& info(int id) const { return infos[id]; }
  int add(LabelInfo info) {
    const int id = static_cast<int>(infos.size());
    by_name[info.name] = id;
    infos.push_back(std::move(info));
    return id;
  }
};

bool same_kind(const LabelInfo& a, const LabelInfo& b) {
  return a.type == b.type && a.centring == b.centring;
}

Registry& registry() {
  static Registry r;
  return r;
}

}  // namespace

std::string_view name_of(Centring c) {
  constexpr std::string_view names[] = {"cell",   "node",     "x face",   "y face",
                                        "z face", "particle", "reduction"};
  return names[static_cast<int>(c)];
}

std::string_view name_of(ValueType t) {
  constexpr std::string_view names[] = {"real", "vector", "integer", "long integer", "tensor"};
  return names[static_cast<int>(t)];
}

const LabelInfo& Label::info() const {
  Registry& r = registry();
  const std::lock_guard lock(r.mutex);
  if (id_ < 0 || id_ >= static_cast<int>(r.infos.size()))
    throw std::logic_error("label used before it was declared");
  return r.infos[id_];
}

Label declare_label(LabelInfo info) {
  Registry& r = registry();
  const std::lock_guard lock(r.mutex);
  if (auto it = r.by_name.find(info.name); it != r.by_name.end()) {
    if (!same_kind(r.info(it->second), info))
      throw std::logic_error("label " + info.name + " declared twice with different types");
    return Label(it->second);
  }
  return Label(r.add(std::move(info)));
}

Label claim_label(LabelInfo info) {
  Registry& r = registry();
  const std::lock_guard lock(r.mutex);
  for (int id = 0; id < static_cast<int>(r.infos.size()); ++id)
    if (r.info(id).name == info.name && same_kind(r.info(id), info)) {
      r.by_name[info.name] = id;
      return Label(id);
    }
  return Label(r.add(std::move(info)));
}

std::optional<Label> find_label(std::string_view name) {
  Registry& r = registry();
  const std::lock_guard lock(r.mutex);
  auto it = r.by_name.find(name);
  if (it == r.by_name.end()) return std::nullopt;
  return Label(it->second);
}

std::vector<Label> all_labels() {
  Registry& r = registry();
  const std::lock_guard lock(r.mutex);
  std::vector<Label> labels;
  for (int id = 0; id < static_cast<int>(r.infos.size()); ++id) labels.emplace_back(id);
  std::stable_sort(labels.begin(), labels.end(),
                   [&](Label a, Label b) { return r.info(a.id()).name < r.info(b.id()).name; });
  return labels;
}

}  // namespace sluice
