#include "bench/chart/results.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "base/error.hpp"
#include "synthetic.hpp"

namespace tessera::chart_test {
namespace {

void expect_same(const chart::Error& a, const chart::Error& b) {
  EXPECT_EQ(a.max, b.max);
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.rms, b.rms);
}

void expect_same(const ErrorMap& a, const ErrorMap& b) {
  EXPECT_EQ(a.title, b.title);
  EXPECT_EQ(a.column_name, b.column_name);
  EXPECT_EQ(a.row_name, b.row_name);
  ASSERT_EQ(a.values.size(), b.values.size());
  for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_NEAR(a.values[i], b.values[i], 1e-5 * std::abs(a.values[i]));
}

void expect_same(const Point& a, const Point& b) {
  for (const auto member :
       {&Point::id, &Point::title, &Point::formula, &Point::paper, &Point::file, &Point::fails, &Point::note})
    EXPECT_EQ(a.*member, b.*member);
  ASSERT_EQ(a.cost.size(), b.cost.size());
  for (const auto& [isa, cost] : a.cost) {
    EXPECT_EQ(cost.ns, b.cost.at(isa).ns);
    EXPECT_EQ(cost.low, b.cost.at(isa).low);
    EXPECT_EQ(cost.high, b.cost.at(isa).high);
    EXPECT_EQ(cost.repetitions, b.cost.at(isa).repetitions);
  }
  expect_same(a.method, b.method);
  expect_same(a.arithmetic, b.arithmetic);
  EXPECT_EQ(a.extra, b.extra);
  ASSERT_EQ(a.maps.size(), b.maps.size());
  for (std::size_t i = 0; i < a.maps.size(); ++i) expect_same(a.maps[i], b.maps[i]);
}

TEST(ResultsJson, ComeBackAsTheyWere) {
  Results results = synthetic_results();
  results.families[0].plots[1].measure = Measure::rms;
  const Results back = from_json(to_json(results), "a test");
  EXPECT_EQ(back.machine.cpu, results.machine.cpu);
  EXPECT_EQ(back.machine.flags, results.machine.flags);
  EXPECT_EQ(back.machine.isas, results.machine.isas);
  EXPECT_EQ(back.machine.clock_ghz, results.machine.clock_ghz);
  EXPECT_EQ(back.machine.quick, results.machine.quick);
  ASSERT_EQ(back.families.size(), results.families.size());
  for (std::size_t f = 0; f < back.families.size(); ++f) {
    const Family &a = results.families[f], &b = back.families[f];
    EXPECT_EQ(a.findings, b.findings);
    EXPECT_EQ(a.about, b.about);
    ASSERT_EQ(a.plots.size(), b.plots.size());
    for (std::size_t p = 0; p < a.plots.size(); ++p) {
      EXPECT_EQ(a.plots[p].error_name, b.plots[p].error_name);
      EXPECT_EQ(a.plots[p].measure, b.plots[p].measure);
      ASSERT_EQ(a.plots[p].points.size(), b.plots[p].points.size());
      for (std::size_t i = 0; i < a.plots[p].points.size(); ++i)
        expect_same(a.plots[p].points[i], b.plots[p].points[i]);
    }
  }
}

TEST(ResultsJson, WhatIsNoNumberBecomesNullAndComesBackAsNone) {
  Results results = synthetic_results();
  results.families[0].plots[0].points[0].method.max = INFINITY;
  results.families[0].plots[0].points[0].maps[0].values[3] = NAN;
  const Results back = from_json(to_json(results), "a test");
  EXPECT_TRUE(std::isnan(back.families[0].plots[0].points[0].method.max));
  EXPECT_TRUE(std::isnan(back.families[0].plots[0].points[0].maps[0].values[3]));
}

// Whatever the text is: results, or one line that says what is wrong with it.
void expect_refused(const std::string& text, const std::string& must_contain) {
  try {
    (void)from_json(text, "other.json");
    ADD_FAILURE() << "accepted: " << text.substr(0, 80);
  } catch (const tessera::Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.status(), ExitStatus::input);
    EXPECT_EQ(what.rfind("other.json", 0), 0u) << what;
    EXPECT_NE(what.find(must_contain), std::string::npos) << what;
    EXPECT_LT(what.size(), 500u);
  }
}

// Hands the JSON of good results to `spoil`, and says what must be complained about.
template <class Spoil>
void expect_refused_after(const std::string& must_contain, const Spoil& spoil) {
  nlohmann::json json = nlohmann::json::parse(to_json(synthetic_results()));
  spoil(json);
  expect_refused(json.dump(), must_contain);
}

TEST(ResultsJson, RefusesWhatIsNotOne) {
  for (const char* text : {"", "{", "nonsense", "{\"format\":\"tessera-chart\",\"version\":1e999}", "\xff\xfe"})
    expect_refused(text, "not JSON");
  for (const char* text : {"[]", "null", "{}", "{\"format\":3}", "{\"format\":\"other\"}"})
    expect_refused(text, "not the results of a chart");
  expect_refused(std::string(200000, '['), "not JSON");
  expect_refused(R"({"format":"tessera-chart"})", "'version' is missing");
  expect_refused(R"({"format":"tessera-chart","version":2})", "version 2");
}

TEST(ResultsJson, RefusesWrongValuesAndSaysWhere) {
  using Json = nlohmann::json;
  const auto point = [](Json& j) -> Json& { return j["families"][0]["plots"][0]["points"][0]; };
  expect_refused_after("machine.cpu: expected a text", [](Json& j) { j["machine"]["cpu"] = 3; });
  expect_refused_after("families: expected a list", [](Json& j) { j["families"] = "many"; });
  expect_refused_after("families[0].plots[0].points[0].id", [&](Json& j) { point(j)["id"] = "../../etc"; });
  expect_refused_after("appears twice",
                       [&](Json& j) { j["families"][0]["plots"][0]["points"][1]["id"] = point(j)["id"]; });
  expect_refused_after("negative", [&](Json& j) { point(j)["method"]["max"] = -1; });
  expect_refused_after("cost.avx2: expected an object", [&](Json& j) { point(j)["cost"]["avx2"] = 1; });
  expect_refused_after("'ns' is missing", [&](Json& j) { point(j)["cost"]["avx2"].erase("ns"); });
  expect_refused_after("not a count", [&](Json& j) { point(j)["cost"]["avx2"]["repetitions"] = 1e20; });
  expect_refused_after("numbers for", [&](Json& j) { point(j)["maps"][0]["values"].push_back(1); });
  expect_refused_after("more than numbers", [&](Json& j) { point(j)["maps"][0]["values"][0] = "x"; });
  expect_refused_after("measure", [](Json& j) { j["families"][0]["plots"][0]["measure"] = "median"; });
  expect_refused_after("entries", [](Json& j) { j["families"][0]["findings"] = Json(std::vector<std::string>(5000)); });
}

TEST(ResultsJson, SurvivesRandomDamage) {
  Results small = synthetic_results();
  for (Family& family : small.families)
    for (Plot& plot : family.plots) {
      plot.points.resize(2);
      for (Point& p : plot.points) p.maps.clear();
    }
  const std::string good = to_json(small);
  std::mt19937 random(11);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text = good;
    for (int k = 0; k < 1 + i % 3; ++k) text[random() % text.size()] = static_cast<char>(random());
    try {
      (void)from_json(text, "damaged");
    } catch (const tessera::Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::input);
      ++refused;
    }
  }
  EXPECT_GT(refused, 500);
}

TEST(ResultsCsv, HasARowForEveryCostAndQuotesWhatNeedsIt) {
  Results results = synthetic_results();
  results.families.resize(1);
  results.families[0].plots.resize(1);
  results.families[0].plots[0].points.resize(1);
  Point& point = results.families[0].plots[0].points[0];
  point.title = "A \"quoted\", name";
  point.cost.erase("sse42");
  point.arithmetic.max = NAN;
  const std::string csv = to_csv(results);
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < csv.size(); at = csv.find("\r\n", at) + 2)
    lines.push_back(csv.substr(at, csv.find("\r\n", at) - at));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[1].rfind("fresnel,dielectric,method-0,\"A \"\"quoted\"\", name\",avx2,", 0), 0u) << lines[1];
  EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), ','), 17);
  EXPECT_NE(lines[1].find(",,2e-08,3e-08,"), std::string::npos) << "an empty cell for what is no number: " << lines[1];
}

}  // namespace
}  // namespace tessera::chart_test
