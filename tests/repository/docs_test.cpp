// SPDX-License-Identifier: MIT
// The documents and lists of files: what they point at is there, and nothing is left out.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "tests/support/messages.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

/// A page without its blocks of code, in which brackets make no links.
std::string without_code(const std::string& page) {
  std::string text;
  for (std::size_t from = 0; from != std::string::npos;) {
    const std::size_t begin = page.find("```", from);
    text += page.substr(from, begin - from);
    const std::size_t end = begin == std::string::npos ? begin : page.find("```", begin + 3);
    from = end == std::string::npos ? end : end + 3;
  }
  return text;
}

TEST(Docs, every_link_to_a_file_leads_to_one) {
  std::vector<SourceFile> pages = files_in("docs");
  for (const char* name : {"README.md", "CHANGELOG.md", "core/README.md"})
    pages.push_back({name, text_of_file(source_folder() / name)});
  const std::regex link(R"re(\]\(([^)#\s]+)[^)]*\))re");
  std::size_t count = 0;
  for (const SourceFile& page : pages) {
    if (!page.name.ends_with(".md")) continue;
    const std::filesystem::path folder = (source_folder() / page.name).parent_path();
    const std::string text = without_code(page.text);
    for (std::sregex_iterator match(text.begin(), text.end(), link), end; match != end; ++match) {
      const std::string target = (*match)[1];
      if (target.starts_with("http")) continue;
      EXPECT_TRUE(std::filesystem::exists(folder / target)) << page.name << ": " << target;
      ++count;
    }
  }
  EXPECT_GT(count, 50u);  // the test has found the links
}

TEST(Docs, the_index_has_every_page) {
  const std::string index = text_of_file(source_folder() / "docs/README.md");
  std::size_t count = 0;
  for (const SourceFile& page : files_in("docs")) {
    if (!page.name.ends_with(".md") || page.name == "docs/README.md") continue;
    EXPECT_TRUE(has(index, "](" + page.name.substr(5) + ")"))
        << page.name << " is not in docs/README.md";
    ++count;
  }
  EXPECT_GT(count, 25u);
}

/// True if a CMakeLists.txt of its own folder, or of one above, names the file.
bool is_built(const std::filesystem::path& file) {
  for (auto folder = file.parent_path(); !folder.empty(); folder = folder.parent_path()) {
    const std::filesystem::path list = source_folder() / folder / "CMakeLists.txt";
    if (std::filesystem::exists(list) &&
        text_of_file(list).find(' ' + file.lexically_relative(folder).string()) !=
            std::string::npos)
      return true;
  }
  return false;
}

TEST(Docs, every_source_of_tests_is_built) {
  std::size_t count = 0;
  for (const SourceFile& file : files_in("tests")) {
    if (!file.name.ends_with("_test.cpp")) continue;
    EXPECT_TRUE(is_built(file.name)) << file.name << " is in no CMakeLists.txt: nobody runs it";
    ++count;
  }
  EXPECT_GT(count, 150u);
}

TEST(Docs, every_file_that_contributing_names_is_there) {
  const std::string text = text_of_file(source_folder() / "docs/contributing.md");
  const std::regex file(R"re(`([\w.-]+(/[\w.-]+)+)`)re");
  std::size_t count = 0;
  for (std::sregex_iterator match(text.begin(), text.end(), file), end; match != end; ++match) {
    EXPECT_TRUE(std::filesystem::exists(source_folder() / (*match)[1].str()))
        << "there is no " << (*match)[1] << ", which docs/contributing.md names";
    ++count;
  }
  EXPECT_GT(count, 50u);  // the test has found the names
}

}  // namespace
}  // namespace minkray
