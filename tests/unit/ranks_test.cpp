// Owns the claims about how many points a process is handed at once.
#include "results/journal/ranks.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace beltlife {
namespace {

TEST(Ranks, FewPointsAreSharedOutEvenlySoThatNobodyIsIdle) {
  EXPECT_EQ(chunk_size(8, 2, 4), 4u);
  EXPECT_EQ(chunk_size(9, 2, 4), 5u);
  EXPECT_EQ(chunk_size(3, 8, 1), 1u);
}

TEST(Ranks, OfManyPointsAChunkFillsTheLanesOfAllThreads) {
  EXPECT_EQ(chunk_size(1000, 2, 1), 8u);
  EXPECT_EQ(chunk_size(1000, 2, 4), 32u);
  EXPECT_EQ(chunk_size(1000, 2, 0), 8u) << "threads as many as there are: at least one";
}

TEST(Ranks, AChunkIsNeverEmpty) { EXPECT_EQ(chunk_size(0, 4, 2), 1u); }

TEST(Ranks, AProgramStartedByItselfHasNone) {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"})
    if (std::getenv(name)) GTEST_SKIP() << "these tests run under a launcher";
  EXPECT_EQ(Ranks::join(), nullptr);
}

}  // namespace
}  // namespace beltlife
