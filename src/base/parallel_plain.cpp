// parallel.hpp over plain threads, in place of parallel.cpp (CMake: TESSERA_PLAIN_THREADS). ThreadSanitizer cannot see
// how oneTBB, which Debian builds without it, orders one thread's work before another's, and takes every hand-over for
// a race; here it sees all. Slow, for threads are started for each loop.
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "base/parallel.hpp"
#include "base/stream_copy.hpp"

namespace tessera {
namespace {

thread_local int arena_threads = 0;  // 0: outside run_with_threads, as many as there are cores
thread_local int arena_index = 0;
thread_local bool inside_loop = false;

int cores() {
  const unsigned count = std::thread::hardware_concurrency();
  return count == 0 ? 1 : int(count);
}

}  // namespace

void parallel_detail::run_with_threads(int threads, void (*work)(const void*), const void* context) {
  const int before = arena_threads;
  arena_threads = threads > 0 ? threads : cores();
  try {
    work(context);
  } catch (...) {
    arena_threads = before;
    throw;
  }
  arena_threads = before;
}

void parallel_detail::loop(std::size_t count, void (*body)(const void*, std::size_t), const void* context) {
  if (inside_loop) {  // a loop within a loop stays on its thread
    for (std::size_t i = 0; i < count; ++i) body(context, i);
    return;
  }
  const int threads = thread_count();
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_lock;
  const auto work = [&](int index) {
    arena_threads = threads;
    arena_index = index;
    inside_loop = true;
    try {
      for (std::size_t i = next++; i < count; i = next++) body(context, i);
      end_streaming();
    } catch (...) {
      const std::lock_guard lock(failure_lock);
      if (!failure) failure = std::current_exception();
      next = count;
    }
    inside_loop = false;
  };
  const int before = arena_threads;
  std::vector<std::thread> others;
  others.reserve(std::size_t(threads));
  for (int t = 1; t < threads && std::size_t(t) < count; ++t) others.emplace_back(work, t);
  work(0);
  for (std::thread& thread : others) thread.join();
  arena_threads = before;
  if (failure) std::rethrow_exception(failure);
}

int thread_count() { return arena_threads > 0 ? arena_threads : cores(); }
int thread_index() { return arena_index; }

}  // namespace tessera
