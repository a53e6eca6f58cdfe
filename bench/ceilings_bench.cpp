// What this machine can do at best, for docs/performance.md: arithmetic by instruction, loads by working set, streams.
// Time per operation on one thread; Threads(2) for what two cores share. x86-64 with AVX-512 or AVX2; elsewhere
// nothing.
#include <benchmark/benchmark.h>

#if defined(__x86_64__)
#include <immintrin.h>

#include <random>
#include <vector>

#include "base/aligned.hpp"

namespace {

using namespace tessera;

#define AVX512 __attribute__((target("avx512f")))
#define AVX2 __attribute__((target("avx2,fma")))

// `step` on eight independent chains, enough to hide a latency of four cycles on two ports. The barriers keep the
// compiler from seeing through it.
#define STEP(v, step)           \
  {                             \
    auto& x = v;                \
    x = step;                   \
    asm volatile("" : "+v"(x)); \
  }
#define CEILING(name, target, Vector, splat, step)                                                        \
  target void name(benchmark::State& state) {                                                             \
    Vector a = splat(1.25f), b = a, c = a, d = a, e = a, f = a, g = a, h = a;                             \
    const Vector one = splat(1.0f), half = splat(0.5f);                                                   \
    for (auto _ : state)                                                                                  \
      for (int round = 0; round < 8; ++round) {                                                           \
        STEP(a, step)                                                                                     \
        STEP(b, step) STEP(c, step) STEP(d, step) STEP(e, step) STEP(f, step) STEP(g, step) STEP(h, step) \
      }                                                                                                   \
    asm volatile("" ::"v"(a), "v"(b), "v"(c), "v"(d), "v"(e), "v"(f), "v"(g), "v"(h));                    \
    asm volatile("" ::"v"(one), "v"(half));                                                               \
    state.SetItemsProcessed(state.iterations() * 64);                                                     \
  }

CEILING(fma_avx512, AVX512, __m512, _mm512_set1_ps, _mm512_fmadd_ps(x, half, one))
CEILING(divide_avx512, AVX512, __m512, _mm512_set1_ps, _mm512_div_ps(one, x))
CEILING(root_avx512, AVX512, __m512, _mm512_set1_ps, _mm512_maskz_sqrt_ps(0xffff, x))
CEILING(fma_avx2, AVX2, __m256, _mm256_set1_ps, _mm256_fmadd_ps(x, half, one))
CEILING(divide_avx2, AVX2, __m256, _mm256_set1_ps, _mm256_div_ps(one, x))
CEILING(root_avx2, AVX2, __m256, _mm256_set1_ps, _mm256_sqrt_ps(x))

// Sixteen bytes from random places of a working set, as a footprint's row is read; the places are known beforehand.
AVX2 void load_quads(benchmark::State& state) {
  const std::size_t bytes = std::size_t(state.range(0)) << 10;
  const std::vector<float> table(bytes / sizeof(float) + 4, 1.0f);
  std::vector<std::uint32_t> places(1 << 14);
  std::mt19937 random(1);
  for (std::uint32_t& p : places) p = std::uint32_t(random() % (bytes / 16)) * 4;
  __m128 sum[4] = {};
  for (auto _ : state)
    for (std::size_t i = 0; i < places.size(); i += 4)
      for (std::size_t k = 0; k < 4; ++k) sum[k] = _mm_add_ps(sum[k], _mm_loadu_ps(table.data() + places[i + k]));
  for (const __m128& s : sum) asm volatile("" ::"x"(s));
  state.SetItemsProcessed(state.iterations() * std::int64_t(places.size()));
}

// Streams of 256 MiB, shared by the threads: past every cache.
constexpr std::size_t stream_floats = std::size_t{64} << 20;
AlignedVector<float>& stream_buffer() {
  static AlignedVector<float> buffer(stream_floats);
  return buffer;
}
struct Part {
  std::size_t begin, end;
  explicit Part(const benchmark::State& state)
      : begin(stream_floats / std::size_t(state.threads()) * std::size_t(state.thread_index())),
        end(begin + stream_floats / std::size_t(state.threads())) {}
};

AVX2 void stream_read(benchmark::State& state) {
  const float* p = stream_buffer().data();
  const Part part(state);
  __m256 sum[4] = {};
  for (auto _ : state)
    for (std::size_t i = part.begin; i < part.end; i += 32)
      for (std::size_t k = 0; k < 4; ++k) sum[k] = _mm256_add_ps(sum[k], _mm256_load_ps(p + i + 8 * k));
  for (const __m256& s : sum) asm volatile("" ::"x"(s));
  state.SetBytesProcessed(state.iterations() * std::int64_t((part.end - part.begin) * sizeof(float)));
}

AVX2 void stream_write(benchmark::State& state) {
  float* p = stream_buffer().data();
  const Part part(state);
  const __m256 one = _mm256_set1_ps(1);
  for (auto _ : state) {
    for (std::size_t i = part.begin; i < part.end; i += 8) _mm256_stream_ps(p + i, one);
    _mm_sfence();
  }
  state.SetBytesProcessed(state.iterations() * std::int64_t((part.end - part.begin) * sizeof(float)));
}

void add_ceilings() {
  using Body = void (*)(benchmark::State&);
  const auto add = [](const char* name, Body body) { return benchmark::RegisterBenchmark(name, body); };
  if (__builtin_cpu_supports("avx512f")) {
    add("fma/avx512", fma_avx512);
    add("divide/avx512", divide_avx512);
    add("root/avx512", root_avx512);
  }
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return;
  add("fma/avx2", fma_avx2);
  add("divide/avx2", divide_avx2);
  add("root/avx2", root_avx2);
  for (const int kib : {16, 256, 4096, 65536}) add("load16/KiB", load_quads)->Arg(kib);
  for (const int threads : {1, 2}) {
    add("stream_read", stream_read)->Threads(threads)->UseRealTime();
    add("stream_write", stream_write)->Threads(threads)->UseRealTime();
  }
}

}  // namespace

int main(int argc, char** argv) {
  add_ceilings();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

#else
BENCHMARK_MAIN();
#endif
