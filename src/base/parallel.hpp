// Loops over oneTBB. Which thread does what never shows in a result: bodies write only to their own index's memory.
#pragma once
#include <cstddef>

namespace tessera {

namespace parallel_detail {
void run_with_threads(int threads, void (*work)(const void*), const void* context);
void loop(std::size_t count, void (*body)(const void*, std::size_t), const void* context);
}  // namespace parallel_detail

/// Runs work inside an arena of `threads` threads (0: all cores); loops started by it use those.
template <class Work>
void run_with_threads(int threads, const Work& work) {
  parallel_detail::run_with_threads(
      threads, [](const void* w) { (*static_cast<const Work*>(w))(); }, &work);
}

/// body(i) for i in [0, count), in any order, on any thread. Each body runs with the default floating-point environment
/// (round to nearest, denormals kept), whatever a shared library did to the process. What bodies have stored, past the
/// caches too, is there for all after the loop.
template <class Body>
void parallel_for(std::size_t count, const Body& body) {
  parallel_detail::loop(
      count, [](const void* b, std::size_t i) { (*static_cast<const Body*>(b))(i); }, &body);
}

/// Number of threads that loops started here may use; and the calling one's index below that number.
int thread_count();
int thread_index();

}  // namespace tessera
