#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/chart/results.hpp"

namespace tessera::chart {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no infinities; null stands for whatever is no finite number.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json rounded(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number(std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr)));
  return list;
}

Json json_of(const Error& error) {
  return {{"max", number(error.max)}, {"mean", number(error.mean)}, {"rms", number(error.rms)}};
}

Json json_of(const Point& point) {
  Json json = {{"id", point.id},       {"title", point.title},   {"formula", point.formula},
               {"paper", point.paper}, {"file", point.file},     {"fails", point.fails},
               {"note", point.note},   {"cost", Json::object()}, {"method", json_of(point.method)}};
  json["arithmetic"] = json_of(point.arithmetic);
  for (const auto& [isa, cost] : point.cost)
    json["cost"][isa] = {{"ns", number(cost.ns)},
                         {"low", number(cost.low)},
                         {"high", number(cost.high)},
                         {"repetitions", cost.repetitions}};
  json["extra"] = Json::object();
  for (const auto& [name, value] : point.extra) json["extra"][name] = number(value);
  json["maps"] = Json::array();
  for (const ErrorMap& map : point.maps)
    json["maps"].push_back({{"title", map.title},
                            {"column_name", map.column_name},
                            {"row_name", map.row_name},
                            {"columns", rounded(map.columns)},
                            {"rows", rounded(map.rows)},
                            {"values", rounded(map.values)}});
  return json;
}

// Indented, but lists of numbers on one line: error maps would else take a line a value.
void write(std::string& out, const Json& json, int depth) {
  const std::string indent(static_cast<std::size_t>(depth) * 2, ' ');
  const bool flat =
      json.is_array() && std::all_of(json.begin(), json.end(), [](const Json& j) { return !j.is_structured(); });
  if (!json.is_structured() || json.empty() || flat) {
    out += json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return;
  }
  const bool object = json.is_object();
  out += object ? "{\n" : "[\n";
  for (auto it = json.begin(); it != json.end(); ++it) {
    if (it != json.begin()) out += ",\n";
    out += indent + "  ";
    if (object) out += Json(it.key()).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
    write(out, *it, depth + 1);
  }
  out += '\n';
  out += indent;
  out += object ? '}' : ']';
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out.append(c == '"' ? 2 : 1, c);
  return out + "\"";
}

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{:.9g}", value) : ""; }

}  // namespace

double measured(const Error& error, Measure measure) {
  return measure == Measure::max ? error.max : measure == Measure::mean ? error.mean : error.rms;
}

std::string to_json(const Results& results) {
  const Machine& m = results.machine;
  Json json = {{"format", "tessera-chart"}, {"version", 1}};
  json["machine"] = {{"cpu", m.cpu},
                     {"compiler", m.compiler},
                     {"flags", m.flags},
                     {"commit", m.commit},
                     {"date", m.date},
                     {"tessera", m.version},
                     {"clock_ghz", number(m.clock_ghz)},
                     {"quick", m.quick},
                     {"isas", m.isas}};
  json["families"] = Json::array();
  for (const Family& family : results.families) {
    Json f = {{"id", family.id}, {"title", family.title}, {"about", family.about}, {"findings", family.findings}};
    f["plots"] = Json::array();
    for (const Plot& plot : family.plots) {
      constexpr const char* measures[] = {"max", "mean", "rms"};
      Json p = {{"id", plot.id},
                {"title", plot.title},
                {"error_name", plot.error_name},
                {"measure", measures[static_cast<int>(plot.measure)]},
                {"domain", plot.domain},
                {"truth", plot.truth}};
      p["points"] = Json::array();
      for (const Point& point : plot.points) p["points"].push_back(json_of(point));
      f["plots"].push_back(std::move(p));
    }
    json["families"].push_back(std::move(f));
  }
  std::string out;
  write(out, json, 0);
  return out + "\n";
}

std::string to_csv(const Results& results) {
  std::string out =
      "family,plot,method,title,isa,ns,ns_low,ns_high,repetitions,cycles,method_error_max,method_error_mean,"
      "method_error_rms,arithmetic_error_max,arithmetic_error_mean,arithmetic_error_rms,paper,file\r\n";
  for (const Family& family : results.families)
    for (const Plot& plot : family.plots)
      for (const Point& point : plot.points)
        for (const auto& [isa, cost] : point.cost) {
          const double cycles = results.machine.clock_ghz > 0 ? cost.ns * results.machine.clock_ghz : NAN;
          const Error &m = point.method, &a = point.arithmetic;
          for (const std::string& text : {family.id, plot.id, point.id, point.title, isa})
            out.append(quoted(text)).append(1, ',');
          out += cell(cost.ns) + "," + cell(cost.low) + "," + cell(cost.high) + "," + std::to_string(cost.repetitions);
          for (const double value : {cycles, m.max, m.mean, m.rms, a.max, a.mean, a.rms})
            out.append(1, ',').append(cell(value));
          out.append(1, ',').append(quoted(point.paper)).append(1, ',').append(quoted(point.file)).append("\r\n");
        }
  return out;
}

}  // namespace tessera::chart
