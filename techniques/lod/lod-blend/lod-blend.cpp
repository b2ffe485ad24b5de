// Blending of levels (Giegl and Wimmer 2007, dissertation 2.4.3): both levels of an instance in transition are drawn in
// every frame, the wholly visible one opaque, the other blended over it, depth-tested but not written, its polygons in no
// order. In the middle of the transition the two swap roles.
#include "techniques/contract/entry.h"
#include "techniques/lod/shaded_pass.h"
#include "techniques/lod/transition.h"

namespace shadowbench::techniques {
namespace {

class LodBlend final : public LodTechnique {
public:
    void render(const LodFrame& frame, const LodPicture& picture) override {
        std::vector<LevelDraw> opaque, fading;
        for (const LodInstance& instance : frame.instances) {
            opaque.push_back(switched(instance));
            if (instance.selection.inTransition()) fading.push_back(otherLevel(instance));
        }
        pass_.drawOpaque(frame, picture, opaque);
        pass_.drawFading(frame, picture, fading);
    }

private:
    /// The level that switching does not show.
    static LevelDraw otherLevel(const LodInstance& instance) {
        const auto& [level, progress] = instance.selection;
        const TransitionVisibility visibility = transitionVisibility(progress);
        if (showsCoarser(progress)) return {&instance, level, static_cast<float>(visibility.finer)};
        return {&instance, level + 1, static_cast<float>(visibility.coarser)};
    }

    ShadedPass pass_;
};

} // namespace

Entry lodBlend() {
    return {.id = "lod-blend",
            .title = "Two-phase alpha blending of levels",
            .source = {Document::Dissertation, "2.4.3"},
            .answer = Answer::Colour,
            .parameters = {},
            .variants = {""},
            .makeLod = [](const Parameters&) { return std::make_unique<LodBlend>(); }};
}

} // namespace shadowbench::techniques
