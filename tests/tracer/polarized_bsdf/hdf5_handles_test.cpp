#include <random>

#include <gtest/gtest.h>
#include <hdf5.h>

#include "core/base/error.h"
#include "tests/support/leaks_allowed.h"
#include "tests/support/temp_folder.h"
#include "tracer/polarized_bsdf/hdf5_table.h"
#include "tracer/polarized_bsdf/stored_table.h"

/// What stands behind `leak:libhdf5` in scripts/sanitizers/leaks.txt: the library's memory that is lost at a refusal is
/// held by no handle that the reader has left open.
namespace evenglow::tracer {
namespace {

long open_handles() {
  return static_cast<long>(H5Fget_obj_count(static_cast<hid_t>(H5F_OBJ_ALL), H5F_OBJ_ALL));
}

/// A good table with one to four bits turned, mostly in the heads at its beginning; each fifth is cut, too.
std::string damaged(const std::string& bytes, int which) {
  std::mt19937 random(static_cast<unsigned>(which));
  const auto below = [&](std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random); };
  std::string result = bytes;
  const std::size_t reach = which % 2 == 0 ? result.size() : std::min<std::size_t>(result.size(), 3000);
  for (std::size_t left = 1 + below(4); left > 0; --left) {
    char& byte = result[below(reach)];
    byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << below(8)));
  }
  if (which % 5 == 0) result.resize(1 + below(result.size()));
  return result;
}

TEST(Hdf5Handles, NoneIsLeftOpenByAFileThatIsRefused) {
  const tests::LeaksAllowed here;
  const std::string good = tests::file_text(std::string(EVENGLOW_SOURCE_DIR) + "/tests/app/faulty/tables/good.csv");
  // Without the user block, whose checksum would end the reading at once.
  const std::string bytes = hdf5_table_bytes(parse_csv_table(good, "good.csv")).substr(512);
  parse_hdf5_table(bytes, "good.h5");
  ASSERT_EQ(open_handles(), 0) << "after a good one";
  int refused = 0;
  for (int which = 0; which < 200; ++which) {
    try {
      parse_hdf5_table(damaged(bytes, which), "bad.h5");
    } catch (const core::Error&) {
      ++refused;
    }
    ASSERT_EQ(open_handles(), 0) << which;
  }
  EXPECT_GT(refused, 100) << "the test could not fail";
}

}  // namespace
}  // namespace evenglow::tracer
