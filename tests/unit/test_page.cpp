// What goes into the page stays text, whatever it is.
#include "page/page.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace servoid {
namespace {

// The JSON that a browser finds in the page.
std::string mode_of(const std::string& page) {
    const std::string open = R"(<script id="servoid-mode" type="application/json">)";
    const size_t begin = page.find(open) + open.size();
    return page.substr(begin, page.find("</script>", begin) - begin);
}

TEST(Page, HostileTextDoesNotEndItsElement) {
    const std::string names[] = {
        "</script><script>alert(1)</script>", "<!--<script>", "a&lt;b", "\u2028 and \u2029",
        "@SCRIPTS@ @STYLE@ @MODE_JSON@",      "\"\\"};
    for (const std::string& name : names) {
        const std::string mode = mode_of(report_page({{"title", name}}));
        EXPECT_EQ(mode.find('<'), std::string::npos);
        EXPECT_EQ(mode.find("\u2028"), std::string::npos);
        const Json read = Json::parse(mode);
        EXPECT_EQ(read["mode"], "report");
        EXPECT_EQ(read["story"]["title"], name);
    }
}

TEST(Page, BytesThatAreNoTextAreReplaced) {
    EXPECT_EQ(Json::parse(mode_of(report_page({{"title", "a\xff"}})))["story"]["title"], "a\ufffd");
}

TEST(Page, IsWhole) {
    for (const std::string& page : {report_page({{"title", "x"}}), studio_page()}) {
        for (const char* place : {"@STYLE@", "@DYGRAPHS_CSS@", "@DYGRAPHS_JS@", "@SCRIPTS@"})
            EXPECT_EQ(page.find(place), std::string::npos) << place;
        EXPECT_NE(page.find("Dygraph"), std::string::npos);
    }
    EXPECT_EQ(Json::parse(mode_of(studio_page()))["mode"], "studio");
}

} // namespace
} // namespace servoid
