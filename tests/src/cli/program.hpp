// Runs the program as a person would, and makes the files to run it on.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace tessera::cli_test {

struct Result {
  int status = -1;  // exit status; 128 + n if signal n ended it
  std::string out, err;
};

/// tessera ARGUMENTS, waited for.
Result run(const std::vector<std::string>& arguments);

/// Starts it, sends `signal` once `ready` holds (or after ten seconds), and waits.
Result interrupt(const std::vector<std::string>& arguments, int signal, bool (*ready)(const std::filesystem::path&),
                 const std::filesystem::path& watched);

/// A folder of its own for a test, removed with everything in it.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::string path(const std::string& name) const { return (path_ / name).string(); }
  [[nodiscard]] const std::filesystem::path& get() const { return path_; }
  /// Names of what is in it, sorted.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& content);

/// A square in the plane z = 0 from (-1, -1) to (1, 1), facing +Z, called "square"; base colour (1, 0.5, 0.25), rough
/// and not metallic; a camera "front" at (0, 0, 3). extra: members added to the root object, such as lights.
std::string square_gltf(const std::string& extra = {}, const std::string& material_extra = {});

}  // namespace tessera::cli_test
