// Distributions of microfacet normals in double, by angles as the papers write them. alpha = roughness^2 in (0,1].
#pragma once

namespace tessera::reference {

/// Beckmann & Spizzichino 1963, as Walter et al. 2007, eq. 25. theta in [0, pi/2).
double beckmann_distribution(double theta, double alpha);

/// Walter et al. 2007, eq. 30, with power 2 / alpha^2 - 2. theta in [0, pi/2).
double blinn_phong_distribution(double theta, double alpha);

/// Burley 2012, appendix B, eq. 9; gamma = 1 by eq. 4, alpha = 1 by its limit 1/pi.
double gtr_distribution(double theta, double alpha, double gamma);

/// Burley 2012, appendix B, eq. 13. phi = azimuth from the tangent.
double anisotropic_ggx_distribution(double theta, double phi, double alpha_x, double alpha_y);

/// Heitz 2014, section 5.4: slopes normally distributed with deviations alpha_x / sqrt 2, alpha_y / sqrt 2.
double anisotropic_beckmann_distribution(double theta, double phi, double alpha_x, double alpha_y);

}  // namespace tessera::reference
