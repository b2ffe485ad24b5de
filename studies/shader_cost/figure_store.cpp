#include "studies/shader_cost/figure_store.h"

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "embedded_shader_sources.h"

#include <fmt/format.h>

namespace shadowbench::shaders {
namespace {

std::string keyOf(const std::string& digest, const gpu::Architecture& architecture) {
    return fmt::format("figures of {} on {} by {}, {}", digest, architecture.id, gpu::compilerVersion(),
                       embedded::compiling_sources);
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
    const auto kept = text(keyOf(digest, architecture));
    if (!kept) return std::nullopt;
    try {
        return gpu::figuresOf(*kept);
    } catch (const BadInput&) { // cut off by a power cut: as good as not there
        return std::nullopt;
    }
}

std::vector<gpu::StageFigures> FigureStore::get(const gpu::Pipeline& pipeline, const gpu::Architecture& architecture) {
    const std::string digest = pipeline.digest();
    if (auto kept = find(digest, architecture)) return *std::move(kept);
    auto compiler = compilers_.find(architecture.id);
    if (compiler == compilers_.end()) compiler = compilers_.try_emplace(architecture.id, architecture).first;
    std::vector<gpu::StageFigures> figures = compiler->second.compile(pipeline);
    keepText(keyOf(digest, architecture), gpu::toText(figures));
    return figures;
}

} // namespace shadowbench::shaders
