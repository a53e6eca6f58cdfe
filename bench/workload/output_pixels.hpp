// A raw picture on its way into a file.
#pragma once
#include <cstddef>
#include <string>

namespace tessera::workload {

class OutputPixels {
 public:
  /// Of `pixels` RGBA floats; an output error if the file cannot be created. What it holds before is not defined.
  OutputPixels(std::string path, std::size_t pixels);
  ~OutputPixels();
  OutputPixels(const OutputPixels&) = delete;
  OutputPixels& operator=(const OutputPixels&) = delete;

  [[nodiscard]] float* rgba() const { return rgba_; }
  /// Writes everything, on all threads.
  void finish();

 private:
  std::string path_;
  std::size_t bytes_;
  int descriptor_;
  float* rgba_;
};

}  // namespace tessera::workload
