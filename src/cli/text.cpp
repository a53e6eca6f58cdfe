#include "cli/text.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/error.hpp"

namespace tessera::cli {

void print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw output_error("standard output: cannot be written: {}", std::strerror(errno));
}

void warn(std::string_view message) { std::fprintf(stderr, "tessera: warning: %s\n", printable(message).c_str()); }

void note(std::string_view message) { std::fprintf(stderr, "tessera: %s\n", printable(message).c_str()); }

std::string grouped(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
  return text;
}

std::string printable(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  return out;
}

}  // namespace tessera::cli
