#include "studies/recommend/receivers.h"

#include "base/error.h"
#include "groundtruth/cgal/hard/exact.h"

namespace shadowbench::recommend {

using groundtruth::Surface;

Receivers receivers(const Snapshot& drawn, glm::ivec2 size, const Casters& casters, const Progress& progress) {
    Receivers result{groundtruth::hard::primaryHits(drawn, size, progress), size, {}};
    for (std::size_t i = 0; i < result.primary.id.size(); ++i) {
        if (result.primary.surface[i] != Surface::Receiver) continue;
        ++result.all;
        if (casters.hasLevels(result.primary.id[i])) {
            result.primary.surface[i] = Surface::Background;
            continue;
        }
        result.ids.insert(result.primary.id[i]);
        ++result.pixels;
    }
    if (result.pixels == 0)
        throw BadInput("no pixel of the frame shows a lit side of an object without levels of detail, on which shadows of "
                       "casters' levels could be compared: add a ground, or turn the camera");
    return result;
}

} // namespace shadowbench::recommend
