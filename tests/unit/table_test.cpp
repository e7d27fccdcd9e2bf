// Owns the tests of plain-text tables.
#include "results/text/table.h"

#include <gtest/gtest.h>

namespace beltlife {
namespace {

TEST(Table, AlignsNumbersRightWithTheirHeaderAndWordsLeft) {
  Table table({"pulley", "life h", "side"});
  table.row({"crank", "1580", "front"});
  table.row({"idler_2", "-3.5e+20", "back"});
  table.row({"tensioner", "inf", ""});
  EXPECT_EQ(table.text(),
            "pulley       life h  side\n"
            "crank          1580  front\n"
            "idler_2    -3.5e+20  back\n"
            "tensioner       inf\n");
}

TEST(Table, IndentsEveryLine) {
  Table table({"a"});
  table.row({"b"});
  EXPECT_EQ(table.text(2), "  a\n  b\n");
}

TEST(Table, CountsCharactersNotBytes) {
  Table table({"σ_m", "x"});
  table.row({"µm", "y"});
  table.row({"abcd", "z"});
  EXPECT_EQ(table.text(), "σ_m   x\nµm    y\nabcd  z\n");
}

TEST(Table, TakesRowsShorterAndLongerThanTheHeader) {
  Table table({"a", "b"});
  table.row({"1"});
  table.row({"2", "3", "4"});
  EXPECT_EQ(table.text(), "a  b\n1\n2  3  4\n");
}

TEST(Table, OfAHeaderAloneIsItsHeader) { EXPECT_EQ(Table({"a", "b"}).text(), "a  b\n"); }

}  // namespace
}  // namespace beltlife
