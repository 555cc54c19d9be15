// Tables in all forms that programs write, and what is refused of them.
#include "framework/base/data_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::data_lines_test {
namespace {

using Rows = std::vector<std::vector<double>>;

class Table : public testing::Test {
 protected:
  // Of three columns.
  Rows read(const std::string& text) {
    const std::string file = (folder_ / "t.tab").string();
    std::ofstream(file, std::ios::binary) << text;
    Rows rows;
    read_table(file, {"time", "u", "v"}, [&](const TableRow& row) {
      rows.push_back({row[0], row[1], row[2]});
    });
    return rows;
  }
  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& e) {
      const std::string message = e.what();
      const std::size_t name = message.find("t.tab");
      return name == std::string::npos ? message : message.substr(name);
    }
    return "read";
  }

  TemporaryFolder folder_;
};

const Rows two_rows = {{0, 1, 2}, {3, -4.5, 6}};

TEST_F(Table, LinesEndInAnyWay) {
  EXPECT_EQ(read("0 1 2\n3 -4.5 6\n"), two_rows);
  EXPECT_EQ(read("0 1 2\r\n3 -4.5 6\r\n"), two_rows);
  EXPECT_EQ(read("0 1 2\r3 -4.5 6\r"), two_rows);
  EXPECT_EQ(read("0 1 2\n3 -4.5 6"), two_rows);
  EXPECT_EQ(read("\xef\xbb\xbf\n\r\n 0\t1 , 2 \r\r3,-4.5,6"), two_rows);
}

TEST_F(Table, CommentsAndBlankLinesAreNoRows) {
  EXPECT_EQ(read("# time u v\n\n0 1 2 # m/s\n  \n#\n3 -4.5 6\n"), two_rows);
}

TEST_F(Table, NumbersInTheFormsOfOtherPrograms) {
  EXPECT_EQ(read("1.5d-3 1.5D-3 1.5e-3\n1. .5 +2\n1.e5 1e+2 -0.0\n"),
            (Rows{{1.5e-3, 1.5e-3, 1.5e-3}, {1, 0.5, 2}, {1e5, 100, 0}}));
}

TEST_F(Table, EveryRowIsReadToItsEnd) {
  EXPECT_EQ(refusal("0 1 2\n0 1 2 7\n"),
            "t.tab:2:7: '7' found after the last number; expected 3 numbers per line: time, u, v");
  EXPECT_EQ(refusal("0 1 2 m/s\n"),
            "t.tab:1:7: 'm/s' found after the last number; expected 3 numbers per line: time, u, "
            "v");
  EXPECT_EQ(refusal("0 1 2\r3 4\r"), "t.tab:2:4: number 3 of 3 (v) is missing");
  EXPECT_EQ(refusal("0 1 2x\n"), "t.tab:1:5: '2x' is not a number; expected number 3 of 3 (v)");
  EXPECT_EQ(refusal("\xef\xbb\xbf 0 1,,2\n"),
            "t.tab:1:6: there is nothing before this comma; expected a number");
}

TEST_F(Table, WhatIsNoNumberIsRefused) {
  for (const char* word : {"nan", "inf", "0x10", "1.5-3", "1.2.3", "--1", "+-1", "1d", "1e2e3",
                           "1d2d3", "\xc2\xbd", "true"})
    EXPECT_EQ(refusal(std::string("0 ") + word + " 2\n"),
              "t.tab:1:3: '" + std::string(word) + "' is not a number; expected number 2 of 3 (u)");
  EXPECT_EQ(refusal("0 1e999 2\n"),
            "t.tab:1:3: '1e999' is outside the range of a double; expected number 2 of 3 (u)");
}

// Characters, not bytes, are counted.
TEST_F(Table, ColumnsBehindOtherLetters) {
  EXPECT_EQ(refusal("0 1 2 \xc3\xa9\xc3\xa9 x\n").substr(0, 10), "t.tab:1:7:");
  EXPECT_EQ(refusal("\xc3\xa9\xc3\xa9 1 2\n").substr(0, 10), "t.tab:1:1:");
}

TEST_F(Table, AFileWithoutRowsIsRefused) {
  EXPECT_EQ(refusal("# nothing\n"), "t.tab: no rows; expected 3 numbers per line: time, u, v");
  EXPECT_THAT(refusal("\xff\xfe"
                      "0"),
              testing::HasSubstr("is in UTF-16"));
  EXPECT_THAT([] { read_table("no_such.tab", {"x"}, [](const TableRow&) {}); },
              testing::ThrowsMessage<InputError>(
                  testing::HasSubstr("'no_such.tab' cannot be opened: no such file")));
}

}  // namespace
}  // namespace sluice::data_lines_test
