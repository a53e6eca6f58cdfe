#include "base/progress.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace tessera {
namespace {

std::string drawn(Progress::Show show, std::chrono::milliseconds length) {
  testing::internal::CaptureStderr();
  {
    Progress progress(show);
    progress.begin("kneading");
    progress.set_fraction(1, 2);
    std::this_thread::sleep_for(length);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, LongJobsAreDrawnAndErased) {
  const std::string text = drawn(Progress::Show::always, std::chrono::milliseconds(1300));
  EXPECT_NE(text.find("kneading [###############---------------]  50 %"), std::string::npos) << text;
  const std::string erase = "\r\033[K";
  ASSERT_GE(text.size(), erase.size());
  EXPECT_EQ(text.substr(text.size() - erase.size()), erase);
}

TEST(Progress, ShortJobsAndOtherThanTerminalsAreNot) {
  EXPECT_EQ(drawn(Progress::Show::always, std::chrono::milliseconds(1)), "");
  EXPECT_EQ(drawn(Progress::Show::on_terminal, std::chrono::milliseconds(1300)), "");  // a pipe or file here
}

}  // namespace
}  // namespace tessera
