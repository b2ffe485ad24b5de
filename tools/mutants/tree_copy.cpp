#include "tools/mutants/tree_copy.h"

#include "base/error.h"
#include "base/files.h"
#include "base/process.h"
#include "tools/mutants/tool.h"

#include <algorithm>

namespace shadowbench::mutants {
namespace {

void writeIfDifferent(const std::filesystem::path& file, const std::string& text) {
    if (!std::filesystem::exists(file) || readFile(file) != text) writeFile(file, text);
}

} // namespace

TreeCopy::TreeCopy(std::filesystem::path source, std::filesystem::path folder)
    : source_(std::move(source)), folder_(std::move(folder)) {
    files_ = trackedFiles();
    for (const std::string& file : files_) writeIfDifferent(folder_ / file, readFile(source_ / file));
    removeAllBut(files_);
}

std::vector<std::string> TreeCopy::trackedFiles() const {
    std::vector<std::string> files = runTool("git", {"-C", source_.string(), "ls-files"}, source_);
    std::erase_if(files, [&](const std::string& file) { return !std::filesystem::exists(source_ / file); });
    std::ranges::sort(files);
    return files;
}

/// Sources are globbed: one that is no longer tracked must not be built.
void TreeCopy::removeAllBut(const std::vector<std::string>& files) const {
    for (const auto& top : std::filesystem::directory_iterator(folder_)) {
        if (!top.is_directory() || top.path().filename() == "build") continue;
        std::vector<std::filesystem::path> stale;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(top.path()))
            if (entry.is_regular_file() &&
                !std::ranges::binary_search(files, entry.path().lexically_relative(folder_).string()))
                stale.push_back(entry.path());
        for (const std::filesystem::path& file : stale) std::filesystem::remove(file);
    }
}

std::string TreeCopy::read(const std::filesystem::path& file) const { return readFile(folder_ / file); }

void TreeCopy::write(const std::filesystem::path& file, std::string_view text) const { writeFile(folder_ / file, text); }

void TreeCopy::build(const std::string& target) const {
    if (!std::filesystem::exists(folder_ / "build/release/build.ninja")) {
        std::vector<std::string> words{"--preset", "release", "-DSHADOWBENCH_BENCHMARKS=OFF"};
        if (findProgram("ld.lld"))
            words.emplace_back("-DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld"); // links in a tenth of the time
        runTool("cmake", words, folder_);
    }
    runTool("cmake", {"--build", "build/release", "--target", target}, folder_);
}

PlantedFault::PlantedFault(const TreeCopy& tree, std::filesystem::path file, std::string_view text)
    : tree_(tree), file_(std::move(file)), original_(tree.read(file_)) {
    tree_.write(file_, text);
}

PlantedFault::~PlantedFault() {
    try {
        tree_.write(file_, original_);
    } catch (const Error&) { // the next run copies the file anew
    }
}

} // namespace shadowbench::mutants
