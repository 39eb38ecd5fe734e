#include "design/report/batch_table.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

using ::testing::HasSubstr;

BatchTable sample() {
  BatchTable table{"a study", "0.1.0", "evenglow batch a.yaml", {}};
  BatchRow done{
      "p1_haze-0.8", "a.yaml", BatchStatus::kDone, "stopped, well", {{"films[0].haze", "0.8"}}, "ab12", {}, 3.5};
  done.final = {2000000, 0.11, {0.1, 0.001}, 0.9, 0.8, {1000.0, 3.0}, 1010.0, {0.5, 0.001}};
  BatchRow wrong{"p2", "a.yaml", BatchStatus::kWrongInput, "must lie in [0, 1], got \"3\"", {{"other", "[1, 2]"}}, "",
                 {},   0};
  table.rows = {done, wrong};
  return table;
}

TEST(BatchTable, ItsJsonReadsBack) {
  const BatchTable table = sample();
  const BatchTable read = read_batch_json(batch_json(table));
  ASSERT_EQ(read.rows.size(), 2u);
  EXPECT_EQ(batch_json(read), batch_json(table));
  EXPECT_EQ(read.rows[0].final.luminance_mean.se, 3.0);
  EXPECT_EQ(read.rows[1].status, BatchStatus::kWrongInput);
}

TEST(BatchTable, WhatIsNoNumberReadsBackAsSuch) {
  BatchTable table = sample();
  table.rows[0].final.uniformity_9 = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(read_batch_json(batch_json(table)).rows[0].final.uniformity_9));
}

TEST(BatchTable, WhatIsLeftFromAnEarlierBatchIsTold) {
  BatchTable table = sample();
  EXPECT_EQ(left_over_text(table), "");
  EXPECT_THAT(batch_html(table, "/nowhere"), ::testing::Not(HasSubstr("not of this batch")));
  table.left_over = {"p3", "<b>"};
  EXPECT_EQ(left_over_text(table), "not of this batch: p3, <b> (left from an earlier one)");
  EXPECT_THAT(batch_html(table, "/nowhere"), HasSubstr("not of this batch: p3, &lt;b&gt; (left"));
  EXPECT_EQ(read_batch_json(batch_json(table)).left_over, table.left_over);
  table.left_over.assign(25, "p");
  EXPECT_THAT(left_over_text(table), HasSubstr(", p and 5 more (left"));
}

TEST(BatchTable, OtherJsonIsRefused) {
  for (const char* text : {"", "{}", "[]", "{\"format\": \"evenglow-batch/2\"}", "{\"format\": 3}",
                           "{\"format\": \"evenglow-batch/1\", \"version\": \"\", \"title\": \"\", \"command\": \"\", "
                           "\"runs\": [{\"name\": \"a\"}]}"}) {
    EXPECT_THROW(read_batch_json(text), core::Error) << text;
  }
}

TEST(BatchTable, ItsCsvHasAColumnForEachChangedKey) {
  const std::string csv = batch_csv(sample());
  EXPECT_THAT(csv, HasSubstr("name,file,status,films[0].haze,other,rms,"));
  EXPECT_THAT(csv, HasSubstr("p1_haze-0.8,a.yaml,done,0.8,,0.11,0.1,0.001,0.9,0.8,1000,3,1010,0.5,0.001,2000000,3.5,"
                             "\"stopped, well\"\n"));
  EXPECT_THAT(csv, HasSubstr("p2,a.yaml,wrong_input,,\"[1, 2]\",,,,,,,,,,,,,\"must lie in [0, 1], got \"\"3\"\"\"\n"));
}

TEST(BatchTable, ItsPageEscapesWhatComesFromFiles) {
  BatchTable table = sample();
  table.rows[0].name = "<script>alert(1)</script>";
  table.rows[1].message = "<b>";
  const std::string page = batch_html(table, "/nowhere");
  EXPECT_THAT(page, ::testing::Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, ::testing::Not(HasSubstr("<b>")));
  EXPECT_THAT(page, HasSubstr("1 of 2 runs done"));
}

TEST(BatchTable, HeadingsAreTheLastWordOfAKeyWhereItIsUnique) {
  BatchTable table = sample();
  table.rows[0].changes = {{"films[0].haze", "0.8"}, {"films[1].haze", "0.9"}, {"trace.seed", "1"}};
  const std::string page = batch_html(table, "/nowhere");
  EXPECT_THAT(page, HasSubstr("title=\"trace.seed\">seed</button>"));
  EXPECT_THAT(page, HasSubstr("title=\"films[0].haze\">films[0].haze</button>"));
}

TEST(BatchTable, NoTextBecomesMarkup) {
  const std::string attack = "\"><b onclick='alert(1)'>";
  BatchTable table = sample();
  table.title = table.version = table.command = attack;
  for (BatchRow& row : table.rows) {
    row.name = row.file = row.message = row.identity = attack;
    row.changes = {{attack, attack}};
  }
  EXPECT_THAT(batch_html(table, "/nowhere"), ::testing::Not(HasSubstr("<b onclick")));
}

}  // namespace
}  // namespace evenglow::design
