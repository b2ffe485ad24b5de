#include "base/error.h"
#include "harness/metrics/table.h"
#include "scene/load/expectations.h"
#include "techniques/folder/description.h"
#include "techniques/folder/unused.h"
#include "tests/fuzz/readers.h"
#include "tests/fuzz/target.h"

#include <algorithm>

namespace shadowbench::fuzz {

void readTechniqueDescription(std::string_view input) {
    const techniques::TechniqueFolder read = techniques::parseTechniqueFolder(
        std::string(input), "folder", {{"resolve.frag", ""}, {"mean.frag", ""}, {"blur.frag", ""}, {"moments.frag", ""}});
    for (const std::string& variant : read.entry.variants)
        techniques::parseParameters(variant, read.entry.parameters, read.entry.id);
    for (const techniques::FolderPass& pass : read.passes) {
        require(pass.shader.empty() || read.shaders.contains(pass.shader), "a pass has a shader that the folder lacks");
        for (const std::string& name : pass.to)
            require(name == techniques::visibilityTarget ||
                        std::ranges::count(read.targets, name, &techniques::FolderTarget::name) == 1,
                    "a pass writes a target that there is not");
    }
    techniques::unusedIn(read);
}

void readTechniqueShader(std::string_view input) {
    const gl::ShaderFiles files{{"resolve.frag", std::string(input)}, {"more.glsl", "#include \"resolve.frag\"\n"}};
    try {
        const gl::ShaderSource source = gl::loadShader({"folder", files}, "resolve.frag", {{"KERNEL", "3"}});
        require(std::ranges::count(source.text, '\n') == std::ssize(source.origin), "a line of a shader has no origin");
    } catch (const InternalError& error) { // a file that is not there; folders are told as bad input
        throw BadInput(error.what());
    }
}

void readExpectationList(std::string_view input) {
    for (const SceneExpectations& of : parseExpectations(input, "expect.toml", metrics::boundedMetrics()))
        require(!of.expectations.empty(), "a scene of which nothing is expected is expected");
}

} // namespace shadowbench::fuzz
