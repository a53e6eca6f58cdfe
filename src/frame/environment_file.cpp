#include "frame/environment_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <utility>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "io/file_bytes.hpp"
#include "io/output_file.hpp"

namespace tessera {
namespace {

static_assert(std::endian::native == std::endian::little, "environment files are written as memory has them");

constexpr char magic[4] = {'T', 'S', 'R', 'A'};
constexpr std::uint32_t version = 2;
constexpr std::uint32_t flag_cube = 1, flag_light = 2;
constexpr std::uint64_t file_limit = std::uint64_t{4} << 30;  // the largest cubes there are take less

class Writer {
 public:
  template <class T>
  void add(const T& value) {
    add(&value, sizeof(T));
  }
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), bytes, bytes + size);
  }
  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  Reader(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes), name_(name) {}
  template <class T>
  T take() {
    T value;
    take(&value, sizeof(T));
    return value;
  }
  void take(void* out, std::size_t size) {
    if (bytes_.size() - at_ < size) throw input_error("{}: truncated environment of {} bytes", name_, bytes_.size());
    std::memcpy(out, bytes_.data() + at_, size);
    at_ += size;
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

 private:
  std::span<const std::byte> bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
};

std::uint64_t checksum(std::span<const std::byte> bytes) {
  PixelHash hash;
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + i, 4);
    hash.add(word);
  }
  return hash.value();
}

struct CubeSize {
  std::uint32_t size = 0, levels = 0;
  [[nodiscard]] std::size_t halves() const { return size == 0 ? 0 : cube_texel_count(int(size), int(levels)) * 4; }
};

CubeSize take_size(Reader& in, const std::string& name, const char* what, bool has_levels) {
  CubeSize cube;
  cube.size = in.take<std::uint32_t>();
  cube.levels = has_levels ? in.take<std::uint32_t>() : 1;
  if (!has_levels && cube.size == 0) return cube;
  if (cube.size < 1 || cube.size > std::uint32_t(max_cube_size) || !std::has_single_bit(cube.size))
    throw input_error("{}: {} cube of size {}, expected a power of two up to {}", name, what, cube.size, max_cube_size);
  if (cube.levels < 1 || cube.levels > 31 || cube.size >> (cube.levels - 1) == 0)
    throw input_error("{}: {} cube of size {} with {} levels", name, what, cube.size, cube.levels);
  return cube;
}

Cube take_cube(Reader& in, const CubeSize& size, const std::string& name, const char* what) {
  if (size.size == 0) return {};
  AlignedVector<std::uint16_t> halves(size.halves());
  in.take(halves.data(), halves.size() * sizeof(std::uint16_t));
  // Finite and not negative.
  if (std::any_of(halves.begin(), halves.end(), [](std::uint16_t half) { return half > 0x7bff; }))
    throw input_error("{}: {} cube holds radiance that is negative or not finite", name, what);
  return {int(size.size), int(size.levels), std::move(halves)};
}

template <class T, std::size_t N>
void take_finite(Reader& in, T (&out)[N], const std::string& name, const char* what) {
  in.take(out, sizeof out);
  for (const T value : out)
    if (!std::isfinite(value)) throw input_error("{}: {} is not finite", name, what);
}

DominantLight take_light(Reader& in, const std::string& name) {
  DominantLight light{};
  take_finite(in, light.direction, name, "the light's direction");
  take_finite(in, light.illuminance, name, "the light's illuminance");
  float radius[1];
  take_finite(in, radius, name, "the light's radius");
  light.angular_radius = radius[0];
  double length2 = 0;
  for (const float d : light.direction) length2 += double(d) * double(d);
  if (!(std::abs(length2 - 1) < 1e-4)) throw input_error("{}: the light's direction is not a unit vector", name);
  if (std::any_of(std::begin(light.illuminance), std::end(light.illuminance), [](float e) { return e < 0; }))
    throw input_error("{}: the light's illuminance is negative", name);
  if (!(light.angular_radius >= 0 && light.angular_radius <= 4))
    throw input_error("{}: the light's angular radius is {}", name, light.angular_radius);
  return light;
}

}  // namespace

bool is_baked_environment(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  char head[4] = {};
  return file.read(head, sizeof head) && std::memcmp(head, magic, sizeof magic) == 0;
}

void write_environment(const std::string& path, const EnvironmentData& data) {
  Writer out;
  out.add(magic, sizeof magic);
  out.add(version);
  for (const Cube* cube : {&data.background, &data.specular}) {
    out.add(std::uint32_t(cube->size()));
    out.add(std::uint32_t(cube->levels()));
  }
  out.add(std::uint32_t(data.irradiance.size()));
  out.add((data.uses_cube ? flag_cube : 0) | (data.light ? flag_light : 0));
  out.add(data.lod_curve);
  out.add(data.sh.coefficients);
  for (const std::size_t count :
       {data.report.negative, data.report.non_finite, data.report.fireflies, data.report.clamped})
    out.add(std::uint64_t(count));
  out.add(data.statistics.mean);
  out.add(data.statistics.brightest);
  if (data.light) {
    out.add(data.light->direction);
    out.add(data.light->illuminance);
    out.add(data.light->angular_radius);
  }
  for (const Cube* cube : {&data.background, &data.specular, &data.irradiance})
    out.add(cube->texels().data(), cube->texels().size() * sizeof(std::uint16_t));
  out.add(checksum(out.bytes()));
  OutputFile file(path);
  file.write(out.bytes().data(), out.bytes().size());
  file.commit();
}

EnvironmentData parse_environment(std::span<const std::byte> bytes, const std::string& name) {
  Reader in(bytes, name);
  char head[4];
  in.take(head, sizeof head);
  if (std::memcmp(head, magic, sizeof magic) != 0) throw input_error("{}: not a baked environment", name);
  if (const auto found = in.take<std::uint32_t>(); found != version)
    throw input_error("{}: a baked environment of version {}, expected {}; bake it again", name, found, version);
  const CubeSize background = take_size(in, name, "background", true), specular = take_size(in, name, "specular", true),
                 irradiance = take_size(in, name, "irradiance", false);
  const auto flags = in.take<std::uint32_t>();
  if (flags > (flag_cube | flag_light) || ((flags & flag_cube) != 0 && irradiance.size == 0))
    throw input_error("{}: flags {:#x} make no sense", name, flags);

  EnvironmentData data;
  data.uses_cube = (flags & flag_cube) != 0;
  data.lod_curve = in.take<float>();
  if (!(data.lod_curve >= 0 && data.lod_curve <= 1))
    throw input_error("{}: level curve {}, expected 0 to 1", name, data.lod_curve);
  for (auto& row : data.sh.coefficients) take_finite(in, row, name, "a harmonic coefficient");
  for (std::size_t* count :
       {&data.report.negative, &data.report.non_finite, &data.report.fireflies, &data.report.clamped})
    *count = std::size_t(in.take<std::uint64_t>());
  take_finite(in, data.statistics.mean, name, "mean radiance");
  data.statistics.brightest = in.take<double>();
  if (!std::isfinite(data.statistics.brightest)) throw input_error("{}: the brightest texel is not finite", name);
  if ((flags & flag_light) != 0) data.light = take_light(in, name);

  // Before memory is asked for.
  const std::size_t expected = (background.halves() + specular.halves() + irradiance.halves()) * 2 + 8;
  if (in.left() != expected) throw input_error("{}: {} bytes of texels, expected {}", name, in.left(), expected);
  std::uint64_t sum = 0;
  std::memcpy(&sum, bytes.data() + bytes.size() - 8, 8);
  if (checksum(bytes.first(bytes.size() - 8)) != sum) throw input_error("{}: damaged: its checksum is wrong", name);
  data.background = take_cube(in, background, name, "background");
  data.specular = take_cube(in, specular, name, "specular");
  data.irradiance = take_cube(in, irradiance, name, "irradiance");
  return data;
}

EnvironmentData read_environment(const std::string& path) {
  return parse_environment(read_file(path, file_limit), path);
}

}  // namespace tessera
