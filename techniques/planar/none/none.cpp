// No shadow at all: the floor of cost and of accuracy (Zápotocký 5.2).
#include "techniques/contract/entry.h"

namespace shadowbench::techniques {
namespace {

class None final : public Technique {
public:
    void render(const Frame& frame, const gl::Texture& visibility) override {
        const auto pass = frame.pass("clear");
        gl::RenderTarget({&visibility}).clearColour(0, glm::vec4(1));
    }
};

} // namespace

Entry none() {
    return {.id = "none",
            .title = "No shadow",
            .source = {Document::Zapotocky, "5.2"},
            .answer = Answer::Hard,
            .environment = EnvironmentAnswer::Also,
            .parameters = {},
            .variants = {""},
            .make = [](const Parameters&) { return std::make_unique<None>(); }};
}

} // namespace shadowbench::techniques
