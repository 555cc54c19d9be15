// compute_Lnorm_udas: L1, L2 and Linf norms of the differences of two archives, on the terminal and
// in files Lnorm/L-<level>/<variable>_<material>.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "app/classic/classic_archive.hpp"
#include "app/classic/classic_tools.hpp"
#include "framework/archive/selection.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

ClassicSpec norm_spec() {
  return {"compute_Lnorm_udas",
          "[options] <archive 1> <archive 2>",
          {{"-h -help", "", "this text"},
           {"-ignoreVariables", "<a,b>", "all variables but these"},
           {"-compareVariables", "<a,b>", "these variables only"},
           {"-timeTolerance", "<x>", "allowed distance of the times (1e-5)"}}};
}

constexpr int not_comparable_status = 5;

struct NormsDiffer {
  std::string why;
};

// By component.
struct ClassicNorms {
  std::vector<double> l1, l2, linf;
  std::int64_t cells = 0;

  void add(const std::vector<double>& difference) {
    if (l1.empty()) l1.resize(difference.size()), l2 = linf = l1;
    for (std::size_t c = 0; c < difference.size(); ++c) {
      l1[c] += difference[c];
      l2[c] += difference[c] * difference[c];
      linf[c] = std::max(linf[c], difference[c]);
    }
    ++cells;
  }
  void finish() {
    for (double& x : l1) x /= static_cast<double>(cells);
    for (double& x : l2) x = std::sqrt(x / static_cast<double>(cells));
  }
};

std::string short_numbers(const std::vector<double>& v) {
  if (v.size() == 1) return fmt::format("{:g}", v[0]);
  std::string text = " ";
  for (const double x : v) text += fmt::format("{:g} ", x);
  return text;
}

ClassicNorms norms_between(const ArchiveStep& a, const ArchiveStep& b, const FieldInfo& fa,
                           const FieldInfo& fb) {
  const DenseField x = a.read(fa), y = b.read(fb);
  const Level &la = a.grid().levels[fa.level], &lb = b.grid().levels[fb.level];
  ClassicNorms norms;
  for_each_cell(x.cells, [&](IntVec3 c) {
    if (!x.has(c)) return;
    if (!y.has(c) || la.centre(c) != lb.centre(c))
      throw NormsDiffer{fmt::format(
          "You can't compare data at different physical locations: {} of level {} at {}", fa.name,
          fa.level, index_text(c))};
    std::vector<double> difference;
    for (int m = 0; m < fa.components(); ++m)
      difference.push_back(std::abs(x.at(c, m) - y.at(c, m)));
    norms.add(difference);
  });
  norms.finish();
  return norms;
}

// A file begins with its head at the first output.
void append_line(const fs::path& file, bool first, double time, const ClassicNorms& n) {
  fs::create_directories(file.parent_path());
  std::ofstream out(file, first ? std::ios::trunc : std::ios::app);
  if (first) {
    fmt::print(" Now creating the file: {}\n", file.string());
    out << "#Time \t\t\t L1 \t\t L2 \t\t Linf\n";
  }
  const auto text = [](const std::vector<double>& v) {
    return v.size() == 3 ? vector_text({v[0], v[1], v[2]}, 10) : number_text(v[0], 10);
  };
  out << number_text(time, 10) << ' ' << text(n.l1) << ' ' << text(n.l2) << ' ' << text(n.linf)
      << '\n';
  if (!out.flush()) throw SystemError("cannot write " + file.string() + ": is the disk full?");
}

class LnormRun {
 public:
  LnormRun(const ClassicArguments& arguments)
      : a_(Archive::open(arguments.positional()[0])),
        b_(Archive::open(arguments.positional()[1])),
        labels_{split_names(arguments.text("-compareVariables")),
                split_names(arguments.text("-ignoreVariables"))},
        time_tolerance_(arguments.real("-timeTolerance", 1e-5)) {}

  void run() {
    const std::size_t count = std::min(a_.outputs().size(), b_.outputs().size());
    for (std::size_t t = 0; t < count; ++t) {
      const StepEntry &ea = a_.outputs()[t], &eb = b_.outputs()[t];
      fmt::print("time = {:g}\n", ea.time);
      if (std::abs(ea.time - eb.time) > time_tolerance_)
        throw NormsDiffer{fmt::format(
            "Timestep at time {:.17g} in {} does not match\ntimestep at time {:.17g} in {} within "
            "the allowable tolerance.",
            ea.time, a_.folder().string(), eb.time, b_.folder().string())};
      const ArchiveStep sa = a_.read_output(ea), sb = b_.read_output(eb);
      if (sa.grid().levels.size() != sb.grid().levels.size())
        throw NormsDiffer{fmt::format("the grids have {} and {} levels", sa.grid().levels.size(),
                                      sb.grid().levels.size())};
      for (const VariableEntry& v : a_.index().variables)
        if (v.readable && v.centring != Centring::particle && component_count(v.type) < 9 &&
            labels_.selects(v.name))
          compare_variable(sa, sb, v, ea.time);
    }
  }

 private:
  void compare_variable(const ArchiveStep& sa, const ArchiveStep& sb, const VariableEntry& v,
                        double time) {
    const auto& others = b_.index().variables;
    if (std::none_of(others.begin(), others.end(),
                     [&](const VariableEntry& w) { return w.name == v.name; }))
      return;
    fmt::print("\t{}\n", v.name);
    for (const Level& level : sa.grid().levels) {
      fmt::print(" \t\t L-{}", level.index);
      for (const FieldInfo& f : sa.fields()) {
        if (f.name != v.name || f.level != level.index) continue;
        const FieldInfo* other = sb.find(f.name, f.material, f.level);
        if (other == nullptr || other->components() != f.components())
          throw NormsDiffer{
              fmt::format("The variable ({}) was not found in both archives", v.name)};
        fmt::print("\t{} Matl-{}", f.material > 0 ? "\t\t" : "", f.material);
        const ClassicNorms n = norms_between(sa, sb, f, *other);
        const fs::path file = fs::path("Lnorm") / fmt::format("L-{}", level.index) /
                              fmt::format("{}_{}", v.name, f.material);
        const bool first = std::find(begun_.begin(), begun_.end(), file) == begun_.end();
        if (first) begun_.push_back(file);
        append_line(file, first, time, n);
        fmt::print(" \t norms: L1 {} L2: {} Linf: {} n_cells: {}\n", short_numbers(n.l1),
                   short_numbers(n.l2), short_numbers(n.linf), n.cells);
      }
    }
  }

  Archive a_, b_;
  LabelFilter labels_;
  double time_tolerance_;
  std::vector<fs::path> begun_;
};

}  // namespace

int run_compute_lnorm(const ClassicCall& call) {
  const ClassicArguments arguments(norm_spec(), call.words);
  if (arguments.has("-h")) {
    fmt::print("{}", usage_of(norm_spec()));
    return 1;
  }
  if (arguments.positional().size() != 2)
    arguments.refuse("You must specify two archive directories.");
  try {
    LnormRun(arguments).run();
  } catch (const NormsDiffer& e) {
    std::fflush(stdout);
    fmt::print(stderr, "\n{}\n\nThe uda directories may not be compared.\n", e.why);
    return not_comparable_status;
  }
  return 0;
}

}  // namespace sluice
