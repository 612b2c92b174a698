#include "meniscus/io/atomic_file.hpp"

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "tests/io/full_disk.hpp"
#include "tests/io/temporary_folder.hpp"

namespace meniscus::io {
namespace {

using test::get;
using test::message_of;
using test::put;

TEST(AtomicFile, WritesAndReadsBackAnyBytes) {
  const test::TemporaryFolder folder;
  const std::string bytes("a\0b\nc\xff", 6);
  write_file(folder / "file", bytes);
  EXPECT_EQ(read_file(folder / "file"), bytes);
  write_file(folder / "file", "");
  EXPECT_EQ(read_file(folder / "file"), "");
  EXPECT_EQ(folder.num_entries(), 1);
}

TEST(AtomicFile, OverwritesWhatAKilledProgramLeft) {
  const test::TemporaryFolder folder;
  put(folder / "file.partial", "a longer text than the new one");
  write_file(folder / "file", "new");
  EXPECT_EQ(get(folder / "file"), "new");
  EXPECT_EQ(folder.num_entries(), 1);
}

TEST(AtomicFile, FullDiskKeepsTheOldFileAndLeavesNothing) {
  const test::TemporaryFolder folder;
  put(folder / "file", "old");
  EXPECT_TRUE(test::holds_on_full_disk(1000, [&] {
    return message_of<RunFailure>([&] { write_file(folder / "file", std::string(2000, 'x')); }) ==
           (folder / "file").string() + ": cannot be written: File too large";
  }));
  EXPECT_EQ(get(folder / "file"), "old");
  EXPECT_EQ(folder.num_entries(), 1);
}

TEST(AtomicFile, DeviceIsWrittenInPlace) {
  EXPECT_EQ(message_of<RunFailure>([] { write_file("/dev/full", "x"); }),
            "/dev/full: cannot be written: No space left on device");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(AtomicFile, SaysWhyAFileCannotBeWritten) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(message_of<RunFailure>([&] { write_file(folder / "none/file", "x"); }),
            (folder / "none/file").string() + ": cannot be written: No such file or directory");
  put(folder / "file", "");
  EXPECT_EQ(message_of<RunFailure>([&] { write_file(folder / "file/below", "x"); }),
            (folder / "file/below").string() + ": cannot be written: Not a directory");
  EXPECT_EQ(message_of<RunFailure>([&] { write_file(folder.path(), "x"); }),
            folder.path().string() + ": cannot be written: Is a directory");
}

TEST(AtomicFile, SaysWhyAFileCannotBeRead) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(message_of<InvalidInput>([&] { (void)read_file(folder / "none"); }),
            (folder / "none").string() + ": no such file");
  EXPECT_EQ(message_of<InvalidInput>([&] { (void)read_file(folder.path()); }),
            folder.path().string() + ": not a file");
}

}  // namespace
}  // namespace meniscus::io
