#include "studies/shader_cost/figure_store.h"

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "embedded_shader_sources.h"

#include <fmt/format.h>

namespace shadowbench::shaders {
namespace {

std::string keyOf(const char* what, const std::string& digest, const gpu::Architecture& architecture) {
    return fmt::format("{} of {} on {} by {}, {}", what, digest, architecture.id, gpu::compilerVersion(),
                       embedded::compiling_sources);
}

/// Nothing where the text was cut off by a power cut: as good as not there.
template <typename Read>
auto readKept(const std::optional<std::string>& kept, const Read& read) -> std::optional<decltype(read(*kept))> {
    if (!kept) return std::nullopt;
    try {
        return read(*kept);
    } catch (const BadInput&) {
        return std::nullopt;
    }
}

} // namespace

std::filesystem::path FigureStore::fileOf(const std::string& key) const {
    const std::string name = hash128(key).text();
    return folder_ / name.substr(0, 2) / (name + ".json");
}

std::optional<std::string> FigureStore::text(const std::string& key) const {
    const std::filesystem::path file = fileOf(key);
    std::error_code failed;
    if (!std::filesystem::exists(file, failed)) return std::nullopt;
    try {
        return readFile(file);
    } catch (const Error&) { // removed meanwhile
        return std::nullopt;
    }
}

void FigureStore::keepText(const std::string& key, const std::string& text) const {
    try {
        writeFileUnflushed(fileOf(key), text);
    } catch (const Error&) { // a full disk or a folder of someone else's costs time, not the run
    }
}

std::optional<std::vector<gpu::StageFigures>> FigureStore::find(const std::string& digest,
                                                                const gpu::Architecture& architecture) const {
    return readKept(text(keyOf("figures", digest, architecture)), gpu::figuresOf);
}

std::optional<std::vector<gpu::Busy>> FigureStore::findMarks(const std::string& digest,
                                                             const gpu::Architecture& architecture) const {
    return readKept(text(keyOf("marks", digest, architecture)), gpu::busyOf);
}

const gpu::Compiler& FigureStore::compilerFor(const gpu::Architecture& architecture) {
    auto compiler = compilers_.find(architecture.id);
    if (compiler == compilers_.end()) compiler = compilers_.try_emplace(architecture.id, architecture).first;
    return compiler->second;
}

std::vector<gpu::StageFigures> FigureStore::get(const gpu::Pipeline& pipeline, const gpu::Architecture& architecture) {
    const std::string digest = pipeline.digest();
    if (auto kept = find(digest, architecture)) return *std::move(kept);
    std::vector<gpu::StageFigures> figures = compilerFor(architecture).compile(pipeline);
    keepText(keyOf("figures", digest, architecture), gpu::toText(figures));
    return figures;
}

std::vector<gpu::Busy> FigureStore::getMarks(const gpu::Pipeline& pipeline, const gpu::Architecture& architecture) {
    const std::string digest = pipeline.digest();
    if (auto kept = findMarks(digest, architecture)) return *std::move(kept);
    std::vector<gpu::Busy> marks = compilerFor(architecture).busyOfMarks(pipeline);
    keepText(keyOf("marks", digest, architecture), gpu::toText(marks));
    return marks;
}

} // namespace shadowbench::shaders
