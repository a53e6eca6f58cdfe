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

inline int columns_of(const CubeRows& rows) { return rows.columns > 0 ? rows.columns : rows.size; }

inline TexelBlock texel_block(const CubeRows& rows, int first, int end) {
  const Int index = min(lane_index() + Int(first), Int(end - 1));
  const Float width = Float(columns_of(rows));
  const Float row = floor(to_float(index) / width);  // exact: width is a power of two, the index below 2^24
  const Float column = to_float(index) - row * width;
  const int left = end - first;
  return {column + Float(rows.column_begin), row + Float(rows.row_begin), left < Float::lanes ? left : Float::lanes};
}

inline void store_texels(const CubeRows& rows, int first, int count, const Vec3<Float>& color) {
  float r[Float::lanes], g[Float::lanes], b[Float::lanes];
  store(r, color.x);
  store(g, color.y);
  store(b, color.z);
  const int width = columns_of(rows);
  for (int k = 0; k < count; ++k) {
    const int row = rows.row_begin + (first + k) / width, column = rows.column_begin + (first + k) % width;
    float* texel = rows.out + (std::size_t(row) * std::size_t(rows.size) + std::size_t(column)) * 4;
    texel[0] = r[k];
    texel[1] = g[k];
    texel[2] = b[k];
    texel[3] = 1.0f;
  }
}

// for_texels(rows, f): f(i, j) -> radiance of texel i of row j, for all texels of the rows.
template <class Function>
inline void for_texels(const CubeRows& rows, const Function& f) {
  const int end = (rows.row_end - rows.row_begin) * columns_of(rows);
  for (int first = 0; first < end; first += Float::lanes) {
    const TexelBlock block = texel_block(rows, first, end);
    store_texels(rows, first, block.count, f(block.i, block.j));
  }
}

// Each texel the mean of samples^2 points of it, looked up along the picture's own directions.
template <class Lookup>
inline void resample(const CubeRows& rows, int n, const float rotation[2], const Lookup& lookup) {
  const Float step = Float(2.0f / (float(rows.size) * float(n)));
  const Float cosine = Float(rotation[0]), sine = Float(rotation[1]);
  const Float share = Float(float(n) * float(n));
  for_texels(rows, [&](Float i, Float j) {
    Vec3<Float> sum{Float(0), Float(0), Float(0)};
    for (int b = 0; b < n; ++b) {
      const Float t = mul_sub(mul_add(j, Float(n), Float(float(b) + 0.5f)), step, Float(1));
      for (int a = 0; a < n; ++a) {
        const Float s = mul_sub(mul_add(i, Float(n), Float(float(a) + 0.5f)), step, Float(1));
        const Vec3<Float> d = face_direction(rows.face, s, t);
        // Back into the picture's own orientation: turned by minus the rotation about +Y.
        const Float x = difference_of_products(d.x, cosine, d.z, sine);
        const Float z = mul_add(d.x, sine, d.z * cosine);
        sum = sum + lookup(Vec3<Float>{x, d.y, z});
      }
    }
    return Vec3<Float>{sum.x / share, sum.y / share, sum.z / share};
  });
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
  resample(args.rows, args.samples, args.rotation,
           [&](const Vec3<Float>& d) { return sample_equirect(args.source, d); });
}

void faces_to_cube(const FacesToCubeArgs& args) {
  resample(args.rows, args.samples, args.rotation, [&](const Vec3<Float>& d) { return sample_faces(args.source, d); });
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
