// Figures of pipelines, kept from run to run: in the folder `gpu` beside the references, a file for each pipeline and
// architecture. Files are named by hashes of all that they depend on, so that nothing outlives its compiler; the folder may
// be removed at any time.
#pragma once

#include "gpu/compiler.h"
#include "gpu/figures.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::shaders {

class FigureStore {
public:
    explicit FigureStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// The figures of a pipeline by its digest; nothing where they are not kept.
    [[nodiscard]] std::optional<std::vector<gpu::StageFigures>> find(const std::string& digest,
                                                                     const gpu::Architecture& architecture) const;

    /// The same, compiled and kept where they are not.
    std::vector<gpu::StageFigures> get(const gpu::Pipeline& pipeline, const gpu::Architecture& architecture);

    /// Likewise what the marks of its counted shader execute (gpu::Compiler::busyOfMarks).
    [[nodiscard]] std::optional<std::vector<gpu::Busy>> findMarks(const std::string& digest,
                                                                  const gpu::Architecture& architecture) const;
    std::vector<gpu::Busy> getMarks(const gpu::Pipeline& pipeline, const gpu::Architecture& architecture);

    /// Text by a key of any kind; one that cannot be written is not kept.
    [[nodiscard]] std::optional<std::string> text(const std::string& key) const;
    void keepText(const std::string& key, const std::string& text) const;

private:
    const gpu::Compiler& compilerFor(const gpu::Architecture& architecture);
    [[nodiscard]] std::filesystem::path fileOf(const std::string& key) const;

    std::filesystem::path folder_;
    std::map<std::string_view, gpu::Compiler> compilers_; // by architecture, made when first asked for
};

} // namespace shadowbench::shaders
