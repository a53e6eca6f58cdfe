// Copies for memory that is written once and read much later: past the caches, which keep what is in use.
#pragma once
#include <cstddef>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace tessera {

/// Stores past the caches are not ordered with others: before this, a thread that this one releases to may not see
/// them. It waits for them to arrive, so it is for the end of a piece of work; parallel_for() calls it behind every
/// body.
inline void end_streaming() {
#ifdef __SSE2__
  _mm_sfence();
#endif
}

/// Copies `bytes`, a multiple of 16, between places on multiples of 16 that do not overlap. Other threads see it after
/// end_streaming().
inline void stream_copy(void* to, const void* from, std::size_t bytes) {
#ifdef __SSE2__
  auto* out = static_cast<__m128i*>(to);
  const auto* in = static_cast<const __m128i*>(from);
  for (std::size_t i = 0; i < bytes / 16; ++i) _mm_stream_si128(out + i, _mm_load_si128(in + i));
#else
  std::memcpy(to, from, bytes);
#endif
}

}  // namespace tessera
