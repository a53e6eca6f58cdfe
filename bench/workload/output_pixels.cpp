#include "bench/workload/output_pixels.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace tessera::workload {

OutputPixels::OutputPixels(std::string path, std::size_t pixels)
    : path_(std::move(path)),
      bytes_(pixels * 4 * sizeof(float)),
      descriptor_(open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0 || ftruncate(descriptor_, static_cast<off_t>(bytes_)) != 0)
    throw output_error("{}: cannot be written", path_);
  void* memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw output_error("{}: no memory for the picture", path_);
  madvise(memory, bytes_, MADV_HUGEPAGE);
  rgba_ = static_cast<float*>(memory);
}

OutputPixels::~OutputPixels() {
  munmap(rgba_, bytes_);
  if (descriptor_ >= 0) close(descriptor_);
}

void OutputPixels::finish() {
  constexpr std::size_t piece = std::size_t{1} << 20;
  const auto* bytes = reinterpret_cast<const char*>(rgba_);
  parallel_for((bytes_ + piece - 1) / piece, [&](std::size_t i) {
    for (std::size_t at = i * piece, end = std::min(at + piece, bytes_); at < end;) {
      const ssize_t written = pwrite(descriptor_, bytes + at, end - at, static_cast<off_t>(at));
      if (written <= 0) throw output_error("{}: cannot be written", path_);
      at += static_cast<std::size_t>(written);
    }
  });
}

}  // namespace tessera::workload
