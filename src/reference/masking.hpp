// Masking and shadowing in double, by angles as the papers write them: G, not divided by 4 cos cos. n = +Z.
#pragma once
#include <functional>

#include "reference/vector.hpp"

namespace tessera::reference {

/// Smith's Lambda for Beckmann: Heitz 2014, eq. 66 with a = 1 / (alpha tan theta); Walter 2007's fit, by its G1 (eq.
/// 27).
double beckmann_lambda(double theta, double alpha);
double beckmann_lambda_rational(double theta, double alpha);

/// How masking and shadowing are joined: Heitz 2014, eqs. 98 to 101, from the Lambda of either direction and the
/// azimuth between them, [0, pi].
enum class Joint { separable, height, direction, height_direction };
double joint_masking(Joint joint, double lambda_v, double lambda_l, double azimuth);

/// mu / (mu (1 - k) + k), separable: Schlick 1994, eq. 19.
double schlick_masking(const Vec3& v, const Vec3& l, double k);
/// One direction of it.
double schlick_g1(double mu, double k);

/// 2 cos cos / lerp(2 cos cos, cos + cos, alpha): Hammon 2017.
double hammon_masking(const Vec3& v, const Vec3& l, double alpha);

/// The V-shaped groove with facets along m: Cook and Torrance 1982; and its masking alone, Heitz 2014, eq. 28.
double cook_torrance_masking(const Vec3& v, const Vec3& l);
double v_cavity_g1(const Vec3& v, const Vec3& m);

double neumann_masking(const Vec3& v, const Vec3& l);
double kelemen_masking(const Vec3& v, const Vec3& l);
double implicit_masking(const Vec3& v, const Vec3& l);

/// What the masking constraint holds to be n.v: integral G1(v,m) max(0, v.m) D(m) dm (Heitz 2014, eq. 5), the area of
/// the facets that are seen along v, by quadrature. D is a function of the angle between facet and normal; alpha says
/// where it lies (tan theta of that order). Converged to 1e-6 for a G1 that is smooth in m, 1e-4 for one with a kink.
double visible_area(double mu, double alpha, const std::function<double(double theta)>& D,
                    const std::function<double(const Vec3& v, const Vec3& m)>& G1);

}  // namespace tessera::reference
