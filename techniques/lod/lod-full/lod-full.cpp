// Every instance at its finest level: the reference image of level-of-detail techniques (dissertation, chapter 5).
#include "techniques/contract/entry.h"
#include "techniques/lod/shaded_pass.h"

namespace shadowbench::techniques {
namespace {

class LodFull final : public LodTechnique {
public:
    void render(const LodFrame& frame, const LodPicture& picture) override {
        std::vector<LevelDraw> draws;
        for (const LodInstance& instance : frame.instances) draws.push_back({&instance, 0});
        pass_.drawOpaque(frame, picture, draws);
    }

private:
    ShadedPass pass_;
};

} // namespace

Entry lodFull() {
    return {.id = "lod-full",
            .title = "Always the finest level of detail",
            .source = {Document::Dissertation, "chapter 5"},
            .answer = Answer::Colour,
            .parameters = {},
            .variants = {""},
            .makeLod = [](const Parameters&) { return std::make_unique<LodFull>(); }};
}

} // namespace shadowbench::techniques
