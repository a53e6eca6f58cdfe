// A large file of records, read in pieces by all threads.
#pragma once
#include <cstddef>
#include <string>

#include "base/parallel.hpp"

namespace tessera::workload {

class BulkFile {
 public:
  /// An input error if it cannot be opened or does not hold whole records.
  BulkFile(std::string path, std::size_t record_bytes);
  ~BulkFile();
  BulkFile(const BulkFile&) = delete;
  BulkFile& operator=(const BulkFile&) = delete;

  [[nodiscard]] std::size_t records() const { return records_; }
  void read(std::size_t first, std::size_t count, void* out) const;
  /// body(first, count) over all records, on all threads.
  template <class Body>
  void for_each_piece(const Body& body) const {
    const std::size_t piece = (std::size_t{1} << 18) / record_bytes_ + 1;
    parallel_for((records_ + piece - 1) / piece, [&](std::size_t i) {
      const std::size_t first = i * piece;
      body(first, first + piece <= records_ ? piece : records_ - first);
    });
  }

 private:
  std::string path_;
  std::size_t record_bytes_, records_ = 0;
  int descriptor_;
};

}  // namespace tessera::workload
