// Diffuse lobes in double, by angles as the papers write them: BRDF values, cosine not included. n = +Z.
#pragma once
#include <functional>

#include "reference/vector.hpp"

namespace tessera::reference {

/// Burley 2012, section 5.3; Lagarde and de Rousiers 2014, listing 2. roughness perceptual.
double burley_diffuse(double albedo, double roughness, const Vec3& v, const Vec3& l);
double frostbite_diffuse(double albedo, double roughness, const Vec3& v, const Vec3& l);

/// Oren and Nayar 1994, eq. 30; sigma in radians.
double oren_nayar_diffuse(double albedo, double sigma, const Vec3& v, const Vec3& l);

/// Fujii 2012: the single-scattering lobe of the next.
double fujii_diffuse(double albedo, double roughness, const Vec3& v, const Vec3& l);

/// Portsmouth, Kutz, Hill 2025, eqs. for f_ss + f_ms, its directional and average albedos not from the paper's closed
/// forms but from their definitions, by quadrature: slow.
double eon_diffuse(double albedo, double roughness, const Vec3& v, const Vec3& l);

/// Ashikhmin and Shirley 2000, eq. 5.
double ashikhmin_shirley_diffuse(double albedo, double f0, const Vec3& v, const Vec3& l);

/// integral f(v, l) n.l dl over the hemisphere, mu = n.v: what of the light along v comes back. f smooth but where l is
/// a quarter turn from v in azimuth, or as high as v. Converged to 1e-7 for the lobes above.
double hemispherical_albedo(const std::function<double(const Vec3& v, const Vec3& l)>& f, double mu, int order = 32);

/// 2 integral E(mu) mu dmu.
double average_hemispherical_albedo(const std::function<double(const Vec3& v, const Vec3& l)>& f, int order = 32);

}  // namespace tessera::reference
