#include "core/base/sha256.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace evenglow::core {
namespace {

// Vectors of FIPS 180-4 / NIST's "Secure Hashing" examples, and of the empty text.
TEST(Sha256, GivesTheDigestsOfTheStandard) {
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(
      sha256_hex("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopqklmnopqrlmnopqrsm"
                 "nopqrstnopqrstu"),
      "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1");
}

TEST(Sha256, TakesAMillionBytes) {
  EXPECT_EQ(sha256_hex(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, CountsNulBytes) {
  EXPECT_EQ(sha256_hex(std::string(1, '\0')), "6e340b9cffb37a989ca544e6bb780a2c78901d3fb33738768511a30617afa01d");
}

TEST(Sha256, OfAFileIsThatOfItsBytes) {
  const tests::TempFolder folder;
  const std::string bytes = std::string(3000000, 'a') + '\0' + "end";  // more than is read at once
  tests::write_text(folder / "file", bytes);
  EXPECT_EQ(sha256_hex_of_file(folder / "file"), sha256_hex(bytes));
}

}  // namespace
}  // namespace evenglow::core
