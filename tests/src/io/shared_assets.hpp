// Test scenes and environments of other people, present on some machines only: a folder shared/assets beside the
// source tree or beside one of its parents.
#pragma once
#include <filesystem>

namespace tessera {

/// A path that does not exist where the assets are not there.
inline std::filesystem::path shared_assets() {
  for (const char* up : {"..", "../.."}) {
    std::filesystem::path folder = std::filesystem::path(TESSERA_SOURCE_DIR) / up / "shared" / "assets";
    if (std::filesystem::exists(folder)) return folder;
  }
  return "no-shared-assets";
}

}  // namespace tessera
