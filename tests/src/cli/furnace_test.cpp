#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/image_file.hpp"
#include "program.hpp"
#include "reference/albedo.hpp"

namespace tessera::cli_test {
namespace {

nlohmann::json furnace(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"furnace", "--json"});
  const Result result = run(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return nlohmann::json::parse(result.out);
}

TEST(Furnace, SingleScatteringIsTheQuadrature) {
  for (const double f0 : {1.0, 0.3}) {
    const auto json = furnace({"--roughness", "0.1,0.5,1", "--f0", std::to_string(f0)});
    for (const auto& row : json.at("rows"))
      for (std::size_t i = 0; i < json.at("NoV").size(); ++i) {
        const double r = row.at("roughness");
        const auto exact = reference::directional_albedo(json.at("NoV")[i], r * r, 64);
        EXPECT_NEAR(row.at("albedo")[i].get<double>(), f0 * exact.A + exact.B, 2e-5) << r << " " << json.at("NoV")[i];
      }
  }
}

TEST(Furnace, CompensatedLobesAreWhite) {
  for (const char* name : {"KullaConty_table", "Turquin", "split_FdezAguera", "split_FdezAguera_kS"}) {
    const auto json = furnace({"--brdf", name, "--roughness", "0.05,0.3,0.7,1"});
    ASSERT_EQ(json.at("rows").size(), 4u);
    for (const auto& row : json.at("rows")) {
      EXPECT_NEAR(row.at("lowest").get<double>(), 1, 1e-3) << name << " " << row.at("roughness");
      EXPECT_NEAR(row.at("highest").get<double>(), 1, 1e-3) << name << " " << row.at("roughness");
    }
  }
}

TEST(Furnace, EveryPartCanBePutInsideOne) {
  const Result list = run({"furnace", "--list"});
  ASSERT_EQ(list.status, 0);
  int parts = 0;
  for (std::size_t at = 0; at < list.out.size();) {
    const std::size_t end = list.out.find('\n', at);
    const std::string line = list.out.substr(at, end - at);
    at = end + 1;
    if (line[0] != ' ') continue;
    ++parts;
    const auto json = furnace({"--brdf", line.substr(2), "--roughness", "0.5"});
    const double average = json.at("rows")[0].at("average");
    EXPECT_TRUE(average > 0.3 && average < 3) << line << " " << average;
  }
  EXPECT_GT(parts, 30);
}

TEST(Furnace, PictureShowsNothingWhereNothingIsMissing) {
  const Folder folder;
  const std::string path = folder.path("f.png");
  ASSERT_EQ(run({"furnace", "--brdf", "KullaConty_table", "--roughness", "0.5,1", "--size", "48", "-o", path}).status,
            0);
  const Image white = read_image(path);
  ASSERT_EQ(white.width, 96);
  for (int x = 0; x < 96; ++x) EXPECT_NEAR(white.at(x, 24)[0], white.at(0, 0)[0], 1.5 / 255) << x;
  ASSERT_EQ(run({"furnace", "--roughness", "0.5,1", "--size", "48", "-o", path}).status, 0);
  const Image grey = read_image(path);
  EXPECT_LT(grey.at(24 + 48, 24)[0], grey.at(0, 0)[0] - 0.2F);  // a rough metal's middle
}

TEST(Furnace, WrongUsageIsStatus2AndOneLine) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--brdf", "phong"},
                                                    {"--brdf", "ggx,beckmann"},
                                                    {"--brdf", "ggx,"},
                                                    {"--roughness", "0"},
                                                    {"--roughness", "x"},
                                                    {"--f0", "2"},
                                                    {"--size", "3"},
                                                    {"--gamma", "9"}}) {
    std::vector<std::string> all = {"furnace"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Result result = run(all);
    EXPECT_EQ(result.status, 2) << arguments[0] << " " << arguments[1];
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  EXPECT_EQ(run({"furnace", "-o", "/nowhere/at/all.png"}).status, 4);
}

}  // namespace
}  // namespace tessera::cli_test
