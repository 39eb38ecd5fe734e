#include "tracer/polarized_bsdf/hdf5_writer.h"

#include <array>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/sha256.h"
#include "tracer/polarized_bsdf/hdf5_reader.h"

namespace evenglow::tracer {
namespace {

TEST(Hdf5Writer, WhatIsWrittenIsRead) {
  std::vector<double> values(24);
  std::iota(values.begin(), values.end(), 0.1);
  Hdf5Writer writer;
  writer.text("", "title", "two \xC2\xB5m\nlines");
  writer.integer("", "version", -3);
  writer.numbers("box", std::array<std::size_t, 3>{2, 3, 4}, std::array<std::size_t, 3>{1, 3, 2}, values);
  writer.numbers("line", std::array<std::size_t, 1>{24}, {}, values);
  writer.text("box", "unit", "1/sr");
  const Hdf5Reader reader(writer.bytes(), "a.h5");
  EXPECT_EQ(reader.links(), 2u);
  EXPECT_TRUE(reader.has("box"));
  EXPECT_TRUE(reader.has("line"));
  EXPECT_EQ(reader.text("", "title"), "two \xC2\xB5m\nlines");
  EXPECT_EQ(reader.integer("", "version"), -3);
  EXPECT_EQ(reader.text("box", "unit"), "1/sr");
  EXPECT_EQ(reader.text("line", "unit"), std::nullopt);
  EXPECT_EQ(reader.shape("box"), (std::vector<std::size_t>{2, 3, 4}));
  EXPECT_EQ(reader.numbers("box", 24), values);
  EXPECT_EQ(reader.numbers("line", 24), values);
}

TEST(Hdf5Writer, HoldsWhatIsLargerThanItsFirstMemory) {
  std::vector<double> values(300000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i * 2654435761u % 1000003);
  Hdf5Writer writer;
  writer.numbers("a", std::array{values.size()}, {}, values);
  EXPECT_EQ(Hdf5Reader(writer.bytes(), "a.h5").numbers("a", values.size()), values);
}

TEST(Hdf5Writer, BeginsWithTheChecksumOfTheRest) {
  Hdf5Writer writer;
  writer.text("", "title", "a film");
  const std::string bytes = writer.bytes();
  std::string block = "Evenglow HDF5, SHA-256 of all after byte 512: " + core::sha256_hex(bytes.substr(512)) + "\n";
  block.resize(512, '\0');
  EXPECT_EQ(bytes.substr(0, 512), block);
  EXPECT_EQ(bytes.substr(512, 8), std::string("\x89HDF\r\n\x1a\n"));
}

TEST(Hdf5Writer, SeveralAtATimeDoNotMeet) {
  Hdf5Writer one, two;
  one.text("", "name", "one");
  two.text("", "name", "two");
  const Hdf5Reader first(one.bytes(), "same.h5"), second(two.bytes(), "same.h5");
  EXPECT_EQ(first.text("", "name"), "one");
  EXPECT_EQ(second.text("", "name"), "two");
}

TEST(Hdf5Writer, SaysWhatItCannotWrite) {
  Hdf5Writer writer;
  const std::vector<double> values(4);
  writer.numbers("a", std::array<std::size_t, 1>{4}, {}, values);
  EXPECT_THROW(writer.numbers("a", std::array<std::size_t, 1>{4}, {}, values), core::Error) << "the name is taken";
  EXPECT_THROW(writer.text("none", "unit", "m"), core::Error);
}

}  // namespace
}  // namespace evenglow::tracer
