#include "base/large_buffer.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace tessera {

LargeBuffer::LargeBuffer(std::size_t count) {
  constexpr std::size_t huge_page = std::size_t{1} << 21;
  const std::size_t bytes = (count * sizeof(float) / huge_page + 1) * huge_page;
  auto* memory = static_cast<float*>(std::aligned_alloc(huge_page, bytes));
  if (memory == nullptr) throw std::bad_alloc();
  madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: without it the pages are small and all else is the same
  std::fill_n(memory, count, 0.0f);
  data_.reset(memory);
}

void LargeBuffer::Free::operator()(float* p) const { std::free(p); }

}  // namespace tessera
