// SPDX-License-Identifier: MIT
#include "core/support/named_kind.h"

#include <gtest/gtest.h>

#include "tests/support/messages.h"

namespace minkray {
namespace {

enum class Colour { red, green, blue };

constexpr NamedKind<Colour> colours[] = {{Colour::red, "red", "long waves"},
                                         {Colour::green, "green", ""},
                                         {Colour::blue, "blue", "short"}};

TEST(NamedKinds, are_found_by_name_and_by_kind) {
  for (const NamedKind<Colour>& row : colours) {
    EXPECT_EQ(row_named(colours, row.name), &row);
    EXPECT_EQ(kind_named(colours, row.name), row.kind);
    EXPECT_EQ(name_in(colours, row.kind), row.name);
  }
  EXPECT_EQ(names_in(colours), (std::vector<std::string>{"red", "green", "blue"}));
  EXPECT_EQ(lines_of_help(colours), "\nred: long waves\ngreen: \nblue: short");
}

/// An unknown name had the first row's value.
TEST(NamedKinds, of_an_unknown_name_are_an_error_with_the_known_names) {
  for (const std::string name : {"", "Red", "re", "redd", "red ", "violet"}) {
    EXPECT_EQ(row_named(colours, name), nullptr) << name;
    EXPECT_EQ(message_of<std::invalid_argument>([&] { kind_named(colours, name); }),
              "must be one of red, green, blue (got " + name + ")");
  }
}

}  // namespace
}  // namespace minkray
