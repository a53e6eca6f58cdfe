#include "kernels/bake/cube.hpp"
#include "kernels/bake/dfg.hpp"
#include "kernels/bake/prefilter.hpp"
#include "kernels/entry/entries.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// Texels of a face in rows, as many as there are lanes at a time; rows shorter than a vector share one.
struct TexelBlock {
  Float i, j;  // coordinates of each lane's texel; the last texel's, past the end
  int count;
};

inline TexelBlock texel_block(const CubeRows& rows, int first, int end) {
  const Int index = min(lane_index() + Int(first), Int(end - 1));
  const Float row = floor(to_float(index) / Float(rows.size));  // exact: size is a power of two, the index below 2^24
  const Float column = to_float(index) - row * Float(rows.size);
  const int left = end - first;
  return {column, row, left < Float::lanes ? left : Float::lanes};
}

inline void store_texels(float* out, int first, const TexelBlock& block, const Vec3<Float>& color) {
  float r[Float::lanes], g[Float::lanes], b[Float::lanes];
  store(r, color.x);
  store(g, color.y);
  store(b, color.z);
  float* texel = out + std::size_t(first) * 4;
  for (int k = 0; k < block.count; ++k, texel += 4) {
    texel[0] = r[k];
    texel[1] = g[k];
    texel[2] = b[k];
    texel[3] = 1.0f;
  }
}

// for_texels(rows, f): f(i, j) -> radiance of texel i of row j, for all texels of the rows.
template <class Function>
inline void for_texels(const CubeRows& rows, const Function& f) {
  const int end = rows.row_end * rows.size;
  for (int first = rows.row_begin * rows.size; first < end; first += Float::lanes) {
    const TexelBlock block = texel_block(rows, first, end);
    store_texels(rows.out, first, block, f(block.i, block.j));
  }
}

}  // namespace

void dfg_table(const DfgTableArgs& args) {
  const Float size = Float(args.size);
  for (int j = args.row_begin; j < args.row_end; ++j) {
    const Float r = Float((float(j) + 0.5f)) / size;
    float* row = args.out + std::size_t(j) * std::size_t(args.size) * 2;
    for (int i = 0; i < args.size; i += Float::lanes) {
      const Float NoV = min(to_float(lane_index() + Int(i)) + Float(0.5), size) / size;
      const Dfg<Float> dfg = integrate_dfg(NoV, r);
      float a[Float::lanes], b[Float::lanes];
      store(a, dfg.A);
      store(b, dfg.B);
      for (int k = 0; k < Float::lanes && i + k < args.size; ++k) {
        row[2 * (i + k)] = a[k];
        row[2 * (i + k) + 1] = b[k];
      }
    }
  }
}

void equirect_to_cube(const EquirectToCubeArgs& args) {
  const int n = args.samples;
  const Float step = Float(2.0f / (float(args.rows.size) * float(n)));
  const Float cosine = Float(args.rotation[0]), sine = Float(args.rotation[1]);
  const Float share = Float(float(n) * float(n));
  for_texels(args.rows, [&](Float i, Float j) {
    Vec3<Float> sum{Float(0), Float(0), Float(0)};
    for (int b = 0; b < n; ++b) {
      const Float t = mul_sub(mul_add(j, Float(n), Float(float(b) + 0.5f)), step, Float(1));
      for (int a = 0; a < n; ++a) {
        const Float s = mul_sub(mul_add(i, Float(n), Float(float(a) + 0.5f)), step, Float(1));
        const Vec3<Float> d = face_direction(args.rows.face, s, t);
        // Back into the picture's own orientation: turned by minus the rotation about +Y.
        const Float x = difference_of_products(d.x, cosine, d.z, sine);
        const Float z = mul_add(d.x, sine, d.z * cosine);
        sum = sum + sample_equirect(args.source, Vec3<Float>{x, d.y, z});
      }
    }
    return Vec3<Float>{sum.x / share, sum.y / share, sum.z / share};
  });
}

void prefilter_cube(const PrefilterCubeArgs& args) {
  const Float step = Float(2.0f / float(args.rows.size));
  for_texels(args.rows, [&](Float i, Float j) {
    const Float s = mul_sub(i + Float(0.5), step, Float(1));
    const Float t = mul_sub(j + Float(0.5), step, Float(1));
    const Vec3<Float> n = normalize(face_direction(args.rows.face, s, t));
    return prefilter(args.radiance, args.lobe, n) + sum_points(args.points, n);
  });
}

}  // namespace tessera::TESSERA_ISA
