#include "studies/shader_cost/shader_cost.h"

#include "base/files.h"
#include "base/folder_lock.h"
#include "cli/command.h"
#include "cli/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace shadowbench {
namespace {

struct VerbOptions {
    shaders::ShaderCostOptions study;
    std::filesystem::path out = "results/latest/shader-cost";
    std::filesystem::path base; // empty: none
};

ExitCode printShaderCosts(const VerbOptions& options) {
    if (!options.study.files.empty() && !(options.study.techniques.empty() && options.study.scene.empty()))
        throw BadInput("files of shaders have neither technique nor scene; name the ones or the others");
    shaders::ShaderCosts before;
    if (!options.base.empty()) before = shaders::readLines(options.base);
    const OutputLock alone(options.out);
    const shaders::ShaderCostResult result = shaders::shaderCosts(options.study);
    for (const std::string& error : result.errors) fmt::print(stderr, "shadowbench: {}\n", error);
    for (const auto& [variant, reason] : result.notApplicable)
        fmt::print(stderr, "{} is not applicable: {}\n", variant, reason);
    if (result.costs.shaders.empty()) return result.code == ExitCode::Pass ? ExitCode::BadInput : result.code;
    if (!options.study.techniques.empty()) // the base may be of more
        std::erase_if(before.shaders, [&](const shaders::ShaderCost& shader) {
            return std::ranges::find(result.costs.shaders, shader.technique, &shaders::ShaderCost::technique) ==
                   result.costs.shaders.end();
        });
    const std::filesystem::path file = options.out / "shader-cost.jsonl";
    writeFile(file, shaders::toLines(result.costs));
    fmt::print("{}lines: {}\n", options.base.empty() ? shaders::table(result.costs) : shaders::changes(before, result.costs),
               file.string());
    return result.code;
}

} // namespace

void addShaderCost(CLI::App& app, Action& action) {
    const auto options = std::make_shared<VerbOptions>();
    shaders::ShaderCostOptions& study = options->study;
    CLI::App* verb = app.add_subcommand(
        "shader-cost", "Compiles shaders for AMD's graphics processors that are not there: instructions, registers, waves");
    verb->footer(
        "Figures are of machine code, whose loops count as often as the compiler guesses; `executed` is what waves of the\n"
        "technique's frame run, counted on llvmpipe (docs/gpu-cost.md).\n"
        "Files that differ in .vert and .frag alone are one program.\n"
        "Examples:\n  shadowbench shader-cost --technique sm-uniform --technique pcss\n"
        "  shadowbench shader-cost blur.vert blur.frag --arch navi21\n"
        "  shadowbench shader-cost --out before; …; shadowbench shader-cost --base before/shader-cost.jsonl");
    verb->add_option(
        "FILE", study.files,
        "Shaders: GLSL for OpenGL or Vulkan (.vert, .frag, .comp) or SPIR-V (.spv) (default: those of techniques)");
    verb->add_option("--technique", study.techniques,
                     "Variant such as pcf:kernel=7, or a glob over ids; repeatable (default: all)");
    addTechniqueFolderOption(*verb, study.techniques);
    verb->add_option("--scene", study.scene,
                     "Scene id or file that techniques are drawn on (default: for each the first that it applies to, from "
                     "`simple` on)");
    verb->add_option("--arch", study.architectures, "Architecture; repeatable (default: all)")
        ->type_name("TEXT:{vega10,navi10,navi21,gfx1100}");
    verb->add_option("--base", options->base, "shader-cost.jsonl of an earlier run: prints what changed since");
    verb->add_option("--out", options->out, "Folder of shader-cost.jsonl, a line for each shader and architecture")
        ->capture_default_str();
    verb->add_option("--cache", study.cache,
                     "Folder of references, which keeps figures, too (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    addGlOption(*verb);
    verb->add_flag("--quiet", study.quiet, "No progress");
    verb->callback([&action, options] { action = [options] { return printShaderCosts(*options); }; });
}

} // namespace shadowbench
