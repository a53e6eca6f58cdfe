// The program as a whole: help, version, and exit statuses for wrong usage.
#include <gtest/gtest.h>

#include "program.hpp"

namespace tessera::cli_test {
namespace {

using testing::Test;

// One line that begins as every error does; a person must be able to read it.
void expect_one_error_line(const Result& result, const std::string& must_contain) {
  EXPECT_EQ(result.err.rfind("tessera: error: ", 0), 0u) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find(must_contain), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
}

TEST(Program, HelpNamesEveryCommandAndTeaches) {
  const Result help = run({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.err, "");
  for (const char* word : {"render", "shade", "info", "isa", "chart", "Examples", "--version"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
}

TEST(Program, HelpOfRenderHasEveryOptionAndTheConventions) {
  const Result help = run({"render", "--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* word : {"--size",         "--camera",        "--eye",     "--target",        "--up",         "--fov",
                           "--orbit",        "--exposure",      "--tonemap", "khronos-neutral", "--background", "--env",
                           "--env-rotation", "--env-intensity", "--light",   "--samples",       "--threads",    "--isa",
                           "--aov",          "--stats",         "--quiet",   "atan2(z, x)",     "acos(y)",      "+X",
                           "OpenEXR",        "candela",         "lux",       "gbuffer"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
}

TEST(Program, HelpOfShadeNamesTheLayers) {
  const Result help = run({"shade", "--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* word : {"position.X", "normal.Z", "albedo.R", "roughness", "metallic", "coverage_mask", "--eye"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
}

TEST(Program, VersionIsOneLine) {
  const Result version = run({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.rfind("tessera ", 0), 0u);
  EXPECT_EQ(version.out.back(), '\n');
}

struct Misuse {
  const char* name;
  std::vector<std::string> arguments;
  std::string must_contain;
};
void PrintTo(const Misuse& misuse, std::ostream* out) { *out << misuse.name; }

class WrongUsage : public testing::TestWithParam<Misuse> {};

TEST_P(WrongUsage, EndsInStatus2AndOneLine) {
  const Result result = run(GetParam().arguments);
  EXPECT_EQ(result.status, 2);
  expect_one_error_line(result, GetParam().must_contain);
}

// None of these reaches the scene, so that none has to exist.
INSTANTIATE_TEST_SUITE_P(
    Cases, WrongUsage,
    testing::Values(
        Misuse{"nothing", {}, "command"}, Misuse{"unknown_command", {"paint"}, "paint"},
        Misuse{"unknown_option", {"render", "a.glb", "-o", "/tmp/a.png", "--shiny"}, "--shiny"},
        Misuse{"no_output", {"render", "a.glb"}, "--output"},
        Misuse{"unknown_ending", {"render", "a.glb", "-o", "a.jpg"}, ".png or .exr"},
        Misuse{"size", {"render", "a.glb", "-o", "/tmp/a.png", "--size", "640"}, "WIDTHxHEIGHT"},
        Misuse{"size_zero", {"render", "a.glb", "-o", "/tmp/a.png", "--size", "0x10"}, "16384"},
        Misuse{"size_huge", {"render", "a.glb", "-o", "/tmp/a.png", "--size", "99999x10"}, "16384"},
        Misuse{"samples", {"render", "a.glb", "-o", "/tmp/a.png", "--samples", "3"}, "1, 2, 4, 8 or 16"},
        Misuse{"tonemap", {"render", "a.glb", "-o", "/tmp/a.png", "--tonemap", "film"}, "khronos-neutral"},
        Misuse{"background", {"render", "a.glb", "-o", "/tmp/a.png", "--background", "blue"}, "#rrggbb"},
        Misuse{"background_hex", {"render", "a.glb", "-o", "/tmp/a.png", "--background", "#12345"}, "hexadecimal"},
        Misuse{"blur", {"render", "a.glb", "-o", "/tmp/a.png", "--background-blur", "2"}, "0 to 1"},
        Misuse{"exposure", {"render", "a.glb", "-o", "/tmp/a.png", "--exposure", "bright"}, "bright"},
        Misuse{"aov", {"render", "a.glb", "-o", "/tmp/a.exr", "--aov", "depth,smell"}, "smell"},
        Misuse{"aov_nowhere", {"render", "a.glb", "-o", "-", "--aov", "depth"}, "file of their own"},
        Misuse{"isa", {"render", "a.glb", "-o", "/tmp/a.png", "--isa", "mmx"}, "mmx"},
        Misuse{"threads", {"render", "a.glb", "-o", "/tmp/a.png", "--threads", "-1"}, "--threads"},
        Misuse{"orbit_and_eye", {"render", "a.glb", "-o", "/tmp/a.png", "--orbit", "1,2", "--eye", "1,2,3"}, "--eye"},
        Misuse{"target_alone", {"render", "a.glb", "-o", "/tmp/a.png", "--target", "1,2,3"}, "--eye"},
        Misuse{"light_kind", {"render", "a.glb", "-o", "/tmp/a.png", "--light", "sun:1"}, "point, directional or spot"},
        Misuse{
            "light_fields", {"render", "a.glb", "-o", "/tmp/a.png", "--light", "point:1,2,3"}, "point:x,y,z:candela"},
        Misuse{"light_number", {"render", "a.glb", "-o", "/tmp/a.png", "--light", "point:1,2,z:5"}, "'z'"},
        Misuse{"light_nan", {"render", "a.glb", "-o", "/tmp/a.png", "--light", "point:1,2,nan:5"}, "'nan'"},
        Misuse{"light_direction", {"render", "a.glb", "-o", "/tmp/a.png", "--light", "directional:0,0,0:5"}, "length"},
        Misuse{"light_cone", {"render", "a.glb", "-o", "/tmp/a.png", "--light", "spot:0,0,0:0,0,1:5:40,20"}, "inner"},
        Misuse{"isa_command", {"isa", "--isa", "mmx"}, "mmx"}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(Program, FullStandardOutputIsStatus4) {
  const Folder folder;
  const std::string command = std::string(TESSERA_PROGRAM) + " isa > /dev/full 2> " + folder.path("err");
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 4);
  EXPECT_EQ(read_file(folder.path("err")).rfind("tessera: error: ", 0), 0u);
}

}  // namespace
}  // namespace tessera::cli_test
