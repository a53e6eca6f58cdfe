// What must not be left behind when a signal ends the program.
#pragma once
#include <string>

namespace tessera {

/// From here on SIGINT, SIGTERM and SIGHUP remove the guarded files before they end the program as usual.
void remove_guarded_files_on_signals();

/// Guards a file's name while it lives: an unfinished file that a signal should remove.
class FileGuard {
 public:
  FileGuard() = default;
  explicit FileGuard(const std::string& path);
  FileGuard(FileGuard&& other) noexcept : slot_(other.slot_) { other.slot_ = -1; }
  FileGuard& operator=(FileGuard&& other) noexcept;
  ~FileGuard() { release(); }
  /// The file is finished, or gone.
  void release();

 private:
  int slot_ = -1;
};

}  // namespace tessera
