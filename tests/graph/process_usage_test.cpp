#include "graph/process_usage.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace credo {
namespace {

// Blocks too small to be mapped each by itself, and between them some that stay.
TEST(ProcessUsage, FreeMemoryIsGivenBackThoughSomethingBetweenIsNot) {
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "not glibc's allocator";
#endif
  constexpr std::size_t kBlocks = 2000;
  constexpr std::size_t kBytes = 60'000;
  constexpr std::size_t kStays = 50;
  double const before_mb = resident_mb();
  std::vector<std::unique_ptr<std::vector<char>>> blocks;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    blocks.push_back(std::make_unique<std::vector<char>>(kBytes, 'x'));
  }
  double const full_mb = resident_mb();
  ASSERT_GT(full_mb, before_mb + 100.0);
  for (std::size_t i = 0; i < kBlocks; ++i) {
    if (i % kStays != kStays - 1) {
      blocks[i].reset();
    }
  }
  ASSERT_GT(resident_mb(), before_mb + 60.0) << "freed, and kept by the library";
  give_back_free_memory();
  EXPECT_LT(resident_mb(), before_mb + 30.0);
}

TEST(ProcessUsage, TheMostIsNoLessThanWhatIs) {
  EXPECT_GT(resident_mb(), 1.0);
  EXPECT_GE(peak_resident_mb(), resident_mb());
}

}  // namespace
}  // namespace credo
