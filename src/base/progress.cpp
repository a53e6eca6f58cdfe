#include "base/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace tessera {
namespace {

constexpr std::int64_t first_draw = 1000, draw_interval = 100;  // milliseconds
constexpr std::size_t bar_width = 30;

}  // namespace

Progress::Progress(Show show)
    : enabled_(show == Show::always || (show == Show::on_terminal && isatty(STDERR_FILENO) == 1)),
      next_draw_(first_draw) {}

Progress::~Progress() { finish(); }

std::int64_t Progress::milliseconds() const {
  return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - start_).count();
}

void Progress::begin(std::string_view stage, std::size_t total) {
  if (!enabled_) return;
  const std::lock_guard lock(drawing_);
  stage_ = stage;
  total_ = total;
  done_.store(0, std::memory_order_relaxed);
  const std::int64_t now = milliseconds();
  if (now >= first_draw) draw(now);
}

void Progress::advance(std::size_t steps) {
  if (!enabled_) return;
  done_.fetch_add(steps, std::memory_order_relaxed);
  const std::int64_t now = milliseconds();
  if (now < next_draw_.load(std::memory_order_relaxed)) return;
  const std::unique_lock lock(drawing_, std::try_to_lock);
  if (lock.owns_lock()) draw(now);
}

void Progress::draw(std::int64_t now) {
  next_draw_.store(now + draw_interval, std::memory_order_relaxed);
  drawn_ = true;
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
  const std::lock_guard lock(drawing_);
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

}  // namespace tessera
