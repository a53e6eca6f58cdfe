// results.json of another run, or of another machine, comes from anywhere: every value is checked before it is used.
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.hpp"
#include "base/json_depth.hpp"
#include "bench/chart/results.hpp"
#include "io/file_bytes.hpp"

namespace tessera::chart {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t max_file_bytes = std::uint64_t{256} << 20;
constexpr std::size_t max_list = 4096;      // families, plots, methods, maps, findings: each list
constexpr std::size_t max_map_side = 4096;  // samples of an error map along a side
constexpr std::size_t max_text = 1 << 16;   // bytes of one text
constexpr double largest_number = 1e300;

// A value and the way to it, for messages: "results.json: families[2].plots[0].id: ...".
struct Value {
  const Json& json;
  std::string where;

  [[nodiscard]] tessera::Error wrong(const std::string& expected) const {
    return input_error("{}: expected {}, found {}", where, expected, json.type_name());
  }
  [[nodiscard]] Value operator[](const char* key) const {
    if (!json.is_object()) throw wrong("an object");
    const auto found = json.find(key);
    if (found == json.end()) throw input_error("{}: '{}' is missing", where, key);
    return {*found, where + "." + key};
  }
  [[nodiscard]] std::vector<Value> list(std::size_t most = max_list) const {
    if (!json.is_array()) throw wrong("a list");
    if (json.size() > most) throw input_error("{}: {} entries, at most {} are allowed", where, json.size(), most);
    std::vector<Value> values;
    values.reserve(json.size());
    for (std::size_t i = 0; i < json.size(); ++i) values.push_back({json[i], where + "[" + std::to_string(i) + "]"});
    return values;
  }
  [[nodiscard]] std::string text() const {
    if (!json.is_string()) throw wrong("a text");
    const auto& text = json.get_ref<const std::string&>();
    if (text.size() > max_text)
      throw input_error("{}: a text of {} bytes, at most {} are allowed", where, text.size(), max_text);
    return text;
  }
  // Ids become parts of file names.
  [[nodiscard]] std::string id() const {
    std::string text = this->text();
    if (text.empty() || text.size() > 64 ||
        text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") != std::string::npos)
      throw input_error("{}: an id is 1 to 64 characters of a-z, 0-9 and -", where);
    return text;
  }
  [[nodiscard]] double number() const {
    if (json.is_null()) return NAN;
    if (!json.is_number()) throw wrong("a number or null");
    const auto value = json.get<double>();
    if (!(std::abs(value) <= largest_number)) throw input_error("{}: a number too large", where);
    return value;
  }
  // Costs and errors.
  [[nodiscard]] double amount() const {
    const double value = number();
    if (value < 0) throw input_error("{}: {} is negative", where, value);
    return value;
  }
  [[nodiscard]] bool boolean() const {
    if (!json.is_boolean()) throw wrong("true or false");
    return json.get<bool>();
  }
};

std::vector<double> numbers(const Value& value, std::size_t most) {
  if (!value.json.is_array()) throw value.wrong("a list");
  if (value.json.size() > most)
    throw input_error("{}: {} numbers, at most {} are allowed", value.where, value.json.size(), most);
  std::vector<double> list;
  list.reserve(value.json.size());
  for (const Json& entry : value.json) {
    // The path of each would cost more than the numbers.
    if (!entry.is_number() && !entry.is_null()) throw input_error("{}: holds more than numbers", value.where);
    list.push_back(entry.is_null() ? NAN : entry.get<double>());
    if (std::isinf(list.back())) throw input_error("{}: a number too large", value.where);
  }
  return list;
}

Error error_of(const Value& value) { return {value["max"].amount(), value["mean"].amount(), value["rms"].amount()}; }

Cost cost_of(const Value& value) {
  Cost cost{value["ns"].amount(), value["low"].amount(), value["high"].amount(), 0};
  const double repetitions = value["repetitions"].amount();
  if (!(repetitions <= 1e9)) throw input_error("{}.repetitions: not a count", value.where);
  cost.repetitions = static_cast<int>(repetitions);
  return cost;
}

ErrorMap map_of(const Value& value) {
  ErrorMap map{value["title"].text(),
               value["column_name"].text(),
               value["row_name"].text(),
               numbers(value["columns"], max_map_side),
               numbers(value["rows"], max_map_side),
               numbers(value["values"], max_map_side * max_map_side)};
  if (map.values.size() != map.columns.size() * map.rows.size())
    throw input_error("{}.values: {} numbers for {} columns and {} rows", value.where, map.values.size(),
                      map.columns.size(), map.rows.size());
  return map;
}

Point point_of(const Value& value) {
  Point point;
  point.id = value["id"].id();
  point.title = value["title"].text();
  point.formula = value["formula"].text();
  point.paper = value["paper"].text();
  point.file = value["file"].text();
  point.fails = value["fails"].text();
  point.note = value["note"].text();
  const Value cost = value["cost"], extra = value["extra"];
  if (!cost.json.is_object()) throw cost.wrong("an object");
  if (!extra.json.is_object()) throw extra.wrong("an object");
  if (cost.json.size() > 64 || extra.json.size() > 64) throw input_error("{}: more than 64 columns", value.where);
  for (const auto& [isa, entry] : cost.json.items()) point.cost[isa] = cost_of({entry, cost.where + "." + isa});
  for (const auto& [name, entry] : extra.json.items())
    point.extra[name] = Value{entry, extra.where + "." + name}.number();
  point.method = error_of(value["method"]);
  point.arithmetic = error_of(value["arithmetic"]);
  for (const Value& map : value["maps"].list()) point.maps.push_back(map_of(map));
  return point;
}

Plot plot_of(const Value& value) {
  Plot plot;
  plot.id = value["id"].id();
  plot.title = value["title"].text();
  plot.error_name = value["error_name"].text();
  plot.domain = value["domain"].text();
  plot.truth = value["truth"].text();
  const std::string measure = value["measure"].text();
  if (measure != "max" && measure != "mean" && measure != "rms")
    throw input_error("{}.measure: expected max, mean or rms", value.where);
  plot.measure = measure == "max" ? Measure::max : measure == "mean" ? Measure::mean : Measure::rms;
  std::set<std::string> ids;
  for (const Value& point : value["points"].list()) {
    plot.points.push_back(point_of(point));
    if (!ids.insert(plot.points.back().id).second)
      throw input_error("{}: the id '{}' appears twice", value.where, plot.points.back().id);
  }
  return plot;
}

Family family_of(const Value& value) {
  Family family{value["id"].id(), value["title"].text(), value["about"].text(), {}, {}};
  for (const Value& finding : value["findings"].list()) family.findings.push_back(finding.text());
  std::set<std::string> ids;
  for (const Value& plot : value["plots"].list()) {
    family.plots.push_back(plot_of(plot));
    if (!ids.insert(family.plots.back().id).second)
      throw input_error("{}: the id '{}' appears twice", value.where, family.plots.back().id);
  }
  return family;
}

Machine machine_of(const Value& value) {
  Machine machine{value["cpu"].text(),         value["compiler"].text(), value["flags"].text(),
                  value["commit"].text(),      value["date"].text(),     value["tessera"].text(),
                  value["clock_ghz"].amount(), value["quick"].boolean(), {}};
  for (const Value& isa : value["isas"].list(64)) machine.isas.push_back(isa.id());
  return machine;
}

// What the library says of a syntax error, without its own name and on one line.
std::string plain(const Json::exception& error) {
  std::string text = error.what();
  const std::size_t at = text.find("] ");
  if (at != std::string::npos) text.erase(0, at + 2);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return text.substr(0, 200);
}

}  // namespace

Results from_json(const std::string& text, const std::string& name) {
  constexpr int deepest = 32;
  if (nests_deeper(text, deepest))
    throw input_error("{}: not JSON of a chart: nested more than {} deep", name, deepest);
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception& error) {
    throw input_error("{}: not JSON: {}", name, plain(error));
  }
  const Value root{json, name};
  if (!json.is_object() || json.value("format", Json()) != "tessera-chart")
    throw input_error("{}: not the results of a chart (no \"format\": \"tessera-chart\")", name);
  if (root["version"].json != 1)
    throw input_error("{}: results of version {}, version 1 is known", name, root["version"].json.dump().substr(0, 40));
  Results results{machine_of(root["machine"]), {}};
  std::set<std::string> ids;
  for (const Value& family : root["families"].list()) {
    results.families.push_back(family_of(family));
    if (!ids.insert(results.families.back().id).second)
      throw input_error("{}: the family '{}' appears twice", name, results.families.back().id);
  }
  return results;
}

Results read_results(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(path, max_file_bytes);
  return from_json(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), path);
}

}  // namespace tessera::chart
