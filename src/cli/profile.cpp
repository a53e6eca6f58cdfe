#include "cli/profile.hpp"

#include <algorithm>
#include <cstdio>

#include "cli/picture.hpp"
#include "cli/text.hpp"
#include "io/output_file.hpp"

namespace tessera::cli {
namespace {

// Threads that had anything to do.
std::vector<const ThreadProfile*> busy_threads(const FrameStatistics& f) {
  std::vector<const ThreadProfile*> busy;
  for (const ThreadProfile& thread : f.profile)
    if (std::any_of(thread.ticks.begin(), thread.ticks.end(), [](std::uint64_t t) { return t != 0; }))
      busy.push_back(&thread);
  return busy;
}

std::string thread_columns(const std::vector<double>& values) {
  std::string text;
  for (const double v : values) text += fmt::format("{:>12.3f}", v);
  return text;
}

// Microseconds since the run began.
class TraceClock {
 public:
  explicit TraceClock(const RunReport& r) : begin_(r.frame.begin_ticks), ticks_per_us_(r.frame.ticks_per_ms / 1000) {
    for (const RunPhase& phase : r.phases) begin_ = std::min(begin_, phase.begin);
  }
  [[nodiscard]] double us(std::uint64_t ticks) const {
    return ticks_per_us_ > 0 ? static_cast<double>(ticks - begin_) / ticks_per_us_ : 0;
  }

 private:
  std::uint64_t begin_;
  double ticks_per_us_;
};

}  // namespace

void check_machine_outputs(const MachineOptions& options, const std::string& picture_path) {
  int to_standard_output = picture_path == "-" ? 1 : 0;
  for (const std::string& path : {options.statistics, options.trace}) {
    if (!path.empty()) check_writable(path);
    to_standard_output += path == "-" ? 1 : 0;
  }
  if (to_standard_output > 1) throw usage_error("only one of -o, --stats and --trace can be standard output");
}

void report_to(const MachineOptions& options, const RunReport& report) {
  if (options.profile) tell_profile(report);
  if (!options.trace.empty()) write_trace(options.trace, report);
  if (!options.statistics.empty()) write_statistics(options.statistics, report);
}

void tell_profile(const RunReport& r) {
  const FrameStatistics& f = r.frame;
  const std::vector<const ThreadProfile*> threads = busy_threads(f);
  std::string text = fmt::format("time-stamp counter: {:.0f} MHz; million cycles of it by stage and thread\n  {:<12}",
                                 f.ticks_per_ms / 1000, "stage");
  for (std::size_t t = 0; t < threads.size(); ++t) text += fmt::format("{:>12}", fmt::format("thread {}", t));
  text += fmt::format("{:>12}{:>10}{:>10}\n", "all", "share", "ms");
  double everything = 0;
  for (const ThreadProfile* thread : threads)
    for (const std::uint64_t ticks : thread->ticks) everything += static_cast<double>(ticks);
  std::vector<double> sums(threads.size() + 1);
  const auto add_row = [&](const char* name, const std::vector<double>& row) {
    text += fmt::format("  {:<12}{}{:>9.1f}%{:>10.2f}\n", name, thread_columns(row),
                        everything > 0 ? 100 * row.back() * 1e6 / everything : 0,
                        f.ticks_per_ms > 0 ? row.back() * 1e6 / f.ticks_per_ms : 0);
  };
  for (std::size_t k = 0; k < stage_names.size(); ++k) {
    std::vector<double> row;
    double all = 0;
    for (const ThreadProfile* thread : threads) {
      row.push_back(static_cast<double>(thread->ticks[k]) / 1e6);
      all += row.back();
    }
    row.push_back(all);
    for (std::size_t i = 0; i < row.size(); ++i) sums[i] += row[i];
    if (all > 0) add_row(stage_names[k], row);
  }
  add_row("all", sums);
  const double shade = f.stage_ms[static_cast<std::size_t>(Stage::shade)] * f.ticks_per_ms;
  if (f.fragments != 0)
    text += fmt::format("  {} fragments: {:.0f} cycles each, {:.0f} of them to shade it\n", grouped(f.fragments),
                        everything / static_cast<double>(f.fragments), shade / static_cast<double>(f.fragments));
  std::fputs(text.c_str(), stderr);
}

void write_trace(const std::string& path, const RunReport& r) {
  const FrameStatistics& f = r.frame;
  const TraceClock clock(r);
  const std::uint32_t columns = static_cast<std::uint32_t>((r.width + tile_size - 1) / tile_size);
  OutputFile file(path);
  std::string text =
      "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n"
      R"({"ph":"M","pid":1,"tid":0,"name":"process_name","args":{"name":"tessera"}})";
  const auto flush = [&](std::size_t limit) {
    if (text.size() < limit) return;
    file.write(text.data(), text.size());
    text.clear();
  };
  const auto event = [&](const char* name, const char* category, std::size_t thread, std::uint64_t begin,
                         std::uint64_t end, const std::string& arguments) {
    text += fmt::format(
        ",\n{{\"ph\":\"X\",\"pid\":1,\"tid\":{},\"name\":\"{}\",\"cat\":\"{}\",\"ts\":{:.3f},"
        "\"dur\":{:.3f},\"args\":{{{}}}}}",
        thread, name, category, clock.us(begin), clock.us(end) - clock.us(begin), arguments);
    flush(std::size_t{1} << 20);
  };
  const auto thread_name = [&](std::size_t thread, const std::string& name) {
    text += fmt::format(
        ",\n{{\"ph\":\"M\",\"pid\":1,\"tid\":{},\"name\":\"thread_name\",\"args\":{{\"name\":\"{}\"}}}}", thread, name);
  };
  thread_name(0, "run");
  for (const RunPhase& phase : r.phases) event(phase.name, "run", 0, phase.begin, phase.end, "");
  for (std::size_t t = 0; t < f.profile.size(); ++t) {
    thread_name(t + 1, fmt::format("thread {}", t));
    for (const StageEvent& e : f.profile[t].events) {
      const bool tile = static_cast<int>(e.stage) >= first_tile_stage;
      event(stage_names[static_cast<std::size_t>(e.stage)], tile ? "tile" : "geometry", t + 1, e.begin, e.end,
            tile ? fmt::format("\"x\":{},\"y\":{}", e.item % columns * tile_size, e.item / columns * tile_size)
                 : fmt::format("\"piece\":{}", e.item));
    }
  }
  text += "\n]}\n";
  flush(0);
  file.commit();
}

}  // namespace tessera::cli
