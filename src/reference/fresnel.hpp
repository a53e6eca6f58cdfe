// Reflectance of an interface, in double.
#pragma once

namespace tessera::reference {

/// Schlick 1994, eq. 15.
double fresnel_schlick(double f0, double cos_theta);

/// Exact, unpolarised: Born & Wolf, Principles of Optics, 1.5.2, eq. 21 with Snell's law. eta = index behind the
/// surface over index before it. 1 for total internal reflection.
double fresnel_dielectric(double cos_theta, double eta);

/// Exact, unpolarised, for a metal of relative index eta + i k: the same equations with a complex index.
double fresnel_conductor(double cos_theta, double eta, double k);

}  // namespace tessera::reference
