#include "bench/peers/gl_deferred.hpp"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include <fstream>
#include <sstream>
#include <utility>

#include "base/error.hpp"
#include "bench/workload/inputs.hpp"

namespace tessera::peers {
namespace {

using workload::height, workload::width, workload::read_array;

constexpr const char* vertex_shader = R"(#version 330 core
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); })";

// Texture units, in the order of these names in the shader.
constexpr const char* sampler_names[] = {"position_occlusion", "normal_roughness", "color_metallic", "environment",
                                         "dfg"};
constexpr GLenum first_unit = GL_TEXTURE0, environment_unit = GL_TEXTURE3, dfg_unit = GL_TEXTURE4;
constexpr int cube_size = 256, cube_levels = 9, dfg_size = 128;

void filter(GLenum target, GLint minify, GLint magnify) {
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, minify);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, magnify);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTexParameteri(target, wrap, GL_CLAMP_TO_EDGE);
}

GLuint new_texture(GLenum unit, GLenum target) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glActiveTexture(unit);
  glBindTexture(target, texture);
  return texture;
}

// Three textures of four of the twelve planes each.
void upload_gbuffer(const std::string& folder) {
  constexpr std::size_t which[3][4] = {{0, 1, 2, 11}, {3, 4, 5, 10}, {6, 7, 8, 9}};
  constexpr std::size_t pixels = std::size_t{width} * height;
  const auto planes = read_array<float>(folder + "/w1_gbuffer.f32");
  std::vector<float> texels(4 * pixels);
  for (GLenum t = 0; t < 3; ++t) {
    for (std::size_t i = 0; i < pixels; ++i)
      for (std::size_t k = 0; k < 4; ++k) texels[4 * i + k] = planes[which[t][k] * pixels + i];
    new_texture(first_unit + t, GL_TEXTURE_2D);
    filter(GL_TEXTURE_2D, GL_NEAREST, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, texels.data());
  }
}

void upload_surroundings(const std::string& folder) {
  const auto cube = read_array<std::uint16_t>(folder + "/env.rgba16f");
  new_texture(environment_unit, GL_TEXTURE_CUBE_MAP);
  filter(GL_TEXTURE_CUBE_MAP, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAX_LEVEL, cube_levels - 1);
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  const std::uint16_t* face = cube.data();
  for (int level = 0; level < cube_levels; ++level)
    for (GLenum f = 0; f < 6; ++f) {
      const int n = cube_size >> level;
      glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + f, level, GL_RGBA16F, n, n, 0, GL_RGBA, GL_HALF_FLOAT, face);
      face += std::ptrdiff_t{4} * n * n;
    }
  const auto table = read_array<std::uint16_t>(folder + "/dfg.rg16f");
  new_texture(dfg_unit, GL_TEXTURE_2D);
  filter(GL_TEXTURE_2D, GL_LINEAR, GL_LINEAR);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RG16F, dfg_size, dfg_size, 0, GL_RG, GL_HALF_FLOAT, table.data());
}

// A unit that no sampler reads keeps the picture bound.
void make_target() {
  const GLuint picture = new_texture(dfg_unit + 1, GL_TEXTURE_2D);
  filter(GL_TEXTURE_2D, GL_NEAREST, GL_NEAREST);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
  GLuint framebuffer = 0, no_vertices = 0;
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture, 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw input_error("OpenGL: no picture of 32-bit floats to draw to");
  glGenVertexArrays(1, &no_vertices);
  glBindVertexArray(no_vertices);
  glViewport(0, 0, width, height);
}

void attach(GLuint program, GLenum kind, const std::string& source) {
  const GLuint shader = glCreateShader(kind);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
  GLint compiled = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  char log[2048] = "";
  glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  if (compiled == 0) throw input_error("OpenGL: a shader does not compile: {}", log);
}

}  // namespace

GlDeferred::GlDeferred(std::string folder, std::string shader) : folder_(std::move(folder)) {
  std::ifstream file(shader);
  if (!file) throw input_error("{}: cannot be opened", shader);
  std::stringstream text;
  text << file.rdbuf();
  shader_ = text.str();
  upload_gbuffer(folder_);
  upload_surroundings(folder_);
  make_target();
}

void GlDeferred::use_lights(const std::string& count) {
  const auto records = read_array<float>(folder_ + "/lights_" + count + ".f32");
  program_ = glCreateProgram();
  attach(program_, GL_VERTEX_SHADER, vertex_shader);
  attach(program_, GL_FRAGMENT_SHADER,
         "#version 330 core\n#define LIGHTS " + std::to_string(records.size() / 8) + "\n" + shader_);
  glLinkProgram(program_);
  GLint linked = 0;
  glGetProgramiv(program_, GL_LINK_STATUS, &linked);
  if (linked == 0) throw input_error("OpenGL: the shaders do not link");
  glUseProgram(program_);
  set_uniforms(records);
}

void GlDeferred::set_uniforms(const std::vector<float>& records) const {
  const auto location = [&](const char* name) { return glGetUniformLocation(program_, name); };
  for (GLint unit = 0; unit < GLint(std::size(sampler_names)); ++unit) glUniform1i(location(sampler_names[unit]), unit);
  glUniform3fv(location("eye"), 1, read_array<float>(folder_ + "/camera.f32").data());
  glUniform3fv(location("irradiance"), 9, read_array<float>(folder_ + "/sh9.f32").data());
  std::vector<float> lights = records;
  for (std::size_t i = 3; i < lights.size(); i += 8) lights[i] = 1 / (lights[i] * lights[i]);
  glUniform4fv(location("lights"), GLsizei(lights.size() / 4), lights.data());
}

void GlDeferred::draw() const {
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glFinish();
}

std::vector<float> GlDeferred::read() const {
  std::vector<float> picture(std::size_t{4} * width * height);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, picture.data());
  if (glGetError() != GL_NO_ERROR) throw input_error("OpenGL: an error while drawing");
  return picture;
}

}  // namespace tessera::peers
