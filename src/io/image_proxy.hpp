// OpenImageIO's input and output over memory and over files under construction.
#pragma once
#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <span>

#include "io/output_file.hpp"

namespace tessera {

/// Bytes in memory as a file. OpenImageIO's own reader (2.4) copies out of bounds after a seek past the end; its JPEG
/// plugin insists on that type, so this derives from it and replaces the access.
class MemoryReader : public OIIO::Filesystem::IOMemReader {
 public:
  explicit MemoryReader(std::span<const std::byte> bytes) : IOMemReader(bytes.data(), bytes.size()), bytes_(bytes) {}
  bool seek(int64_t offset) override {
    m_pos = std::clamp<int64_t>(offset, 0, int64_t(bytes_.size()));
    return offset == m_pos;
  }
  size_t read(void* buffer, size_t size) override {
    const size_t got = pread(buffer, size, m_pos);
    m_pos += int64_t(got);
    return got;
  }
  size_t pread(void* buffer, size_t size, int64_t offset) override {
    if (offset < 0 || size_t(offset) >= bytes_.size() || size == 0) return 0;
    const size_t got = std::min(size, bytes_.size() - size_t(offset));
    std::memcpy(buffer, bytes_.data() + offset, got);
    return got;
  }
  size_t size() const override { return bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
};

/// An OutputFile as OpenImageIO writes it; remembers the first failure, which some encoders pass over in silence.
class OutputProxy : public OIIO::Filesystem::IOProxy {
 public:
  explicit OutputProxy(OutputFile& file) : IOProxy("", Write), file_(file.stream()) {}
  const char* proxytype() const override { return "output"; }
  bool seek(int64_t offset) override {
    m_pos = offset;
    return note(fseeko(file_, offset, SEEK_SET) == 0);
  }
  size_t write(const void* data, size_t size) override {
    const size_t done = std::fwrite(data, 1, size, file_);
    m_pos += int64_t(done);
    note(done == size);
    return done;
  }
  size_t pwrite(const void* data, size_t size, int64_t offset) override {
    const std::lock_guard lock(mutex_);
    const int64_t back = m_pos;
    seek(offset);
    const size_t done = write(data, size);
    seek(back);
    return done;
  }
  void flush() const override { std::fflush(file_); }
  /// errno of the first failure, or 0.
  int failure() const { return failure_; }

 private:
  bool note(bool good) {
    if (!good && failure_ == 0) failure_ = errno != 0 ? errno : EIO;
    return good;
  }
  std::FILE* file_;
  std::mutex mutex_;
  int failure_ = 0;
};

}  // namespace tessera
