#include "tools/mutants/operators/point.h"

#include <algorithm>
#include <fmt/format.h>
#include <span>

namespace shadowbench::mutants {
namespace {

class Writer {
public:
    explicit Writer(std::string_view source) : source_(source) {}

    Switched write(std::span<const Point> points) {
        result_.text = "#include \"tools/mutants/operators/active.h\"\n#line 1\n";
        writePart(0, source_.size(), points);
        return std::move(result_);
    }

private:
    /// The source from `begin` to `end` with `points`, which lie there, outer ones before those in them.
    void writePart(std::size_t begin, std::size_t end, std::span<const Point> points) {
        while (!points.empty()) {
            const Point& point = points.front();
            result_.text += source_.substr(begin, point.begin - begin);
            std::size_t inner = 1;
            while (inner < points.size() && points[inner].begin < point.end) ++inner;
            writePoint(point, points.subspan(1, inner - 1));
            begin = point.end;
            points = points.subspan(inner);
        }
        result_.text += source_.substr(begin, end - begin);
    }

    void writePoint(const Point& point, std::span<const Point> inner) {
        const std::size_t start = result_.text.size();
        result_.text += point.after.empty() ? fmt::format("{{ if (!::mutants::active({})) ", point.number)
                                            : fmt::format("(::mutants::active({}) ? ({}) : (", point.number, point.after);
        writePart(point.begin, point.end, inner);
        result_.text += point.after.empty() ? " }" : "))";
        result_.ranges.push_back({start, result_.text.size(), point.number});
    }

    std::string_view source_;
    Switched result_;
};

} // namespace

std::optional<int> Switched::around(std::size_t offset) const {
    for (const Range& range : ranges) // inner ones come first
        if (range.begin <= offset && offset < range.end) return range.number;
    return {};
}

Switched switched(std::string_view source, std::vector<Point> points) {
    std::ranges::stable_sort(
        points, [](const Point& a, const Point& b) { return a.begin != b.begin ? a.begin < b.begin : a.end > b.end; });
    return Writer(source).write(points);
}

} // namespace shadowbench::mutants
