// Views against glm's projection in double, and against rays.
#include "frame/view.hpp"

#include <gtest/gtest.h>

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "base/error.hpp"
#include "frame/dispatch.hpp"

namespace tessera {
namespace {

struct Window {
  double x, y, depth, w;
};

Window project(const ViewTransform& t, const glm::dvec3& p) {
  const auto row = [&](const float(&r)[4]) { return r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3]; };
  const double w = row(t.w);
  return {row(t.x) / w, row(t.y) / w, row(t.z) / w, w};
}

TEST(View, PerspectiveAgreesWithGlm) {
  Camera camera;
  camera.eye[0] = 3, camera.eye[1] = 2, camera.eye[2] = 5;
  camera.target[0] = -0.5, camera.target[1] = 0.25;
  camera.vertical_fov = 0.7;
  camera.near_plane = 0.1;
  const View view = make_view(camera, 640, 360, select_kernels());
  const glm::dmat4 glm_view = glm::lookAt(glm::dvec3(3, 2, 5), glm::dvec3(-0.5, 0.25, 0), glm::dvec3(0, 1, 0));
  const glm::dmat4 glm_projection = glm::infinitePerspective(0.7, 640.0 / 360.0, 0.1);
  for (const glm::dvec3& p :
       {glm::dvec3(0, 0, 0), glm::dvec3(1, -1, 0.5), glm::dvec3(-2, 1, -3), glm::dvec3(0.3, 0.9, 1)}) {
    const glm::dvec4 clip = glm_projection * glm_view * glm::dvec4(p, 1);
    const Window window = project(view.transform, p);
    EXPECT_NEAR(window.x, (clip.x / clip.w * 0.5 + 0.5) * 640, 1e-3);
    EXPECT_NEAR(window.y, (0.5 - clip.y / clip.w * 0.5) * 360, 1e-3);
    EXPECT_NEAR(window.depth, 0.1 / clip.w, 1e-6);
    // The ray of that pixel points at it.
    glm::dvec3 ray;
    for (int k = 0; k < 3; ++k) ray[k] = view.ray_corner[k] + window.x * view.ray_dx[k] + window.y * view.ray_dy[k];
    EXPECT_NEAR(glm::length(glm::cross(glm::normalize(ray), glm::normalize(p - glm::dvec3(3, 2, 5)))), 0, 1e-5);
  }
}

TEST(View, OrthographicSeesItsExtent) {
  Camera camera;
  camera.orthographic = true;
  camera.vertical_extent = 2;
  camera.eye[2] = 4;
  camera.near_plane = 1;
  camera.far_plane = 9;
  const View view = make_view(camera, 200, 100, select_kernels());
  const Window corner = project(view.transform, {4, 2, 3});
  EXPECT_NEAR(corner.x, 200, 1e-4);
  EXPECT_NEAR(corner.y, 0, 1e-4);
  EXPECT_NEAR(corner.depth, 1, 1e-6);
  EXPECT_NEAR(project(view.transform, {0, 0, -5}).depth, 0, 1e-6);
  EXPECT_EQ(view.transform.eye[3], 0);
  EXPECT_EQ(view.transform.eye[2], 1);
}

TEST(View, OrbitHoldsTheWholeSphere) {
  Bounds bounds;
  bounds.center[0] = 10, bounds.center[1] = -3;
  bounds.radius = 0.02;
  for (const double aspect : {0.4, 1.0, 2.5})
    for (const double pitch : {-1.57079632679, -0.4, 0.0, 1.2, 1.57079632679}) {
      const int height = 500, width = static_cast<int>(height * aspect);
      const Camera camera = orbit_camera(bounds, 0.8, pitch, 0, 0.7, aspect, select_kernels());
      const View view = make_view(camera, width, height, select_kernels());
      double nearest_edge = 1e9;
      for (int i = 0; i < 400; ++i) {  // points of a Fibonacci sphere
        const double z = 1 - (2 * i + 1) / 400.0, s = std::sqrt(1 - z * z), a = i * 2.399963229728653;
        const Window p = project(view.transform, {10 + 0.02 * s * std::cos(a), -3 + 0.02 * s * std::sin(a), 0.02 * z});
        EXPECT_LT(p.depth, 1.0001);
        nearest_edge = std::min({nearest_edge, p.x, width - p.x, p.y, height - p.y});
      }
      EXPECT_GT(nearest_edge, -0.5);
      EXPECT_LT(nearest_edge, 0.05 * std::min(width, height));
    }
}

TEST(View, RefusesWhatIsNoCamera) {
  Camera camera;
  for (int k = 0; k < 3; ++k) camera.target[k] = camera.eye[k];
  EXPECT_THROW(make_view(camera, 10, 10, select_kernels()), Error);
  camera = {};
  camera.vertical_fov = 3.2;
  EXPECT_THROW(make_view(camera, 10, 10, select_kernels()), Error);
  camera = {};
  camera.near_plane = 0;
  EXPECT_THROW(make_view(camera, 10, 10, select_kernels()), Error);
}

}  // namespace
}  // namespace tessera
