#include "meniscus/report/text.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace meniscus::report {
namespace {

TEST(Text, EscapesWhatMarkupMeans) {
  EXPECT_EQ(escaped("a<b> & \"c\"\n\x01\x1b é"), "a&lt;b&gt; &amp; &quot;c&quot;\n é");
}

TEST(Text, NumbersForReaders) {
  EXPECT_EQ(readable(0.0), "0");
  EXPECT_EQ(readable(0.123456), "0.1235");
  EXPECT_EQ(readable(-1.5), "−1.5");
  EXPECT_EQ(readable(12345.0), "12345");
  EXPECT_EQ(readable(1234.4, 2), "1234");
  EXPECT_EQ(readable(100.0, 1), "100");
  EXPECT_EQ(readable(999.99, 2), "1000");
  EXPECT_EQ(readable(999999.9, 2), "1.0×10⁶");
  EXPECT_EQ(readable(1e-13, 2), "1.0×10⁻¹³");
  EXPECT_EQ(readable(9.9999e-14, 2), "1.0×10⁻¹³");  // not 10×10⁻¹⁴
  EXPECT_EQ(readable(-2.5e7, 2), "−2.5×10⁷");
  EXPECT_EQ(readable(std::numeric_limits<double>::quiet_NaN()), "–");
  EXPECT_EQ(readable(std::numeric_limits<double>::infinity()), "–");
}

TEST(Text, FixedDecimals) {
  EXPECT_EQ(fixed(1.54, 4), "1.5400");
  EXPECT_EQ(fixed(-0.25, 1), "−0.2");
  EXPECT_EQ(fixed(-1e-12, 2), "0.00");
  EXPECT_EQ(fixed(std::numeric_limits<double>::quiet_NaN(), 2), "–");
}

TEST(Text, CountsAreGroupedByThousands) {
  EXPECT_EQ(readable_count(0.0), "0");
  EXPECT_EQ(readable_count(999.0), "999");
  EXPECT_EQ(readable_count(1234567.0), "1\u202f234\u202f567");
  EXPECT_EQ(readable_count(-1000.0), "−1\u202f000");
  EXPECT_EQ(readable_count(std::numeric_limits<double>::quiet_NaN()), "–");
}

TEST(Text, Durations) {
  EXPECT_EQ(readable_duration(0.349), "0.35 s");
  EXPECT_EQ(readable_duration(12.44), "12.4 s");
  EXPECT_EQ(readable_duration(185.2), "3 min 05 s");
  EXPECT_EQ(readable_duration(7625.0), "2 h 07 min");
  EXPECT_EQ(readable_duration(std::numeric_limits<double>::infinity()), "–");
}

TEST(Text, Superscripts) { EXPECT_EQ(superscript(-120), "⁻¹²⁰"); }

}  // namespace
}  // namespace meniscus::report
