// --profile and --trace: what they write, and that it adds up.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "kernels/interface.hpp"
#include "program.hpp"

namespace tessera::cli_test {
namespace {

using Json = nlohmann::json;

class Profile : public testing::Test {
 protected:
  void SetUp() override { write_file(folder.path("square.gltf"), square_gltf()); }
  [[nodiscard]] Result render(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"render",    folder.path("square.gltf"),
                                      "-o",        folder.path("a.png"),
                                      "--size",    "200x100",
                                      "--camera",  "front",
                                      "--light",   "directional:0,0,-1:3",
                                      "--threads", "2"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  Folder folder;
};

TEST_F(Profile, TraceHoldsEveryStageOfEveryTileOnceAndThreadsDoOneThingAtATime) {
  const Result result = render({"--trace", folder.path("t.json"), "-q"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json trace = Json::parse(read_file(folder.path("t.json")));
  std::map<std::string, std::set<std::pair<int, int>>> tiles;
  std::map<int, std::vector<std::pair<double, double>>> spans;  // of each thread
  std::set<std::string> run, geometry;
  std::set<int> named;
  for (const Json& e : trace.at("traceEvents")) {
    if (e.at("ph") == "M") {
      if (e.at("name") == "thread_name") named.insert(e.at("tid").get<int>());
      continue;
    }
    ASSERT_EQ(e.at("ph"), "X");
    const double begin = e.at("ts").get<double>(), duration = e.at("dur").get<double>();
    ASSERT_GE(begin, 0);
    ASSERT_GE(duration, 0);
    spans[e.at("tid").get<int>()].push_back({begin, begin + duration});
    const std::string name = e.at("name").get<std::string>(), category = e.at("cat").get<std::string>();
    if (category == "run") run.insert(name);
    if (category == "geometry") geometry.insert(name);
    if (category != "tile") continue;
    const int x = e.at("args").at("x").get<int>(), y = e.at("args").at("y").get<int>();
    EXPECT_TRUE(x % tile_size == 0 && y % tile_size == 0 && x < 200 && y < 100);
    if (name == "shade") {
      EXPECT_TRUE(tiles[name].insert({x, y}).second) << "twice: " << x << ',' << y;
    } else {
      tiles[name].insert({x, y});
    }
  }
  EXPECT_EQ(run, (std::set<std::string>{"environment", "prepare", "read", "render", "write"}));
  EXPECT_EQ(geometry, (std::set<std::string>{"bins", "triangles", "vertices"}));
  // Every tile is there; those that the square does not reach are background alone.
  std::set<std::pair<int, int>> seen = tiles["composite"];
  seen.insert(tiles["background"].begin(), tiles["background"].end());
  EXPECT_EQ(seen.size(), 7u * 4u);
  EXPECT_LT(tiles["coverage"].size(), seen.size());
  for (const auto& tile : tiles["shade"]) EXPECT_EQ(tiles["composite"].count(tile), 1u);
  EXPECT_GT(tiles["shade"].size(), 3u);
  for (auto& [thread, list] : spans) {
    EXPECT_EQ(named.count(thread), 1u);
    std::sort(list.begin(), list.end());
    for (std::size_t i = 1; i < list.size(); ++i)
      EXPECT_GE(list[i].first, list[i - 1].second - 0.002);  // printed digits
  }
}

TEST_F(Profile, TableNamesStagesAndThreadsAndItsSharesAreAWhole) {
  const Result result = render({"--profile", "-q"});
  ASSERT_EQ(result.status, 0) << result.err;
  double share = 0;
  std::set<std::string> names;
  std::istringstream lines(result.err);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t percent = line.find('%');
    if (percent == std::string::npos) continue;
    std::istringstream words(line);
    std::string name;
    words >> name;
    const double value = std::stod(line.substr(line.rfind(' ', percent)));
    if (name == "all") {
      EXPECT_NEAR(value, 100, 0.051);
    } else {
      names.insert(name);
      share += value;
    }
  }
  for (const char* stage : {"vertices", "triangles", "coverage", "resolve", "shade", "composite"})
    EXPECT_EQ(names.count(stage), 1u) << stage << " in\n" << result.err;
  EXPECT_NEAR(share, 100, 0.6);
  EXPECT_NE(result.err.find("thread 0"), std::string::npos);
}

TEST_F(Profile, StageTimesInTheStatisticsFitIntoTheFrame) {
  ASSERT_EQ(render({"--stats", folder.path("s.json"), "-q"}).status, 0);
  const Json s = Json::parse(read_file(folder.path("s.json")));
  double geometry = 0, tiles = 0;
  for (const Json& ms : s.at("geometry_stages_thread_ms")) geometry += ms.get<double>();
  for (const Json& ms : s.at("tile_stages_thread_ms")) tiles += ms.get<double>();
  const double threads = s.at("threads").get<double>();
  EXPECT_GT(tiles, 0);
  EXPECT_LE(geometry, 1.05 * threads * s.at("stages_ms").at("geometry").get<double>() + 0.05);
  EXPECT_LE(tiles, 1.05 * threads * s.at("stages_ms").at("tiles").get<double>() + 0.05);
}

TEST_F(Profile, OnlyOneThingGoesToStandardOutput) {
  const Result result = render({"--trace", "-", "--stats", "-"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("--trace"), std::string::npos) << result.err;
  EXPECT_EQ(render({"--trace", "/nowhere/t.json"}).status, 4);
}

}  // namespace
}  // namespace tessera::cli_test
