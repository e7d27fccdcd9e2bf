// Owns the tests of CSV text: quoting by RFC 4180, numbers back to the bit, columns as lines.
#include "results/text/csv.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>

namespace beltlife {
namespace {

TEST(Csv, QuotesOnlyWhatWouldBeMistakenAndDoublesQuotes) {
  EXPECT_EQ(csv_field("crank"), "crank");
  EXPECT_EQ(csv_field("span a-b [N]"), "span a-b [N]");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("say \"no\""), "\"say \"\"no\"\"\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_field(" blank"), "\" blank\"");
  EXPECT_EQ(csv_field(""), "\"\"");
}

TEST(Csv, NumbersReadBackToTheSameBits) {
  std::mt19937_64 draw(1);
  std::vector<double> values{0.0,
                             -0.0,
                             0.1,
                             1.0 / 3,
                             5e-324,
                             std::numeric_limits<double>::max(),
                             std::nextafter(1.0, 2.0),
                             std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()};
  while (values.size() < 10000)
    if (const double v = std::bit_cast<double>(draw()); std::isfinite(v)) values.push_back(v);
  for (const double value : values) {
    const std::string text = csv_number(value);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)), std::bit_cast<std::uint64_t>(value))
        << text;
    EXPECT_LE(text.size(), 24u) << text << ": sign, 17 digits, point, exponent of five";
  }
  EXPECT_EQ(csv_number(-std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(Csv, HasAHeaderAndALineForEachRow) {
  EXPECT_EQ(csv_text({{"time [s]", {"0", "0.5"}}, {"a,b", {"\"x\"", "y"}}}), "time [s],\"a,b\"\n0,\"x\"\n0.5,y\n");
  EXPECT_EQ(csv_text({{"empty", {}}}), "empty\n");
}

}  // namespace
}  // namespace beltlife
