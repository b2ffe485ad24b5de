#include "techniques/shared/maps/stale_pages.h"

#include "techniques/shared/light_views/light_planes.h"

#include <algorithm>

namespace shadowbench::techniques {
namespace {

bool sameView(const LightView& a, const LightView& b) {
    return a.clipFromWorld == b.clipFromWorld && a.depthFromWorld == b.depthFromWorld && a.far == b.far &&
           a.perspective == b.perspective;
}

} // namespace

void StalePages::drop(PageCache& cache, const Snapshot& snapshot, const std::vector<LightView>& planes,
                      const std::function<LightView(const Page&)>& viewOf) {
    const std::optional<std::vector<glm::dvec3>> moved = changes_.since(snapshot);
    const bool samePlanes = std::ranges::equal(planes, planes_, sameView);
    planes_ = planes;
    if (!moved || !samePlanes) {
        cache.clear();
    } else if (!moved->empty()) {
        cache.drop([&](const Page& page) {
            const std::vector<bool> meets = castersIn(viewOf(page), *moved);
            return std::ranges::find(meets, true) != meets.end();
        });
    }
}

} // namespace shadowbench::techniques
