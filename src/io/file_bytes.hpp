// Whole input files in memory.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tessera {

/// The bytes of a regular file of at most `limit` bytes. Throws Error(input) that names the file and the reason.
std::vector<std::byte> read_file(const std::string& path, std::uint64_t limit = std::uint64_t{16} << 30);

}  // namespace tessera
