// What the subjects of kernel_hash share: pseudo-random numbers and the hash.
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

#include "kernels/interface.hpp"

namespace tessera {

// splitmix64: the same numbers with every standard library.
class Random {
 public:
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
  }
  float unit() { return static_cast<float>(next() >> 40) * 0x1p-24f; }
  float between(float low, float high) { return low + (high - low) * unit(); }
  float any_bits() { return std::bit_cast<float>(static_cast<std::uint32_t>(next())); }
  std::vector<float> units(std::size_t count, float low = 0, float high = 1) {
    std::vector<float> out(count);
    for (float& x : out) x = between(low, high);
    return out;
  }

 private:
  std::uint64_t state_ = 1;
};

// FNV-1a over 32-bit words; one NaN for all.
class Hash {
 public:
  void add(std::uint32_t word) { value_ = (value_ ^ word) * 0x100000001b3u; }
  void add(float x) { add(x != x ? 0x7fc00000u : std::bit_cast<std::uint32_t>(x)); }
  template <class T>
  void add(const std::vector<T>& values) {
    for (const T& x : values) add(x);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

// One pixel plane per component, as a GBufferView wants them: on 64-byte boundaries, padded.
class GBuffer {
 public:
  static constexpr std::size_t count = 997, capacity = 1024;
  static_assert(capacity % max_lanes == 0);
  struct alignas(64) Plane {
    float values[capacity];
  };
  std::vector<Plane> planes{gbuffer_planes};

  GBufferView view() {
    std::size_t next = 0;
    const auto plane = [&] { return planes[next++].values; };
    GBufferView v{};
    for (float*& p : v.position) p = plane();
    for (float*& p : v.normal) p = plane();
    for (float*& p : v.base_color) p = plane();
    v.metallic = plane();
    v.roughness = plane();
    v.occlusion = plane();
    for (float*& p : v.emissive) p = plane();
    v.alpha = plane();
    v.unlit = plane();
    v.depth = plane();
    return v;
  }
};

void hash_raster(const Kernels&, Random&, Hash&);       // kernel_hash_raster.cpp
void hash_shade(const Kernels&, Random&, Hash&);        // kernel_hash_shade.cpp
void hash_environment(const Kernels&, Random&, Hash&);  // kernel_hash_shade.cpp

}  // namespace tessera
