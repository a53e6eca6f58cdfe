#include <gtest/gtest.h>

#include "frame/dispatch.hpp"
#include "program.hpp"

namespace tessera::cli_test {
namespace {

TEST(Isa, ListsEverySetAndMarksOneAsChosen) {
  const Result result = run({"isa"});
  ASSERT_EQ(result.status, 0);
  for (const Kernels* table : built_kernels()) EXPECT_NE(result.out.find(table->isa), std::string::npos) << result.out;
  const std::size_t first = result.out.find("chosen");
  EXPECT_NE(first, std::string::npos);
  EXPECT_EQ(result.out.find("chosen", first + 1), std::string::npos);
}

TEST(Isa, ChoosesTheOneThatIsAskedFor) {
  for (const Kernels* table : built_kernels()) {
    if (!cpu_runs(*table)) continue;
    const Result result = run({"isa", "--isa", table->isa});
    ASSERT_EQ(result.status, 0);
    const std::size_t line = result.out.find(table->isa), chosen = result.out.find("chosen");
    EXPECT_EQ(result.out.find('\n', line), result.out.find('\n', chosen)) << result.out;
  }
}

}  // namespace
}  // namespace tessera::cli_test
