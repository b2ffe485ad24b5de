// Vertex shaders that are built in have no loop and no branch: what waves execute is counted of fragment and compute shaders
// alone, and of these shaders the compiler's figure stands for it (docs/gpu-cost.md, "What waves execute").
#include "base/files.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <regex>
#include <string>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

const fs::path techniques = fs::path(SOURCE_FOLDER) / "techniques";

std::string withIncludes(const fs::path& file) {
    static const std::regex include(R"re(#include "([^"]+)")re");
    std::string text = readFile(file);
    const std::string own = text;
    for (std::sregex_iterator match(own.begin(), own.end(), include); match != std::sregex_iterator(); ++match)
        text += withIncludes(techniques / (*match)[1].str());
    return text;
}

TEST(VertexShaders, HaveNoLoopAndNoBranch) {
    static const std::regex comment("//[^\n]*"), branch(R"(\b(for|while|if|switch)\s*\()");
    int shaders = 0;
    for (const auto& entry : fs::recursive_directory_iterator(techniques)) {
        if (entry.path().extension() != ".vert") continue;
        ++shaders;
        EXPECT_FALSE(std::regex_search(std::regex_replace(withIncludes(entry.path()), comment, ""), branch))
            << entry.path() << ": say so in docs/gpu-cost.md";
    }
    EXPECT_GT(shaders, 10);
}

} // namespace
} // namespace shadowbench
