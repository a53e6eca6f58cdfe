// Where a frame's time went: a table for a person (--profile), and a file for a trace viewer (--trace).
#pragma once
#include <string>

#include "cli/machine.hpp"
#include "cli/report.hpp"

namespace tessera::cli {

/// Before the work begins: whether the files that the options name can be written. Throws Error(usage), Error(output).
void check_machine_outputs(const MachineOptions& options, const std::string& picture_path);

/// At the end: everything that the options ask for.
void report_to(const MachineOptions& options, const RunReport& report);

/// Cycles of each thread by stage, on standard error.
void tell_profile(const RunReport& report);

/// Trace Event Format, which chrome://tracing, Perfetto and others read: a row per thread, an event per stage of a
/// tile. Throws Error(output).
void write_trace(const std::string& path, const RunReport& report);

}  // namespace tessera::cli
