// Copies for memory that is written once and read much later: past the caches, which keep what is in use.
#pragma once
#include <cstddef>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace tessera {

/// Copies `bytes`, a multiple of 16, between places on multiples of 16 that do not overlap. What is written is visible
/// to other threads that this one releases to afterwards, as after memcpy().
inline void stream_copy(void* to, const void* from, std::size_t bytes) {
#ifdef __SSE2__
  auto* out = static_cast<__m128i*>(to);
  const auto* in = static_cast<const __m128i*>(from);
  for (std::size_t i = 0; i < bytes / 16; ++i) _mm_stream_si128(out + i, _mm_load_si128(in + i));
  _mm_sfence();
#else
  std::memcpy(to, from, bytes);
#endif
}

}  // namespace tessera
