// The vocabulary of vectors on each instruction set that this CPU runs.
#pragma once
#include <string>
#include <vector>

#include "kernels/isa/vocabulary.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera {

#if defined(__x86_64__)
namespace sse42 {
extern const VocabularyTable vocabulary;
}
namespace avx2 {
extern const VocabularyTable vocabulary;
}
namespace avx512 {
extern const VocabularyTable vocabulary;
}
inline const VocabularyTable* const vocabulary_tables[] = {&sse42::vocabulary, &avx2::vocabulary, &avx512::vocabulary,
                                                           nullptr};
#else
namespace neon64 {
extern const VocabularyTable vocabulary;
}
inline const VocabularyTable* const vocabulary_tables[] = {&neon64::vocabulary, nullptr};
#endif

inline std::vector<const VocabularyTable*> runnable_vocabularies() {
  std::vector<const VocabularyTable*> tables;
  for (const Kernels* kernels : runnable_kernels())
    for (const VocabularyTable* const* table = vocabulary_tables; *table; ++table)
      if (std::string((*table)->isa) == kernels->isa) tables.push_back(*table);
  return tables;
}

}  // namespace tessera
