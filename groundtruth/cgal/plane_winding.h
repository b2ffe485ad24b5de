// Winding numbers of a plane's shadow edges at pixel centres: exact at one centre, from there on by the changes along rows
// and columns, and exact again where an edge may pass through a centre.
#pragma once

#include "groundtruth/cgal/occluders.h"
#include "groundtruth/cgal/scanline.h"
#include "harness/scene/camera.h"

#include <optional>
#include <vector>

namespace shadowbench::groundtruth {

/// A plane as the image sees it. `members` are the pixels that see the receiver.
struct PlaneView {
    const Camera& camera;
    glm::ivec2 size;
    Triangle plane;
    const Image<std::uint8_t>& members;
};

class PlaneWinding {
public:
    /// `edges` are those of `casters` in pixels. All arguments must live longer. InternalError if the winding numbers that
    /// different ways lead to differ.
    PlaneWinding(const PlaneView& view, const Occluders& occluders, const Casters& casters,
                 const std::vector<PixelEdge>& edges);

    /// Winding numbers around the centre of a member.
    [[nodiscard]] WindingAround::Range at(int x, int y) const;

    /// Indexed by pixel + scanMargin; −1 where not known: only members and their neighbours on the plane are.
    [[nodiscard]] const Image<int>& numbers() const { return winding_.change; }
    [[nodiscard]] const Image<std::uint8_t>& uncertain() const { return winding_.uncertain; }

private:
    void findWanted(int row);
    void sumRow(int row);
    void linkRows();
    void checkRow(int row) const;
    void finishRow(int row);
    void listUncertainEdges();
    [[nodiscard]] bool onPlane(int x, int row) const;
    [[nodiscard]] bool isCertain(int x, int row) const { return wanted_(x, row) != 0 && winding_.uncertain(x, row) == 0; }
    [[nodiscard]] std::optional<int> firstCertain(int row) const;
    [[nodiscard]] std::optional<int> linkColumn(int row) const;
    void requireExact(int row) const;
    [[nodiscard]] Ray centreRay(int x, int row) const;
    [[nodiscard]] SpatialEdge edge(std::uint32_t index) const;
    [[nodiscard]] int exactNumber(int x, int row) const;
    [[nodiscard]] WindingAround::Range exactAround(int x, int row) const;
    [[nodiscard]] std::vector<TriangleName> groundedAt(const ReceiverPoint& point) const;
    [[nodiscard]] std::optional<int> nearestCertain(int x, int row) const;

    const PlaneView& view_;
    const Occluders& occluders_;
    const Casters& casters_;
    const std::vector<PixelEdge>& edges_;
    Winding winding_;                                        // `change` becomes the winding number
    Image<std::uint8_t> wanted_;                             // members and their neighbours on the plane
    std::vector<std::optional<int>> shift_;                  // winding number before a row's first change
    std::vector<std::vector<std::uint32_t>> uncertainEdges_; // of rows with members whose number is uncertain
};

} // namespace shadowbench::groundtruth
