// Memory of many megabytes that is streamed through: on huge pages where the system has them, so that a walk over it
// does not miss the TLB at every page.
#pragma once
#include <cstddef>
#include <memory>

namespace tessera {

class LargeBuffer {
 public:
  LargeBuffer() = default;
  /// `count` floats, zero, on a 2 MiB boundary. Throws std::bad_alloc.
  explicit LargeBuffer(std::size_t count);
  [[nodiscard]] float* data() const { return data_.get(); }

 private:
  struct Free {
    void operator()(float* p) const;
  };
  std::unique_ptr<float[], Free> data_;
};

}  // namespace tessera
