#include "design/report/html_films.h"

#include <gtest/gtest.h>

#include "design/report/html_facts.h"
#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

TEST(HtmlFilms, TellsNameKindAxisGapAndRemarks) {
  Report r;
  EXPECT_EQ(film_table(r), "");
  r.films = {{"diffuser", 0.0, 0.05, {}}, {"dbef<", 90.0, 0.1, {"first <remark>", "second"}}};
  const std::string html = film_table(r);
  EXPECT_NE(html.find("<td>films[0]</td><td>diffuser</td><td class=\"n\">0</td><td class=\"n\">0.05000</td>"),
            std::string::npos)
      << html;
  EXPECT_NE(html.find("<td>films[1]</td><td>dbef&lt;</td><td class=\"n\">90.00</td>"), std::string::npos) << html;
  EXPECT_NE(html.find("first &lt;remark&gt;<br>second"), std::string::npos);
}

TEST(HtmlFilms, RemarksThatStandThereAreNotRepeatedAmongTheNotes) {
  Report r;
  r.films = {{"dbef", 0.0, 0.05, {"held at its last angle"}}};
  r.notes = {film_note(0, r.films[0], "held at its last angle"), "the limit binds"};
  const std::string notes = note_list(r);
  EXPECT_EQ(notes.find("last angle"), std::string::npos);
  EXPECT_NE(notes.find("the limit binds"), std::string::npos);
  r.notes.pop_back();
  EXPECT_EQ(note_list(r), "");
}

}  // namespace
}  // namespace evenglow::design
