#include "base/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace tessera {
namespace {

constexpr std::chrono::milliseconds first_draw{1000}, draw_interval{100};
constexpr std::size_t bar_width = 30;

}  // namespace

Progress::Progress(Show show) {
  if (show == Show::always || (show == Show::on_terminal && isatty(STDERR_FILENO) == 1))
    drawer_ = std::thread([this] { draw_until_finished(); });
}

Progress::~Progress() { finish(); }

void Progress::begin(std::string_view stage, std::size_t total) {
  const std::lock_guard lock(mutex_);
  stage_ = stage;
  total_ = total;
  done_.store(0, std::memory_order_relaxed);
}

void Progress::draw_until_finished() {
  std::unique_lock lock(mutex_);
  if (changed_.wait_for(lock, first_draw, [this] { return finished_; })) return;
  do draw();
  while (!changed_.wait_for(lock, draw_interval, [this] { return finished_; }));
  std::fputs("\r\033[K", stderr);
}

void Progress::draw() const {
  if (total_ == 0) {
    std::fprintf(stderr, "\r\033[K%s ...", stage_.c_str());
  } else {
    const std::size_t done = std::min(done_.load(std::memory_order_relaxed), total_);
    const std::size_t filled = bar_width * done / total_;
    const std::string bar = std::string(filled, '#') + std::string(bar_width - filled, '-');
    std::fprintf(stderr, "\r\033[K%s [%s] %3zu %%", stage_.c_str(), bar.c_str(), 100 * done / total_);
  }
  std::fflush(stderr);
}

void Progress::finish() {
  {
    const std::lock_guard lock(mutex_);
    finished_ = true;
  }
  changed_.notify_all();
  if (drawer_.joinable()) drawer_.join();
}

}  // namespace tessera
