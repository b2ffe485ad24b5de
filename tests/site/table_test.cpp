#include "site/names.h"
#include "site/table.h"

#include <gtest/gtest.h>

namespace shadowbench::site {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Table example() {
    return {.id = "errors",
            .caption = "A & B",
            .columns = {{.title = "technique", .number = false}, {.title = "error %"}, {.title = "wide", .brief = false}},
            .rows = {{{Cell{"a_b:x=1"}, Cell{"0.33 %", 1.0 / 3}, Cell{"–"}}}}};
}

TEST(Slug, KeepsWhatIsSafeAndTellsApartWhatIsNot) {
    EXPECT_EQ(slug("pcss:taps=32+32,map=2048"), "pcss_taps=32+32,map=2048");
    EXPECT_EQ(slug("simple"), "simple");
    EXPECT_NE(slug("a b"), slug("a_b"));
    EXPECT_NE(slug("a b"), slug("a\tb"));
    EXPECT_NE(slug(""), "");
    for (const std::string& name :
         {std::string("../../etc/passwd"), std::string("<script>"), std::string(1000000, 'x'), std::string(".")}) {
        const std::string text = slug(name);
        EXPECT_LE(text.size(), 100U);
        EXPECT_NE(text.front(), '.');
        EXPECT_EQ(text.find_first_of("/<>\"'&% "), std::string::npos) << text;
    }
}

TEST(Truncate, CutsLongNamesBetweenCharacters) {
    EXPECT_EQ(truncate("short"), "short");
    std::string name = fmt::format("{:a>159}", "");
    for (int i = 0; i < 100; ++i) name += "é";
    const std::string text = truncate(name);
    EXPECT_TRUE(has(text, "… (359 bytes)")) << text;
    EXPECT_LT(text.size(), 200U);
    EXPECT_EQ(text.find("…"), 159U) << text; // no half of the é
}

TEST(Table, IsCsvWithUnroundedValues) {
    EXPECT_EQ(csvOf(example()), "technique,error %,wide\na_b:x=1,0.3333333333333333,\n");
}

TEST(Table, IsLatexWithBooktabsBriefOrWhole) {
    const std::string brief = latexOf(example(), true, "scene-errors"), whole = latexOf(example(), false, "x");
    for (const char* part : {"\\toprule", "\\midrule", "\\bottomrule", "technique & error \\%", "a\\_b:x=1 & 0.33 \\% \\\\",
                             "\\caption{A \\& B}", "\\label{tab:scene-errors}", "{lr}"})
        EXPECT_TRUE(has(brief, part)) << part << "\n" << brief;
    EXPECT_FALSE(has(brief, "wide"));
    EXPECT_TRUE(has(whole, "technique & error \\% & wide")) << whole;
    EXPECT_TRUE(has(whole, "& -- \\\\")) << whole;
}

TEST(Table, HasTheBestOfEachColumnBoldInLatexAndNamesForPeople) {
    Table table{.id = "errors",
                .caption = "Errors",
                .columns = {{.title = "technique"}, {.title = "error", .least = true}, {.title = "SSIM"}}};
    table.rows = {{{Cell{"none"}, Cell{"0.0", 0.0}, Cell{"1", 1.0}}, {{"baseline", "yes"}}},
                  {{Cell{.text = "pcss", .name = "Percentage-closer soft shadows"}, Cell{"0.1", 0.1}, Cell{"2", 2.0}}},
                  {{Cell{"pcf"}, Cell{"0.2", 0.2}, Cell{"3", 3.0}}}};
    const std::string text = latexOf(table, false, "x");
    EXPECT_TRUE(has(text, "Percentage-closer soft shadows & \\textbf{0.1} & 2 \\\\")) << text;
    EXPECT_TRUE(has(text, "none & 0.0 & 1 \\\\") && has(text, "pcf & 0.2 & 3 \\\\")) << text;
}

TEST(Latex, HasAWordForWhatItWouldRead) {
    EXPECT_EQ(
        latexText("50 % of $x_1^2$ & {#~} \\input{/etc/passwd}"),
        "50 \\% of \\$x\\_1\\textasciicircum{}2\\$ \\& \\{\\#\\textasciitilde{}\\} \\textbackslash{}input\\{/etc/passwd\\}");
    EXPECT_EQ(latexText("σ ≤ 3 × 4² ●"), "$\\sigma$ $\\le$ 3 $\\times$ 4$^2$ $\\bullet$");
    EXPECT_EQ(latexText("Zápotocký 影"), "Zápotocký ?");
    EXPECT_EQ(latexText("the \"method\""), "the ''method''");
}

TEST(Table, IsHtmlInWhichRecordsAreText) {
    Table table = example();
    table.caption = "<img src=x onerror=alert(1)>";
    table.rows[0].cells[0] = {.text = "\"><script>alert(1)</script>", .note = "' onmouseover='alert(1)"};
    table.rows[0].marks = {{"family", "\" onclick=\"alert(1)"}};
    const std::string html = render("table.html", tableData(table, "../", "tables/x"));
    EXPECT_FALSE(has(html, "<script>"));
    EXPECT_FALSE(has(html, "<img"));
    EXPECT_TRUE(has(html, "&quot;&gt;&lt;script&gt;alert(1)&lt;/script&gt;")) << html;
    EXPECT_TRUE(has(html, "data-family=\"&quot; onclick=&quot;alert(1)\"")) << html;
    EXPECT_TRUE(has(html, "data-v=\"0.3333333333333333\"")) << html;
    EXPECT_TRUE(has(html, "href=\"../tables/x.tex\"")) << html;
}

TEST(Table, OfTextHasTheNumbersThatLeadItsCells) {
    const Table table = tableOf({{"technique", "pop"}, {{"12-bit", "4.87 %"}, {"b", "–"}}}, "lod", "Levels");
    EXPECT_FALSE(table.columns[0].number);
    EXPECT_FALSE(table.rows[0].cells[0].value);
    EXPECT_EQ(table.rows[0].cells[1].value, 4.87);
    EXPECT_FALSE(table.rows[1].cells[1].value);
}

} // namespace
} // namespace shadowbench::site
