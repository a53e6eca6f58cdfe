// tessera chart as a person runs it, short of measuring.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "src/cli/program.hpp"
#include "synthetic.hpp"

namespace tessera::chart_test {
namespace {

using cli_test::Folder;
using cli_test::Result;
using cli_test::run;

void expect_one_error_line(const Result& result, int status, const std::string& must_contain) {
  EXPECT_EQ(result.status, status);
  EXPECT_EQ(result.err.rfind("tessera: error: ", 0), 0u) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find(must_contain), std::string::npos) << result.err;
}

TEST(ChartProgram, HasHelp) {
  const Result help = run({"chart", "--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.err, "");
  for (const char* word :
       {"tessera chart", "--quick", "--isa", "--compare", "--from", "--list", "results.json", "out/chart"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
}

TEST(ChartProgram, ListsFamilies) {
  const Result list = run({"chart", "--list"});
  EXPECT_EQ(list.status, 0);
  EXPECT_NE(list.out.find("fresnel\n"), std::string::npos) << list.out;
  // Each family, at the left margin, is followed by its methods, which are indented.
  std::istringstream lines(list.out);
  std::string line, family;
  std::map<std::string, int> methods;
  while (std::getline(lines, line)) {
    if (line.rfind("  ", 0) != 0) {
      family = line;
      methods[family] = 0;
    } else {
      ++methods[family];
    }
  }
  EXPECT_GE(methods.size(), 9u);
  for (const auto& [name, count] : methods) EXPECT_GE(count, 5) << name;
  for (const char* method : {"\n  RGB9E5 ", "\n  trilinear ", "\n  8 x 8 tiles\n", "\n  off-specular peak "})
    EXPECT_NE(list.out.find(method), std::string::npos) << method << list.out;
}

TEST(ChartProgram, RefusesWhatItDoesNotKnow) {
  expect_one_error_line(run({"chart", "nonsense"}), 2, "no family 'nonsense'");
  expect_one_error_line(run({"chart", "--isa", "mmx"}), 2, "mmx");
  expect_one_error_line(run({"chart", "--no-such-option"}), 2, "no-such-option");
  expect_one_error_line(run({"chart", "--from", "x.json", "--quick"}), 2, "--quick");
  expect_one_error_line(run({"chart", "fresnel", "--env", "a.exr"}), 2, "only ibl");
  expect_one_error_line(run({"chart", "ibl", "--env", "nothing.exr", "-o", Folder().path("chart")}), 3, "nothing.exr");
}

TEST(ChartProgram, DrawsFromAFileAndComparesWithAnother) {
  const Folder folder;
  cli_test::write_file(folder.path("results.json"), to_json(synthetic_results()));
  const Result result = run({"chart", "--from", folder.path("results.json"), "--compare", folder.path("results.json"),
                             "-o", folder.path("deep/chart")});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("deep/chart/index.html"), std::string::npos);
  EXPECT_NE(result.out.find("cost x 1.00"), std::string::npos) << result.out;
  const std::string page = cli_test::read_file(folder.path("deep/chart/index.html"));
  EXPECT_EQ(page.rfind("<!doctype html>", 0), 0u);
  EXPECT_EQ(page.find("{{"), std::string::npos);
  EXPECT_EQ(cli_test::read_file(folder.path("deep/chart/plots/fresnel-crowded-avx2.png")).substr(1, 3), "PNG");
  EXPECT_EQ(cli_test::read_file(folder.path("deep/chart/plots/fresnel-crowded-avx2.svg")).rfind("<svg ", 0), 0u);
  EXPECT_EQ(cli_test::read_file(folder.path("deep/chart/maps/fresnel-dielectric-method-0.png")).substr(1, 3), "PNG");
  const std::string json = cli_test::read_file(folder.path("deep/chart/results.json"));
  EXPECT_EQ(json, to_json(synthetic_results())) << "what was read is written as it was";
}

TEST(ChartProgram, RefusesHostileFilesInOneLine) {
  const Folder folder;
  std::string hostile = to_json(synthetic_results());
  const std::string key = "\"avx2\": {";
  hostile.replace(hostile.find(key), key.size(), "\"\\n\\u001b[31m\": {\"x\": 1}, \"avx2\": {");
  cli_test::write_file(folder.path("hostile.json"), hostile);
  cli_test::write_file(folder.path("deep.json"), R"({"format": "tessera-chart", "version": )" +
                                                     std::string(300000, '[') + std::string(300000, ']') + "}");
  for (const char* option : {"--from", "--compare"}) {
    expect_one_error_line(run({"chart", option, folder.path("hostile.json")}), 3, "hostile.json");
    expect_one_error_line(run({"chart", option, folder.path("nothing.json")}), 3, "nothing.json");
    expect_one_error_line(run({"chart", option, folder.path("deep.json")}), 3, "nested");
  }
}

TEST(ChartProgram, SaysWhenItCannotWrite) {
  const Folder folder;
  cli_test::write_file(folder.path("results.json"), to_json(synthetic_results()));
  cli_test::write_file(folder.path("file"), "in the way");
  expect_one_error_line(run({"chart", "--from", folder.path("results.json"), "-o", folder.path("file/chart")}), 4,
                        "file/chart");
  // Before it measures: this comes at once, and with no line of progress before it.
  expect_one_error_line(run({"chart", "fresnel", "-o", folder.path("file/chart")}), 4, "file/chart");
}

}  // namespace
}  // namespace tessera::chart_test
