// Measured metals.
#pragma once

namespace tessera::reference {

/// Complex index eta + i k for the red, green and blue of linear Rec.709: spectral measurements (those collected at
/// refractiveindex.info and in the SOPRA database), integrated to three channels by Bitterli 2014, Tungsten renderer,
/// ComplexIorData.hpp; four digits. Iron, which is not among those: Johnson & Christy 1974, Optical constants of
/// transition metals, Phys. Rev. B 9, 5056, interpolated linearly at 650, 550 and 450 nm.
struct Metal {
  const char* name;
  double eta[3], k[3];
};

inline constexpr Metal metals[] = {
    {"silver", {0.1553, 0.1167, 0.1384}, {4.828, 3.122, 2.147}},
    {"gold", {0.1431, 0.3750, 1.442}, {3.983, 2.386, 1.603}},
    {"copper", {0.2004, 0.9240, 1.102}, {3.913, 2.453, 2.142}},
    {"aluminium", {1.657, 0.8804, 0.5212}, {9.224, 6.270, 4.837}},
    {"chromium", {4.370, 2.917, 1.655}, {5.206, 4.231, 3.755}},
    {"iron", {2.911, 2.950, 2.585}, {3.089, 2.932, 2.767}},
    {"nickel", {2.367, 1.663, 1.467}, {4.499, 3.050, 2.345}},
    {"tungsten", {4.371, 3.300, 2.998}, {3.501, 2.605, 2.273}},
};

}  // namespace tessera::reference
