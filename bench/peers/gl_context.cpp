#include "bench/peers/gl_context.hpp"

#include <EGL/eglext.h>
#include <GL/gl.h>

#include "base/error.hpp"

namespace tessera::peers {

GlContext::GlContext() : display_(eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)) {
  if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) == EGL_FALSE)
    throw input_error("EGL: no surfaceless display");
  eglBindAPI(EGL_OPENGL_API);
  const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3, EGL_NONE};
  EGLConfig config{};
  EGLint count = 0;
  eglChooseConfig(display_, wanted, &config, 1, &count);
  context_ = count > 0 ? eglCreateContext(display_, config, EGL_NO_CONTEXT, version) : EGL_NO_CONTEXT;
  if (context_ == EGL_NO_CONTEXT || eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
    throw input_error("EGL: no OpenGL 3.3 context without a surface (error {:#x})", eglGetError());
  const auto text = [](GLenum name) { return std::string(reinterpret_cast<const char*>(glGetString(name))); };
  driver_ = text(GL_VERSION) + ", " + text(GL_RENDERER);
  if (!text(GL_RENDERER).starts_with("llvmpipe")) throw input_error("OpenGL: {} is not llvmpipe", driver_);
}

GlContext::~GlContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

}  // namespace tessera::peers
