// A shadow that is there for a while, and then its caster is gone: what rows that remember leave of it.
#pragma once

#include "tests/support/rows_over_frames.h"
#include "tests/support/soft_scenes.h"

namespace shadowbench {

/// Of an umbra that halfPlaneScene() has at x = 0.8 under a smaller light, for ten frames: the share in [0, 1] that is left
/// in the frame `gone`, from 1, of those after its plate has leapt away by `leap` metres.
inline double leftOfTheUmbra(const std::string& variant, double leap, int gone) {
    Scene scene = halfPlaneScene();
    scene.light.u.x = scene.light.v.z = 0.2;
    scene.timeline = {10, 2};
    scene.objects[1].motion.shift.keys = {{0, {0, 0, 0}}, {1, {leap, 0, 0}}, {2, {leap, 0, 0}}};
    Stage stage(scene);
    const auto row = rowOf(variant);
    for (int frame = 0; frame < 10 + gone; ++frame) {
        stage.show(frame);
        stage.render(*row, frame, 1);
    }
    return 1 - visibilityAt(slabPoints(stage, stage.visibility()), 0.8, 0.1);
}

} // namespace shadowbench
