// Environments from files: pictures of several layouts, and baked ones (.tsra).
//
// A .tsra file, all numbers little-endian, version 1:
//   "TSRA", u32 version, u32 background size, levels, specular size, levels, irradiance size (0: none), u32 flags
//   (1: irradiance comes from the cube; 2: a light follows the statistics), f32 lod_curve, f32 harmonics[9][3],
//   u64 negative, non-finite, firefly and clamped texels, f64 mean[3], brightest,
//   [f32 direction[3], illuminance[3], angular radius]
//   half texels[4] of the cubes background, specular, irradiance as CubeView has them, borders included
//   u64 FNV-1a over the 32-bit words before it
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "precompute/environment.hpp"
#include "precompute/environment_source.hpp"

namespace tessera {

/// Whether the file begins as a baked environment does. False for files that cannot be read.
bool is_baked_environment(const std::string& path);

/// Writes a file that appears whole or not at all. Throws Error(output).
void write_environment(const std::string& path, const EnvironmentData& data);

/// Throws Error(input) that says what is wrong. What it returns is as sound as what build_environment makes.
EnvironmentData read_environment(const std::string& path);
/// The same from memory; name begins error messages.
EnvironmentData parse_environment(std::span<const std::byte> bytes, const std::string& name);

/// An environment's picture: from one file, from a folder of faces (px nx py ny pz nz, also as m0_px ..., with any
/// extension), or from six files in that order. layout: as parse_layout. Pictures of integers (PNG, JPEG) are taken as
/// sRGB and decoded. Throws Error(input), Error(usage).
EnvironmentPicture read_environment_picture(const std::vector<std::string>& paths, const std::string& layout,
                                            const Kernels& kernels);

}  // namespace tessera
