// Prints a hash of every kernel's output on pseudo-random input, one line per kernel, for each instruction set that
// this CPU runs: "isa kernel hash". All lines of a kernel must agree, here and on every other machine and compiler.
// Uses the kernels alone, so that it can be built for, and run as, another architecture.
//
// To add a kernel: a function that fills inputs from a Random, calls it, and adds what it wrote to a Hash; a row in
// `subjects`.
#include "guards/kernel_hash.hpp"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "kernels/runnable_kernels.hpp"
#include "kernels/sampling.hpp"
#include "kernels/terms.hpp"

namespace tessera {
namespace {

void hash_evaluate(const Kernels& kernels, Random& random, Hash& hash) {
  constexpr std::size_t count = 20011;
  std::vector<float> a(count), b(count), out(count);
  for (std::size_t i = 0; i < count; ++i) {
    a[i] = i % 2 ? random.any_bits() : random.between(-4, 4);
    b[i] = i % 2 ? random.any_bits() : random.between(-4, 4);
  }
  for (int f = 0; f <= static_cast<int>(MathFunction::float_to_half); ++f) {
    kernels.evaluate(static_cast<MathFunction>(f), a.data(), b.data(), out.data(), count);
    hash.add(out);
  }
}

// One hash per term but for hardware estimates, whose bits differ between machines: over the unit cube and over any
// bits. Those that need a table get one of noise.
void print_term_hashes(const Kernels& kernels) {
  constexpr std::size_t count = 5003;
  constexpr int table_size = 16;
  Random random;
  std::vector<std::vector<float>> in;
  for (int k = 0; k < max_term_inputs; ++k) {
    in.push_back(random.units(count));
    for (std::size_t i = 0; i < count; i += 4) in.back()[i] = random.any_bits();
  }
  const std::vector<float> table = random.units(std::size_t{4} * table_size * table_size);
  for (const TermSpan<float>* const* span = kernels.terms; *span != nullptr; ++span)
    for (int t = 0; t < (*span)->count; ++t) {
      const Term<float>& term = (*span)->first[t];
      if (std::string_view(term.name).starts_with("estimate_")) continue;
      std::vector<std::vector<float>> out(std::size_t(term.outputs), std::vector<float>(count));
      TermArgs<float> args{};
      for (int k = 0; k < term.inputs; ++k) args.in[k] = in[static_cast<std::size_t>(k)].data();
      for (int k = 0; k < term.outputs; ++k) args.out[k] = out[static_cast<std::size_t>(k)].data();
      args.count = count;
      args.table = table.data();
      args.table_size = table_size;
      term.run(args);
      Hash hash;
      for (const auto& plane : out) hash.add(plane);
      std::printf("%s term/%s %016llx\n", kernels.isa, term.name, static_cast<unsigned long long>(hash.value()));
    }
}

// Textures of noise: any word is a texel of the packed formats.
void hash_sampling(const Kernels& kernels, Random& random, Hash& hash) {
  constexpr int size = 64, levels = 4;
  constexpr std::size_t count = 1003;
  std::vector<std::uint32_t> words(sampling_texels(size, levels, true) * 4 + 4);
  for (std::uint32_t& word : words) word = std::uint32_t(random.next());
  std::vector<float> in[4], out[3];
  for (auto& plane : in)
    for (std::size_t i = 0; i < count; ++i) plane.push_back(i % 4 ? random.between(-3, 3) : random.any_bits());
  for (const SamplingKernels* const* list = sampling_tables; *list != nullptr; ++list) {
    if (std::string_view((*list)->isa) != kernels.isa) continue;
    for (int k = 0; k < (*list)->count; ++k) {
      for (auto& plane : out) plane.assign(count, 0);
      (*list)->first[k].run({{words.data(), size, levels},
                             {in[0].data(), in[1].data(), in[2].data(), in[3].data()},
                             {out[0].data(), out[1].data(), out[2].data()},
                             count});
      for (const auto& plane : out) hash.add(plane);
    }
  }
}

void hash_encode(const Kernels& kernels, Random& random, Hash& hash) {
  constexpr std::size_t count = 4099;
  std::vector<float> rgba(4 * count);
  for (std::size_t i = 0; i < rgba.size(); ++i) rgba[i] = i % 16 ? random.unit() : random.any_bits();
  for (int curve = 0; curve <= static_cast<int>(ToneCurve::khronos_neutral); ++curve) {
    std::vector<std::uint8_t> out(4 * count);
    kernels.encode({rgba.data(), count, 1.3f, static_cast<ToneCurve>(curve), out.data()});
    for (const std::uint8_t byte : out) hash.add(std::uint32_t{byte});
  }
}

void hash_downsample(const Kernels& kernels, Random& random, Hash& hash) {
  const int sizes[][2] = {{64, 32}, {37, 22}, {1, 9}, {5, 5}};
  for (const auto& [width, height] : sizes) {
    const std::vector<float> in = random.units(std::size_t{4} * width * height);
    std::vector<float> out(std::size_t{4} * std::max(1, width / 2) * std::max(1, height / 2));
    kernels.downsample({in.data(), width, height, out.data()});
    hash.add(out);
  }
}

void hash_halves(const Kernels& kernels, Random& random, Hash& hash) {
  std::vector<float> in(5001), out(in.size());
  for (std::size_t i = 0; i < in.size(); ++i) in[i] = i % 2 ? random.any_bits() : random.between(-1e-4f, 1e-4f);
  std::vector<std::uint16_t> halves(in.size());
  kernels.pack_half(in.data(), halves.data(), in.size());
  kernels.unpack_half(halves.data(), out.data(), out.size());
  for (const std::uint16_t half : halves) hash.add(std::uint32_t{half});
  hash.add(out);
}

struct Subject {
  const char* name;
  void (*run)(const Kernels&, Random&, Hash&);
};
const Subject subjects[] = {
    {"evaluate", hash_evaluate},     {"sampling", hash_sampling},       {"encode", hash_encode},
    {"downsample", hash_downsample}, {"halves", hash_halves},           {"raster", hash_raster},
    {"shade", hash_shade},           {"environment", hash_environment},
};

}  // namespace
}  // namespace tessera

int main() {
  using namespace tessera;
  for (const Kernels* kernels : runnable_kernels()) {
    print_term_hashes(*kernels);
    for (const Subject& subject : subjects) {
      Random random;
      Hash hash;
      subject.run(*kernels, random, hash);
      std::printf("%s %s %016llx\n", kernels->isa, subject.name, static_cast<unsigned long long>(hash.value()));
    }
  }
}
