// Scenes made from integers, + - * / and square roots alone: the same on every machine, so that their pictures can be
// compared to the bit.
#pragma once
#include <string>
#include <vector>

#include "base/image.hpp"
#include "frame/settings.hpp"
#include "scene/scene.hpp"

namespace tessera::golden {

struct GoldenScene {
  std::string name;
  Scene scene;
  Camera camera;
  RenderSettings settings;
  bool environment = true;
};

/// Every scene, small enough to be rendered some dozens of times in a test.
std::vector<GoldenScene> golden_scenes();

/// A sky with a gradient, a ground and a bright sun: 64 x 32 texels.
Image golden_environment();

}  // namespace tessera::golden
