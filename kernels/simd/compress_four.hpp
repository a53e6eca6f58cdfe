// How to move the lanes of a mask to the front by one shuffle of bytes, for vectors of four. Included by the vectors'
// own headers.
#pragma once

namespace tessera::TESSERA_ISA {
namespace {
namespace native {

// For each of the 16 masks, the bytes of the lanes that are set, ascending; zeros behind them.
struct CompressTable {
  std::uint8_t bytes[16][16] = {};
  constexpr CompressTable() {
    for (int set = 0; set < 16; ++set)
      for (int lane = 0, next = 0; lane < 4; ++lane)
        if (set >> lane & 1) {
          for (int b = 0; b < 4; ++b) bytes[set][4 * next + b] = static_cast<std::uint8_t>(4 * lane + b);
          ++next;
        }
  }
};
constexpr CompressTable compress_table;

}  // namespace native
}  // namespace
}  // namespace tessera::TESSERA_ISA
