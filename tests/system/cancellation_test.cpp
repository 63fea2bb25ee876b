// Who is cancelled by what.
#include "dspm/base/system/cancellation.h"

#include <gtest/gtest.h>

namespace dspm {
namespace {

using Loss = Cancellable::Loss;

struct Cancellation : testing::Test {
  Cancellation() { allow_work(); }
  ~Cancellation() override { allow_work(); }
};

bool stops(Loss loss) {
  const Cancellable cancellable(loss);
  return Cancellable::is_cancelled();
}

TEST_F(Cancellation, WorkThatMayLoseResultsIsOnlyDiscarded) {
  EXPECT_FALSE(stops(Loss::nothing));
  EXPECT_FALSE(stops(Loss::results));
  cancel_work();
  EXPECT_TRUE(stops(Loss::nothing));
  EXPECT_FALSE(stops(Loss::results));
  discard_work();
  EXPECT_TRUE(stops(Loss::nothing));
  EXPECT_TRUE(stops(Loss::results));
  cancel_work();  // later, and takes nothing back
  EXPECT_TRUE(stops(Loss::results));
  EXPECT_FALSE(Cancellable::is_cancelled()) << "nothing that may be cancelled is going on";
  allow_work();
  EXPECT_FALSE(stops(Loss::nothing));
}

}  // namespace
}  // namespace dspm
