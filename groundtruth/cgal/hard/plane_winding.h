// Winding numbers of a plane's shadow edges at pixel centres: exact at one centre, from there on by the changes along rows
// and columns, and exact again where an edge may pass through a centre.
#pragma once

#include "groundtruth/cgal/hard/occluders.h"
#include "groundtruth/cgal/hard/scanline.h"
#include "scene/camera.h"

#include <optional>
#include <vector>

namespace shadowbench::groundtruth::hard {

/// A plane as the image sees it. `members` are the pixels that see the receiver.
struct PlaneView {
    const Camera& camera;
    glm::ivec2 size;
    Triangle plane;
    const Image<std::uint8_t>& members;
};

class PlaneWinding {
public:
    /// `edges` are those of `casters` in pixels. All arguments must live longer. InternalError if winding numbers found
    /// along different paths differ.
    PlaneWinding(const PlaneView& view, const Occluders& occluders, const Casters& casters,
                 const std::vector<PixelEdge>& edges);

    /// Winding numbers around the centre of a member.
    [[nodiscard]] WindingAround::Range at(int x, int y) const;

    /// The following are indexed by pixel + scanMargin: `width` × `height` centres.
    [[nodiscard]] int width() const { return wanted_.width(); }
    [[nodiscard]] int height() const { return wanted_.height(); }

    static constexpr int unknown = -1;
    /// `unknown` where no label is wanted: only members and their neighbours on the plane are known.
    [[nodiscard]] int number(int x, int row) const;
    /// Is the number known, and does no edge pass so near the centre that only exact arithmetic can tell on which side?
    [[nodiscard]] bool isCertain(int x, int row) const { return wanted_(x, row) != 0 && winding_.uncertain(x, row) == 0; }

private:
    void findWanted(int row);
    void sumRow(int row);
    void linkRows();
    void checkRow(int row) const;
    void listUncertainEdges();
    [[nodiscard]] bool onPlane(int x, int row) const;
    [[nodiscard]] std::optional<int> firstCertain(int row) const;
    [[nodiscard]] std::optional<int> linkColumn(int row) const;
    [[nodiscard]] Ray centreRay(int x, int row) const;
    [[nodiscard]] SpatialEdge edge(std::uint32_t index) const;
    void addEdges(WindingAround& around, std::size_t begin, std::size_t end) const;
    /// At pixel + scanMargin.
    [[nodiscard]] int exactNumber(glm::ivec2 at) const;
    [[nodiscard]] int exactNumber(glm::ivec2 at, glm::ivec2 start) const;
    [[nodiscard]] WindingAround::Range exactAround(int x, int row) const;
    [[nodiscard]] std::vector<TriangleName> groundedAt(const ReceiverPoint& point) const;
    [[nodiscard]] std::optional<int> nearestCertain(int x, int row) const;

    const PlaneView& view_;
    const Occluders& occluders_;
    const Casters& casters_;
    const std::vector<PixelEdge>& edges_;
    Winding winding_;                                        // `change` is summed up along rows
    Image<std::uint8_t> wanted_;                             // members and their neighbours on the plane
    std::vector<std::optional<int>> shift_;                  // winding number before a row's first change
    std::vector<std::vector<std::uint32_t>> uncertainEdges_; // of rows with members whose number is uncertain
};

} // namespace shadowbench::groundtruth::hard
