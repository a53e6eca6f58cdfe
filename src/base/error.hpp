// Errors that a person caused or can mend. Broken invariants are asserts, not errors.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace tessera {

/// The program's exit status for each kind of failure.
enum class ExitStatus { ok = 0, difference = 1, usage = 2, input = 3, output = 4 };

/// One clear line: which file, which part, what was found, what was expected.
class Error : public std::runtime_error {
 public:
  Error(ExitStatus status, const std::string& message) : std::runtime_error(message), status_(status) {}
  [[nodiscard]] ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

template <class... Args>
[[nodiscard]] Error usage_error(fmt::format_string<Args...> format, Args&&... args) {
  return {ExitStatus::usage, fmt::format(format, std::forward<Args>(args)...)};
}
template <class... Args>
[[nodiscard]] Error input_error(fmt::format_string<Args...> format, Args&&... args) {
  return {ExitStatus::input, fmt::format(format, std::forward<Args>(args)...)};
}
template <class... Args>
[[nodiscard]] Error output_error(fmt::format_string<Args...> format, Args&&... args) {
  return {ExitStatus::output, fmt::format(format, std::forward<Args>(args)...)};
}

}  // namespace tessera
