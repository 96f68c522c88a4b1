// SPDX-License-Identifier: MIT
// Replacement of MPI in builds without it, which builds with it test as well: a program of its
// own, since the others use MPI's.
#include <gtest/gtest.h>

#include <cstdlib>

#include "renderer/base/errors.h"
#include "renderer/share/ranks.h"
#include "tests/support/messages.h"

namespace minkray {
namespace {

class RanksAlone : public ::testing::TestWithParam<const char*> {
 protected:
  ~RanksAlone() override { ::unsetenv(GetParam()); }
};

TEST_P(RanksAlone, are_one_if_no_launcher_says_otherwise) {
  for (const char* size : {"", "0", "1"}) {
    ::setenv(GetParam(), size, 1);
    const Ranks ranks;
    EXPECT_EQ(ranks.rank(), 0);
    EXPECT_EQ(ranks.count(), 1);
  }
}

TEST_P(RanksAlone, that_a_launcher_started_with_others_are_told_that_mpi_is_missing) {
  ::setenv(GetParam(), "4", 1);
  EXPECT_TRUE(has(message_of<WrongUsage>([&] { const Ranks ranks; }), "built without MPI"));
}

INSTANTIATE_TEST_SUITE_P(Launchers, RanksAlone,
                         ::testing::Values("OMPI_COMM_WORLD_SIZE", "PMI_SIZE"));

}  // namespace
}  // namespace minkray
