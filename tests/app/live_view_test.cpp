#include "meniscus/app/live_view.hpp"

#include <array>
#include <charconv>
#include <string>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <unistd.h>

#include "meniscus/io/vtk_file.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/report/page_bundle.hpp"
#include "tests/io/temporary_folder.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

int port_of(const LiveView& view) {
  const std::string url = view.url();
  int port = 0;
  std::from_chars(url.data() + url.rfind(':') + 1, url.data() + url.size(), port);
  return port;
}

/// The whole answer to a GET, its head too.
std::string answer(const LiveView& view, const std::string& path, const std::string& host) {
  const int link = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in where{};
  where.sin_family = AF_INET;
  where.sin_port = htons(static_cast<std::uint16_t>(port_of(view)));
  const std::string url = view.url();
  const std::string address = url.substr(7, url.rfind(':') - 7);
  EXPECT_EQ(inet_pton(AF_INET, address.c_str(), &where.sin_addr), 1);
  EXPECT_EQ(connect(link, reinterpret_cast<const sockaddr*>(&where), sizeof where), 0);
  const std::string request =
      "GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n\r\n";
  EXPECT_EQ(write(link, request.data(), request.size()), static_cast<ssize_t>(request.size()));
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t n = 0; (n = read(link, part.data(), part.size())) > 0;)
    text.append(part.data(), static_cast<std::size_t>(n));
  close(link);
  return text;
}

int status(const std::string& answer) { return std::atoi(answer.c_str() + answer.find(' ')); }

nlohmann::json json_of(const std::string& answer) {
  return nlohmann::json::parse(answer.substr(answer.find("\r\n\r\n")));
}

/// A run of three frames of the surface and no rows.
void put_run(const fs::path& folder) {
  (void)RunDirectory::create(folder, false);
  fs::create_directories(folder / "surface");
  test::put(folder / "run.json", "{}");
  const SurfaceMesh ball = sphere(60);
  const std::array surfaces{&ball};
  std::vector<io::PvdEntry> entries;
  for (int k = 0; k < 3; ++k) {
    entries.push_back({0.5 * k, "surface/" + std::to_string(k) + ".vtp"});
    io::write_vtp(folder / entries.back().file, surfaces, {}, entries.back().t);
  }
  io::write_pvd(folder / "surface.pvd", entries);
}

class Live : public testing::Test {
 protected:
  void SetUp() override {
    if (!report::has_page_bundle()) GTEST_SKIP() << "pages need their script";
    put_run(run);
  }

  test::TemporaryFolder folder;
  fs::path run = folder / "run";
};

TEST_F(Live, AFrameThatCannotBeReadStopsNeitherLaterOnesNorCuts) {
  test::put(run / "surface/1.vtp", "torn");
  test::put(run / "volume.vtu", "torn");
  io::write_pvd(run / "volume.pvd", std::array{io::PvdEntry{0.0, "volume.vtu"}});
  LiveView view({.port = 0});
  view.begin(run);
  const RunDirectory directory = RunDirectory::take_up(run, 9, 9.0);
  view.update(directory);
  view.update(directory);
  const nlohmann::json state = json_of(answer(view, "/state", "localhost"));
  EXPECT_EQ(state["frames"], 2);
  EXPECT_EQ(state["cuts"], 0);
  const nlohmann::json frames = json_of(answer(view, "/frames?from=0", "localhost"));
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[1]["t"], 1.0);
}

TEST_F(Live, TellsRunsApart) {
  LiveView first({.port = 0}), second({.port = 0});
  first.begin(run);
  second.begin(run);
  const std::string id = json_of(answer(first, "/state", "localhost"))["run"];
  EXPECT_NE(id, json_of(answer(second, "/state", "localhost"))["run"]);
  EXPECT_NE(answer(first, "/", "localhost").find("\"id\":\"" + id + "\""), std::string::npos);
  for (const std::string path : {"/history.csv?from=0", "/frames?from=0"}) {
    EXPECT_EQ(status(answer(first, path + "&run=" + id, "localhost")), 200) << path;
    EXPECT_EQ(status(answer(second, path + "&run=" + id, "localhost")), 409) << path;
  }
}

/// Names of this machine with the port of a tunnel, or none, are ours; redirected ones are not.
TEST_F(Live, AnswersToItsOwnNamesAtAnyPort) {
  LiveView view({.address = "127.0.0.2", .port = 0});
  view.begin(run);
  for (const char* host : {"127.0.0.2:9000", "127.0.0.2", "127.0.0.1:80", "localhost:9000"})
    EXPECT_EQ(status(answer(view, "/state", host)), 200) << host;
  for (const char* host : {"elsewhere.example:9000", "localhost.example", "127.0.0.3:1", ""})
    EXPECT_EQ(status(answer(view, "/state", host)), 403) << host;
}

}  // namespace
}  // namespace meniscus
