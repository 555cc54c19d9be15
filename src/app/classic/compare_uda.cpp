// compare_uda: two archives output by output, variable by variable, within two tolerances.
//
// Two numbers differ when |a - b| exceeds the absolute tolerance and, over the larger of both, the
// relative one; whole numbers must be equal. Vectors are compared component by component, tensors
// by their norm. Exit status: 0 passed, 1 bad arguments, 2 tolerances exceeded, 5 not comparable,
// 255 (-1) a type that is not read.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/classic/classic_archive.hpp"
#include "app/classic/classic_tools.hpp"
#include "framework/archive/particle_table.hpp"
#include "framework/archive/selection.hpp"

namespace sluice {
namespace {

ClassicSpec compare_spec() {
  return {"compare_uda",
          "[options] <archive 1> <archive 2>",
          {{"-h -help", "", "this text"},
           {"-abs_tolerance", "<x>", "allowed absolute difference (1e-9)"},
           {"-rel_tolerance", "<x>", "allowed relative difference (1e-6)"},
           {"-exact", "", "both tolerances 0"},
           {"-levels", "<int> <int>", "only this level of the first and of the second archive"},
           {"-includeExtraCells", "", "also the cells around levels"},
           {"-as_warnings", "", "go on after a difference"},
           {"-concise", "", "with -as_warnings: the first difference of each variable"},
           {"-skip_unknown_types", "", "skip variables of types that are not read"},
           {"-ignoreVariables", "<a,b>", "all variables but these"},
           {"-compareVariables", "<a,b>", "these variables only"},
           {"-dont_sort", "", "variables in the order of the index"}}};
}

constexpr int passed = 0, exceeded = 2, not_comparable = 5, unknown_type = 255;

// Ends the comparison with this exit status.
struct ComparisonEnds {
  int status;
};

struct CompareUdaOptions {
  double absolute = 1e-9, relative = 1e-6;
  bool warnings = false, concise = false, skip_unknown = false, sorted = true;
  Layers layers = Layers::interior;
  int first_level = -1, second_level = -1;
  LabelFilter labels;
};

class UdaComparison {
 public:
  UdaComparison(std::string name_a, std::string name_b, CompareUdaOptions options)
      : name_a_(std::move(name_a)),
        name_b_(std::move(name_b)),
        options_(std::move(options)),
        a_(Archive::open(name_a_)),
        b_(Archive::open(name_b_)) {}

  int run() {
    print_head();
    bool same_variables = true;
    const std::vector<VariableEntry> variables = common_variables(same_variables);
    const std::size_t count = std::min(a_.outputs().size(), b_.outputs().size());
    for (std::size_t t = 0; t < count; ++t) compare_output(t, variables);
    if (a_.outputs().size() != b_.outputs().size())
      cannot(fmt::format("{} has {} outputs, {} has {}\n", name_a_, a_.outputs().size(), name_b_,
                         b_.outputs().size()));
    if (!same_variables) cannot("the archives hold different variables\n");
    if (any_difference_) {
      fmt::print(stderr, "\nComparison did NOT fully pass.\n");
      return exceeded;
    }
    fmt::print("\nComparison fully passed!\n");
    return passed;
  }

 private:
  void print_head() const {
    fmt::print("Using absolute tolerance: {:g}\nUsing relative tolerance: {:g}\n",
               options_.absolute, options_.relative);
    // The word is theirs: scripts may look for it.
    fmt::print("Comparision domain:  {}\n", options_.layers == Layers::extra
                                                ? "patch cells, including extra cells"
                                                : "interior patch cells, excluding extra cells");
  }

  // What cannot be compared: status 5, or 2 where a difference was seen before.
  [[noreturn]] void cannot(const std::string& why) const {
    std::fflush(stdout);
    fmt::print(stderr, "\n_______________ERROR:compare_uda___________________\n");
    const int status = any_difference_ ? exceeded : not_comparable;
    if (any_difference_)
      fmt::print(stderr,
                 " The tolerances are exceeded and the archives can no longer be compared.\n");
    else
      fmt::print(stderr, "{}\n  The uda directories may not be compared.\n", why);
    fmt::print(stderr,
               " Now exiting ({}).\n\n_______________ERROR:compare_uda___________________\n",
               status);
    throw ComparisonEnds{status};
  }

  std::vector<VariableEntry> selected(const Archive& archive) const {
    std::vector<VariableEntry> list;
    for (const VariableEntry& v : archive.index().variables) {
      if (!options_.labels.selects(v.name)) continue;
      if (!v.readable && !options_.skip_unknown) {
        fmt::print(stderr, "Variable {} is of a type that is not read: {}\n", v.name, v.type_name);
        throw ComparisonEnds{unknown_type};
      }
      if (v.readable) list.push_back(v);
    }
    if (options_.sorted)
      std::sort(list.begin(), list.end(),
                [](const VariableEntry& x, const VariableEntry& y) { return x.name < y.name; });
    return list;
  }

  std::vector<VariableEntry> common_variables(bool& same) const {
    std::vector<VariableEntry> of_a = selected(a_), of_b = selected(b_), common;
    for (const VariableEntry& v : of_a) {
      const auto other = std::find_if(of_b.begin(), of_b.end(),
                                      [&](const VariableEntry& w) { return w.name == v.name; });
      if (other == of_b.end()) continue;
      if (other->centring != v.centring || component_count(other->type) != component_count(v.type))
        cannot(fmt::format("Variable {} is {} in {} and {} in {}\n", v.name, v.type_name, name_a_,
                           other->type_name, name_b_));
      common.push_back(v);
    }
    same = common.size() == of_a.size() && common.size() == of_b.size();
    if (!same)
      fmt::print(stderr,
                 "WARNING: the archives hold different variables; those of both are compared.\n");
    return common;
  }

  void compare_output(std::size_t t, const std::vector<VariableEntry>& variables) {
    const StepEntry &ea = a_.outputs()[t], &eb = b_.outputs()[t];
    fmt::print("time = {:.7g}\n", ea.time);
    if (differ(ea.time, eb.time))
      cannot(fmt::format("Time {:.17g} in {} does not match {:.17g} in {}\n", ea.time, name_a_,
                         eb.time, name_b_));
    const ArchiveStep sa = a_.read_output(ea), sb = b_.read_output(eb);
    time_ = ea.time;
    const std::size_t levels = sa.grid().levels.size();
    if (options_.first_level < 0 && levels != sb.grid().levels.size())
      cannot(fmt::format("{} has {} levels, {} has {}\n", name_a_, levels, name_b_,
                         sb.grid().levels.size()));
    for (const VariableEntry& v : variables) {
      fmt::print("\tVariable: {:<20}, type {}\n", v.name, v.type_name);
      std::fflush(stdout);
      seen_here_ = false;
      if (v.centring == Centring::particle)
        compare_particles(sa, sb, v);
      else
        compare_levels(sa, sb, v);
    }
  }

  void compare_levels(const ArchiveStep& sa, const ArchiveStep& sb, const VariableEntry& v) {
    if (options_.first_level >= 0)
      return compare_level(sa, sb, v, options_.first_level, options_.second_level);
    for (const Level& level : sa.grid().levels) compare_level(sa, sb, v, level.index, level.index);
  }

  std::vector<int> materials_of(const ArchiveStep& step, const std::string& name, int level) const {
    std::vector<int> materials;
    for (const FieldInfo& f : step.fields())
      if (f.name == name && f.level == level) materials.push_back(f.material);
    return materials;
  }

  void compare_level(const ArchiveStep& sa, const ArchiveStep& sb, const VariableEntry& v, int la,
                     int lb) {
    const std::vector<int> materials = materials_of(sa, v.name, la);
    if (materials != materials_of(sb, v.name, lb))
      cannot(fmt::format("Variable {} is stored for different materials\n", v.name));
    for (const int material : materials) {
      const FieldInfo &fa = *sa.find(v.name, material, la), &fb = *sb.find(v.name, material, lb);
      const DenseField x = sa.read(fa, sa.range(fa, options_.layers), options_.layers);
      const DenseField y = sb.read(fb, sb.range(fb, options_.layers), options_.layers);
      for_each_cell(bounding(x.cells, y.cells), [&](IntVec3 c) {
        if (x.has(c) != y.has(c))
          cannot(
              fmt::format("Inconsistent patch coverage on level {} at time {:g}: ({},{},{}) is "
                          "covered by {} and not {}\n",
                          la, time_, c.x, c.y, c.z, x.has(c) ? name_a_ : name_b_,
                          x.has(c) ? name_b_ : name_a_));
        if (!x.has(c) || (options_.concise && seen_here_)) return;
        const auto values = [&](const DenseField& f) {
          std::vector<double> list;
          for (std::size_t m = 0; m < f.components.size(); ++m)
            list.push_back(f.at(c, static_cast<int>(m)));
          return list;
        };
        const std::vector<double> p = values(x), q = values(y);
        if (!values_differ(v.type, p, q)) return;
        fmt::print(stderr, "DIFFERENCE {}  ", index_text(c));
        tell(sa, sb, v, la, lb, material, c, p, q);
      });
    }
  }

  static int patch_of(const ArchiveStep& step, int level, IntVec3 c) {
    for (const PatchRecord& p : step.patches().at(level))
      if (p.outer.contains(c)) return p.id;
    return -1;
  }

  void tell(const ArchiveStep& sa, const ArchiveStep& sb, const VariableEntry& v, int la, int lb,
            int material, IntVec3 c, const std::vector<double>& p, const std::vector<double>& q) {
    fmt::print(stderr, "Time: {:g} Level: {} Patch1: {} Patch2: {} Material: {} Variable: {}\n",
               time_, la, patch_of(sa, la, c), patch_of(sb, lb, c), material, v.name);
    fmt::print(stderr, "{} (1)\t\t{} (2)\n{}\t\t{}\n", name_a_, name_b_, full_text(p),
               full_text(q));
    note_difference();
  }

  void note_difference() {
    any_difference_ = seen_here_ = true;
    if (!options_.warnings) throw ComparisonEnds{exceeded};
    fmt::print(stderr, "\n");
  }

  // By number where both have numbers, whatever the patches; else in stored order.
  void compare_particles(const ArchiveStep& sa, const ArchiveStep& sb, const VariableEntry& v) {
    if (particle_materials(sa) != particle_materials(sb))
      cannot("the archives hold particles of different materials\n");
    for (const int material : particle_materials(sa)) {
      const LabelFilter only{{v.name}, {}};
      const ParticleTable x = read_particles(sa, material, only);
      const ParticleTable y = read_particles(sb, material, only);
      if (x.size() != y.size())
        cannot(
            fmt::format("Inconsistent number of particles.\nTime: {:g}\nVariable: {}\nMaterial: "
                        "{}\n    {} has {} particles.\n    {} has {} particles.\n",
                        time_, v.name, material, name_a_, x.size(), name_b_, y.size()));
      if (x.numbered && y.numbered && x.ids != y.ids) cannot("    ParticleIDs do not match\n");
      const ParticleColumn *p = x.find(v.name), *q = y.find(v.name);
      if (p == nullptr || q == nullptr) continue;  // the numbers themselves
      for (std::size_t n = 0; n < x.size(); ++n) compare_particle(v, material, x, *p, *q, n);
    }
  }

  void compare_particle(const VariableEntry& v, int material, const ParticleTable& x,
                        const ParticleColumn& p, const ParticleColumn& q, std::size_t n) {
    if (options_.concise && seen_here_) return;
    const auto values = [&](const ParticleColumn& column) {
      std::vector<double> list;
      for (const std::vector<double>& component : column.components) list.push_back(component[n]);
      return list;
    };
    const std::vector<double> a = values(p), b = values(q);
    if (!values_differ(v.type, a, b)) return;
    if (x.numbered)
      fmt::print(stderr, "\nDIFFERENCE on particle id= {}\n", x.ids[n]);
    else
      fmt::print(stderr, "\nValues differ too much.\n");
    fmt::print(stderr, "Time: {:g}\nVariable: {}\nMaterial: {}\n{}:\n{}\n{}:\n{}\n", time_, v.name,
               material, name_a_, full_text(a), name_b_, full_text(b));
    note_difference();
  }

  bool differ(double a, double b) const {
    if (std::isnan(a) || std::isnan(b)) return true;
    const double d = std::abs(a - b), largest = std::max(std::abs(a), std::abs(b));
    return d > options_.absolute && largest > 0 && d / largest > options_.relative;
  }

  bool values_differ(ValueType type, const std::vector<double>& a,
                     const std::vector<double>& b) const {
    if (type == ValueType::integer || type == ValueType::long_integer) return a != b;
    if (a.size() == 9) return differ(norm(a), norm(b));
    return !std::equal(a.begin(), a.end(), b.begin(), b.end(),
                       [&](double x, double y) { return !differ(x, y); });
  }

  static double norm(const std::vector<double>& tensor) {
    double sum = 0;
    for (const double x : tensor) sum += x * x;
    return std::sqrt(sum);
  }

  static std::string full_text(const std::vector<double>& value) {
    if (value.size() == 1) return fmt::format("{:.18g}", value[0]);
    std::string text;
    for (const double x : value) text += fmt::format("{}{:.18g}", text.empty() ? "[" : ", ", x);
    return text + "]";
  }

  std::string name_a_, name_b_;
  CompareUdaOptions options_;
  Archive a_, b_;
  double time_ = 0;
  bool any_difference_ = false;
  bool seen_here_ = false;  // in the variable that is being compared
};

CompareUdaOptions compare_options(const ClassicArguments& arguments) {
  CompareUdaOptions o;
  const bool exact = arguments.has("-exact");
  o.absolute = exact ? 0 : arguments.real("-abs_tolerance", o.absolute);
  o.relative = exact ? 0 : arguments.real("-rel_tolerance", o.relative);
  if (!(o.absolute >= 0) || !(o.relative >= 0)) arguments.refuse("a tolerance is negative");
  o.warnings = arguments.has("-as_warnings");
  o.concise = arguments.has("-concise");
  o.skip_unknown = arguments.has("-skip_unknown_types");
  o.sorted = !arguments.has("-dont_sort");
  if (arguments.has("-includeExtraCells")) o.layers = Layers::extra;
  if (const auto levels = arguments.pair("-levels")) {
    o.first_level = levels->first;
    o.second_level = levels->second;
    if (o.first_level < 0 || o.second_level < 0) arguments.refuse("-levels: a level is negative");
  }
  o.labels = {split_names(arguments.text("-compareVariables")),
              split_names(arguments.text("-ignoreVariables"))};
  return o;
}

}  // namespace

int run_compare_uda(const ClassicCall& call) {
  const ClassicArguments arguments(compare_spec(), call.words);
  if (arguments.has("-h")) {
    fmt::print(stderr, "{}", usage_of(compare_spec()));
    return 1;
  }
  if (arguments.positional().size() != 2)
    arguments.refuse("You must specify two archive directories.");
  try {
    return UdaComparison(arguments.positional()[0], arguments.positional()[1],
                         compare_options(arguments))
        .run();
  } catch (const ComparisonEnds& end) {
    return end.status;
  }
}

}  // namespace sluice
