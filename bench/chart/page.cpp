#include "bench/chart/page.hpp"

#include <fmt/format.h>

#include "bench/chart/compare.hpp"
#include "bench/chart/page_parts.hpp"
#include "bench/chart/plot.hpp"
#include "chart/markup.hpp"

namespace tessera::chart {
namespace {

std::string paragraph(const std::string& text, const char* attributes = "") {
  return text.empty() ? "" : fmt::format("<p {}>{}</p>\n", attributes, escaped(text));
}

// Both layouts for every instruction set; the style sheet and the script choose one.
std::string drawings(const Results& results, const Plot& plot, const Plot* other, const std::string& other_name) {
  std::string out;
  const std::vector<std::string>& isas = results.machine.isas;
  for (const std::string& isa : isas) {
    out += fmt::format(R"(<div class="drawing" data-isa="{}"{}>)", escaped(isa), isa == isas.back() ? "" : " hidden");
    for (const Layout layout : {Layout::wide, Layout::narrow}) {
      const Drawing drawing = draw_plot({results.machine, plot, isa, other, other_name}, layout);
      out +=
          fmt::format(R"(<svg class="plot {}" viewBox="0 0 {} {}" role="group" aria-label="{}">{}</svg>)",
                      layout == Layout::wide ? "wide" : "narrow", coordinate(drawing.width), coordinate(drawing.height),
                      escaped(fmt::format(
                          "Scatter plot of {} methods on {}: cost against method error, arithmetic error below. The "
                          "table has the same numbers.",
                          plot.points.size(), isa)),
                      drawing.content);
    }
    out += fmt::format("<figcaption>{}</figcaption></div>\n",
                       escaped(caption_of(results.machine, isa) + " · " + flags_of(results.machine, isa)));
  }
  return out;
}

std::string plot_section(const Results& results, const Family& family, const Plot& plot, const Results* other) {
  const Plot* theirs = other == nullptr ? nullptr : matching_plot(*other, family.id, plot.id);
  return fmt::format(
             R"(<article id="{0}-{1}"><h3>{2}</h3><p class="terms"><span><b>Error</b> {3}</span><span><b>Over</b> {4}</span>)"
             R"(<span><b>Truth</b> {5}</span></p><figure class="chart" data-plot="{0}/{1}">)",
             escaped(family.id), escaped(plot.id), escaped(plot.title), escaped(plot.error_name), escaped(plot.domain),
             escaped(plot.truth)) +
         drawings(results, plot, theirs, other == nullptr ? "" : name_of_run(other->machine)) + "</figure>\n" +
         page_table(results, family, plot, theirs) + page_maps(plot) + "</article>\n";
}

std::string family_section(const Results& results, const Family& family, const Results* other) {
  std::string out =
      fmt::format(R"(<section id="{}" class="family"><h2>{}</h2>)", escaped(family.id), escaped(family.title));
  out += paragraph(family.about, "class=\"about\"");
  if (!family.findings.empty()) {
    out += R"(<div class="findings"><h3>What the numbers show</h3><ul>)";
    for (const std::string& finding : family.findings) out += "<li>" + escaped(finding) + "</li>";
    out += "</ul></div>\n";
  }
  for (const Plot& plot : family.plots) out += plot_section(results, family, plot, other);
  return out + "</section>\n";
}

std::string machine_list(const Machine& m) {
  std::string out;
  const auto row = [&](const char* key, const std::string& value) {
    out += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", key, escaped(value));
  };
  row("CPU", m.cpu);
  row("Clock",
      m.clock_ghz > 0 ? fmt::format("{:.2f} GHz, from a chain of dependent additions", m.clock_ghz) : "unknown");
  row("Compiler", m.compiler);
  row("Commit", m.commit);
  row("Measured", m.date + (m.quick ? ", quick run: fewer samples and repetitions" : ""));
  row("Flags", m.flags);
  return out;
}

std::string isa_choice(const Machine& machine) {
  std::string out;
  for (const std::string& isa : machine.isas)
    out += fmt::format(R"(<label><input type="radio" name="isa" value="{0}"{1}><span>{0}</span></label>)", escaped(isa),
                       isa == machine.isas.back() ? " checked" : "");
  return out;
}

std::string comparison(const Results& results, const Results* other) {
  if (other == nullptr) return "";
  std::string rows;
  for (const RatioSummary& row : summarise_ratios(results, *other))
    rows += fmt::format(
        R"(<tr><th scope="row">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{} <small>{}</small></td><td>{} <small>{}</small></td></tr>)",
        escaped(row.family), escaped(row.isa), row.methods, amount(row.geometric_mean), amount(row.lowest),
        escaped(row.lowest_title), amount(row.highest), escaped(row.highest_title));
  return R"(<section id="comparison" class="family"><h2>Against another run</h2>)" +
         paragraph("Compared with " + caption_of(other->machine, "") +
                   ". Ratios are this run's cost over the other's: below 1, this run is faster.") +
         R"(<div class="table-frame" tabindex="0" role="region" aria-label="Table: cost ratios"><table class="ratios"><caption>Cost ratios by family</caption>)"
         R"(<thead><tr><th scope="col">Family</th><th scope="col">Instruction set</th><th scope="col">Methods</th><th scope="col">Geometric mean</th><th scope="col">Lowest</th><th scope="col">Highest</th></tr></thead><tbody>)" +
         rows + "</tbody></table></div></section>\n";
}

}  // namespace

std::string make_page(const Results& results, const Results* other) {
  std::string links, sections;
  if (other != nullptr) links += R"(<a href="#comparison">Comparison</a>)";
  for (const Family& family : results.families) {
    links += fmt::format(R"(<a href="#{}">{}</a>)", escaped(family.id), escaped(family.title));
    sections += family_section(results, family, other);
  }
  return filled_in(page_html, {{"css", page_css},
                               {"js", page_js},
                               {"machine", machine_list(results.machine)},
                               {"caption", escaped(caption_of(results.machine, ""))},
                               {"links", links},
                               {"isas", isa_choice(results.machine)},
                               {"families", comparison(results, other) + sections},
                               {"data", page_data(results, other)}});
}

}  // namespace tessera::chart
