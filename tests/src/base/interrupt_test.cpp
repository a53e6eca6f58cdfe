#include "base/interrupt.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

namespace tessera {
namespace {

class Interrupt : public testing::Test {
 protected:
  void SetUp() override {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "ThreadSanitizer holds signals back";
#endif
    std::ofstream(path) << "unfinished";
  }
  void TearDown() override { std::filesystem::remove(path); }
  const std::string path =
      (std::filesystem::temp_directory_path() / ("tessera-guard-" + std::to_string(getpid()))).string();
};

// The signal that ended a process in which `work` ran before it was sent one.
template <class Work>
int ended_by(int signal, const Work& work) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(signal, SIG_DFL);  // tests that run in the background of a script inherit that it is ignored
    remove_guarded_files_on_signals();
    work();
    std::raise(signal);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

TEST_F(Interrupt, GuardedFilesGoAndTheSignalStillEndsTheProgram) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::ofstream(path) << "unfinished";
    FileGuard guard;  // outlives the signal
    EXPECT_EQ(ended_by(signal, [&] { guard = FileGuard(path); }), signal);
    EXPECT_FALSE(std::filesystem::exists(path)) << signal;
  }
}

TEST_F(Interrupt, ReleasedFilesStay) {
  EXPECT_EQ(ended_by(SIGTERM,
                     [&] {
                       FileGuard guard(path);
                       guard.release();
                     }),
            SIGTERM);
  EXPECT_TRUE(std::filesystem::exists(path));
}

TEST_F(Interrupt, TheGuardMovesWithItsOwner) {
  FileGuard owner;
  EXPECT_EQ(ended_by(SIGTERM,
                     [&] {
                       FileGuard first(path);
                       owner = std::move(first);
                     }),
            SIGTERM);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(Interrupt, SlotsAreUsedAgain) {
  for (int i = 0; i < 1000; ++i) FileGuard guard(path);
  FileGuard last;
  EXPECT_EQ(ended_by(SIGTERM, [&] { last = FileGuard(path); }), SIGTERM);
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace tessera
