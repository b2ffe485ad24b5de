#include "gate/check/client_scenes.h"

#include "scene/load/load.h"

namespace shadowbench::gate {
namespace {

struct Text {
    const char *id, *toml;
};

// Images are wider than high: a field of view that is taken for the horizontal one shows.
constexpr Text texts[] = {
    {"hands", R"(
title = "Hands"
size = [96, 72]
timeline = { still = 2, moving = 0 }
camera = { eye = [1.3, 4.1, 5.2], target = [0.1, 0.3, -0.2], fovy = 40, near = 0.5, far = 40 }
light = { kind = "point", centre = [2.7, 4.9, 1.3] }
[[object]]
name = "ground"
mesh = { box = { size = [9.1, 0.2, 8.3] } }
place = [{ at = [0.1, -0.1, -0.3] }]
[[object]]
name = "posts"
mesh = { box = { size = [0.31, 1.9, 0.27] } }
place = [{ at = [-0.9, 0.97, -0.7], turn = 17 }, { at = [0.7, 0.97, -1.1], turn = -31 }]
[[object]]
name = "beams"
mesh = { box = { size = [1.7, 0.21, 0.33] } }
place = [{ at = [-0.3, 1.63, 0.9], turn = 37 }, { at = [0.9, 0.71, 0.3], turn = -14 }, { at = [-1.5, 0.9, 0.1], turn = 81 }]
)"},
    {"sun", R"(
title = "Sun"
size = [96, 72]
timeline = { still = 2, moving = 0 }
camera = { eye = [130, 410, 520], target = [10, 30, -20], fovy = 44, near = 50, far = 4000 }
light = { kind = "directional", direction = [-0.48, -0.8, -0.36] }
[[object]]
name = "ground"
mesh = { box = { size = [910, 20, 830] } }
place = [{ at = [10, -10, -30] }]
[[object]]
name = "towers"
mesh = { box = { size = [31, 190, 27] } }
place = [{ at = [-90, 97, -70], turn = 17 }, { at = [70, 97, -110], turn = -31 }, { at = [150, 97, 110], turn = 5 }]
[[object]]
name = "bridge"
mesh = { box = { size = [170, 21, 33] } }
place = [{ at = [-30, 63, 90], turn = 37 }]
)"},
    {"moving", R"(
title = "Moving"
size = [96, 72]
timeline = { still = 2, moving = 2 }
light = { kind = "point", centre = [-1.7, 4.3, 0.9], path = [{ frame = 0, centre = [-1.7, 4.3, 0.9] }, { frame = 2, centre = [0.9, 4.5, 1.5] }] }
[camera]
eye = [0.7, 4.3, 5.1]
target = [0.1, 0.2, -0.1]
fovy = 42
near = 0.5
far = 40
path = [{ frame = 0, shift = [0, 0, 0] }, { frame = 2, shift = [0.7, 0, 0] }]
[[object]]
name = "ground"
mesh = { box = { size = [9.1, 0.2, 8.3] } }
place = [{ at = [0.1, -0.1, -0.3] }]
[[object]]
name = "still blocks"
mesh = { box = { size = [0.43, 1.1, 0.51] } }
place = [{ at = [-1.1, 0.57, 0.9], turn = 23 }]
[[object]]
name = "moving blocks"
mesh = { box = { size = [0.9, 0.31, 0.71] } }
place = [{ at = [-0.3, 1.1, -0.7], turn = -18 }, { at = [0.9, 0.6, 0.7], turn = 33 }]
path = [{ frame = 0, shift = [0, 0, 0] }, { frame = 2, shift = [0.8, 0, 0.5] }]
)"},
    {"contact", R"(
title = "Contact"
size = [96, 72]
timeline = { still = 2, moving = 0 }
camera = { eye = [-1.9, 2.9, 4.3], target = [0.1, 0.3, -0.2], fovy = 44, near = 0.5, far = 40 }
light = { kind = "point", centre = [-3.9, 2.3, 0.7] }
[[object]]
name = "ground"
mesh = { box = { size = [6.1, 0.2, 5.7] } }
place = [{ at = [0.1, -0.1, -0.3] }]
[[object]]
name = "wall"
mesh = { box = { size = [0.4, 2.6, 5.3] } }
place = [{ at = [2.3, 1.29, -0.3], turn = 9 }]
[[object]]
name = "steps"
mesh = { box = { size = [0.9, 0.23, 1.3] } }
place = [{ at = [-1.3, 0.117, 0.7], turn = 21 }, { at = [0.6, 0.117, -0.6], turn = -13 }, { at = [0.5, 0.117, 1.3], turn = 40 }, { at = [-1.1, 0.117, -1.2], turn = 3 }, { at = [-0.2, 0.117, 0.4], turn = -8 }, { at = [1.3, 0.117, 0.9], turn = 15 }, { at = [-0.4, 0.117, -2.1], turn = 9 }]
)"},
    {"sheets", R"(
title = "Sheets"
size = [96, 72]
timeline = { still = 2, moving = 0 }
camera = { eye = [0.9, 3.7, 5.3], target = [0.1, 0.3, -0.2], fovy = 44, near = 0.5, far = 40 }
light = { kind = "point", centre = [0.7, 5.3, -0.9] }
[[object]]
name = "ground"
mesh = { box = { size = [9.1, 0.2, 8.3] } }
place = [{ at = [0.1, -0.1, -0.3] }]
[[object]]
name = "sheets that face the light"
mesh = { plane = { half = 0.53 } }
place = [{ at = [-0.9, 1.1, 0.9], turn = 23 }]
[[object]]
name = "sheets that face away"
mesh = { plane = { half = 0.53 } }
place = [{ matrix = [0.8, 0, 0.6, 0, 0, -1, 0, 0, 0.6, 0, -0.8, 0, 0.8, 1.3, 0.5, 1] }]
)"},
    {"soft", R"(
title = "Soft"
size = [96, 72]
timeline = { still = 2, moving = 0 }
camera = { eye = [0.9, 3.9, 5.3], target = [0.1, 0.3, -0.2], fovy = 44, near = 0.5, far = 40 }
light = { kind = "rectangle", centre = [0.3, 2.9, -0.3], u = [2.6, 0, 0.4], v = [-0.3, 0, 1.95] }
[[object]]
name = "ground"
mesh = { box = { size = [9.1, 0.2, 8.3] } }
place = [{ at = [0.1, -0.1, -0.3] }]
[[object]]
name = "posts"
mesh = { box = { size = [0.41, 1.7, 0.37] } }
place = [{ at = [-1.2, 0.87, 0.3], turn = 17 }, { at = [1.1, 0.87, -0.6], turn = -31 }]
[[object]]
name = "table"
mesh = { box = { size = [1.3, 0.11, 0.9] } }
place = [{ at = [0.1, 0.9, 1.1], turn = 12 }]
)"},
};

} // namespace

std::vector<Scene> clientScenes() {
    std::vector<Scene> scenes;
    for (const Text& text : texts) {
        scenes.push_back(parseScene(text.toml, std::string(text.id) + ".toml", Profile::Gate));
        requireWellPosed(scenes.back());
    }
    return scenes;
}

} // namespace shadowbench::gate
