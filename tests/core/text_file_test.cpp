#include "core/config/text_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/base/error.h"
#include "tests/support/temp_folder.h"

namespace evenglow::core {
namespace {

using ::testing::HasSubstr;
using tests::TempFolder;
using tests::write_text;

template <typename Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "nothing refused";
}

TEST(TextFile, GivesTheBytes) {
  const TempFolder folder;
  const std::string text(200'000, 'x');  // more than one read
  write_text(folder / "a.txt", text);
  EXPECT_EQ(read_text_file(folder / "a.txt"), text);
}

TEST(TextFile, RefusesWhatIsNoSmallFile) {
  const TempFolder folder;
  write_text(folder / "large.txt", std::string((1 << 20) + 1, 'x'));
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(refusal([&] { read_text_file(""); }), HasSubstr("got an empty name"));
  EXPECT_THAT(refusal([&] { read_text_file(folder / "none"); }), HasSubstr("cannot be opened: No such file"));
  EXPECT_THAT(refusal([&] { read_text_file(folder.path()); }), HasSubstr("must be a file, got a directory"));
  EXPECT_THAT(refusal([&] { read_text_file(folder / "pipe"); }), HasSubstr("got a pipe, socket or device"));
  EXPECT_THAT(refusal([&] { read_text_file(folder / "large.txt", 1 << 20); }),
              HasSubstr("must not be larger than 1 MiB, got 1.0 MiB"));
}

TEST(RequireText, TellsLineAndColumnOfTheFirstBadByte) {
  EXPECT_NO_THROW(require_text("good\n\xC3\xA9", "a.yaml"));
  EXPECT_THAT(refusal([] { require_text("one\ntwo\xFF", "a.yaml"); }),
              HasSubstr("a.yaml:2:4: must be UTF-8 text, got the byte 0xff"));
}

}  // namespace
}  // namespace evenglow::core
