// Output that appears whole or not at all.
#pragma once
#include <cstdio>
#include <string>

#include "base/interrupt.hpp"

namespace tessera {

/// A file under construction: written beside its target and renamed over it by commit(); removed if that is never
/// reached. Targets that cannot be replaced by a rename ("-" for standard output, devices, pipes) get a copy at
/// commit(). All failures throw Error(output) that names the target and the reason.
class OutputFile {
 public:
  explicit OutputFile(const std::string& target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  [[nodiscard]] std::FILE* stream() const { return file_; }
  /// Where the bytes are until commit(), for libraries that insist on a path.
  [[nodiscard]] const std::string& path() const { return temporary_; }
  /// The target as messages should call it.
  [[nodiscard]] const std::string& name() const { return name_; }
  void write(const void* data, std::size_t size);
  void commit();

 private:
  void copy_to_target();

  std::string target_, name_, temporary_;
  FileGuard guard_;    // of the temporary
  bool copy_ = false;  // commit by copying
  std::FILE* file_ = nullptr;
};

}  // namespace tessera
