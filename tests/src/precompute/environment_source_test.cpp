#include "precompute/environment_source.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.hpp"
#include "frame/dispatch.hpp"
#include "precompute/environment.hpp"
#include "src/precompute/cube_texels.hpp"

namespace tessera::test {
namespace {

constexpr int n = 4;

// Says of each texel of a cube where it is: face, column, row.
Image face_image(int face) {
  Image image(n, n, 3);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      image.at(i, j)[0] = float(face);
      image.at(i, j)[1] = float(i);
      image.at(i, j)[2] = float(j);
    }
  return image;
}

void paste(const Image& from, Image& to, int column, int row, bool turned = false) {
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      std::copy_n(from.at(turned ? n - 1 - i : i, turned ? n - 1 - j : j), 3, to.at(column * n + i, row * n + j));
}

void expect_faces_in_order(const EnvironmentPicture& picture) {
  ASSERT_TRUE(picture.faces);
  ASSERT_EQ(picture.face_size(), n);
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const float* texel = picture.image.at(i, face * n + j);
        EXPECT_EQ(texel[0], float(face));
        EXPECT_EQ(texel[1], float(i));
        EXPECT_EQ(texel[2], float(j));
      }
}

TEST(EnvironmentSource, EveryLayoutGivesTheSameFaces) {
  std::array<Image, 6> faces;
  for (int f = 0; f < 6; ++f) faces[std::size_t(f)] = face_image(f);
  expect_faces_in_order(arrange_faces(faces, {"a", "b", "c", "d", "e", "f"}));

  Image strip(6 * n, n, 3), column(n, 6 * n, 3), cross(4 * n, 3 * n, 3), upright(3 * n, 4 * n, 3);
  for (int f = 0; f < 6; ++f) {
    paste(faces[std::size_t(f)], strip, f, 0);
    paste(faces[std::size_t(f)], column, 0, f);
  }
  const int places[6][2] = {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}};
  for (std::size_t f = 0; f < 6; ++f) {
    paste(faces[f], cross, places[f][0], places[f][1]);
    if (f < 5) paste(faces[f], upright, places[f][0], places[f][1]);
  }
  paste(faces[5], upright, 1, 3, true);
  for (const Image& image : {strip, column, cross, upright})
    expect_faces_in_order(arrange(image, EnvironmentLayout::automatic, "x"));
}

// In a cross, neighbours on the paper are neighbours on the sphere: each seam's texels lie close together.
TEST(EnvironmentSource, CrossesFoldWithoutSeams) {
  const struct {
    int from, i, j, to, k, l;
  } seams[] = {{1, n - 1, 1, 4, 0, 1}, {4, n - 1, 1, 0, 0, 1}, {0, n - 1, 1, 5, 0, 1},
               {2, 1, n - 1, 4, 1, 0}, {4, 1, n - 1, 3, 1, 0}, {3, 1, n - 1, 5, n - 2, n - 1}};
  for (const auto& s : seams)
    EXPECT_GT(dot(texel_centre(s.from, s.i, s.j, n), texel_centre(s.to, s.k, s.l, n)), 0.85) << s.from << " " << s.to;
}

// A cube of faces is looked up where its faces say; turned, where the rotation takes it.
TEST(EnvironmentSource, FacesAreWhereTheySay) {
  for (int face = 0; face < 6; ++face) {
    Image strip(64, 6 * 64, 3);
    strip.at(40, face * 64 + 20)[1] = 100;
    EnvironmentSettings settings;
    settings.samples = 4;
    for (const float rotation : {0.0f, 0.7f}) {
      settings.rotation = rotation;
      const Environment environment =
          build_environment(arrange(strip, EnvironmentLayout::vertical_strip, "x"), settings, select_kernels());
      const CubeView cube = environment.view().background;
      Unit centre{0, 0, 0};
      double energy = 0;
      for_each_texel(cube.size, [&](int f, int i, int j) {
        const Unit d = texel_centre(f, i, j, cube.size);
        const double weight = texel_value(cube, 0, f, i, j, 1) * texel_solid_angle(i, j, cube.size);
        centre = {centre.x + weight * d.x, centre.y + weight * d.y, centre.z + weight * d.z};
        energy += weight;
      });
      const Unit seen = texel_centre(face, 40, 20, 64);
      const double c = std::cos(double(rotation)), s = std::sin(double(rotation));
      const Unit expected{seen.x * c + seen.z * s, seen.y, seen.z * c - seen.x * s};
      EXPECT_GT(dot(centre, expected) / std::sqrt(dot(centre, centre)), std::cos(0.01)) << face << " " << rotation;
      EXPECT_NEAR(energy / (100 * texel_solid_angle(40, 20, 64)), 1, 0.05);
      if (rotation == 0) {
        EXPECT_EQ(texel_value(cube, 0, face, 40, 20, 1), 100);  // copied, not filtered
      }
    }
  }
}

TEST(EnvironmentSource, WhiteFacesStayWhite) {
  Image strip(10, 60, 1);
  std::fill(strip.pixels.begin(), strip.pixels.end(), 1.0f);
  EnvironmentSettings settings;
  settings.rotation = 0.3f;
  settings.irradiance = IrradianceForm::cube;
  const Environment environment =
      build_environment(arrange(strip, EnvironmentLayout::automatic, "x"), settings, select_kernels());
  const EnvironmentView view = environment.view();
  for (const CubeView& cube : {view.background, view.specular, view.irradiance})
    for (int level = 0; level < cube.levels; ++level)
      for_each_texel(cube.size >> level,
                     [&](int face, int i, int j) { ASSERT_NEAR(texel_value(cube, level, face, i, j, 0), 1, 1e-3); });
  EXPECT_NEAR(view.irradiance_sh[0][0], 1, 1e-6);
}

TEST(EnvironmentSource, WrongProportionsAreNamed) {
  const Image image(12, 10, 3);
  EXPECT_FALSE(arrange(image, EnvironmentLayout::automatic, "x").faces);
  for (const auto layout : {EnvironmentLayout::horizontal_cross, EnvironmentLayout::vertical_cross,
                            EnvironmentLayout::horizontal_strip, EnvironmentLayout::vertical_strip})
    EXPECT_THROW(arrange(image, layout, "x"), Error);
  EXPECT_THROW(parse_layout("ball", 4, 3), Error);
  std::array<Image, 6> faces;
  for (Image& face : faces) face = Image(4, 4, 3);
  faces[3] = Image(4, 5, 3);
  EXPECT_THROW(arrange_faces(faces, {"a", "b", "c", "d", "e", "f"}), Error);
  faces[3] = Image(8, 8, 3);
  EXPECT_THROW(arrange_faces(faces, {"a", "b", "c", "d", "e", "f"}), Error);
}

}  // namespace
}  // namespace tessera::test
