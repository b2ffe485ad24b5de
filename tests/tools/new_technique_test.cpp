// tools/new-technique in a copy of the few files that it reads and writes.
#include "base/files.h"
#include "tests/support/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

class NewTechnique : public testing::Test {
protected:
    NewTechnique() {
        const fs::path source = SOURCE_FOLDER;
        for (const char* folder : {"tools", "techniques/filtered/pcf", "techniques/maps", "tests/techniques/gl"})
            fs::create_directories(tree_ / folder);
        for (const char* file : {"tools/new-technique", "techniques/catalog.inc", "README.md"})
            fs::copy_file(source / file, tree_ / file);
    }

    [[nodiscard]] Outcome start(const std::string& arguments) const {
        return shell(tree_ / "tools/new-technique" + " " + arguments);
    }
    [[nodiscard]] std::string text(const std::string& file) const { return readFile(tree_ / file); }

    Folder tree_;
};

TEST_F(NewTechnique, WritesAFolderALineAndATest) {
    const std::string before = text("techniques/catalog.inc");
    const Outcome outcome = start("filtered my-2nd-filter");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_EQ(text("techniques/catalog.inc"), before + "TECHNIQUE(my2ndFilter)\n");
    const auto techniques = [](const std::string& catalogue) {
        std::size_t lines = 0;
        for (const char* line : {"\nTECHNIQUE(", "\nFOLDER("})
            for (std::size_t at = 0; (at = catalogue.find(line, at)) != std::string::npos; ++at) ++lines;
        return lines;
    };
    EXPECT_NE(text("README.md").find(fmt::format("runs {} shadow", techniques(before) + 1)), std::string::npos);
    EXPECT_NE(text("techniques/filtered/my-2nd-filter/my-2nd-filter.cpp").find("Entry my2ndFilter() {"), std::string::npos);
    EXPECT_NE(text("techniques/filtered/my-2nd-filter/my-2nd-filter.cpp").find("Answer::Filtered"), std::string::npos);
    EXPECT_NE(text("techniques/filtered/my-2nd-filter/my-2nd-filter.frag").find("out float visibility"), std::string::npos);
    EXPECT_NE(text("tests/techniques/gl/my_2nd_filter_test.cpp").find("TEST(My2ndFilter, "), std::string::npos);
    EXPECT_NE(outcome.output.find("-R '^techniques/gl/my_2nd_filter$'"), std::string::npos) << outcome.output;
}

TEST_F(NewTechnique, RefusesWithASentenceAndWritesNothing) {
    const std::string before = text("techniques/catalog.inc");
    const std::pair<const char*, const char*> refused[] = {
        {"", "it takes a family and an id"},
        {"filtered", "it takes a family and an id"},
        {"blurred my-filter", "there is no family \"blurred\"; the families are: planar"},
        {"'' my-filter", "there is no family \"\""},
        {"filtered MyFilter", "\"MyFilter\" is no id"},
        {"filtered my--filter", "\"my--filter\" is no id"},
        {"filtered ../filter", "\"../filter\" is no id"},
        {"filtered ''", "\"\" is no id"},
        {"filtered pcf", "there is a technique \"pcf\" already: techniques/filtered/pcf"},
        {"maps pcf", "there is a technique \"pcf\" already: techniques/filtered/pcf"},
        {"maps sm-uniform", "the catalogue has a technique smUniform already"}, // whose folder was not copied
    };
    for (const auto& [arguments, sentence] : refused) {
        const Outcome outcome = start(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_NE(outcome.output.find(sentence), std::string::npos) << outcome.output;
    }
    EXPECT_EQ(text("techniques/catalog.inc"), before);
    EXPECT_TRUE(fs::is_empty(tree_ / "tests/techniques/gl"));
}

} // namespace
} // namespace shadowbench
