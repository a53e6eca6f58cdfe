// Tables and environments, made once: the environment BRDF, cubes and their mips, mips of textures.
// A part of kernels/interface.hpp, which has the conventions; include that.
#pragma once
#include <cstddef>
#include <cstdint>

#include "kernels/interface/shading.hpp"

namespace tessera {

struct DfgTableArgs {
  float* out;  // the whole table: size x size pairs, DfgView::texels without its border
  int size;
  int row_begin, row_end;
};

struct EquirectView {   // radiance; column u = 0.5 + atan2(z, x) / 2pi, row v = acos(y) / pi from the top
  const float* texels;  // RGB, stride 3, finite and non-negative; width * height < 2^29
  int width, height;
};

struct CubeRows {  // rows of one face that a kernel fills, without the border
  int face, size;
  int row_begin, row_end;
  float* out;                         // RGBA, size * size of the whole face
  int column_begin = 0, columns = 0;  // a power of two of them; 0: all
};

struct EquirectToCubeArgs {
  EquirectView source;
  float rotation[2];  // cos, sin: the environment is turned about +Y, counter-clockwise seen from above
  int samples;        // per texel, along each side: a box filter over samples^2 bilinear lookups
  CubeRows rows;
};

struct CubeFacesView {  // radiance on six faces of any size, in the order and orientation of a CubeView
  const float* texels;  // RGB, stride 3, finite and non-negative; 6 * size * size < 2^29
  int size;
};

struct FacesToCubeArgs {
  CubeFacesView source;
  float rotation[2];  // cos, sin: as EquirectToCubeArgs::rotation
  int samples;        // per texel, along each side
  CubeRows rows;
};

// Points of a lobe about the +z axis: the same for all texels of a level.
struct LobeSamples {
  const float *x, *y, *z;  // unit directions
  const float* weight;     // sums to 1
  const float* lod;        // level of the radiance cube to read
  int count;
};

// Small bright sources, summed one by one: points of a lobe would hit or miss them.
struct PointSources {
  const float *x, *y, *z;           // unit directions
  const float *red, *green, *blue;  // radiance times solid angle
  int count;
  float alpha2, scale;  // the lobe: scale c / (alpha2 + (1 - alpha2) (1 - c) / 2)^2 at cosine c from its axis
  const float* solid_angle = nullptr;  // of each source, if they are all there is: the sum is then a weighted mean over
                                       // them, and `scale` does not matter
};

struct PrefilterCubeArgs {
  CubeView radiance;  // bordered mips of plain radiance
  LobeSamples lobe;   // none: points alone
  CubeRows rows;
  PointSources points;
};

struct DownsampleArgs {  // one mip level from the one above it, box filter in linear light
  const float* in;       // RGBA
  int width, height;
  float* out;  // max(1, width/2) x max(1, height/2)
};

}  // namespace tessera
