#include "design/report/writer_registry.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

TEST(WriterRegistry, WritesTheFormatsAskedFor) {
  const samples::Folder folder("registry");
  const auto has = [&](const char* name) { return std::filesystem::exists(folder.path() / "new" / name); };
  write_report(samples::report(), {"json", "csv"}, folder.path() / "new");
  EXPECT_TRUE(has("result.json"));
  EXPECT_TRUE(has("convergence.csv"));
  EXPECT_FALSE(has("report.html"));
  write_report(compare_reports("t", "c", {samples::report("a"), samples::report("b")}), output_formats(),
               folder.path() / "new");
  for (const char* name : {"compare.json", "compare.csv", "compare.png", "report.html", "maps.vti", "maps.h5"}) EXPECT_TRUE(has(name)) << name;
  for (const auto& file : std::filesystem::directory_iterator(folder.path() / "new")) {
    EXPECT_NE(file.path().extension(), ".part") << file.path();
  }
}

TEST(WriterRegistry, TwoRunsGiveTheSameBytes) {
  const samples::Folder folder("bytes");
  for (const char* run : {"a", "b"}) write_report(samples::report(), output_formats(), folder.path() / run);
  for (const auto& file : std::filesystem::directory_iterator(folder.path() / "a")) {
    EXPECT_EQ(samples::content(file.path()), samples::content(folder.path() / "b" / file.path().filename()))
        << file.path();
  }
}

TEST(WriterRegistry, KnowsItsFormats) {
  EXPECT_EQ(output_formats(), (std::vector<std::string>{"json", "csv", "png", "html", "vti", "hdf5"}));
  EXPECT_EQ(default_output_formats(), (std::vector<std::string>{"json", "csv", "png", "html"}));
  const samples::Folder folder("unknown");
  EXPECT_THROW(write_report(samples::report(), {"docx"}, folder.path()), core::Error);
}

TEST(WriterRegistry, NamesTheFolderItCannotMake) {
  const samples::Folder folder("blocked");
  std::ofstream(folder.path() / "file") << "x";
  EXPECT_THROW(write_report(samples::report(), {"json"}, folder.path() / "file" / "sub"), core::Error);
}

}  // namespace
}  // namespace evenglow::design
