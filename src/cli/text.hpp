// Words for a person: results on standard output, notes on standard error.
#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace tessera::cli {

/// The only way to standard output; throws Error(output) if it cannot be written.
void print(std::string_view text);

/// "tessera: warning: ..." on standard error, on one line.
void warn(std::string_view message);

/// "tessera: ..." on standard error, on one line.
void note(std::string_view message);

/// 75730 -> "75,730"
std::string grouped(std::uint64_t value);

/// text, with what would break a line or steer a terminal replaced: names come from files.
std::string printable(std::string_view text);

}  // namespace tessera::cli
