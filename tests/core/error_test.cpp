#include "isolux/core/error.h"

#include <gtest/gtest.h>

namespace isolux {
namespace {

TEST(InputError, NamesThePlaceAsFarAsKnown) {
  EXPECT_STREQ(InputError({"a.yaml", 3, 7}, "is wrong").what(), "a.yaml:3:7: is wrong");
  EXPECT_STREQ(InputError({"a.yaml"}, "is wrong").what(), "a.yaml: is wrong");
  EXPECT_STREQ(InputError({}, "is wrong").what(), "is wrong");
}

}  // namespace
}  // namespace isolux
