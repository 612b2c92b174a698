#include "meniscus/report/text.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace meniscus::report {
namespace {

TEST(Text, EscapesWhatMarkupMeans) {
  EXPECT_EQ(markup_text("a<b> & \"c\"\n\x01\x1b é"), "a&lt;b&gt; &amp; &quot;c&quot;\n é");
}

TEST(Text, NumbersForReaders) {
  EXPECT_EQ(number_text(0.0), "0");
  EXPECT_EQ(number_text(0.123456), "0.1235");
  EXPECT_EQ(number_text(-1.5), "−1.5");
  EXPECT_EQ(number_text(12345.0), "12345");
  EXPECT_EQ(number_text(1234.4, 2), "1234");
  EXPECT_EQ(number_text(100.0, 1), "100");
  EXPECT_EQ(number_text(999.99, 2), "1000");
  EXPECT_EQ(number_text(999999.9, 2), "1.0×10⁶");
  EXPECT_EQ(number_text(1e-13, 2), "1.0×10⁻¹³");
  EXPECT_EQ(number_text(9.9999e-14, 2), "1.0×10⁻¹³");  // not 10×10⁻¹⁴
  EXPECT_EQ(number_text(-2.5e7, 2), "−2.5×10⁷");
  EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "–");
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "–");
}

TEST(Text, FixedDecimals) {
  EXPECT_EQ(decimal_text(1.54, 4), "1.5400");
  EXPECT_EQ(decimal_text(-0.25, 1), "−0.2");
  EXPECT_EQ(decimal_text(-1e-12, 2), "0.00");
  EXPECT_EQ(decimal_text(std::numeric_limits<double>::quiet_NaN(), 2), "–");
}

TEST(Text, CountsAreGroupedByThousands) {
  EXPECT_EQ(count_text(0.0), "0");
  EXPECT_EQ(count_text(999.0), "999");
  EXPECT_EQ(count_text(1234567.0), "1\u202f234\u202f567");
  EXPECT_EQ(count_text(-1000.0), "−1\u202f000");
  EXPECT_EQ(count_text(std::numeric_limits<double>::quiet_NaN()), "–");
}

TEST(Text, Durations) {
  EXPECT_EQ(duration_text(0.349), "0.35 s");
  EXPECT_EQ(duration_text(12.44), "12.4 s");
  EXPECT_EQ(duration_text(185.2), "3 min 05 s");
  EXPECT_EQ(duration_text(7625.0), "2 h 07 min");
  EXPECT_EQ(duration_text(std::numeric_limits<double>::infinity()), "–");
}

TEST(Text, Superscripts) { EXPECT_EQ(superscript(-120), "⁻¹²⁰"); }

}  // namespace
}  // namespace meniscus::report
