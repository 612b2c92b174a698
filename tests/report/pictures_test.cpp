#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/report/rasterize.hpp"
#include "meniscus/report/report.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/report/synthetic_run.hpp"

namespace meniscus {
namespace {

using test::get;
using test::put;

std::string svg_of(const std::string& content, double width, double height) {
  return fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{}" height="{}">{}</svg>)",
                     width, height, content);
}

/// The file of a program; empty where PATH has none.
std::string found_on_path(const std::string& name) {
  std::stringstream folders(std::getenv("PATH"));
  for (std::string folder; std::getline(folders, folder, ':');)
    if (std::filesystem::exists(folder + "/" + name)) return folder + "/" + name;
  return {};
}

struct Pixel {
  int blue, green, red;
};

Pixel pixel(const report::Pixels& picture, int x, int y) {
  const std::size_t at = 4 * static_cast<std::size_t>(y * picture.width + x);
  return {picture.bytes[at], picture.bytes[at + 1], picture.bytes[at + 2]};
}

TEST(Rasterize, ShapesHaveTheirPlaceAndColour) {
  const std::string svg =
      svg_of(R"(<rect x="10" y="20" width="30" height="10" fill="#ff0000"/>)", 100.0, 50.0);
  const report::Pixels picture = report::pixels_of(svg, 2.0);
  EXPECT_EQ(picture.width, 200);
  EXPECT_EQ(picture.height, 100);
  EXPECT_EQ(pixel(picture, 30, 50).red, 255);
  EXPECT_EQ(pixel(picture, 30, 50).green, 0);
  EXPECT_EQ(pixel(picture, 10, 50).green, 255);  // paper
  EXPECT_EQ(pixel(picture, 90, 50).green, 255);
}

/// Letters need a font; a machine without any draws none.
TEST(Rasterize, LettersAreDrawn) {
  const auto ink = [](const char* content) {
    const report::Pixels picture = report::pixels_of(svg_of(content, 200.0, 40.0), 1.0);
    int dark = 0;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) dark += pixel(picture, x, y).green < 200;
    }
    return dark;
  };
  EXPECT_EQ(ink(""), 0);
  EXPECT_GT(ink(R"(<text x="10" y="25">Deformation</text>)"), 50);
}

TEST(Rasterize, RefusesWhatIsNoPicture) {
  EXPECT_THROW((void)report::png_of("<svg", 1.0), RunFailure);
}

TEST(Pictures, PngNeedsNoDisplay) {
  const test::TemporaryFolder folder;
  test::write_synthetic_run(folder.path(), {.num_frames = 3, .num_volume_frames = 1});
  for (const std::string& name : write_stills(folder.path(), StillFormat::png)) {
    const std::string bytes = get(folder / name);
    EXPECT_TRUE(bytes.starts_with("\x89PNG\r\n")) << name;
    EXPECT_GT(bytes.size(), 5000U) << name;
  }
}

/// A stand-in for ffmpeg that counts what it is given: whole frames of the size it was told.
TEST(Pictures, MovieHandsEveryFrameToFfmpeg) {
  const test::TemporaryFolder folder;
  test::write_synthetic_run(folder / "run", {.num_frames = 4, .num_vertices = 60});
  std::filesystem::create_directories(folder / "bin");
  put(folder / "bin/ffmpeg",
      "#!/bin/sh\nfor last; do :; done\necho \"$@\" > \"$last\"\nwc -c >> \"$last\"\n");
  std::filesystem::permissions(folder / "bin/ffmpeg", std::filesystem::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", ((folder / "bin").string() + ":" + path).c_str(), 1);
  write_movie(folder / "run", folder / "film.mp4");
  setenv("PATH", path.c_str(), 1);
  const std::string told = get(folder / "film.mp4");
  int width = 0, height = 0;
  const std::size_t size = told.find(" -s ");
  ASSERT_NE(size, std::string::npos) << told;
  ASSERT_EQ(std::sscanf(told.c_str() + size, " -s %dx%d", &width, &height), 2);
  EXPECT_EQ(width % 2, 0);
  EXPECT_EQ(height % 2, 0);
  const std::string bytes = told.substr(told.find('\n') + 1);
  EXPECT_EQ(std::stol(bytes), 4L * 4 * width * height);
  EXPECT_EQ(folder.num_entries(), 3);  // no unfinished film
}

TEST(Pictures, MovieSaysWhatIsMissing) {
  const test::TemporaryFolder folder;
  test::write_synthetic_run(folder / "run", {.num_frames = 2, .num_vertices = 60});
  const std::string path = std::getenv("PATH");
  std::filesystem::create_directories(folder / "bin");
  const std::string node = found_on_path("node");
  ASSERT_FALSE(node.empty()) << "no node here (Debian: apt install nodejs)";
  std::filesystem::create_symlink(node, folder / "bin/node");
  setenv("PATH", (folder / "bin").c_str(), 1);
  const std::string message =
      test::message_of<InvalidInput>([&] { write_movie(folder / "run", folder / "film.mp4"); });
  setenv("PATH", path.c_str(), 1);
  EXPECT_TRUE(message.starts_with("--movie: the program ffmpeg cannot be started")) << message;
  EXPECT_EQ(folder.num_entries(), 2);
}

}  // namespace
}  // namespace meniscus
