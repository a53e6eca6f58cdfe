#include "base/interrupt.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <cstring>
#include <utility>

namespace tessera {
namespace {

// A signal handler may neither lock nor allocate: fixed slots, claimed by an atomic.
enum SlotState : int { slot_free, slot_claimed, slot_guarded };
struct Slot {
  std::atomic<int> state{slot_free};
  char path[PATH_MAX];
};
std::array<Slot, 8> slots;
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void remove_guarded_files(int signal) {
  for (const Slot& slot : slots)
    if (slot.state.load(std::memory_order_acquire) == slot_guarded) unlink(slot.path);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void remove_guarded_files_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    // A parent that ignores a signal (nohup) wants it ignored.
    if (std::signal(signal, remove_guarded_files) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

FileGuard::FileGuard(const std::string& path) {
  if (path.size() >= PATH_MAX) return;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    int expected = slot_free;
    if (!slots[i].state.compare_exchange_strong(expected, slot_claimed)) continue;
    std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
    slots[i].state.store(slot_guarded, std::memory_order_release);
    slot_ = static_cast<int>(i);
    return;
  }
}

FileGuard& FileGuard::operator=(FileGuard&& other) noexcept {
  if (this != &other) {
    release();
    slot_ = std::exchange(other.slot_, -1);
  }
  return *this;
}

void FileGuard::release() {
  if (slot_ >= 0) slots[static_cast<std::size_t>(slot_)].state.store(slot_free, std::memory_order_release);
  slot_ = -1;
}

}  // namespace tessera
