// A specular lobe put together from the catalogue's terms, in a white furnace: every direction sends light of 1.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "kernels/interface.hpp"

namespace tessera::cli {

/// Names of terms (kernels/terms.hpp): what a lobe is made of.
struct LobeChoice {
  std::string distribution = "D_GGX", masking = "V_SmithGGXCorrelated", fresnel = "F_Schlick",
              compensation = "f_SingleScattering";
  double f0 = 1;     // reflectance at normal incidence
  double gamma = 2;  // of D_GTR
};

/// The parts that a lobe may have: 'D' distributions, 'V' masking, 'F' Fresnel, 'f' compensation.
std::vector<std::string> lobe_parts(char kind);

/// "ggx,smith...,turquin": names of parts, with or without their prefix, in any order and case. Throws Error(usage).
LobeChoice parse_lobe(std::string_view names);

/// What comes back towards the eye, by NoV (each in (0,1]): 1 is the furnace itself. Through the same kernels that
/// shade pictures. roughness in (0,1], perceptual.
std::vector<double> furnace_albedo(const Kernels& kernels, const LobeChoice& choice, double roughness,
                                   const std::vector<double>& NoV);

}  // namespace tessera::cli
