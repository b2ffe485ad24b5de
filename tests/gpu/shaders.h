// What tests compile, and for what.
#pragma once

#include "base/error.h"
#include "gpu/compiler.h"
#include "gpu/standalone.h"

#include <gtest/gtest.h>
#include <map>
#include <string>

namespace shadowbench::gpu {

/// A test that compiles: skipped where Mesa's Vulkan driver for AMD is not installed.
class Compiling : public testing::Test {
protected:
    void SetUp() override {
        try {
            (void)compilerFor("navi21");
        } catch (const Inconclusive& error) {
            GTEST_SKIP() << error.what();
        }
    }

    static const Compiler& compilerFor(const std::string& architecture) {
        static std::map<std::string, Compiler> compilers;
        return compilers.try_emplace(architecture, architectureNamed(architecture)).first->second;
    }

    /// The figures of the stage that `text` is.
    static StageFigures figures(Stage stage, const std::string& text, const std::string& architecture = "navi21") {
        for (const StageFigures& each : compilerFor(architecture).compile(pipelineOf({{stage, "test", text}})))
            if (each.stage == stage) return each;
        throw InternalError("the stage has no figures");
    }
};

/// A fragment shader that does `body` with `vec4 x`, which it writes.
inline std::string fragment(const std::string& body, const std::string& declared = "") {
    return "#version 450 core\nlayout(location = 0) in vec4 value;\nlayout(location = 0) out vec4 colour;\n" + declared +
           "\nvoid main() {\n    vec4 x = value;\n    " + body + "\n    colour = x;\n}\n";
}

} // namespace shadowbench::gpu
