// JSON of strangers, before a library parses it.
#pragma once
#include <string_view>

namespace tessera {

/// Whether brackets nest deeper than `limit`. Libraries copy and print values by recursion: nothing but brackets, some
/// ten thousand of them, ends the stack. For text that is no JSON: some answer.
inline bool nests_deeper(std::string_view json, int limit) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string && c == '\\')
      ++i;
    else if (c == '"')
      in_string = !in_string;
    else if (!in_string && (c == '[' || c == '{') && ++depth > limit)
      return true;
    else if (!in_string && (c == ']' || c == '}'))
      --depth;
  }
  return false;
}

}  // namespace tessera
