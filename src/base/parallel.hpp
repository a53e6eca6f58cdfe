// Loops over oneTBB. Which thread does what never shows in a result: bodies write only to their own index's memory.
#pragma once
#include <cstddef>
#include <functional>

namespace tessera {

/// Runs work inside an arena of `threads` threads (0: all cores); loops started by it use those.
void run_with_threads(int threads, const std::function<void()>& work);

/// body(i) for i in [0, count), in any order, on any thread. Each body runs with the default floating-point environment
/// (round to nearest, denormals kept), whatever a shared library did to the process.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Number of threads that loops started here may use; and the calling one's index below that number.
int thread_count();
int thread_index();

}  // namespace tessera
