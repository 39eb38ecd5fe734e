#include "tracer/polarized_bsdf/hdf5_reader.h"

#include <array>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/leaks_allowed.h"
#include "tracer/polarized_bsdf/hdf5_writer.h"

namespace evenglow::tracer {
namespace {

using testing::HasSubstr;

std::string sample() {
  const std::vector<double> values{1, 2, 3, 4, 5, 6};
  Hdf5Writer writer;
  writer.text("", "title", "a film");
  writer.integer("", "version", 1);
  writer.numbers("values", std::array<std::size_t, 2>{2, 3}, std::array<std::size_t, 2>{2, 3}, values);
  return writer.bytes();
}

/// The same as another program would write it: without our user block.
std::string foreign(const std::string& bytes) {
  return bytes.substr(512);
}

template <typename Read>
std::string fault(Read&& read) {
  try {
    read();
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Hdf5Reader, TellsWhatIsThere) {
  const Hdf5Reader reader(sample(), "a.h5");
  EXPECT_EQ(reader.links(), 1u);
  EXPECT_TRUE(reader.has("values"));
  EXPECT_FALSE(reader.has("none"));
  EXPECT_EQ(reader.text("", "none"), std::nullopt);
  EXPECT_EQ(reader.integer("", "none"), std::nullopt);
  EXPECT_EQ(reader.numbers("values", 6), (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

TEST(Hdf5Reader, NamesFaultsWithFileAndPlace) {
  const Hdf5Reader reader(sample(), "a.h5");
  EXPECT_EQ(fault([&] { reader.numbers("values", 5); }), "a.h5: values: must hold 1 to 5 numbers, got more");
  EXPECT_EQ(fault([&] { reader.text("", "version"); }),
            "a.h5: version: must be a text, got an attribute of another type");
  EXPECT_EQ(fault([&] { reader.integer("", "title"); }),
            "a.h5: title: must be a whole number, got an attribute of another type");
  EXPECT_EQ(fault([&] { reader.shape("none"); }), "a.h5: none: must be a dataset, got a damaged one");
}

TEST(Hdf5Reader, RefusesChunksThatCouldBurst) {
  const std::vector<double> values(200000);  // zeros: a few hundred bytes when compressed
  Hdf5Writer writer;
  writer.numbers("a", std::array{values.size()}, std::array{values.size()}, values);
  const Hdf5Reader reader(writer.bytes(), "a.h5");
  EXPECT_THAT(fault([&] { reader.numbers("a", 1u << 20); }), HasSubstr("a.h5: a: must have chunks of at most 1 MiB"));
}

TEST(Hdf5Reader, RefusesBytesThatAreNoFile) {
  EXPECT_THAT(fault([] { Hdf5Reader("text", "a.h5"); }), HasSubstr("a.h5: must be an HDF5 file"));
  const std::string bytes = sample(), other = foreign(bytes);
  EXPECT_THAT(fault([&] { Hdf5Reader(other.substr(0, other.size() / 2), "a.h5"); }), HasSubstr("must be a whole HDF5"));
  for (const std::size_t size :
       {std::size_t{60}, std::size_t{511}, std::size_t{512}, bytes.size() / 2, bytes.size() - 1}) {
    EXPECT_EQ(fault([&] { Hdf5Reader(bytes.substr(0, size), "a.h5"); }),
              "a.h5: must have the SHA-256 that its first line tells, got another (cut short, damaged or edited)");
  }
}

TEST(Hdf5Reader, RefusesEveryChangeOfAFileWithItsChecksum) {
  const std::string good = sample();
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bytes = good;
    bytes[i] = static_cast<char>(bytes[i] ^ (1 << i % 8));
    const std::string text = fault([&] { Hdf5Reader(bytes, "a.h5"); });
    ASSERT_THAT(text, testing::AnyOf(HasSubstr("SHA-256"), HasSubstr("must be an HDF5 file"))) << "byte " << i;
  }
  EXPECT_THAT(fault([&] { Hdf5Reader(good + '\0', "a.h5"); }), HasSubstr("SHA-256"));
}

TEST(Hdf5Reader, ReadsFilesOfOtherProgramsAndFindsTheirDamage) {
  const tests::LeaksAllowed leaks;  // HDF5 1.10.8 leaks some bytes of a header that it refuses
  const std::string good = foreign(sample());
  EXPECT_EQ(Hdf5Reader(good, "a.h5").numbers("values", 6), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  int found = 0;
  for (std::size_t i = 48; i < good.size(); i += 7) {
    std::string bytes = good;
    bytes[i] = static_cast<char>(bytes[i] ^ 0x55);
    const std::string text = fault([&] {
      const Hdf5Reader reader(bytes, "a.h5");
      EXPECT_TRUE(reader.has("values"));
      EXPECT_EQ(reader.numbers("values", 6), (std::vector<double>{1, 2, 3, 4, 5, 6}));
    });
    if (text != "accepted") ++found;
  }
  EXPECT_GT(found, 20);
}

/// Many datasets: the library keeps their names in a heap outside the header of the group. It crashed in the
/// reading of damaged ones when the names were asked for by index.
TEST(Hdf5Reader, ADamagedHeapOfNamesDoesNotCrash) {
  const tests::LeaksAllowed leaks;
  Hdf5Writer writer;
  for (int i = 0; i < 60; ++i)
    writer.numbers("values" + std::to_string(i), std::array<std::size_t, 1>{1}, {}, std::array{1.0});
  const std::string good = foreign(writer.bytes());
  int found = 0;
  for (std::size_t i = 48; i < good.size(); i += 11) {
    std::string bytes = good;
    bytes[i] = static_cast<char>(bytes[i] ^ 0x55);
    const std::string text = fault([&] {
      const Hdf5Reader reader(bytes, "a.h5");
      EXPECT_EQ(reader.links(), 60u);
      for (int k = 0; k < 60; ++k) EXPECT_TRUE(reader.has("values" + std::to_string(k)));
    });
    if (text != "accepted") ++found;
  }
  EXPECT_GT(found, 20);
}

}  // namespace
}  // namespace evenglow::tracer
