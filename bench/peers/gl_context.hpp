// An OpenGL 3.3 context without window, screen or graphics card: Mesa's surfaceless platform, current in this thread.
#pragma once
#include <EGL/egl.h>

#include <string>

namespace tessera::peers {

class GlContext {
 public:
  /// Throws Error(input) if there is none, or if what draws is not llvmpipe.
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Version and renderer, as the driver puts it.
  [[nodiscard]] const std::string& driver() const { return driver_; }

 private:
  EGLDisplay display_;
  EGLContext context_;
  std::string driver_;
};

}  // namespace tessera::peers
