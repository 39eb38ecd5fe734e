#include "design/report/processor.h"

#include <sstream>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

std::string name_in(const std::string& text) {
  std::istringstream in(text);
  return processor_name(in);
}

TEST(Processor, IsTheFirstModelName) {
  EXPECT_EQ(name_in("processor\t: 0\nmodel name\t:  Chip A @ 3 GHz \nmodel name\t: B\n"), "Chip A @ 3 GHz");
}

TEST(Processor, IsTheBoardWhereCoresHaveNoName) {
  EXPECT_EQ(name_in("processor : 0\nModel\t\t: Board 5 Rev 1\n"), "Board 5 Rev 1");
}

TEST(Processor, IsEmptyWhereNothingIsTold) {
  EXPECT_EQ(name_in(""), "");
  EXPECT_EQ(name_in("no colon here\nmodel name"), "");
}

}  // namespace
}  // namespace evenglow::design
