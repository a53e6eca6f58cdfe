// The pictures that an environment can come as: one equirectangular map, or the six faces of a cube in several layouts.
#pragma once
#include <array>
#include <string>

#include "base/image.hpp"

namespace tessera {

enum class EnvironmentLayout {
  automatic,  // by the picture's proportions: layout_by_size
  equirect,
  horizontal_cross,  // 4 x 3 faces:    +Y       vertical_cross, 3 x 4:    +Y
                     //              -X +Z +X -Z                        -X +Z +X
                     //                 -Y                                 -Y
                     //                                                    -Z, upside down
  vertical_cross,
  horizontal_strip,  // +X -X +Y -Y +Z -Z
  vertical_strip,
};

/// 4:3 and 3:4 crosses, 6:1 and 1:6 strips (of whole faces); everything else is equirectangular.
EnvironmentLayout layout_by_size(int width, int height);

/// "auto", "equirect", "cross" (of either kind), "strip". Throws Error(usage).
EnvironmentLayout parse_layout(const std::string& text, int width, int height);

/// A picture whose layout is settled: equirectangular (EquirectView has the orientation), or six square faces one below
/// the other, in the order and orientation of CubeView.
struct EnvironmentPicture {
  Image image;
  bool faces = false;
  [[nodiscard]] int face_size() const { return image.width; }
};

/// Puts the picture's faces in order. Throws Error(input), beginning with name, if it has no pixels, 2^29 or more, or
/// not the proportions of its layout.
EnvironmentPicture arrange(Image image, EnvironmentLayout layout, const std::string& name);

/// Faces from files of their own, +X -X +Y -Y +Z -Z. Throws Error(input) for faces that are not square, or not all
/// alike.
EnvironmentPicture arrange_faces(const std::array<Image, 6>& faces, const std::array<std::string, 6>& names);

}  // namespace tessera
