#include "meniscus/report/report.hpp"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "meniscus/core/error.hpp"
#include "meniscus/report/packing.hpp"
#include "meniscus/report/page_data.hpp"
#include "meniscus/report/run_data.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/report/synthetic_run.hpp"
#include "tests/report/xml_check.hpp"

namespace meniscus {
namespace {

using test::get;
using test::message_of;
using test::put;

/// A page without its script and what only that reads: tests/web looks at these in a browser.
std::string without_scripts(std::string page) {
  for (std::size_t at = page.find("<script"); at != std::string::npos; at = page.find("<script")) {
    page.erase(at, page.find("</script>", at) + 9 - at);
  }
  return page;
}

/// The page of a run, checked for what holds of every page.
std::string page_of(const std::filesystem::path& folder) {
  write_report(folder);
  const std::string page = without_scripts(get(folder / "report.html"));
  const test::Xml xml = test::parse_xml(page);
  EXPECT_EQ(xml.fault, "");
  EXPECT_EQ(test::bad_coordinate(xml), "");
  EXPECT_EQ(test::outside_reference(xml), "");
  EXPECT_EQ(page.find("http:"), std::string::npos);
  EXPECT_EQ(page.find("https:"), std::string::npos);
  EXPECT_TRUE(page.ends_with("</html>\n"));
  return page;
}

bool has(const std::string& page, const std::string& part) {
  return page.find(part) != std::string::npos;
}

long count(const std::string& page, const std::string& part) {
  long n = 0;
  for (std::size_t at = page.find(part); at != std::string::npos; at = page.find(part, at + 1)) ++n;
  return n;
}

TEST(Report, ShowsARun) {
  const test::TemporaryFolder folder;
  test::write_synthetic_run(folder.path(), {});
  const std::string page = page_of(folder.path());
  EXPECT_LT(page.size(), 2'000'000U);
  for (const char* part :
       {"Drop in simple shear, &lt;subcritical&gt; &amp; steady", "class=\"status done\"",
        "0123456789ab", "cases/shear/case.toml", "<i>Ca</i> = 0.3", "1 min 55 s", "52.4 s",
        "Volume drift", "Volume corrections, sum", "kind = &quot;simple-shear&quot;",
        "flow.capillary-number", "prefers-color-scheme"}) {
    EXPECT_TRUE(has(page, part)) << part;
  }
  EXPECT_TRUE(has(page, "id=\"app\""));
  EXPECT_FALSE(has(page, "class=\"notice\""));
}

TEST(Report, ShowsTheLastDeformationOfTheTable) {
  const test::TemporaryFolder folder;
  test::write_synthetic_run(folder.path(), {});
  put(folder / "drops.csv", "step,t,drop,D,angle_deg\n0,0,0,0,45\n1,1,0,0.123449,26\n");
  EXPECT_TRUE(has(page_of(folder.path()), "<dd>0.1234</dd>"));
}

TEST(Report, EveryFileButOneMayBeMissing) {
  for (const char* kept : {"run.json", "history.csv"}) {
    const test::TemporaryFolder folder;
    test::write_synthetic_run(folder.path(), {.num_drops = 1, .num_frames = 2});
    for (const char* name : {"run.json", "history.csv", "drops.csv", "timing.csv", "surface.pvd"}) {
      if (std::string(name) != kept) std::filesystem::remove(folder / name);
    }
    const std::string page = page_of(folder.path());
    EXPECT_FALSE(has(page, "class=\"notice\"")) << kept;
    EXPECT_EQ(has(page, "Time by phase"), std::string(kept) == "run.json");
  }
}

TEST(Report, NamesWhatCannotBeRead) {
  const test::TemporaryFolder folder;
  test::write_synthetic_run(folder.path(), {.num_drops = 1, .num_frames = 3});
  put(folder / "run.json", "{\"title\": ");
  put(folder / "drops.csv", "a,b\n1\n2\n");
  put(folder / "surface/surface-0001.vtp", "torn");
  const std::string page = page_of(folder.path());
  EXPECT_TRUE(has(page, "run.json cannot be read"));
  EXPECT_TRUE(has(page, "drops.csv:2: 1 cells where the header has 2"));
  EXPECT_TRUE(has(page, "surface-0001.vtp: not a surface file"));
}

TEST(Report, RunJsonOfUnexpectedTypesIsBorne) {
  const test::TemporaryFolder folder;
  for (const char* text :
       {"[]", "{}", "{\"title\": 7, \"seconds\": [1, 2], \"case\": 3, \"warnings\": {\"a\": 1}}",
        "{\"wall_seconds\": \"x\", \"case\": {\"a\": {\"b\": [[1], {}]}, \"c\": []}, \"t\": "
        "null}"}) {
    put(folder / "run.json", text);
    (void)page_of(folder.path());
  }
}

// HTML reads the end of a script after "<!--" and "<script" differently.
TEST(Report, NoTextOfTheRunEndsItsScript) {
  const test::TemporaryFolder folder;
  put(folder / "run.json", R"({"title": "<!-- <script> </script>", "case_text": "# <!--<script"})");
  write_report(folder.path());
  const std::string page = get(folder / "report.html");
  const std::size_t begin = page.find("id=\"page-data\">") + 15;
  const std::string data = page.substr(begin, page.find("</script>", begin) - begin);
  EXPECT_FALSE(has(data, "<"));
  const nlohmann::json json = nlohmann::json::parse(data);
  EXPECT_EQ(json["runs"][0]["title"], "<!-- <script> </script>");
  EXPECT_EQ(json["runs"][0]["case_text"], "# <!--<script");
}

TEST(Report, UnitsAreThoseOfTheFlow) {
  const test::TemporaryFolder folder;
  put(folder / "history.csv", "step,t\n0,0\n1,0.5\n");
  const auto page = [&](const std::string& flow, const std::string& more = "") {
    put(folder / "run.json", R"({"case": {"flow": {)" + flow + "}}" + more + "}");
    return page_of(folder.path());
  };
  const std::string sheared = page(R"("kind": "simple-shear", "capillary-number": 0.3)");
  EXPECT_TRUE(has(sheared, "<dd>0.5 <small>1/G</small>"));
  EXPECT_TRUE(has(sheared, "times in 1/G, stresses in μG"));
  for (const std::string& resting :
       {page(R"("kind": "quiescent", "capillary-number": 1.0)"),
        page(R"("kind": "quiescent")", R"(, "dimensionless": {"end": 2.0, "Ca": 1.0, "Re": 0})")}) {
    EXPECT_TRUE(has(resting, "<dd>0.5 <small>μR₀/σ</small>"));
    EXPECT_TRUE(has(resting, "times in μR₀/σ, stresses in σ/R₀"));
  }
  // Walls that move give a rate to a flow that is quiescent without them.
  EXPECT_TRUE(has(page(R"("kind": "quiescent", "capillary-number": 0.2)"), "<small>1/G</small>"));
}

TEST(Report, CasesInSiUnitsShowTheRunsOwnNumbers) {
  const test::TemporaryFolder folder;
  put(folder / "run.json",
      R"({"case": {"flow": {"kind": "simple-shear"}, "time": {"end": 0.08}, "scale": {"length": 1e-3}},
          "dimensionless": {"end": 7.999999999999999, "Ca": 0.25, "Re": 0.5}})");
  const std::string page = page_of(folder.path());
  EXPECT_TRUE(has(page, "<i>Ca</i> = 0.25 · <i>Re</i> = 0.5"));
  const report::RunData run = report::load_run(folder.path());
  const nlohmann::json data = nlohmann::json::parse(report::live_drawing_data(run, "1").page);
  EXPECT_EQ(data["runs"][0]["end"], "8");
}

// The program writes the rows of all drops, then that of history.csv.
TEST(Report, DropsAreThoseOfTheLastWholeStep) {
  const test::TemporaryFolder folder;
  put(folder / "history.csv", "step,t,drops\n0,0,2\n1,1,2\n");
  put(folder / "drops.csv", "step,t,drop,L\n0,0,0,1\n0,0,1,1\n1,1,0,1.25\n1,1,1,1.75\n2,2,0,1.5\n");
  const std::string page = page_of(folder.path());
  EXPECT_TRUE(has(page, "1.2500") && has(page, "1.7500"));
  EXPECT_FALSE(has(page, "1.5000"));
}

TEST(Report, LongTablesKeepTheirLastStep) {
  const test::TemporaryFolder folder;
  constexpr int kLast = 1009;  // a prime
  const auto rows_at_every = [](int n) {
    std::string rows = "step,t,value\n";
    for (int step = 0; step <= kLast; ++step)
      if (step % n == 0 || step == kLast)
        rows += fmt::format("{},{},{}\n", step, 0.1 * step, std::sin(step));
    return rows;
  };
  put(folder / "history.csv", rows_at_every(1));
  report::RunData run = report::load_run(folder.path());
  report::PageRun page;
  const report::DrawingData data =
      report::drawing_data("report", std::span(&run, 1), std::span(&page, 1), {.tables = 6000});
  ASSERT_EQ(page.notes.size(), 1U);
  EXPECT_TRUE(has(page.notes[0], "th step and the last")) << page.notes[0];
  const int n = std::atoi(page.notes[0].c_str() + page.notes[0].find("every ") + 6);
  EXPECT_GT(n, 1);
  EXPECT_EQ(data.texts[0].second, report::base64(report::zlib_bytes(rows_at_every(n))));
}

TEST(Report, FailedRunsSayWhy) {
  const test::TemporaryFolder folder;
  put(folder / "run.json", R"({"status": "failed: disk <full>", "warnings": ["w & w"]})");
  const std::string page = page_of(folder.path());
  EXPECT_TRUE(has(page, "class=\"status failed\">failed<"));
  EXPECT_TRUE(has(page, "failed: disk &lt;full&gt;"));
  EXPECT_TRUE(has(page, "w &amp; w"));
}

TEST(Report, PicturesStandAlone) {
  const test::TemporaryFolder folder;
  test::write_synthetic_run(folder.path(), {.num_volume_frames = 2, .is_curved = true});
  const std::vector<std::string> names = {"interface.svg", "deformation.svg", "mesh.svg",
                                          "history.svg"};
  EXPECT_EQ(write_stills(folder.path(), StillFormat::svg), names);
  EXPECT_EQ(count(get(folder / "interface.svg"), "class=\"mesh\""), 6);
  EXPECT_EQ(count(get(folder / "mesh.svg"), "class=\"cut\""), 2);  // by liquid and by quality
  EXPECT_TRUE(has(get(folder / "mesh.svg"), "t = 6,"));
  const double times[] = {0.0, 3.1};
  (void)write_stills(folder.path(), StillFormat::svg, times);
  for (const std::string& name : names) {
    const test::Xml xml = test::parse_xml(get(folder / name));
    EXPECT_EQ(xml.fault, "") << name;
    EXPECT_EQ(test::bad_coordinate(xml), "") << name;
    EXPECT_EQ(test::outside_reference(xml), "") << name;
  }
  EXPECT_EQ(count(get(folder / "interface.svg"), "class=\"mesh\""), 2);
  EXPECT_TRUE(has(get(folder / "interface.svg"), "t = 3<"));
  EXPECT_TRUE(has(get(folder / "mesh.svg"), "t = 0,"));
}

// Half the size of the curved frames is more than that of the flat ones, a tenth is less.
TEST(Report, FacesBecomeFlatBeforeTheyBecomeFewer) {
  const test::TemporaryFolder folder;
  test::write_synthetic_run(folder.path(),
                            {.num_frames = 4, .num_vertices = 1000, .is_curved = true});
  report::RunData run = report::load_run(folder.path());
  const auto size = [](const report::PageRun& page) {
    std::size_t sum = 0;
    for (const report::PackedFrame& frame : page.frames) sum += frame.bytes.size();
    return sum;
  };
  const report::PageRun whole = report::page_run(run, {});
  EXPECT_TRUE(whole.frames[0].is_curved);
  report::PageBudget budget;
  budget.frames = size(whole) * 4 / 3 * 9 / 10;
  const report::PageRun flat = report::page_run(run, budget);
  EXPECT_FALSE(flat.frames[0].is_curved);
  EXPECT_EQ(flat.frames[0].num_faces, whole.frames[0].num_faces);
  EXPECT_TRUE(has(flat.notes.back(), "drawn flat")) << flat.notes.back();
  budget.frames /= 9;
  const report::PageRun coarse = report::page_run(run, budget);
  EXPECT_LT(coarse.frames[0].num_faces, whole.frames[0].num_faces / 2);
  EXPECT_TRUE(has(coarse.notes.back(), "drawn with about as many")) << coarse.notes.back();
}

TEST(Report, PicturesOfWildTables) {
  const test::TemporaryFolder folder;
  put(folder / "history.csv",
      "step,t,dt,drops,surface_nodes,nodes,tetrahedra,linear_iterations,power_in,power_residual\n"
      "0,0,0,1,110,,,5,0,0\n1,0.1,0.1,1,nan,,,6,inf,1\n2,0.2,0.1,1,112,,,nan,1e308,-1e308\n");
  put(folder / "drops.csv", "step,t,drop,D\n0,0,0,0\n1,0.1,0,0.1\n0,0,1,0\n1,0.1,1,0.2\n");
  put(folder / "events.csv", "step,t,kind\n1,0.1,breakup\n");
  put(folder / "reference.csv", "# Where it comes from.\nt,D\n0,0\n0.1,0.12\n");
  EXPECT_EQ(write_stills(folder.path(), StillFormat::svg),
            (std::vector<std::string>{"deformation.svg", "history.svg"}));
  const std::string history = get(folder / "history.svg");
  const test::Xml xml = test::parse_xml(history);
  EXPECT_EQ(xml.fault, "");
  EXPECT_EQ(test::bad_coordinate(xml), "");
  for (const char* part : {"<title>D of drop 0</title>", "<title>D of drop 1</title>",
                           "<title>breakup at t = 0.1</title>", "surface nodes"})
    EXPECT_TRUE(has(history, part)) << part;
  EXPECT_FALSE(has(history, ">tetrahedra<"));
  EXPECT_EQ(count(history, "<title>D, reference</title>"), 1);
}

TEST(Report, NamesNodeWhereItIsMissing) {
  const test::TemporaryFolder folder;
  test::write_synthetic_run(folder / "run", {.num_frames = 2, .num_vertices = 60});
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.path().c_str(), 1);
  const std::string message =
      message_of<InvalidInput>([&] { (void)write_stills(folder / "run", StillFormat::png); });
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(message,
            "--png: the program node cannot be started: No such file or directory (Debian: apt "
            "install nodejs)");
  write_report(folder / "run");  // needs none
}

TEST(Report, RefusesWhatIsNoRun) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path().string();
  EXPECT_EQ(message_of<InvalidInput>([&] { write_report(path); }),
            path + ": not the folder of a run; it holds neither run.json nor history.csv");
  put(folder / "run.json", "{}");
  EXPECT_EQ(message_of<InvalidInput>([&] { (void)write_stills(path, StillFormat::svg); }),
            path + ": no frame, mesh or history that a picture could show");
  EXPECT_EQ(message_of<InvalidInput>([&] { write_movie(path, folder / "m.mp4"); }),
            path + ": no frame of the surface can be read");
  EXPECT_EQ(folder.num_entries(), 1);
}

}  // namespace
}  // namespace meniscus
