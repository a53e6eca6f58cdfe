#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bench/chart/compare.hpp"
#include "bench/chart/page.hpp"
#include "bench/chart/plot.hpp"
#include "chart/markup.hpp"

namespace tessera::chart {
namespace {

std::string head(const std::string& words, const std::string& attributes) {
  return fmt::format(R"(<th scope="col" aria-sort="none" {}><button type="button">{}</button></th>)", attributes,
                     escaped(words));
}

// data-value is what sorting goes by.
std::string cell(double value, const std::string& attributes = "", const std::string& below = "") {
  return fmt::format("<td {} data-value=\"{}\">{}{}</td>", attributes,
                     std::isfinite(value) ? fmt::format("{:.9g}", value) : "", amount(value),
                     below.empty() ? "" : "<small>" + below + "</small>");
}

std::string isa_attribute(const std::string& isa) { return "data-column-isa=\"" + escaped(isa) + "\""; }

std::string method_cell(const Point& point) {
  std::string rows;
  const auto row = [&](const char* key, const std::string& value, const char* tag) {
    if (!value.empty()) rows += fmt::format("<dt>{}</dt><dd><{}>{}</{}></dd>", key, tag, escaped(value), tag);
  };
  row("Formula", point.formula, "code");
  row("Source", point.paper, "cite");
  row("Code", point.file, "code");
  row("Fails", point.fails, "span");
  row("Note", point.note, "span");
  return fmt::format(R"(<th scope="row"><span class="name">{}</span>{}</th>)", escaped(point.title),
                     rows.empty() ? "" : "<details><summary>details</summary><dl>" + rows + "</dl></details>");
}

// The names of the further columns, in the order of their first use.
std::vector<std::string> extra_names(const Plot& plot) {
  std::vector<std::string> names;
  for (const Point& point : plot.points)
    for (const auto& [name, value] : point.extra)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

}  // namespace

std::string page_table(const Results& results, const Family& family, const Plot& plot, const Plot* other) {
  const std::vector<std::string>& isas = results.machine.isas;
  const double ghz = results.machine.clock_ghz;
  const std::vector<std::string> extras = extra_names(plot);
  std::string groups = R"(<tr><td colspan="2"></td>)",
              heads = "<tr>" + head("#", "class=\"number\"") + head("Method", "");
  const auto group = [&](const std::string& words, std::size_t columns, const char* attributes = "") {
    groups += fmt::format(R"(<th scope="colgroup" colspan="{}" {}>{}</th>)", columns, attributes, escaped(words));
  };
  group(ghz > 0 ? "Cost, ns per evaluation (and cycles)" : "Cost, ns per evaluation", isas.size(), "data-isas");
  for (const std::string& isa : isas) heads += head(isa, isa_attribute(isa));
  if (other != nullptr) {
    group("Cost, this run / other run", isas.size(), "data-isas");
    for (const std::string& isa : isas) heads += head("× " + isa, isa_attribute(isa));
  }
  for (const char* kind : {"Method error", "Arithmetic error"}) {
    group(kind, 3);
    for (const char* name : {"largest", "mean", "rms"}) heads += head(name, "");
  }
  if (!extras.empty()) group("Further", extras.size());
  for (const std::string& name : extras) heads += head(name, "");

  std::string body;
  for (std::size_t i = 0; i < plot.points.size(); ++i) {
    const Point& point = plot.points[i];
    body += fmt::format(R"(<tr data-point="{}"><td class="number" data-value="{}">{}</td>)", escaped(point.id), i + 1,
                        i + 1) +
            method_cell(point);
    for (const std::string& isa : isas) {
      const auto cost = point.cost.find(isa);
      const double ns = cost == point.cost.end() ? NAN : cost->second.ns;
      const bool cycles = ghz > 0 && std::isfinite(ns);
      const std::vector<bool> frontier = on_frontier(plot, isa);
      body += cell(ns, isa_attribute(isa) + (frontier[i] ? " class=\"best\"" : ""),
                   cycles ? fmt::format("{} cycles", amount(ns * ghz)) : "");
    }
    if (other != nullptr)
      for (const std::string& isa : isas) {
        const double ratio = cost_ratio(point, matching_point(other, point.id), isa);
        body += cell(ratio > 0 ? ratio : NAN, isa_attribute(isa));
      }
    for (const Error& e : {point.method, point.arithmetic})
      for (const double value : {e.max, e.mean, e.rms}) body += cell(value);
    for (const std::string& name : extras) {
      const auto value = point.extra.find(name);
      body += cell(value == point.extra.end() ? NAN : value->second);
    }
    body += "</tr>\n";
  }
  return fmt::format(
      R"(<div class="table-frame" tabindex="0" role="region" aria-label="Table: {0}"><table data-plot="{1}/{2}">)"
      "<caption>{0}: every method, with its errors ({3}). Costs on the Pareto frontier are marked.</caption>"
      "<thead>{4}</tr>{5}</tr></thead>\n<tbody>\n{6}</tbody></table></div>\n",
      escaped(plot.title), escaped(family.id), escaped(plot.id), escaped(plot.error_name), groups, heads, body);
}

}  // namespace tessera::chart
