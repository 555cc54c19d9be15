// Laws and tables of gases that follow from a mixture fraction.
#include "models/gases/mixed_gas.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"
#include "models/gases/adiabatic_table.hpp"
#include "models/gases/flame_sheet.hpp"
#include "models/gases/table_expression.hpp"

namespace sluice::models::mixed_gas_test {
namespace {

using testing::HasSubstr;

TEST(MixedGas, IsLinearBetweenNodesAndConstantBeyond) {
  MixedGas gas;
  gas.set_nodes({{0, 1}, {0.125, 3}, {0.25, 2}, {1, 8}});
  EXPECT_EQ(gas.specific_heat(-1), 1);
  EXPECT_EQ(gas.specific_heat(0.0625), 2);
  EXPECT_EQ(gas.specific_heat(0.125), 3);
  EXPECT_EQ(gas.specific_heat(0.625), 5);
  EXPECT_EQ(gas.specific_heat(7), 8);
  EXPECT_EQ(gas.lowest_specific_heat(), 1);
}

// Nodes at random places: the interval found is that of a search through all.
TEST(MixedGas, FindsTheIntervalOfEveryFraction) {
  std::vector<MixedGas::Node> nodes(57);
  for (std::size_t n = 1; n < nodes.size(); ++n)
    nodes[n].f = nodes[n - 1].f + (n % 7 == 0 ? 0.11 : 1e-4 * static_cast<double>(1 + n % 5));
  for (MixedGas::Node& node : nodes) node.heat = 3 * node.f * node.f;
  MixedGas gas;
  gas.set_nodes(nodes);
  for (int k = 0; k <= 4000; ++k) {
    const double f = nodes.back().f * k / 4000.0;
    std::size_t n = 0;
    while (n + 2 < nodes.size() && nodes[n + 1].f <= f) ++n;
    const double a = nodes[n].f, b = nodes[n + 1].f;
    ASSERT_NEAR(gas.heat(f), 3 * (a * a + (b * b - a * a) * (f - a) / (b - a)), 1e-13) << f;
  }
}

TEST(MixedGas, RowsAreWhatSingleCellsAre) {
  for (const std::size_t count : {std::size_t{2}, std::size_t{5}}) {
    std::vector<MixedGas::Node> nodes(count);
    for (std::size_t n = 0; n < count; ++n) {
      nodes[n].f = static_cast<double>(n) / static_cast<double>(count - 1);
      nodes[n].cv = std::exp(nodes[n].f);
    }
    MixedGas gas;
    gas.set_nodes(nodes);
    double f[100];
    for (int i = 0; i < 100; ++i) f[i] = -0.1 + 0.012 * i;
    gas.for_each_in_row(100, f, [&](int i, const MixedGas::Between& at) {
      EXPECT_EQ(at(&MixedGas::Node::cv), gas.specific_heat(f[i]));
    });
  }
}

// All fuel of a lean mixture burns, all oxidizer of a rich one.
TEST(FlameSheet, GivesTheHeatOfWhatBurns) {
  MixedGas gas;
  gas.set_nodes(flame_sheet_nodes(0.0625, 5e7));
  for (const double f : {0.0, 0.01, 0.05, 0.0625, 0.1, 0.5, 1.0}) {
    const double oxidizer_per_fuel = (1 - 0.0625) / 0.0625;
    const double burnt = std::min(f, (1 - f) / oxidizer_per_fuel);
    EXPECT_NEAR(gas.heat(f), 5e7 * burnt, 1e-8) << f;
  }
}

TEST(TableExpression, FollowsTheRulesOfArithmetic) {
  const ColumnLookup lookup = [](const std::string& name, bool axis) {
    return axis ? 0.25 : name == "a b" ? 3.0 : 5.0;
  };
  EXPECT_EQ(evaluate_expression(" 1 + 2*3 ", lookup), 7);
  EXPECT_EQ(evaluate_expression("-(1+2)*[a b]/4", lookup), -2.25);
  EXPECT_EQ(evaluate_expression("8*(1-{f}) + 4e0*{f}", lookup), 7);
  EXPECT_EQ(evaluate_expression("[c]-8314*[c]", lookup), 5 - 8314.0 * 5);
  EXPECT_EQ(evaluate_expression("8-4-2", lookup), 2);
  for (const char* bad : {"", "1+", "2 3", "(1", "[a", "x"})
    EXPECT_THROW(evaluate_expression(bad, lookup), InputError) << bad;
}

class Tables : public testing::Test {
 protected:
  std::string write(const std::string& text) {
    const std::string path = (folder_.path() / "gas.rxn").string();
    std::ofstream(path) << text;
    return path;
  }
  static std::string bytes_of(const std::string& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::string refusal(const std::string& text, PropertyTable::Additions additions = {}) {
    try {
      adiabatic_nodes(PropertyTable(write(text), std::move(additions)));
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }
  TemporaryFolder folder_;
};

constexpr const char* two_columns =
    "# a table\n1\nmixture_fraction\n3\n2\ntemperature heat_capac_Cv\nK J\n"
    "0 0.5 1\n300 900 400\n\n# cv\n0 0.5 1\n700 800 900\n";

TEST_F(Tables, GiveAGasItsHeatOfMixing) {
  PropertyTable::Additions more;
  more.constants = {{"viscosity", 1e-5}, {"thermal_conductivity", 0.1}, {"reference_Temp", 300}};
  more.derived = {{"gamma", "1.5 - 0.125*{mixture_fraction}"},
                  {"reference_gamma", "[gamma]"},
                  {"reference_heat_capac_Cv", "[heat_capac_Cv]"}};
  const auto nodes = adiabatic_nodes(PropertyTable(write(two_columns), more));
  ASSERT_EQ(nodes.size(), 3u);
  EXPECT_EQ(nodes[1].f, 0.5);
  EXPECT_EQ(nodes[1].R, (1.4375 - 1) * 800);
  EXPECT_EQ(nodes[0].heat, 0);
  EXPECT_NEAR(nodes[1].heat, 600 * 1.4375 * 800, 1e-9);  // (T_f - T_r) cp
  EXPECT_EQ(nodes[2].conductivity, 0.1);
}

// At one value of the second axis, between two of its points.
TEST_F(Tables, AreTakenAtTheDefaultOfASecondAxis) {
  const std::string text = "2\nF Fvar\n2 3\n1\nTemp\nK\n0 0.5 1\n0 1\n1 2\n3 4\n5 6\n";
  PropertyTable::Additions more;
  EXPECT_EQ(PropertyTable(write(text), more).column("Temp"), (std::vector<double>{1, 2}));
  more.defaults["mixture_fraction_variance"] = 0.75;
  EXPECT_EQ(PropertyTable(write(text), more).column("temperature"), (std::vector<double>{4, 5}));
}

TEST_F(Tables, SayWhatIsWrongWithThem) {
  EXPECT_THAT(refusal(two_columns), HasSubstr("no column gamma; there are Temp, heat_capac_Cv"));
  EXPECT_THAT(refusal("1\nheat_loss\n2\n"), HasSubstr("gas.rxn:2:1: the first axis"));
  EXPECT_THAT(refusal("3\n"), HasSubstr("gas.rxn:1:1: the number of axes"));
  EXPECT_THAT(
      refusal("1\nF\n2\n1\nTemp\nK\n0 1\n2 x\n"),
      HasSubstr("gas.rxn:8:3: 'x' is not a number; expected a number (values of a column)"));
  EXPECT_THAT(refusal("1\nF\n2\n1\nTemp\nK\n0 1\n2 3 4\n"), HasSubstr("gas.rxn:8:5: "));
  EXPECT_THAT(refusal("1\nF\n2\n1\nTemp\nK\n0 1\n2 3\n7\n"),
              HasSubstr("gas.rxn:9:1: '7' found after the end of the table"));
  EXPECT_THAT(refusal("1\nF\n2\n1\nTemp\nK\n1 0\n2 2\n"), HasSubstr("increasing"));
  EXPECT_THAT(refusal("1\nF\n2\n1\nTemp\nK\n0 1\n"), HasSubstr("ends where"));
  PropertyTable::Additions circle;
  circle.derived = {{"gamma", "[a]"}, {"a", "[gamma]"}};
  EXPECT_THAT(refusal(two_columns, circle), HasSubstr("depends on itself"));
  EXPECT_THROW(PropertyTable("there_is_no.rxn", {}), InputError);
}

// As gzip leaves it, whatever the file is called.
TEST_F(Tables, ThatArePackedAreTheSame) {
  const std::string text = "1\nF\n2\n1\nTemp\nK\n0 1\n300.25 1e3\n";
  for (const char* name : {"gas.rxn.gz", "packed.rxn"}) {
    const std::string path = (folder_.path() / name).string();
    const gzFile out = gzopen(path.c_str(), "wb");
    gzputs(out, text.c_str());
    gzclose(out);
    std::string packed = bytes_of(path);
    EXPECT_NE(packed, text);
    EXPECT_EQ(PropertyTable(path, {}).column("Temp"),
              PropertyTable(write(text), {}).column("Temp"));
    const auto said_of = [&](const std::string& bytes) -> std::string {
      std::ofstream(path) << bytes;
      try {
        PropertyTable(path, {});
      } catch (const InputError& e) {
        return e.what();
      }
      return "accepted";
    };
    EXPECT_THAT(said_of(packed.substr(0, packed.size() - 9)),
                HasSubstr(path + ": ends before it is unpacked completely"));
    packed[packed.size() - 5] ^= 1;  // of the check sum
    EXPECT_THAT(said_of(packed), HasSubstr(path + ": cannot be unpacked"));
  }
}

}  // namespace
}  // namespace sluice::models::mixed_gas_test
