#include "bench/workload/bulk_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.hpp"

namespace tessera::workload {

BulkFile::BulkFile(std::string path, std::size_t record_bytes)
    : path_(std::move(path)), record_bytes_(record_bytes), descriptor_(open(path_.c_str(), O_RDONLY | O_CLOEXEC)) {
  struct stat status {};
  if (descriptor_ < 0 || fstat(descriptor_, &status) != 0) throw input_error("{}: cannot be opened", path_);
  const auto bytes = static_cast<std::size_t>(status.st_size);
  if (bytes % record_bytes != 0)
    throw input_error("{}: {} bytes are not whole records of {}", path_, bytes, record_bytes);
  records_ = bytes / record_bytes;
}

BulkFile::~BulkFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

void BulkFile::read(std::size_t first, std::size_t count, void* out) const {
  auto* at = static_cast<char*>(out);
  std::size_t offset = first * record_bytes_, left = count * record_bytes_;
  while (left != 0) {
    const ssize_t got = pread(descriptor_, at, left, static_cast<off_t>(offset));
    if (got <= 0) throw input_error("{}: cannot be read", path_);
    at += got;
    offset += static_cast<std::size_t>(got);
    left -= static_cast<std::size_t>(got);
  }
}

}  // namespace tessera::workload
