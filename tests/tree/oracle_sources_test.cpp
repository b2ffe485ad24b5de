// Code that decides a truth does not change unnoticed: groundtruth/sources.json has a digest of each oracle's sources beside
// its version, and one of the two is renewed on purpose (CONTRIBUTING.md, "Truth has changed").
#include "base/files.h"
#include "base/hash.h"

#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path root = SOURCE_FOLDER;

bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Code without comments, and with white space only where it parts two words: what is left when nothing but explanations and
/// layout change. Raw strings are no part of the oracles.
std::string codeOf(const std::string& text) {
    std::string code;
    bool space = false;
    for (std::size_t i = 0; i < text.size();) {
        if (text.compare(i, 2, "//") == 0) {
            i = std::min(text.find('\n', i), text.size());
        } else if (text.compare(i, 2, "/*") == 0) {
            i = text.find("*/", i) + 2;
        } else if (std::isspace(static_cast<unsigned char>(text[i])) != 0) {
            space = true;
            ++i;
        } else {
            if (space && !code.empty() && isWord(code.back()) && isWord(text[i])) code += ' ';
            space = false;
            const bool quoted = text[i] == '"' || (text[i] == '\'' && !(i > 0 && isWord(text[i - 1])));
            const std::size_t from = i++;
            if (quoted) {
                while (i < text.size() && text[i] != text[from]) i += text[i] == '\\' ? 2 : 1;
                ++i;
            }
            code += text.substr(from, i - from);
        }
    }
    return code;
}

/// Of all files that the entry names, folders with all that is below them.
std::string digestOf(const Json& entry) {
    std::set<fs::path> files;
    for (const Json& source : entry.at("sources")) {
        const fs::path path = root / source.get<std::string>();
        if (fs::is_regular_file(path)) files.insert(path);
        if (!fs::is_directory(path)) continue;
        for (const fs::directory_entry& file : fs::recursive_directory_iterator(path))
            if (file.is_regular_file()) files.insert(file.path());
    }
    std::string all;
    for (const fs::path& file : files) all += fs::relative(file, root).string() + "\n" + codeOf(readFile(file)) + "\n";
    return hash128(all).text();
}

int declaredVersion(const Json& entry) {
    const std::string code = codeOf(readFile(root / entry.at("declared").at(0).get<std::string>()));
    const std::regex pattern("int " + entry.at("declared").at(1).get<std::string>() + "=(\\d+);");
    std::smatch found;
    return std::regex_search(code, found, pattern) ? std::stoi(found[1]) : -1;
}

const Json& oracles() {
    static const Json all = Json::parse(readFile(root / "groundtruth/sources.json"));
    return all;
}

TEST(OracleSources, DoNotChangeWithoutANewVersionOrANewDigest) {
    for (const auto& [oracle, entry] : oracles().items())
        EXPECT_EQ(digestOf(entry), entry.at("digest"))
            << "the sources of \"" << oracle << "\" have changed. If a number of a truth can: raise " << entry.at("declared")
            << " and \"version\". In any case write the new digest into groundtruth/sources.json.";
}

TEST(OracleSources, HaveTheVersionsOfTheCode) {
    for (const auto& [oracle, entry] : oracles().items()) EXPECT_EQ(declaredVersion(entry), entry.at("version")) << oracle;
}

TEST(OracleSources, AreAllOfTheGroundTruth) {
    std::set<std::string> named;
    for (const auto& [oracle, entry] : oracles().items())
        for (const Json& source : entry.at("sources")) {
            const std::string& path = source.get_ref<const std::string&>();
            EXPECT_TRUE(fs::exists(root / path)) << path;
            named.insert(path);
        }
    const auto isNamed = [&](const fs::path& file) {
        for (fs::path part = file; !part.empty(); part = part.parent_path())
            if (named.contains(part.string())) return true;
        return false;
    };
    // What passes answers on, compares them or keeps them, and computes none.
    const std::set<std::string> others{"groundtruth/contract",
                                       "groundtruth/store",
                                       "groundtruth/oracle.h",
                                       "groundtruth/area_comparison.h",
                                       "groundtruth/area_comparison.cpp",
                                       "groundtruth/certify/agreement.h",
                                       "groundtruth/certify/agreement.cpp"};
    named.insert(others.begin(), others.end());
    for (const fs::directory_entry& file : fs::recursive_directory_iterator(root / "groundtruth")) {
        const bool code = file.path().extension() == ".cpp" || file.path().extension() == ".h";
        EXPECT_TRUE(!code || isNamed(fs::relative(file.path(), root)))
            << file.path() << ": name it in groundtruth/sources.json";
    }
}

TEST(OracleSources, CommentsAndLayoutAreNoCode) {
    EXPECT_EQ(codeOf("int  a = 1; // one\n/* two */ int b;"), codeOf("int a=1;\nint b;"));
    EXPECT_NE(codeOf("int a = 1;"), codeOf("int a = 2;"));
    EXPECT_EQ(codeOf("f(\"a // b\");"), "f(\"a // b\");");
    EXPECT_EQ(codeOf("1'000 + 2'000 // c"), "1'000+2'000");
    EXPECT_NE(codeOf("return x;"), codeOf("returnx;"));
}

} // namespace
} // namespace shadowbench
