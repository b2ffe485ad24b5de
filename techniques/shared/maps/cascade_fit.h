// The views of cascaded shadow maps: the view frustum is cut into slices along the view axis, and each has a map of its own
// (Scherzer 2.2.2, z-partitioning).
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/shared/light_views/cascades.h"
#include "techniques/shared/light_views/light_view.h"
#include "techniques/shared/maps/cascade_rule.h"
#include "techniques/shared/maps/receiver_bounds.h"

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

namespace shadowbench::techniques {

class CascadeFit {
public:
    explicit CascadeFit(const CascadeRule& rule);

    /// Fits the slices to the frame; `texels` per side of the map of each. Where points are looked for, as the pass
    /// "receiver bounds".
    void fit(const Frame& frame, int texels);

    /// Forgets the frame before.
    void reset() { before_.reset(); }

    /// Of the frame that was fitted last: a view a slice, and the placements that cast into it, none where a slice has no
    /// receivers.
    [[nodiscard]] const std::vector<LightView>& views() const { return views_; }
    [[nodiscard]] const std::vector<std::vector<bool>>& casters() const { return casters_; }

    /// dot(·, (p, 1)): distance along the view axis.
    [[nodiscard]] const glm::dvec4& eyeDepthFromWorld() const { return region_.eyeDepthFromWorld; }

    /// `sliceEnds` of shared/maps/slice.glsl.
    [[nodiscard]] std::vector<glm::vec4> ends() const;

    /// The slice of a point, without regard to blending.
    [[nodiscard]] std::size_t sliceAt(const glm::dvec3& world) const;

private:
    /// What the maps are to hold.
    struct Region {
        Camera camera;
        glm::dvec4 eyeDepthFromWorld{0};
        std::vector<double> splits = {};               // eye depths at which slices meet
        std::vector<DepthRange> ranges = {};           // of each slice
        bool ofPoints = false;                         // of those that a G-buffer shows
        std::vector<std::optional<Bounds>> boxes = {}; // theirs in each slice, after `clipFromWorld`
        glm::dmat4 clipFromWorld{1};
    };

    [[nodiscard]] Region viewed(const Frame& frame) const;
    [[nodiscard]] Region seen(const Frame& frame);
    void divide(Region& region, const DepthRange& depths) const;
    void fitSlices(const Frame& frame, int texels);
    [[nodiscard]] const Light& lightOf(const Frame& frame) const;
    [[nodiscard]] LightView sliceView(const Frame& frame, std::size_t slice, int texels) const;
    [[nodiscard]] LightView partOfScene(const Frame& frame, std::size_t slice, const Camera& part) const;

    CascadeRule rule_;
    std::optional<ReceiverBounds> receivers_; // where they are fitted to what the G-buffer shows
    Region region_;
    std::optional<Region> before_; // what the frame before showed
    std::vector<LightView> views_;
    std::vector<std::vector<bool>> casters_;
};

} // namespace shadowbench::techniques
