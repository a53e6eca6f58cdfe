// GGX microfacets with Smith masking, in double, by angles as the papers write them. alpha = roughness^2.
#pragma once
#include "reference/vector.hpp"

namespace tessera::reference {

/// Walter et al. 2007, eq. 33. theta = angle between the microfacet and the surface normal, [0, pi/2).
double ggx_distribution(double theta, double alpha);

/// The same from sin^2 and cos^2 of that angle, for angles too small to be told apart by their cosine.
double ggx_distribution(double sin2, double cos2, double alpha);

/// Smith's Lambda for GGX: Heitz 2014, eq. 72 with a = 1 / (alpha tan theta).
double ggx_lambda(double theta, double alpha);

/// Height-correlated masking and shadowing: Heitz 2014, eq. 99. 0 at or below the horizon.
double smith_masking_shadowing(double theta_v, double theta_l, double alpha);

/// D G / (4 cos cos), everything but Fresnel, for unit vectors in the shading frame (n = +Z). Heitz 2014, eq. 15.
double specular_brdf_over_fresnel(const Vec3& v, const Vec3& l, double alpha);

}  // namespace tessera::reference
