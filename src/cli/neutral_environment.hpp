// A plain studio for scenes that come without light.
#pragma once
#include "base/image.hpp"

namespace tessera::cli {

/// Equirectangular RGB radiance: a grey room that is brighter above, with three soft boxes for highlights.
Image neutral_environment();

}  // namespace tessera::cli
