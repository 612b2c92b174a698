#include "meniscus/io/table.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "tests/io/full_disk.hpp"
#include "tests/io/temporary_folder.hpp"

namespace meniscus::io {
namespace {

using test::get;
using test::message_of;
using test::put;

TEST(Table, WritesCellsOfEveryKind) {
  const test::TemporaryFolder folder;
  TableWriter writer(folder / "t.csv", {"step", "t", "note"});
  writer.add({std::int64_t{0}, 0.1, "a"});
  writer.add({std::int64_t{1}, std::monostate(), "b,\"c\"\nd"});
  EXPECT_EQ(get(folder / "t.csv"), "step,t,note\n0,0.1,a\n1,,\"b,\"\"c\"\"\nd\"\n");
  const Table table = read_commented_table(folder / "t.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"step", "t", "note"}));
  EXPECT_EQ(table.rows[1][2], "b,\"c\"\nd");
  EXPECT_EQ(table.column("t")[0], 0.1);
  EXPECT_TRUE(std::isnan(table.column("t")[1]));
  EXPECT_TRUE(std::isnan(table.column("note")[0]));
  EXPECT_EQ(table.find("note"), 2U);
  EXPECT_EQ(table.find("x"), std::nullopt);
}

TEST(Table, EveryDoubleReadsBackTheSame) {
  const test::TemporaryFolder folder;
  std::mt19937_64 random(7);
  std::vector<double> values = {
      0.0, -0.0, 1.0 / 3.0, 1e300, 5e-324, 1e22, std::numeric_limits<double>::infinity()};
  while (values.size() < 2000) {
    const double value = std::bit_cast<double>(random());
    if (!std::isnan(value)) values.push_back(value);
  }
  {
    TableWriter writer(folder / "t.csv", {"x"});
    for (const double value : values) writer.add({value});
  }
  EXPECT_EQ(read_table(folder / "t.csv").column("x"), values);
}

TEST(Table, RowIsWithTheSystemBeforeAddReturns) {
  const test::TemporaryFolder folder;
  TableWriter writer(folder / "t.csv", {"step"});
  EXPECT_EQ(get(folder / "t.csv"), "step\n");
  writer.add({std::int64_t{5}});
  EXPECT_EQ(get(folder / "t.csv"), "step\n5\n");  // while the writer is open
}

TEST(Table, ResumingDropsLaterRowsAndATornLine) {
  const test::TemporaryFolder folder;
  put(folder / "t.csv", "step,t\n0,0\n0,0\n1,0.1\n2,0.2\n3,0.");
  {
    TableWriter writer(folder / "t.csv", {"step", "t"}, 2);
    EXPECT_EQ(get(folder / "t.csv"), "step,t\n0,0\n0,0\n1,0.1\n");
    writer.add({std::int64_t{2}, 0.25});
  }
  EXPECT_EQ(get(folder / "t.csv"), "step,t\n0,0\n0,0\n1,0.1\n2,0.25\n");
  // A torn line whose step is kept, with all its cells or not: its last number may be cut short.
  for (const char* torn : {"1,0.", "1", "1,"}) {
    put(folder / "t.csv", std::string("step,t\n0,0\n") + torn);
    const TableWriter writer(folder / "t.csv", {"step", "t"}, 2);
    EXPECT_EQ(get(folder / "t.csv"), "step,t\n0,0\n") << torn;
  }
}

TEST(Table, ReadingARunsTableLeavesATornLineOut) {
  const test::TemporaryFolder folder;
  for (const char* torn : {"", "1", "1,", "1,0.12", "1,1.5e-"}) {
    put(folder / "t.csv", std::string("step,t\n0,0.5\n") + torn);
    EXPECT_EQ(read_table(folder / "t.csv").column("t"), std::vector<double>{0.5}) << torn;
  }
  put(folder / "t.csv", "step,t\n0,0.5\n1,0.12");
  EXPECT_EQ(read_commented_table(folder / "t.csv").column("t").size(), 2);
}

TEST(Table, ResumedFileEqualsTheUninterruptedOneWhereverItWasCut) {
  const test::TemporaryFolder folder;
  const auto add_rows = [](TableWriter& writer, int first) {
    for (int step = first; step < 6; ++step)
      writer.add({std::int64_t{step}, std::sqrt(step), "é,"});
  };
  const std::vector<std::string> columns = {"step", "t", "text"};
  {
    TableWriter writer(folder / "whole.csv", columns);
    add_rows(writer, 0);
  }
  const std::string whole = get(folder / "whole.csv");
  for (std::size_t cut = whole.find("\n3,"); cut <= whole.size(); ++cut) {
    put(folder / "cut.csv", whole.substr(0, cut));
    TableWriter writer(folder / "cut.csv", columns, 2);
    add_rows(writer, 2);
    ASSERT_EQ(get(folder / "cut.csv"), whole) << "cut at " << cut;
  }
}

TEST(Table, FullDiskEndsWithTheLastWholeRow) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(test::holds_on_full_disk(20, [&] {
    TableWriter writer(folder / "t.csv", {"step", "t"});
    writer.add({std::int64_t{0}, 0.125});
    return message_of<RunFailure>([&] {
             writer.add({std::int64_t{1}, 0.2500001});
           }) == (folder / "t.csv").string() + ": cannot be written: File too large";
  }));
  EXPECT_EQ(get(folder / "t.csv"), "step,t\n0,0.125\n");
  EXPECT_EQ(message_of<RunFailure>([] { TableWriter("/dev/full", {"step"}); }),
            "/dev/full: cannot be written: No space left on device");
}

TEST(Table, SaysWhatIsWrong) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "t.csv").string();
  const auto reading = [&](std::string_view text) {
    put(path, text);
    return message_of<InvalidInput>([&] { (void)read_table(path); });
  };
  const auto resuming = [&](std::string_view text, std::vector<std::string> columns) {
    put(path, text);
    return message_of<InvalidInput>([&] { TableWriter(path, columns, 0); });
  };
  EXPECT_EQ(reading(""), path + ": is empty; a header line is missing");
  EXPECT_EQ(reading("a,b\n1,2\n3\n"), path + ":3: 1 cells where the header has 2");
  EXPECT_EQ(resuming("a,b\n", {"a", "c"}), path + ":1: the header is not `a,c`");
  EXPECT_EQ(resuming("a,b\n", {"a", "b"}), path + ": has no column `step`");
  EXPECT_EQ(resuming("step\nx\n", {"step"}), path + ":2: step = `x` is not a whole number");
  EXPECT_EQ(message_of<InvalidInput>([&] { (void)read_table(path).column("D"); }),
            "the table has no column `D`");
  std::filesystem::remove(path);
  EXPECT_EQ(message_of<InvalidInput>([&] { TableWriter(path, {"step"}, 0); }),
            path + ": no such file");
}

TEST(Table, CommentsCountAsLinesAndHoldQuotes) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "a.csv").string();
  const auto read = [&](const std::string& text) {
    put(path, text);
    return read_commented_table(path);
  };
  const Table table = read("\xef\xbb\xbf# 1/2\" tube\n\nt,L\n# more\n0,1\n");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"t", "L"}));
  EXPECT_EQ(table.rows.size(), 1);
  const auto refusal = [&](const std::string& text) {
    return message_of<InvalidInput>([&] { (void)read(text); });
  };
  EXPECT_EQ(refusal("# one\n# two\nt,L\n0,1,2\n"), path + ":4: 3 cells where the header has 2");
  EXPECT_EQ(refusal("t,L\n0,1\n1,\"2\n2,9\n"), path + ":3: a quotation mark is not closed");
}

TEST(Table, ReadsWhatOthersWrite) {
  const test::TemporaryFolder folder;
  put(folder / "t.csv", "t,D\r\n0,0.5\r\n1,+inf\r\n2,1e-3");  // no line break at the end
  const Table table = read_commented_table(folder / "t.csv");
  EXPECT_EQ(table.column("t"), (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(table.column("D")[0], 0.5);
  EXPECT_EQ(table.column("D")[2], 1e-3);
}

}  // namespace
}  // namespace meniscus::io
