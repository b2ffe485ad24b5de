// Vertex shaders that are built in.
#include "base/files.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
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

/// With what they include, without comments.
std::map<fs::path, std::string> vertexShaders() {
    static const std::regex comment("//[^\n]*");
    std::map<fs::path, std::string> shaders;
    for (const auto& entry : fs::recursive_directory_iterator(techniques))
        if (entry.path().extension() == ".vert")
            shaders[entry.path()] = std::regex_replace(withIncludes(entry.path()), comment, "");
    EXPECT_GT(shaders.size(), 10U);
    return shaders;
}

/// What waves execute is counted of fragment and compute shaders alone, and of these shaders the compiler's figure stands
/// for it (docs/gpu-cost.md, "What waves execute").
TEST(VertexShaders, HaveNoLoopAndNoBranch) {
    static const std::regex branch(R"(\b(for|while|if|switch)\s*\()");
    for (const auto& [file, text] : vertexShaders())
        EXPECT_FALSE(std::regex_search(text, branch)) << file << ": say so in docs/gpu-cost.md";
}

/// Mesa links one that reads two attributes from a location, where one of them is not used; compilers of SPIR-V do not.
TEST(VertexShaders, ReadOneAttributeFromALocation) {
    static const std::regex attribute(R"(location = (\d+)\) in )");
    for (const auto& [file, text] : vertexShaders()) {
        std::set<std::string> locations;
        for (std::sregex_iterator match(text.begin(), text.end(), attribute); match != std::sregex_iterator(); ++match)
            EXPECT_TRUE(locations.insert((*match)[1]).second) << file << ": location " << (*match)[1];
    }
}

} // namespace
} // namespace shadowbench
