// Arrays that kernels read and write: 64-byte aligned, so that a plane starts on a cache line; large ones on huge
// pages, where the system gives them to those who ask.
#pragma once
#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace tessera {

template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::size_t huge_page = std::size_t{1} << 21;
  static constexpr std::size_t most = PTRDIFF_MAX / sizeof(T) - huge_page;
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  static std::align_val_t alignment(std::size_t n) {
    return std::align_val_t{n * sizeof(T) >= 2 * huge_page ? huge_page : 64};
  }
  T* allocate(std::size_t n) {
    if (n * sizeof(T) < 2 * huge_page) return static_cast<T*>(::operator new(n * sizeof(T), alignment(n)));
    if (n > most) throw std::bad_array_new_length();
    const std::size_t bytes = (n * sizeof(T) + huge_page - 1) / huge_page * huge_page;  // the last page is one, too
    void* p = ::operator new(bytes, alignment(n));
    madvise(p, bytes, MADV_HUGEPAGE);  // a wish: no matter if it fails
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t n) { ::operator delete(p, alignment(n)); }
  bool operator==(const AlignedAllocator&) const { return true; }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

/// The same for memory that is always written before it is read: resize() leaves new elements as they are.
template <class T>
struct ScratchAllocator : AlignedAllocator<T> {
  template <class U>
  struct rebind {
    using other = ScratchAllocator<U>;
  };
  using value_type = T;
  ScratchAllocator() = default;
  template <class U>
  ScratchAllocator(const ScratchAllocator<U>&) {}
  template <class U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Args>
  void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(static_cast<Args&&>(args)...);
  }
};

template <class T>
using ScratchVector = std::vector<T, ScratchAllocator<T>>;

}  // namespace tessera
