// Machine code for graphics processors that are not there, by Mesa's Vulkan driver for AMD (RADV): its compiler needs no
// device. Vulkan is a tool of measurement here; nothing is drawn.
#pragma once

#include "gpu/figures.h"
#include "gpu/machine_code.h"
#include "gpu/pipeline.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::gpu {

struct Architecture {
    std::string_view id;   // the family, as the driver names it
    std::string_view name; // "GCN 5"
    std::string_view card; // one that has it
};

/// The oldest first.
std::span<const Architecture> architectures();

/// Throws BadInput with near matches.
const Architecture& architectureNamed(std::string_view id);

/// Both compilers with their versions: "radv Mesa 22.3.6, glslang 12.0.0". Throws Inconclusive, saying what to install,
/// without the driver.
std::string compilerVersion();

class Compiler {
public:
    /// For one of architectures(): the driver ends the process for a family that it does not know. Throws Inconclusive,
    /// saying what to install, without the driver.
    explicit Compiler(const Architecture& architecture);
    ~Compiler();
    Compiler(Compiler&&) noexcept;
    Compiler& operator=(Compiler&&) = delete;

    /// Stage by stage. Throws BadInput for shaders that do not compile.
    [[nodiscard]] std::vector<StageFigures> compile(const Pipeline& pipeline) const;

    /// What each mark of the text (gpu/marks.h) of its fragment or compute shader executes. Where marks keep the compiler
    /// from unrolling a loop, those in loops of constant length are left out: they execute nothing, and what is around them
    /// does.
    [[nodiscard]] std::vector<Busy> busyOfMarks(const Pipeline& pipeline) const;

private:
    struct Device;
    struct Compiled;
    [[nodiscard]] std::vector<Compiled> compiled(const Pipeline& pipeline) const;
    [[nodiscard]] std::vector<CodeBlock> blocksOf(Pipeline pipeline, const std::string& text) const;

    std::unique_ptr<Device> device_;
};

} // namespace shadowbench::gpu
