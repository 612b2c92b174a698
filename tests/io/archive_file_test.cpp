#include "meniscus/io/archive_file.hpp"

#include <chrono>
#include <limits>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "tests/io/full_disk.hpp"
#include "tests/io/temporary_folder.hpp"

namespace meniscus::io {
namespace {

using test::get;
using test::message_of;
using test::put;

Archive example() {
  std::mt19937_64 random(3);
  Archive archive;
  std::vector<double>& velocity = archive.reals["flow/guess/velocity"];
  for (int i = 0; i < 3000; ++i) velocity.push_back(std::ldexp(static_cast<double>(random()), -60));
  archive.reals["t"] = {std::numeric_limits<double>::infinity()};
  archive.reals["flow/empty"] = {};
  archive.integers["step"] = {std::numeric_limits<std::int64_t>::min(), -1, 7};
  archive.integers["drops/0/faces"] = {};
  archive.texts["case"] = "title = \"ä\"\n";
  archive.texts["drops/0/name"] = "";
  archive.texts["zero"] = std::string("a\0b\0", 4);
  return archive;
}

std::string reading(const std::filesystem::path& path) {
  return message_of<InvalidInput>([&] { (void)read_archive(path); });
}

TEST(ArchiveFile, GivesBackWhatItGot) {
  const test::TemporaryFolder folder;
  const Archive archive = example();
  write_archive(folder / "a.h5", archive);
  const Archive back = read_archive(folder / "a.h5");
  EXPECT_EQ(back.reals, archive.reals);
  EXPECT_EQ(back.integers, archive.integers);
  EXPECT_EQ(back.texts, archive.texts);
  EXPECT_EQ(folder.num_entries(), 1);
}

TEST(ArchiveFile, SameStateGivesTheSameBytesAtAnyTime) {
  const test::TemporaryFolder folder;
  write_archive(folder / "a.h5", example());
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5's times count seconds
  write_archive(folder / "b.h5", example());
  EXPECT_EQ(get(folder / "a.h5"), get(folder / "b.h5"));
}

TEST(ArchiveFile, EmptyArchive) {
  const test::TemporaryFolder folder;
  write_archive(folder / "a.h5", {});
  const Archive back = read_archive(folder / "a.h5");
  EXPECT_TRUE(back.reals.empty() && back.integers.empty() && back.texts.empty());
}

TEST(ArchiveFile, RefusesEveryTruncation) {
  const test::TemporaryFolder folder;
  write_archive(folder / "a.h5", example());
  const std::string whole = get(folder / "a.h5"), path = (folder / "a.h5").string();
  for (std::size_t size = 0; size < whole.size(); size += size < 600 ? 7 : 1009) {
    put(path, whole.substr(0, size));
    const std::string expected =
        size < 16 ? path + ": not a Meniscus checkpoint"
                  : fmt::format("{}: the checkpoint is cut short after {} bytes", path, size);
    ASSERT_EQ(reading(path), expected);
  }
}

TEST(ArchiveFile, RefusesEveryFlippedByte) {
  const test::TemporaryFolder folder;
  write_archive(folder / "a.h5", example());
  const std::string whole = get(folder / "a.h5");
  for (std::size_t at = 0; at < whole.size(); at += at < 600 ? 5 : 211) {
    std::string broken = whole;
    broken[at] = static_cast<char>(broken[at] ^ 0x10);
    put(folder / "a.h5", broken);
    ASSERT_NE(reading(folder / "a.h5"), "") << "byte " << at;
  }
  put(folder / "a.h5", whole + "x");
  EXPECT_EQ(reading(folder / "a.h5"),
            (folder / "a.h5").string() + ": the checkpoint is corrupt (its checksum differs)");
}

TEST(ArchiveFile, RefusesForeignFilesAndOtherFormats) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "a.h5").string();
  EXPECT_EQ(reading(path), path + ": no such file");
  put(path, "\x89HDF\r\n\x1a\n and then some of another program");
  EXPECT_EQ(reading(path), path + ": not a Meniscus checkpoint");
  for (const std::string other : {"1", "3"}) {
    put(path, "Meniscus archive " + other + "\nwhatever");
    EXPECT_EQ(reading(path),
              path + ": a checkpoint of format " + other + "; this program reads format 2");
  }
}

TEST(ArchiveFile, FullDiskLeavesNothing) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(test::holds_on_full_disk(4096, [&] {
    return message_of<RunFailure>([&] { write_archive(folder / "a.h5", example()); }) ==
           (folder / "a.h5").string() + ": cannot be written: File too large";
  }));
  EXPECT_EQ(folder.num_entries(), 0);
}

TEST(ArchiveFile, NameThatIsGroupAndArrayIsRefused) {
  const test::TemporaryFolder folder;
  Archive archive;
  archive.reals["flow"] = {1.0};
  archive.reals["flow/guess"] = {2.0};
  EXPECT_EQ(message_of<RunFailure>([&] { write_archive(folder / "a.h5", archive); }),
            (folder / "a.h5").string() + ": cannot be written: H5Dcreate of flow/guess failed");
  EXPECT_EQ(folder.num_entries(), 0);
}

}  // namespace
}  // namespace meniscus::io
