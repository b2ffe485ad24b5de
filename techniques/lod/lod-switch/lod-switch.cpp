// Discrete levels of detail (dissertation 2.4.2): an instance changes its level from one frame to the next, here in the
// middle of what is a transition for others.
#include "techniques/contract/entry.h"
#include "techniques/lod/shaded_pass.h"

namespace shadowbench::techniques {
namespace {

class LodSwitch final : public LodTechnique {
public:
    void render(const LodFrame& frame, const LodPicture& picture) override {
        std::vector<LevelDraw> draws;
        for (const LodInstance& instance : frame.instances) draws.push_back(switched(instance));
        pass_.drawOpaque(frame, picture, draws);
    }

private:
    ShadedPass pass_;
};

} // namespace

Entry lodSwitch() {
    return {.id = "lod-switch",
            .title = "Discrete switching of levels",
            .source = {Document::Dissertation, "2.4.2"},
            .answer = Answer::Colour,
            .parameters = {},
            .variants = {""},
            .makeLod = [](const Parameters&) { return std::make_unique<LodSwitch>(); }};
}

} // namespace shadowbench::techniques
