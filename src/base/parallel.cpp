#include "base/parallel.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include <cfenv>
#include <memory>

#include "base/stream_copy.hpp"

namespace tessera {
namespace {

// Whether the vector unit rounds, traps and keeps denormals as it does by default. The C library's functions take a
// tenth of a microsecond, as they ask the old floating-point unit too, which nothing here uses.
bool is_default_environment() {
#ifdef __SSE2__
  constexpr unsigned flags = 0x3f, defaults = 0x1f80;
  return (_mm_getcsr() & ~flags) == defaults;
#else
  return false;
#endif
}

// FE_DFL_ENV also clears flush-to-zero and denormals-are-zero, which a shared library linked with -ffast-math sets.
class DefaultFloatEnvironment {
 public:
  DefaultFloatEnvironment() : changed_(!is_default_environment()) {
    if (!changed_) return;
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatEnvironment() {
    if (changed_) std::fesetenv(&saved_);
  }
  DefaultFloatEnvironment(const DefaultFloatEnvironment&) = delete;
  DefaultFloatEnvironment& operator=(const DefaultFloatEnvironment&) = delete;

 private:
  bool changed_;
  std::fenv_t saved_{};
};

}  // namespace

void parallel_detail::run_with_threads(int threads, void (*work)(const void*), const void* context) {
  const int count = threads > 0 ? threads : tbb::info::default_concurrency();
  // More threads than cores only happen when asked for (tests of determinism): the global limit must allow them.
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count));
  tbb::task_arena arena(count);
  arena.execute([&] {
    const DefaultFloatEnvironment environment;
    work(context);
  });
}

void parallel_detail::loop(std::size_t count, void (*body)(const void*, std::size_t), const void* context) {
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        const DefaultFloatEnvironment environment;
        for (std::size_t i = range.begin(); i != range.end(); ++i) body(context, i);
        end_streaming();
      },
      tbb::simple_partitioner());
}

int thread_count() { return tbb::this_task_arena::max_concurrency(); }
int thread_index() { return tbb::this_task_arena::current_thread_index(); }

}  // namespace tessera
