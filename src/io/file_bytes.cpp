#include "io/file_bytes.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>

#include "base/error.hpp"

namespace tessera {

std::vector<std::byte> read_file(const std::string& path, std::uint64_t limit) {
  namespace fs = std::filesystem;
  if (path.find('\0') != std::string::npos) throw input_error("{}: not a file name", path.c_str());
  std::error_code status_error;
  const fs::file_status status = fs::status(path, status_error);
  if (status.type() == fs::file_type::not_found) throw input_error("{}: no such file", path);
  if (status.type() == fs::file_type::directory) throw input_error("{}: is a directory, expected a file", path);
  if (status_error) throw input_error("{}: cannot be opened: {}", path, status_error.message());

  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw input_error("{}: cannot be opened: {}", path, std::strerror(errno));

  std::vector<std::byte> bytes;
  try {
    // Pipes have no size: grow as the data come, starting from the size that a regular file states.
    std::error_code size_error;
    const std::uintmax_t stated = fs::is_regular_file(status) ? fs::file_size(path, size_error) : 0;
    if (!size_error && stated > limit) {
      throw input_error("{}: {} bytes long, expected at most {}", path, stated, limit);
    }
    bytes.resize(size_error ? 0 : std::size_t(stated) + 1);
    std::size_t used = 0;
    for (;;) {
      if (used == bytes.size()) bytes.resize(used + used / 2 + 65536);
      const std::size_t got = std::fread(bytes.data() + used, 1, bytes.size() - used, file.get());
      used += got;
      if (used > limit) throw input_error("{}: longer than {} bytes", path, limit);
      if (got == 0) break;
    }
    if (std::ferror(file.get()) != 0) throw input_error("{}: cannot be read: {}", path, std::strerror(errno));
    bytes.resize(used);
  } catch (const std::bad_alloc&) {
    throw input_error("{}: too large for this machine's memory", path);
  }
  return bytes;
}

}  // namespace tessera
