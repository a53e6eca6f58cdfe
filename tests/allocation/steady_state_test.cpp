// Frame after frame, nothing is allocated. A program of its own, for it replaces the global operator new.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "base/parallel.hpp"
#include "frame/dispatch.hpp"
#include "frame/frame.hpp"
#include "golden/scenes.hpp"
#include "precompute/environment.hpp"

namespace {

std::atomic<std::size_t> allocations{0}, live_bytes{0}, peak_bytes{0};

void* allocate(std::size_t size, std::size_t alignment) {
  ++allocations;
  void* p = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (p == nullptr) throw std::bad_alloc();
  const std::size_t live = live_bytes += malloc_usable_size(p);
  for (std::size_t peak = peak_bytes; live > peak && !peak_bytes.compare_exchange_weak(peak, live);) {
  }
  return p;
}

void release(void* p) {
  if (p != nullptr) live_bytes -= malloc_usable_size(p);
  std::free(p);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* p) noexcept { release(p); }
void operator delete(void* p, std::size_t) noexcept { release(p); }
void operator delete(void* p, std::align_val_t) noexcept { release(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { release(p); }

namespace tessera {
namespace {

std::size_t allocations_of(const std::function<void()>& work) {
  const std::size_t before = allocations;
  work();
  return allocations - before;
}

// What oneTBB takes for an arena of threads, frame or no frame.
std::size_t allocations_of_threads(int threads) {
  const auto start = [=] { run_with_threads(threads, [] { parallel_for(64, [](std::size_t) {}); }); };
  for (int warm = 0; warm < 8; ++warm) start();
  std::size_t most = 0;
  for (int round = 0; round < 8; ++round) most = std::max(most, allocations_of(start));
  return most;
}

TEST(SteadyState, FramesAllocateNothing) {
  for (golden::GoldenScene& g : golden::golden_scenes()) {
    const Kernels& kernels = select_kernels();
    const Environment environment = build_environment(golden::golden_environment(), {}, kernels);
    Renderer renderer(g.scene, g.environment ? &environment : nullptr, kernels);
    const View view = make_view(g.camera, g.settings.width, g.settings.height, kernels);
    for (const int threads : {1, 2}) {
      g.settings.threads = threads;
      Frame frame;
      const auto render = [&] { renderer.render(view, g.settings, {}, frame); };
      // Which thread meets which tile differs from frame to frame; after a while each has met the largest.
      for (int warm = 0; warm < 20; ++warm) render();
      std::size_t least = ~std::size_t{0};
      for (int round = 0; round < 5; ++round) least = std::min(least, allocations_of(render));
      EXPECT_LE(least, allocations_of_threads(threads)) << g.name << " on " << threads << " threads";
    }
  }
}

// Scene and film are there before; vertices, set-up, bins and tiles are what a frame adds.
TEST(Memory, AFrameOf3840x2160TakesLessThan64MiB) {
  const Kernels& kernels = select_kernels();
  const Environment environment = build_environment(golden::golden_environment(), {}, kernels);
  for (golden::GoldenScene& g : golden::golden_scenes()) {
    g.settings.width = 3840;
    g.settings.height = 2160;
    g.settings.threads = 2;
    Renderer renderer(g.scene, g.environment ? &environment : nullptr, kernels);
    const View view = make_view(g.camera, g.settings.width, g.settings.height, kernels);
    Frame frame;
    frame.rgba = Image(g.settings.width, g.settings.height, 4);
    const std::size_t before = live_bytes;
    peak_bytes = before;
    renderer.render(view, g.settings, {}, frame);
    EXPECT_LT(peak_bytes - before, std::size_t{64} << 20) << g.name;
    EXPECT_LT(frame.statistics.working_bytes, std::size_t{64} << 20) << g.name;
  }
}

TEST(SteadyState, TheCounterCounts) {
  EXPECT_EQ(allocations_of([] { delete new int(1); }), 1u);
}

}  // namespace
}  // namespace tessera
