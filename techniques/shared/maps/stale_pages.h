// Which of the pages that are kept would be drawn otherwise in another frame (no GL).
#pragma once

#include "techniques/shared/light_views/light_view.h"
#include "techniques/shared/maps/caster_changes.h"
#include "techniques/shared/maps/page_cache.h"

#include <functional>
#include <vector>

namespace shadowbench::techniques {

class StalePages {
public:
    /// Leaves in the cache what this frame would draw just so: nothing if the views of the planes are others than at the
    /// last call, or casters have come or gone; else pages into whose view (`viewOf`) no caster has moved, nor out of it.
    void drop(PageCache& cache, const Snapshot& snapshot, const std::vector<LightView>& planes,
              const std::function<LightView(const Page&)>& viewOf);

    /// Makes the next call the first.
    void forget() { changes_.forget(); }

private:
    CasterChanges changes_;
    std::vector<LightView> planes_;
};

} // namespace shadowbench::techniques
