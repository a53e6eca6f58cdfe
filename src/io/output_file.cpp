#include "io/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "base/error.hpp"

namespace tessera {
namespace fs = std::filesystem;

namespace {
Error cannot_write(const std::string& name, int error) {
  return output_error("{}: cannot be written: {}", name, std::strerror(error));
}
}  // namespace

OutputFile::OutputFile(const std::string& target) : target_(target), name_(target == "-" ? "standard output" : target) {
  if (target.empty()) throw output_error("the output file has no name");
  std::error_code error;
  fs::path folder;
  fs::path leaf = "output";
  if (target == "-") {
    copy_ = true;
  } else {
    // Follow a symbolic link, so that the rename replaces the file and not the link.
    const fs::path resolved = fs::weakly_canonical(target, error);
    if (!error) target_ = resolved.string();
    const fs::file_status status = fs::status(target_, error);
    if (fs::is_directory(status)) throw output_error("{}: is a directory", name_);
    copy_ = fs::exists(status) && !fs::is_regular_file(status);
    folder = fs::path(target_).parent_path();
    leaf = fs::path(target_).filename();
  }
  if (copy_) {
    folder = fs::temp_directory_path(error);
    leaf = "output";
  }
  if (folder.empty()) folder = ".";

  static std::atomic<unsigned> counter{0};
  for (int attempt = 0; attempt < 100; ++attempt) {
    // File names have a length limit; the target's may already be at it.
    const std::string name =
        fmt::format(".{}.tessera-{}-{}", leaf.string().substr(0, 100), ::getpid(), counter.fetch_add(1));
    temporary_ = (folder / name).string();
    guard_ = FileGuard(temporary_);
    const int descriptor = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      file_ = ::fdopen(descriptor, "w+b");
      if (file_ == nullptr) ::close(descriptor);
      break;
    }
    if (errno != EEXIST) break;
  }
  if (file_ == nullptr) {
    const int reason = errno;
    temporary_.clear();
    guard_.release();
    throw cannot_write(name_, reason);
  }
}

OutputFile::~OutputFile() {
  if (file_ != nullptr) std::fclose(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::write(const void* data, std::size_t size) {
  if (std::fwrite(data, 1, size, file_) != size) throw cannot_write(name_, errno);
}

void OutputFile::copy_to_target() {
  const int out = target_ == "-" ? ::dup(STDOUT_FILENO) : ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
  if (out < 0) throw cannot_write(name_, errno);
  std::rewind(file_);
  std::vector<char> block(1 << 16);
  int reason = 0;
  while (reason == 0) {
    const std::size_t got = std::fread(block.data(), 1, block.size(), file_);
    if (got == 0) break;
    for (std::size_t done = 0; done < got && reason == 0;) {
      const ssize_t n = ::write(out, block.data() + done, got - done);
      if (n >= 0) {
        done += std::size_t(n);
      } else if (errno != EINTR) {
        reason = errno;
      }
    }
  }
  if (std::ferror(file_) != 0 && reason == 0) reason = EIO;
  if (::close(out) != 0 && reason == 0) reason = errno;
  if (reason != 0) throw cannot_write(name_, reason);
}

void OutputFile::commit() {
  if (std::fflush(file_) != 0) throw cannot_write(name_, errno);
  if (copy_) {
    copy_to_target();
    return;
  }
  std::FILE* const file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0) throw cannot_write(name_, errno);
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) throw cannot_write(name_, errno);
  temporary_.clear();
  guard_.release();
}

}  // namespace tessera
