// Every path, section and link that our comments and pages cite is there.
#include "tests/support/citations.h"

#include "base/files.h"

#include <gtest/gtest.h>

namespace shadowbench::citations {
namespace {
namespace fs = std::filesystem;

const fs::path root = SOURCE_FOLDER;

bool isOneOf(const std::string& word, std::initializer_list<const char*> words) {
    return std::ranges::find(words, word) != words.end();
}

/// The project's files by their paths from the root: not what builds and runs leave.
std::vector<std::string> allFiles() {
    std::vector<std::string> files;
    for (const fs::directory_entry& top : fs::directory_iterator(root)) {
        const std::string name = top.path().filename().string();
        if (top.is_regular_file()) files.push_back(name);
        if (!top.is_directory() || name == ".git" || name == "build") continue;
        for (auto entry = fs::recursive_directory_iterator(top); entry != fs::recursive_directory_iterator(); ++entry) {
            const std::string path = entry->path().lexically_relative(root).string();
            const bool isOfASite = path.starts_with("results/") && path.ends_with("/docs"); // a copy, for its links
            if (path == "results/latest" || isOfASite || path.ends_with("/node_modules")) entry.disable_recursion_pending();
            if (entry->is_regular_file()) files.push_back(path);
        }
    }
    return files;
}

const std::vector<std::string>& projectFiles() {
    static const std::vector<std::string> files = allFiles();
    return files;
}

const Tree& projectTree() {
    static const Tree tree = [] {
        Tree made;
        for (const std::string& file : projectFiles()) {
            made.add(file);
            if (file.ends_with(".md")) made.headings[file] = headingsOf(readFile(root / file));
        }
        return made;
    }();
    return tree;
}

/// Whether a file's comments begin with two slashes, with #, or whether it has none that we read.
enum class Comments { Slashes, Hash, None };
Comments commentStyle(const std::string& file) {
    const std::string ending = fs::path(file).extension().string();
    if (isOneOf(ending, {".h", ".cpp", ".glsl", ".vert", ".frag", ".comp", ".inc"})) return Comments::Slashes;
    const bool isScript = file.starts_with("tools/") && ending.empty();
    if (isScript || file == "bench" || isOneOf(ending, {".toml", ".sh", ".cmake", ".yml"}) ||
        file.ends_with("CMakeLists.txt") || file == "cmake/layers.txt")
        return Comments::Hash;
    return Comments::None;
}

std::string listed(const std::string& file, const std::vector<std::string>& problems) {
    std::string list;
    for (const std::string& problem : problems) list += fmt::format("\n  {}: {}", file, problem);
    return list;
}

TEST(Citations, OfCommentsLeadSomewhere) {
    std::string stale;
    int comments = 0;
    for (const std::string& file : projectFiles()) {
        const Comments style = commentStyle(file);
        if (style == Comments::None) continue;
        for (const std::string& comment : commentsOf(readFile(root / file), style == Comments::Slashes)) {
            stale += listed(file, staleIn(projectTree(), comment));
            stale += listed(file, barePagesIn(comment));
            ++comments;
        }
    }
    EXPECT_TRUE(stale.empty()) << stale;
    EXPECT_GT(comments, 1000) << "the comments were not found";
}

TEST(Citations, OfPagesLeadSomewhere) {
    std::string stale;
    for (const auto& [page, headings] : projectTree().headings) {
        const std::string text = readFile(root / page);
        stale += listed(page, deadLinks(projectTree(), page, text));
        if (page.starts_with("results/") && page != "results/README.md") continue; // generated, of the tree as it was then
        const std::string folder = fs::path(page).parent_path().string();
        if (page == "CHANGELOG.md") continue; // names what is gone
        for (const std::string& line : linesOf(text)) stale += listed(page, staleIn(projectTree(), line, folder));
    }
    EXPECT_TRUE(stale.empty()) << stale;
}

Tree smallTree() {
    Tree tree;
    tree.add("base/error.h");
    tree.add("docs/gate.md");
    tree.add("results/truth/report.md");
    tree.headings["docs/gate.md"] = headingsOf("# The gate\n\n## Exit codes\n```\n# no heading\n```\n## Time, in pairs\n");
    return tree;
}

TEST(Citations, AreFoundStaleWhenFilesMove) {
    const Tree tree = smallTree();
    EXPECT_TRUE(staleIn(tree, "errors (base/error.h), as error.h says").empty());
    EXPECT_EQ(staleIn(tree, "errors (base/errors.h)."), std::vector<std::string>{"no file or folder: base/errors.h"});
    EXPECT_EQ(staleIn(tree, "as mistake.h says"), std::vector<std::string>{"no file or folder: mistake.h"});
    EXPECT_EQ(staleIn(tree, "results/truth/*.svg").size(), 1U);
    EXPECT_TRUE(staleIn(tree, "results/truth/*.md, results/latest/report.md, techniques/<id>/, $root/base/x.h").empty());
}

TEST(Citations, AreFoundStaleWhenSectionsAreRenamed) {
    const Tree tree = smallTree();
    EXPECT_TRUE(staleIn(tree, "exit codes: docs/gate.md, \"Exit codes\"").empty());
    EXPECT_EQ(staleIn(tree, "docs/gate.md, \"Exits\""), std::vector<std::string>{"no section of docs/gate.md: Exits"});
    EXPECT_EQ(staleIn(tree, "(docs/gone.md, \"Exits\")").size(), 2U) << "neither the file nor the section";
    EXPECT_EQ(staleIn(tree, "docs/gate.md, \"no heading\"").size(), 1U) << "code is no heading";
}

TEST(Citations, NamePagesByTheirPaths) {
    EXPECT_EQ(barePagesIn("why: METRICS, \"Labels\"").size(), 1U);
    EXPECT_EQ(barePagesIn("why: GATE.md").size(), 1U);
    EXPECT_EQ(barePagesIn("README, \"Exit codes\"").size(), 1U);
    EXPECT_TRUE(barePagesIn("README.md, $SCENES, GATES and METRICS_H").empty());
}

TEST(Citations, AreFoundInCommentsOnly) {
    const std::string source =
        "#include \"gone.h\"\nconst char* text = \"// gone.h\"; // see base/error.h\n// and\n// docs/gate.md";
    EXPECT_EQ(commentsOf(source, true), (std::vector<std::string>{"see base/error.h and docs/gate.md"}));
    EXPECT_EQ(commentsOf("[ $# -gt 0 ] # at least one\nx=1", false), (std::vector<std::string>{"at least one"}));
}

TEST(Citations, OfLinksNeedFileAndHeading) {
    const Tree tree = smallTree();
    EXPECT_TRUE(
        deadLinks(tree, "README.md", "[a](docs/gate.md#time-in-pairs) [b](docs) [c](https://example.org/x)").empty());
    EXPECT_TRUE(deadLinks(tree, "docs/gate.md", "[a](../results/truth/report.md), [b](#exit-codes)").empty());
    EXPECT_EQ(deadLinks(tree, "README.md", "[a](docs/gates.md) [b](docs/gate.md#exits)").size(), 2U);
}

} // namespace
} // namespace shadowbench::citations
