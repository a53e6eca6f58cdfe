#include "bench/chart/machine.hpp"

#include <fmt/chrono.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>

#include "tessera_chart_flags.hpp"
#include "tessera_commit.hpp"

namespace tessera::chart {
namespace {

constexpr const char* unknown = "unknown";

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    // x86 says "model name"; some ARM systems say "Model" or "Hardware" at the end.
    if (line.rfind("model name", 0) != 0 && line.rfind("Model", 0) != 0 && line.rfind("Hardware", 0) != 0) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos && colon + 2 < line.size()) return line.substr(colon + 2);
  }
  return unknown;
}

std::string compiler_name() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return unknown;
#endif
}

constexpr int chain = 20000, additions = 10;

// Register to register: recent CPUs do additions of constants while renaming, at no time at all.
void add_in_a_chain() {
#if defined(__x86_64__)
  long sum = 1, step = 3;
  for (int i = 0; i < chain; ++i)
    asm volatile(
        "add %1, %0\n add %1, %0\n add %1, %0\n add %1, %0\n add %1, %0\n"
        "add %1, %0\n add %1, %0\n add %1, %0\n add %1, %0\n add %1, %0\n"
        : "+r"(sum)
        : "r"(step));
#elif defined(__aarch64__)
  long sum = 1, step = 3;
  for (int i = 0; i < chain; ++i)
    asm volatile(
        "add %0, %0, %1\n add %0, %0, %1\n add %0, %0, %1\n add %0, %0, %1\n add %0, %0, %1\n"
        "add %0, %0, %1\n add %0, %0, %1\n add %0, %0, %1\n add %0, %0, %1\n add %0, %0, %1\n"
        : "+r"(sum)
        : "r"(step));
#endif
}

}  // namespace

double measure_clock_ghz() {
#if defined(__x86_64__) || defined(__aarch64__)
  using Clock = std::chrono::steady_clock;
  double best_ns = 1e300;
  // The shortest of many: whatever interrupts only adds time.
  for (int i = 0; i < 100; ++i) {
    const Clock::time_point start = Clock::now();
    add_in_a_chain();
    best_ns = std::min(best_ns, std::chrono::duration<double, std::nano>(Clock::now() - start).count());
  }
  return double{chain} * additions / best_ns;
#else
  return 0;
#endif
}

Machine describe_machine() {
  Machine machine;
  machine.cpu = cpu_name();
  machine.compiler = compiler_name();
  machine.flags = TESSERA_CHART_FLAGS;
  machine.commit = TESSERA_COMMIT;
  machine.version = TESSERA_VERSION;
  machine.date = fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)));
  machine.clock_ghz = measure_clock_ghz();
  return machine;
}

}  // namespace tessera::chart
