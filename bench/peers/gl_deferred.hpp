// The deferred-shading pass in OpenGL: one triangle over the whole picture, G-buffer, cube and table as textures.
#pragma once
#include <string>
#include <vector>

namespace tessera::peers {

class GlDeferred {
 public:
  /// Uploads the inputs of `folder`; `shader`: path of deferred.frag. A GlContext is current, and outlives this.
  GlDeferred(std::string folder, std::string shader);

  /// Compiles the pass for the lights of lights_COUNT.f32.
  void use_lights(const std::string& count);
  /// Draws a frame and waits for its end.
  void draw() const;
  /// The picture: RGBA, top row first.
  [[nodiscard]] std::vector<float> read() const;

 private:
  void set_uniforms(const std::vector<float>& records) const;

  std::string folder_, shader_;
  unsigned program_ = 0;
};

}  // namespace tessera::peers
